// The plan of a study: which motions of which conditions are compared, on which clips, how they are shown,
// what is asked, and who takes part. Its JSON Schema is study/plan/plan.schema.json.
#pragma once

#include <filesystem>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "core/files/json.h"
#include "core/manner.h"
#include "core/render/rate.h"
#include "core/render/renderer.h"
#include "skinning/degrade/degrade.h"
#include "skinning/motion/motion_file.h"
#include "study/clip/avatars.h"
#include "study/clip/cue.h"
#include "study/clip/cut.h"
#include "study/clip/drawing.h"
#include "study/clip/travel.h"
#include "study/clip/visibility_modes.h"
#include "study/record/key.h"
#include "study/record/page_kinds.h"
#include "study/record/pages.h"
#include "study/record/questions.h"
#include "study/record/scales.h"
#include "synth/markup/markup.h"

namespace chironomia::study {

// How the two conditions of a pair are shown.
enum class Presentation {
    two_videos,  // A and B side by side, each with its own controls
    one_video,   // both figures in one picture, A on the left
    one_by_one,  // A, then B
};

// Where the clips of a condition come from.
enum class Making {
    given,              // motions that the plan names
    manner,             // the expressive engine performs the speech of the clips, in a manner
    style,              // a model of style performs them, as somebody else would
    mismatched_speech,  // the motions of another condition, each with the speech of another clip
    mismatched_motion,  // the speech, with the motions of another condition on other clips
    anchor,             // a degraded condition, the anchor of MUSHRA (ITU-R BS.1534)
};

// How a model of style performs a condition (`chironomia synth --style-of`).
struct PlanStyle {
    std::string engine = "zs-mstm";      // or "mix-stage"
    std::filesystem::path checkpoint{};  // empty: the bundled one
    // the condition whose intervals of PATS say what; none: the clips' speech
    std::optional<std::size_t> content{};
    // The condition whose intervals have the style, of Mix-StAGE that of their speakers; none: `speaker`'s.
    std::optional<std::size_t> of{};
    std::string speaker{};  // an interval's file, or one of the speakers that Mix-StAGE has learned
};

struct PlanCondition {
    std::string name;
    Making making = Making::given;
    std::size_t from = 0;  // the condition that it is made of; its own index if it is of none
    Degradation anchor{};
    std::string speaker{};  // manner: whose habits it has, one of the bundled or a file
    LocalManner manner{};   // manner: in place of the speaker's
    PlanStyle style{};      // style
    Json as_written{};      // manner, style: the same in the plan's words, with what it is from
};

// Who is in a clip beside the agent whose motion is compared; the same in every condition.
struct PlanPartner {
    std::filesystem::path motion;
    MotionHints hints{};             // how the motion is read
    Json hints_as_written{};         // the same in the plan's words; null: nothing is set
    std::filesystem::path face{};    // empty: the motion's own, if it has one
    std::filesystem::path audio{};   // empty: the sound of the clip is that of both
    std::filesystem::path avatar{};  // a file, or the name of a bundled avatar; empty: the plan's
};

struct PlanClip {
    std::string id;
    std::filesystem::path audio;                 // empty: the clip is silent, or a synthetic voice says it
    std::vector<std::filesystem::path> motions;  // one per condition; empty for those that the program makes
    // the same; no entries: the motions' own faces, if they have any
    std::vector<std::filesystem::path> faces{};
    std::optional<PlanPartner> partner{};  // in all clips of a plan or in none
    std::string speaker{};                 // whose speech it is; mismatched clips are of the same
    std::string transcript{};              // what is said; for the record
    std::string caption{};                 // shown under the videos
    std::optional<Cut> cut{};              // of motions and sound [s]
    bool practice = false;                 // shown before the trials alone
    std::optional<std::size_t> block{};    // none: the program draws one

    // What conditions perform that are made of speech, beside or in place of `audio`.
    std::optional<MarkupSource> text{};  // what is said, plain or marked
    std::filesystem::path script{};      // the file that `text` was read from; empty: it stands in the plan
    std::filesystem::path words{};       // when the words of `audio` are said; empty: unknown
    std::string voice = "neutral";       // whose voice says the text: one of the bundled speakers, or a file
    std::uint64_t seed = 0;              // another one makes other choices of gestures

