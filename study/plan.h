// The plan of a study: which motions of which conditions are compared, on which clips, and how they are
// shown. Its JSON Schema is study/plan.schema.json.
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "core/json.h"
#include "core/rate.h"
#include "core/renderer.h"
#include "skinning/motion/motion_file.h"
#include "study/avatars.h"
#include "study/cue.h"
#include "study/drawing.h"
#include "study/modes.h"

namespace chironomia {

// How the two conditions of a page are shown.
enum class Presentation {
    two_videos,  // A and B side by side, each with its own controls
    one_video,   // both figures in one picture, A on the left
};

// Who is in a clip beside the agent whose motion is compared; the same in every condition.
struct PlanPartner {
    std::filesystem::path motion;
    MotionHints hints{};             // how the motion is read
    Json hints_as_written{};         // the same in the plan's words; null: nothing is set
    std::filesystem::path face{};    // empty: the motion's own, if it tells one
    std::filesystem::path audio{};   // empty: the sound of the clip is that of both
    std::filesystem::path avatar{};  // a file, or the name of a bundled avatar; empty: the plan's
};

struct PlanClip {
    std::string id;
    std::filesystem::path audio;                 // empty: the clip is silent
    std::vector<std::filesystem::path> motions;  // one per condition, in the order of Plan::conditions
    std::vector<std::filesystem::path> faces{};  // the same; empty: the motions' own faces, if they tell any
    std::optional<PlanPartner> partner{};        // in all clips of a plan or in none
};

struct PlanRender {
    std::filesystem::path avatar = kDefaultAvatar;  // a file, or the name of a bundled avatar
    std::filesystem::path scene = "upper";          // a file, or the name of a bundled scene
    RenderSize size;                                // of one video
    Rate fps;
    bool upper_body = false;
    Drawing drawing;
    Modes modes{};
    std::string format = "mp4";  // or "webm"
    bool partner_on_left = false;
    SpeakingCue cue = SpeakingCue::none;
};

struct Plan {
    std::filesystem::path file;  // the plan itself
    std::string title;
    std::string instructions;
    std::string question;
    std::vector<std::string> answers;  // 5, from "A clearly" to "B clearly"
    std::vector<std::string> conditions;
    Presentation presentation = Presentation::two_videos;
    std::vector<MotionHints> hints;     // how the motions of each condition are read
    Json hints_as_written;              // the same in the plan's words; null: nothing is set
    std::vector<Modes> modes;           // how face and hands of each condition are shown
    Json modes_as_written;              // the same in the plan's words; null: all are as in `render`
    std::optional<std::size_t> orders;  // none: as many as the design needs
    PlanRender render;
    std::vector<PlanClip> clips;
};

// Paths are taken relative to the plan. Texts that the plan leaves out are filled in.
// Throws Error, naming the key, if the plan is no JSON, has an unknown key or a value that is not allowed,
// lacks the motion of a condition, names a file that is not there, or tells a condition's name in a text that
// participants read.
Plan read_plan(const std::filesystem::path& file);

// The plan with everything filled in, as a plan again. Paths are those of `plan`, relative to its file's
// folder where they lie in it.
Json plan_as_used(const Plan& plan);

// {"ours": {"face_mode": "mask", "hands": "motion"}, ...}
Json modes_by_condition(const Plan& plan);

// A path of `plan` as it was written there when it lies below the plan's folder, in full otherwise.
std::string path_in_plan(const Plan& plan, const std::filesystem::path& path);

// The keys that the reader knows, by the object that holds them: "" the plan, "render", "hints.*", "modes.*",
// "clips[]".
struct PlanKeys {
    std::string object;
    std::vector<std::string> keys;
    std::vector<std::string> required;
};
const std::vector<PlanKeys>& plan_keys();

}  // namespace chironomia
