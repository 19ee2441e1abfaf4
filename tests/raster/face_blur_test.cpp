#include "raster/studio/face_blur.h"

#include <gtest/gtest.h>

#include <cmath>

#include "core/body/rest.h"
#include "core/random.h"
#include "core/render/srgb.h"
#include "raster/studio/gaussian.h"
#include "tests/raster/shapes.h"

namespace chironomia {
namespace {

using testing::avatar_of;
using testing::quad;

const RenderSize kSize{320, 240};

// 1 m is 100 px at z = 0; the picture's middle is the origin.
Camera square_on() {
    return {.eye = {0, 0, 4}, .target = {0, 0, 0}, .fov_y = 2 * std::atan(1.2f / 4)};
}

// A face of 1 m x 1 m in the middle, whose blur has a sigma of 8 px, and whatever else there is.
struct Scenery {
    Avatar avatar = avatar_of({quad({.low = Vec2(-0.5f), .high = Vec2(0.5f)})});
    FaceBlurSpec spec{.face = {.height = 1, .parts = {std::vector<FacePart>(4, FacePart::face)}},
                      .part = FacePart::face,
                      .sigma = 0.08f};

    void add(const Surface& surface, FacePart part) {
        avatar.surfaces.push_back(surface);
        avatar.surfaces.back().joint = avatar.surfaces.back().material = 0;
        spec.face.parts.emplace_back(surface.positions.size(), part);
    }

    FaceBlur blur() const { return FaceBlur(avatar, spec, square_on(), kSize); }

