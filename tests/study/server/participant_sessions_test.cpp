#include "study/server/participant_sessions.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "study/server/answers_file.h"
#include "tests/study/served_sample.h"
#include "tests/support/support.h"

namespace chironomia::study::server {
namespace {

using ::testing::HasSubstr;
using testing::sample_entry;
using testing::SampleStudy;
using testing::TemporaryFolder;
using testing::write_sample_study;

constexpr std::int64_t kMinute = 60'000;
constexpr std::int64_t kTimeout = 30 * kMinute;

// Sessions whose clock the test sets and whose secrets are "s-1", "s-2", ...
class TestSessions {
  public:
    explicit TestSessions(const SampleStudy& sample = {}, const Json& plan = nullptr) {
        write_sample_study(folder_.path(), sample, plan);
        study_ = read_served_study(folder_.path());
        store_.emplace(folder_ / "private/answers.sqlite", Database::Use::write, study_.pages.study);
        sessions_.emplace(study_, kTimeout);
    }

    Reply begin(const Json& body) {
        return sessions_->begin(*store_, body,
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
        return sessions_->answer(*store_, {{"session", session}, {"number", number}, {"answer", entry}}, now);
    }

    Reply finish(const std::string& session, const Json& questionnaire = Json::object()) {
        return sessions_->finish(*store_, {{"session", session}, {"questionnaire", questionnaire}}, now);
    }

    // Answers every step; if `right`, the checks with the answers that the key expects.
    void answer_all(const Reply& begun, bool right = true) {
        const std::size_t sheet = begun.body["sheet"];
        const std::vector<Step>& steps = study_.sheets[sheet];
        for (std::size_t number = 0; number < steps.size(); ++number) {
            Json one = entry(sheet, number);
            if (right && study_.key.pages[steps[number].page].kind == PageKind::check) {
                const bool mirrored = steps[number].order.front() == 1;
                one["values"] = {{"realism", mirrored ? 5 : 1},
                                 {"human", mirrored ? Json({1, 7}) : Json({7, 1})}};
            }
            const Reply reply = answer(begun.body["session"], number, one);
            ASSERT_EQ(reply.status, 200) << reply.body;
        }
    }

    AnswerStore& store() { return *store_; }
    TestSessions& operator=(const TestSessions&) = delete;

    std::int64_t now = 1'700'000'000'000;
    bool admits = true;  // newcomers
    int asked = 0;       // how often

    Reply decline(const std::string& session) { return sessions_->decline(*store_, {{"session", session}}); }

  private:
    TemporaryFolder folder_;
    ServedStudy study_;
    std::optional<AnswerStore> store_;
    std::optional<ParticipantSessions> sessions_;
    int drawn_ = 0;
};

Json without_pages(Json begun) {
    begun.erase("pages");
    return begun;
}

TEST(ParticipantSessions, GivesSheetsInTurn) {
    TestSessions sessions;
    std::vector<int> sheets;
    for (const char* name : {"a", "b", "c", "d", "e"})
        sheets.push_back(sessions.begin_as(name).body["sheet"]);
    EXPECT_EQ(sheets, (std::vector<int>{0, 1, 2, 3, 0}));
    EXPECT_EQ(without_pages(sessions.begin_as("f").body),
              Json::parse(R"({"session": "s-6", "sheet": 1, "answered": 0, "finished": false})"));
}

TEST(ParticipantSessions, KnowsWhoComesBackByTheirProlificId) {
    TestSessions sessions;
    const Json first = {{"participant", "x"}, {"arrived_with", {{"PROLIFIC_PID", "5f"}}}};
    const Json again = {{"participant", "y"}, {"arrived_with", {{"PROLIFIC_PID", " 5f"}}}};
    sessions.begin_as("other");
    const Reply begun = sessions.begin(first);
    sessions.answer(begun.body["session"], 0, sessions.entry(1, 0));
    EXPECT_EQ(without_pages(sessions.begin(again).body),
              Json::parse(R"({"session": "s-2", "sheet": 1, "answered": 1, "finished": false})"));
}

// Letters and accents may be one character or two.
TEST(ParticipantSessions, KnowsWhoComesBackHoweverTheirNameIsComposed) {
    TestSessions sessions;
    EXPECT_EQ(sessions.begin_as("\u00c9ric").body["session"], "s-1");
    EXPECT_EQ(sessions.begin_as("E\u0301ric").body["session"], "s-1");
}

// ?p=wave1&PROLIFIC_PID=...: the link gives all of a wave one `p`.
TEST(ParticipantSessions, NamesThoseOfOneWaveByTheirProlificIds) {
    TestSessions sessions;
    for (const char* id : {"5f", "60"})
        sessions.begin({{"participant", "wave1"}, {"arrived_with", {{"PROLIFIC_PID", id}}}});
    EXPECT_EQ(sessions.store().participants()[0].name, "5f");
    EXPECT_EQ(sessions.store().participants()[1].name, "60");
}

// A link that was pasted without the panel filling it in: all who come by it would be one.
TEST(ParticipantSessions, KnowsNobodyByAMarkThatWasNotFilledIn) {
    TestSessions sessions;
    for (const char* mark : {"{{%PROLIFIC_PID%}}", "${e://Field/PROLIFIC_PID}"}) {
        sessions.begin({{"participant", mark}, {"arrived_with", {{"PROLIFIC_PID", mark}}}});
        sessions.begin(
            {{"participant", "a1b2" + std::string(mark)}, {"arrived_with", {{"PROLIFIC_PID", mark}}}});
    }
    std::vector<std::string> names;
    for (const Participant& participant : sessions.store().participants()) names.push_back(participant.name);
    EXPECT_EQ(names, (std::vector<std::string>{"p-1", "a1b2{{%PROLIFIC_PID%}}", "p-3",
                                               "a1b2${e://Field/PROLIFIC_PID}"}));
}

// The analysis refuses two participants of one name.
TEST(ParticipantSessions, GivesNoTwoParticipantsOneName) {
    TestSessions sessions;
    sessions.begin_as("ada");
    sessions.begin({{"arrived_with", {{"PROLIFIC_PID", "ada"}}}});
    sessions.begin_as("p-4");
    sessions.begin(Json::object());
    sessions.begin_as(" \u00a0x ");
    std::vector<std::string> names;
    for (const Participant& participant : sessions.store().participants()) names.push_back(participant.name);
    EXPECT_EQ(names, (std::vector<std::string>{"ada", "ada-2", "p-4", "p-2", "\u00a0x"}));
}

TEST(ParticipantSessions, TakesABlankNameForNone) {
    TestSessions sessions;
    sessions.begin_as("  ");
    EXPECT_EQ(sessions.store().participants()[0].name, "p-1");
    EXPECT_FALSE(sessions.store().participants()[0].identity);
}

TEST(ParticipantSessions, RefusesNamesWithControlCharacters) {
    TestSessions sessions;
    for (const std::string& name : {std::string("a\0b", 3), std::string("a\nb"), std::string("\x1b[2J")}) {
        const Reply reply = sessions.begin_as(name);
        EXPECT_EQ(reply.status, 400);
        EXPECT_THAT(reply.body["error"].get<std::string>(),
                    HasSubstr("participant: a text of at most 1000 bytes without control characters"));
        EXPECT_THAT(
            sessions.begin({{"arrived_with", {{"PROLIFIC_PID", name}}}}).body["error"].get<std::string>(),
            HasSubstr("arrived_with"));
        EXPECT_THAT(sessions.begin({{"browser", name}}).body["error"].get<std::string>(),
                    HasSubstr("browser"));
    }
    EXPECT_EQ(sessions.store().participants().size(), 0u);
}

TEST(ParticipantSessions, KnowsANamelessBrowserByItsSession) {
    TestSessions sessions;
    const Reply begun = sessions.begin(Json::object());
    EXPECT_EQ(sessions.begin({{"session", begun.body["session"]}}).body, begun.body);
    EXPECT_EQ(sessions.begin({{"session", "unknown"}}).body["sheet"], 1) << "a new participant";
    EXPECT_EQ(sessions.store().participants()[1].name, "p-2");
}

TEST(ParticipantSessions, BelievesANameMoreThanTheSessionOfWhoSatThereBefore) {
    TestSessions sessions;
    const Reply before = sessions.begin_as("a");
    const Reply after = sessions.begin({{"participant", "b"}, {"session", before.body["session"]}});
    EXPECT_NE(after.body["session"], before.body["session"]);
}

TEST(ParticipantSessions, FreesTheSheetOfWhoIsSilentButLetsThemComeBack) {
    TestSessions sessions;
    const Reply gone = sessions.begin_as("gone");  // sheet 0
    sessions.begin_as("b");
    sessions.begin_as("c");
    sessions.begin_as("d");
    sessions.now += kTimeout / 2;
    for (const char* name : {"b", "c", "d"}) sessions.begin_as(name);  // all are active again
    sessions.now += kTimeout / 2 + 1;
    EXPECT_EQ(sessions.begin_as("new").body["sheet"], 0) << "the sheet of who is gone";
    EXPECT_EQ(sessions.begin_as("gone").body["session"], gone.body["session"]);
    EXPECT_EQ(sessions.answer(gone.body["session"], 0, sessions.entry(0, 0)).status, 200);
}

TEST(ParticipantSessions, SaysWhenEnoughHaveCome) {
    TestSessions sessions(
        {}, {{"participants", 2}, {"completion", {{"declined_url", "https://example.org/no"}}}});
    sessions.begin_as("a");
    sessions.begin_as("b");
    const Reply full = sessions.begin_as("c");
    EXPECT_EQ(full.status, 409);
    EXPECT_EQ(full.body["full"], true);
    EXPECT_THAT(full.body["error"].get<std::string>(), HasSubstr("enough people"));
    EXPECT_EQ(full.body["completion"]["url"], "https://example.org/no") << "the way back";
    EXPECT_EQ(sessions.begin_as("a").status, 200) << "who has a place keeps it";
    sessions.now += kTimeout + 1;
    EXPECT_EQ(sessions.begin_as("c").status, 200) << "places of those who dropped out are free";
}

TEST(ParticipantSessions, AdmitsNewcomersAloneByTheirNumber) {
    TestSessions sessions({}, {{"participants", 2}});
    sessions.begin_as("a");
    sessions.admits = false;
    EXPECT_EQ(sessions.begin_as("a").status, 200) << "who comes back";
    EXPECT_EQ(sessions.asked, 1);
    const Reply refused = sessions.begin_as("b");
    EXPECT_EQ(refused.status, 429);
    EXPECT_THAT(refused.body["error"].get<std::string>(), HasSubstr("too many people have begun from this"));
    sessions.admits = true;
    sessions.begin_as("b");
    sessions.admits = false;
    EXPECT_EQ(sessions.begin_as("c").status, 409) << "a full study says so";
    EXPECT_EQ(sessions.store().participants().size(), 2u);
}

TEST(ParticipantSessions, LetsWhoDeclinesGiveTheSheetBack) {
    TestSessions sessions({}, {{"completion", {{"declined_url", "https://example.org/no"}}}});
    const Reply begun = sessions.begin_as("a");
    EXPECT_EQ(sessions.decline(begun.body["session"]).body["completion"]["url"], "https://example.org/no");
    EXPECT_EQ(sessions.begin_as("b").body["sheet"], 0);
    EXPECT_EQ(sessions.decline("nobody").status, 200) << "people may decline before they have a session";
}

// Each showing of a video has a name of its own, by which the page answers.
TEST(ParticipantSessions, TakesAnswersByTheNamesThatItGave) {
    TestSessions sessions;
    sessions.begin_as("other");
    const Reply begun = sessions.begin_as("a");  // sheet 1
    const Json page = begun.body["pages"][0];
    Json entry = sessions.entry(1, 0);
    EXPECT_EQ(page["id"], entry["page"]);
    const Json stored = entry["videos"];
    for (std::size_t place = 0; place < 2; ++place) {
        EXPECT_NE(token_of(page["videos"][place]), stored[place]);
        entry["videos"][place] = token_of(page["videos"][place]);
    }
    EXPECT_EQ(sessions.answer(begun.body["session"], 0, entry).body, Json({{"stored", 1}}));
    EXPECT_EQ(Json::parse(sessions.store().last_answers(1)[0].entry)["videos"], stored);
    std::swap(entry["videos"][0], entry["videos"][1]);
    EXPECT_EQ(sessions.answer(begun.body["session"], 0, entry).status, 409) << "other sides";
}

TEST(ParticipantSessions, StoresAnAnswerOnce) {
    TestSessions sessions;
    const std::string session = sessions.begin_as("a").body["session"];
    EXPECT_EQ(sessions.answer(session, 0, sessions.entry(0, 0)).body, Json({{"stored", 1}}));
    EXPECT_EQ(sessions.answer(session, 1, sessions.entry(0, 1)).body, Json({{"stored", 2}}));
    EXPECT_EQ(sessions.answer(session, 0, sessions.entry(0, 0)).body, Json({{"stored", 2}}));
    EXPECT_EQ(sessions.store().count_answers(), 2u);
}

TEST(ParticipantSessions, RefusesOtherAnswersForWhatIsStored) {
    TestSessions sessions;
    const std::string session = sessions.begin_as("a").body["session"];
    sessions.answer(session, 0, sessions.entry(0, 0));
    Json other = sessions.entry(0, 0);
    other["values"]["realism"] = 5;
    const Reply reply = sessions.answer(session, 0, other);
    EXPECT_EQ(reply.status, 409);
    EXPECT_THAT(reply.body["error"].get<std::string>(), HasSubstr("answered otherwise"));
}

TEST(ParticipantSessions, RefusesWhatIsNotNext) {
    TestSessions sessions;
    const std::string session = sessions.begin_as("a").body["session"];
    EXPECT_EQ(sessions.answer(session, 1, sessions.entry(0, 1)).status, 409);
    EXPECT_THAT(sessions.answer(session, 1, sessions.entry(0, 1)).body["error"].get<std::string>(),
                HasSubstr("number 1 is not the next one; 0 of 5 answers are stored"));
    EXPECT_EQ(sessions.answer(session, 0, sessions.entry(0, 1)).status, 409) << "another page of the sheet";
    EXPECT_EQ(sessions.answer(session, 0, sessions.entry(1, 0)).status, 409) << "a page of another sheet";
    EXPECT_EQ(sessions.store().count_answers(), 0u);
}

TEST(ParticipantSessions, RefusesAnswersBeyondTheSheet) {
    TestSessions sessions;
    const Reply begun = sessions.begin_as("a");
    sessions.answer_all(begun);
    EXPECT_EQ(sessions.answer(begun.body["session"], 5, sessions.entry(0, 0)).status, 409);
}

TEST(ParticipantSessions, RefusesUnknownSessions) {
    TestSessions sessions;
    EXPECT_EQ(sessions.answer("unknown", 0, sessions.entry(0, 0)).status, 403);
    EXPECT_EQ(sessions.answer("", 0, sessions.entry(0, 0)).status, 403);
    EXPECT_EQ(sessions.finish("unknown").status, 403);
}

TEST(ParticipantSessions, RefusesWhatDoesNotFit) {
    TestSessions sessions;
    const std::string session = sessions.begin_as("a").body["session"];
    Json wrong = sessions.entry(0, 0);
    wrong["values"]["realism"] = 9;
    EXPECT_EQ(sessions.answer(session, 0, wrong).status, 400);
    EXPECT_EQ(sessions.begin(Json::array()).status, 400);
    EXPECT_EQ(sessions.begin({{"participant", 1}}).status, 400);
    EXPECT_EQ(sessions.begin({{"browser", std::string(1001, 'x')}}).status, 400);
    EXPECT_EQ(sessions.begin({{"arrived_with", {{"STUDY_ID", 1}}}}).status, 400);
    EXPECT_EQ(sessions.store().participants().size(), 1u);
}

TEST(ParticipantSessions, SendsThoseWhoFinishWhereTheyBelong) {
    const Json completion = {{"url", "https://example.org/done"},
                             {"code", "DONE"},
                             {"failed_url", "https://example.org/failed"},
                             {"failed_code", "FAILED"}};
    TestSessions sessions({}, {{"completion", completion}});
    for (const bool right : {true, false}) {
        for (const char* side : {"left", "right"}) {
            const Reply begun = sessions.begin_as(side + std::to_string(right));
            sessions.answer_all(begun, right);
            EXPECT_EQ(sessions.finish(begun.body["session"], {{"age", 30}}).body["completion"]["code"],
                      right ? "DONE" : "FAILED")
                << "sheet " << begun.body["sheet"];
        }
    }
}

TEST(ParticipantSessions, GivesNoCodeWhenThereIsNone) {
    TestSessions sessions;
    const Reply begun = sessions.begin_as("a");
    sessions.answer_all(begun);
    EXPECT_EQ(sessions.finish(begun.body["session"]).body, Json({{"completion", nullptr}}));
}

TEST(ParticipantSessions, FinishesOnce) {
    TestSessions sessions;
    const Reply begun = sessions.begin_as("a");
    EXPECT_EQ(sessions.finish(begun.body["session"]).status, 409) << "0 of 5 answers";
    sessions.answer_all(begun);
    EXPECT_EQ(sessions.finish(begun.body["session"], {{"age", 3}}).status, 400);
    EXPECT_EQ(sessions.finish(begun.body["session"], {{"age", 30}}).status, 200);
    EXPECT_EQ(sessions.finish(begun.body["session"], {{"age", 40}}).status, 200);
    EXPECT_EQ(sessions.begin_as("a").body["finished"], true);
    const Participant stored = sessions.store().participants().front();
    EXPECT_EQ(stored.questionnaire, R"({"age":30})");
    EXPECT_FALSE(stored.failed);
}

// The sheet of an excluded participant goes to another one.
TEST(ParticipantSessions, DoesNotCountThoseWhoFailedChecks) {
    TestSessions sessions;
    const Reply begun = sessions.begin_as("a");
    sessions.answer_all(begun, false);
    sessions.finish(begun.body["session"]);
    EXPECT_EQ(sessions.begin_as("b").body["sheet"], 0);
}

TEST(ParticipantSessions, KeepsAnswersInTheFormOfTheContract) {
    TestSessions sessions;
    const Reply begun =
        sessions.begin({{"participant", "p-7"}, {"browser", "B"}, {"arrived_with", {{"STUDY_ID", "s"}}}});
    sessions.answer(begun.body["session"], 0, sessions.entry(0, 0));
    const Json answers =
        answers_json(sessions.store(), sessions.store().participants().front(), "3f0c9a5b1e2d4c68");
    Json expected = Json::parse(R"({"format": "chironomia answers 2", "study": "3f0c9a5b1e2d4c68",
        "participant": "p-7", "sheet": 0, "simulated": false, "started": "2023-11-14T22:13:20.000Z", "finished": null,
        "browser": "B", "arrived_with": {"STUDY_ID": "s"}, "questionnaire": {}, "answers": []})");
    expected["answers"].push_back(sessions.entry(0, 0));
    EXPECT_EQ(answers, expected);
}

}  // namespace
}  // namespace chironomia::study::server
