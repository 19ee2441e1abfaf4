#include "scenes/framing.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "core/body/rest.h"
#include "core/render/camera.h"
#include "core/text.h"
#include "skinning/gltf/gltf.h"
#include "tests/scenes/stick_figure.h"
#include "tests/support/support.h"

namespace chironomia {
namespace {

using testing::rest_place;
using testing::stick_figure;

const std::vector<RenderSize> kSizes = {{1280, 720}, {1024, 768}, {720, 1280}, {512, 512}, {1920, 400}};

// How far inside the picture a point lies, as a share of its height; negative: outside.
float inside(const Camera& camera, RenderSize size, const Vec3& point) {
    const Vec2 pixel = pixel_of(camera, size, point);
    const auto width = static_cast<float>(size.width), height = static_cast<float>(size.height);
    return std::min({pixel.x, width - pixel.x, pixel.y, height - pixel.y}) / height;
}

Camera frame_figure(const FigureMeasures& figure, const Shot& shot, RenderSize size) {
    return frame_figures(std::span(&figure, 1), figure.forward, shot, size);
}

std::string size_text(RenderSize size) {
    return format("{} x {}", size.width, size.height);
}

TEST(MeasureFigure, LooksPastAPropThatIsLoose) {
    Avatar figure = stick_figure(1.7f);
    figure.surfaces[0].joint = figure.humanoid[HumanJoint::hips];
    Avatar beside = figure;
    Surface pillar;
    pillar.joint = 0;
    pillar.positions = {{0, -3, 0}, {0, 9, 0}, {0.1f, 0, 0}};
    pillar.normals.resize(3, Vec3(0, 0, 1));
    beside.surfaces.push_back(pillar);
    const FigureMeasures expected = measure_figure(figure), found = measure_figure(beside);
    EXPECT_EQ(found.floor, expected.floor);
    EXPECT_EQ(found.top, expected.top);
}

TEST(MeasureFigure, FindsLengthsAndFacing) {
    const FigureMeasures figure = measure_figure(stick_figure(2, 0.5f));
    EXPECT_NEAR(figure.floor, 0, 1e-5);
    EXPECT_NEAR(figure.top, 2, 1e-5);
    EXPECT_NEAR(figure.shoulders, 1.62, 1e-5);
    EXPECT_NEAR(figure.shoulder_width, 0.4, 1e-5);
    EXPECT_NEAR(figure.upper_arm, 0.34, 1e-5);
    EXPECT_NEAR(figure.hand, 0.2, 1e-5);
    EXPECT_NEAR(figure.forward.x, std::sin(0.5f), 1e-5);
    EXPECT_NEAR(figure.forward.z, std::cos(0.5f), 1e-5);
}

TEST(MeasureFigure, GuessesWhatTheMapLacks) {
    Avatar avatar = stick_figure(1.7f);
    avatar.humanoid = HumanoidMap();
    const FigureMeasures figure = measure_figure(avatar);
    EXPECT_NEAR(figure.shoulders, 0.81 * 1.7, 1e-4);
    EXPECT_NEAR(figure.knees, 0.28 * 1.7, 1e-4);
    EXPECT_NEAR(figure.upper_arm, 0.17 * 1.7, 1e-4);
}

// Whatever its size and the way it faces, a figure sits in the picture in the same way.
// The thighs of the figure turned forward and its shins down again, which a chair would hold at the same floor.
TEST(MeasureFigure, MeasuresWhoSitsAsStanding) {
    const Avatar standing = stick_figure(2, 0.5f);
    Avatar seated = standing;
    const auto turn = [&](HumanJoint part, float angle) {
        Quat& rest = seated.skeleton.joints[static_cast<size_t>(seated.humanoid[part])].rest.rotation;
        rest = rest * glm::angleAxis(angle, Vec3(1, 0, 0));
    };
    for (const HumanJoint thigh : {HumanJoint::left_upper_leg, HumanJoint::right_upper_leg})
        turn(thigh, -kPi / 2);
    for (const HumanJoint shin : {HumanJoint::left_lower_leg, HumanJoint::right_lower_leg})
        turn(shin, kPi / 2);
    for (Joint& joint : seated.skeleton.joints)
        if (joint.parent < 0) joint.rest.translation.y -= bounds_of(rest_mesh(seated)).low.y;
    const FigureMeasures figure = measure_figure(seated), expected = measure_figure(standing);
    EXPECT_NEAR(figure.floor, expected.floor, 1e-4);
    EXPECT_NEAR(figure.top, expected.top, 1e-4);
    EXPECT_NEAR(figure.hips, expected.hips, 1e-4);
    EXPECT_NEAR(figure.knees, expected.knees, 1e-4);
}

TEST(FrameFigure, DoesNotDependOnSizeAndFacing) {
    const Avatar small = stick_figure(0.5f), large = stick_figure(2, 2.0f);
    for (const Framing framing : {Framing::upper, Framing::full, Framing::head}) {
        const RenderSize size{1280, 720};
        const Camera near = frame_figure(measure_figure(small), {.framing = framing}, size);
        const Camera far = frame_figure(measure_figure(large), {.framing = framing}, size);
        for (const HumanJoint part : {HumanJoint::head, HumanJoint::left_hand, HumanJoint::right_lower_leg}) {
            const Vec2 a = pixel_of(near, size, rest_place(small, part));
            const Vec2 b = pixel_of(far, size, rest_place(large, part));
            EXPECT_NEAR(a.x, b.x, 0.1);
            EXPECT_NEAR(a.y, b.y, 0.1);
        }
    }
}

// All of the room of a framing lies inside the margin, and at least one corner on it.
TEST(FrameFigure, HoldsItsRoomAsTightlyAsItCan) {
    const FigureMeasures figure = measure_figure(stick_figure(1.7f));
    for (const RenderSize size : kSizes) {
        for (const Framing framing : {Framing::upper, Framing::full, Framing::head}) {
            for (const float yaw : {0.0f, 0.6f, -1.5f}) {
                const Camera camera =
                    frame_figure(figure, {.framing = framing, .yaw = yaw, .pitch = 0.1f}, size);
                float least_x = 1, least_y = 1;
                for (const Vec3& corner : room_of(figure, framing)) {
                    const Vec2 pixel = pixel_of(camera, size, corner);
                    const Vec2 share(pixel.x / static_cast<float>(size.width),
                                     pixel.y / static_cast<float>(size.height));
                    least_x = std::min({least_x, share.x, 1 - share.x});
                    least_y = std::min({least_y, share.y, 1 - share.y});
                }
                EXPECT_GT(std::min(least_x, least_y), 0.039) << size_text(size);
                EXPECT_LT(std::min(least_x, least_y), 0.045) << size_text(size);
            }
        }
    }
}

// Landmarks of a person at rest and in gesture, worked out by hand for a stick figure of 1.7 m.
TEST(FrameFigure, KeepsTheLandmarksOfItsFraming) {
    const Avatar avatar = stick_figure(1.7f);
    const FigureMeasures figure = measure_figure(avatar);
    const Vec3 top(0, 1.7f, 0), soles(0, 0, 0);
    const Vec3 hand_at_side(0.25f, 0.70f, 0), elbow_out(0.46f, 1.38f, 0), hand_ahead(0.2f, 1.2f, 0.4f);
    const Vec3 hand_overhead(0.2f, 2.1f, 0);
    for (const RenderSize size : kSizes) {
        const Camera upper = frame_figure(figure, {.framing = Framing::upper}, size);
        for (const Vec3& point : {top, hand_at_side, elbow_out, hand_ahead}) {
            EXPECT_GT(inside(upper, size, point), 0.03) << size_text(size);
        }
        // An upright picture is filled by its width and shows more of the legs.
        const bool upright = size.width < size.height;
        EXPECT_TRUE(upright || inside(upper, size, rest_place(avatar, HumanJoint::left_foot)) < 0);

        const Camera full = frame_figure(figure, {.framing = Framing::full}, size);
        for (const Vec3& point : {top, soles, hand_at_side, elbow_out, hand_ahead, hand_overhead}) {
            EXPECT_GT(inside(full, size, point), 0.02) << size_text(size);
        }

        const Camera head = frame_figure(figure, {.framing = Framing::head}, size);
        EXPECT_GT(inside(head, size, top), 0.03) << size_text(size);
        EXPECT_GT(inside(head, size, rest_place(avatar, HumanJoint::left_upper_arm)), 0.03)
            << size_text(size);
        EXPECT_LT(inside(head, size, rest_place(avatar, HumanJoint::hips)), 0) << size_text(size);
    }
}

// The figure is large in the picture: a head is at least a ninth of the height of an upper view at 16:9.
TEST(FrameFigure, WastesNoPicture) {
    const FigureMeasures figure = measure_figure(stick_figure(1.7f));
    const RenderSize size{1280, 720};
    const auto height_of = [&](Framing framing, const Vec3& low, const Vec3& high) {
        const Camera camera = frame_figure(figure, {.framing = framing}, size);
        return (pixel_of(camera, size, low).y - pixel_of(camera, size, high).y) / 720;
    };
    EXPECT_GT(height_of(Framing::upper, {0, 1.48f, 0}, {0, 1.7f, 0}), 0.15);
    EXPECT_GT(height_of(Framing::full, {0, 0, 0}, {0, 1.7f, 0}), 0.7);
    EXPECT_GT(height_of(Framing::head, {0, 1.48f, 0}, {0, 1.7f, 0}), 0.4);
}

TEST(FrameFigure, ZoomComesCloser) {
    const FigureMeasures figure = measure_figure(stick_figure(1.7f));
    const Camera far = frame_figure(figure, {}, {1280, 720});
    const Camera near = frame_figure(figure, {.zoom = 2}, {1280, 720});
    EXPECT_NEAR(length(far.eye - far.target), 2 * length(near.eye - near.target), 1e-4);
}

// Real figures: every vertex of the rest pose in a full view, head and shoulders in all.
class FrameRealFigure : public ::testing::TestWithParam<std::string> {};

TEST_P(FrameRealFigure, KeepsItInThePicture) {
    const Avatar avatar = read_avatar(testing::test_file(GetParam()));
    const FigureMeasures figure = measure_figure(avatar);
    const Vec3 top(figure.middle.x, figure.top, figure.middle.z);
    for (const RenderSize size : kSizes) {
        const Camera full = frame_figure(figure, {.framing = Framing::full, .pitch = 0.14f}, size);
        for (const Vec3& point : {bounds_of(rest_mesh(avatar)).low, bounds_of(rest_mesh(avatar)).high, top}) {
            EXPECT_GT(inside(full, size, {figure.middle.x, point.y, figure.middle.z}), 0.015)
                << size_text(size);
        }
        for (const Framing framing : {Framing::upper, Framing::full, Framing::head}) {
            const Camera camera = frame_figure(figure, {.framing = framing}, size);
            EXPECT_GT(inside(camera, size, top), 0.02) << size_text(size);
            EXPECT_GT(inside(camera, size, rest_place(avatar, HumanJoint::left_upper_arm)), 0.02)
                << size_text(size);
            EXPECT_GT(inside(camera, size, rest_place(avatar, HumanJoint::right_upper_arm)), 0.02)
                << size_text(size);
        }
        const Camera upper = frame_figure(figure, {.framing = Framing::upper}, size);
        EXPECT_GT(inside(upper, size, rest_place(avatar, HumanJoint::hips)), 0.05) << size_text(size);
    }
}

// A figure of games: every vertex of its head, turned to either side, is in each view.
TEST(FrameFigure, HoldsALargeHead) {
    const Avatar avatar = read_avatar(testing::test_file("made/large_head.glb"));
    const FigureMeasures figure = measure_figure(avatar);
    const FigureMeasures person =
        measure_figure(read_avatar(testing::test_file("assets/avatars/neutral.glb")));
    EXPECT_GT(figure.head_side, 2 * person.head_side);
    EXPECT_GT(figure.top, person.top + 0.2f);
    for (const RenderSize size : kSizes) {
        for (const Framing framing : {Framing::upper, Framing::full, Framing::head}) {
            const Camera camera = frame_figure(figure, {.framing = framing, .pitch = 0.14f}, size);
            for (const PosedSurface& surface : rest_mesh(avatar).surfaces) {
                for (const Vec3& point : surface.positions) {
                    if (point.y < figure.shoulders + 0.1f) continue;
                    ASSERT_GT(inside(camera, size, point), 0) << size_text(size) << " " << point.y;
                }
            }
        }
    }
}

// The heads of people change nothing: they lie in the room of the body.
TEST(FrameFigure, LeavesViewsOfPeopleAsTheyAre) {
    for (const char* name : {"neutral", "male", "female", "mannequin"}) {
        const Avatar avatar = read_avatar(testing::test_file(format("assets/avatars/{}.glb", name)));
        const FigureMeasures figure = measure_figure(avatar);
        FigureMeasures headless = figure;
        headless.head_side = headless.head_front = 0;
        for (const Framing framing : {Framing::upper, Framing::full, Framing::head})
            EXPECT_EQ(room_of(figure, framing), room_of(headless, framing)) << name;
    }
}

INSTANTIATE_TEST_SUITE_P(
    All, FrameRealFigure,
    ::testing::ValuesIn(testing::present({"assets/avatars/mannequin.glb", "assets/avatars/female.glb",
                                          "made/numbered.glb", "made/makehuman.glb", "made/mixamo.glb",
                                          "made/vrm.vrm", "../shared/data/avatars/tests/CesiumMan.glb",
                                          "../shared/data/avatars/tests/mh_neutral_arkit52.glb",
                                          "../shared/data/avatars/tests/mh_male_mixamo_arkit52.glb",
                                          "../shared/data/avatars/tests/mh_neutral_vrm1.vrm"})));

}  // namespace
}  // namespace chironomia
