#include "tests/study/served_sample.h"

#include <numeric>

#include "core/files/files.h"
#include "core/hash.h"
#include "core/text.h"
#include "tests/study/sample_key.h"

namespace chironomia::testing {

using namespace study;
namespace {

constexpr const char* kStudy = "3f0c9a5b1e2d4c68";

std::string token(const std::string& what) {
    return keyed_sha256("sample", what).substr(0, 16);
}

std::size_t places_of(const std::string& layout) {
    if (layout == "single") return 1;
    if (layout == "pair") return 2;
    return layout == "triplet" ? 3 : 4;
}

std::string condition_at(std::size_t place) {
    constexpr const char* kNames[] = {"ours", "baseline", "third", "fourth"};
    return kNames[place];
}

std::string video_token(std::size_t page, std::size_t place) {
    return token(format("video {} {}", page, place));
}

std::size_t pages_of(const SampleStudy& sample) {
    return sample.trials + sample.checks;
}

Json sheet(const SampleStudy& sample, std::size_t number) {
    Json shown = Json::array();
    for (std::size_t i = 0; i < pages_of(sample); ++i) {
        std::vector<std::size_t> order(places_of(sample.layout));
        std::iota(order.begin(), order.end(), 0u);
        if (number % 2 == 1) std::reverse(order.begin(), order.end());
        shown.push_back(Json::array({(i + number) % pages_of(sample), order}));
    }
    return {{"pages", std::move(shown)}};
}

Json preference() {
    return Json::parse(
        R"({"id": "realism", "kind": "preference", "text": "Which one moves more like a person?",
        "answers": ["left clearly", "left slightly", "equal", "right slightly", "right clearly"],
        "reasons": {"text": "Why?", "options": [{"id": "smooth", "text": "smoothness"}, {"id": "amount", "text": "amount"}],
                    "other": "Something else", "unless": 3}})");
}

Json questions_of(const std::string& layout) {
    Json rating =
        Json::parse(R"({"id": "human", "kind": "rating", "text": "How human-like is it?", "points": 7,
        "labels": {"1": "not at all", "7": "very"}, "each": true})");
    if (layout == "single") rating.erase("each");
    if (layout == "parallel") {
        rating = Json::parse(R"({"id": "human", "kind": "slider", "text": "How human-like is it?", "least": 0,
            "most": 100, "labels": ["excellent", "good", "fair", "poor", "bad"], "each": true})");
    }
    if (layout == "pair" || layout == "triplet") return Json::array({preference(), rating});
    return Json::array({rating});
}

Json expected_of(const std::string& layout) {
    if (layout == "single") return {{"human", 1}};
    if (layout == "pair") return {{"realism", 1}, {"human", {7, 1}}};
    if (layout == "triplet") return {{"realism", 1}};
    return {{"human", {100, 0, 0, 0}}};
}

}  // namespace

Json sample_pages(const SampleStudy& sample) {
    const Json questions = questions_of(sample.layout);
    std::vector<std::size_t> asked(questions.size());
    std::iota(asked.begin(), asked.end(), 0u);
    Json pages = Json::array(), sheets = Json::array();
    for (std::size_t i = 0; i < pages_of(sample); ++i) {
        Json videos = Json::array();
        for (std::size_t place = 0; place < places_of(sample.layout); ++place) {
            videos.push_back(format("clips/{}.mp4", video_token(i, place)));
        }
        pages.push_back({{"id", token(format("page {}", i))},
                         {"videos", std::move(videos)},
                         {"seconds", 9.5},
                         {"caption", ""},
                         {"passes", Json::array({{{"sound", true}, {"questions", asked}}})}});
    }
    for (std::size_t i = 0; i < sample.sheets; ++i) sheets.push_back(sheet(sample, i));
    return {{"format", "chironomia pages 2"},
            {"study", kStudy},
            {"language", "en"},
            {"title", "Two ways to move"},
            {"texts", Json::object()},
            {"layout", sample.layout},
            {"one_by_one", false},
            {"width", 320},
            {"height", 180},
            {"sound", true},
            {"shuffle_questions", false},
            {"skip_after", sample.may_skip ? Json(5) : Json(nullptr)},
            {"instructions", "You will see two people.\nWatch both & answer."},
            {"consent", {{"text", "Your answers are kept."}, {"agree", "I agree"}}},
            {"training", nullptr},
            {"sound_check", nullptr},
            {"questions", questions},
            {"pages", std::move(pages)},
            {"sheets", std::move(sheets)},
            {"questionnaire", Json::parse(R"([{"id": "age", "kind": "number", "text": "Your age", "least": 18,
                "most": 120, "optional": true}, {"id": "remarks", "kind": "text", "text": "Anything else?", "optional": true}])")},
            {"completion", nullptr}};
}

