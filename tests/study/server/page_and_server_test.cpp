// The page in a browser, and the server that it speaks to.
#include <map>
#include <optional>
#include <thread>

#include "study/build/participant_pages.h"
#include "study/record/pages.h"
#include "study/server/answers_file.h"
#include "study/server/serve.h"
#include "tests/study/page_fixture.h"
#include "tests/study/raw_client.h"
#include "tests/study/sample_key.h"
#include "tests/study/walk.h"

namespace chironomia::study::server {
namespace {

using testing::preference_with_reasons;
using testing::rating;
using testing::Walker;

class PageAndServer : public testing::PageFixture {
  protected:
    PageAndServer() {
        Json each = rating("human-like");
        each["each"] = true;
        study_ = study_of("pair", 2, Json::array({preference_with_reasons(), each}));
        study_["consent"] = {{"text", "Your answers are kept."}};
        study_["questionnaire"] = Json::parse(
            R"([{"id": "age", "kind": "number", "text": "Your age", "least": 18, "most": 120, "optional": true}])");
    }

    ~PageAndServer() override { stop(); }

    // The second page is a check whose left video, as listed, must be the better one.
    void write_key() {
        Json videos = Json::array(), pages = Json::array();
        const std::vector<std::string> conditions = {"ours", "baseline"};
        for (const Json& page : study_["pages"]) {
            Json places = Json::array();
            for (std::size_t i = 0; i < 2; ++i) {
                places.push_back({{"condition", conditions[i]}, {"video", token(static_cast<int>(i))}});
                videos.push_back({{"token", token(static_cast<int>(i))}, {"clip", "c"}, {"speech", "c"}});
            }
            const bool check = !pages.empty();
            pages.push_back({{"page", page["id"]},
                             {"kind", check ? "check" : "trial"},
                             {"clip", "c"},
                             {"block", 0},
                             {"places", places},
                             {"expected", check ? Json({{"realism", 1}}) : Json(nullptr)}});
        }
        const Json key = {{"format", "chironomia key 2"},
                          {"study", study_["study"]},
                          {"seed", 7},
                          {"key", "secret"},
                          {"layout", "pair"},
                          {"questions", study_["questions"]},
                          {"exclusions", {{"failed_checks", 1}, {"lenient_failed_checks", 2}}},
                          {"conditions", {{{"name", "ours"}}, {{"name", "baseline"}}}},
                          {"videos", videos},
                          {"pages", pages}};
        write_json(folder_ / "private/key.json", testing::whole_key(key, 1));
        write_json(folder_ / "private/plan.json", {{"completion",
                                                    {{"url", "https://example.org/done"},
                                                     {"code", "DONE"},
                                                     {"failed_url", "https://example.org/failed"},
                                                     {"failed_code", "FAILED"}}}});
    }

    void serve() {
        write_study();
        write_json(folder_ / "public/pages.json", study_);
        write_key();
        server_.emplace(ServeOptions{.study = folder_.path(), .port = port_});
        port_ = server_->port();
        serving_ = std::thread([this] { server_->run(); });
        url_ = format("http://127.0.0.1:{}/", port_);
    }

    void stop() {
        if (!server_) return;
        server_->stop();
        serving_.join();
        server_.reset();
    }

    // The token of a video by the name of its showing.
    std::map<std::string, std::string> tokens() const {
        std::map<std::string, std::string> found;
        for (std::size_t sheet = 0; sheet < study_["sheets"].size(); ++sheet) {
            const Json& shown = study_["sheets"][sheet]["pages"];
            const Json pages = pages_of_sheet(study_, sheet, "secret");
            for (std::size_t at = 0; at < pages.size(); ++at) {
                const Json& page = study_["pages"][shown[at][0].get<std::size_t>()];
                for (std::size_t place = 0; place < pages[at]["videos"].size(); ++place) {
                    found[token_of(pages[at]["videos"][place])] =
                        token_of(page["videos"][shown[at][1][place].get<std::size_t>()]);
                }
            }
        }
        return found;
    }

    // "left clearly" or "right clearly", so that the first video of the pages is the better one, or the worse
    // one.
    Walker prefers(bool the_first) const {
        Walker walker;
        walker.answer = [the_first, tokens = tokens()](const testing::ShownPage& page,
                                                       const Json& question) -> Json {
            if (question["id"] != "realism") return testing::plain_answer(question, 2);
            const bool first_is_left = tokens.at(page.videos.front()).ends_with('0');
            return first_is_left == the_first ? 1 : 5;
        };
        return walker;
    }

    Json stored() {
        write_answers(folder_.path(), {}, folder_ / "answers.json");
        return read_json(folder_ / "answers.json");
    }

    void withdraw_elsewhere() {
        const Json session = evaluate("state.session");
        const auto reply = testing::RawClient(port_).post("/api/withdraw", {{"session", session}});
        ASSERT_EQ(reply.value().status, 200);
    }

