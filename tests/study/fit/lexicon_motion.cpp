#include "tests/study/fit/lexicon_motion.h"

#include "synth/body/agent_body.h"
#include "synth/gestures/lexicon.h"
#include "synth/motor/move_arms.h"

namespace chironomia::testing {
namespace {

constexpr double kEach = 5;    // [s]
constexpr double kStroke = 3;  // its end [s]

const Lexicon& bundled_gestures() {
    static const Lexicon lexicon = read_lexicon(bundled_lexicon_files());
    return lexicon;
}

}  // namespace

std::vector<std::string> ids_of_bundled_gestures() {
    std::vector<std::string> ids;
    for (const Gesture& gesture : bundled_gestures().gestures) ids.push_back(gesture.id);
    return ids;
}

Motion motion_of_gestures(const std::vector<std::string>& ids, double fps) {
    const Lexicon& lexicon = bundled_gestures();
    std::vector<PlannedGesture> wishes;
    for (const std::string& id : ids) {
        const double begin = kEach * static_cast<double>(wishes.size());
        wishes.push_back({.gesture = find_gesture(lexicon, id).value(),
                          .function = "rheme",
                          .stroke_end = begin + kStroke,
                          .accents = {},
                          .rheme_start = begin + kStroke - 1,
                          .rheme_end = begin + kStroke + 1});
    }
    const auto frames = static_cast<std::size_t>(kEach * fps * static_cast<double>(ids.size()));
    const Speaker speaker;
    const Variants variants;
    ArmMotion arms = move_arms(wishes, {.lexicon = lexicon, .speaker = speaker, .variants = variants},
                               {.frames = frames, .fps = fps}, 7);
    Motion motion{
        .source = "lexicon",
        .fps = fps,
        .frames = frames,
        .joints =
            JointTrack{.skeleton = agent_skeleton(), .turns = std::move(arms.turns), .translations = {}},
        .keypoints = {},
        .labels = std::move(arms.labels),
        .notes = std::move(arms.notes)};
    for (std::size_t t = 0; t < frames; ++t)
        for (const Joint& joint : agent_skeleton().joints)
            motion.joints->translations.push_back(joint.rest.translation);
    return motion;
}

}  // namespace chironomia::testing
