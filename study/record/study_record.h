// A finished study as its own files tell it.
#pragma once

#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

#include "core/files/json.h"
#include "study/design/design.h"

namespace chironomia {

struct KeyedVideo {
    std::string token;
    std::string file;  // "clips/<token>.mp4"
    std::string clip;
    std::string speech;                   // the clip whose sound it has
    std::vector<std::string> conditions;  // 1, or 2: left and right
    bool tells = false;                   // an instruction stands in it
    std::string instruction;              // its text
    std::size_t frames = 0;
    std::string sha256;
};

struct KeyedPlace {
    std::string condition;
    std::string video;  // token
};

struct KeyedPage {
    std::string page;  // token
    std::string kind;  // "trial", "check", "practice"
    std::string clip;
    std::size_t block = 0;
    std::vector<KeyedPlace> places;  // from left to right
    Json expected;                   // of a check
};

struct ListedFile {
    std::string path;  // "public/index.html"
    std::string sha256;
};

struct StudyRecord {
    std::filesystem::path folder;
    std::string program;
    std::uint64_t seed = 0;
    std::string key;
    std::string layout;
    std::vector<std::string> conditions;
    std::vector<std::string> clips;  // ids of those that are judged
    DesignShape shape;               // numbers of `clips` and `conditions`
    std::vector<std::string> secret_names;
    std::string study_token;
    std::vector<KeyedVideo> videos;
    std::vector<KeyedPage> pages;
    std::vector<ListedFile> outputs;
    Json plan;                                            // plan.json
    Json public_pages;                                    // pages.json
    std::vector<std::string> public_texts;                // all that a participant reads
    std::vector<std::string> public_page_ids;             // in the order of pages.json
    std::vector<std::vector<std::string>> public_videos;  // of each page, by path
    std::vector<std::string> public_sounds;               // of the sound check, by path
    std::vector<Sheet> sheets;                            // their blocks are those of their pages
};

// Throws Error if the folder holds no finished study, or one of key.json, plan.json, manifest.json and
// pages.json is missing or damaged.
StudyRecord read_study(const std::filesystem::path& folder);

}  // namespace chironomia
