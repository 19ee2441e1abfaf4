#include "synth/presence/dialog_file.h"

#include <gmock/gmock.h>

#include <cmath>

#include "core/files/files.h"
#include "core/files/json.h"
#include "tests/support/support.h"

namespace chironomia {
namespace {

using ::testing::HasSubstr;
using testing::refusal_of;
using testing::TemporaryFolder;

const std::string kPeople = R"("people": [{"speaker": "neutral"}, {"speaker": "jane"}])";
const std::string kTurns = R"("turns": [{"person": 0, "text": "Hello."}])";

TEST(DialogFile, SaysWhoSpeaksWithWhomAndWhatTheySay) {
    const TemporaryFolder folder;
    write_text(folder / "max.json", R"({"habits": {"handedness": -1}, "voice": {"language": "en-gb"}})");
    write_text(folder / "answer.xml", "<aplm><affect type=\"joy\">I am fine.</affect></aplm>");
    write_text(folder / "talk.json", R"({
        "people": [{"speaker": "jane", "language": "de", "partner_deg": 30}, {"speaker": "max.json"}],
        "coupling": {"strength": 0.7, "delay_s": 1.1}, "pause_s": 0.8,
        "turns": [{"person": 0, "text": "How are you?"}, {"person": 1, "file": "answer.xml"},
                  {"person": 0, "ssml": "<speak>So\nam <emphasis>I</emphasis>.</speak>"}]})");
    const DialogScript dialog = read_dialog(folder / "talk.json");
    EXPECT_EQ(dialog.people[0].speaker.name, "jane");
    EXPECT_NEAR(dialog.people[0].partner, M_PI / 6, 1e-6);
    EXPECT_EQ(dialog.people[0].speaker.voice.language, "de");
    EXPECT_EQ(dialog.people[1].speaker.name, "max");
    EXPECT_EQ(dialog.people[1].speaker.handedness, -1);
    EXPECT_EQ(dialog.people[1].partner, 0);
    EXPECT_EQ(dialog.coupling.strength, 0.7);
    EXPECT_EQ(dialog.coupling.delay, 1.1);
    EXPECT_EQ(dialog.pause, 0.8);
    ASSERT_EQ(dialog.turns.size(), 3u);
    EXPECT_EQ(dialog.turns[0].person, 0u);
    EXPECT_EQ(dialog.turns[1].person, 1u);
    EXPECT_EQ(dialog.turns[0].text.words.size(), 3u);
    EXPECT_EQ(dialog.turns[1].text.words[2].text, "fine");
    EXPECT_EQ(dialog.turns[1].text.marks.at(0).value, "joy");
    EXPECT_TRUE(dialog.turns[2].text.is_ssml);
}

TEST(DialogFile, TakesTheUsualForWhatItDoesNotSay) {
    const TemporaryFolder folder;
    write_text(folder / "talk.json", "{" + kPeople + ", " + kTurns + "}");
    const DialogScript dialog = read_dialog(folder / "talk.json");
    EXPECT_EQ(dialog.coupling.strength, Coupling{}.strength);
    EXPECT_EQ(dialog.coupling.delay, Coupling{}.delay);
    EXPECT_EQ(dialog.pause, 0.4);
}

// The refusal of a file with this text, without the file's name in front.
std::string refusal_of_text(const std::string& text) {
    const TemporaryFolder folder;
    const std::string file = (folder / "talk.json").string();
    write_text(file, text);
    const std::string refusal = refusal_of([&] { read_dialog(file); });
    EXPECT_TRUE(refusal.starts_with(file + ": ")) << refusal;
    return refusal.substr(std::min(refusal.size(), file.size() + 2));
}

TEST(DialogFile, RefusesWhatItMustNotHold) {
    const auto with = [](const std::string& people, const std::string& more) {
        return refusal_of_text("{" + people + ", " + more + "}");
    };
    EXPECT_EQ(refusal_of_text("[]"), "is [], an object in curly brackets is needed");
    EXPECT_EQ(refusal_of_text("{" + kTurns + "}"), "people: is missing; add it");
    EXPECT_EQ(refusal_of_text("{" + kPeople + "}"), "turns: is missing; add it");
    EXPECT_EQ(with(kPeople, kTurns + R"(, "pauses": 1)"),
              "pauses: there is no such key; did you mean \"pause_s\"?");
    EXPECT_EQ(with(R"("people": [{"speaker": "neutral"}])", kTurns),
              "people: has 1 entries, at least 2 are needed");
    EXPECT_EQ(with(R"("people": [{}, {}, {}])", kTurns), "people: has 3 entries, 2 are needed");
    EXPECT_EQ(
        with(R"("people": [{"speaker": "jane"}, {"name": "jane"}])", kTurns),
        "people[1].name: there is no such key; write one of \"speaker\", \"language\", \"partner_deg\"");
    EXPECT_THAT(with(R"("people": [{"speaker": "jane", "language": "d e"}, {"speaker": "jane"}])", kTurns),
                HasSubstr("people[0].language: is \"d e\", a language of espeak-ng is needed"));
    EXPECT_EQ(with(R"("people": [{"speaker": "jane", "partner_deg": 90}, {"speaker": "jane"}])", kTurns),
              "people[0].partner_deg: is 90, a number from -45 to 45 is needed");
    EXPECT_EQ(with(kPeople, kTurns + R"(, "coupling": {"strength": 1})"),
              "coupling.strength: is 1, a number from 0 to 0.8 is needed");
    EXPECT_EQ(with(kPeople, kTurns + R"(, "coupling": {"delay_s": 0})"),
              "coupling.delay_s: is 0, a number from 0.3 to 1.2 is needed");
    EXPECT_EQ(with(kPeople, kTurns + R"(, "pause_s": -1)"), "pause_s: is -1, a number from 0 to 5 is needed");
    EXPECT_EQ(with(kPeople, R"("turns": [])"), "turns: has 0 entries, at least 1 are needed");
    EXPECT_EQ(with(kPeople, R"("turns": [{"person": 2, "text": "Hello."}])"),
              "turns[0].person: is 2, a whole number from 0 to 1 is needed");
    EXPECT_EQ(with(kPeople, R"("turns": [{"person": 1}])"),
              "turns[0]: has 0 scripts, 1 is needed; write one of text, aplm, bml, ssml, file");
    EXPECT_EQ(with(kPeople, R"("turns": [{"person": 1, "text": "Hello.", "ssml": "<speak>Hi</speak>"}])"),
              "turns[0]: has 2 scripts, 1 is needed; write one of text, aplm, bml, ssml, file");
    EXPECT_EQ(with(kPeople, R"("turns": [{"person": 1, "aplm": 3}])"),
              "turns[0].aplm: is 3, a text in quotes is needed");
    // The reader of the markup language reports the place of an error in a script.
    EXPECT_THAT(with(kPeople, R"("turns": [{"person": 1, "aplm": "<aplm><rheme>Hello"}])"),
                ::testing::StartsWith("turns[0].aplm:1:"));
}

TEST(DialogFile, RefusesSpeakersAndFilesThatAreNotThere) {
    const TemporaryFolder folder;
    const std::string file = (folder / "talk.json").string();
    write_text(file, R"({"people": [{"speaker": "jon"}, {"speaker": "jane"}], )" + kTurns + "}");
    EXPECT_THAT(refusal_of([&] { read_dialog(file); }),
                HasSubstr(file + ": people[0].speaker: speaker \"jon\": there is no such speaker"));
    write_text(file, R"({"people": [{"speaker": "x.json"}, {"speaker": "jane"}], )" + kTurns + "}");
    EXPECT_EQ(refusal_of([&] { read_dialog(file); }),
              file + ": people[0].speaker: " + (folder / "x.json").string() +
                  ": there is no such file; check the path");
    write_text(file, "{" + kPeople + R"(, "turns": [{"person": 0, "file": "y.xml"}]})");
    EXPECT_EQ(refusal_of([&] { read_dialog(file); }),
              (folder / "y.xml").string() + ": there is no such file; check the path");
}

// The published schema has the keys and limits that the reader has.
TEST(DialogSchema, SaysWhatTheReaderTakes) {
    const Json schema = read_json(testing::source_dir() / "synth/presence/dialog.schema.json");
    const Json whole = {{"people", {{{"speaker", "neutral"}, {"partner_deg", 0}}, {{"speaker", "jane"}}}},
                        {"coupling", {{"strength", 0.5}, {"delay_s", 0.5}}},
                        {"pause_s", 1},
                        {"turns", {{{"person", 1}, {"text", "Hello."}}}}};
    const Json& keys = schema.at("properties");
    EXPECT_EQ(keys.size(), whole.size() + 1);  // and "$schema"
    const auto limits_hold = [&](const Json& limits, const char* pointer) {
        for (const auto& [limit, outward] : {std::pair("minimum", -0.01), std::pair("maximum", 0.01)}) {
            Json file = whole;
            Json& value = file.at(Json::json_pointer(pointer));
            const TemporaryFolder folder;
            value = limits.at(limit);
            write_json(folder / "talk.json", file);
            EXPECT_NO_THROW(read_dialog(folder / "talk.json")) << pointer << " " << limit;
            value = limits.at(limit).get<double>() + outward;
            EXPECT_NE(refusal_of_text(file.dump()), "") << pointer << " " << limit;
        }
    };
    limits_hold(keys.at("pause_s"), "/pause_s");
    limits_hold(keys.at("coupling").at("properties").at("strength"), "/coupling/strength");
    limits_hold(keys.at("coupling").at("properties").at("delay_s"), "/coupling/delay_s");
    limits_hold(keys.at("people").at("items").at("properties").at("partner_deg"), "/people/0/partner_deg");
    limits_hold(keys.at("turns").at("items").at("properties").at("person"), "/turns/0/person");
}

}  // namespace
}  // namespace chironomia
