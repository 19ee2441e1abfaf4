#include "synth/corpus/make/pose.h"

#include <algorithm>
#include <array>
#include <cassert>

#include "core/body/humanoid.h"
#include "synth/body/agent_body.h"
#include "synth/corpus/face_points.h"
#include "synth/corpus/records.h"

namespace chironomia {
namespace {

constexpr std::size_t kJoints = IntervalRecord::kJoints;
// Of the joints of PATS.
constexpr std::size_t kNeck = 0, kRightShoulder = 1, kLeftShoulder = 4, kNose = 7, kRightEye = 8,
                      kLeftEye = 9;

struct PatsJoint {
    std::size_t joint;
    HumanJoint part;
};
constexpr PatsJoint kArms[] = {{1, HumanJoint::right_upper_arm}, {2, HumanJoint::right_lower_arm},
                               {3, HumanJoint::right_hand},      {4, HumanJoint::left_upper_arm},
                               {5, HumanJoint::left_lower_arm},  {6, HumanJoint::left_hand}};

struct PatsHand {
    std::size_t root;  // the fingers of PATS follow it
    HumanJoint hand;
    // The first joint of each finger; the others follow it in HumanJoint, and the tip comes last.
    std::array<HumanJoint, 5> fingers;
};
constexpr PatsHand kHands[] = {
    {10,
     HumanJoint::left_hand,
     {HumanJoint::left_thumb_1, HumanJoint::left_index_1, HumanJoint::left_middle_1, HumanJoint::left_ring_1,
      HumanJoint::left_little_1}},
    {31,
     HumanJoint::right_hand,
     {HumanJoint::right_thumb_1, HumanJoint::right_index_1, HumanJoint::right_middle_1,
      HumanJoint::right_ring_1, HumanJoint::right_little_1}}};

// One frame in the world [m].
struct Body {
    std::array<Vec3, kJoints> joints;
    FacePoints face;
};

void place_hand(Body& body, const std::vector<Mat4>& world, const PatsHand& of) {
    constexpr float kTip = 0.8f;  // of the last bone but one
    const auto& [root, hand, fingers] = of;
    body.joints[root] = origin(world[joint_of(hand)]);
    for (std::size_t f = 0; f < fingers.size(); ++f) {
        const std::size_t first = joint_of(fingers[f]);
        for (std::size_t i = 0; i < 3; ++i) body.joints[root + 1 + 4 * f + i] = origin(world[first + i]);
        const Vec3 bone = agent_skeleton().joints[first + 2].rest.translation;
        body.joints[root + 4 + 4 * f] = Vec3(world[first + 2] * Vec4(kTip * bone, 1));
    }
}

Body body_at(const Motion& motion, std::size_t frame) {
    const Skeleton& skeleton = motion.joints->skeleton;
    const std::vector<Mat4> world = world_from_joints(*motion.joints, frame);
    Body body;
    for (const PatsJoint& arm : kArms) body.joints[arm.joint] = origin(world[joint_of(arm.part)]);
    body.joints[kNeck] = 0.5f * (body.joints[kRightShoulder] + body.joints[kLeftShoulder]);
    for (const PatsHand& hand : kHands) place_hand(body, world, hand);
    const Vec3 eyes = 0.5f * (skeleton.joints[joint_of(HumanJoint::left_eye)].rest.translation +
                              skeleton.joints[joint_of(HumanJoint::right_eye)].rest.translation);
    body.face = place_face_points(*motion.face, frame);
    for (Vec3& point : body.face) point = Vec3(world[joint_of(HumanJoint::head)] * Vec4(eyes + point, 1));
    body.joints[kNose] = body.face[kNoseTip];
    body.joints[kRightEye] = body.face[kRightPupil];
    body.joints[kLeftEye] = body.face[kLeftPupil];
    return body;
}

// What finds points in pictures.
struct Detector {
    bool noise;
    Random random;

    // Appends what is found of one frame's points; the first `sure` of them are never lost.
    void find(const std::vector<Vec2>& points, std::size_t sure, PicturePoints& seen);
};

void Detector::find(const std::vector<Vec2>& points, std::size_t sure, PicturePoints& seen) {
    constexpr double kLost = 0.01, kDeviation = 0.4;
    const std::size_t count = points.size(), first = seen.places.size();
    seen.places.resize(first + 2 * count);
    seen.confidence.resize(first + 2 * count);
    for (std::size_t i = 0; i < count; ++i) {
        const Vec2 error =
            Vec2(random.normal(), random.normal()) * static_cast<float>(noise ? kDeviation : 0);
        const double doubt = 0.35 * random.uniform();
        const bool is_lost = noise && i >= sure && random.uniform() < kLost;
        // The neck is where all others are measured from.
        const Vec2 place = is_lost || i < sure ? Vec2(0) : points[i] + error;
        const double confidence = is_lost ? 0 : noise ? 1 - doubt : 1;
        seen.places[first + i] = place.x;
        seen.places[first + count + i] = place.y;
        seen.confidence[first + i] = seen.confidence[first + count + i] = static_cast<float>(confidence);
    }
}

}  // namespace

PicturedPerson picture_person(const Motion& motion, const FarCamera& camera, bool noise, Random random) {
    PicturedPerson person;
    Detector detector{.noise = noise, .random = random};
    for (std::size_t t = 0; t < motion.frames; ++t) {
        const Body body = body_at(motion, t);
        const auto seen = [&](const auto& places) {
            std::vector<Vec2> points;
            for (const Vec3& place : places) points.push_back(seen_from(camera, place, body.joints[kNeck]));
            return points;
        };
        detector.find(seen(body.joints), 1, person.pose);
        detector.find(seen(body.face), 0, person.face);
    }
    const auto width = shoulder_width(person.pose);
    assert(width);  // shoulders are lost in one frame of a hundred
    for (PicturePoints* points : {&person.pose, &person.face})
        points->normalized = with_equal_shoulders(points->places, *width);
    return person;
}

}  // namespace chironomia
