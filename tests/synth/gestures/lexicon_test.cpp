#include "synth/gestures/lexicon.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <filesystem>
#include <functional>
#include <map>
#include <set>
#include <string>
#include <vector>

#include "core/files/files.h"
#include "core/files/json.h"
#include "core/text.h"
#include "synth/gestures/hand_shape.h"
#include "synth/gestures/sectors.h"
#include "tests/support/support.h"

namespace chironomia {
namespace {

namespace fs = std::filesystem;
using ::testing::ElementsAre;
using ::testing::EndsWith;

// The smallest lexicon that says something: an offer in two poses.
Json small_lexicon() {
    return Json::parse(R"({
        "shapes": {"relax": {"fingers": {"flexion": [20, 20, 10]}}, "open": {"thumb": {"spread": -10}}},
        "gestures": [{
            "id": "offer", "category": "metaphoric", "hands": "either", "functions": ["rheme"], "note": "Offers.",
            "poses": [
                {"phase": "preparation",
                 "arm": {"wrist": {"x": "XC", "y": "YLowerC", "z": "ZMiddle"}, "palm": "in", "fingers": "front",
                         "shape": "relax"}},
                {"phase": "stroke", "arm": {"wrist": {"y": "chest"}, "palm": ["up", "in"], "shape": "open"}}]}]})");
}

class ReadLexicon : public ::testing::Test {
  protected:
    fs::path write(const std::string& name, const Json& json) const {
        write_json(folder / name, json);
        return folder / name;
    }
    Lexicon read(const Json& json) const {
        const std::vector<fs::path> files = {write("own.json", json)};
        return read_lexicon(files);
    }
    Gesture offer(const Json& json) const { return read(json).gestures.at(0); }
    // What the reader says of the small lexicon after a change, without the folder.
    std::string refusal(const std::function<void(Json&)>& change) const {
        Json json = small_lexicon();
        change(json);
        const std::string said = testing::refusal_of([&] { read(json); });
        return said.substr(std::min(said.size(), folder.path().string().size() + 1));
    }

