#include "study/server/front_desk.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "study/server/answers_file.h"
#include "tests/study/served_sample.h"
#include "tests/support/support.h"

namespace chironomia {
namespace {

using ::testing::HasSubstr;
using testing::sample_entry;
using testing::SampleStudy;
using testing::TemporaryFolder;
using testing::write_sample_study;

constexpr std::int64_t kMinute = 60'000;
constexpr std::int64_t kTimeout = 30 * kMinute;

// A desk whose clock the test sets and whose sessions are "s-1", "s-2", ...
class Desk {
  public:
    explicit Desk(const SampleStudy& sample = {}, const Json& plan = nullptr) {
        write_sample_study(folder_.path(), sample, plan);
        study_ = read_served_study(folder_.path());
        store_.emplace(folder_ / "private/answers.sqlite", Database::Use::write, study_.pages.study);
        desk_.emplace(study_, kTimeout);
    }

    Reply begin(const Json& body) {
        return desk_->begin(*store_, body,
                            {.now = now, .session = "s-" + std::to_string(++drawn_), .admits = [&] {
                                 ++asked;
                                 return admits;
                             }});
    }
    Reply begin_as(const std::string& name) { return begin({{"participant", name}, {"browser", "test"}}); }

    Json entry(std::size_t sheet, std::size_t number) const {
        return sample_entry(study_.pages, study_.sheets[sheet][number], "because");
    }

    Reply answer(const std::string& session, std::size_t number, const Json& entry) {
        return desk_->answer(*store_, {{"session", session}, {"number", number}, {"answer", entry}}, now);
    }

    Reply finish(const std::string& session, const Json& questionnaire = Json::object()) {
        return desk_->finish(*store_, {{"session", session}, {"questionnaire", questionnaire}}, now);
    }

    // Answers every step; if `right`, the checks with the answers that the key expects.
    void answer_all(const Reply& begun, bool right = true) {
        const std::size_t sheet = begun.body["sheet"];
        const std::vector<Step>& steps = study_.sheets[sheet];
        for (std::size_t number = 0; number < steps.size(); ++number) {
            Json one = entry(sheet, number);
            if (right && study_.key.pages[steps[number].page].kind == "check") {
                const bool mirrored = steps[number].order.front() == 1;
                one["values"] = {{"realism", mirrored ? 5 : 1},
                                 {"human", mirrored ? Json({1, 7}) : Json({7, 1})}};
            }
            const Reply reply = answer(begun.body["session"], number, one);
            ASSERT_EQ(reply.status, 200) << reply.body;
        }
    }

    AnswerStore& store() { return *store_; }
    Desk& operator=(const Desk&) = delete;

    std::int64_t now = 1'700'000'000'000;
    bool admits = true;  // newcomers
    int asked = 0;       // how often

    Reply decline(const std::string& session) { return desk_->decline(*store_, {{"session", session}}); }

