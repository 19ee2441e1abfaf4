// The volume of a body: capsules in each other, and those of the bundled people against their surfaces.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <set>

#include "core/body/rest.h"
#include "core/quantile.h"
#include "skinning/body/posture_rest.h"
#include "skinning/gltf/gltf.h"
#include "skinning/shape/contacts.h"
#include "skinning/shape/measure_shape.h"
#include "tests/skinning/fit/figure.h"
#include "tests/support/support.h"

namespace chironomia {
namespace {

using testing::source_dir;

TEST(Capsules, OfCrossingLinesAreAsDeepAsBothRadiiLessTheGap) {
    const Overlap overlap =
        overlap_of({{-1, 0, 0.1f}, {1, 0, 0.1f}, 0.05f}, {{0.2f, -1, 0}, {0.2f, 1, 0}, 0.12f});
    EXPECT_NEAR(overlap.depth, 0.07, 1e-6);
    EXPECT_LT(distance(overlap.away, Vec3(0, 0, 1)), 1e-5f);
    EXPECT_NEAR(overlap.along, 0.6, 1e-6);
}

TEST(Capsules, EndAtTheirEnds) {
    const Capsule ball{{0, 0, 0}, {0, 0, 0}, 0.1f};
    EXPECT_NEAR(overlap_of({{1, 0, 0}, {2, 0, 0}, 0.1f}, ball).depth, -0.8, 1e-6);
    EXPECT_NEAR(overlap_of(ball, {{1, 0, 0}, {2, 0, 0}, 0.1f}).depth, -0.8, 1e-6);
    EXPECT_LT(overlap_of(ball, {{1, 0, 0}, {2, 0, 0}, 0.1f}).away.x, -0.999f);
}

TEST(Capsules, OfParallelAndEqualLinesAreMeasuredToo) {
    const Capsule line{{0, 0, 0}, {0, 1, 0}, 0.1f};
    EXPECT_NEAR(overlap_of({{0.15f, 0.2f, 0}, {0.15f, 3, 0}, 0.1f}, line).depth, 0.05, 1e-6);
    EXPECT_NEAR(overlap_of(line, line).depth, 0.2, 1e-6);
    EXPECT_NEAR(length(overlap_of(line, line).away), 1, 1e-6);
}

struct Person {
    explicit Person(const std::string& name)
        : avatar(read_avatar(source_dir() / "assets/avatars" / (name + ".glb"))),
          rig(posture_rig(avatar.skeleton, avatar.humanoid)),
          shape(measure_shape(avatar, rig)) {}

    float depth_of(const Vec3& point, ShapePart part) const {
        float deepest = -1;
        for (const ShapeCapsule& capsule : shape.capsules) {
            if (capsule.part != part) continue;
            const Capsule at_rest = placed(capsule, {rig.rest.turns, rig.rest.places});
            deepest = std::max(deepest, overlap_of({point, point, 0}, at_rest).depth);
        }
        return deepest;
    }

