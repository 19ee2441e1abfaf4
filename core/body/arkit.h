// What ARKit's coefficients and action units say of the same jaw.
#pragma once

namespace chironomia {

// The weight of jawOpen (at 1 the widest drop, AU27) that equals a full AU26, a relaxed drop. mouthClose brings the
// lips of the same drop back together: the same weight of it equals a full AU8. Ours, by eye.
inline constexpr float kWholeDrop = 0.7f;

}  // namespace chironomia
