#include "study/clip/recipe_memory.h"

#include "core/hash.h"
#include "skinning/gltf/gltf.h"

namespace chironomia::study {
namespace fs = std::filesystem;

const std::string& RecipeMemory::hash(const fs::path& file) {
    std::string& known = hashes_[file.string()];
    if (known.empty()) known = sha256_of_file(file);
    return known;
}

Json RecipeMemory::hashes(const fs::path& file, const std::vector<fs::path>& companions) {
    Json hashes = Json::array();
    if (!fs::is_directory(file)) hashes.push_back(hash(file));
    for (const fs::path& companion : companions) hashes.push_back(hash(companion));
    return hashes;
}

Json RecipeMemory::avatar(const fs::path& name_or_file) {
    if (is_stick(name_or_file)) return name_or_file.string();
    Json& known = avatars_[name_or_file.string()];
    if (known.is_null()) {
        const fs::path file = find_avatar(name_or_file);
        known = hashes(file, files_beside_gltf(file));
    }
    return known;
}

const CompanionFiles& RecipeMemory::companions(const Performer& performer, const Json& hints) {
    const Json key = {performer.motion.string(), performer.face.value_or(fs::path()).string(), hints};
    const auto found = companions_.find(key.dump());
    if (found != companions_.end()) return found->second;
    return companions_.emplace(key.dump(), read_motions(performer).companions()).first->second;
}

}  // namespace chironomia::study
