// How well `chironomia fit` separates good motions from broken ones: writes 60 labelled BVH files, 30 of each kind, in a
// tuning half and a held-out half of other people, judges them as `fit` does and prints what was found.
// `build/release/bin/fit_table RECORDINGS OUT [HALF]` with the CMU recordings of ../shared/data/motion/cmu.
#include <array>
#include <cmath>
#include <cstdio>
#include <functional>

#include "core/text.h"
#include "skinning/body/moving_skeleton.h"
#include "skinning/motion/bvh/bvh.h"
#include "skinning/motion/motion_file.h"
#include "study/fit/fit_clips.h"
#include "synth/expressive.h"
#include "synth/gestures/lexicon.h"
#include "synth/markup/markup.h"
#include "synth/speakers/speakers.h"
#include "synth/speech/speak.h"
#include "tests/synth/talks.h"

namespace chironomia {
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

// What `fit` says of a half.
void judge_half(const Half& half, const fs::path& out) {
    const FittedClips fitted = fit_clips({.motions = {out}, .quiet = true});
    int found = 0, missed = 0, wrong = 0, right = 0;
    std::printf("\n## %s\n\n", half.name);
    for (const FittedClip& clip : fitted.clips) {
        const bool broken = clip.name.find("broken-") != std::string::npos;
        const bool suspected = clip.judgement.verdict != Verdict::fit_to_show;
        ++(broken ? suspected ? found : missed : suspected ? wrong : right);
        std::printf("%s %s\n", broken == suspected ? "     " : "WRONG", clip.name.c_str());
        for (const Reason& reason : clip.judgement.reasons)
            std::printf("          %s\n", reason.text.c_str());
    }
    std::printf(
        "\nfound %d, missed %d, wrongly suspected %d, rightly passed %d: precision %.1f %%, recall %.1f %%\n",
        found, missed, wrong, right, 100.0 * found / std::max(found + wrong, 1),
        100.0 * found / std::max(found + missed, 1));
}

}  // namespace
}  // namespace chironomia

int main(int count, char** words) {
    using namespace chironomia;
    if (count < 3) {
        std::fputs("usage: fit_table RECORDINGS OUT [HALF]\n", stderr);
        return 2;
    }
    for (const Half& half : halves()) {
        if (count > 3 && std::string(words[3]) != half.name) continue;
        write_half(half, words[1], std::filesystem::path(words[2]) / half.name);
        judge_half(half, std::filesystem::path(words[2]) / half.name);
    }
}
