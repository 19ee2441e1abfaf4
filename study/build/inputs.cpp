#include "study/build/inputs.h"

#include <set>

#include "core/files/files.h"
#include "core/hash.h"
#include "core/text.h"
#include "study/clip/clip.h"
#include "study/models/learned_engine.h"

namespace chironomia {
namespace fs = std::filesystem;
namespace {

class InputList {
  public:
    // `name` is how the manifest calls `path`.
    void add(const fs::path& path, const std::string& name) {
        if (!taken_.insert(name).second) return;
        inputs_.push_back({.path = name, .sha256 = sha256_of_file(path), .bytes = fs::file_size(path)});
    }

    std::vector<InputFile> take() { return std::move(inputs_); }

  private:
    std::set<std::string> taken_;
    std::vector<InputFile> inputs_;
};

}  // namespace

std::vector<InputFile> list_inputs(const Plan& plan) {
    InputList list;
    const auto add = [&](const fs::path& path) { list.add(path, path_in_plan(plan, path)); };
    // A motion may be a folder with a file for each frame.
    const auto add_all = [&](const fs::path& motion) {
        if (!fs::is_directory(motion)) return add(motion);
        std::set<fs::path> files;
        for (const auto& entry : fs::directory_iterator(motion)) files.insert(entry.path());
        for (const fs::path& file : files) add(file);
    };
    const auto add_avatar = [&](const fs::path& avatar) {
        if (is_stick(avatar)) return;
        if (avatar.has_extension()) return add(avatar);
        const std::string bundled = format("assets/avatars/{}.glb", avatar.string());
        list.add(find_asset(bundled), bundled);
    };
    add_avatar(plan.render.avatar);
    if (plan.render.scene.has_extension()) add(plan.render.scene);
    for (const MotionHints& hints : plan.hints) {
        if (!hints.name_map.empty()) add(hints.name_map);
    }
    const auto add_model = [&](const PlanStyle& style) {
        const bool is_bundled = style.checkpoint.empty();
        const fs::path file = is_bundled ? bundled_checkpoint(style.engine) : style.checkpoint;
        for (const char* ending : {".safetensors", ".json"}) {
            const fs::path part = fs::path(file).replace_extension(ending);
            list.add(part,
                     is_bundled ? "assets/models/" + part.filename().string() : path_in_plan(plan, part));
        }
        if (style.engine == "zs-mstm" && !style.of) add(style.speaker);
    };
    const auto add_speaker = [&](const fs::path& speaker) {
        if (speaker.has_extension()) add(speaker);
    };
    for (const PlanCondition& condition : plan.conditions) {
        add_speaker(condition.speaker);
        if (condition.making == Making::style) add_model(condition.style);
    }
    for (const PlanClip& clip : plan.clips) {
        if (!clip.script.empty()) add(clip.script);
        if (!clip.words.empty()) add(clip.words);
        add_speaker(clip.voice);
        if (!clip.audio.empty()) add(clip.audio);
        for (const fs::path& motion : clip.motions) {
            if (!motion.empty()) add_all(motion);
        }
        for (const fs::path& face : clip.faces) {
            if (!face.empty()) add(face);
        }
        if (!clip.partner) continue;
        add_all(clip.partner->motion);
        if (!clip.partner->hints.name_map.empty()) add(clip.partner->hints.name_map);
        if (!clip.partner->face.empty()) add(clip.partner->face);
        if (!clip.partner->audio.empty()) add(clip.partner->audio);
        if (!clip.partner->avatar.empty()) add_avatar(clip.partner->avatar);
    }
    return list.take();
}

}  // namespace chironomia
