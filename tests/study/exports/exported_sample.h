// A sample study that has been exported.
#pragma once

#include <cstdlib>
#include <filesystem>
#include <string>
#include <vector>

#include "core/files/files.h"
#include "core/files/json.h"
#include "core/text.h"
#include "study/exports/export_study.h"
#include "tests/study/served_sample.h"
#include "tests/support/support.h"

namespace chironomia::testing {

using namespace study;

class ExportedSample {
  public:
    explicit ExportedSample(const SampleStudy& sample) { write_sample_study(study(), sample); }

    // Changes one of the study's files.
    template <typename Change>
    void change(const std::string& file, Change how) {
        Json json = read_json(study() / file);
        how(json);
        write_json(study() / file, json);
    }

    ExportSummary write(ExportForm form, const std::string& video_url = "") {
        return export_study({.study = study(), .out = out(), .form = form, .video_url = video_url});
    }

    std::string refusal(ExportForm form, const std::string& video_url = "") {
        return refusal_of([&] { write(form, video_url); });
    }

    std::filesystem::path study() const { return folder_ / "study"; }
    std::filesystem::path out() const { return folder_ / "out"; }
    std::filesystem::path open(const std::string& file) const { return out() / "public" / file; }
    Json mapping() const { return read_json(out() / "private/mapping.json"); }

    // All text and all names below public/, for a look for what must not be there.
    std::string all_that_is_open() const {
        std::string all;
        for (const auto& entry : std::filesystem::recursive_directory_iterator(out() / "public")) {
            all += entry.path().string().substr(out().string().size()) + "\n";
            if (entry.is_regular_file()) all += read_text(entry.path());
        }
        return all;
    }

    // A file of YAML as Debian's Python reads it.
    Json read_yaml(const std::filesystem::path& file) const {
        const std::filesystem::path script = folder_ / "read.py";
        write_text(script,
                   // Of two surrogates, which are no letter, JSON would make one: UTF-8 cannot write them.
                   "import json, sys, yaml\n"
                   "value = yaml.safe_load(open(sys.argv[1], encoding='utf-8'))\n"
                   "json.dump(value, open(sys.argv[2], 'w', encoding='utf-8'), ensure_ascii=False)\n");
        const std::filesystem::path json = folder_ / "read.json";
        const std::string command =
            format("/usr/bin/python3 '{}' '{}' '{}'", script.string(), file.string(), json.string());
        EXPECT_EQ(std::system(command.c_str()), 0);
        return read_json(json);
    }

  private:
    TemporaryFolder folder_;
};

}  // namespace chironomia::testing
