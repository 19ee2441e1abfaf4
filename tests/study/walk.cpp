#include "tests/study/walk.h"

#include <gtest/gtest.h>

#include "core/files/files.h"
#include "core/text.h"
#include "tests/support/support.h"

namespace chironomia::testing {
namespace {

Json for_each(const Json& question, std::size_t places, const Json& value) {
    return question.value("each", false) ? Json(std::vector<Json>(places, value)) : value;
}

// "realism" chosen with a need for reasons: the first one.
Json reasons_for(const Json& question, const Json& value) {
    if (!question.contains("reasons") || question["reasons"].is_null() || value.is_null()) {
        return Json::array();
    }
    const Json& reasons = question["reasons"];
    if (reasons.contains("unless") && reasons["unless"] == value) return Json::array();
    return Json::array({reasons["options"][0]["id"]});
}

class Walk {
  public:
    Walk(Browser& browser, const Walker& walker) : browser_(browser), walker_(walker) {}

    // Does what the section that is shown asks for; false at the end.
    bool go_on() {
        const Json shown = browser_.evaluate("walker.shown()");
        const std::string section = shown["section"];
        if (section == "finish") return false;
        if (section == "trial") {
            if (answered_ == walker_.pages_at_most) return false;
            answer_page(shown);
            ++answered_;
        } else if (section == "questionnaire") {
            for (const Json& question : browser_.evaluate("study.questionnaire")) {
                fill(question, walker_.about_me(question));
            }
            press("#send");
        } else if (section == "sound") {
            browser_.evaluate("walker.passSoundCheck()");
        } else {
            press(button_of(section));
        }
        return true;
    }

  private:
    static std::string button_of(const std::string& section) {
        if (section == "consent") return "#agree";
        return section == "intro" ? "#start" : "#message-actions button";
    }

    void press(const std::string& selector) {
        const Json pressed = browser_.evaluate(
            format("(() => {{ const button = document.querySelector('{}'); "
                   "if (!button || button.disabled) return document.querySelector('main').innerText; "
                   "button.click(); return true; }})()",
                   selector));
        EXPECT_EQ(pressed, true) << selector << " cannot be pressed";
    }

    void fill(const Json& question, const Json& value) {
        browser_.evaluate(format("walker.fill({}, {}, {})", question.dump(), value.dump(),
                                 reasons_for(question, value).dump()));
    }

    void answer_page(const Json& shown) {
        const ShownPage page{.page = shown["page"],
                             .pass = shown["pass"],
                             .practice = shown["practice"],
                             .videos = shown["videos"].get<std::vector<std::string>>()};
        EXPECT_EQ(browser_.evaluate(format("walker.watch({})", walker_.play)), true) << "a video did not end";
        for (const Json& question : shown["questions"]) fill(question, walker_.answer(page, question));
        press("#next");
    }

    Browser& browser_;
    const Walker& walker_;
    int answered_ = 0;
};

}  // namespace

Json plain_answer(const Json& question, std::size_t places) {
    const std::string kind = question["kind"];
    if (question.value("optional", false) || kind == "text")
        return question.value("optional", false) ? Json() : "-";
    if (kind == "preference") return question["answers"].size() / 2 + 1;
    if (kind == "rating") return for_each(question, places, (question["points"].get<int>() + 1) / 2);
    if (kind == "slider" || kind == "number") {
        const double middle = (question.value("least", 0.0) + question.value("most", 100.0)) / 2;
        return for_each(question, places, static_cast<int>(middle));
    }
    const bool of_videos = question.value("of_videos", false);
    if (kind == "choice") return of_videos ? Json(0) : question["options"][0]["id"];
    Json ranks = Json::array();
    const std::size_t count = of_videos ? places : question["options"].size();
    for (std::size_t rank = 1; rank <= count; ++rank) ranks.push_back(rank);
    return ranks;
}

Json walk_study(Browser& browser, const std::string& url, const Walker& walker) {
    browser.open("about:blank");
    browser.open(url);
    browser.evaluate(read_text(source_dir() / "tests/study/walk.js"));
    Walk walk(browser, walker);
    EXPECT_TRUE(browser.wait_for("walker.section() !== ''")) << "the page shows nothing";
    for (;;) {
        const std::string before = browser.evaluate("walker.mark()");
        if (!walk.go_on()) break;
        if (!browser.wait_for(format("walker.section() && walker.mark() !== {}", Json(before).dump()))) {
            ADD_FAILURE() << "the page does not go on: " << browser.evaluate("document.body.innerText");
            break;
        }
    }
    return browser.evaluate("JSON.parse(participation.text)");
}

}  // namespace chironomia::testing
