// Work that several processes share, through the real binary: parts of a study, of a fit, of a comparison.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <map>
#include <set>

#include "core/files/files.h"
#include "core/files/json.h"
#include "core/text.h"
#include "raster/images/image_file.h"
#include "study/record/study_folder.h"
#include "tests/study/process.h"
#include "tests/support/support.h"

namespace chironomia::study {
namespace {

namespace fs = std::filesystem;
using ::testing::HasSubstr;
using testing::Outcome;
using testing::run_chironomia;
using testing::RunningChironomia;
using testing::source_dir;
using testing::TemporaryFolder;

using Words = std::vector<std::string>;

std::map<std::string, std::string> files_below(const fs::path& folder) {
    std::map<std::string, std::string> files;
    for (const std::string& file : list_files(folder)) files[file] = read_text(folder / file);
    return files;
}

class ShardCli : public ::testing::Test {
  protected:
    std::string in(const std::string& name) const { return (folder_ / name).string(); }

    // The sample plan with its four videos, small, slow and short.
    static void write_plan_in(const fs::path& folder) {
        const fs::path samples = source_dir() / "assets/samples";
        fs::copy(samples, folder, fs::copy_options::recursive);
        Json plan = read_json(samples / "plan.json");
        plan["render"]["size"] = {64, 36};
        plan["render"]["fps"] = 10;
        plan["render"]["avatar"] = "mannequin";
        for (Json& clip : plan["clips"]) clip["cut"] = {0, 1};
        write_json(folder / "plan.json", plan);
    }
    static Words build_words_in(const fs::path& folder, const std::string& name) {
        return {
            "study", "build",  (folder / "plan.json").string(), "--out", (folder / name).string(), "--seed",
            "3",     "--quiet"};
    }
    void write_plan() const { write_plan_in(folder_.path()); }
    Words build_words(const std::string& name, const std::string& shard = "") const {
        Words words = build_words_in(folder_.path(), name);
        if (!shard.empty()) words.insert(words.end(), {"--shard", shard});
        return words;
    }
    std::map<std::string, std::string> files_of(const std::string& name) const {
        return files_below(folder_ / name);
    }
    // What one process makes of the plan, in another folder; the same for all tests.
    static const std::map<std::string, std::string>& files_of_whole() {
        static const std::map<std::string, std::string> files = [] {
            const TemporaryFolder folder;
            write_plan_in(folder.path());
            EXPECT_EQ(run_chironomia(build_words_in(folder.path(), "whole")).exit_code, 0);
            return files_below(folder / "whole");
        }();
        return files;
    }

