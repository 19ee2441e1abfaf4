#include "study/cli/options/people_options.h"

#include <algorithm>
#include <map>
#include <utility>

#include "core/error.h"
#include "core/text.h"
#include "skinning/lift/lift.h"
#include "skinning/signal/smooth.h"
#include "study/cli/options/option_kinds.h"
#include "study/cli/options/option_values.h"

namespace chironomia::study {
namespace {

constexpr std::size_t kMostPeople = 2;

const HintOption kHintOptions[] = {
    {"--motion-fps", "R",
     "Frames per second of a motion, in place of the rate that it carries; given once for two people, it applies "
     "to the motion that has no rate",
     [](MotionHints& hints, const std::string& text) { hints.fps = parse_motion_rate(text); }},
    {"--up", "AXIS", "Up axis of the motion: auto, x, y, z, -x, -y or -z [auto]",
     [](MotionHints& hints, const std::string& text) { hints.up = up_axis_named(text); }},
    {"--unit", "U", "Unit of the motion: m, dm, cm, mm, inch, foot, or metres as a number [detected]",
     [](MotionHints& hints, const std::string& text) { hints.unit = unit_named(text); }},
    {"--facing", "TURN",
     "Turn the motion about the up axis: cw, ccw, flip, none, or degrees [until it faces the camera]",
     [](MotionHints& hints, const std::string& text) { hints.turn_deg = turn_named(text); }},
    {"--names", "F.json", "JSON file that maps the motion's keypoint names to ours",
     [](MotionHints& hints, const std::string& text) { hints.name_map = text; }},
    {"--picture-size", "WxH", "Pixels of the picture in which the points of a motion were found [unknown]",
     [](MotionHints& hints, const std::string& text) { hints.picture.size = picture_size_named(text); }},
    {"--field-of-view", "DEG",
     "Degrees that the camera of that picture showed across its longer side [unknown]",
     [](MotionHints& hints, const std::string& text) {
         hints.picture.field_of_view = field_of_view_named(text);
     }},
    {"--lift-filter", "HZ",
     "Zero-phase filter of a motion that is lifted out of a picture: auto, off, or its cutoff in Hz [auto]",
     [](MotionHints& hints, const std::string& text) { hints.lift_cutoff = lift_cutoff_named(text); }},
    {"--smooth", "HZ",
     "Smooth a motion that comes in as 3D by a zero-phase low-pass at this cutoff [nothing]",
     [](MotionHints& hints, const std::string& text) { hints.smoothing = smoothing_named(text); }},
    {"--animation", "NAME|N",
     "Which animation of a glTF file, as a motion or the avatar's own, by name or by number from 0 as info lists "
     "them [of a motion the first that moves, of an avatar the first]",
     [](MotionHints& hints, const std::string& text) { hints.animation = text; }},
};

const std::map<std::string, HeadTurn> kHeadTurns = {
    {"replace", HeadTurn::replace}, {"add", HeadTurn::add}, {"keep", HeadTurn::keep}};
const char* const kFaceHelp = "A face for the motion: action units, head turns, gaze [the motion's own]";
const char* const kFaceGainHelp = "Show action units stronger or weaker, such as 12=1.3,1=1.5 [1]";
const char* const kFaceHeadHelp =
    "The face's head turns are added to the body's, are left out, or replace them [replace]";

std::string times(std::size_t count) {
    return count == 1 ? "once" : format("{} times", count);
}

}  // namespace

std::span<const HintOption> hint_options() {
    return kHintOptions;
}

void add_motion_hints(CLI::App& verb, MotionHints& hints) {
    for (const HintOption& option : hint_options()) {
        const auto read = [&hints, option](const std::string& text) { option.read(hints, text); };
        add_read_option(verb, option.name, read, option.help)->type_name(option.type);
    }
}

CLI::Option* PeopleOptions::add(CLI::App& verb, const PersonOption& option) {
    const std::string name = option.names.substr(option.names.find('-'));
    // A list does not move when it grows, so CLI11 may write into it.
    Given& given = given_.emplace_back(Given{.name = name, .option = option, .texts = {}});
    return verb.add_option(option.names, given.texts, option.help)
        ->type_name(option.type)
        ->allow_extra_args(false);
}

bool PeopleOptions::has(const std::string& name) const {
    return std::any_of(given_.begin(), given_.end(),
                       [&](const Given& given) { return given.name == name && !given.texts.empty(); });
}

std::vector<Performer> PeopleOptions::make() const {
    const Given* counted = &given_.front();
    for (const Given& given : given_) {
        if (counted->texts.empty() && given.option.is_of_one) counted = &given;
    }
    const std::size_t count = counted->texts.size();
    if (count > kMostPeople) {
        throw CLI::ValidationError(
            counted->name,
            format(
                "is given {} times ({}), a clip shows at most {} people; an option of several values is written "
                "before each of them",
                count, join(counted->texts), kMostPeople));
    }
    std::vector<Performer> people(std::max<std::size_t>(count, 1));
    for (const Given& given : given_) distribute(given, *counted, people);
    return people;
}

void PeopleOptions::distribute(const Given& given, const Given& counted, std::vector<Performer>& people) {
    const std::size_t count = given.texts.size();
    if (count == 0) return;
    if (count != people.size() && (count != 1 || given.option.is_of_one)) {
        throw CLI::ValidationError(
            given.name, format("is given {}, but {} {}; give it {}as often as {}", times(count), counted.name,
                               people.size() == 1 ? "once" : "twice",
                               given.option.is_of_one ? "" : "once or ", counted.name));
    }
    for (std::size_t i = 0; i < people.size(); ++i) {
        if (count < people.size()) {
            MotionHints& hints = people[i].hints;
            hints.fps_where_missing |= given.name == "--motion-fps";
            hints.of_several |= given.name == "--names" || given.name == "--lift-filter";
        }
        try {
            given.option.read(people[i], given.texts[count == 1 ? 0 : i]);
        } catch (const Error& error) {
            throw CLI::ValidationError(given.name, error.what());
        }
    }
}

void add_face(CLI::App& verb, std::optional<std::filesystem::path>& face, FaceOptions& options) {
    verb.add_option("--face", face, kFaceHelp)->type_name("F");
    add_read_option(
        verb, "--face-gain", [&options](const std::string& text) { options.gains = parse_face_gains(text); },
        kFaceGainHelp)
        ->type_name("AU=G,...");
    add_choice<HeadTurn>(verb, "--face-head", options.head, kHeadTurns)->description(kFaceHeadHelp);
}

void add_faces(CLI::App& verb, PeopleOptions& people) {
    people.add(verb, {.names = "--face",
                      .type = "F",
                      .help = kFaceHelp,
                      .read = [](Performer& person, const std::string& text) { person.face = text; },
                      .is_of_one = true});
    people.add(verb, {.names = "--face-gain",
                      .type = "AU=G,...",
                      .help = kFaceGainHelp,
                      .read = [](Performer& person, const std::string& text) {
                          person.face_options.gains = parse_face_gains(text);
                      }});
    people.add(verb, {.names = "--face-head",
                      .type = "add|keep|replace",
                      .help = kFaceHeadHelp,
                      .read = [](Performer& person, const std::string& text) {
                          person.face_options.head = meaning_of(text, kHeadTurns);
                      }});
}

void add_modes(CLI::App& verb, PeopleOptions& people) {
    people.add(verb, {.names = "--face-mode",
                      .type = join(keys_of(face_modes()), "|"),
                      .help = "au shows the face as driven, neutral at rest, the others hide it [au]",
                      .read = [](Performer& person, const std::string& text) {
                          person.modes.face_mode = meaning_of(text, face_modes());
                      }});
    people.add(verb, {.names = "--hands",
                      .type = join(keys_of(hands_modes()), "|"),
                      .help = "relaxed holds the fingers still, hidden puts mitts over the hands [motion]",
                      .read = [](Performer& person, const std::string& text) {
                          person.modes.hands = meaning_of(text, hands_modes());
                      }});
}

void add_anchors(CLI::App& verb, PeopleOptions& people) {
    people.add(
        verb,
        {.names = "--anchor",
         .type = "frozen|mirrored|delayed:MS|damped:X|jittered:DEG[:SEED]",
         .help =
             "Make the motion worse in a known way: frozen in its mean posture, mirrored, delayed against the "
             "sound by milliseconds, damped towards its mean posture by a factor, jittered by degrees",
         .read = [](Performer& person, const std::string& text) {
             person.anchor = degradation_named(text);
         }});
}

// One sound belongs to the clip; two are the voices of its two people.
void distribute_sounds(const std::vector<std::string>& sounds, ClipJob& job) {
    if (sounds.size() > job.performers.size()) {
        throw CLI::ValidationError("--audio",
                                   format("is given {} times, but --motion {}; give one sound, or "
                                          "two motions with a voice each",
                                          sounds.size(), job.performers.size() == 1 ? "once" : "twice"));
    }
    if (sounds.size() == 1) job.audio = sounds.front();
    for (std::size_t i = 0; sounds.size() > 1 && i < sounds.size(); ++i) job.performers[i].voice = sounds[i];
}

}  // namespace chironomia::study
