// Vectors of one width, such as what an encoder makes of clips: one vector each.
#pragma once

#include <cstddef>
#include <span>
#include <string>
#include <vector>

#include "study/measure/movement.h"
#include "study/measure/pose_errors.h"

namespace chironomia::study {

struct Vectors {
    std::size_t width = 0;       // D
    std::vector<double> values;  // (N, D)

    std::size_t count() const { return width == 0 ? 0 : values.size() / width; }
    std::span<const double> operator[](std::size_t i) const {
        return std::span(values).subspan(i * width, width);
    }
};

// Throws Error, beginning with `where`, if a value is infinite or not a number.
void require_finite(const Vectors& vectors, const std::string& where);

double squared_distance(std::span<const double> a, std::span<const double> b);

// Each frame's x and y (and z), point by point; frames that miss a point are left out.
Vectors poses_of(const PointPaths& paths, Axes axes = Axes::picture);

// The vectors less their mean along the `most` directions in which they vary most, largest first: (N, least of
// `most`, D and N). Distances are kept as well as they can be in so few dimensions. The directions' signs are
// any.
Vectors principal_components(const Vectors& vectors, std::size_t most);

}  // namespace chironomia::study
