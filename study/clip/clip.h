// One clip: what is to be rendered, and what came of it.
#pragma once

#include <cstddef>
#include <filesystem>
#include <functional>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "core/files/json.h"
#include "core/render/rate.h"
#include "core/render/renderer.h"
#include "raster/gl/gl_renderer.h"
#include "skinning/degrade/degrade.h"
#include "skinning/face/face_drive.h"
#include "skinning/motion/motion_file.h"
#include "study/clip/avatars.h"
#include "study/clip/cue.h"
#include "study/clip/cut.h"
#include "study/clip/drawing.h"
#include "study/clip/notice.h"
#include "study/clip/travel.h"
#include "study/clip/visibility_modes.h"

namespace chironomia::study {

// Frames [first, last) of the clip.
struct FrameRange {
    std::size_t first = 0;
    std::optional<std::size_t> last;  // none: to the end
};

// Who is in a clip, and what moves them.
struct Performer {
    std::filesystem::path motion;                 // empty: the body stands relaxed, if there is a face
    MotionHints hints{};                          // how the motion is read
    std::optional<std::filesystem::path> face{};  // otherwise the face of the motion, if it has one
    FaceOptions face_options{};
    std::filesystem::path avatar = kDefaultAvatar;  // a file, the name of a bundled avatar, or "stick"
    Modes modes{};
    std::optional<std::filesystem::path> voice{};  // what this person says, heard from their side
    std::optional<Cut> cut{};                      // of motion, face or film; none: ClipJob::cut
    std::optional<Cut> voice_cut{};                // as ClipJob::sound_cut
    std::optional<Degradation> anchor{};           // body and face are made worse, after the cut
    std::filesystem::path film{};  // of a real person, who is shown in place of the avatar, alone in the clip
    // With Travel::follow: whom the camera follows, shown or not, moved by a motion or a face; empty: this person.
    std::vector<Performer> followed{};
};

// Without a motion and a face the file of the avatar, which may show anything, plays its own animation.
inline bool plays_own_animation(const Performer& performer) {
    return performer.motion.empty() && !performer.face && performer.film.empty();
}

struct ClipJob {
    std::vector<Performer> performers = {{}};  // 1, or 2 from the viewer's left to right
    bool beside = false;  // each performer in a picture of their own, as if rendered alone
    std::optional<std::filesystem::path> audio;  // of the whole clip; none with voices
    std::optional<Cut> cut;                 // what is shown of motions and their faces, to the nearest frame
    std::optional<Cut> sound_cut;           // what is heard of `audio`; none: `cut` in whole frames
    bool silent = false;                    // as long as with sound, but without any
    bool stereo = false;                    // a sound of one channel is played in two
    std::optional<double> loudness;         // of all sound [LUFS], set in soundtrack.cpp; none: as it is
    std::optional<Notice> notice{};         // burnt into the picture
    std::optional<SpokenNotice> spoken{};   // over the sound, before it is brought to its loudness
    SpeakingCue cue = SpeakingCue::none;    // needs two voices
    std::filesystem::path scene = "upper";  // a file, or the name of a bundled scene
    RenderSize size;                        // of the whole picture
    Rate fps;
    bool upper_body = false;  // hold root and legs still
    Travel travel = Travel::free;
    bool no_interpenetration = false;  // move arms out of the body
    Drawing drawing;
    FrameRange frames;
    std::optional<double> at_least;  // the clip lasts so long or longer: last pose held, silence added [s]
    std::filesystem::path out;       // *.mp4, *.webm, or a stack such as DIR/%05d.png
    int threads = 0;                 // of the renderer and the image writers; 0: all cores
    GlBackend gl = GlBackend::any;
    bool quiet = false;  // no progress
};

// What is shown of a performer; none: all.
inline const std::optional<Cut>& cut_of(const Performer& performer, const ClipJob& job) {
    return performer.cut ? performer.cut : job.cut;
}

struct ClipResult {
    std::size_t frames = 0;
    double seconds = 0;                 // duration of the clip
    std::vector<std::string> warnings;  // held poses, added silence; each one sentence
    Json report;  // recipe, what was detected, and how well each avatar follows its motion
};

// Files beside a performer's motion and face that these were also read from.
struct CompanionFiles {
    std::vector<std::filesystem::path> of_motion, of_face;
};

// The files that move a performer, read.
struct PerformerMotions {
    std::optional<Motion> body;           // may also hold a face
    std::optional<Motion> face;           // of a file of its own
    std::optional<std::size_t> frames{};  // of the clip, if a cut says how many
    std::vector<std::string> warnings{};  // of times that begin late

    CompanionFiles companions() const;
};

// Throws Error if a file cannot be read, or the file of the face holds none.
PerformerMotions read_motions(const Performer& performer);

// The same, and of them what the job shows: the cut, and what the anchor makes of it. Throws Error also if
// the cut is beyond the end of a motion, or if it cannot become the anchor.
PerformerMotions read_motions(const Performer& performer, const ClipJob& job);

// What decides the bytes of a clip: hashes of its inputs and of the program, and the options. Two jobs with
// the same recipe make the same clip. Throws Error if an input cannot be read.
Json recipe_of(const ClipJob& job);

// The same without reading the motions again, which are large.
//   companions   of the motions of each performer
Json recipe_of(const ClipJob& job, std::span<const CompanionFiles> companions);

// What a study must know of the motions of a clip before it records any.
struct ClipMotions {
    double length = 0;  // of the longest [s]
    bool is_film = false;
    std::vector<bool> shown_face;  // of each performer: there is face data, and the modes let it be seen
};

// What a study is recorded with. `clip_maker()` is the real thing.
struct ClipMaker {
    std::function<ClipResult(const ClipJob&)> record;    // writes job.out whole or not at all
    std::function<Json(const ClipJob&)> recipe;          // all that decides the bytes of a clip
    std::function<ClipMotions(const ClipJob&)> motions;  // throws what record would
};

}  // namespace chironomia::study
