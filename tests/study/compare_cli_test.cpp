// chironomia compare as a runner of CI calls it, and the examples of docs/ci.md as they stand there.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cstdlib>

#include <sys/wait.h>

#include "core/files/files.h"
#include "core/files/json.h"
#include "core/text.h"
#include "raster/images/image_file.h"
#include "tests/raster/media_support.h"
#include "tests/study/process.h"
#include "tests/support/support.h"

namespace chironomia::study {
namespace {

namespace fs = std::filesystem;
using ::testing::HasSubstr;
using testing::Outcome;
using testing::run_chironomia;
using testing::source_dir;
using testing::TemporaryFolder;

void write_grey(const fs::path& file, int level) {
    Frame frame{.width = 16, .height = 16, .rgba = std::vector<std::uint8_t>(16 * 16 * 4, 255)};
    for (size_t i = 0; i < frame.rgba.size(); ++i) {
        if (i % 4 != 3) frame.rgba[i] = static_cast<std::uint8_t>(level);
    }
    write_image(file, frame);
}

class CompareCli : public ::testing::Test {
  protected:
    Outcome compare(const std::vector<std::string>& more = {}) const {
        std::vector<std::string> words = {"compare", (folder_ / "refs").string(), (folder_ / "res").string()};
        words.insert(words.end(), more.begin(), more.end());
        return run_chironomia(words);
    }
    std::string in(const std::string& name) const { return (folder_ / name).string(); }

    TemporaryFolder folder_;
};

TEST_F(CompareCli, WritesEveryReportAndExitsWithOne) {
    write_grey(folder_ / "refs/deep/a.png", 255);
    write_grey(folder_ / "refs/gone.png", 255);
    write_grey(folder_ / "res/deep/a.png", 200);
    const Outcome outcome =
        compare({"--diff", in("diff"), "--junit", in("report/r.xml"), "--html", in("report/r.html")});
    EXPECT_EQ(outcome.exit_code, 1);
    EXPECT_EQ(outcome.err, "");
    EXPECT_THAT(outcome.out, HasSubstr("different: deep/a.png: 256 of 256 pixels differ"));
    EXPECT_THAT(outcome.out, HasSubstr("missing: gone.png: "));
    EXPECT_THAT(outcome.out,
                HasSubstr("different: 0 of 1 frames within the limits, 1 missing; the worst is"));
    EXPECT_TRUE(fs::exists(folder_ / "diff/deep/a.png"));
    EXPECT_THAT(read_text(folder_ / "report/r.xml"), HasSubstr("failures=\"2\" errors=\"0\""));
    EXPECT_THAT(read_text(folder_ / "report/r.html"), HasSubstr("data:image/png;base64,"));
    const Json json = Json::parse(compare({"--json"}).out);
    EXPECT_EQ(json["missing"], 1);
    EXPECT_EQ(json["frames"][0]["pixels_above_large"], 256);
    EXPECT_EQ(json["others"][0]["name"], "gone.png");
}

TEST_F(CompareCli, ReportsOfEqualFoldersAreEqualBytesAndExitIsZero) {
    write_grey(folder_ / "refs/a.png", 255);
    write_grey(folder_ / "res/a.png", 255);
    EXPECT_EQ(compare({"--junit", in("1.xml"), "--html", in("1.html")}).exit_code, 0);
    EXPECT_EQ(compare({"--junit", in("2.xml"), "--html", in("2.html")}).exit_code, 0);
    EXPECT_EQ(read_text(folder_ / "1.xml"), read_text(folder_ / "2.xml"));
    EXPECT_EQ(read_text(folder_ / "1.html"), read_text(folder_ / "2.html"));
    EXPECT_THAT(read_text(folder_ / "1.html"), HasSubstr("1 of 1 the same"));
}

TEST_F(CompareCli, AFileThatCannotBeReadExitsWithThreeAfterTheReports) {
    write_grey(folder_ / "refs/a.png", 255);
    write_grey(folder_ / "res/a.png", 255);
    write_grey(folder_ / "refs/b.png", 255);
    write_text(folder_ / "res/b.png", "torn");
    const Outcome outcome = compare({"--junit", in("r.xml")});
    EXPECT_EQ(outcome.exit_code, 3);
    EXPECT_THAT(outcome.err, HasSubstr("chironomia: " + in("res/b.png") + ":"));
    EXPECT_THAT(read_text(folder_ / "r.xml"), HasSubstr("type=\"unreadable\""));
}

TEST_F(CompareCli, AViewerMayPassWhatTheLevelsRefuse) {
    write_grey(folder_ / "refs/a.png", 255);
    write_grey(folder_ / "res/a.png", 250);
    EXPECT_EQ(compare().exit_code, 1);
    const Outcome outcome = compare({"--perceptual", "0", "--json"});
    EXPECT_EQ(outcome.exit_code, 0) << outcome.out;
    EXPECT_EQ(Json::parse(outcome.out)["frames"][0]["pixels_seen"], 0);
    write_grey(folder_ / "res/a.png", 200);
    EXPECT_EQ(compare({"--perceptual", "0.99"}).exit_code, 1);
}

TEST_F(CompareCli, AcceptsResultsAsReferences) {
    write_grey(folder_ / "refs/a.png", 255);
    write_grey(folder_ / "res/a.png", 100);
    write_grey(folder_ / "res/b.png", 100);
    const Outcome outcome = compare({"--update"});
    EXPECT_EQ(outcome.exit_code, 0) << outcome.err;
    EXPECT_EQ(outcome.out, in("refs") + ": 1 changed, 1 added, 0 removed, 0 kept\n");
    EXPECT_EQ(compare().exit_code, 0);
    write_text(folder_ / "res/b.png", "torn");
    EXPECT_EQ(compare({"--update"}).exit_code, 3);
    fs::remove(folder_ / "res/b.png");
    EXPECT_EQ(Json::parse(compare({"--update", "--json"}).out)["removed"], 1);
}

// Clips of the same pictures that players show otherwise.
class ComparePlayback : public ::testing::Test {
  protected:
    void SetUp() override {
        testing::output_of(
            "ffmpeg -nostdin -v error -f lavfi -i testsrc=s=64x48:r=10:d=1 -c:v libx264 -bf 0 "
            "-pix_fmt yuv420p -colorspace bt709 " +
            testing::quoted(a()));
    }
    // What compare says of the clip and a copy that was made with these options.
    Outcome compare_copy(const std::string& options) const {
        testing::output_of("ffmpeg -nostdin -v error -y -i " + testing::quoted(a()) + " -c copy " + options +
                           " " + testing::quoted(b()));
        return run_chironomia({"compare", "--quiet", a().string(), b().string()});
    }
    std::string info() const { return run_chironomia({"info", b().string()}).out; }
    void expect_difference(const std::string& options, const std::string& says) const {
        const Outcome outcome = compare_copy(options);
        EXPECT_EQ(outcome.exit_code, 1) << options;
        EXPECT_THAT(outcome.out, HasSubstr(says));
    }
    fs::path a() const { return folder_ / "a.mp4"; }
    fs::path b() const { return folder_ / "b.mp4"; }