    TemporaryFolder folder_;
};

TEST_F(ShardCli, BuildsTheSameStudyInParts) {
    write_plan();
    {
        RunningChironomia third(build_words("study", "3/3"));
        const Outcome first = run_chironomia(build_words("study", "1/3"));
        EXPECT_EQ(first.exit_code, 0) << first.err;
        EXPECT_EQ(first.out, in("study") + "\npart 1 of 3: 2 videos (2 recorded now)\n");
        EXPECT_THAT(third.wait_for_out("recorded now"), HasSubstr("part 3 of 3: 1 videos (1 recorded now)"));
    }
    const Outcome built = run_chironomia(build_words("study"));
    EXPECT_EQ(built.exit_code, 0) << built.err;
    EXPECT_THAT(built.out, HasSubstr("4 videos (1 recorded now)"));
    EXPECT_EQ(files_of("study"), files_of_whole());
    EXPECT_EQ(run_chironomia(build_words("study", "2/3")).out,
              in("study") + "\npart 2 of 3: 1 videos (0 recorded now)\n");
    EXPECT_EQ(files_of("study"), files_of_whole());
}

// A walker leaves the picture, and sounds end before their clips.
TEST_F(ShardCli, WarnsOfWhatItRenders) {
    write_plan();
    Json plan = read_json(folder_ / "plan.json");
    fs::copy(testing::test_file("tests/fixtures/gestures/walk.bvh"), folder_ / "walk.bvh");
    plan["render"]["scene"] = "full";
    plan["render"]["fps"] = 5;
    for (Json& clip : plan["clips"]) {
        clip["motion"]["expressive"] = "walk.bvh";
        clip["cut"] = {0, 4};
    }
    write_json(folder_ / "plan.json", plan);
    const auto lines_of = [](const std::string& text) {
        std::multiset<std::string> lines;
        for (const std::string_view line : split(text, '\n'))
            if (!line.empty()) lines.emplace(line);
        return lines;
    };
    const Outcome whole = run_chironomia(build_words("whole"));
    ASSERT_EQ(whole.exit_code, 0) << whole.err;
    EXPECT_THAT(whole.err, HasSubstr("expressive: "));
    EXPECT_THAT(whole.err, HasSubstr("walk.bvh: the head is outside the picture in "));
    std::multiset<std::string> of_parts;
    for (const char* shard : {"2/3", "1/3", "3/3"}) {
        const Outcome part = run_chironomia(build_words("study", shard));
        EXPECT_EQ(part.exit_code, 0) << part.err;
        of_parts.merge(lines_of(part.err));
    }
    EXPECT_EQ(of_parts, lines_of(whole.err));
    const Outcome built = run_chironomia(build_words("study"));
    EXPECT_EQ(built.exit_code, 0);
    EXPECT_EQ(built.err, whole.err);
    EXPECT_EQ(files_of("study"), files_of("whole"));
    EXPECT_EQ(run_chironomia(build_words("study", "1/3")).err, "")
        << "nothing is rendered of a finished study";
}

// Another machine may have the shared folder under another name.
TEST_F(ShardCli, MakesTheSameBytesWhereverThePlanLies) {
    write_plan();
    fs::create_directory_symlink(folder_.path(), folder_ / "mounted");
    Words words = build_words("study", "1/1");
    words[2] = in("mounted/plan.json");
    ASSERT_EQ(run_chironomia(words).exit_code, 0);
    EXPECT_THAT(run_chironomia(build_words("study")).out, HasSubstr("4 videos (0 recorded now)"));
    EXPECT_EQ(files_of("study"), files_of_whole());
}

TEST_F(ShardCli, GoesOnAfterAKilledPart) {
    write_plan();
    const Outcome killed =
        testing::signal_chironomia_at(folder_ / "study/private/work", SIGKILL, build_words("study", "1/2"));
    EXPECT_EQ(killed.exit_code, 128 + SIGKILL);
    EXPECT_EQ(run_chironomia(build_words("study", "2/2")).exit_code, 0);
    EXPECT_EQ(run_chironomia(build_words("study", "1/2")).exit_code, 0);
    EXPECT_THAT(run_chironomia(build_words("study")).out, HasSubstr("4 videos (0 recorded now)"));
    EXPECT_EQ(files_of("study"), files_of_whole());
}

TEST_F(ShardCli, SaysThatTheDiskIsFullAndGoesOn) {
    write_plan();
    const Outcome full = testing::run_chironomia_with_file_limit(1000, build_words("study", "1/1"));
    EXPECT_EQ(full.exit_code, 3);
    EXPECT_THAT(full.err, HasSubstr("check free space"));
    EXPECT_EQ(run_chironomia(build_words("study")).exit_code, 0);
    EXPECT_EQ(files_of("study"), files_of_whole());
}

TEST_F(ShardCli, RefusesWhatIsNoPart) {
    const std::map<std::string, std::string> refused = {
        {"2", "\"2\" is no part of the work; write PART/PARTS such as 1/8"},
        {"1/2/3", "\"1/2/3\" is no part of the work; write PART/PARTS such as 1/8"},
        {"a/2", "\"a/2\" is no part of the work; write PART/PARTS such as 1/8"},
        {"0/2", "\"0/2\" is part 0 of 2; parts are counted from 1 to 2"},
        {"3/2", "\"3/2\" is part 3 of 2; parts are counted from 1 to 2"},
        {"1/0", "\"1/0\" has 0 parts; their number must be 1 to 100000"},
        {"1/100001", "\"1/100001\" has 100001 parts; their number must be 1 to 100000"}};
    for (const auto& [shard, message] : refused) {
        const Outcome outcome = run_chironomia(build_words("study", shard));
        EXPECT_EQ(outcome.exit_code, 2);
        EXPECT_THAT(outcome.err, HasSubstr("--shard: " + message));
    }
}

// The samples are three motions; a fourth cannot be read.
TEST_F(ShardCli, FitsInPartsWhatOneRunFits) {
    fs::create_directory(folder_ / "motions");
    for (const char* manner : {"expressive", "restrained"})
        fs::copy(source_dir() / "assets/samples" / manner / "two-ways.bvh",
                 folder_ / "motions" / (std::string(manner) + ".bvh"));
    write_text(folder_ / "motions/broken.bvh", "HIERARCHY\n");
    const Json whole = Json::parse(run_chironomia({"fit", in("motions"), "--quiet", "--json"}).out);
    ASSERT_EQ(whole["clips"].size(), 3u);
    std::map<std::string, Json> of_parts, of_one;
    for (const Json& clip : whole["clips"]) of_one[clip["name"]] = clip;
    for (const char* shard : {"1/2", "2/2", "4/4"}) {
        const Outcome part = run_chironomia({"fit", in("motions"), "--quiet", "--json", "--shard", shard});
        const Json clips = Json::parse(part.out)["clips"];
        for (const Json& clip : clips) EXPECT_TRUE(of_parts.emplace(clip["name"], clip).second);
        EXPECT_EQ(part.exit_code, std::string(shard) == "1/2" ? 3 : 0) << part.err;
    }
    EXPECT_EQ(of_parts, of_one);
}

TEST_F(ShardCli, ComparesInPartsWhatOneRunCompares) {
    for (const char* name : {"a", "b", "c", "d", "e"}) {
        for (const char* side : {"refs", "res"}) {
            const auto level = static_cast<std::uint8_t>(name[0] == 'd' && side[2] == 's' ? 90 : 200);
            write_image(folder_ / side / (std::string(name) + ".png"),
                        {.width = 16, .height = 16, .rgba = std::vector<std::uint8_t>(16 * 16 * 4, level)});
        }
    }
    fs::remove(folder_ / "res/e.png");
    const auto compare = [&](const std::string& shard) {
        return run_chironomia({"compare", in("refs"), in("res"), "--quiet", "--shard", shard});
    };
    EXPECT_EQ(compare("1/2").exit_code, 1);
    EXPECT_THAT(compare("1/2").out, HasSubstr("missing: e.png"));
    EXPECT_THAT(compare("1/2").out, HasSubstr("different: 2 of 2 frames within the limits, 1 missing"));
    EXPECT_EQ(compare("2/2").exit_code, 1);
    EXPECT_THAT(compare("2/2").out,
                HasSubstr("different: 1 of 2 frames within the limits; the worst is d.png"));
    EXPECT_EQ(compare("1/4").exit_code, 1);
    EXPECT_EQ(compare("2/4").exit_code, 0);
    const Outcome single = run_chironomia({"compare", in("refs/a.png"), in("res/a.png"), "--shard", "1/2"});
    EXPECT_EQ(single.exit_code, 3);
    EXPECT_THAT(single.err,
                HasSubstr("a.png: is compared as a whole, so there is no part 1 of 2; give two folders"));
}

}  // namespace
}  // namespace chironomia::study
