#include "study/clip/stick_performance.h"

#include "core/error.h"
#include "core/text.h"
#include "skinning/body/up_doubt.h"
#include "skinning/stick/stick.h"

namespace chironomia::study {
namespace {

// Said with the motion's name: in a study the same avatar is refused for one condition alone.
void refuse_what_sticks_lack(const Performer& performer) {
    const std::string who = performer.motion.empty() ? performer.face->string() : performer.motion.string();
    if (performer.face) {
        throw Error(
            format("{}: a stick figure has no face that {} could move; leave the face out, or choose "
                   "another avatar",
                   who, performer.face->string()));
    }
    if (performer.modes.face_mode != FaceMode::au && performer.modes.face_mode != FaceMode::mask) {
        throw Error(format(
            "{}: a stick figure has no face to show as \"{}\"; choose the face mode \"{}\", or \"{}\", which "
            "draws no more of a face than nose and eyes, or another avatar",
            who, to_text(performer.modes.face_mode), to_text(FaceMode::au), to_text(FaceMode::mask)));
    }
    if (performer.modes.hands == HandsMode::relaxed) {
        throw Error(
            format("{}: a stick figure shows the hands that were seen, and has none to show as \"{}\"; "
                   "choose \"{}\" or \"{}\", or another avatar",
                   who, to_text(HandsMode::relaxed), to_text(HandsMode::motion), to_text(HandsMode::hidden)));
    }
}

}  // namespace

Performance perform_stick(const Performer& performer, const PerformerMotions& motions, const ClipJob& job) {
    refuse_what_sticks_lack(performer);
    if (job.no_interpenetration) {
        throw Error(format(
            "{}: a stick figure has no volume that its hands could enter; leave --no-interpenetration out, or "
            "choose another avatar",
            performer.motion.string()));
    }
    const bool hands = performer.modes.hands == HandsMode::motion;
    const bool face = performer.modes.face_mode == FaceMode::au;
    StickFigure figure = make_stick_figure(
        *motions.body,
        {.fps = job.fps.per_second(), .upper_body = job.upper_body, .hands = hands, .face = face});
    Performance performance;
    performance.avatar = std::move(figure.avatar);
    performance.fit = std::move(figure.fit);
    if (motions.frames) performance.fit.poses.hold_to(*motions.frames);
    performance.motion_file = performance.face_file = performer.motion;
    performance.companions = motions.companions();
    performance.notes = motions.body->notes;
    performance.warnings = motions.warnings;
    if (const auto doubt = doubt_of_up_axis(*motions.body))
        performance.warnings.push_back(format("{}: {}", motions.body->source, *doubt));
    if (!hands) performance.modes.push_back(format("hands {}", to_text(HandsMode::hidden)));
    if (!face) performance.modes.push_back(format("face {}", to_text(FaceMode::mask)));
    if (motions.body->face) {
        performance.warnings.push_back(
            format("{}: a stick figure does not show the face of this motion", performer.motion.string()));
    }
    return performance;
}

}  // namespace chironomia::study