    Frame blurred(const Frame& frame) const {
        Frame result = frame;
        blur().apply(result, rest_mesh(avatar));
        return result;
    }
};

Frame filled(const Vec3& levels) {
    Frame frame{.width = kSize.width, .height = kSize.height, .rgba = {}};
    for (int i = 0; i < kSize.width * kSize.height; ++i) {
        for (int channel = 0; channel < 3; ++channel)
            frame.rgba.push_back(static_cast<std::uint8_t>(levels[channel]));
        frame.rgba.push_back(255);
    }
    return frame;
}

std::uint8_t* pixel(Frame& frame, int x, int y) {
    return frame.rgba.data() + (static_cast<size_t>(y) * kSize.width + static_cast<size_t>(x)) * 4;
}

// Patches of 5 x 5 px of any colour.
Frame patchwork() {
    Frame frame = filled(Vec3(0));
    for (int y = 0; y < kSize.height; ++y) {
        for (int x = 0; x < kSize.width; ++x) {
            Random random(static_cast<std::uint64_t>(y / 5 * 1000 + x / 5));
            for (int channel = 0; channel < 3; ++channel)
                pixel(frame, x, y)[channel] = static_cast<std::uint8_t>(random.uniform() * 255);
        }
    }
    return frame;
}

// The definition of a Gaussian mean, without any short cut.
double gaussian_at(Frame frame, int x, int y, int channel, double sigma) {
    double sum = 0, weights = 0;
    const int reach = static_cast<int>(4 * sigma);
    for (int j = -reach; j <= reach; ++j) {
        for (int i = -reach; i <= reach; ++i) {
            const double weight = std::exp(-(i * i + j * j) / (2 * sigma * sigma));
            sum += weight * linear_from_srgb(pixel(frame, x + i, y + j)[channel] / 255.0);
            weights += weight;
        }
    }
    return 255 * srgb_from_linear(sum / weights);
}

double light_of(Frame frame) {
    double sum = 0;
    for (int y = 0; y < kSize.height; ++y) {
        for (int x = 0; x < kSize.width; ++x) sum += linear_from_srgb(pixel(frame, x, y)[0] / 255.0);
    }
    return sum;
}

TEST(GaussianWeights, SumToOneAndHaveTheirSigma) {
    for (const float sigma : {0.7f, 2.0f, 5.3f}) {
        const auto weights = gaussian_weights(sigma);
        double sum = weights[0], variance = 0;
        for (size_t i = 1; i < weights.size(); ++i) {
            sum += 2 * weights[i];
            variance += 2 * weights[i] * static_cast<double>(i * i);
        }
        EXPECT_NEAR(sum, 1, 1e-6);
        EXPECT_NEAR(std::sqrt(variance), sigma, 0.03 * sigma);
    }
}

TEST(FaceBlur, IsAGaussianMeanInLinearLight) {
    for (const float sigma : {0.03f, 0.08f, 0.14f}) {
        Scenery scenery;
        scenery.spec.sigma = sigma;
        EXPECT_NEAR(scenery.blur().sigma(), 100 * sigma, 1e-3);
        const Frame before = patchwork();
        Frame after = scenery.blurred(before);
        for (int y = 90; y <= 150; y += 7) {
            for (int x = 130; x <= 190; x += 7) {
                for (int channel = 0; channel < 3; ++channel) {
                    EXPECT_NEAR(pixel(after, x, y)[channel], gaussian_at(before, x, y, channel, 100 * sigma),
                                3)
                        << x << ", " << y << ", sigma " << sigma;
                }
            }
        }
    }
}

TEST(FaceBlur, LeavesEveryByteOutsideAsItIs) {
    const Scenery scenery;
    Frame before = patchwork();
    Frame after = scenery.blurred(before);
    EXPECT_NE(after, before);
    for (int y = 0; y < kSize.height; ++y) {
        for (int x = 0; x < kSize.width; ++x) {
            // The face reaches from 110 to 210 and from 70 to 170; the edge fades within two sigma.
            const int outside = std::max(std::abs(x - 160), std::abs(y - 120)) - 50;
            if (outside <= 20) continue;
            for (int channel = 0; channel < 4; ++channel)
                ASSERT_EQ(pixel(after, x, y)[channel], pixel(before, x, y)[channel]) << x << ", " << y;
        }
    }
}

TEST(FaceBlur, KeepsOneColourAndTheSumOfLight) {
    const Scenery scenery;
    const Frame grey = filled(Vec3(90, 150, 210));
    EXPECT_EQ(scenery.blurred(grey), grey);

    Frame spot = filled(Vec3(0));
    for (int y = 110; y < 130; ++y) {
        for (int x = 150; x < 170; ++x) pixel(spot, x, y)[0] = 255;
    }
    EXPECT_NEAR(light_of(scenery.blurred(spot)), light_of(spot), 0.01 * light_of(spot));
}

// A bright square before black stays recognisable at no place of the face: no step between neighbours is
// left.
TEST(FaceBlur, LeavesNoEdgeInside) {
    const Scenery scenery;
    Frame frame = filled(Vec3(0));
    for (int y = 100; y < 140; ++y) {
        for (int x = 160; x < 200; ++x) pixel(frame, x, y)[0] = 255;
    }
    Frame after = scenery.blurred(frame);
    for (int x = 112; x < 208; ++x)
        EXPECT_LT(std::abs(pixel(after, x, 120)[0] - pixel(after, x + 1, 120)[0]), 24) << x;
}

TEST(FaceBlur, HasOneStrengthHoweverNearTheFaceComes) {
    const Scenery scenery;
    const FaceBlur blur = scenery.blur();
    PosedMesh near = rest_mesh(scenery.avatar);
    for (Vec3& place : near.surfaces[0].positions) place.z = 1;
    const Frame before = patchwork();
    Frame far_frame = before, near_frame = before;
    blur.apply(far_frame, rest_mesh(scenery.avatar));
    blur.apply(near_frame, near);
    for (int y = 110; y <= 130; ++y) {
        for (int x = 150; x <= 170; ++x) EXPECT_EQ(pixel(near_frame, x, y)[0], pixel(far_frame, x, y)[0]);
    }
}

TEST(FaceBlur, FollowsTheMesh) {
    const Scenery scenery;
    PosedMesh moved = rest_mesh(scenery.avatar);
    for (Vec3& place : moved.surfaces[0].positions) place.x -= 1;  // 100 px to the left
    Frame before = patchwork(), after = before;
    scenery.blur().apply(after, moved);
    EXPECT_NEAR(pixel(after, 60, 120)[0], gaussian_at(before, 60, 120, 0, 8), 3);
    EXPECT_EQ(pixel(after, 160, 120)[0], pixel(before, 160, 120)[0]);
    for (Vec3& place : moved.surfaces[0].positions) place.x += 100;  // out of the picture
    after = before;
    scenery.blur().apply(after, moved);
    EXPECT_EQ(after, before);
}

TEST(FaceBlur, EndsWhereTheFaceTurnsAwayOrIsHidden) {
    const Frame before = patchwork();
    Scenery turned;
    for (size_t i = 0; i < 6; i += 3) {
        auto& triangles = turned.avatar.surfaces[0].triangles;
        std::swap(triangles[i + 1], triangles[i + 2]);
    }
    EXPECT_EQ(turned.blurred(before), before);

    Scenery hidden;
    hidden.add(quad({.low = Vec2(-0.6f), .high = Vec2(0.6f), .z = 0.2f}), FacePart::other);
    EXPECT_EQ(hidden.blurred(before), before);

    Scenery behind_camera;
    PosedMesh mesh = rest_mesh(behind_camera.avatar);
    for (Vec3& place : mesh.surfaces[0].positions) place.z = 5;
    Frame after = before;
    behind_camera.blur().apply(after, mesh);
    EXPECT_EQ(after, before);
}

// A red hand over the left half of a grey face.
TEST(FaceBlur, KeepsAHandInFrontSharpAndItsColourToItself) {
    Frame before = filled(Vec3(128));
    for (int y = 100; y < 140; ++y) {
        for (int x = 120; x < 160; ++x) pixel(before, x, y)[0] = 255;
    }
    Scenery scenery;
    // 1 m nearer everything is a third larger.
    scenery.add(quad({.low = Vec2(-0.3f, -0.15f), .high = Vec2(0, 0.15f), .z = 1}), FacePart::arm);
    EXPECT_EQ(scenery.blurred(before), before);
    // The same pixels blur where no hand is known of.
    EXPECT_NE(Scenery().blurred(before), before);
}

TEST(FaceBlur, OfTheMouthLeavesTheRestOfTheFace) {
    Scenery scenery;
    scenery.add(quad({.low = Vec2(-0.1f), .high = Vec2(0.1f), .z = 0.01f}), FacePart::mouth);
    scenery.spec.part = FacePart::mouth;
    scenery.spec.sigma = 0.05f;
    Frame before = patchwork(), after = scenery.blurred(before);
    EXPECT_NEAR(pixel(after, 160, 120)[1], gaussian_at(before, 160, 120, 1, 5), 3);
    for (const int x : {120, 130, 190, 200}) EXPECT_EQ(pixel(after, x, 120)[1], pixel(before, x, 120)[1]);
}

// Draws the picture it was given.
class Painter : public Renderer {
  public:
    explicit Painter(const Frame& frame) : frame_(frame) {}
    Frame render(std::span<const PosedMesh>) override { return frame_; }

  private:
    Frame frame_;
};

TEST(BlurFaces, BlursWhatTheRendererDrew) {
    const Scenery scenery;
    const Frame before = patchwork();
    const auto renderer = blur_faces(std::make_unique<Painter>(before), scenery.blur());
    EXPECT_EQ(renderer->render(std::vector(3, rest_mesh(scenery.avatar))), scenery.blurred(before));
}

}  // namespace
}  // namespace chironomia