    testing::TemporaryFolder folder;
};

Json& gesture_in(Json& json) {
    return json["gestures"][0];
}
Json& pose_in(Json& json, std::size_t n) {
    return gesture_in(json)["poses"][n];
}
Json& arm_in(Json& json, std::size_t n) {
    return pose_in(json, n)["arm"];
}

TEST_F(ReadLexicon, ReadsWhatAGestureIs) {
    const Lexicon lexicon = read(small_lexicon());
    ASSERT_EQ(lexicon.gestures.size(), 1u);
    EXPECT_THAT(lexicon.sources, ElementsAre(EndsWith("own.json")));
    EXPECT_EQ(find_shape(lexicon, "relax"), 0u);
    EXPECT_EQ(find_shape(lexicon, "fist"), std::nullopt);
    EXPECT_EQ(find_gesture(lexicon, "offer"), 0u);
    const Gesture& gesture = lexicon.gestures[0];
    EXPECT_EQ(gesture.category, GestureCategory::metaphoric);
    EXPECT_EQ(gesture.hands, GestureHands::either);
    EXPECT_THAT(gesture.functions, ElementsAre("rheme"));
    EXPECT_TRUE(gesture.repeats);
    ASSERT_EQ(gesture.poses.size(), 2u);
    const KeyPose &start = gesture.poses[0], &end = gesture.poses[1];
    EXPECT_EQ(start.phase, GesturePhase::preparation);
    EXPECT_EQ(start.right->wrist, Vec3(0.25f, 0, 0.65f));
    EXPECT_EQ(start.right->palm, Vec3(-1, 0, 0));
    EXPECT_FALSE(start.left);
    EXPECT_EQ(start.path.shape, WristShape::line);
    EXPECT_EQ(end.phase, GesturePhase::stroke);
    EXPECT_EQ(end.right->shape, 1u);
}

TEST_F(ReadLexicon, TakesWhatAPoseLeavesOutFromTheOneBefore) {
    const ArmPose end = *offer(small_lexicon()).poses[1].right;
    EXPECT_EQ(end.wrist, Vec3(0.25f, 0.25f, 0.65f));
    EXPECT_EQ(end.fingers, Vec3(0, 0, 1));

    Json json = small_lexicon();
    arm_in(json, 0)["swivel"] = 0.7;
    EXPECT_EQ(offer(json).poses[1].right->swivel, usual_swivel({0.25f, 0.25f, 0.65f})) << "the wrist moved";
    arm_in(json, 1).erase("wrist");
    EXPECT_FLOAT_EQ(offer(json).poses[1].right->swivel, 0.7f);
}

TEST_F(ReadLexicon, KnowsWhatAHandRestsOn) {
    Json json = small_lexicon();
    arm_in(json, 1)["touches"] = "upper arm";
    gesture_in(json)["poses"].push_back({{"phase", "post-stroke-hold"}});
    const Gesture gesture = offer(json);
    EXPECT_EQ(gesture.poses[0].right->touches, Touch::nothing);
    EXPECT_EQ(gesture.poses[1].right->touches, Touch::upper_arm);
    EXPECT_EQ(gesture.poses[2].right->touches, Touch::upper_arm) << "as in the pose before";
}

TEST_F(ReadLexicon, BlendsSectorsAndDirections) {
    Json json = small_lexicon();
    Json& arm = arm_in(json, 1);
    arm["wrist"] = {{"x", {"centre", "XP"}}, {"y", {{"chest", 1}, {"shoulder", 3}}}, {"z", {0.4, "ZMiddle"}}};
    arm["palm"] = {{"up", 3}, {"in", 4}};
    const ArmPose end = *offer(json).poses[1].right;
    EXPECT_LT(distance(end.wrist, Vec3(0.375f, 0.5125f, 0.525f)), 1e-6f);
    EXPECT_LT(distance(end.palm, Vec3(-0.8f, 0.6f, 0)), 1e-6f);
}

TEST_F(ReadLexicon, MakesFingersSquareToThePalm) {
    Json json = small_lexicon();
    arm_in(json, 0)["fingers"] = {"front", "in"};
    EXPECT_LT(distance(offer(json).poses[0].right->fingers, Vec3(0, 0, 1)), 1e-6f);
}

TEST_F(ReadLexicon, KnowsEverySectorByNameAndByWord) {
    for (const int axis : {0, 1, 2}) {
        const std::string key(1, "xyz"[axis]);
        float before = -1;
        for (const SectorName& sector : sectors_along(axis)) {
            EXPECT_GT(sector.place, before) << sector.name;
            before = sector.place;
            // Mixed with the centre, so that arms reach it.
            const Vec3 centre(0.25f, 0.25f, 0.65f);
            for (const std::string_view name : {sector.name, sector.word}) {
                Json json = small_lexicon();
                arm_in(json, 0)["wrist"] = {{"x", 0.25}, {"y", 0.25}, {"z", 0.65}};
                arm_in(json, 0)["wrist"][key] = {{std::string(name), 0.1},
                                                 {key == "x"   ? "XC"
                                                  : key == "y" ? "YCC"
                                                               : "ZMiddle",
                                                  0.9}};
                if (sector.place == centre[axis]) arm_in(json, 0)["wrist"][key] = name;
                const float expected =
                    sector.place == centre[axis] ? centre[axis] : 0.1f * sector.place + 0.9f * centre[axis];
                EXPECT_NEAR(offer(json).poses[0].right->wrist[axis], expected, 1e-6f) << name;
            }
        }
    }
}

TEST(UsualSwivel, GrowsOutwardAndUpward) {
    EXPECT_FLOAT_EQ(usual_swivel({0.25f, 0.25f, 0.6f}), 0.35f);
    EXPECT_FLOAT_EQ(usual_swivel({0.25f, 0.6f, 0.6f}), 0.9f);
    EXPECT_FLOAT_EQ(usual_swivel({0.25f, 1.2f, 0.2f}), 0.9f);
    EXPECT_FLOAT_EQ(usual_swivel({0.8f, 0, 0.6f}), 0.9f);
    EXPECT_NEAR(usual_swivel({0.5875f, 0, 0.6f}), 0.625f, 1e-5f);
}

TEST_F(ReadLexicon, KnowsTheFunctionsOfMarksAndOnesOwn) {
    Json json = small_lexicon();
    gesture_in(json)["functions"] = {"rheme",          "emotion=joy", "backchannel=interest",
                                     "world=x-spiral", "world=shape", "deictic"};
    EXPECT_EQ(offer(json).functions.size(), 6u);
    for (const char* other : {"boundary=LL", "emphasis=x-huge", "world=x-", "rheme=new"})
        EXPECT_NE(refusal([&](Json& j) { gesture_in(j)["functions"] = {other}; }), "") << other;
}

TEST_F(ReadLexicon, FixesWhatMeansSomethingInItsCategory) {
    const auto fixed_of = [&](const char* category) {
        Json json = small_lexicon();
        gesture_in(json)["category"] = category;
        return offer(json).poses[1].right->fixed;
    };
    for (const char* free : {"beat", "metaphoric"}) {
        const FixedFeatures fixed = fixed_of(free);
        EXPECT_FALSE(fixed.palm || fixed.shape || fixed.wrist_x || fixed.swivel) << free;
    }
    for (const char* shown : {"iconic", "deictic"}) {
        const FixedFeatures fixed = fixed_of(shown);
        EXPECT_TRUE(fixed.palm && fixed.shape && !fixed.wrist_x && !fixed.swivel) << shown;
    }
    for (const char* exact : {"emblem", "adaptor"}) {
        const FixedFeatures fixed = fixed_of(exact);
        EXPECT_TRUE(fixed.palm && fixed.shape && fixed.wrist_x && fixed.wrist_y && fixed.wrist_z) << exact;
    }
    Json json = small_lexicon();
    gesture_in(json)["fixed"] = {"wrist_y", "swivel"};
    arm_in(json, 1)["fixed"] = {"wrist"};
    const Gesture own = offer(json);
    EXPECT_TRUE(own.poses[0].right->fixed.wrist_y && own.poses[0].right->fixed.swivel);
    EXPECT_FALSE(own.poses[0].right->fixed.wrist_x || own.poses[0].right->fixed.palm);
    EXPECT_TRUE(own.poses[1].right->fixed.wrist_x && own.poses[1].right->fixed.wrist_z);
    EXPECT_FALSE(own.poses[1].right->fixed.swivel);
}

TEST_F(ReadLexicon, ReadsPathsSpeedsAndBothHands) {
    Json json = small_lexicon();
    gesture_in(json)["hands"] = "both";
    gesture_in(json)["repeats"] = false;
    pose_in(json, 1)["speed"] = "fast";
    pose_in(json, 1)["path"] = {{"shape", "circle"}, {"radius", 0.12}, {"turns", 1.5}, {"axis", "up"}};
    pose_in(json, 1)["right"] = pose_in(json, 1)["arm"];
    pose_in(json, 1).erase("arm");
    const Gesture gesture = offer(json);
    EXPECT_FALSE(gesture.repeats);
    EXPECT_EQ(gesture.poses[1].speed, Speed::fast);
    EXPECT_EQ(gesture.poses[1].path.shape, WristShape::circle);
    EXPECT_FLOAT_EQ(gesture.poses[1].path.radius, 0.12f);
    EXPECT_FLOAT_EQ(gesture.poses[1].path.turns, 1.5f);
    EXPECT_EQ(gesture.poses[1].path.axis, Vec3(0, 1, 0));
    EXPECT_EQ(gesture.poses[0].left->wrist, gesture.poses[0].right->wrist);
    EXPECT_EQ(gesture.poses[1].left->wrist.y, 0) << "the left hand stays";
    EXPECT_EQ(gesture.poses[1].right->wrist.y, 0.25f);
    pose_in(json, 1)["path"] = {{"shape", "line"}};
    EXPECT_EQ(offer(json).poses[1].path.shape, WristShape::line);
}

TEST_F(ReadLexicon, TakesSeveralFilesAndReplacesOnlyWhereAsked) {
    Json other = small_lexicon();
    other["shapes"] = {{"open", {{"replaces", true}, {"fingers", {{"flexion", {50, 0, 0}}}}}},
                       {"flat", {{"like", "open"}, {"index", {{"spread", 5}}}}}};
    gesture_in(other)["replaces"] = true;
    gesture_in(other)["note"] = "Ours.";
    const std::vector<fs::path> files = {write("a.json", small_lexicon()), write("b.json", other)};
    const Lexicon lexicon = read_lexicon(files);
    ASSERT_EQ(lexicon.gestures.size(), 1u);
    EXPECT_EQ(lexicon.gestures[0].note, "Ours.");
    EXPECT_EQ(lexicon.sources.size(), 2u);
    ASSERT_EQ(lexicon.shapes.size(), 3u);
    const HandBends fifty{.fingers = {{{{50, 0, 0}}, {{50, 0, 0}}, {{50, 0, 0}}, {{50, 0, 0}}}}};
    EXPECT_EQ(lexicon.shapes[1].turns, turns_of(fifty));
    EXPECT_GT(angle_between(lexicon.shapes[2].turns[3], lexicon.shapes[1].turns[3]), 0.05f);

    gesture_in(other).erase("replaces");
    write("b.json", other);
    EXPECT_THAT(
        testing::refusal_of([&] { read_lexicon(files); }),
        EndsWith(
            "b.json: gesture \"offer\": an earlier file has the id \"offer\" already; choose another, or "
            "add \"replaces\": true to take its place"));
}

struct Refusal {
    std::function<void(Json&)> change;
    const char* says;  // after the file's folder
};

TEST_F(ReadLexicon, RefusesGesturesThatItDoesNotUnderstand) {
    const std::vector<Refusal> refusals = {
        {[](Json& j) { j["gesture"] = 1; },
         "own.json: gesture: there is no such key; did you mean \"gestures\"?"},
        {[](Json& j) { gesture_in(j).erase("category"); },
         "own.json: gesture \"offer\".category: is missing; add it"},
        {[](Json& j) { gesture_in(j)["category"] = "beet"; },
         "own.json: gesture \"offer\".category: is \"beet\", which is none of \"adaptor\", \"beat\", \"deictic\", "
         "\"emblem\", \"iconic\", \"metaphoric\"; did you mean \"beat\"?"},
        {[](Json& j) { gesture_in(j)["id"] = "My gesture"; },
         "own.json: gestures[0].id: is \"My gesture\"; an id has small letters a to z, digits and _ only, such as "
         "\"open_offer\""},
        {[](Json& j) { gesture_in(j)["repeats"] = "yes"; },
         "own.json: gesture \"offer\".repeats: is \"yes\", true or false is needed"},
        {[](Json& j) { gesture_in(j)["replaces"] = true; },
         "own.json: gesture \"offer\": replaces \"offer\", which no earlier file has; correct the id or remove "
         "\"replaces\""},
        {[](Json& j) { j["gestures"].push_back(gesture_in(j)); },
         "own.json: gesture \"offer\": there are two of the id \"offer\" in this file; rename one"},
        {[](Json& j) { gesture_in(j)["fixed"] = {"hand"}; },
         "own.json: gesture \"offer\".fixed[0]: is \"hand\", which is none of \"wrist\", \"wrist_x\", \"wrist_y\", "
         "\"wrist_z\", \"palm\", \"shape\", \"swivel\""},
        {[](Json& j) { arm_in(j, 1)["touches"] = "knee"; },
         "own.json: gesture \"offer\".poses[1].arm.touches: is \"knee\", which is none of \"forearm\", \"hand\", \"head\", "
         "\"nothing\", \"trunk\", \"upper arm\""},
        {[](Json& j) { gesture_in(j)["functions"] = {"performative=gret"}; },
         "own.json: gesture \"offer\".functions[0]: is \"performative=gret\", which no text can ask for; did you mean "
         "\"performative=greet\"? write a function that docs/markup.md lists, or a value of your own that begins with "
         "x-, such as \"world=x-spiral\""},
        {[](Json& j) { pose_in(j, 0)["phase"] = "stroke"; },
         "own.json: gesture \"offer\".poses[0].phase: is \"stroke\" in the first pose; a gesture begins with its "
         "preparation"},
        {[](Json& j) {
             gesture_in(j)["poses"].push_back({{"phase", "pre-stroke-hold"}});
         },
         "own.json: gesture \"offer\".poses[2].phase: is \"pre-stroke-hold\" after \"stroke\"; put the phases in the "
         "order preparation, pre-stroke-hold, stroke, post-stroke-hold"},
        {[](Json& j) { pose_in(j, 1)["phase"] = "preparation"; },
         "own.json: gesture \"offer\".poses: has no pose of phase \"stroke\"; add the one in which the meaning is "
         "shown"},
    };
    for (const Refusal& refusal_expected : refusals)
        EXPECT_EQ(refusal(refusal_expected.change), refusal_expected.says);
}

TEST_F(ReadLexicon, RefusesPosesThatNoArmTakes) {
    const std::vector<Refusal> refusals = {
        {[](Json& j) {
             arm_in(j, 1)["palm"] = {"up", "down"};
         },
         "own.json: gesture \"offer\".poses[1].arm.palm: is [\"up\",\"down\"], which points nowhere; leave out "
         "opposites"},
        {[](Json& j) { arm_in(j, 1)["palm"] = Json::object(); },
         "own.json: gesture \"offer\".poses[1].arm.palm: is empty; name something in it"},
        {[](Json& j) {
             arm_in(j, 1)["palm"] = {{"up", 0}};
         },
         "own.json: gesture \"offer\".poses[1].arm.palm.up: is 0, a number from 0.01 to 100 is needed"},
        {[](Json& j) { arm_in(j, 1)["palm"] = "left"; },
         "own.json: gesture \"offer\".poses[1].arm.palm: is \"left\", which is none of \"up\", \"down\", \"in\", "
         "\"out\", \"front\", \"back\""},
        {[](Json& j) {
             arm_in(j, 1)["fingers"] = {"up", "in"};
         },
         "own.json: gesture \"offer\".poses[1].arm: has its fingers pointing where its palm faces, or the opposite "
         "way; let them point across, such as palm \"up\" and fingers \"front\""},
        {[](Json& j) { arm_in(j, 0)["wrist"].erase("z"); },
         "own.json: gesture \"offer\".poses[0].arm.wrist.z: is missing; add it"},
        {[](Json& j) { arm_in(j, 1)["wrist"]["y"] = 2; },
         "own.json: gesture \"offer\".poses[1].arm.wrist.y: is 2, a number from -0.6 to 1.6 is needed"},
        {[](Json& j) { arm_in(j, 1)["shape"] = "opem"; },
         "own.json: gesture \"offer\".poses[1].arm.shape: is \"opem\", which is none of \"relax\", \"open\"; did you "
         "mean \"open\"?"},
        {[](Json& j) {
             arm_in(j, 1)["wrist"] = {{"y", 1.3}, {"z", "ZFar"}};
         },
         "own.json: gesture \"offer\".poses[1].arm: has its wrist at x 0.25, y 1.30, z 0.95, where no arm reaches; "
         "bring it nearer to the shoulder at x 0.33, y 0.51, z 0, or further off if it is at the shoulder"},
        {[](Json& j) { arm_in(j, 1)["palm"] = "out"; },
         "own.json: gesture \"offer\".poses[1].arm: turns the hand 121 degrees further than forearm and wrist go "
         "(twist -45, flexion 21, deviation 24); turn palm or fingers, move the wrist, or give another swivel than "
         "0.35"},
        {[](Json& j) {
             pose_in(j, 1)["path"] = {{"shape", "line"}, {"turns", 2}};
         },
         "own.json: gesture \"offer\".poses[1].path: is a line, which has no radius, turns or axis; remove "
         "them"},
        {[](Json& j) {
             pose_in(j, 1)["path"] = {{"shape", "circle"}};
         },
         "own.json: gesture \"offer\".poses[1].path.radius: is missing; add it"},
        {[](Json& j) { pose_in(j, 1)["right"] = pose_in(j, 1)["arm"]; },
         "own.json: gesture \"offer\".poses[1]: has \"arm\" beside \"right\" or \"left\"; write either"},
        {[](Json& j) {
             pose_in(j, 1)["right"] = pose_in(j, 1)["arm"];
             pose_in(j, 1).erase("arm");
         },
         "own.json: gesture \"offer\".poses[1]: distinguishes right from left in a gesture for either hand; write "
         "\"arm\", or \"hands\": \"both\""},
        {[](Json& j) { pose_in(j, 0).erase("arm"); },
         "own.json: gesture \"offer\".poses[0]: is the first pose and lacks its arm; add \"arm\""},
        {[](Json& j) {
             gesture_in(j)["hands"] = "both";
             pose_in(j, 0)["right"] = pose_in(j, 0)["arm"];
             pose_in(j, 0).erase("arm");
         },
         "own.json: gesture \"offer\".poses[0]: is the first pose and lacks an arm; add \"arm\" for both alike, or "
         "\"right\" and \"left\""},
    };
    for (const Refusal& refusal_expected : refusals)
        EXPECT_EQ(refusal(refusal_expected.change), refusal_expected.says);
}

TEST_F(ReadLexicon, RefusesHandsThatNobodyHas) {
    const std::vector<Refusal> refusals = {
        {[](Json& j) { j["shapes"] = Json::array(); },
         "own.json: shapes: is [], an object of shapes by their ids is needed"},
        {[](Json& j) { j["shapes"].erase("relax"); },
         "own.json: there is no hand shape \"relax\", which hands at rest have; add it, or read the bundled lexicon "
         "first"},
        {[](Json& j) {
             j["shapes"]["open"]["index"] = {{"flexion", {10, 20}}};
         },
         "own.json: shape \"open\".index.flexion: has 2 entries, at least 3 are needed"},
        {[](Json& j) {
             j["shapes"]["open"]["index"] = {{"flexion", {10, 20, 30, 40}}};
         },
         "own.json: shape \"open\".index.flexion: has 4 entries, the flexion of 3 joints is needed, from the palm "
         "outward"},
        {[](Json& j) {
             j["shapes"]["open"]["index"] = {{"flexion", {10, 130, 30}}};
         },
         "own.json: shape \"open\".index.flexion[1]: is 130, a number from -5 to 115 is needed"},
        {[](Json& j) { j["shapes"]["open"]["thumb"]["oppose"] = 80; },
         "own.json: shape \"open\".thumb.oppose: is 80, a number from -60 to 60 is needed"},
        {[](Json& j) { j["shapes"]["open"]["like"] = "opem"; },
         "own.json: shape \"open\".like: is \"opem\", which is none of \"relax\""},
        {[](Json& j) { j["shapes"]["open"]["replaces"] = true; },
         "own.json: shape \"open\": replaces \"open\", which no earlier file has; correct the id or remove "
         "\"replaces\""},
    };
    for (const Refusal& refusal_expected : refusals)
        EXPECT_EQ(refusal(refusal_expected.change), refusal_expected.says);
}

std::set<std::string> as_set(const std::vector<std::string>& names) {
    return {names.begin(), names.end()};
}

const Json& schema() {
    static const Json read = read_json(testing::source_dir() / "synth/gestures/lexicon.schema.json");
    return read;
}

// The published schema and the reader know the same keys, objects and required keys.
TEST(LexiconSchema, HasTheKeysOfTheReader) {
    const Json& shape = schema()["properties"]["shapes"]["additionalProperties"];
    const Json& defs = schema()["$defs"];
    const std::map<std::string, Json> objects = {{"", schema()},
                                                 {"shapes.*", shape},
                                                 {"shapes.*.thumb", shape["properties"]["thumb"]},
                                                 {"shapes.*.index", defs["finger"]},
                                                 {"gestures[]", defs["gesture"]},
                                                 {"gestures[].poses[]", defs["pose"]},
                                                 {"arm", defs["arm"]},
                                                 {"wrist", defs["arm"]["properties"]["wrist"]},
                                                 {"path", defs["pose"]["properties"]["path"]}};
    EXPECT_EQ(lexicon_keys().size(), objects.size());
    for (const LexiconKeys& known : lexicon_keys()) {
        const Json& object = objects.at(known.object);
        std::set<std::string> described;
        for (const auto& [name, value] : object["properties"].items()) described.insert(name);
        EXPECT_EQ(described, as_set(known.keys)) << known.object;
        EXPECT_EQ(as_set(object.value("required", std::vector<std::string>())), as_set(known.required))
            << known.object;
        EXPECT_EQ(object["additionalProperties"], false) << known.object;
    }
}

TEST(LexiconSchema, HasTheRangesOfTheReader) {
    const auto expect_range = [](const Json& number, const BendRange& range) {
        EXPECT_EQ(number["minimum"], range.least);
        EXPECT_EQ(number["maximum"], range.most);
    };
    const Json& thumb =
        schema()["properties"]["shapes"]["additionalProperties"]["properties"]["thumb"]["properties"];
    const Json& finger = schema()["$defs"]["finger"]["properties"];
    for (std::size_t k = 0; k < 3; ++k) {
        expect_range(thumb["flexion"]["prefixItems"][k], kThumbFlexion[k]);
        expect_range(finger["flexion"]["prefixItems"][k], kFingerFlexion[k]);
    }
    expect_range(thumb["spread"], kThumbSpread);
    expect_range(thumb["oppose"], kThumbOppose);
    expect_range(finger["spread"], kFingerSpread);
}

// What the schema says of a word is what the reader says: it takes each, and refuses others with the same
// list.
TEST_F(ReadLexicon, TakesTheWordsOfTheSchema) {
    const Json& defs = schema()["$defs"];
    const auto listed = [](const Json& words) {
        std::vector<std::string> quoted;
        for (const Json& word : words) quoted.push_back(word.dump());
        std::sort(quoted.begin(), quoted.end());
        return join(quoted);
    };
    const auto said = [&](const std::function<void(Json&)>& change) {
        const std::string whole = refusal(change);
        const std::string_view list = std::string_view(whole).substr(whole.find("none of ") + 8);
        std::vector<std::string> words;
        for (const std::string_view word : split(list, ',')) words.emplace_back(trim(word));
        std::sort(words.begin(), words.end());
        return join(words);
    };
    EXPECT_EQ(said([](Json& j) { gesture_in(j)["category"] = "?????"; }),
              listed(defs["gesture"]["properties"]["category"]["enum"]));
    EXPECT_EQ(said([](Json& j) { gesture_in(j)["hands"] = "?????"; }),
              listed(defs["gesture"]["properties"]["hands"]["enum"]));
    EXPECT_EQ(said([](Json& j) { pose_in(j, 0)["phase"] = "?????"; }),
              listed(defs["pose"]["properties"]["phase"]["enum"]));
    EXPECT_EQ(said([](Json& j) { pose_in(j, 0)["speed"] = "?????"; }),
              listed(defs["pose"]["properties"]["speed"]["enum"]));
    EXPECT_EQ(said([](Json& j) { arm_in(j, 0)["palm"] = "?????"; }),
              listed(defs["direction"]["anyOf"][0]["enum"]));
    EXPECT_EQ(said([](Json& j) { gesture_in(j)["fixed"] = {"?????"}; }),
              listed(defs["fixed"]["items"]["enum"]));
}

}  // namespace
}  // namespace chironomia
