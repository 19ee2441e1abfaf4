// chironomia render
#include <CLI/CLI.hpp>

#include <cstdio>
#include <memory>

#include "core/text.h"
#include "raster/embree/ray_renderer.h"
#include "study/cli/options/option_kinds.h"
#include "study/cli/options/option_values.h"
#include "study/cli/options/people_options.h"
#include "study/cli/verbs/verbs.h"
#include "study/clip/pipeline.h"

namespace chironomia::study {
namespace {

constexpr auto kOfMotions = "Motions and faces";  // group of options

// What is said about a motion or a face has no meaning where the avatar's file plays its own animation, and
// the other way round.
void check_source_of_movement(const CLI::App& verb, const PeopleOptions& people, const ClipJob& job) {
    if (!plays_own_animation(job.performers.front())) {
        if (people.has("--animation") && job.performers.front().motion.empty())
            throw CLI::ValidationError("--animation",
                                       "cannot be combined with --face: it names an animation of --motion "
                                       "or of the avatar's own file; leave one of them out");
        return;
    }
    if (!people.has("--avatar")) throw CLI::RequiredError("--motion, --face or --avatar");
    for (const std::string& name : options_in(verb, kOfMotions)) {
        if (name != "--animation" && verb.count(name) > 0)
            throw CLI::ValidationError(name, "needs --motion or --face");
    }
}

// How people move in the picture, and who of them speaks.
void add_travel(CLI::App& verb, ClipJob& job) {
    add_choice<SpeakingCue>(verb, "--cue", job.cue,
                            {{"none", SpeakingCue::none}, {"light", SpeakingCue::light}})
        ->description("light draws a soft bar under the person who speaks [none]");
    CLI::Option* body = add_choice<bool>(verb, "--body", job.upper_body, {{"full", false}, {"upper", true}})
                            ->description("upper holds root and legs still [full]");
    CLI::Option* follow = verb.add_flag_callback(
        "--follow", [&job] { job.travel = Travel::follow; },
        "The camera goes along with a person who walks, smoothly, and keeps them in the middle third");
    CLI::Option* in_place = verb.add_flag_callback(
        "--in-place", [&job] { job.travel = Travel::in_place; },
        "The hips stay over the place where they begin; the legs move");
    follow->excludes(in_place);
    follow->excludes(body);
    in_place->excludes(body);
    verb.add_flag("--no-interpenetration", job.no_interpenetration,
                  "Move hands and forearms out of the body where the motion puts them into it, smoothly");
}

// Instructions to the viewer.
void add_notices(CLI::App& verb, ClipJob& job) {
    const auto notice = [&job]() -> Notice& { return job.notice ? *job.notice : job.notice.emplace(); };
    const auto spoken = [&job]() -> SpokenNotice& { return job.spoken ? *job.spoken : job.spoken.emplace(); };
    CLI::Option* text = verb.add_option_function<std::string>(
        "--notice", [notice](const std::string& words) { notice().text = words; },
        "Burn a text into the picture, on a plate in its middle");
    text->type_name("TEXT");
    add_read_option(
        verb, "--notice-at",
        [notice](const std::string& seconds) {
            const Cut cut = parse_cut(seconds);
            notice().from = cut.begin;
            notice().to = cut.end;
        },
        "From A to B seconds of the clip [all of it]")
        ->type_name("A:B")
        ->needs(text);
    CLI::Option* words = verb.add_option_function<std::string>(
        "--say", [spoken](const std::string& said) { spoken().text = said; },
        "Let a synthetic voice speak a text over the sound, which is quieter meanwhile");
    words->type_name("TEXT");
    verb.add_option_function<double>(
            "--say-at", [spoken](double seconds) { spoken().at = seconds; },
            "From so many seconds of the clip on [0]")
        ->type_name("S")
        ->check(CLI::Range(0.0, 1e6))
        ->needs(words);
    verb.add_option_function<std::string>(
            "--say-language", [spoken](const std::string& language) { spoken().language = language; },
            "In this language: en-gb, en-us, fr, de, ... [en]")
        ->type_name("L")
        ->needs(words);
}

// A film replaces a person, so it excludes all options about that person.
void take_film(const CLI::App& verb, ClipJob& job, const std::filesystem::path& film) {
    std::vector<std::string> of_people = options_in(verb, kOfMotions);
    for (const char* name : {"--avatar", "--animation", "--scene", "--renderer", "--gl"})
        of_people.emplace_back(name);
    for (const std::string& name : of_people) {
        if (verb.count(name) > 0)
            throw CLI::ValidationError("--film", format("is shown as it is; leave {} out", name));
    }
    job.performers = {{.motion = {}, .film = film}};
}

// Options about a sound need a sound.
void check_sounds(ClipJob& job) {
    bool heard = job.audio.has_value();
    for (Performer& person : job.performers) {
        heard = heard || person.voice;
        if (person.voice) person.voice_cut = job.sound_cut;
    }
    if (heard) return;
    if (job.sound_cut) throw CLI::ValidationError("--audio-cut", "needs --audio");
    if (job.silent) throw CLI::ValidationError("--silent", "needs --audio");
    if (job.loudness) throw CLI::ValidationError("--loudness", "needs --audio");
}

// What part of motions and sounds is taken, and how loud it is.
void add_cuts(CLI::App& verb, ClipJob& job) {
    add_read_option(
        verb, "--cut", [&job](const std::string& text) { job.cut = parse_cut(text); },
        "Only what lies from A to B seconds of the motions, their faces and sounds [all]")
        ->type_name("A:B");
    add_read_option(
        verb, "--audio-cut", [&job](const std::string& text) { job.sound_cut = parse_cut(text); },
        "Only what lies from A to B seconds of --audio; what is missing is silent, what is too much is cut "
        "off [as --cut]")
        ->type_name("A:B");
    verb.add_flag("--silent", job.silent, "As long as with --audio, but without sound");
    verb.add_option("--loudness", job.loudness,
                    "Bring the sound to so many LUFS (EBU R 128), such as -23 [as it is]")
        ->type_name("L")
        ->check(CLI::Range(-70.0, 0.0));
}

// What the options of render are read into.
struct RenderOptions {
    RenderCommand command;
    PeopleOptions people;
    std::vector<std::string> sounds;
    std::filesystem::path film;  // empty: a motion is shown
};

// Motions and faces, with all that is said about them.
void add_people(CLI::App& verb, RenderOptions& options) {
    PeopleOptions& people = options.people;
    verb.option_defaults()->group(kOfMotions);
    CLI::Option* motion = people.add(
        verb,
        {.names = "motion,--motion",
         .type = "M",
         .help =
             "BVH, SMPL-X, glTF, keypoints in space or a picture, OpenPose, PATS, our .h5. Given twice, it shows two people, "
             "left and right. Each has options of reading it, --face, --audio and --avatar of their own [with --face "
             "the body stands still; without, the file of --avatar, which may be any glTF, plays its own animation, or is shown still "
             "for 1 s, in one picture of a stack]",
         .read = [](Performer& person, const std::string& text) { person.motion = text; }});
    motion->allow_extra_args();
    for (const HintOption& option : hint_options()) {
        const auto read = [option](Performer& person, const std::string& text) {
            option.read(person.hints, text);
        };
        people.add(verb, {.names = option.name, .type = option.type, .help = option.help, .read = read});
    }
    add_faces(verb, people);
    add_modes(verb, people);
    add_anchors(verb, people);
    add_travel(verb, options.command.job);
    verb.option_defaults()->group("Options");
}

// What people look like and sound like.
void add_sounds_and_avatars(CLI::App& verb, RenderOptions& options) {
    verb.add_option("--audio", options.sounds,
                    "WAV, FLAC, OGG or MP3 that goes with it; given twice, the voices of two people, heard "
                    "from their sides")
        ->allow_extra_args(false)
        ->type_name("WAV");
    options.people.add(
        verb, {.names = "--avatar",
               .type = "A",
               .help = "glTF, GLB or VRM file, a bundled name, or stick for a figure of lines [neutral]",
               .read = [](Performer& person, const std::string& text) { person.avatar = text; }});
}

void add_picture(CLI::App& verb, ClipJob& job) {
    verb.add_option("--scene", job.scene,
                    "upper, full, head, object, for two people dyad or split, or a scene file [upper; object "
                    "where a file plays its own animation: all that moves is in the picture]")
        ->type_name("S");
    add_read_option(
        verb, "--size", [&job](const std::string& text) { job.size = parse_size(text); }, "Pixels [1280x720]")
        ->type_name("WxH");
    add_read_option(
        verb, "--fps", [&job](const std::string& text) { job.fps = parse_clip_rate(text); },
        "Frames per second of the clip [30]")
        ->type_name("N");
    add_read_option(
        verb, "--frames", [&job](const std::string& text) { job.frames = parse_frame_range(text); },
        "Only frames A to B - 1 of the clip")
        ->type_name("A:B");
}

void add_drawing(CLI::App& verb, ClipJob& job) {
    add_choice<RendererKind>(verb, "--renderer", job.drawing.renderer, renderer_names())
        ->description(
            "tiles: on the processor; gl, also called raster: by OpenGL, on a GPU with --gl egl; rays: slower, with "
            "soft light and real shadows [auto: tiles, or gl with --gl]");
    verb.add_option("--samples", job.drawing.samples, "With rays: samples a pixel, 1 to 1024 [16]")
        ->type_name("N")
        ->check(CLI::Range(1, kMostRaySamples));
    verb.add_option("--motion-blur", job.drawing.motion_blur,
                    "With rays: share of a frame that the shutter is open, 0 to 1 [0]")
        ->type_name("S")
        ->check(CLI::Range(0.0, 1.0));
    add_choice<GlBackend>(verb, "--gl", job.gl, {{"osmesa", GlBackend::osmesa}, {"egl", GlBackend::egl}})
        ->description(
            "Which OpenGL draws; the same bytes without a GPU [osmesa, or egl where Mesa has no OSMesa]");
    verb.add_option("--threads", job.threads, "Threads that draw and write; 0: all cores [0]")
        ->type_name("N")
        ->check(CLI::Range(0, 256));
}

void add_output(CLI::App& verb, RenderCommand& command) {
    verb.add_option("--report", command.report, "Write how well the avatar follows the motion")
        ->type_name("F.json");
    verb.add_option("--out", command.job.out,
                    "clip.mp4, clip.webm, or a stack numbered from 0, such as DIR/%05d.png")
        ->type_name("FILE")
        ->required();
    verb.add_flag("--quiet", command.job.quiet, "No progress");
}

// --gl chooses its renderer; each renderer has options that no other has.
void check_drawing(const CLI::App& verb, RendererKind& chosen) {
    const bool by_gl = verb.count("--gl") > 0;
    if (by_gl && verb.count("--renderer") == 0) chosen = RendererKind::gl;
    if (by_gl && chosen != RendererKind::gl)
        throw CLI::ValidationError("--gl", "works with --renderer gl alone");
    const bool by_rays = verb.count("--samples") > 0 || verb.count("--motion-blur") > 0;
    if (by_rays && chosen != RendererKind::rays)
        throw CLI::ValidationError("--samples and --motion-blur", "work with --renderer rays alone");
}

// The command of options that fit together.
RenderCommand finish_command(const CLI::App& verb, const RenderOptions& options) {
    RenderCommand command = options.command;
    ClipJob& job = command.job;
    check_drawing(verb, job.drawing.renderer);
    job.performers = options.people.make();
    if (options.film.empty()) {
        check_source_of_movement(verb, options.people, job);
    } else {
        take_film(verb, job, options.film);
    }
    if (plays_own_animation(job.performers.front()) && verb.count("--scene") == 0) job.scene = "object";
    distribute_sounds(options.sounds, job);
    check_sounds(job);
    return command;
}

}  // namespace

void add_render(CLI::App& app, std::optional<Command>& result) {
    CLI::App* verb = add_verb(
        app, "render", "Render one clip or stack of frames from a motion",
        "  $ chironomia render --motion wave.bvh --audio hello.wav --out clip.mp4\n"
        "  $ chironomia render --motion a.npz --scene full --size 640x480 --out 'frames/%05d.png'\n"
        "  $ chironomia render --motion left.bvh --audio left.wav --motion right.bvh --audio right.wav "
        "--scene dyad --out talk.mp4\n"
        "  $ chironomia render --avatar model.gltf --animation Walk --out walk.mp4");
    auto options = std::make_shared<RenderOptions>();
    ClipJob& job = options->command.job;
    add_people(*verb, *options);
    add_sounds_and_avatars(*verb, *options);
    add_picture(*verb, job);
    add_cuts(*verb, job);
    add_notices(*verb, job);
    verb->add_option(
            "--film", options->film,
            "Instead of a motion: a film of a person, fitted into the picture with black around it and "
            "brought to the clip's rate; its own sound is heard only if it is given as --audio")
        ->type_name("F");
    add_drawing(*verb, job);
    add_output(*verb, options->command);
    verb->callback([&result, options, verb] { result = finish_command(*verb, *options); });
}

void announce_egl_fallback() {
    if (!has_osmesa())
        std::fputs("this machine has no OSMesa: EGL draws in its place, to the same bytes\n", stderr);
}

int run(const RenderCommand& command) {
    const ClipJob& job = command.job;
    const bool by_gl = job.drawing.renderer == RendererKind::gl && job.performers.front().film.empty();
    if (!job.quiet && by_gl && job.gl == GlBackend::any) announce_egl_fallback();
    const ClipResult clip = record_clip(command.job);
    warn(clip.warnings);
    if (command.report) write_json(*command.report, clip.report);
    print(command.job.out.string() + "\n");
    return kExitYes;
}

}  // namespace chironomia::study