    bool has_speech() const { return !audio.empty() || text.has_value(); }
};

struct PlanRender {
    std::filesystem::path avatar = kDefaultAvatar;  // a file, or the name of a bundled avatar
    std::filesystem::path scene = "upper";          // a file, or the name of a bundled scene
    RenderSize size;                                // of one video
    Rate fps;
    bool upper_body = false;
    Travel travel = Travel::free;
    Drawing drawing;
    Modes modes{};
    std::string format = "mp4";  // or "webm"
    bool partner_on_left = false;
    SpeakingCue cue = SpeakingCue::none;
    std::optional<double> loudness = -23;  // of every sound [LUFS]; none: as recorded
};

// Which checks are among the first pages; the others are spread over the rest.
enum class EarlyChecks { none, first, all };

// Pages whose instruction asks for one answer.
struct PlanChecks {
    std::size_t count = 0;           // of one participant
    std::vector<std::string> kinds;  // "text": burnt into a clip, "audio": spoken over it; in turn
    EarlyChecks at_beginning = EarlyChecks::first;
    std::string instruction;           // for all answers of the page, with {answer} in it
    std::string instruction_of_video;  // for the value of the video itself, with {answer} in it
};

struct PlanCompletion {
    std::string url;  // empty: none
    std::string code;
    std::string failed_url;  // after failed checks; only the server gives it
    std::string failed_code;
    std::string declined_url;  // without consent
    bool by_server = false;    // the page does not hold url and code
};

// Who takes part, and how much each one sees.
struct PlanParticipants {
    std::optional<std::size_t> wanted;
    std::size_t blocks = 1;                   // each participant sees one
    bool each_clip_once = false;              // in one of the comparisons
    std::optional<std::size_t> pages_each;    // none: all of the block
    std::optional<std::size_t> preset_pages;  // that the preset has, and the plan's clips do not fill
    std::optional<std::size_t> orders;        // none: as many as the design needs
};

// What the page says beside questions. Paragraphs are parted by line feeds.
struct PlanTexts {
    std::string language = "en";
    std::string title;
    std::string instructions;
    std::string consent;         // empty: none is asked for
    std::string training;        // empty: none
    Json page = Json::object();  // texts of the page by name, instead of its own
};

// By the name of a condition the option that is right where it is shown; of a question about the videos, by the id of a
// clip the condition that is right on it.
using RightAnswers = std::map<std::string, std::string>;

struct Plan {
    std::filesystem::path file;  // the plan itself
    std::string preset;          // whose values stand where the plan has none; empty: none
    PlanTexts texts;
    Layout layout = Layout::pair;
    Presentation presentation = Presentation::two_videos;
    std::vector<PlanCondition> conditions;
    std::optional<std::size_t> reference;          // of a triplet: the condition in the middle
    std::vector<std::vector<std::size_t>> groups;  // conditions that are shown together, from left to right
    Json compare_as_written{};                     // null: all
    bool fixed_sides = false;                      // as `compare` lists them, on every page
    double length_tolerance = 0.1;                 // of mismatched clips, a share of the length
    std::vector<MotionHints> hints;                // how the motions of each condition are read
    Json hints_as_written{};                       // the same in the plan's words; null: nothing is set
    std::vector<Modes> modes;                      // how face and hands of each condition are shown
    Json modes_as_written{};  // the same in the plan's words; null: all are as in `render`
    bool silent = false;      // sounds of the clips are left out
    PlanRender render;
    std::vector<PlanClip> clips;
    std::vector<Question> questions;
    std::vector<Scale> scales{};                          // of `questions`; for the analysis alone
    std::map<std::string, RightAnswers> right_answers{};  // by the id of a question; for the analysis alone
    std::vector<PagePass> passes;
    bool shuffle_questions = false;
    std::optional<double> skip_after;  // [s]
    bool sound_check = false;
    std::vector<Question> questionnaire;
    PlanChecks checks;
    ExclusionRules exclusions;
    PlanParticipants participants;
    PlanCompletion completion;
    // by item what the study's people say, a text each and a list of hypotheses; null: nothing
    Json preregistration{};
    // that matters: Elo of preferences, standard deviations of other answers
    std::optional<double> smallest_effect{};
};

// Paths are taken relative to the plan. Values that the plan leaves out are those of its preset; texts that
// are left out there too are filled in.
// Throws Error, naming the key, if the plan is no JSON, has an unknown key or a value that is not allowed,
// lacks the motion of a condition, names a file that is not there, or has a condition's name in a text that
// participants read.
Plan read_plan(const std::filesystem::path& file);
// The same of a plan that is yet to be written to that file.
Plan read_plan(const Json& written, const std::filesystem::path& file);

// The plan with everything filled in, as a plan again. Paths are those of `plan`, relative to its file's
// folder where they lie in it.
Json plan_as_used(const Plan& plan);

// What may not be meant so: conditions that show the same motion of a clip, texts of the page that are in English in a
// study of another language.
std::vector<std::string> plan_warnings(const Plan& plan);

// {"ours": {"face_mode": "mask", "hands": "motion"}, ...}
Json modes_by_condition(const Plan& plan);

std::vector<std::string> condition_names(const Plan& plan);

// How the program makes a condition: "mismatched speech", "delayed:250", "manner: neutral, spc 0.8",
// "zs-mstm: source in the style of target", ...
std::string name_of_making(const PlanCondition& condition);

// Whether an engine performs a condition as the study is built.
bool is_performed(const PlanCondition& condition);

// Whether the motions of a condition are its own: given or performed.
bool has_motions(const PlanCondition& condition);

// Whether a condition performs the speech of the clips.
bool performs_speech(const Plan& plan);

// Whether the clips have a sound that participants hear.
bool has_sound(const Plan& plan);

// Whether a condition shows the motion or the speech of other clips.
bool has_mismatch(const Plan& plan);

// Every text that a participant reads.
std::vector<std::string> public_texts(const Plan& plan);

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

}  // namespace chironomia::study
