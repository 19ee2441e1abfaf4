// Blurring a face or a mouth in the finished picture, so that the region follows the head.
#pragma once

#include <memory>

#include "core/body/avatar.h"
#include "core/body/face_region.h"
#include "core/render/frame.h"
#include "core/render/renderer.h"
#include "core/render/scene.h"

namespace chironomia {

// Standard deviation of the blur, of the height of the face (FaceRegion::height).
inline constexpr float kFaceSigma = 0.11f;
inline constexpr float kMouthSigma = 0.07f;

struct FaceBlurSpec {
    FaceRegion face;                 // of the avatar in its rest pose
    FacePart part = FacePart::face;  // what is blurred: the face with the mouth, or the mouth alone
    float sigma = kFaceSigma;        // of the height of the face
};

// Blurs the frames of one avatar under one camera.
//
// The region is what the camera sees of the part's triangles in the mesh of that frame, widened by about half
// a sigma with a soft edge beyond; it vanishes as the face turns away. Inside it the picture is a Gaussian
// mean in linear light, with the same sigma in pixels in every frame: that of the spec at the distance of the
// face in the rest pose, so that all motions on one avatar and scene get the same. Outside not a byte
// changes. Arms and hands before the face stay sharp, and their colours are not blurred into it. What
// does not belong to `avatar` counts as background.
class FaceBlur {
  public:
    // Throws Error unless the avatar's head is in front of the camera in the rest pose.
    FaceBlur(const Avatar& avatar, const FaceBlurSpec& spec, const Camera& camera, RenderSize size);
    ~FaceBlur();
    FaceBlur(FaceBlur&&) noexcept;

    float sigma() const;  // [px]

    //   frame   (H, W, 4) of the size given before, drawn from `mesh`
    void apply(Frame& frame, const PosedMesh& mesh) const;

  private:
    struct Parts;
    std::unique_ptr<Parts> parts_;
};

// What `renderer` draws, blurred. An exposure over time is blurred where its middle shows the face.
std::unique_ptr<Renderer> blur_faces(std::unique_ptr<Renderer> renderer, FaceBlur blur);

}  // namespace chironomia
