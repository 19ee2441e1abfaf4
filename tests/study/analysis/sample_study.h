// The files of a small study, without any video: what analysis and rehearsal read.
#pragma once

#include <cstddef>
#include <filesystem>
#include <string>
#include <vector>

#include "core/files/json.h"
#include "core/text.h"
#include "tests/study/sample_key.h"

namespace chironomia::testing {

struct SampleStudy {
    std::string layout = "pair";
    Json conditions = Json::array({{{"name", "ours"}}, {{"name", "baseline"}}});
    Json reference = nullptr;
    std::vector<std::vector<std::string>> groups = {{"ours", "baseline"}};  // shown together on every clip
    Json questions = Json::array({{{"id", "realism"},
                                   {"kind", "preference"},
                                   {"text", "Which one gestures more like a real person?"},
                                   {"answers",
                                    {"Left clearly better", "Left slightly better", "They are equal",
                                     "Right slightly better", "Right clearly better"}}}});
    Json expected = {{"realism", 4}};  // of every check
    Json exclusions = {{"failed_checks", 1}, {"lenient_failed_checks", 2}, {"fastest_seconds", nullptr}};
    std::size_t clips = 6;
    std::size_t checks = 2;
    std::size_t sheets = 4;
};

// From left to right: sheets turn the places of every second trial, and every sheet turns others.
inline std::vector<std::size_t> order_of(const SampleStudy& study, std::size_t places, std::size_t page,
                                         std::size_t sheet, bool is_check) {
    std::vector<std::size_t> order;
    for (std::size_t i = 0; i < places; ++i) order.push_back(i);
    if (is_check || places < 2) return order;
    if (study.layout == "parallel") {
        for (std::size_t& place : order) place = (place + page + sheet) % places;
    } else if ((page + sheet) % 2 == 1) {
        std::swap(order.front(), order.back());
    }
    return order;
}

inline Json key_page(const SampleStudy& study, std::size_t page, bool is_check) {
    const auto& group = study.groups[page % study.groups.size()];
    Json places = Json::array();
    for (const std::string& condition : group)
        places.push_back({{"condition", condition}, {"video", format("{:08x}{:08x}", page, places.size())}});
    return {{"page", format("{:016x}", page)},
            {"kind", is_check ? "check" : "trial"},
            {"clip", format("c{}", page / study.groups.size() % study.clips + 1)},
            {"block", 0},
            {"places", places},
            {"expected", is_check ? study.expected : Json()}};
}

// Writes private/key.json and public/pages.json.
inline void write_sample_study(const SampleStudy& study, const std::filesystem::path& folder) {
    const std::size_t trials = study.clips * study.groups.size();
    Json key_pages = Json::array(), pages = Json::array(), sheets = Json::array(), asked = Json::array(),
         videos_of_key = Json::array();
    for (std::size_t i = 0; i < study.questions.size(); ++i) asked.push_back(i);
    for (std::size_t page = 0; page < trials + study.checks; ++page) {
        key_pages.push_back(key_page(study, page, page >= trials));
        Json videos = Json::array();
        for (const Json& place : key_pages.back()["places"]) {
            videos.push_back("clips/" + place["video"].get<std::string>() + ".mp4");
            videos_of_key.push_back({{"token", place["video"]},
                                     {"clip", key_pages.back()["clip"]},
                                     {"speech", key_pages.back()["clip"]}});
        }
        pages.push_back({{"id", key_pages.back()["page"]},
                         {"videos", videos},
                         {"seconds", 9.5},
                         {"caption", ""},
                         {"passes", {{{"sound", true}, {"questions", asked}}}}});
    }
    for (std::size_t sheet = 0; sheet < study.sheets; ++sheet) {
        Json list = Json::array();
        for (std::size_t i = 0; i < pages.size(); ++i) {
            const std::size_t page = (i + sheet) % pages.size();
            list.push_back(
                {page, order_of(study, pages[page]["videos"].size(), page, sheet, page >= trials)});
        }
        sheets.push_back({{"pages", list}});
    }
    const Json key = {{"format", "chironomia key 2"},
                      {"study", "3f0c9a5b1e2d4c68"},
                      {"seed", 7},
                      {"key", "secret"},
                      {"layout", study.layout},
                      {"conditions", study.conditions},
                      {"reference", study.reference},
                      {"questions", study.questions},
                      {"exclusions", study.exclusions},
                      {"videos", videos_of_key},
                      {"pages", key_pages}};
    write_json(folder / "private/key.json", whole_key(key, study.sheets));
    write_json(folder / "public/pages.json", {{"format", "chironomia pages 2"},
                                              {"study", "3f0c9a5b1e2d4c68"},
                                              {"title", "Two systems"},
                                              {"layout", study.layout},
                                              {"width", 1280},
                                              {"height", 720},
                                              {"questions", study.questions},
                                              {"pages", pages},
                                              {"sheets", sheets}});
}

}  // namespace chironomia::testing
