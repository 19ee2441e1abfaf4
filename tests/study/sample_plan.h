// A plan of two conditions and two clips, and the files it names.
#pragma once

#include <filesystem>

#include "core/files/files.h"
#include "core/files/json.h"

namespace chironomia::testing {

inline Json sample_plan() {
    return Json::parse(R"({
        "title": "Two ways to move", "layout": "pair", "sound_check": false, "conditions": ["ours", "baseline"],
        "render": {"avatar": "mannequin", "scene": "upper", "size": [160, 90], "fps": 30},
        "clips": [
            {"id": "c1", "audio": "c1.wav", "motion": {"ours": "ours/c1.bvh", "baseline": "base/c1.bvh"}},
            {"id": "c2", "audio": "c2.wav", "motion": {"ours": "ours/c2.bvh", "baseline": "base/c2.bvh"}}]})");
}

// The files hold their own names: enough for all who only hash them.
inline void write_sample_inputs(const std::filesystem::path& folder) {
    for (const char* name :
         {"c1.wav", "c2.wav", "ours/c1.bvh", "ours/c2.bvh", "base/c1.bvh", "base/c2.bvh"}) {
        write_text(folder / name, name);
    }
}

}  // namespace chironomia::testing
