// How well `chironomia fit` separates good motions from broken ones: writes 60 labelled BVH files, 30 of each kind, in a
// tuning half and a held-out half of other people, judges them as `fit` does and prints what was found.
// `build/release/bin/fit_table RECORDINGS OUT [HALF [AVATAR]]` with the CMU recordings of ../shared/data/motion/cmu.
// A clip has two labels. The source's: broken if a fault was put in. The mesh's: broken also if the avatar shows a hand
// or a forearm inside its body, measured on its triangles (tests/skinning/shape/mesh_depth.h).
#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <functional>

#include "core/text.h"
#include "skinning/body/moving_skeleton.h"
#include "skinning/fit/fit.h"
#include "skinning/gltf/gltf.h"
#include "skinning/motion/bvh/bvh.h"
#include "skinning/motion/motion_file.h"
#include "skinning/skin.h"
#include "study/fit/fit_clips.h"
#include "synth/expressive.h"
#include "synth/gestures/lexicon.h"
#include "synth/markup/markup.h"
#include "synth/speakers/speakers.h"
#include "synth/speech/speak.h"
#include "tests/skinning/shape/mesh_depth.h"
#include "tests/synth/talks.h"

namespace chironomia {

using namespace study;
namespace {

namespace fs = std::filesystem;

// Frames [first, first + kLength) of a recording: of people on a level floor, where their hips travel by less than
// 0.8 m in x and in z.
struct Recording {
    const char* name;
    std::size_t first;
};
constexpr std::size_t kLength = 100;  // frames

struct Half {
    const char* name;
    std::vector<Recording> recordings;
    std::vector<std::string> speakers;
    std::size_t twice;  // the first of the five kinds of fault that are made of two motions
};

// clang-format off
const std::vector<Half>& halves() {
    static const std::vector<Half> all = {
        {"tuning",
         {{"13_07", 100}, {"13_08", 100}, {"13_09", 100}, {"13_14", 100}, {"13_15", 100},
          {"13_16", 100}, {"13_18", 200}, {"13_26", 100}, {"13_30", 100}, {"13_31", 100}},
         {"neutral", "adrian", "beth", "carl", "vigorous"}, 0},
        {"held-out",
         {{"02_05", 80}, {"02_07", 140}, {"02_10", 500}, {"05_02", 10}, {"05_09", 10},
          {"05_12", 150}, {"05_18", 160}, {"06_10", 140}, {"06_12", 130}, {"10_01", 10}},
         {"doris", "edgar", "fiona", "gordon", "abrupt"}, 5}};
    return all;
}
// clang-format on

// One transform of a motion.
struct Fault {
    const char* name;
    std::function<void(Motion&, const HumanoidMap&)> make;
};

Quat& turn(Motion& motion, std::size_t t, int joint) {
    return motion.joints->turns[t * motion.joints->skeleton.joints.size() + static_cast<std::size_t>(joint)];
}
Vec3& move(Motion& motion, std::size_t t, int joint) {
    return motion.joints
        ->translations[t * motion.joints->skeleton.joints.size() + static_cast<std::size_t>(joint)];
}

// The direction of the bone from a joint to another at rest, in the joint's own axes.
Vec3 bone_of(const Motion& motion, int to) {
    return normalize(motion.joints->skeleton.joints[static_cast<std::size_t>(to)].rest.translation);
}

void turn_after(Motion& motion, int joint, std::size_t from, std::size_t to, const Quat& by) {
    for (std::size_t t = from; t < std::min(to, motion.frames); ++t)
        turn(motion, t, joint) = turn(motion, t, joint) * by;
}

const std::vector<Fault>& faults() {
    using enum HumanJoint;
    static const std::vector<Fault> all = {
        {"forearm-roll",
         [](Motion& m, const HumanoidMap& p) {
             turn_after(m, p[left_lower_arm], 40, 70, glm::angleAxis(1.9f, bone_of(m, p[left_hand])));
         }},
        {"upper-arm-roll",
         [](Motion& m, const HumanoidMap& p) {
             turn_after(m, p[right_upper_arm], 55, 57, glm::angleAxis(1.2f, bone_of(m, p[right_lower_arm])));
         }},
        {"heading",
         [](Motion& m, const HumanoidMap& p) {
             for (std::size_t t = 50; t < m.frames; ++t)
                 turn(m, t, p[hips]) = glm::angleAxis(0.9f, Vec3(0, 1, 0)) * turn(m, t, p[hips]);
         }},
        {"hand-flip",
         [](Motion& m, const HumanoidMap& p) {
             turn_after(m, p[right_hand], 30, 60, glm::angleAxis(2.6f, bone_of(m, p[right_hand])));
         }},
        {"toe-flip",
         [](Motion& m, const HumanoidMap& p) {
             turn_after(m, p[left_foot], 45, 75, glm::angleAxis(2.4f, Vec3(0, 1, 0)));
         }},
        {"slide",
         [](Motion& m, const HumanoidMap& p) {
             for (std::size_t t = 0; t < m.frames; ++t)
                 move(m, t, p[hips]).x += 0.25f * std::sin(0.1f * static_cast<float>(t));
         }},
        {"hover",
         [](Motion& m, const HumanoidMap& p) {
             for (std::size_t t = 40; t < 90 && t < m.frames; ++t) move(m, t, p[hips]).y += 0.15f;
         }},
        {"trunk",
         [](Motion& m, const HumanoidMap& p) {
             for (std::size_t t = 20; t < m.frames; ++t) {
                 const float share = std::min(1.0f, static_cast<float>(t - 20) / 20);
                 turn(m, t, p[spine]) = turn(m, t, p[spine]) * glm::angleAxis(1.9f * share, Vec3(0, 1, 0));
             }
         }},
        {"leaves",
         [](Motion& m, const HumanoidMap& p) {
             for (std::size_t t = 0; t < m.frames; ++t)
                 move(m, t, p[hips]).x += 0.03f * static_cast<float>(t);
         }},
        {"spike", [](Motion& m, const HumanoidMap& p) {
             turn_after(m, p[left_upper_arm], 50, 51, glm::angleAxis(1.4f, Vec3(0, 0, 1)));
         }}};
    return all;
}

Motion cut(const Motion& motion, std::size_t first, std::size_t count) {
    Motion part = motion;
    const std::size_t joints = motion.joints->skeleton.joints.size();
    part.frames = std::min(count, motion.frames - first);
    part.face.reset();
    part.labels.clear();
    const auto from = static_cast<std::ptrdiff_t>(first * joints),
               to = from + static_cast<std::ptrdiff_t>(part.frames * joints);
    part.joints->turns.assign(motion.joints->turns.begin() + from, motion.joints->turns.begin() + to);
    part.joints->translations.assign(motion.joints->translations.begin() + from,
                                     motion.joints->translations.begin() + to);
    return part;
}

Motion synthesized(const std::string& speaker, std::size_t talk) {
    const Speech speech =
        speak(parse_marked_text({.text = testing::talk(talk, 1)}, MarkupLanguage::plain), Voice{});
    ExpressiveOptions options{.speaker = speaker_named(speaker),
                              .lexicon = read_lexicon(bundled_lexicon_files()),
                              .fps = 30,
                              .seed = 3};
    return cut(perform(speech, options).motion, 30, kLength);
}

// Recordings first, then what is synthesized: 15 motions of a half.
std::vector<Motion> good_motions(const Half& half, const fs::path& recordings) {
    std::vector<Motion> motions;
    for (const Recording& recording : half.recordings) {
        const fs::path file = recordings / (std::string(recording.name) + ".bvh");
        motions.push_back(cut(read_motion(file), recording.first, kLength));
    }
    for (std::size_t i = 0; i < half.speakers.size(); ++i)
        motions.push_back(synthesized(half.speakers[i], i % testing::kTalks.size()));
    return motions;
}

void write_half(const Half& half, const fs::path& recordings, const fs::path& out) {
    const std::vector<Motion> good = good_motions(half, recordings);
    fs::create_directories(out);
    for (std::size_t i = 0; i < good.size(); ++i) write_bvh(out / format("good-{:02}.bvh", i), good[i]);
    for (std::size_t i = 0; i < good.size(); ++i) {
        const std::size_t kind = i < faults().size() ? i : half.twice + i - faults().size();
        Motion motion = good[(3 * i + i / 5) % good.size()];
        faults()[kind].make(motion, read_skeleton(motion).parts);
        write_bvh(out / format("broken-{:02}-{}.bvh", i, faults()[kind].name), motion);
    }
}

// When the mesh's label is "in the body". Set by thought before any clip was measured, and by nothing that `fit` says:
// flesh and cloth give way by 2 cm, and a finger, which is less than 2 cm thick, is gone with a centimetre to spare. The
// area is that of a finger's last bone. What lasts for less than a tenth of a second is hardly seen.
struct MeshLimits {
    static constexpr float kDepth = 0.03f;     // [m]
    static constexpr float kArea = 4e-4f;      // [m^2]
    static constexpr std::size_t kFrames = 3;  // at 30 a second, one after the other
};

// Where a hand or a forearm of the avatar is deepest in its body.
struct MeshInside {
    bool is_inside = false;   // by MeshLimits
    std::size_t frames = 0;   // of the longest stretch
    std::size_t deepest = 0;  // frame
    float depth = 0;          // there [m]
    std::string parts;        // "left hand in trunk", there
};

std::string parts_of(const std::vector<testing::SunkenPiece>& pieces) {
    const auto deepest = std::max_element(pieces.begin(), pieces.end(),
                                          [](const auto& a, const auto& b) { return a.depth < b.depth; });
    if (deepest == pieces.end()) return "";
    return format("{} in {}", testing::name_of(deepest->of), testing::name_of(deepest->in));
}

MeshInside measure_mesh(const PoseTrack& poses, const Avatar& avatar, testing::MeshDepth& mesh) {
    MeshInside inside;
    std::size_t stretch = 0;
    for (std::size_t t = 0; t < poses.size(); ++t) {
        const std::vector<testing::SunkenPiece> pieces = mesh.sunken(skin(avatar, poses[t]));
        const float depth = testing::depth_of_area(pieces, MeshLimits::kArea);
        stretch = depth > MeshLimits::kDepth ? stretch + 1 : 0;
        inside.frames = std::max(inside.frames, stretch);
        if (depth <= inside.depth) continue;
        inside.depth = depth;
        inside.deepest = t;
        inside.parts = parts_of(pieces);
    }
    inside.is_inside = inside.frames >= MeshLimits::kFrames;
    return inside;
}

// How often `fit` and a label agree.
struct Agreement {
    int found = 0, missed = 0, wrong = 0, right = 0;

