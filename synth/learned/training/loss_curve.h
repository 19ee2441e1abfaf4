// The losses of a training as a drawing.
#pragma once

#include <string>
#include <vector>

#include "synth/learned/training/checkpoint.h"

namespace chironomia {

// An SVG of both losses over the steps, on a logarithmic axis where they differ much.
std::string draw_loss_curve(const std::string& title, const std::vector<CurvePoint>& curve);

}  // namespace chironomia
