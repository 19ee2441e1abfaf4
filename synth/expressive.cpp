#include "synth/expressive.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <utility>

#include "synth/body/agent_body.h"
#include "synth/planner/plan_behaviours.h"
#include "synth/presence/carry_body.h"
#include "synth/speech/visemes.h"

namespace chironomia {
namespace {

// Arms, hands and fingers move by their own; all else, and the breath in the shoulders, by the body.
JointTrack join_joints(const CarriedBody& body, const ArmMotion& arms) {
    const Skeleton& skeleton = agent_skeleton();
    JointTrack track{.skeleton = skeleton, .turns = {}, .translations = {}};
    track.turns.reserve(body.turns.size());
    track.translations.reserve(body.turns.size());
    for (std::size_t i = 0; i < body.turns.size(); ++i) {
        const std::size_t joint = i % kAgentJoints;
        track.turns.push_back(normalize(body.turns[i] * arms.turns[i]));
        track.translations.push_back(joint == joint_of(HumanJoint::hips)
                                         ? body.hips[i / kAgentJoints]
                                         : skeleton.joints[joint].rest.translation);
    }
    return track;
}

// The turn of the head in the world, (T).
std::vector<Quat> head_turns(const JointTrack& track) {
    std::vector<Quat> turns;
    for (std::size_t first = 0; first < track.turns.size(); first += kAgentJoints) {
        Quat turn = kNoTurn;
        for (auto part = std::optional(HumanJoint::head); part; part = parent_of(*part))
            turn = track.turns[first + joint_of(*part)] * turn;
        turns.push_back(normalize(turn));
    }
    return turns;
}

// What both show of a unit adds up.
FaceTrack join_faces(FaceTrack face, const FaceTrack& mouth, std::size_t frames) {
    std::vector<FaceChannel> channels = face.channels;
    for (const FaceChannel& channel : mouth.channels) {
        if (std::find(channels.begin(), channels.end(), channel) == channels.end())
            channels.push_back(channel);
    }
    std::vector<float> intensities(frames * channels.size(), 0.0f);
    for (const FaceTrack* track : std::initializer_list<const FaceTrack*>{&face, &mouth}) {
        for (std::size_t c = 0; c < track->channels.size(); ++c) {
            const auto to = static_cast<std::size_t>(
                std::find(channels.begin(), channels.end(), track->channels[c]) - channels.begin());
            for (std::size_t t = 0; t < frames; ++t) {
                float& intensity = intensities[t * channels.size() + to];
                intensity = std::min(intensity + track->intensities[t * track->channels.size() + c], 5.0f);
            }
        }
    }
    face.channels = std::move(channels);
    face.intensities = std::move(intensities);
    return face;
}

LabelTrack label_accents(const Behaviours& behaviours, std::size_t frames, double fps) {
    LabelTrack label{.name = "accent", .values = {"-", "pitch accent"}, .frames = std::vector<int>(frames)};
    for (const double accent : behaviours.accents) {
        const auto frame = static_cast<std::size_t>(std::llround(accent * fps));
        if (frame < frames) label.frames[frame] = 1;
    }
    return label;
}

class ExpressiveEngine : public Synthesizer {
  public:
    explicit ExpressiveEngine(ExpressiveOptions options) : options_(std::move(options)) {}

    Motion synthesize(const Speech& speech) const override { return perform(speech, options_).motion; }

  private:
    ExpressiveOptions options_;
};

}  // namespace

Performed perform(const Speech& speech, const ExpressiveOptions& options) {
    assert(options.fps > 0);
    const auto frames = std::max<std::size_t>(
        1, static_cast<std::size_t>(std::llround(speech.audio.duration() * options.fps)));
    Behaviours behaviours =
        plan_behaviours(speech, options.lexicon, options.speaker, options.variants, options.seed);
    ArmMotion arms = move_arms(behaviours.gestures, options.lexicon, options.speaker, options.variants,
                               {.frames = frames, .fps = options.fps}, options.seed);
    const CarriedBody body =
        carry_body(behaviours, speech, options.speaker, frames, options.fps, options.seed);
    Motion motion{.source = "expressive engine",
                  .fps = options.fps,
                  .frames = frames,
                  .joints = join_joints(body, arms),
                  .keypoints = {},
                  .notes = std::move(arms.notes)};
    motion.face = join_faces(body.face, shape_mouth(speech, frames, options.fps), frames);
    motion.face->head = head_turns(*motion.joints);
    motion.labels = std::move(arms.labels);
    motion.labels.push_back(label_accents(behaviours, frames, options.fps));
    return {
        .motion = std::move(motion), .behaviours = std::move(behaviours), .gestures = std::move(arms.placed)};
}

std::unique_ptr<Synthesizer> make_expressive_engine(ExpressiveOptions options) {
    return std::make_unique<ExpressiveEngine>(std::move(options));
}

}  // namespace chironomia