    TemporaryFolder folder_;
};

TEST_F(ComparePlayback, FindsFramesAtOtherTimes) {
    expect_difference("-bsf:v \"setts=ts=TS+if(eq(N\\,4)\\,0.02/TB\\,0)\"",
                      "a.mp4: shows frame 4 after 0.400 s, " + b().string() +
                          " after 0.420 s; write both with the same time stamps");
    EXPECT_EQ(compare_copy("-bsf:v \"setts=ts=TS+if(eq(N\\,4)\\,0.005/TB\\,0)\"").exit_code, 0)
        << "what clocks of files round is no difference";
}

TEST_F(ComparePlayback, FindsAnotherShapeOfPixels) {
    expect_difference(
        "-bsf:v h264_metadata=sample_aspect_ratio=2/1 -aspect 8/3",
        "a.mp4: has pixels of 1:1, " + b().string() + " of 2:1; write both with pixels of one shape");
    EXPECT_THAT(info(), HasSubstr("\nshown      pixels of 2:1\n"));
}

TEST_F(ComparePlayback, FindsPicturesThatAreTurned) {
    expect_difference("-metadata:s:v:0 rotate=180", "a.mp4: is to be shown turned by 0 degrees, " +
                                                        b().string() +
                                                        " by 180 degrees; write both to be shown alike");
    EXPECT_THAT(info(), HasSubstr("\nshown      turned by 180 degrees\n"));
}

TEST_F(ComparePlayback, FindsOtherTagsOfColour) {
    expect_difference(
        "-bsf:v h264_metadata=colour_primaries=9:transfer_characteristics=13:matrix_coefficients=1",
        "a.mp4: has colours of transfer bt709 and primaries bt709, " + b().string() +
            " of transfer iec61966-2-1 and primaries bt2020; write both with the same tags");
    EXPECT_THAT(info(), HasSubstr("\ncolours    transfer iec61966-2-1, primaries bt2020\n"));
    EXPECT_EQ(compare_copy(
                  "-bsf:v h264_metadata=colour_primaries=1:transfer_characteristics=1:matrix_coefficients=1")
                  .exit_code,
              0)
        << "what is not tagged is taken as players take it";
}

TEST_F(ComparePlayback, TakesNumbersOfColoursWithoutANameForUnknown) {
    const std::string file = (folder_ / "c.webm").string();
    testing::output_of("ffmpeg -nostdin -v error -i " + testing::quoted(a()) +
                       " -c:v libvpx -color_range tv -colorspace bt709 -color_trc bt709 "
                       "-color_primaries bt709 " +
                       testing::quoted(file));
    std::string bytes = read_text(file);
    for (const char element : {'\xb1', '\xb9', '\xba', '\xbb'}) {  // matrix, range, transfer, primaries
        const std::size_t at = bytes.find(std::string("\x55") + element + '\x81');
        ASSERT_NE(at, std::string::npos) << "Matroska's colour elements of one byte";
        bytes[at + 3] = '\x4c';
    }
    write_text(file, bytes);
    const Outcome info = run_chironomia({"info", file});
    EXPECT_EQ(info.exit_code, 0) << info.err;
    EXPECT_THAT(info.out, HasSubstr("picture    vp8 yuv420p unknown, 64x48"));
    EXPECT_THAT(info.out, Not(HasSubstr("\ncolours ")));
    EXPECT_EQ(run_chironomia({"compare", "--quiet", file, file}).exit_code, 0);
}

// A YAML block of the document: every command that it runs, and every file that it hands on.
struct Example {
    std::vector<std::string> commands;
    std::string text;
};

Example example_of(const std::string& file) {
    const std::string document = read_text(source_dir() / "docs/ci.md");
    const std::size_t begin = document.find("# " + file + "\n");
    if (begin == std::string::npos) return {};
    Example example{.commands = {}, .text = document.substr(begin, document.find("```", begin) - begin)};
    const TemporaryFolder folder;
    write_text(folder / "ci.yml", example.text);
    write_text(folder / "commands.py", R"(import json, sys, yaml
jobs = yaml.safe_load(open(sys.argv[1]))
job = jobs["jobs"]["frames"] if "jobs" in jobs else jobs["frames"]
commands = job.get("script") or [step["run"] for step in job["steps"] if "run" in step]
json.dump(commands, open(sys.argv[2], "w"))
)");
    const std::string out = (folder / "commands.json").string();
    const int code = std::system(
        format("python3 '{}' '{}' '{}'", (folder / "commands.py").string(), (folder / "ci.yml").string(), out)
            .c_str());
    EXPECT_EQ(code, 0) << "the example is no YAML";
    for (const Json& command : read_json(out)) example.commands.push_back(command);
    return example;
}

class DocumentedExample : public ::testing::TestWithParam<const char*> {
  protected:
    // A project with a motion and Chironomia as a submodule that is built.
    void SetUp() override {
        const fs::path binary = folder_ / "chironomia/build/release/bin";
        fs::create_directories(binary);
        fs::create_symlink(testing::chironomia_binary(), binary / "chironomia");
        fs::create_directories(folder_ / "motion");
        fs::copy_file(source_dir() / "assets/samples/expressive/two-ways.bvh", folder_ / "motion/wave.bvh");
    }

