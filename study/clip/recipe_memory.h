// What the recipes of many clips share, read once: hashes of files and avatars, and what lies beside motions.
#pragma once

#include <filesystem>
#include <map>
#include <string>
#include <vector>

#include "core/files/json.h"
#include "study/clip/clip.h"

namespace chironomia::study {

// Holds for as long as the files stay as they are.
class RecipeMemory {
  public:
    // SHA-256. Throws Error if the file cannot be read.
    const std::string& hash(const std::filesystem::path& file);

    // Of a file, and of the files beside it that it was also read from; of a folder, of these alone.
    Json hashes(const std::filesystem::path& file, const std::vector<std::filesystem::path>& companions);

    // Of a name or a file of an avatar; of a stick figure its name.
    Json avatar(const std::filesystem::path& name_or_file);

    // Of the motions of a performer, which are read if they are not known. `hints` is how recipes write these.
    const CompanionFiles& companions(const Performer& performer, const Json& hints);

  private:
    std::map<std::string, std::string> hashes_;
    std::map<std::string, Json> avatars_;
    std::map<std::string, CompanionFiles> companions_;  // by motion, face and hints
};

Json recipe_of(const ClipJob& job, RecipeMemory& memory);

}  // namespace chironomia::study
