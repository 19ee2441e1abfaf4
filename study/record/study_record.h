// A finished study as its own files have it.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "core/files/json.h"
#include "study/record/key.h"
#include "study/record/pages.h"

namespace chironomia::study {

struct ListedFile {
    std::string path;  // "public/index.html"
    std::string sha256;
};

// manifest.json: what built a study, and the files that it is made of.
struct Manifest {
    std::string format, program, recipe;  // "" where the file has none
    std::vector<ListedFile> outputs;      // at least one
};

// Throws Error if the file is missing, no JSON, or lists no outputs with their hashes.
Manifest read_manifest(const std::filesystem::path& file);

struct StudyRecord {
    std::filesystem::path folder;
    std::string program;              // that built it
    std::vector<ListedFile> outputs;  // of manifest.json
    StudyKey key;
    StudyPages pages;
    Json plan;                              // plan.json
    Json public_pages;                      // pages.json
    std::vector<std::string> public_texts;  // all that a participant reads
};

// Throws Error if the folder holds no finished study, or one of key.json, plan.json, manifest.json and pages.json is
// missing or damaged. Whether key and pages are of the same study is not asked.
StudyRecord read_study(const std::filesystem::path& folder);

}  // namespace chironomia::study