    int run(const std::string& command) const {
        const int status =
            std::system(format("cd '{}' && ( {} ) >log 2>&1", folder_.path().string(), command).c_str());
        return WIFEXITED(status) ? WEXITSTATUS(status) : -1;
    }
    std::string log() const { return read_text(folder_ / "log"); }

    TemporaryFolder folder_;
};

// All lines but those that install and build run here as they stand.
TEST_P(DocumentedExample, RunsAsItStands) {
    const Example example = example_of(GetParam());
    std::string render, compare;
    for (const std::string& command : example.commands) {
        if (command.find(" render ") != std::string::npos) render = command;
        if (command.find(" compare ") != std::string::npos) compare = command;
        if (!command.starts_with("chironomia/tools/")) continue;
        const fs::path tool =
            source_dir() / split_words(command)[0].substr(std::string("chironomia/").size());
        EXPECT_TRUE(fs::exists(tool)) << tool;
    }
    ASSERT_EQ(run(render), 0) << log();
    EXPECT_EQ(run(compare), 3) << "there are no references yet: " << log();

    const std::string update = "chironomia/build/release/bin/chironomia compare references results --update";
    EXPECT_THAT(read_text(source_dir() / "docs/ci.md"), HasSubstr("\n" + update + "\n"));
    ASSERT_EQ(run(update), 0) << log();
    ASSERT_EQ(run(compare), 0) << log();

    write_grey(folder_ / "results/wave/00030.png", 100);
    EXPECT_EQ(run(compare), 1) << log();
    for (const char* report : {"report/frames.xml", "report/frames.html"}) {
        EXPECT_TRUE(fs::exists(folder_ / report)) << report;
        EXPECT_THAT(example.text, HasSubstr("report/"));
    }
    EXPECT_THAT(read_text(folder_ / "report/frames.xml"), HasSubstr("tests=\"31\" failures=\"1\""));
}

INSTANTIATE_TEST_SUITE_P(Ci, DocumentedExample,
                         ::testing::Values(".github/workflows/frames.yml", ".gitlab-ci.yml"),
                         [](const auto& file) {
                             return std::string(file.param).starts_with(".github") ? "GitHub" : "GitLab";
                         });

}  // namespace
}  // namespace chironomia::study