  private:
    TemporaryFolder folder_;
    ServedStudy study_;
    std::optional<AnswerStore> store_;
    std::optional<FrontDesk> desk_;
    int drawn_ = 0;
};

Json without_pages(Json begun) {
    begun.erase("pages");
    return begun;
}

TEST(FrontDesk, GivesSheetsInTurn) {
    Desk desk;
    std::vector<int> sheets;
    for (const char* name : {"a", "b", "c", "d", "e"}) sheets.push_back(desk.begin_as(name).body["sheet"]);
    EXPECT_EQ(sheets, (std::vector<int>{0, 1, 2, 3, 0}));
    EXPECT_EQ(without_pages(desk.begin_as("f").body),
              Json::parse(R"({"session": "s-6", "sheet": 1, "answered": 0, "finished": false})"));
}

TEST(FrontDesk, KnowsWhoComesBackByTheirProlificId) {
    Desk desk;
    const Json first = {{"participant", "x"}, {"arrived_with", {{"PROLIFIC_PID", "5f"}}}};
    const Json again = {{"participant", "y"}, {"arrived_with", {{"PROLIFIC_PID", "5f"}}}};
    desk.begin_as("other");
    const Reply begun = desk.begin(first);
    desk.answer(begun.body["session"], 0, desk.entry(1, 0));
    EXPECT_EQ(without_pages(desk.begin(again).body),
              Json::parse(R"({"session": "s-2", "sheet": 1, "answered": 1, "finished": false})"));
}

// ?p=wave1&PROLIFIC_PID=...: the link gives all of a wave one `p`.
TEST(FrontDesk, NamesThoseOfOneWaveByTheirProlificIds) {
    Desk desk;
    for (const char* id : {"5f", "60"})
        desk.begin({{"participant", "wave1"}, {"arrived_with", {{"PROLIFIC_PID", id}}}});
    EXPECT_EQ(desk.store().participants()[0].name, "5f");
    EXPECT_EQ(desk.store().participants()[1].name, "60");
}

// The analysis refuses two participants of one name.
TEST(FrontDesk, GivesNoTwoParticipantsOneName) {
    Desk desk;
    desk.begin_as("ada");
    desk.begin({{"arrived_with", {{"PROLIFIC_PID", "ada"}}}});
    desk.begin_as("p-4");
    desk.begin(Json::object());
    desk.begin_as(" \u00a0x ");
    std::vector<std::string> names;
    for (const Participant& participant : desk.store().participants()) names.push_back(participant.name);
    EXPECT_EQ(names, (std::vector<std::string>{"ada", "ada-2", "p-4", "p-2", "\u00a0x"}));
}

TEST(FrontDesk, TakesABlankNameForNone) {
    Desk desk;
    desk.begin_as("  ");
    EXPECT_EQ(desk.store().participants()[0].name, "p-1");
    EXPECT_FALSE(desk.store().participants()[0].identity);
}

TEST(FrontDesk, RefusesNamesWithControlCharacters) {
    Desk desk;
    for (const std::string& name : {std::string("a\0b", 3), std::string("a\nb"), std::string("\x1b[2J")}) {
        const Reply reply = desk.begin_as(name);
        EXPECT_EQ(reply.status, 400);
        EXPECT_THAT(reply.body["error"].get<std::string>(),
                    HasSubstr("participant: a text of at most 1000 bytes without control characters"));
        EXPECT_THAT(desk.begin({{"arrived_with", {{"PROLIFIC_PID", name}}}}).body["error"].get<std::string>(),
                    HasSubstr("arrived_with"));
        EXPECT_THAT(desk.begin({{"browser", name}}).body["error"].get<std::string>(), HasSubstr("browser"));
    }
    EXPECT_EQ(desk.store().participants().size(), 0u);
}

TEST(FrontDesk, KnowsANamelessBrowserByItsSession) {
    Desk desk;
    const Reply begun = desk.begin(Json::object());
    EXPECT_EQ(desk.begin({{"session", begun.body["session"]}}).body, begun.body);
    EXPECT_EQ(desk.begin({{"session", "unknown"}}).body["sheet"], 1) << "a new participant";
    EXPECT_EQ(desk.store().participants()[1].name, "p-2");
}

TEST(FrontDesk, BelievesANameMoreThanTheSessionOfWhoSatThereBefore) {
    Desk desk;
    const Reply before = desk.begin_as("a");
    const Reply after = desk.begin({{"participant", "b"}, {"session", before.body["session"]}});
    EXPECT_NE(after.body["session"], before.body["session"]);
}

TEST(FrontDesk, FreesTheSheetOfWhoIsSilentButLetsThemComeBack) {
    Desk desk;
    const Reply gone = desk.begin_as("gone");  // sheet 0
    desk.begin_as("b");
    desk.begin_as("c");
    desk.begin_as("d");
    desk.now += kTimeout / 2;
    for (const char* name : {"b", "c", "d"}) desk.begin_as(name);  // signs of life
    desk.now += kTimeout / 2 + 1;
    EXPECT_EQ(desk.begin_as("new").body["sheet"], 0) << "the sheet of who is gone";
    EXPECT_EQ(desk.begin_as("gone").body["session"], gone.body["session"]);
    EXPECT_EQ(desk.answer(gone.body["session"], 0, desk.entry(0, 0)).status, 200);
}

TEST(FrontDesk, SaysWhenEnoughHaveCome) {
    Desk desk({}, {{"participants", 2}});
    desk.begin_as("a");
    desk.begin_as("b");
    const Reply full = desk.begin_as("c");
    EXPECT_EQ(full.status, 409);
    EXPECT_EQ(full.body["full"], true);
    EXPECT_THAT(full.body["error"].get<std::string>(), HasSubstr("enough people"));
    EXPECT_EQ(desk.begin_as("a").status, 200) << "who has a place keeps it";
    desk.now += kTimeout + 1;
    EXPECT_EQ(desk.begin_as("c").status, 200) << "places of those who dropped out are free";
}

TEST(FrontDesk, AdmitsNewcomersAloneByTheirNumber) {
    Desk desk({}, {{"participants", 2}});
    desk.begin_as("a");
    desk.admits = false;
    EXPECT_EQ(desk.begin_as("a").status, 200) << "who comes back";
    EXPECT_EQ(desk.asked, 1);
    const Reply refused = desk.begin_as("b");
    EXPECT_EQ(refused.status, 429);
    EXPECT_THAT(refused.body["error"].get<std::string>(), HasSubstr("too many people have begun from this"));
    desk.admits = true;
    desk.begin_as("b");
    desk.admits = false;
    EXPECT_EQ(desk.begin_as("c").status, 409) << "a full study says so";
    EXPECT_EQ(desk.store().participants().size(), 2u);
}

TEST(FrontDesk, LetsWhoDeclinesGiveTheSheetBack) {
    Desk desk({}, {{"completion", {{"declined_url", "https://example.org/no"}}}});
    const Reply begun = desk.begin_as("a");
    EXPECT_EQ(desk.decline(begun.body["session"]).body["completion"]["url"], "https://example.org/no");
    EXPECT_EQ(desk.begin_as("b").body["sheet"], 0);
    EXPECT_EQ(desk.decline("nobody").status, 200) << "people may decline before they have a session";
}

// Each showing of a video has a name of its own, by which the page answers.
TEST(FrontDesk, TakesAnswersByTheNamesThatItGave) {
    Desk desk;
    desk.begin_as("other");
    const Reply begun = desk.begin_as("a");  // sheet 1
    const Json page = begun.body["pages"][0];
    Json entry = desk.entry(1, 0);
    EXPECT_EQ(page["id"], entry["page"]);
    const Json stored = entry["videos"];
    for (std::size_t place = 0; place < 2; ++place) {
        EXPECT_NE(token_of(page["videos"][place]), stored[place]);
        entry["videos"][place] = token_of(page["videos"][place]);
    }
    EXPECT_EQ(desk.answer(begun.body["session"], 0, entry).body, Json({{"stored", 1}}));
    EXPECT_EQ(Json::parse(desk.store().last_answers(1)[0].entry)["videos"], stored);
    std::swap(entry["videos"][0], entry["videos"][1]);
    EXPECT_EQ(desk.answer(begun.body["session"], 0, entry).status, 409) << "other sides";
}

TEST(FrontDesk, StoresAnAnswerOnce) {
    Desk desk;
    const std::string session = desk.begin_as("a").body["session"];
    EXPECT_EQ(desk.answer(session, 0, desk.entry(0, 0)).body, Json({{"stored", 1}}));
    EXPECT_EQ(desk.answer(session, 1, desk.entry(0, 1)).body, Json({{"stored", 2}}));
    EXPECT_EQ(desk.answer(session, 0, desk.entry(0, 0)).body, Json({{"stored", 2}}));
    EXPECT_EQ(desk.store().count_answers(), 2u);
}

TEST(FrontDesk, RefusesOtherAnswersForWhatIsStored) {
    Desk desk;
    const std::string session = desk.begin_as("a").body["session"];
    desk.answer(session, 0, desk.entry(0, 0));
    Json other = desk.entry(0, 0);
    other["values"]["realism"] = 5;
    const Reply reply = desk.answer(session, 0, other);
    EXPECT_EQ(reply.status, 409);
    EXPECT_THAT(reply.body["error"].get<std::string>(), HasSubstr("answered otherwise"));
}

TEST(FrontDesk, RefusesWhatIsNotNext) {
    Desk desk;
    const std::string session = desk.begin_as("a").body["session"];
    EXPECT_EQ(desk.answer(session, 1, desk.entry(0, 1)).status, 409);
    EXPECT_THAT(desk.answer(session, 1, desk.entry(0, 1)).body["error"].get<std::string>(),
                HasSubstr("number 1 is not the next one; 0 of 5 answers are stored"));
    EXPECT_EQ(desk.answer(session, 0, desk.entry(0, 1)).status, 409) << "another page of the sheet";
    EXPECT_EQ(desk.answer(session, 0, desk.entry(1, 0)).status, 409) << "a page of another sheet";
    EXPECT_EQ(desk.store().count_answers(), 0u);
}

TEST(FrontDesk, RefusesAnswersBeyondTheSheet) {
    Desk desk;
    const Reply begun = desk.begin_as("a");
    desk.answer_all(begun);
    EXPECT_EQ(desk.answer(begun.body["session"], 5, desk.entry(0, 0)).status, 409);
}

TEST(FrontDesk, RefusesUnknownSessions) {
    Desk desk;
    EXPECT_EQ(desk.answer("unknown", 0, desk.entry(0, 0)).status, 403);
    EXPECT_EQ(desk.answer("", 0, desk.entry(0, 0)).status, 403);
    EXPECT_EQ(desk.finish("unknown").status, 403);
}

TEST(FrontDesk, RefusesWhatDoesNotFit) {
    Desk desk;
    const std::string session = desk.begin_as("a").body["session"];
    Json wrong = desk.entry(0, 0);
    wrong["values"]["realism"] = 9;
    EXPECT_EQ(desk.answer(session, 0, wrong).status, 400);
    EXPECT_EQ(desk.begin(Json::array()).status, 400);
    EXPECT_EQ(desk.begin({{"participant", 1}}).status, 400);
    EXPECT_EQ(desk.begin({{"browser", std::string(1001, 'x')}}).status, 400);
    EXPECT_EQ(desk.begin({{"arrived_with", {{"STUDY_ID", 1}}}}).status, 400);
    EXPECT_EQ(desk.store().participants().size(), 1u);
}

TEST(FrontDesk, SendsThoseWhoFinishWhereTheyBelong) {
    const Json completion = {{"url", "https://example.org/done"},
                             {"code", "DONE"},
                             {"failed_url", "https://example.org/failed"},
                             {"failed_code", "FAILED"}};
    Desk desk({}, {{"completion", completion}});
    for (const bool right : {true, false}) {
        for (const char* side : {"left", "right"}) {
            const Reply begun = desk.begin_as(side + std::to_string(right));
            desk.answer_all(begun, right);
            EXPECT_EQ(desk.finish(begun.body["session"], {{"age", 30}}).body["completion"]["code"],
                      right ? "DONE" : "FAILED")
                << "sheet " << begun.body["sheet"];
        }
    }
}

TEST(FrontDesk, GivesNoCodeWhenThereIsNone) {
    Desk desk;
    const Reply begun = desk.begin_as("a");
    desk.answer_all(begun);
    EXPECT_EQ(desk.finish(begun.body["session"]).body, Json({{"completion", nullptr}}));
}

TEST(FrontDesk, FinishesOnce) {
    Desk desk;
    const Reply begun = desk.begin_as("a");
    EXPECT_EQ(desk.finish(begun.body["session"]).status, 409) << "0 of 5 answers";
    desk.answer_all(begun);
    EXPECT_EQ(desk.finish(begun.body["session"], {{"age", 3}}).status, 400);
    EXPECT_EQ(desk.finish(begun.body["session"], {{"age", 30}}).status, 200);
    EXPECT_EQ(desk.finish(begun.body["session"], {{"age", 40}}).status, 200);
    EXPECT_EQ(desk.begin_as("a").body["finished"], true);
    const Participant stored = desk.store().participants().front();
    EXPECT_EQ(stored.questionnaire, R"({"age":30})");
    EXPECT_FALSE(stored.failed);
}

// The sheet of an excluded participant goes to another one.
TEST(FrontDesk, DoesNotCountThoseWhoFailedChecks) {
    Desk desk;
    const Reply begun = desk.begin_as("a");
    desk.answer_all(begun, false);
    desk.finish(begun.body["session"]);
    EXPECT_EQ(desk.begin_as("b").body["sheet"], 0);
}

TEST(FrontDesk, KeepsAnswersInTheFormOfTheContract) {
    Desk desk;
    const Reply begun =
        desk.begin({{"participant", "p-7"}, {"browser", "B"}, {"arrived_with", {{"STUDY_ID", "s"}}}});
    desk.answer(begun.body["session"], 0, desk.entry(0, 0));
    const Json answers = answers_json(desk.store(), desk.store().participants().front(), "3f0c9a5b1e2d4c68");
    Json expected = Json::parse(R"({"format": "chironomia answers 2", "study": "3f0c9a5b1e2d4c68",
        "participant": "p-7", "sheet": 0, "simulated": false, "started": "2023-11-14T22:13:20.000Z", "finished": null,
        "browser": "B", "arrived_with": {"STUDY_ID": "s"}, "questionnaire": {}, "answers": []})");
    expected["answers"].push_back(desk.entry(0, 0));
    EXPECT_EQ(answers, expected);
}

}  // namespace
}  // namespace chironomia
