// The program as `cmake --install` puts it into a folder of its own.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <array>
#include <cstdio>
#include <filesystem>
#include <regex>
#include <string>

#include "core/files/files.h"
#include "core/text.h"
#include "tests/study/process.h"
#include "tests/support/support.h"

namespace chironomia::study {
namespace {

namespace fs = std::filesystem;
using testing::chironomia_binary;
using ::testing::HasSubstr;
using testing::TemporaryFolder;

// What a command of the shell writes to stdout and stderr.
std::string output_of(const std::string& command) {
    std::FILE* pipe = popen((command + " 2>&1").c_str(), "r");
    std::string text;
    std::array<char, 4096> piece;
    while (const std::size_t count = std::fread(piece.data(), 1, piece.size(), pipe))
        text.append(piece.data(), count);
    pclose(pipe);
    return text;
}

class Installed : public ::testing::Test {
  protected:
    static void SetUpTestSuite() {
        place_ = new TemporaryFolder;
        const fs::path build = chironomia_binary().parent_path().parent_path();
        const std::string log =
            output_of(format("cmake --install '{}' --prefix '{}'", build.string(), place_->path().string()));
        ASSERT_TRUE(fs::exists(place_->path() / "bin/chironomia")) << log;
    }
    static void TearDownTestSuite() { delete place_; }

    static fs::path place(const std::string& below) { return place_->path() / below; }
    static std::string run(const std::string& arguments) {
        return output_of(place("bin/chironomia").string() + " " + arguments);
    }
    // What bash offers behind the last of the words.
    static std::string completed(const std::string& words) {
        return output_of(format(
            "bash -c 'PATH={}:$PATH; source {}; COMP_WORDS=({}); COMP_CWORD=$((${{#COMP_WORDS[@]}} - 1)); "
            "_chironomia_complete; echo \"${{COMPREPLY[*]}}\"'",
            place("bin").string(), place("share/bash-completion/completions/chironomia").string(), words));
    }

  private:
    inline static TemporaryFolder* place_ = nullptr;
};

TEST_F(Installed, RendersWithWhatWasInstalled) {
    const std::string render =
        format("render --motion {} --frames 0:2 --size 64x48 --quiet --out {}",
               place("share/chironomia/assets/samples/expressive/two-ways.bvh").string(),
               place("clip.mp4").string());
    EXPECT_EQ(run(render), place("clip.mp4").string() + "\n");
    EXPECT_TRUE(fs::exists(place("clip.mp4")));
    write_text(place("share/chironomia/scenes/upper.json"), "{");
    EXPECT_THAT(run(render), HasSubstr(place("share/chironomia/scenes/upper.json").string()));
}

TEST_F(Installed, SpeaksByItsHelper) {
    EXPECT_THAT(run(format("synth --text Hello. --out {} --speech-out {}", place("m.h5").string(),
                           place("s.wav").string())),
                ::testing::Not(HasSubstr("needs this program")));
    EXPECT_TRUE(fs::exists(place("s.wav")));
}

TEST_F(Installed, HasAManPageForEveryVerb) {
    EXPECT_THAT(read_text(place("share/man/man1/chironomia.1")), HasSubstr("evaluation videos"));
    static const std::regex verb(R"(\n  ([a-z]+)  )");
    const std::string help = run("--help") + run("study --help") + run("corpus --help");
    const fs::path pages = place("share/man/man1");
    std::size_t count = 0;
    for (std::sregex_iterator match(help.begin(), help.end(), verb), end; match != end; ++match) {
        const std::string name = (*match)[1].str();
        EXPECT_TRUE(fs::exists(pages / ("chironomia-" + name + ".1")) ||
                    fs::exists(pages / ("chironomia-study-" + name + ".1")) ||
                    fs::exists(pages / ("chironomia-corpus-" + name + ".1")))
            << name;
        ++count;
    }
    EXPECT_GT(count, 20u);
}

TEST_F(Installed, CompletesVerbsOptionsAndChoices) {
    EXPECT_EQ(completed("chironomia st"), "study\n");
    EXPECT_EQ(completed("chironomia study bu"), "build\n");
    EXPECT_EQ(completed("chironomia render --audio-"), "--audio-cut\n");
    EXPECT_EQ(completed("chironomia render --renderer r"), "raster rays\n");
    EXPECT_EQ(completed("chironomia render --motion x"), "\n");
}

}  // namespace
}  // namespace chironomia::study
