// Faces as Py-Feat's detectors write them, a row per face and frame (Cheong et al. 2023, "Py-Feat: Python Facial
// Expression Analysis Toolbox"; columns of its Fex class, versions 0.3 to 0.6).
#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "core/body/motion.h"

namespace chironomia {

// By the names of its columns: "FaceScore" beside action units such as "AU12".
bool looks_like_pyfeat(const std::vector<std::string>& columns);

// A motion with a face alone. Action units are how likely each is, 0 to 1: shown as intensities from 0 to 5, with a
// note; AU43, eyes closed, is AU45. A row without a FaceScore failed. Turns of the head are left out, with a note:
// detectors give them different signs. Rows have no times: `fps` counts them, by the column "frame" where there is one.
// Throws Error with the line for anything that cannot be meant, and without `fps`.
Motion face_of_pyfeat(std::string_view text, const std::string& where, std::optional<double> fps);

}  // namespace chironomia