    Avatar avatar;
    PostureRig rig;
    BodyShape shape;
};

// Points of the front of the shirt, from the hips to below the shoulders, without what the arms move.
std::vector<float> depths_of_shirt(const Person& person) {
    const PosedMesh mesh = rest_mesh(person.avatar);
    const auto at = [&](HumanJoint part) {
        return person.rig.rest.places[static_cast<size_t>(person.rig.parts[part])];
    };
    const float low = at(HumanJoint::left_upper_leg).y, high = at(HumanJoint::left_upper_arm).y - 0.06f;
    std::vector<float> depths;
    for (size_t s = 0; s < mesh.surfaces.size(); ++s) {
        if (person.avatar.surfaces[s].name != "shirt") continue;
        for (const Vec3& point : mesh.surfaces[s].positions) {
            if (point.y > low && point.y < high && std::abs(point.x) < 0.1f)
                depths.push_back(person.depth_of(point, ShapePart::trunk));
        }
    }
    return depths;
}

TEST(MeasuredShape, LiesAlongTheShirtsOfTheBundledPeople) {
    for (const char* name : {"neutral", "female", "male"}) {
        const std::vector<float> depths = depths_of_shirt(Person(name));
        ASSERT_GT(depths.size(), 100u) << name;
        EXPECT_NEAR(median(depths), 0, 0.005) << name;
        EXPECT_GT(quantile(depths, 0.02), -0.02) << name;
        EXPECT_LT(quantile(depths, 0.98), 0.024) << name;
    }
}

// Few points of a skin lie on the crown.
TEST(MeasuredShape, ReachesToTheCrown) {
    for (const char* name : {"neutral", "female2", "male"}) {
        const Person person(name);
        const PosedMesh mesh = rest_mesh(person.avatar);
        float skin = 0, shape = 0;
        for (size_t s = 0; s < mesh.surfaces.size(); ++s) {
            if (person.avatar.surfaces[s].name != "skin") continue;
            for (const Vec3& point : mesh.surfaces[s].positions) skin = std::max(skin, point.y);
        }
        for (const ShapeCapsule& capsule : person.shape.capsules) {
            const Capsule place = placed(capsule, {person.rig.rest.turns, person.rig.rest.places});
            shape = std::max(shape, std::max(place.from.y, place.to.y) + place.radius);
        }
        EXPECT_NEAR(shape, skin, 0.005f) << name;
    }
}

TEST(MeasuredShape, HasAllPartsOnBothSides) {
    for (const char* name : {"neutral", "female", "male", "mannequin"}) {
        std::set<ShapePart> parts;
        for (const ShapeCapsule& capsule : Person(name).shape.capsules) {
            parts.insert(capsule.part);
            EXPECT_GT(capsule.place.radius, 0.005f) << name << ", " << name_of(capsule.part);
            EXPECT_LT(capsule.place.radius, 0.15f) << name << ", " << name_of(capsule.part);
        }
        EXPECT_EQ(parts.size(), 13u) << name;
    }
}

// Between hips and chest, where hands are.
TEST(MeasuredShape, OfTheNeutralAvatarIsThatOfAnAdultWithoutAvatar) {
    const Person person("neutral");
    const auto at = [&](HumanJoint part) {
        return person.rig.rest.places[static_cast<size_t>(person.rig.parts[part])];
    };
    const Vec3 left = at(HumanJoint::left_upper_arm),
               middle = 0.5f * (left + at(HumanJoint::right_upper_arm));
    const float width = 2 * (left.x - middle.x);
    int slices = 0;
    for (const ShapeCapsule& capsule : person.shape.capsules) {
        const Capsule place = placed(capsule, {person.rig.rest.turns, person.rig.rest.places});
        if (capsule.part != ShapePart::trunk || place.from.y < at(HumanJoint::spine).y - 0.04f ||
            place.from.y > middle.y - 0.08f)
            continue;
        ++slices;
        EXPECT_NEAR((place.from.z + place.radius - middle.z) / width, AdultTrunk::kFront, 0.04)
            << place.from.y;
        EXPECT_NEAR((std::abs(place.to.x) + place.radius) / width, AdultTrunk::kHalfWidth, 0.06)
            << place.from.y;
    }
    EXPECT_GE(slices, 6);
}

// A hand at the chin may be in hair that hangs there.
TEST(MeasuredShape, IsThatOfThePersonWithoutHair) {
    for (const char* name : {"female", "female2"}) {
        const Person worn(name);
        Avatar cut = worn.avatar;
        ASSERT_GT(std::erase_if(cut.surfaces, [](const Surface& surface) { return surface.name == "hair"; }),
                  0u);
        const std::vector<ShapeCapsule> bald = measure_shape(cut, worn.rig).capsules;
        ASSERT_EQ(bald.size(), worn.shape.capsules.size());
        for (size_t i = 0; i < bald.size(); ++i)
            EXPECT_EQ(bald[i].place.radius, worn.shape.capsules[i].place.radius) << name;
    }
}

TEST(MeasuredShape, IsNothingWithoutASurface) {
    const Avatar bare = testing::avatar_of(testing::make_figure({}));
    EXPECT_TRUE(measure_shape(bare, posture_rig(bare.skeleton, bare.humanoid)).capsules.empty());
}

// The arms straight to the sides, then turned about the shoulders.
std::vector<Contact> contacts_with(const Person& person, const Quat& left_upper, const Quat& left_lower) {
    Posture posture;
    for (const HumanJoint part :
         {HumanJoint::right_upper_arm, HumanJoint::right_lower_arm, HumanJoint::right_hand})
        posture[part] = kNoTurn;
    posture[HumanJoint::left_upper_arm] = left_upper;
    posture[HumanJoint::left_lower_arm] = left_lower;
    posture[HumanJoint::left_hand] = left_lower;
    const PosedSkeleton posed = pose_skeleton(person.rig, posture, {});
    return contacts_of(person.shape, {posed.turns, posed.places}, 0.02f);
}

TEST(Contacts, AreNoneOfArmsAtTheSides) {
    EXPECT_TRUE(contacts_with(Person("neutral"), kNoTurn, kNoTurn).empty());
}

TEST(Contacts, FindAForearmAndAHandInTheTrunk) {
    // The upper arm hangs, and the forearm points straight to the other side.
    const Quat hangs = glm::angleAxis(-0.5f * kPi, Vec3(0, 0, 1)),
               across = glm::angleAxis(-kPi, Vec3(0, 1, 0));
    std::set<ShapePart> parts;
    for (const Contact& contact : contacts_with(Person("neutral"), hangs, across)) {
        EXPECT_EQ(contact.in, ShapePart::trunk);
        EXPECT_GT(contact.overlap.depth, 0.06f);
        parts.insert(contact.part);
    }
    EXPECT_EQ(parts, (std::set<ShapePart>{ShapePart::left_forearm, ShapePart::left_hand}));
}

}  // namespace
}  // namespace chironomia
