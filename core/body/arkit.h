// What ARKit's coefficients and action units say of the same jaw.
#pragma once

namespace chironomia {

// How much of jawOpen, the widest drop there is (AU27), shows a whole AU26, a relaxed one. mouthClose takes the lips of
// the same drop back to each other: as much of it shows a whole AU8. Ours, by eye.
inline constexpr float kWholeDrop = 0.7f;

}  // namespace chironomia
