// The page on a web server: a host of files, a server that stores answers, and connections that are slow or
// lost.
#include <map>
#include <mutex>

#include "tests/study/page_fixture.h"
#include "tests/study/tiny_server.h"

namespace chironomia::study {
namespace {

using ::testing::HasSubstr;
using testing::ShownPage;
using testing::TinyServer;

// Answers as docs/study_files.md says that a server does, for one participant.
class FakeSessions {
  public:
    TinyServer::Reply operator()(const std::string& path, const Json& body) {
        const std::lock_guard lock(mutex_);
        ++asked_[path];
        last_[path] = body;
        if (!refusal.empty()) return refuse(409, {{"error", refusal}, {"full", full}});
        if (busy > 0) {
            --busy;
            return {.status = 429, .body = R"({"error": "too many"})", .headers = "Retry-After: 1\r\n"};
        }
        if (path == "api/begin") return begin();
        if (path == "api/decline") return say({{"completion", {{"url", "https://example.org/declined"}}}});
        if (body["session"] != "secret") return refuse(403, {{"error", "unknown session"}});
        if (path == "api/answer") return store(body["number"], body["answer"]);
        if (path == "api/stored") return say({{"name", "0"}});
        finished_ = true;
        return say({{"completion", {{"url", "#done"}, {"code", "XYZ"}}}});
    }

    std::vector<Json> answers() {
        const std::lock_guard lock(mutex_);
        return answers_;
    }
    int times_asked(const std::string& path) {
        const std::lock_guard lock(mutex_);
        return asked_[path];
    }
    Json last(const std::string& path) {
        const std::lock_guard lock(mutex_);
        return last_[path];
    }

    std::string refusal;  // of everything
    bool full = false;
    int busy = 0;  // so many requests are put off

  private:
    static TinyServer::Reply say(const Json& answer) {
        return {.status = 200, .body = answer.dump(), .headers = {}};
    }
    static TinyServer::Reply refuse(int status, const Json& answer) {
        return {.status = status, .body = answer.dump(), .headers = {}};
    }

    TinyServer::Reply begin() {
        return say(
            {{"session", "secret"}, {"sheet", 1}, {"answered", answers_.size()}, {"finished", finished_}});
    }

    TinyServer::Reply store(std::size_t number, const Json& answer) {
        if (number > answers_.size()) return refuse(409, {{"error", "not the next"}});
        if (number < answers_.size() && answers_[number] != answer) {
            return refuse(409, {{"error", "another answer is stored"}});
        }
        if (number == answers_.size()) answers_.push_back(answer);
        return say({{"stored", answers_.size()}});
    }

    std::mutex mutex_;
    std::map<std::string, int> asked_;
    std::map<std::string, Json> last_;
    std::vector<Json> answers_;
    bool finished_ = false;
};

class StudyPageOnline : public testing::PageFixture {
  protected:
    void serve_files() { host({}); }
    void serve_study() {
        host([this](const std::string& path, const Json& body) { return sessions_(path, body); });
    }

    void host(TinyServer::Post post) {
        write_study();
        server_ = std::make_unique<TinyServer>(folder_ / "public", std::move(post));
        url_ = server_->url();
    }

    Json walk_online(const testing::Walker& walker = {}) {
        return testing::walk_study(*browser_, server_->url("?p=0"), walker);
    }

    // Answers the page that is shown.
    void answer(const std::string& key) {
        wait_for("!!trial");
        end_videos();
        browser_->press(key);
        browser_->press("Enter");
    }

