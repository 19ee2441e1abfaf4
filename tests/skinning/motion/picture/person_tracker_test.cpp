#include "skinning/motion/picture/person_tracker.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cstdlib>

namespace chironomia {
namespace {

std::vector<PersonPoint> person(float x, float confidence) {
    return {{.place = {x, 0}, .confidence = confidence}, {.place = {x, 100}, .confidence = confidence}};
}

TEST(PersonTracker, BeginsWithTheOneWhoIsSeenMostSurelyAndStaysWithThem) {
    PersonTracker tracker;
    EXPECT_EQ(tracker.choose({}, 2), std::nullopt);
    EXPECT_EQ(tracker.choose({person(0, 0.4f), person(300, 0.9f)}, 2), 1u);
    EXPECT_EQ(tracker.choose({person(290, 0.3f), person(10, 0.9f)}, 2), 0u);
    EXPECT_EQ(tracker.crowded(), 2u);
    EXPECT_EQ(tracker.doubtful(), 0u);
    EXPECT_EQ(tracker.choose({person(280, 0.5f), person(305, 0.5f)}, 2), 0u);
    EXPECT_EQ(tracker.doubtful(), 1u);
}

// One goes to the right, the other to the left; the detector lists them in turn, and in one frame sees nobody.
TEST(PersonTracker, KeepsApartTwoWhoCross) {
    PersonTracker tracker;
    for (int t = 0; t < 100; ++t) {
        const auto right = person(4.0f * float(t), 0.9f), left = person(400 - 4.0f * float(t), 0.8f);
        if (t == 30) {
            EXPECT_EQ(tracker.choose({}, 2), std::nullopt);
        } else if (t % 2 == 0) {
            EXPECT_EQ(tracker.choose({right, left}, 2), 0u) << t;
        } else if (t != 50) {  // where they lie on each other
            EXPECT_EQ(tracker.choose({left, right}, 2), 1u) << t;
        }
    }
    EXPECT_GT(tracker.doubtful(), 0u);
}

// While they cross, the detector sees the other one alone.
TEST(PersonTracker, DoesNotGoOverToWhoHidesThePerson) {
    for (const int hidden : {3, 10, 30}) {
        PersonTracker tracker;
        for (int t = 0; t < 100; ++t) {
            const auto right = person(4.0f * float(t), 0.9f), left = person(400 - 4.0f * float(t), 0.8f);
            if (std::abs(t - 50) > hidden / 2) {
                EXPECT_EQ(tracker.choose({left, right}, 2), 1u) << hidden << " " << t;
            } else if (const auto chosen = tracker.choose({left}, 2);
                       t != 50) {  // where they lie on each other
                EXPECT_EQ(chosen, std::nullopt) << hidden << " " << t;
            }
        }
    }
}

TEST(PersonTracker, StaysWithAPersonWhoIsFoundTwice) {
    PersonTracker tracker;
    for (int t = 0; t < 60; ++t) {
        const auto sure = person(100, 0.9f), again = person(108, 0.5f);
        std::vector<std::vector<PersonPoint>> found = {again};
        if (t % 10 < 5) found.push_back(sure);
        EXPECT_NE(tracker.choose(found, 2), std::nullopt) << t;
    }
}

// A detector finds one person twice, the second time without an arm, and that one a little nearer to where the person
// was.
TEST(PersonTracker, TakesTheSurerOfTwoAtOnePlace) {
    PersonTracker tracker;
    for (int t = 0; t < 20; ++t) {
        auto whole = person(100, 0.8f), part = person(98, 0.4f);
        if (t > 3) whole[0].place.x += 4;
        EXPECT_EQ(tracker.choose({part, whole}, 2), 1u) << t;
    }
    EXPECT_EQ(tracker.notes().size(), 1u);
}

TEST(PersonTracker, SaysWhereThePersonIsSuddenlyElsewhere) {
    PersonTracker tracker;
    for (int t = 0; t < 30; ++t) tracker.choose({person(t < 10 || t >= 20 ? 100 : 500, 0.9f)}, 2);
    EXPECT_THAT(tracker.notes(),
                ::testing::ElementsAre(
                    "the person is suddenly elsewhere in 2 frames (10, 20), as where a film is cut "
                    "or somebody else is seen"));
}

// The camera goes over to somebody else: a new person is taken, because nobody else may be the one.
TEST(PersonTracker, TakesTheOneWhoIsThereAfterACut) {
    PersonTracker tracker;
    for (int t = 0; t < 20; ++t) EXPECT_EQ(tracker.choose({person(100, 0.9f)}, 2), 0u);
    for (int t = 0; t < 20; ++t) EXPECT_EQ(tracker.choose({person(500, 0.9f)}, 2), 0u) << t;
}

// Of a crowd no more are followed than could hide one another; its pairs would fill the memory.
TEST(PersonTracker, PassesOverACrowd) {
    PersonTracker tracker;
    for (int t = 0; t < 3; ++t) {
        std::vector<std::vector<PersonPoint>> crowd(20000, person(500, 0.3f));
        crowd[7] = person(100, 0.9f);
        EXPECT_EQ(tracker.choose(crowd, 2), 7u) << t;
    }
}

TEST(PersonTracker, LooksAtTheFirstPointsAlone) {
    PersonTracker tracker;
    const std::vector<PersonPoint> hands = {{.place = {0, 0}, .confidence = 0.5f},
                                            {.place = {0, 0}, .confidence = 1}};
    EXPECT_EQ(tracker.choose({hands, person(10, 0.9f)}, 1), 1u);
}

}  // namespace
}  // namespace chironomia
