// The numbers of a frame that models of style see and make.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>

namespace chironomia {

// Of PATS's 52 joints, those that move against the neck and are no fingers: A21 of docs/learned_styles.md.
inline constexpr std::array<std::size_t, 11> kStyleJoints{1, 2, 3, 4, 5, 6, 7, 8, 9, 10, 31};
// Of OpenPose's 70 points of a face: contour, brows and lids (A30).
inline constexpr std::array<std::size_t, 15> kStyleFacePoints{0,  4,  8,  12, 16, 17, 19, 21,
                                                              22, 24, 26, 37, 41, 44, 46};

inline constexpr std::int64_t kStylePose = 2 * kStyleJoints.size();      // x of all, then y of all
inline constexpr std::int64_t kStyleFace = 2 * kStyleFacePoints.size();  // alike
inline constexpr std::int64_t kStyleMel = 128;
inline constexpr std::int64_t kStyleText = 768;
inline constexpr std::int64_t kStyleActs = 38;

}  // namespace chironomia