    FakeSessions sessions_;
    std::unique_ptr<TinyServer> server_;
};

TEST_F(StudyPageOnline, OffersAFileOnAHostThatOnlyHasFiles) {
    serve_files();
    const Json saved = walk_online({.play = true});
    EXPECT_EQ(saved["sheet"], 0);
    EXPECT_EQ(saved["answers"].size(), 2u);
    EXPECT_EQ(evaluate("document.getElementById('file').hidden"), false);
}

TEST_F(StudyPageOnline, SendsEveryAnswerBeforeItGoesOn) {
    study_["questionnaire"] = {
        {{"id", "age"}, {"kind", "number"}, {"text", "Age"}, {"least", 18}, {"most", 99}}};
    serve_study();
    const Json saved = walk_online(
        {.answer = [](const ShownPage& page, const Json&) { return page.page == "00000000000000p0" ? 4 : 2; },
         .play = true});
    ASSERT_EQ(sessions_.answers().size(), 2u);
    EXPECT_EQ(Json(sessions_.answers()), saved["answers"]);
    EXPECT_EQ(sessions_.answers()[0]["page"], "00000000000000p1");  // the sheet is the server's
    EXPECT_EQ(sessions_.answers()[0]["videos"], Json({token(1), token(0)}));
    EXPECT_EQ(sessions_.answers()[0]["values"], Json({{"realism", 2}}));
    EXPECT_EQ(sessions_.last("api/begin")["participant"], "0");
    EXPECT_EQ(sessions_.last("api/finish"), Json({{"session", "secret"}, {"questionnaire", {{"age", 58}}}}));
    EXPECT_EQ(evaluate("document.getElementById('file').hidden"), true);
    EXPECT_EQ(text_of("code"), "XYZ");
    wait_for("document.getElementById('redirect').textContent.includes('seconds')");
    wait_for("byId('redirect').getAttribute('aria-live') === 'off'");  // after the first count
    evaluate("byId('data').showModal()");
    const std::string left = text_of("redirect");
    evaluate("wait(1.5)");
    EXPECT_EQ(text_of("redirect"), left) << "halted";
    evaluate("byId('data').close()");
    click("#stay");
    EXPECT_EQ(text_of("redirect"), "");
    // Who comes back after the end sees the end.
    reload();
    wait_for_section("finish");
    EXPECT_EQ(text_of("code"), "XYZ");
}

TEST_F(StudyPageOnline, LosesNothingWhenTheConnectionIsLost) {
    serve_study();
    reload();
    wait_for_section("intro");
    start();
    server_->lose_requests(1000);
    answer("4");
    wait_for("document.getElementById('lost').open");
    EXPECT_THAT(text_of("lost-again"), HasSubstr("Trying again in"));
    EXPECT_EQ(text_of("progress-text"), "Page 1 of 2");
    EXPECT_TRUE(sessions_.answers().empty());

    // A reload without a connection does not forget that there is a server.
    reload();
    wait_for("document.getElementById('lost').open");
    server_->lose_requests(0);
    click("#try-now");
    wait_for_section("intro");
    EXPECT_EQ(text_of("resume-note"), "You have answered one of 2 pages.");
    ASSERT_EQ(sessions_.answers().size(), 1u);
    EXPECT_EQ(sessions_.answers()[0]["values"], Json({{"realism", 4}}));

    // An answer that was stored, but whose acknowledgement was lost, is sent again and stored once.
    start();
    server_->lose_answers(1);
    answer("2");
    wait_for_section("finish");
    ASSERT_EQ(sessions_.answers().size(), 2u);
    EXPECT_EQ(sessions_.times_asked("api/answer"), 3);
}

TEST_F(StudyPageOnline, WaitsForABusyServer) {
    serve_study();
    sessions_.busy = 2;
    reload();
    wait_for_section("intro");
    EXPECT_EQ(sessions_.times_asked("api/begin"), 3);
}

TEST_F(StudyPageOnline, GoesOnWhereAnotherWindowWas) {
    serve_study();
    reload();
    wait_for_section("intro");
    start();
    // The other window answers the first page.
    sessions_("api/answer",
              {{"session", "secret"}, {"number", 0}, {"answer", {{"page", "00000000000000p1"}}}});
    answer("4");
    wait_for("document.getElementById('progress-text').textContent === 'Page 2 of 2'");
    answer("1");
    wait_for_section("finish");
    ASSERT_EQ(sessions_.answers().size(), 2u);
    EXPECT_EQ(sessions_.answers()[1]["page"], "00000000000000p0");
}

// Nothing but the browser keeps the answers: a window that was left behind must not overwrite those of the other.
TEST_F(StudyPageOnline, KeepsTheAnswersOfTheWindowThatIsAhead) {
    serve_files();
    reload();
    wait_for_section("intro");
    evaluate("void (window.other = window.open(location.href))");
    wait_for("other.eval(\"!byId('intro').hidden\")");
    evaluate("other.eval(\"byId('start').click()\")");
    wait_for("other.eval('!!trial')");
    start();
    answer("4");
    wait_for("state.sent.answers.length === 1");
    evaluate(
        "other.eval(\"trial.stage.screens.forEach(({video}) => video.dispatchEvent(new Event('ended'))); "
        "trial.form.press(2); byId('form').requestSubmit()\")");
    wait_for("other.eval(\"byId('intro-title').textContent\") === 'Welcome back'");
    EXPECT_EQ(evaluate("readKept(participation.key).sent.answers.map((answer) => answer.values)"),
              Json::array({{{"realism", 4}}}));
    answer("1");
    wait_for_section("finish");
}

TEST_F(StudyPageOnline, SaysThatTheStudyIsFull) {
    serve_study();
    sessions_.refusal = "enough";
    sessions_.full = true;
    reload();
    wait_for_section("message");
    EXPECT_EQ(text_of("message-title"), "The study is complete");
}

TEST_F(StudyPageOnline, OffersTheAnswersWhenTheServerRefusesThem) {
    serve_study();
    reload();
    wait_for_section("intro");
    start();
    sessions_.refusal = "the study has ended.";
    answer("4");
    wait_for_section("message");
    EXPECT_THAT(text_of("message-text"), HasSubstr("The server says: “the study has ended”. Please save"));
    const Json saved =
        evaluate("fetch(document.querySelector('#message-actions a').href).then((file) => file.json())");
    EXPECT_EQ(saved["answers"][0]["values"], Json({{"realism", 4}}));
}

TEST_F(StudyPageOnline, SendsThoseWhoDoNotAgreeWhereTheServerSays) {
    study_["consent"] = {{"text", "You may stop."}};
    serve_study();
    reload();
    EXPECT_EQ(sessions_.times_asked("api/begin"), 0);  // nothing is known to the server before the consent
    click("#decline");
    wait_for_section("message");
    EXPECT_EQ(evaluate("document.querySelector('#message-actions a').href"), "https://example.org/declined");
    EXPECT_EQ(sessions_.times_asked("api/begin"), 0);
}

TEST_F(StudyPageOnline, ShowsHowFarVideosAreOnASlowNetwork) {
    serve_files();
    reload();
    wait_for_section("intro");
    evaluate("loadOnly([])");
    const auto size = std::filesystem::file_size(folder_ / "public/clips" / (token(0) + ".mp4"));
    server_->limit_rate(size / 2);
    start();
    wait_for("/Loading [1-9]\\d* %/.test(document.querySelector('.message').textContent)");
    EXPECT_EQ(evaluate("document.querySelector('.play').disabled"), true);
    wait_for("document.querySelector('.message').hidden && !document.querySelector('.play').disabled");
    server_->limit_rate(0);
    click("#all");
    wait_for("trial.watched");
}

TEST_F(StudyPageOnline, LoadsTheNextPageBeforeItIsNeeded) {
    study_["pages"][0]["videos"] = {format("clips/{}.mp4", token(4)), format("clips/{}.mp4", token(5))};
    serve_files();
    reload();
    wait_for_section("intro");
    start();
    const std::string next = "trialSteps(state.sent.sheet)[1].paths.every((path) => load(path).ready)";
    wait_for(next);
    server_->miss(".mp4");  // nothing needs to be loaded any more
    answer("4");
    wait_for(
        "state.sent.answers.length === 1 && !!trial && "
        "trial.stage.screens.every(({video}) => video.readyState >= 2)");
}

TEST_F(StudyPageOnline, LoadsAVideoAgainThatCouldNotBeLoaded) {
    serve_files();
    server_->miss(".mp4");
    reload();
    wait_for_section("intro");
    start();
    wait_for("document.querySelectorAll('.message button').length === 2");
    EXPECT_THAT(evaluate("document.querySelector('.message').textContent").get<std::string>(),
                HasSubstr("This video could not be loaded. Please check your connection."));
    EXPECT_EQ(evaluate("document.querySelectorAll('.message [role=alert]').length"), 2);
    server_->miss("");
    evaluate("document.querySelectorAll('.message button').forEach((button) => button.click())");
    wait_for("document.querySelectorAll('.message:not([hidden])').length === 0");
    click("#all");
    wait_for("trial.watched");
}

TEST_F(StudyPageOnline, SaysThatTheBrowserCannotPlayAVideo) {
    write_text(folder_ / "public/clips" / (token(0) + ".mp4"), "no video");
    serve_files();
    reload();
    wait_for_section("intro");
    start();
    wait_for("!!document.querySelector('.message button')");
    EXPECT_THAT(evaluate("document.querySelector('.message').textContent").get<std::string>(),
                HasSubstr("This browser could not play this video. Please try another browser."));
}

}  // namespace
}  // namespace chironomia::study
