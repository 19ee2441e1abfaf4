// What the program makes of the files that it is given: nothing that it reads is lost, and what cannot be
// read or written is refused by name.
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <sys/stat.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cstdlib>
#include <filesystem>
#include <iterator>
#include <map>

#include "core/files/files.h"
#include "core/text.h"
#include "tests/study/process.h"
#include "tests/support/support.h"

namespace chironomia::study {
namespace {

namespace fs = std::filesystem;
using ::testing::AllOf;
using ::testing::HasSubstr;
using testing::Outcome;
using testing::run_chironomia;
using testing::source_dir;
using testing::TemporaryFolder;

// A folder with a motion, a sound, and what else a test puts there.
class FileUse : public ::testing::Test {
  protected:
    FileUse() {
        fs::copy(source_dir() / "assets/samples/expressive/two-ways.bvh", in("a.bvh"));
        fs::copy(source_dir() / "assets/samples/speech/two-ways.wav", in("a.wav"));
    }

    std::string in(const std::string& name) const { return (folder_ / name).string(); }

    void expect_refused(const std::vector<std::string>& words, const std::string& says) const {
        const Outcome outcome = run_chironomia(words);
        EXPECT_EQ(outcome.exit_code, 3) << join(words, " ") << "\n" << outcome.err;
        EXPECT_THAT(outcome.err, HasSubstr(says)) << join(words, " ");
    }

    // The exit code of a line of the shell in which $PROGRAM is ours; stderr goes into the file "err".
    int run_line(const std::string& line) const {
        const std::string whole =
            format("PROGRAM='{}'; cd '{}'; ( {} ) 2>err", testing::chironomia_binary().string(),
                   folder_.path().string(), line);
        return WEXITSTATUS(std::system(whole.c_str()));
    }

