// What every key of a study holds beside what a test is about.
#pragma once

#include <set>
#include <string>

#include "core/files/json.h"

namespace chironomia::testing {

// The key with a design of the clips that its pages show and of all its conditions together, and with the files of its
// videos.
inline Json whole_key(Json key, std::size_t sheets) {
    Json group = Json::array();
    for (const Json& condition : key["conditions"]) group.push_back(condition["name"]);
    std::set<std::string> clips;
    for (const Json& page : key["pages"]) clips.insert(page["clip"].get<std::string>());
    key["design"] = {{"clips", clips},          {"groups", Json::array({group})},
                     {"moving", "mirror"},      {"block_of_clip", Json::array()},
                     {"each_clip_once", false}, {"sheets", sheets}};
    key["modes"] = Json::object();
    key["secret_names"] = Json::array();
    for (Json& video : key["videos"]) {
        video["file"] = "clips/" + video["token"].get<std::string>() + ".mp4";
        video["conditions"] = {group[0]};
        video["frames"] = 285;
        video["seconds"] = 9.5;
        video["sha256"] = "0";
    }
    return key;
}

}  // namespace chironomia::testing
