#include "study/build/inputs.h"

#include <set>

#include "core/files/files.h"
#include "core/hash.h"
#include "core/text.h"
#include "study/clip/clip.h"
#include "study/models/learned_engine.h"

namespace chironomia::study {
namespace fs = std::filesystem;
namespace {

class InputList {
  public:
    explicit InputList(const Plan& plan) : plan_(plan) {}

    // An empty path names no file.
    void add(const fs::path& path) {
        if (!path.empty()) add_as(path_in_plan(plan_, path), path);
    }

    // A motion may be a folder with a file for each frame.
    void add_motion(const fs::path& motion) {
        if (!fs::is_directory(motion)) return add(motion);
        std::set<fs::path> files;
        for (const auto& entry : fs::directory_iterator(motion)) files.insert(entry.path());
        for (const fs::path& file : files) add(file);
    }

    // A name without an ending is that of a bundled file.
    void add_unless_bundled(const fs::path& path) {
        if (path.has_extension()) add(path);
    }

    void add_avatar(const fs::path& avatar) {
        if (avatar.empty() || is_stick(avatar)) return;
        if (avatar.has_extension()) return add(avatar);
        const std::string bundled = format("assets/avatars/{}.glb", avatar.string());
        add_as(bundled, find_asset(bundled));
    }

    void add_style(const PlanStyle& style) {
        const bool is_bundled = style.checkpoint.empty();
        const fs::path file = is_bundled ? bundled_checkpoint(style.engine) : style.checkpoint;
        for (const char* ending : {".safetensors", ".json"}) {
            const fs::path part = fs::path(file).replace_extension(ending);
            add_as(is_bundled ? "assets/models/" + part.filename().string() : path_in_plan(plan_, part),
                   part);
        }
        if (style.engine == "zs-mstm" && !style.of) add(style.speaker);
    }

    void add_clip(const PlanClip& clip) {
        add(clip.script);
        add(clip.words);
        add_unless_bundled(clip.voice);
        add(clip.audio);
        for (const fs::path& motion : clip.motions) add_motion(motion);
        for (const fs::path& face : clip.faces) add(face);
        if (!clip.partner) return;
        add_motion(clip.partner->motion);
        add(clip.partner->hints.name_map);
        add(clip.partner->face);
        add(clip.partner->audio);
        add_avatar(clip.partner->avatar);
    }

    std::vector<InputFile> take() { return std::move(inputs_); }

  private:
    // `name` is how the manifest calls `path`.
    void add_as(const std::string& name, const fs::path& path) {
        if (!taken_.insert(name).second) return;
        inputs_.push_back({.path = name, .sha256 = sha256_of_file(path), .bytes = fs::file_size(path)});
    }

    const Plan& plan_;
    std::set<std::string> taken_;
    std::vector<InputFile> inputs_;
};

}  // namespace

std::vector<InputFile> list_inputs(const Plan& plan) {
    InputList list(plan);
    list.add_avatar(plan.render.avatar);
    list.add_unless_bundled(plan.render.scene);
    for (const MotionHints& hints : plan.hints) list.add(hints.name_map);
    for (const PlanCondition& condition : plan.conditions) {
        list.add_unless_bundled(condition.speaker);
        if (condition.making == Making::style) list.add_style(condition.style);
    }
    for (const PlanClip& clip : plan.clips) list.add_clip(clip);
    return list.take();
}

}  // namespace chironomia::study
