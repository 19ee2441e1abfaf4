#include "study/cli/command_line.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <regex>

#include "study/cli/options/option_values.h"
#include "tests/support/support.h"

namespace chironomia::study {
namespace {

using ::testing::HasSubstr;
using testing::refusal_of;

CommandLine parse(std::vector<const char*> words) {
    words.insert(words.begin(), "chironomia");
    return parse_command_line(static_cast<int>(words.size()), words.data());
}

TEST(ParseCommandLine, FillsARenderJob) {
    const CommandLine line =
        parse({"render",      "--motion",   "a.bvh",   "--audio", "a.wav",    "--size",       "640x480",
               "--fps",       "25",         "--body",  "upper",   "--frames", "10:20",        "--gl",
               "egl",         "--up",       "z",       "--unit",  "cm",       "--motion-fps", "15",
               "--face-mode", "mouth-blur", "--hands", "hidden",  "--out",    "a.mp4"});
    ASSERT_TRUE(line.command) << line.text;
    const ClipJob& job = std::get<RenderCommand>(*line.command).job;
    ASSERT_EQ(job.performers.size(), 1u);
    EXPECT_EQ(job.performers[0].motion, "a.bvh");
    EXPECT_EQ(job.audio, "a.wav");
    EXPECT_EQ(job.size.width, 640);
    EXPECT_EQ(job.size.height, 480);
    EXPECT_EQ(job.fps, (Rate{25, 1}));
    EXPECT_TRUE(job.upper_body);
    EXPECT_EQ(job.frames.first, 10u);
    EXPECT_EQ(job.frames.last, 20u);
    EXPECT_EQ(job.gl, GlBackend::egl);
    EXPECT_EQ(job.drawing.renderer, RendererKind::gl);
    EXPECT_EQ(job.performers[0].hints.up, UpAxis::z);
    EXPECT_EQ(job.performers[0].hints.unit, 0.01);
    EXPECT_EQ(job.performers[0].hints.fps, 15);
    EXPECT_EQ(job.performers[0].modes, (Modes{FaceMode::mouth_blur, HandsMode::hidden}));
    EXPECT_EQ(job.out, "a.mp4");
}

// On the command line a reading of a paper has a name, in checkpoints its number.
TEST(ParseCommandLine, NamesTheReadingsOfPapers) {
    const CommandLine line = parse({"train", "amii", "--corpus", "c", "--out", "m.safetensors",
                                    "--output-layer", "per_person", "--option", "pitch-input=rise"});
    ASSERT_TRUE(line.command) << line.text;
    const ModelOptions wanted = {{"A25", "per_person"}, {"A40", "rise"}};
    EXPECT_EQ(std::get<TrainCommand>(*line.command).options, wanted);
}

TEST(ParseCommandLine, CutsMotionsAndSounds) {
    const CommandLine line = parse({"render", "--motion", "a.bvh", "--audio", "b.wav", "--cut", "1.5:4",
                                    "--audio-cut", ":3", "--loudness", "-23", "--out", "a.mp4"});
    ASSERT_TRUE(line.command) << line.text;
    const ClipJob& job = std::get<RenderCommand>(*line.command).job;
    EXPECT_EQ(job.cut->begin, 1.5);
    EXPECT_EQ(job.cut->end, 4);
    EXPECT_EQ(job.sound_cut->begin, 0);
    EXPECT_EQ(job.sound_cut->end, 3);
    EXPECT_EQ(job.loudness, -23);
    EXPECT_FALSE(job.silent);
    const CommandLine voices = parse({"render", "--motion", "a.bvh", "--audio", "a.wav", "--motion", "b.bvh",
                                      "--audio", "b.wav", "--audio-cut", "2:", "--silent", "--out", "a.mp4"});
    ASSERT_TRUE(voices.command) << voices.text;
    const ClipJob& two = std::get<RenderCommand>(*voices.command).job;
    EXPECT_TRUE(two.silent);
    EXPECT_EQ(two.performers.at(1).voice_cut->begin, 2);
    EXPECT_FALSE(two.performers.at(1).voice_cut->end);
}

TEST(ParseCommandLine, KnowsAnchors) {
    const CommandLine line = parse({"render", "--motion", "a.bvh", "--anchor", "damped:0.5", "--motion",
                                    "b.bvh", "--anchor", "frozen", "--out", "a.mp4"});
    ASSERT_TRUE(line.command) << line.text;
    const ClipJob& job = std::get<RenderCommand>(*line.command).job;
    EXPECT_EQ(job.performers.at(0).anchor, (Degradation{.kind = DegradationKind::damped, .amount = 0.5}));
    EXPECT_EQ(job.performers.at(1).anchor, Degradation{});
    const CommandLine wrong = parse({"render", "--motion", "a.bvh", "--anchor", "slow", "--out", "a.mp4"});
    EXPECT_EQ(wrong.exit_code, 2);
    EXPECT_THAT(wrong.text, HasSubstr("--anchor: \"slow\" is no anchor; write frozen,"));
    EXPECT_THAT(parse({"render", "--avatar", "a.glb", "--anchor", "frozen", "--out", "a.mp4"}).text,
                HasSubstr("--anchor: needs --motion or --face"));
}

TEST(ParseCommandLine, RefusesWhatIsSaidOfASoundWithoutOne) {
    for (const auto& [option, value] :
         std::vector<std::pair<const char*, const char*>>{{"--audio-cut", "1:2"}, {"--loudness", "-23"}}) {
        const CommandLine line = parse({"render", "--motion", "a.bvh", option, value, "--out", "a.mp4"});
        EXPECT_EQ(line.exit_code, 2);
        EXPECT_THAT(line.text, HasSubstr(std::string(option) + ": needs --audio"));
    }
    EXPECT_THAT(parse({"render", "--motion", "a.bvh", "--silent", "--out", "a.mp4"}).text,
                HasSubstr("--silent: needs --audio"));
}

TEST(ParseCut, SaysWhatItNeeds) {
    for (const char* text : {"", "3", "1:2:3", "a:2", "-1:2", "0:nan", "0:1e9"}) {
        EXPECT_EQ(refusal_of([&] { parse_cut(text); }),
                  "\"" + std::string(text) + "\" is no range of seconds; write BEGIN:END such as 2.5:10");
    }
    EXPECT_THAT(refusal_of([] { parse_cut("3:3"); }), HasSubstr("the end must come after the beginning"));
}

TEST(ParseCommandLine, KnowsTheRayTracer) {
    const CommandLine line = parse({"render", "--motion", "a.bvh", "--renderer", "rays", "--samples", "4",
                                    "--motion-blur", "0.5", "--out", "a.mp4"});
    ASSERT_TRUE(line.command) << line.text;
    EXPECT_EQ(std::get<RenderCommand>(*line.command).job.drawing,
              (Drawing{.renderer = RendererKind::rays, .samples = 4, .motion_blur = 0.5}));
}

TEST(ParseCommandLine, LetsAFilePlayItsOwnAnimationInTheSceneForObjects) {
    const CommandLine line = parse({"render", "--avatar", "a.glb", "--animation", "Walk", "--out", "a.mp4"});
    ASSERT_TRUE(line.command) << line.text;
    const ClipJob& job = std::get<RenderCommand>(*line.command).job;
    EXPECT_TRUE(plays_own_animation(job.performers.at(0)));
    EXPECT_EQ(job.performers[0].hints.animation, "Walk");
    EXPECT_EQ(job.scene, "object");
    const CommandLine full = parse({"render", "--avatar", "a.glb", "--scene", "full", "--out", "a.mp4"});
    EXPECT_EQ(std::get<RenderCommand>(*full.command).job.scene, "full");
}

TEST(ParseCommandLine, GivesEachOfTwoPeopleTheirOwn) {
    const CommandLine line =
        parse({"render",  "--motion", "a.bvh",  "--audio", "a.wav", "--motion", "b.npz",
               "--audio", "b.wav",    "--up",   "z",       "--up",  "y",        "--unit",
               "cm",      "--avatar", "me.vrm", "--scene", "dyad",  "--out",    "a.mp4"});
    ASSERT_TRUE(line.command) << line.text;
    const ClipJob& job = std::get<RenderCommand>(*line.command).job;
    ASSERT_EQ(job.performers.size(), 2u);
    EXPECT_EQ(job.performers[0].motion, "a.bvh");
    EXPECT_EQ(job.performers[1].motion, "b.npz");
    EXPECT_EQ(job.performers[0].hints.up, UpAxis::z);
    EXPECT_EQ(job.performers[1].hints.up, UpAxis::y);
    EXPECT_EQ(job.performers[0].voice, "a.wav");
    EXPECT_EQ(job.performers[1].voice, "b.wav");
    EXPECT_EQ(job.audio, std::nullopt);
    // An option that is given once holds for both.
    for (const Performer& performer : job.performers) {
        EXPECT_EQ(performer.avatar, "me.vrm");
        EXPECT_EQ(performer.hints.unit, 0.01);
    }
}

TEST(ParseCommandLine, LeavesOneSoundToTheClip) {
    const CommandLine line =
        parse({"render", "--motion", "a.bvh", "--motion", "b.bvh", "--audio", "a.wav", "--out", "a.mp4"});
    const ClipJob& job = std::get<RenderCommand>(*line.command).job;
    EXPECT_EQ(job.audio, "a.wav");
    EXPECT_EQ(job.performers[0].voice, std::nullopt);
}

TEST(ParseCommandLine, HelpOfEveryVerbShowsTwoExamples) {
    for (const std::vector<const char*>& verb :
         std::vector<std::vector<const char*>>{{"demo"},
                                               {"synth"},
                                               {"render"},
                                               {"convert"},
                                               {"compare"},
                                               {"info"},
                                               {"bench"},
                                               {"study", "build"},
                                               {"study", "check"},
                                               {"study", "plan"},
                                               {"study", "analyse"},
                                               {"study", "rehearse"}}) {
        std::vector<const char*> words = verb;
        words.push_back("--help");
        const CommandLine line = parse(words);
        EXPECT_EQ(line.exit_code, 0);
        const size_t first = line.text.find("\n  $ chironomia ");
        ASSERT_NE(first, std::string::npos) << line.text;
        EXPECT_NE(line.text.find("\n  $ chironomia ", first + 1), std::string::npos) << line.text;
    }
}

struct WrongLine {
    std::vector<const char*> words;
    const char* says;
};

TEST(ParseCommandLine, SaysWhatIsWrongAndExitsWithTwo) {
    const std::vector<WrongLine> lines = {
        {{}, "Each verb has its own --help with examples."},
        {{"rendr"},
         "\"rendr\" is no verb (did you mean render?); the verbs are demo, synth, corpus, render, convert,"},
        {{"render", "--out", "a.mp4"}, "--motion, --face or --avatar is required"},
        {{"render", "--animation", "1", "--out", "a.mp4"}, "--motion, --face or --avatar is required"},
        {{"render", "--face", "a.csv", "--animation", "1", "--out", "a.mp4"},
         "--animation: cannot be combined with --face: it names an animation of --motion or of the avatar's own "
         "file; leave one of them out"},
        {{"render", "--avatar", "a.glb", "--hands", "hidden", "--out", "a.mp4"},
         "--hands: needs --motion or --face"},
        {{"render", "--avatar", "a.glb", "--up", "z", "--out", "a.mp4"}, "--up: needs --motion or --face"},
        {{"convert", "--out", "a.glb"}, "--motion or --face is required"},
        {{"render", "--face", "f.csv", "--out", "a.mp4", "--face-gain", "12"},
         "\"12\" is no gain of an action unit"},
        {{"render", "--face", "f.csv", "--out", "a.mp4", "--face-head", "off"},
         "\"off\" is none of add, keep, replace"},
        {{"render", "--motion", "a.bvh", "--out", "a.mp4", "--gl", "egl", "--renderer", "tiles"},
         "--gl: works with --renderer gl alone"},
        {{"study", "build", "p.json", "--out", "o", "--seed", ""}, "--seed: \"\" is no seed"},
        {{"study", "build", "p.json", "--out", "o", "--seed", "-1"}, "--seed: \"-1\" is no seed"},
        {{"study", "build", "p.json", "--out", "o", "--seed", "1.5"}, "\"1.5\" is no seed; write a whole"},
        {{"study", "build", "p.json", "--out", "o", "--seed", "18446744073709551616"},
         "is no seed; write a whole number from 0 to 18446744073709551615"},
        {{"render", "--motion", "a.bvh"}, "--out is required"},
        {{"render", "--motion", "a.bvh", "--out", "a.mp4", "--colour", "red"},
         "there is no option --colour\n"},
        {{"render", "a.bvh", "-o", "a.mp4"}, "there is no option -o; did you mean --out?"},
        {{"render", "a.bvh", "--output=a.mp4"}, "there is no option --output; did you mean --out?"},
        {{"study", "build", "p.json", "--sed", "1"}, "there is no option --sed; did you mean --seed?"},
        {{"render", "--motion", "a.bvh", "--out", "a.mp4", "--size", "big"},
         "\"big\" is no size; write WIDTHxHEIGHT"},
        {{"render", "--motion", "a.bvh", "--out", "a.mp4", "--fps", "fast"}, "\"fast\" is no frame rate"},
        {{"render", "--motion", "a.bvh", "--out", "a.mp4", "--body", "half"},
         "\"half\" is none of full, upper"},
        {{"render", "--motion", "a.bvh", "--out", "a.mp4", "--gl", "glx"}, "\"glx\" is none of egl, osmesa"},
        {{"render", "--motion", "a.bvh", "--out", "a.mp4", "--face-mode", "pixels"},
         "\"pixels\" is none of au, blur, mask, mouth-blur, neutral"},
        {{"render", "--motion", "a.bvh", "--out", "a.mp4", "--hands", "gone"},
         "\"gone\" is none of hidden, motion, relaxed"},
        {{"render", "--motion", "a.bvh", "--out", "a.mp4", "--threads", "-1"}, "--threads"},
        {{"render", "--motion", "a.bvh", "--out", "a.mp4", "--renderer", "paint"},
         "\"paint\" is none of auto, gl, raster, rays, tiles"},
        {{"render", "--motion", "a.bvh", "--out", "a.mp4", "--renderer", "rays", "--samples", "0"},
         "--samples"},
        {{"render", "--motion", "a.bvh", "--out", "a.mp4", "--renderer", "rays", "--motion-blur", "2"},
         "--motion-blur"},
        {{"render", "--motion", "a.bvh", "--out", "a.mp4", "--samples", "4"},
         "--samples and --motion-blur: work with --renderer rays alone"},
        {{"render", "--motion", "a.bvh", "--out", "a.mp4", "--up", "w"}, "w"},
        {{"render", "--motion", "a.bvh", "--out", "a.mp4", "--motion-fps", "-1"},
         "\"-1\" is no frame rate; write a number above 0 such as 15"},
        {{"render", "--motion", "a", "--motion", "b", "--motion", "c", "--out", "a.mp4"},
         "--motion: is given 3 times (a, b, c), a clip shows at most 2 people; an option of several values is written "
         "before each of them"},
        {{"render", "--motion", "a", "--avatar", "b", "--avatar", "c", "--out", "a.mp4"},
         "--avatar: is given 2 times, but --motion once; give it once or as often as --motion"},
        {{"render", "--motion", "a", "--motion", "b", "--up", "x", "--up", "y", "--up", "z", "--out",
          "a.mp4"},
         "--up: is given 3 times, but --motion twice; give it once or as often as --motion"},
        {{"render", "--motion", "a", "--motion", "b", "--face", "c", "--out", "a.mp4"},
         "--face: is given once, but --motion twice; give it as often as --motion"},
        {{"render", "--motion", "a", "--audio", "b", "--audio", "c", "--out", "a.mp4"},
         "--audio: is given 2 times, but --motion once; give one sound, or two motions with a voice each"},
        {{"study", "build", "plan.json", "--out", "s"}, "--seed is required"},
        {{"study"}, "A subcommand is required"},
        {{"compare", "a.png"}, "b is required"},
        {{"compare", "a", "b", "--share", "2"}, "--share"},
        {{"compare", "a", "b", "--perceptual", "2"}, "--perceptual"},
        {{"compare", "a", "b", "--update", "--html", "r.html"}, "excludes --update"},
        {{"info", "a", "b"}, "b"},
        {{"convert", "--motion", "a.bvh", "--out", "b.h5", "--fps", "0"}, "--fps"},
        {{"convert", "--motion", "a.bvh", "--out", "b.h5", "--fps", "30", "--fps", "25"},
         "--fps is given more than once; give it once\n"},
        {{"study", "plan", "p.json", "--power", "--effect", "inf"}, "--effect: inf is no finite number"},
    };
    for (const WrongLine& wrong : lines) {
        const CommandLine line = parse(wrong.words);
        EXPECT_FALSE(line.command) << wrong.says;
        EXPECT_EQ(line.exit_code, 2);
        EXPECT_THAT(line.text, HasSubstr(wrong.says));
    }
}

// Options that take numbers show it in the help.
TEST(ParseCommandLine, RefusesWhatIsNoFiniteNumberInEveryVerb) {
    const std::regex option("\n +(--[a-z-]+) [^\n: ]*:(FLOAT in|POSITIVE|NUMBER)");
    std::size_t found = 0;
    for (const std::vector<const char*>& verb :
         std::vector<std::vector<const char*>>{{"synth"},
                                               {"render"},
                                               {"convert"},
                                               {"fit"},
                                               {"compare"},
                                               {"train"},
                                               {"study", "serve"},
                                               {"study", "plan"},
                                               {"study", "rehearse"}}) {
        std::vector<const char*> words = verb;
        words.push_back("--help");
        const std::string help = parse(words).text;
        for (std::sregex_iterator at(help.begin(), help.end(), option); at != std::sregex_iterator(); ++at) {
            const std::string name = (*at)[1].str();
            words = verb;
            words.insert(words.end(), {name.c_str(), "nan"});
            const CommandLine line = parse(words);
            EXPECT_EQ(line.exit_code, 2);
            EXPECT_THAT(line.text, HasSubstr(name + ": nan is no finite number"));
            ++found;
        }
    }
    EXPECT_GE(found, 30u);
}

TEST(ParseSize, RefusesWhatIsNoPicture) {
    EXPECT_EQ(parse_size("1280x720").width, 1280);
    EXPECT_EQ(refusal_of([] { parse_size("1280"); }),
              "\"1280\" is no size; write WIDTHxHEIGHT such as 1280x720");
    EXPECT_EQ(refusal_of([] { parse_size("8x720"); }),
              "\"8x720\" has a side of 8 pixels; both must be 16 to 8192");
}

TEST(ParseFrameRange, TakesOpenEndsAndRefusesEmptyRanges) {
    EXPECT_EQ(parse_frame_range(":5").first, 0u);
    EXPECT_EQ(parse_frame_range("3:").last, std::nullopt);
    EXPECT_EQ(refusal_of([] { parse_frame_range("5:5"); }),
              "\"5:5\" is an empty range of frames; the end must come after the beginning");
    EXPECT_EQ(refusal_of([] { parse_frame_range("-1:5"); }),
              "\"-1:5\" is no range of frames; write FIRST:END such as 0:90, counted from 0");
    EXPECT_EQ(refusal_of([] { parse_frame_range("7"); }),
              "\"7\" is no range of frames; write FIRST:END such as 0:90, counted from 0");
}

TEST(ParseStrengths, TakesNamesWithCommas) {
    const auto strengths = parse_strengths("ours=1,ours, mismatched=-0.5");
    EXPECT_EQ(strengths.at("ours"), 1);
    EXPECT_EQ(strengths.at("ours, mismatched"), -0.5);
    EXPECT_EQ(refusal_of([] { parse_strengths("ours=much"); }),
              "\"ours=much\" is no list of strengths; write NAME=NUMBER,NAME=NUMBER");
    EXPECT_EQ(refusal_of([] { parse_strengths("ours=1,ours=2"); }),
              "\"ours=1,ours=2\" names \"ours\" twice; give each one strength");
}

TEST(ParseClipRate, RefusesWhatIsNoRate) {
    EXPECT_EQ(parse_clip_rate("30000/1001"), (Rate{30000, 1001}));
    EXPECT_EQ(refusal_of([] { parse_clip_rate("0"); }),
              "\"0\" is no frame rate; write a number above 0 and up to 1000 such as 30 or 30000/1001");
}

}  // namespace
}  // namespace chironomia::study