    TemporaryFolder folder_;
};

TEST_F(FileUse, LetsFoldersHaveTheNamesOfScenesAndAvatars) {
    const std::string render =
        "$PROGRAM render --motion a.bvh --frames 0:1 --size 64x48 --quiet --scene head --avatar ";
    for (const std::string avatar : {"mannequin", "stick"}) {
        EXPECT_EQ(run_line(format("{}{} --out {}/%05d.png", render, avatar, avatar)), 0)
            << read_text(in("err"));
        fs::remove_all(in("head"));
        EXPECT_EQ(run_line(format("{}{} --out head/%05d.png", render, avatar)), 0) << read_text(in("err"));
    }
}

TEST_F(FileUse, WritesAStackWhereALinkLeads) {
    fs::create_directory(in("frames"));
    fs::create_directory_symlink("frames", in("link"));
    EXPECT_EQ(
        run_line("$PROGRAM render --motion a.bvh --frames 0:1 --size 64x48 --quiet --out link/%05d.png"), 0)
        << read_text(in("err"));
    EXPECT_TRUE(fs::exists(in("frames/00000.png")));
}

TEST_F(FileUse, WritesNoFileUnderTheNameOfAnotherKind) {
    write_text(in("plan.json"), "{}");
    expect_refused(
        {"study", "pack", in("s"), "--out", in("plan.json")},
        in("plan.json") + ": --out writes a file whose name ends in .zip; write to " + in("plan.zip"));
    expect_refused({"study", "rehearse", in("s"), "--seed", "1", "--out", in("a.bvh")}, "ends in .json");
    expect_refused({"study", "answers", in("s"), "--out", in("a.bvh")}, "ends in .json");
    expect_refused({"study", "plan", in("plan.json"), "--preregister", in("p.pdf")}, "ends in .html");
    expect_refused({"synth", "--text", "Hello", "--out", in("m.h5"), "--speech-out", in("s.mp3")},
                   "--speech-out writes a file whose name ends in .wav");
    EXPECT_EQ(read_text(in("plan.json")), "{}");
}

TEST_F(FileUse, RefusesBeforeAnyWorkWhatCannotBeWritten) {
    fs::create_directory(in("s.wav"));
    expect_refused({"synth", "--text", "Hello", "--out", in("m.h5"), "--speech-out", in("s.wav")},
                   in("s.wav") + ": this is a folder; name a file to write");
    expect_refused({"synth", "--text", "Hello", "--out", in("m.h5"), "--score-out", in("a.bvh/deep/s.json")},
                   in("a.bvh/deep/s.json") + ": --score-out cannot be written, as " + in("a.bvh") +
                       " is no folder; name a place in a folder");
    expect_refused({"render", "--motion", in("a.bvh"), "--out", in("c.mp4"), "--report", in("a.wav/r.json")},
                   "--report cannot be written, as");
    for (const char* made : {"m.h5", "c.mp4"}) EXPECT_FALSE(fs::exists(in(made))) << made;
}

TEST_F(FileUse, RefusesAFolderThatIsProtectedFromWriting) {
    if (::geteuid() == 0) GTEST_SKIP() << "the superuser may write everywhere";
    fs::create_directory(in("locked"));
    fs::permissions(in("locked"), fs::perms::owner_read | fs::perms::owner_exec);
    expect_refused({"convert", "--motion", in("a.bvh"), "--out", in("locked/b.bvh")},
                   "--out cannot be written into " + in("locked") + " (Permission denied); change its");
}

TEST_F(FileUse, KeepsWhatItReads) {
    const std::string motion = read_text(in("a.bvh")), sound = read_text(in("a.wav"));
    fs::create_symlink("a.bvh", in("link.bvh"));
    fs::create_hard_link(in("a.bvh"), in("hard.bvh"));
    fs::create_directory(in("poses"));
    fs::create_directory(in("corpus"));
    write_text(in("poses/a_000000000000_keypoints.json"), "{}");
    write_text(in("film.mp4"), "a film");
    write_text(in("me.glb"), "an avatar");
    write_text(in("answers.csv"), "a,b\n");

    expect_refused({"convert", "--motion", in("a.bvh"), "--out", in("a.bvh")},
                   in("a.bvh") + ": --out would replace what --motion reads (" + in("a.bvh") +
                       "); write to another name");
    for (const char* link : {"link.bvh", "hard.bvh", "corpus/../a.bvh"})
        expect_refused({"convert", "--motion", in("a.bvh"), "--out", in(link)}, "--out would replace");
    expect_refused({"convert", "--motion", in("poses"), "--out", in("poses/")}, "--out would replace");
    expect_refused({"convert", "--motion", in("poses"), "--out", in("b.bvh"), "--report",
                    in("poses/a_000000000000_keypoints.json")},
                   "--report would write into the folder whose files --motion reads");
    fs::create_symlink("poses/a_000000000000_keypoints.json", in("report"));
    expect_refused({"convert", "--motion", in("poses"), "--out", in("b.bvh"), "--report", in("report")},
                   "--report would write into the folder whose files --motion reads");
    expect_refused({"convert", "--motion", in("a.bvh"), "--avatar", in("me.glb"), "--out", in("me.glb")},
                   "--out would replace what --avatar reads");
    expect_refused({"synth", "--speech", in("a.wav"), "--out", in("m.h5"), "--speech-out", in("a.wav")},
                   "--speech-out would replace what --speech reads");
    expect_refused({"render", "--motion", in("a.bvh"), "--out", in("c.mp4"), "--report", in("a.bvh")},
                   "--report would replace what --motion reads");
    expect_refused({"render", "--film", in("film.mp4"), "--out", in("film.mp4")},
                   "--out would replace what --film reads");
    expect_refused({"render", "--motion", in("a.bvh"), "--out", in("c.mp4"), "--report", in("c.mp4")},
                   in("c.mp4") + ": --out and --report name the same file; give each a name of its own");
    expect_refused({"fit", in("poses"), "--report", in("poses/fit.json")},
                   "--report would write into the folder whose files M reads");
    expect_refused({"compare", in("poses"), in("corpus"), "--diff", in("corpus")},
                   "--diff would replace what B reads");
    expect_refused({"compare", in("poses"), in("corpus"), "--html", in("r"), "--junit", in("r")},
                   "--junit and --html name the same file");
    expect_refused({"corpus", "import", in("answers.csv"), "--out", in("answers.csv")},
                   "--out would replace");
    expect_refused({"train", "model2", "--corpus", in("corpus"), "--out", in("corpus/corpus.safetensors")},
                   "corpus.json: --out would replace what --corpus reads");
    expect_refused({"evaluate", "--predictions", in("predictions/hold.h5"), "--corpus", in("corpus"),
                    "--against", "hold", "--out", folder_.path().string()},
                   "--out would replace what --predictions reads");
    expect_refused({"study", "build", in("s/private/plan.json"), "--out", in("s"), "--seed", "1"},
                   "--out would replace what PLAN.json reads");
    expect_refused({"study", "rehearse", in("s"), "--seed", "1", "--out", in("s/private/key.json")},
                   "--out would replace what DIR reads");
    expect_refused({"study", "answers", in("s"), "--out", in("s/private/answers.sqlite")},
                   "--out would replace what --database reads");
    expect_refused({"study", "analyse", "--answers", in("answers.csv"), "--out", folder_.path().string()},
                   "--out would replace what --answers reads");
    expect_refused({"study", "export", in("s"), "--as", "jspsych", "--out", in("s/private/key.json")},
                   "--out would replace what DIR reads");

    EXPECT_EQ(read_text(in("a.bvh")), motion);
    EXPECT_EQ(read_text(in("hard.bvh")), motion);
    EXPECT_EQ(read_text(in("a.wav")), sound);
    EXPECT_EQ(read_text(in("film.mp4")), "a film");
    EXPECT_EQ(read_text(in("answers.csv")), "a,b\n");
    EXPECT_FALSE(fs::exists(in("c.mp4")));
}

TEST_F(FileUse, RefusesPathsThatTheSystemCannotFollow) {
    const std::string long_name = in(std::string(300, 'x'));
    fs::create_symlink("loop2", in("loop1"));
    fs::create_symlink("loop1", in("loop2"));
    ASSERT_EQ(mkfifo(in("pipe").c_str(), 0600), 0);
    for (const std::vector<std::string>& words :
         std::vector<std::vector<std::string>>{{"info"},
                                               {"fit"},
                                               {"measure"},
                                               {"study", "check"},
                                               {"convert", "--out", in("b.bvh"), "--motion"}}) {
        const auto with = [&](const std::string& path) {
            std::vector<std::string> all = words;
            all.push_back(path);
            return all;
        };
        expect_refused(with(long_name), long_name + ": cannot be opened (File name too long)");
        expect_refused(with(in("loop1")),
                       in("loop1") + ": cannot be opened (Too many levels of symbolic links)");
        // Nobody writes into it: it is refused before it is opened, so that nothing waits.
        expect_refused(with(in("pipe")), in("pipe") + ": this is a pipe or a device, a file is needed");
    }
    expect_refused({"render", "--motion", in("a.bvh"), "--audio", in("pipe"), "--out", in("c.mp4")},
                   "this is a pipe or a device");
    ASSERT_EQ(mkfifo(in("pipe.bvh").c_str(), 0600), 0);
    expect_refused({"convert", "--motion", in("a.bvh"), "--out", in("pipe.bvh")},
                   "pipe.bvh: this is a pipe or a device; name a file to write");
    expect_refused({"synth", "--text", "Hello", "--out", in(std::string(300, 'x') + ".h5")},
                   "File name too long");
}

TEST_F(FileUse, RefusesNamesThatAreNotUtf8) {
    const std::string name = in("\xff.bvh");
    fs::copy(in("a.bvh"), name);
    expect_refused({"info", name, "--json"}, "\\xff.bvh: byte ");
    expect_refused({"convert", "--motion", in("a.bvh"), "--out", in("\xff.h5")},
                   "is not UTF-8; rename the file");
    fs::create_directory(in("motions"));
    fs::rename(name, in("motions/\xff.bvh"));
    expect_refused({"fit", in("motions"), "--json"}, "motions/\\xff.bvh: byte ");
}

// "-" means standard output to many programs; here no option does, and none makes a file of that name.
TEST_F(FileUse, WritesNothingThatAnOptionNamesToStandardOutput) {
    const std::map<std::string, std::string> lines = {
        {"demo --out -", "--out"},
        {"synth --text Hello --out -", "--out"},
        {"synth --text Hello --out a.h5 --speech-out -", "--speech-out"},
        {"synth --text Hello --out a.h5 --score-out -", "--score-out"},
        {"render --motion a.bvh --out -", "--out"},
        {"render --motion a.bvh --out -/%05d.png", "--out"},
        {"render --motion a.bvh --out c.mp4 --report -", "--report"},
        {"convert --motion a.bvh --out -", "--out"},
        {"fit a.bvh --report -", "--report"},
        {"compare a.bvh a.wav --junit -", "--junit"},
        {"compare a.bvh a.wav --html -", "--html"},
        {"compare a.bvh a.wav --diff -", "--diff"},
        {"corpus make --kind talks --seed 1 --out -", "--out"},
        {"corpus import a.json --out -", "--out"},
        {"train model2 --corpus c --out -", "--out"},
        {"evaluate --corpus c --predictions p.h5 --against hold --out -", "--out"},
        {"study build plan.json --seed 1 --out -", "--out"},
        {"study build plan.json --seed 1 --out s --slurm-script -", "--slurm-script"},
        {"study plan plan.json --preregister -", "--preregister"},
        {"study plan --from-folders a=m --segments s.csv --preset hemvip --out -", "--out"},
        {"study serve s --database -", "--database"},
        {"study answers s --out -", "--out"},
        {"study pack s --out -", "--out"},
        {"study export s --as jspsych --out -", "--out"},
        {"study rehearse s --seed 1 --out -", "--out"},
        {"study analyse s --answers a.json --out -", "--out"}};
    const auto before = std::distance(fs::directory_iterator(folder_.path()), {});
    for (const auto& [line, option] : lines) {
        EXPECT_EQ(run_line("exec $PROGRAM " + line + " >out"), 3) << line << "\n" << read_text(in("err"));
        EXPECT_EQ(read_text(in("err")),
                  format("chironomia: {}: is \"-\", but this is written to a file, never to standard output; "
                         "name a file or a folder (./- for one of that name)\n",
                         option))
            << line;
        EXPECT_EQ(read_text(in("out")), "") << line;
    }
    EXPECT_EQ(std::distance(fs::directory_iterator(folder_.path()), {}), before + 2) << "out and err alone";
    EXPECT_EQ(run_line("exec $PROGRAM convert --motion a.bvh --out ./-.bvh >out"), 0) << read_text(in("err"));
}

TEST_F(FileUse, SaysThatStdoutIsFull) {
    for (const char* verb :
         {"info a.bvh --json", "--help", "study presets", "convert --motion a.bvh --out b.bvh"}) {
        EXPECT_EQ(run_line(format("exec $PROGRAM {} >/dev/full", verb)), 3) << verb;
        EXPECT_THAT(read_text(in("err")), HasSubstr("stdout: what is to be printed cannot be written"))
            << verb;
    }
}

TEST_F(FileUse, LeavesNothingWhenAStackOfFramesFillsTheDisk) {
    const Outcome outcome = testing::run_chironomia_with_file_limit(
        1500, {"render", "--motion", in("a.bvh"), "--avatar", "mannequin", "--size", "160x90", "--frames",
               "0:6", "--quiet", "--out", in("frames/%05d.png")});
    EXPECT_EQ(outcome.exit_code, 3) << outcome.err;
    EXPECT_THAT(outcome.err, HasSubstr("check free space and permissions"));
    EXPECT_FALSE(fs::exists(in("frames")));
    EXPECT_FALSE(fs::exists(in(".frames.partial")));
}

TEST_F(FileUse, SaysThatTheAddressSpaceIsTooSmall) {
    if (run_line("ulimit -v 800000; exec $PROGRAM --version >/dev/null") != 0)
        GTEST_SKIP() << "needs a build without sanitizers, which reserve terabytes";
    const auto render = [&](const std::string& limit, const char* more) {
        const std::string line = "exec $PROGRAM render --motion a.bvh --frames 0:2 --out c.mp4 ";
        const int code = run_line("ulimit -v " + limit + "; " + line + more);
        return std::pair(code, read_text(in("err")));
    };
    const auto opengl = render("800000", "--renderer gl");
    EXPECT_EQ(opengl.first, 3);
    EXPECT_THAT(opengl.second, AllOf(HasSubstr("OpenGL: pictures of 1280x720 need "),
                                     HasSubstr("raise the limit (ulimit -v)")));
    const auto tiles = render("400000", "");
    EXPECT_EQ(tiles.first, 3);
    EXPECT_THAT(tiles.second, HasSubstr("raise the limit"));
    EXPECT_THAT(tiles.second, HasSubstr("ulimit -v"));
}

TEST_F(FileUse, SaysThatAFileMayNotGrow) {
    EXPECT_EQ(
        run_line("ulimit -f 4; exec $PROGRAM render --motion a.bvh --frames 0:20 --size 320x180 --out c.mp4"),
        3);
    EXPECT_THAT(read_text(in("err")),
                HasSubstr("c.mp4: cannot be written (File too large); check free space"));
    EXPECT_FALSE(fs::exists(in("c.mp4")));
}

// A name without a folder is the first that people write; all frames were drawn before it was refused.
TEST_F(FileUse, WritesFramesIntoAFolderOfTheirOwn) {
    const std::string render = "$PROGRAM render --motion a.bvh --size 64x36 --frames 0:2 --quiet --out ";
    for (const std::string name : {"f_%d.png", "./f_%d.png"}) {
        EXPECT_EQ(run_line(render + name), 3);
        EXPECT_THAT(
            read_text(in("err")),
            HasSubstr(name +
                      ": frames get a new folder of their own, and . is the one you are in; write them "
                      "like "));
        EXPECT_THAT(read_text(in("err")), HasSubstr("frames/f_%d.png\n"));
    }
    EXPECT_EQ(run_line(render + "frames/f_%d.png"), 0) << read_text(in("err"));
    EXPECT_EQ(run_line(render + "frames/f_%d.png"), 3);
    EXPECT_THAT(
        read_text(in("err")),
        HasSubstr(
            "frames/f_%d.png: frames get a new folder of their own, and frames already holds something; "
            "remove it, or name another one\n"));
}

// Nothing limits root: nobody starts the program, with root's rights to files.
TEST_F(FileUse, SaysThatThreadsAreRefused) {
    // A stack larger than the address space: no thread can have one, whoever runs this.
    const std::string limited = "exec prlimit --stack=109951162777600 $PROGRAM ";
    for (const char* words : {"render --motion a.bvh --out f/%d.png", "render --motion a.bvh --out c.mp4",
                              "render --motion a.bvh --renderer rays --out c.mp4"}) {
        EXPECT_EQ(run_line(limited + words + " --size 64x36 --frames 0:2"), 3) << read_text(in("err"));
        EXPECT_THAT(read_text(in("err")), AllOf(HasSubstr("the system refuses a thread or another resource"),
                                                HasSubstr("raise the limits (ulimit -u")));
    }
}

}  // namespace
}  // namespace chironomia::study