    void add(bool broken, bool suspected) {
        ++(broken ? suspected ? found : missed : suspected ? wrong : right);
    }

    void print(const char* label) const {
        std::printf("| %s | %d | %d | %d | %d | %.1f %% | %.1f %% |\n", label, found, missed, wrong, right,
                    100.0 * found / std::max(found + wrong, 1), 100.0 * found / std::max(found + missed, 1));
    }
};

bool says_in_body(const Judgement& judgement) {
    return std::any_of(judgement.reasons.begin(), judgement.reasons.end(), [](const Reason& reason) {
        return reason.text.find(" of the avatar is in its ") != std::string::npos;
    });
}

// What `fit` says of a half.
void judge_half(const Half& half, const fs::path& out, const std::string& avatar_name) {
    const FittedClips fitted = fit_clips({.motions = {out}, .avatar = avatar_name, .quiet = true});
    const Avatar avatar = read_avatar(find_avatar(avatar_name));
    testing::MeshDepth mesh(avatar);
    Agreement by_source, by_mesh, in_body;
    std::printf("\n## %s, %s\n\n", half.name, avatar_name.c_str());
    for (const FittedClip& clip : fitted.clips) {
        const Motion motion = read_motion(out / fs::path(clip.name).filename());
        const MeshInside inside =
            measure_mesh(fit_motion(motion, avatar, {.fps = motion.fps}).poses, avatar, mesh);
        const bool faulty = clip.name.find("broken-") != std::string::npos;
        const bool suspected = clip.judgement.verdict != Verdict::fit_to_show;
        by_source.add(faulty, suspected);
        by_mesh.add(faulty || inside.is_inside, suspected);
        in_body.add(inside.is_inside, says_in_body(clip.judgement));
        std::printf("%s %s %s: source %s, mesh %s", faulty == suspected ? "     " : "WRONG",
                    inside.is_inside == says_in_body(clip.judgement) ? "    " : "BODY", clip.name.c_str(),
                    faulty ? "broken" : "good", faulty || inside.is_inside ? "broken" : "good");
        std::printf("; %.1f cm in frame %zu, %zu frames: %s\n", 100 * static_cast<double>(inside.depth),
                    inside.deepest, inside.frames, inside.depth > 0 ? inside.parts.c_str() : "outside");
        for (const Reason& reason : clip.judgement.reasons)
            std::printf("          %s\n", reason.text.c_str());
    }
    std::puts(
        "\n| label | found | missed | wrongly suspected | rightly passed | precision | recall |\n"
        "| --- | --- | --- | --- | --- | --- | --- |");
    by_source.print("source's");
    by_mesh.print("mesh's");
    in_body.print("in the body alone, mesh's");
}

}  // namespace
}  // namespace chironomia

int main(int count, char** words) {
    using namespace chironomia;
    if (count < 3) {
        std::fputs("usage: fit_table RECORDINGS OUT [HALF [AVATAR]]\n", stderr);
        return 2;
    }
    for (const Half& half : halves()) {
        if (count > 3 && std::string(words[3]) != half.name) continue;
        write_half(half, words[1], std::filesystem::path(words[2]) / half.name);
        judge_half(half, std::filesystem::path(words[2]) / half.name, count > 4 ? words[4] : kDefaultAvatar);
    }
}
