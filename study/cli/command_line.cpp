#include "study/cli/command_line.h"

#include <CLI/CLI.hpp>

#include <algorithm>
#include <memory>

#include "core/text.h"
#include "core/version.h"
#include "raster/embree/ray_renderer.h"
#include "raster/ffmpeg/clip_writer.h"
#include "study/cli/corpus_verbs.h"
#include "study/cli/option_kinds.h"
#include "study/cli/option_values.h"
#include "study/cli/people_options.h"
#include "study/cli/study_verbs.h"
#include "study/cli/synth_verb.h"
#include "study/cli/train_verbs.h"

namespace chironomia {
namespace {

// Where a parsed verb leaves its command.
using Result = std::optional<Command>;

CLI::App* add_verb(CLI::App& app, const std::string& name, const std::string& what,
                   const std::string& examples) {
    CLI::App* verb = app.add_subcommand(name, what);
    verb->footer("Examples:\n" + examples);
    return verb;
}

// A motion, a face, or both.
void need_motion_or_face(const std::filesystem::path& motion,
                         const std::optional<std::filesystem::path>& face) {
    if (motion.empty() && !face) throw CLI::RequiredError("--motion or --face");
}

// What is said about a motion or a face has no meaning where the avatar's file plays its own animation, and
// the other way round.
void check_source_of_movement(const CLI::App& verb, const PeopleOptions& people, const ClipJob& job) {
    if (!plays_own_animation(job.performers.front())) {
        if (!people.has("--animation")) return;
        throw CLI::ValidationError("--animation",
                                   "is of the avatar's own file, but --motion or --face is given too; leave "
                                   "one of them out");
    }
    if (!people.has("--avatar")) throw CLI::RequiredError("--motion, --face or --avatar");
    std::vector<std::string> of_motions = {"--anchor",    "--body",      "--cue",  "--face-gain",
                                           "--face-head", "--face-mode", "--hands"};
    for (const HintOption& hint : hint_options()) of_motions.push_back(hint.name);
    for (const std::string& name : of_motions) {
        if (verb.count(name) > 0) throw CLI::ValidationError(name, "needs --motion or --face");
    }
}

void add_demo(CLI::App& app, Result& result) {
    auto command = std::make_shared<DemoCommand>();
    CLI::App* verb = add_verb(
        app, "demo", "Speak two texts, gesture them in two manners, and build a blinded A/B study of it",
        "  $ chironomia demo\n  $ chironomia demo --out /tmp/demo");
    verb->add_option("--out", command->out, "Folder of the study [chironomia-demo]")->type_name("DIR");
    verb->add_flag("--replace", command->replace,
                   "Replace another finished study there, if nobody answered it");
    verb->add_flag("--quiet", command->quiet, "No progress");
    verb->callback([&result, command] { result = *command; });
}

// Instructions to whoever watches.
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
    std::vector<std::string> of_people = {"--motion", "--face",   "--face-gain", "--face-head", "--face-mode",
                                          "--hands",  "--anchor", "--avatar",    "--animation", "--scene",
                                          "--cue",    "--body",   "--renderer",  "--gl"};
    for (const HintOption& hint : hint_options()) of_people.push_back(hint.name);
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

void add_render(CLI::App& app, Result& result) {
    auto command = std::make_shared<RenderCommand>();
    ClipJob& job = command->job;
    CLI::App* verb = add_verb(
        app, "render", "Render one clip or stack of frames from a motion",
        "  $ chironomia render --motion wave.bvh --audio hello.wav --out clip.mp4\n"
        "  $ chironomia render --motion a.npz --scene full --size 640x480 --out 'frames/%05d.png'\n"
        "  $ chironomia render --motion left.bvh --audio left.wav --motion right.bvh --audio right.wav "
        "--scene dyad --out talk.mp4\n"
        "  $ chironomia render --avatar model.gltf --animation Walk --out walk.mp4");
    auto people = std::make_shared<PeopleOptions>();
    people
        ->add(
            *verb, "--motion", [](Performer& person, const std::string& text) { person.motion = text; },
            "BVH, SMPL-X, glTF, keypoints in space or a picture, OpenPose, PATS, our .h5 [with --face the "
            "body stands; without, the "
            "avatar, which may be any glTF file, plays its own animation]; for two people twice, left "
            "and right, and so may be what says how to read it, --face, --audio and --avatar")
        ->type_name("M");
    for (const HintOption& option : hint_options()) {
        const auto read = [option](Performer& person, const std::string& text) {
            option.read(person.hints, text);
        };
        people->add(*verb, option.name, read, option.help)->type_name(option.type);
    }
    add_faces(*verb, *people);
    add_modes(*verb, *people);
    add_anchors(*verb, *people);
    auto sounds = std::make_shared<std::vector<std::string>>();
    verb->add_option("--audio", *sounds,
                     "WAV, FLAC, OGG or MP3 that goes with it; given twice, the voices of two people, heard "
                     "from their sides")
        ->allow_extra_args(false)
        ->type_name("WAV");
    people
        ->add(
            *verb, "--avatar", [](Performer& person, const std::string& text) { person.avatar = text; },
            "glTF, GLB or VRM file, a bundled name, or stick for a figure of lines [neutral]")
        ->type_name("A");
    people
        ->add(
            *verb, "--animation", [](Performer& person, const std::string& text) { person.animation = text; },
            "Without --motion and --face: which of its animations the avatar's file plays, by name or by "
            "number from 0 as info lists them [the first]; a file without any is shown still, for 1 s in "
            "a clip, in one picture of a stack")
        ->type_name("NAME|N");
    CLI::Option* scene =
        verb->add_option(
                "--scene", job.scene,
                "upper, full, head, object, for two people dyad or split, or a scene file [upper; object "
                "where a file plays its own animation: all that moves is in the picture]")
            ->type_name("S");
    add_choice<SpeakingCue>(*verb, "--cue", job.cue,
                            {{"none", SpeakingCue::none}, {"light", SpeakingCue::light}},
                            "light draws a soft bar under whoever of two voices speaks [none]");
    add_read_option(
        *verb, "--size", [&job](const std::string& text) { job.size = parse_size(text); },
        "Pixels [1280x720]")
        ->type_name("WxH");
    add_read_option(
        *verb, "--fps", [&job](const std::string& text) { job.fps = parse_clip_rate(text); },
        "Frames per second of the clip [30]")
        ->type_name("N");
    add_choice<bool>(*verb, "--body", job.upper_body, {{"full", false}, {"upper", true}},
                     "upper holds root and legs still [full]");
    add_read_option(
        *verb, "--frames", [&job](const std::string& text) { job.frames = parse_frame_range(text); },
        "Only frames A to B - 1 of the clip")
        ->type_name("A:B");
    add_cuts(*verb, job);
    add_notices(*verb, job);
    auto film = std::make_shared<std::filesystem::path>();
    verb->add_option(
            "--film", *film,
            "Instead of a motion: a film of a person, fitted into the picture with black around it and "
            "brought to the clip's rate; its own sound is heard only if it is given as --audio")
        ->type_name("F");
    add_choice<RendererKind>(*verb, "--renderer", job.drawing.renderer,
                             {{"raster", RendererKind::raster}, {"rays", RendererKind::rays}},
                             "rays: slower, with soft light and real shadows [raster]");
    CLI::Option* samples =
        verb->add_option("--samples", job.drawing.samples, "With rays: samples a pixel, 1 to 1024 [16]")
            ->type_name("N")
            ->check(CLI::Range(1, kMostRaySamples));
    CLI::Option* blur = verb->add_option("--motion-blur", job.drawing.motion_blur,
                                         "With rays: share of a frame that the shutter is open, 0 to 1 [0]")
                            ->type_name("S")
                            ->check(CLI::Range(0.0, 1.0));
    add_choice<GlBackend>(*verb, "--gl", job.gl, {{"osmesa", GlBackend::osmesa}, {"egl", GlBackend::egl}},
                          "Which OpenGL draws; the same bytes [osmesa, or egl where Mesa has no OSMesa]");
    verb->add_option("--threads", job.threads, "Threads that draw and write; 0: all cores [0]")
        ->type_name("N")
        ->check(CLI::Range(0, 256));
    verb->add_option("--report", command->report, "Write how well the avatar follows the motion")
        ->type_name("F.json");
    verb->add_option("--out", job.out, "clip.mp4, clip.webm, or a stack such as DIR/%05d.png")
        ->type_name("FILE")
        ->required();
    verb->add_flag("--quiet", job.quiet, "No progress");
    verb->callback([&result, command, people, sounds, film, samples, blur, scene, verb] {
        const bool of_rays = samples->count() > 0 || blur->count() > 0;
        if (of_rays && command->job.drawing.renderer != RendererKind::rays)
            throw CLI::ValidationError("--samples and --motion-blur", "are known to --renderer rays alone");
        command->job.performers = people->make();
        if (film->empty()) {
            check_source_of_movement(*verb, *people, command->job);
        } else {
            take_film(*verb, command->job, *film);
        }
        if (plays_own_animation(command->job.performers.front()) && scene->count() == 0)
            command->job.scene = "object";
        distribute_sounds(*sounds, command->job);
        check_sounds(command->job);
        result = *command;
    });
}

// Where the camera of a projection stands.
void add_picture_camera(CLI::App& verb, std::optional<PictureCamera>& camera) {
    const auto number = [&verb, &camera](const std::string& name, const std::string& type,
                                         const std::string& help, const CLI::Range& range,
                                         double PictureCamera::*value) {
        const auto set = [&camera, value](double given) {
            if (!camera) camera.emplace();
            (*camera).*value = given;
        };
        verb.add_option_function<double>(name, set, help)->type_name(type)->check(range);
    };
    add_read_option(
        verb, "--camera",
        [&camera](const std::string& text) {
            if (!camera) camera.emplace();
            camera->perspective = meaning_of<bool>(text, {{"pinhole", true}, {"weak", false}});
        },
        "For OpenPose: pinhole, or weak perspective, which shows all at one size [pinhole]")
        ->type_name("pinhole|weak");
    add_read_option(
        verb, "--size",
        [&camera](const std::string& text) {
            if (!camera) camera.emplace();
            const RenderSize size = parse_size(text);
            camera->size = Vec2(size.width, size.height);
        },
        "For OpenPose: pixels of the picture [1280x720]")
        ->type_name("WxH");
    number("--focal", "PX", "For OpenPose: focal length [1280]", CLI::Range(1.0, 1e6), &PictureCamera::focal);
    number("--distance", "M", "For OpenPose: from camera to person [4]", CLI::Range(0.1, 1000.0),
           &PictureCamera::distance);
    number("--yaw", "DEG", "For OpenPose: degrees from the front to the person's left [0]",
           CLI::Range(-180.0, 180.0), &PictureCamera::yaw_deg);
}

void add_convert(CLI::App& app, Result& result) {
    auto command = std::make_shared<ConvertCommand>();
    CLI::App* verb = add_verb(app, "convert", "Convert a motion, or bake it into an avatar",
                              "  $ chironomia convert --motion a.npz --out a.bvh\n"
                              "  $ chironomia convert --motion a.bvh --avatar female --out a.glb\n"
                              "  $ chironomia convert --motion a.bvh --yaw 30 --out a_openpose");
    verb->add_option("--motion", command->motion, "A motion of any form that render reads, or animated glTF")
        ->type_name("M");
    add_motion_hints(*verb, command->hints);
    add_face(*verb, command->face, command->face_options);
    verb->add_option("--fps", command->fps, "Frames per second of the result [the motion's own]")
        ->type_name("N")
        ->check(CLI::PositiveNumber);
    verb->add_option("--avatar", command->avatar,
                     "The avatar that a GLB animates, or whose skeleton a BVH moves; none: the motion's own "
                     "skeleton as GLB")
        ->type_name("A");
    verb->add_flag("--lift", command->lift,
                   "Bring the points of a picture into space, for .h5 and .csv; .bvh and .glb do so anyway");
    add_choice<bool>(*verb, "--bvh-names", command->mocapnet_names, {{"own", false}, {"mocapnet", true}},
                     "Joint names in a BVH: as they are, or hip, lShldr, ... as MocapNET has them [own]");
    add_picture_camera(*verb, command->camera);
    verb->add_option("--report", command->report, "Write how well the avatar follows the motion")
        ->type_name("F.json");
    verb->add_option("--out", command->out,
                     "X.bvh, X.glb, X.h5, X.csv, or a folder of OpenPose: a name without "
                     "ending")
        ->type_name("FILE")
        ->required();
    verb->callback([&result, command] {
        need_motion_or_face(command->motion, command->face);
        result = *command;
    });
}

void add_fit(CLI::App& app, Result& result) {
    auto command = std::make_shared<FitCommand>();
    FitJob& job = command->job;
    CLI::App* verb =
        add_verb(app, "fit",
                 "Judge how well motions fit an avatar, and whether they may be shown; exit 1 if one may not",
                 "  $ chironomia fit motions/ --avatar neutral --report page.html\n"
                 "  $ chironomia fit wave.bvh openpose/ --motion-fps 24 --json");
    verb->add_option("motions", job.motions, "Motions, or folders of them")->type_name("M")->required();
    add_motion_hints(*verb, job.hints);
    verb->add_option("--avatar", job.avatar, "glTF, GLB or VRM file, or a bundled name [neutral]")
        ->type_name("A");
    verb->add_option("--fps", job.fps, "Frames per second of the fit [the motion's own]")
        ->type_name("N")
        ->check(CLI::PositiveNumber);
    add_choice<bool>(*verb, "--body", job.upper_body, {{"full", false}, {"upper", true}},
                     "upper holds root and legs still [full]");
    verb->add_option("--report", command->report, "Write a page with pictures (.html), or JSON")
        ->type_name("FILE");
    verb->add_flag("--json", command->json, "Print JSON");
    verb->add_flag("--quiet", job.quiet, "No progress");
    verb->callback([&result, command] { result = *command; });
}

// How much two frames may differ.
void add_limits(CLI::App& verb, CompareOptions& options) {
    CompareLimits& limits = options.limits;
    verb.add_option("--step", limits.large_step, "No colour may differ by more, of 255 [3]")
        ->type_name("N")
        ->check(CLI::Range(0, 255));
    verb.add_option("--small-step", limits.small_step, "Pixels that differ by more are counted, of 255 [1]")
        ->type_name("N")
        ->check(CLI::Range(0, 255));
    verb.add_option("--share", limits.share_above_small, "Share of the pixels that may be counted [0.0002]")
        ->type_name("X")
        ->check(CLI::Range(0.0, 1.0));
    verb.add_option(
            "--perceptual", options.seen_share,
            "Pass a frame beyond these limits if a viewer sees at most this share of its pixels differ")
        ->type_name("X")
        ->check(CLI::Range(0.0, 1.0));
}

void add_compare(CLI::App& app, Result& result) {
    auto command = std::make_shared<CompareCommand>();
    CLI::App* verb = add_verb(
        app, "compare", "Compare frames, stacks, clips or folders of them; exit 1 if they differ",
        "  $ chironomia compare expected.png actual.png\n"
        "  $ chironomia compare references/ results/ --diff differences --junit r.xml --html r.html\n"
        "  $ chironomia compare references/ results/ --update");
    verb->add_option("a", command->a, "What is expected: a frame, a clip, or a folder of them")
        ->type_name("A")
        ->required();
    verb->add_option("b", command->b, "What is compared with it")->type_name("B")->required();
    SetOptions& options = command->options;
    add_limits(*verb, options.compare);
    const std::vector<CLI::Option*> reports = {
        verb->add_option("--diff", options.difference_folder, "Write pictures of the differences here")
            ->type_name("DIR"),
        verb->add_option("--junit", command->junit, "Write JUnit XML, a case for each frame")
            ->type_name("F.xml"),
        verb->add_option("--html", command->html, "Write one page that shows what differs, side by side")
            ->type_name("F.html")};
    CLI::Option* update = verb->add_flag("--update", command->update, "Make B the new reference A instead");
    for (CLI::Option* report : reports) report->excludes(update);
    verb->add_flag("--json", command->json, "Print JSON");
    verb->add_flag("--quiet", options.quiet, "No progress");
    verb->callback([&result, command] { result = *command; });
}

void add_info(CLI::App& app, Result& result) {
    auto command = std::make_shared<InfoCommand>();
    CLI::App* verb = add_verb(app, "info", "Say what an avatar, motion, sound, clip, model or corpus holds",
                              "  $ chironomia info avatar.glb\n  $ chironomia info motion.bvh --json");
    verb->add_option("file", command->file, "The file, or the name of a bundled avatar")
        ->type_name("FILE")
        ->required();
    add_motion_hints(*verb, command->hints);
    verb->add_flag("--json", command->json, "Print JSON");
    verb->callback([&result, command] { result = *command; });
}

void add_bench(CLI::App& app, Result& result) {
    auto command = std::make_shared<BenchCommand>();
    CLI::App* verb = add_verb(app, "bench", "Measure the program on this machine, here and now",
                              "  $ chironomia bench\n  $ chironomia bench --json");
    verb->add_flag("--json", command->json, "Print JSON");
    verb->callback([&result, command] { result = *command; });
}

void add_study(CLI::App& app, Result& result) {
    CLI::App* study = add_verb(app, "study", "Build, check, run, rehearse and analyse blinded studies",
                               "  $ chironomia study build plan.json --out study --seed 1\n"
                               "  $ chironomia study check study\n"
                               "  $ chironomia study serve study");
    study->require_subcommand(1);

    auto build = std::make_shared<StudyBuildCommand>();
    CLI::App* verb = add_verb(*study, "build", "Render the clips of a plan and lay out its pages",
                              "  $ chironomia study build plan.json --out study --seed 1\n"
                              "  $ chironomia study build plan.json --out study --seed 1 --jobs 2");
    verb->add_option("plan", build->plan, "The plan")->type_name("PLAN.json")->required();
    verb->add_option("--out", build->out, "Folder of the study")->type_name("DIR")->required();
    verb->add_option("--seed", build->seed, "Decides tokens, sides and orders; keep it secret")
        ->type_name("N")
        ->required();
    verb->add_option("--jobs", build->jobs, "Clips rendered at a time [1]")
        ->type_name("N")
        ->check(CLI::Range(1, 256));
    verb->add_flag("--replace", build->replace,
                   "Replace a finished study of another seed, plan, input or program, if nobody answered it");
    verb->add_flag("--quiet", build->quiet, "No progress");
    verb->callback([&result, build] { result = *build; });

    auto check = std::make_shared<StudyCheckCommand>();
    verb = add_verb(*study, "check", "Prove that a study is blind, complete and balanced; exit 1 if not",
                    "  $ chironomia study check study\n  $ chironomia study check study --again plan.json");
    verb->add_option("study", check->study, "Folder of the study")->type_name("DIR")->required();
    CLI::Option* again =
        verb->add_option(
                "--again", check->again,
                "The plan: build the study again, in a folder that is removed, and compare every byte")
            ->type_name("PLAN.json");
    verb->add_option("--jobs", check->jobs, "Clips rendered at a time [1]")
        ->type_name("N")
        ->check(CLI::Range(1, 256))
        ->needs(again);
    verb->add_flag("--json", check->json, "Print JSON");
    verb->callback([&result, check] { result = *check; });

    add_study_serve(*study, result);
    add_study_answers(*study, result);
    add_study_presets(*study, result);
    add_study_export(*study, result);
    add_study_plan(*study, result);
    add_study_analyse(*study, result);
    add_study_rehearse(*study, result);
}

// CLI11 would only say that a subcommand is required.
std::optional<std::string> unknown_verb(const CLI::App& app, int argc, const char* const* argv) {
    if (argc < 2 || std::string_view(argv[1]).starts_with('-')) return std::nullopt;
    std::vector<std::string> verbs;
    for (const CLI::App* verb : app.get_subcommands({})) verbs.push_back(verb->get_name());
    if (std::find(verbs.begin(), verbs.end(), argv[1]) != verbs.end()) return std::nullopt;
    const auto meant = nearest_name(argv[1], verbs);
    return format("\"{}\" is no verb{}; the verbs are {}", argv[1],
                  meant ? format(" (did you mean {}?)", *meant) : "", join(verbs));
}

// The program, and what it finds on this machine.
std::string describe_program() {
    const std::string_view torch = torch_version();
    std::string text = format(
        "chironomia {}\nOSMesa  {}\nEGL     {}\nEmbree  {}\nFFmpeg  {}\nTorch   {}\nBuilt with",
        program_version(), describe_gl(GlBackend::osmesa), describe_gl(GlBackend::egl), embree_version(),
        ffmpeg_version(), torch.empty() ? "none: built with CHIRONOMIA_LEARNING=OFF" : torch);
    for (const std::string_view library : split(library_versions(), ','))
        text += format("\n  {}", trim(library));
    return text;
}

}  // namespace

CommandLine parse_command_line(int argc, const char* const* argv) {
    CLI::App app(
        "Evaluation videos of synthesized gestures: offline, headless, blinded, the same bytes every time.",
        "chironomia");
    app.footer("Each verb has its own --help with examples.");
    app.set_version_flag("--version", describe_program);
    app.require_subcommand(1);
    Result result;
    add_demo(app, result);
    add_synth(app, result);
    add_corpus(app, result);
    add_render(app, result);
    add_convert(app, result);
    add_measure(app, result);
    add_fit(app, result);
    add_compare(app, result);
    add_info(app, result);
    add_bench(app, result);
    add_study(app, result);
    add_train(app, result);
    add_evaluate(app, result);
    if (const auto typo = unknown_verb(app, argc, argv)) {
        return {.command = {}, .text = *typo + "\n", .exit_code = kExitWrongCommandLine};
    }
    try {
        app.parse(argc, argv);
    } catch (const CLI::ParseError& problem) {
        std::ostringstream said, complained;
        const int code = app.exit(problem, said, complained);
        return {.command = {},
                .text = said.str() + complained.str(),
                .exit_code = code == 0 ? kExitYes : kExitWrongCommandLine};
    }
    return {.command = std::move(result), .text = {}, .exit_code = kExitYes};
}

}  // namespace chironomia