Json sample_key(const SampleStudy& sample) {
    Json conditions = Json::array(), videos = Json::array(), pages = Json::array();
    for (std::size_t place = 0; place < places_of(sample.layout); ++place) {
        conditions.push_back({{"name", condition_at(place)}});
    }
    for (std::size_t i = 0; i < pages_of(sample); ++i) {
        const std::string clip = format("c{}", i);
        Json places = Json::array();
        for (std::size_t place = 0; place < places_of(sample.layout); ++place) {
            const std::string video = video_token(i, place);
            places.push_back({{"condition", condition_at(place)}, {"video", video}});
            videos.push_back({{"token", video}, {"clip", clip}, {"speech", clip}});
        }
        const bool is_check = i >= sample.trials;
        pages.push_back({{"page", token(format("page {}", i))},
                         {"kind", is_check ? "check" : "trial"},
                         {"clip", clip},
                         {"block", 0},
                         {"places", std::move(places)},
                         {"expected", is_check ? expected_of(sample.layout) : Json(nullptr)}});
    }
    const Json key = {
        {"format", "chironomia key 2"},
        {"study", kStudy},
        {"seed", 7},
        {"key", "secret"},
        {"layout", sample.layout},
        {"conditions", std::move(conditions)},
        {"reference", sample.layout == "triplet" ? Json("baseline") : Json(nullptr)},
        {"questions", questions_of(sample.layout)},
        {"exclusions", {{"failed_checks", 1}, {"lenient_failed_checks", 2}, {"fastest_seconds", nullptr}}},
        {"videos", std::move(videos)},
        {"pages", std::move(pages)}};
    return whole_key(key, sample.sheets);
}

void write_sample_study(const std::filesystem::path& folder, const SampleStudy& sample, const Json& plan) {
    const Json pages = sample_pages(sample);
    write_text(folder / "public/index.html", "<!doctype html><title>Two ways to move</title>\n");
    write_text(folder / "public/player.js", "'use strict';\n");
    write_text(folder / "public/style.css", "body {}\n");
    write_json(folder / "public/pages.json", pages);
    for (const Json& page : pages["pages"]) {
        for (const Json& video : page["videos"]) {
            write_text(folder / "public" / video.get<std::string>(),
                       "0123456789 " + video.get<std::string>());
        }
    }
    write_json(folder / "private/key.json", sample_key(sample));
    if (!plan.is_null()) write_json(folder / "private/plan.json", plan);
}

Json sample_entry(const StudyPages& study, const Step& step, const std::string& mark) {
    const StudyPage& page = study.pages[step.page];
    return {{"page", page.id},
            {"pass", step.pass},
            {"videos", tokens_as_shown(page, step.order)},
            {"values", {{"realism", 2}, {"human", {3, 4}}}},
            {"reasons", {{"realism", {{"chosen", {"smooth"}}, {"other", mark}}}}},
            {"skipped", false},
            {"seconds", 12.5},
            {"events", {{0.5, "play 0"}, {10.25, "ended 0"}}}};
}

}  // namespace chironomia::testing