    int port_ = 0;
    std::optional<StudyServer> server_;
    std::thread serving_;
};

TEST_F(PageAndServer, KeepWhatAParticipantAnswers) {
    serve();
    const Json shown = testing::walk_study(*browser_, url_ + "?p=somebody", prefers(true));
    const Json answers = stored();
    ASSERT_EQ(answers.size(), 1u);
    Json expected = shown["answers"];
    const auto known = tokens();
    for (Json& answer : expected) {
        for (Json& video : answer["videos"]) video = known.at(video.get<std::string>());
    }
    EXPECT_EQ(answers[0]["answers"], expected);
    EXPECT_EQ(answers[0]["participant"], "somebody");
    EXPECT_EQ(answers[0]["questionnaire"], shown["questionnaire"]);
    EXPECT_TRUE(answers[0]["finished"].is_string());
    EXPECT_THAT(evaluate("document.body.innerHTML").get<std::string>(),
                ::testing::HasSubstr("https://example.org/done"));
}

TEST_F(PageAndServer, SendThoseWhoFailChecksElsewhere) {
    serve();
    testing::walk_study(*browser_, url_ + "?p=careless", prefers(false));
    EXPECT_THAT(evaluate("document.body.innerHTML").get<std::string>(),
                ::testing::HasSubstr("https://example.org/failed"));
}

TEST_F(PageAndServer, ShowAParticipantWhatIsStoredAndDeleteIt) {
    serve();
    browser_->open(url_ + "?p=ada");
    wait_for_section("consent");
    click("#your-data");
    wait_for("document.getElementById('data').open");
    EXPECT_THAT(text_of("data-text"), ::testing::StartsWith("Nothing about you is stored so far."));
    EXPECT_EQ(evaluate("document.getElementById('withdraw').hidden"), true);
    click("#data-close");
    Walker first = prefers(true);
    first.pages_at_most = 1;
    testing::walk_study(*browser_, url_ + "?p=ada", first);
    click("#your-data");
    wait_for("document.getElementById('data').open");
    EXPECT_EQ(text_of("data-text"), "This is everything that is stored about you.");
    const Json shown = Json::parse(text_of("data-stored"));
    EXPECT_EQ(shown["name"], "ada");
    EXPECT_EQ(shown["answers"].size(), 1u);
    EXPECT_EQ(stored().size(), 1u);
    click("#withdraw");
    EXPECT_EQ(stored().size(), 1u) << "it asks first";
    click_and_reload("#withdraw-sure");
    wait_for("document.getElementById('message-title').textContent === 'You have withdrawn'");
    EXPECT_EQ(stored(), Json::array());
    EXPECT_EQ(evaluate("localStorage.length"), 0);
    EXPECT_EQ(evaluate("location.hash"), "");
    reload("?p=ada");
    wait_for_section("consent");
}

// Such as by `study forget`, or on another computer.
TEST_F(PageAndServer, AskThoseAgainWhoseAnswersWereDeleted) {
    serve();
    Walker first = prefers(true);
    first.pages_at_most = 1;
    testing::walk_study(*browser_, url_ + "?p=ada", first);
    withdraw_elsewhere();
    reload("?p=ada");
    wait_for_section("consent");
    EXPECT_EQ(evaluate("localStorage.length"), 0);
    EXPECT_EQ(stored(), Json::array());
    testing::walk_study(*browser_, url_ + "?p=ada", prefers(true));
    EXPECT_EQ(stored()[0]["answers"].size(), 2u) << "anew";
}

TEST_F(PageAndServer, DropWhatIsAnsweredAfterAWithdrawalInAnotherWindow) {
    serve();
    Walker first = prefers(true);
    first.pages_at_most = 1;
    testing::walk_study(*browser_, url_ + "?p=ada", first);
    withdraw_elsewhere();
    evaluate("walker.watch(false)");
    const Json shown = evaluate("walker.shown()");
    for (const Json& question : shown["questions"]) {
        evaluate(
            format("walker.fill({}, {}, [])", question.dump(), testing::plain_answer(question, 2).dump()));
    }
    EXPECT_TRUE(may_go_on());
    click_and_reload("#next");
    wait_for("document.getElementById('message-title').textContent === 'You have withdrawn'");
    EXPECT_EQ(evaluate("localStorage.length"), 0);
    EXPECT_EQ(stored(), Json::array());
}

TEST_F(PageAndServer, AreOfTheNextPersonWhenALinkHasNoName) {
    serve();
    testing::walk_study(*browser_, url_ + "?PROLIFIC_PID=5f2c", prefers(true));
    browser_->open("about:blank");
    browser_->open(url_);
    wait_for_section("consent");
    const Json drawn = evaluate("state.sent.participant");
    EXPECT_NE(drawn, "5f2c");
    testing::walk_study(*browser_, url_, prefers(true));
    reload("");
    wait_for_section("finish");
    EXPECT_EQ(stored().size(), 2u);
}

TEST_F(PageAndServer, GoOnAfterTheServerWasAway) {
    serve();
    Walker first = prefers(true);
    first.pages_at_most = 1;
    testing::walk_study(*browser_, url_ + "?p=patient", first);
    stop();
    serve();
    testing::walk_study(*browser_, url_ + "?p=patient", prefers(true));
    const Json answers = stored();
    ASSERT_EQ(answers.size(), 1u);
    EXPECT_EQ(answers[0]["answers"].size(), 2u);
    EXPECT_TRUE(answers[0]["finished"].is_string());
}

}  // namespace
}  // namespace chironomia::study::server
