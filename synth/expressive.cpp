#include "synth/expressive.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <utility>

#include "synth/body/agent_body.h"
#include "synth/planner/plan_behaviours.h"
#include "synth/presence/idle_body.h"
#include "synth/speech/visemes.h"

namespace chironomia {
namespace {

// Arms, hands and fingers move by their own; all else, and the breath in the shoulders, by the body.
JointTrack join_joints(const IdleBody& body, const ArmMotion& arms) {
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

// As many as last as long as the sound, and one at least.
std::size_t frames_of(const Speech& speech, double fps) {
    assert(fps > 0);
    return std::max<std::size_t>(1, static_cast<std::size_t>(std::llround(speech.audio.duration() * fps)));
}

GestureStyle style_of(const ExpressiveOptions& options, const Speaker& speaker) {
    return {.lexicon = options.lexicon, .speaker = speaker, .variants = options.variants};
}

// Moves the arms, and joins all that moves into one motion.
Performed put_together(const Speech& speech, const ExpressiveOptions& options, Behaviours behaviours,
                       const IdleBody& body) {
    const std::size_t frames = body.hips.size();
    ArmMotion arms = move_arms(behaviours.gestures, style_of(options, options.speaker),
                               {.frames = frames, .fps = options.fps}, options.seed);
    Motion motion{.source = "expressive engine",
                  .fps = options.fps,
                  .frames = frames,
                  .joints = join_joints(body, arms),
                  .keypoints = {},
                  .notes = behaviours.notes};
    motion.notes.insert(motion.notes.end(), arms.notes.begin(), arms.notes.end());
    motion.face = join_faces(body.face, shape_mouth(speech, frames, options.fps), frames);
    motion.face->head = head_turns(*motion.joints);
    motion.labels = std::move(arms.labels);
    motion.labels.push_back(label_accents(behaviours, frames, options.fps));
    return {
        .motion = std::move(motion), .behaviours = std::move(behaviours), .gestures = std::move(arms.placed)};
}

}  // namespace

Performed perform(const Speech& speech, const ExpressiveOptions& options) {
    const std::size_t frames = frames_of(speech, options.fps);
    Behaviours behaviours = plan_behaviours(speech, style_of(options, options.speaker), options.seed);
    const IdleBody body = animate_idle_body({.behaviours = behaviours,
                                             .speech = speech,
                                             .speaker = options.speaker,
                                             .times = {.frames = frames, .fps = options.fps},
                                             .seed = options.seed,
                                             .partner = options.partner});
    return put_together(speech, options, std::move(behaviours), body);
}

std::array<Performed, 2> perform_dialog(const ExpressiveDialog& dialog, const ExpressiveOptions& options) {
    const std::size_t frames = frames_of(dialog.people[0].speech, options.fps);
    std::array<Interlocutor, 2> people;
    for (std::size_t i = 0; i < 2; ++i) {
        const ExpressiveDialog::Person& person = dialog.people[i];
        assert(frames_of(person.speech, options.fps) == frames);
        people[i] = {
            .speech = person.speech,
            .behaviours = plan_behaviours(person.speech, style_of(options, person.speaker), options.seed + i),
            .speaker = person.speaker,
            .partner = person.partner};
    }
    const std::array<IdleBody, 2> bodies =
        animate_dialog(people, dialog.coupling, {.frames = frames, .fps = options.fps}, options.seed);
    std::array<Performed, 2> performed;
    for (std::size_t i = 0; i < 2; ++i) {
        ExpressiveOptions own = options;
        own.speaker = people[i].speaker;
        own.seed += i;
        performed[i] = put_together(people[i].speech, own, std::move(people[i].behaviours), bodies[i]);
    }
    return performed;
}

}  // namespace chironomia
