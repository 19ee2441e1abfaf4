#include "study/check/check.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cstdlib>
#include <fstream>

#include "core/hash.h"
#include "core/text.h"
#include "study/build/blinding.h"
#include "study/build/build.h"
#include "study/build/pages.h"
#include "study/build/study_files.h"
#include "study/clip/container.h"
#include "tests/study/sample_plan.h"
#include "tests/study/tiny_maker.h"
#include "tests/support/support.h"

namespace chironomia::study {
namespace {

namespace fs = std::filesystem;
using ::testing::Contains;
using ::testing::ElementsAre;
using testing::FakeMaker;
using ::testing::HasSubstr;
using ::testing::IsEmpty;
using ::testing::Not;
using testing::refusal_of;
using testing::sample_plan;
using ::testing::StartsWith;
using testing::TemporaryFolder;

// A study that is built once and copied for each test, so that one thing about it can be spoilt.
class CheckStudy : public ::testing::Test {
  protected:
    static void SetUpTestSuite() {
        original_ = std::make_unique<TemporaryFolder>();
        testing::write_sample_inputs(original_->path());
        Json json = sample_plan();
        json["render"]["size"] = {64, 48};
        write_json(*original_ / "plan.json", json);
        FakeMaker fake;
        fake.lengths = {
            {"ours/c1.bvh", 0.7}, {"base/c1.bvh", 0.5}, {"ours/c2.bvh", 0.4}, {"base/c2.bvh", 0.4}};
        build_study(read_plan(*original_ / "plan.json"),
                    {.out = *original_ / "study", .seed = 5, .quiet = true}, testing::tiny_maker(fake));
    }
    static void TearDownTestSuite() { original_.reset(); }

    CheckStudy() {
        fs::copy(*original_ / "study", study_, fs::copy_options::recursive);
        reset_times_and_permissions(study_ / "public");
    }

    // The properties that fail, after the lists of hashes were made to fit what is there, as a careful cheat
    // would.
    std::vector<std::string> failing_when_resealed() {
        reseal();
        return failing();
    }

    std::vector<std::string> failing() {
        std::vector<std::string> names;
        details_.clear();
        for (const Proof& proof : check_study(study_).proofs) {
            if (proof.holds || proof.open) continue;
            names.push_back(proof.property);
            details_ += proof.detail + "\n";
        }
        return names;
    }

    // In place of the study another one, of a plan with these keys.
    void build_with(const Json& keys) {
        Json plan = read_json(*original_ / "plan.json");
        plan.update(keys);
        write_json(*original_ / "other.json", plan);
        fs::remove_all(study_);
        build_study(read_plan(*original_ / "other.json"), {.out = study_, .seed = 5, .quiet = true},
                    testing::tiny_maker(FakeMaker()));
    }

    std::string detail_of(const std::string& property) {
        for (const Proof& proof : check_study(study_).proofs) {
            if (proof.property == property) return proof.detail;
        }
        return "";
    }

    void reseal() {
        write_text(study_ / "public/index.html", make_index_page(read_json(study_ / "public/pages.json")));
        reset_times_and_permissions(study_ / "public");
        change("private/manifest.json", [&](Json& manifest) {
            for (Json& output : manifest["outputs"]) {
                const fs::path file = study_ / output["path"].get<std::string>();
                if (fs::exists(file)) output["sha256"] = sha256_of_file(file);
            }
        });
    }

    void change(const std::string& file, const std::function<void(Json&)>& edit) {
        Json json = read_json(study_ / file);
        edit(json);
        write_json(study_ / file, json);
    }

    void change_key(const std::function<void(Json&)>& edit) { change("private/key.json", edit); }

    // The hashes of the key are made to fit the videos that are there.
    void rekey() {
        change_key([&](Json& key) {
            for (Json& video : key["videos"]) video["sha256"] = sha256_of_file(file_of(video));
        });
    }

    fs::path file_of(const Json& video) { return study_ / "public" / video["file"].get<std::string>(); }

    // Remakes both videos of clip c1 with the ffmpeg program. False if there is none.
    bool remake(const std::string& arguments) {
        if (std::system("ffmpeg -version > /dev/null 2>&1") != 0) return false;
        for (const fs::path& file : videos_of_c1()) {
            const std::string remade = file.string() + ".remade.mp4";
            const std::string command =
                format("ffmpeg -v error -i {} -fflags +bitexact -flags:a +bitexact -c copy {} {} < /dev/null",
                       file.string(), arguments, remade);
            EXPECT_EQ(std::system(command.c_str()), 0) << command;
            fs::rename(remade, file);
        }
        make_sizes_equal(videos_of_c1());
        rekey();
        return true;
    }

    // Both videos of clip c1.
    std::vector<fs::path> videos_of_c1() {
        std::vector<fs::path> files;
        const Json key = read_json(study_ / "private/key.json");
        for (const Json& video : key["videos"]) {
            if (video["clip"] == "c1") files.push_back(file_of(video));
        }
        return files;
    }

    static std::unique_ptr<TemporaryFolder> original_;
    TemporaryFolder folder_;
    fs::path study_ = folder_ / "study";
    std::string details_;
};

std::unique_ptr<TemporaryFolder> CheckStudy::original_;

TEST_F(CheckStudy, ProvesEverythingOfAFreshStudy) {
    const CheckReport report = check_study(study_);
    EXPECT_TRUE(report.passed()) << to_text(report);
    EXPECT_EQ(report.proofs.size(), 25u);
    for (const Proof& proof : report.proofs) EXPECT_FALSE(proof.detail.empty()) << proof.property;
    EXPECT_TRUE(to_json(report)["holds"]);
    EXPECT_THAT(to_text(report), StartsWith("yes  every file is as it was built"));
}

TEST_F(CheckStudy, LeavesOpenWhatItCannotDecide) {
    const CheckReport report = check_study(study_);
    const Proof& prediction = report.proofs[23];
    EXPECT_TRUE(prediction.open && !prediction.holds);
    EXPECT_EQ(prediction.detail, "2 clips of 2 conditions are too few to distinguish a leak from chance");
    EXPECT_TRUE(report.proofs[24].open);
    EXPECT_TRUE(to_json(report)["proofs"][24]["holds"].is_null());
    EXPECT_THAT(to_text(report), HasSubstr("\nopen nothing but pictures and sounds predicts a condition "));
    EXPECT_THAT(to_text(report), HasSubstr("\nopen built again from its plan it has the same bytes "));
}

// Builds the study of the fixture again from its plan.
StudySource source_in(const fs::path& folder) {
    FakeMaker fake;
    fake.lengths = {{"ours/c1.bvh", 0.7}, {"base/c1.bvh", 0.5}, {"ours/c2.bvh", 0.4}, {"base/c2.bvh", 0.4}};
    return {.plan = read_plan(folder / "plan.json"), .maker = testing::tiny_maker(fake)};
}

TEST_F(CheckStudy, BuildsTheStudyAgain) {
    const Proof same = check_study(study_, source_in(original_->path())).proofs.back();
    EXPECT_TRUE(same.holds && !same.open) << same.detail;
    EXPECT_EQ(same.detail, "16 files");
}

// Two videos are swapped, and all lists are made to fit, so that only their pictures show it.
TEST_F(CheckStudy, SeesVideosThatAreNotThoseOfThePlan) {
    const auto files = videos_of_c1();
    const std::string first = read_text(files[0]);
    write_text(files[0], read_text(files[1]));
    write_text(files[1], first);
    rekey();
    EXPECT_THAT(failing_when_resealed(), IsEmpty()) << details_;
    const CheckReport report = check_study(study_, source_in(original_->path()));
    EXPECT_FALSE(report.passed());
    EXPECT_THAT(report.proofs.back().detail, ::testing::MatchesRegex("private/key.json differs"));
}

TEST_F(CheckStudy, SeesAPixelThatIsNotOfThePlan) {
    std::string bytes = read_text(videos_of_c1()[0]);
    bytes[bytes.find("mdat") + 40] ^= 1;
    write_text(videos_of_c1()[0], bytes);
    reset_times_and_permissions(study_ / "public");
    const Proof differs = check_study(study_, source_in(original_->path())).proofs.back();
    EXPECT_FALSE(differs.holds || differs.open);
    EXPECT_THAT(differs.detail,
                ::testing::MatchesRegex("public/clips/.*.mp4 \\(clip \"c1\", (ours|baseline)\\) differs"));
}

TEST_F(CheckStudy, SeesSoundThatIsNotTheSame) {
    testing::write_tiny_video(
        videos_of_c1()[1], {.size = {.width = 64, .height = 48}, .fps = {}, .frames = 21, .gain = 0.1001f});
    make_sizes_equal(videos_of_c1());
    rekey();
    EXPECT_THAT(failing_when_resealed(), ElementsAre("videos of a clip with the same speech sound the same"));
    EXPECT_THAT(details_, StartsWith("clip \"c1\": clips/"));
}

TEST_F(CheckStudy, SeesAByteInThePadding) {
    const fs::path file = videos_of_c1()[0];
    make_sizes_equal(videos_of_c1());
    pad_clip(file, fs::file_size(file) + kLeastPadding);
    pad_clip(videos_of_c1()[1], fs::file_size(videos_of_c1()[1]) + kLeastPadding);
    std::string bytes = read_text(file);
    bytes.back() = 1;
    write_text(file, bytes);
    rekey();
    EXPECT_THAT(failing_when_resealed(),
                ElementsAre("nothing but zeros beside the pictures and sounds of a video"));
    EXPECT_THAT(details_, HasSubstr(" has a byte 0x01 in its padding, at "));
}

TEST_F(CheckStudy, SeesABoxThatNobodyNeeds) {
    for (const fs::path& file : videos_of_c1())
        std::ofstream(file, std::ios::app | std::ios::binary) << std::string("\0\0\0\x08", 4) + "uuid";
    rekey();
    EXPECT_THAT(failing_when_resealed(),
                Contains("nothing but zeros beside the pictures and sounds of a video"));
    EXPECT_THAT(details_, HasSubstr(" has a box \"uuid\" at byte "));
}

TEST_F(CheckStudy, SeesANameInDigitsOrTurnedLetters) {
    for (const std::string name : {"626173656c696e65", "onfryvar"}) {
        for (const fs::path& file : videos_of_c1()) {
            std::ofstream(file, std::ios::app | std::ios::binary)
                << std::string("\0\0\0", 3) + static_cast<char>(8 + name.size()) + "free" + name;
        }
        rekey();
        EXPECT_THAT(failing_when_resealed(), Contains("no name of a condition or source in the videos"))
            << name;
        EXPECT_THAT(details_, HasSubstr("\"base\" stands in clips/"));
        fs::remove_all(study_);
        fs::copy(*original_ / "study", study_, fs::copy_options::recursive);
    }
}

TEST_F(CheckStudy, SeesAPageThatSaysMoreThanThePlan) {
    constexpr const char* kProperty = "the page says and asks what the plan does, and nothing else";
    change("public/pages.json", [](Json& pages) { pages["pages"][1]["note"] = "bhef"; });
    EXPECT_THAT(failing_when_resealed(),
                ElementsAre(kProperty, StartsWith("no page of a participant shows")));
    EXPECT_THAT(details_, HasSubstr("pages.json has \"note\", which no page needs\n"));
    EXPECT_THAT(details_, HasSubstr("is of another form than the others\n"));
    change("public/pages.json", [](Json& pages) {
        pages["pages"][1].erase("note");
        pages["pages"][1]["caption"] = "bhef";
    });
    EXPECT_THAT(failing_when_resealed(), ElementsAre(kProperty));
    EXPECT_EQ(details_, "pages[1].caption of pages.json is not what the plan says\n");
    change("public/pages.json", [](Json& pages) {
        pages["pages"][1]["caption"] = "";
        pages["instructions"] = "The better one is often left.";
    });
    EXPECT_THAT(failing_when_resealed(), ElementsAre(kProperty));
    EXPECT_EQ(details_, "instructions of pages.json is not what the plan says\n");
    change("private/plan.json", [](Json& plan) { plan.erase("render"); });
    EXPECT_THAT(failing_when_resealed(), ElementsAre(kProperty));
    EXPECT_EQ(details_, "plan.json or pages.json lacks a part, or has it in another form\n");
}

TEST_F(CheckStudy, SeesAnAnswerThatNoInstructionAsksForAndASoundWithMoreThanTones) {
    testing::write_sample_inputs(folder_.path());
    Json json = sample_plan();
    json["render"]["size"] = {160, 120};
    json["sound_check"] = true;
    json["checks"] = {{"count", 1}, {"kinds", {"text"}}};
    write_json(folder_ / "plan.json", json);
    build_study(read_plan(folder_ / "plan.json"), {.out = folder_ / "checked", .seed = 1, .quiet = true},
                testing::tiny_maker(FakeMaker()));
    study_ = folder_ / "checked";
    EXPECT_THAT(failing(), IsEmpty()) << details_;
    change_key([](Json& key) {
        for (Json& page : key["pages"]) {
            if (page["kind"] == "check") page["expected"].begin().value() = 1;
        }
    });
    EXPECT_THAT(failing_when_resealed(),
                ElementsAre("instructions stand in attention checks alone, each with its answer"));
    EXPECT_THAT(details_, HasSubstr(":1}, which is not what its instruction says"));
    const std::string sound = read_json(study_ / "public/pages.json")["sound_check"]["files"][0];
    std::ofstream(study_ / "public" / sound, std::ios::app) << "ours";
    EXPECT_THAT(failing_when_resealed(), Contains("public/ holds nothing else"));
    EXPECT_THAT(details_, HasSubstr(sound + " is not this program's own sound"));
}

TEST_F(CheckStudy, ProvesEverythingOfOtherPresentationsToo) {
    testing::write_sample_inputs(folder_.path());
    Json json = sample_plan();
    json["render"]["size"] = {64, 48};
    json["presentation"] = "one video";
    json["render"]["format"] = "webm";
    for (const char* name : {"webm", "silent"}) {
        write_json(folder_ / "plan.json", json);
        build_study(read_plan(folder_ / "plan.json"), {.out = folder_ / name, .seed = 1, .quiet = true},
                    testing::tiny_maker(FakeMaker()));
        const CheckReport report = check_study(folder_ / name);
        EXPECT_TRUE(report.passed()) << to_text(report);
        for (Json& clip : json["clips"]) clip.erase("audio");
        json["render"]["format"] = "mp4";
    }
}

TEST_F(CheckStudy, SeesAChangedByte) {
    std::ofstream(study_ / "private/plan.json", std::ios::app) << ' ';
    EXPECT_THAT(failing(), ElementsAre("every file is as it was built"));
    EXPECT_EQ(details_, "private/plan.json has changed\n");
    EXPECT_THAT(to_text(check_study(study_)), StartsWith("NO   every file is as it was built"));
}

TEST_F(CheckStudy, SeesAMissingFile) {
    fs::remove(study_ / "private/recordings.json");
    EXPECT_THAT(failing(), ElementsAre("every file is as it was built"));
    EXPECT_EQ(details_, "private/recordings.json is missing\n");
    fs::remove(videos_of_c1()[0]);
    EXPECT_THAT(failing(), Contains("every video is what the key says"));
    EXPECT_THAT(failing(), Contains("every video is whole"));
    EXPECT_THAT(details_, HasSubstr("clips/"));
    EXPECT_THAT(details_, Not(HasSubstr("filesystem error")));
    fs::remove(study_ / "public/index.html");
    fs::remove(study_ / "public/player.js");
    EXPECT_THAT(failing(), Contains("the page shows what the key says"));
    EXPECT_THAT(details_, HasSubstr("player.js is missing"));
}

TEST_F(CheckStudy, SeesAnUnknownFileOrLinkInPublic) {
    write_text(study_ / "public/clips/.notes", "the left one is ours");
    reset_times_and_permissions(study_ / "public");
    EXPECT_THAT(failing(), ElementsAre("public/ holds nothing else"));
    EXPECT_EQ(details_, "clips/.notes is in no list\n");
    fs::remove(study_ / "public/clips/.notes");
    fs::create_symlink("../private/key.json", study_ / "public/key.json");
    EXPECT_THAT(failing(), Contains("public/ holds nothing else"));
    EXPECT_THAT(details_, HasSubstr("key.json is a link"));
}

TEST_F(CheckStudy, SeesAComparisonThatIsMissing) {
    change_key([](Json& key) { key["design"]["clips"].push_back("c3"); });
    EXPECT_THAT(failing_when_resealed(), Contains("the key holds every comparison of the plan once"));
    EXPECT_THAT(details_, HasSubstr("2 of 3 comparisons"));
}

TEST_F(CheckStudy, SeesAKeyThatNamesTheWrongCondition) {
    change_key([](Json& key) { std::swap(key["videos"][0]["conditions"], key["videos"][1]["conditions"]); });
    EXPECT_THAT(failing_when_resealed(), ElementsAre("the key holds every comparison of the plan once"));
    EXPECT_THAT(details_, HasSubstr(" is needed"));
}

TEST_F(CheckStudy, SeesAComparisonThatIsKeyedTwice) {
    change_key([](Json& key) {
        const Json id = key["pages"][1]["page"];
        key["pages"][1] = key["pages"][0];
        key["pages"][1]["page"] = id;
    });
    EXPECT_THAT(failing_when_resealed(), Contains("the key holds every comparison of the plan once"));
    EXPECT_THAT(details_, HasSubstr(" twice"));
}

TEST_F(CheckStudy, SeesVideosThatWereSwapped) {
    const auto files = videos_of_c1();
    const std::string first = read_text(files[0]);
    write_text(files[0], read_text(files[1]));
    write_text(files[1], first);
    EXPECT_THAT(failing_when_resealed(), ElementsAre("every video is what the key says"));
    EXPECT_THAT(details_, HasSubstr(" is not clip \"c1\", "));
}

TEST_F(CheckStudy, SeesAPageThatShowsOtherVideos) {
    change("public/pages.json",
           [](Json& pages) { std::swap(pages["pages"][0]["videos"], pages["pages"][1]["videos"]); });
    EXPECT_THAT(failing_when_resealed(), ElementsAre("the page shows what the key says"));
    EXPECT_EQ(details_, "page 1 of pages.json differs from the key\n");
}

TEST_F(CheckStudy, SeesAPageWithOtherDataThanItsList) {
    reseal();
    const std::string page = read_text(study_ / "public/index.html");
    write_text(study_ / "public/index.html", page + "<!-- A is ours -->");
    reset_times_and_permissions(study_ / "public");
    EXPECT_THAT(failing(), ElementsAre("every file is as it was built", "the page shows what the key says"));
}

TEST_F(CheckStudy, SeesANameThatIsNoKeyedHash) {
    const std::string token = "0123456789abcdef";
    std::string before;
    change_key([&](Json& key) {
        before = key["videos"][0]["token"];
        key["videos"][0]["token"] = token;
        key["videos"][0]["file"] = "clips/" + token + ".mp4";
    });
    for (const char* file : {"private/key.json", "public/pages.json", "private/manifest.json"}) {
        std::string text = read_text(study_ / file);
        for (std::size_t at; (at = text.find(before)) != std::string::npos;) text.replace(at, 16, token);
        write_text(study_ / file, text);
    }
    fs::rename(study_ / "public/clips" / (before + ".mp4"), study_ / "public/clips" / (token + ".mp4"));
    EXPECT_THAT(failing_when_resealed(), ElementsAre("names are keyed hashes"));
    EXPECT_THAT(details_, StartsWith(token + " should be "));
}

TEST_F(CheckStudy, SeesAVideoThatIsNotNamedByItsToken) {
    change_key([&](Json& key) {
        fs::rename(file_of(key["videos"][0]), study_ / "public/clips/first.mp4");
        key["videos"][0]["file"] = "clips/first.mp4";
    });
    EXPECT_THAT(failing_when_resealed(), Contains("names are keyed hashes"));
    EXPECT_THAT(details_, HasSubstr("clips/first.mp4 is not named by its token"));
}

TEST_F(CheckStudy, SeesAConditionInATextOrInTheScript) {
    change("public/pages.json", [](Json& pages) { pages["title"] = "Is ours better?"; });
    EXPECT_THAT(failing_when_resealed(),
                ElementsAre("the page says and asks what the plan does, and nothing else",
                            "no name of a condition in what participants read"));
    EXPECT_THAT(details_, HasSubstr("\"ours\" stands in \"Is ours better?\"\n"));
    change("public/pages.json", [](Json& pages) { pages["title"] = sample_plan()["title"]; });
    std::ofstream(study_ / "public/player.js", std::ios::app) << "// A is ours\n";
    EXPECT_THAT(failing_when_resealed(), ElementsAre("no name of a condition in what participants read"));
    EXPECT_EQ(details_, "player.js is not this program's own\n");
}

// A box that players skip, with a name in it, at the end of both videos of a clip.
TEST_F(CheckStudy, SeesAConditionInAVideo) {
    for (const fs::path& file : videos_of_c1()) {
        std::ofstream(file, std::ios::app | std::ios::binary) << std::string(
                                                                     "\0\0\0\x10"
                                                                     "free",
                                                                     8)
                                                              << "Baseline";
    }
    rekey();
    EXPECT_THAT(failing_when_resealed(),
                ElementsAre("no name of a condition or source in the videos",
                            "nothing but zeros beside the pictures and sounds of a video"));
    EXPECT_THAT(details_, StartsWith("\"base\" stands in clips/"));
}

TEST_F(CheckStudy, SeesATag) {
    if (!remake("-metadata comment=rendered-at-night")) GTEST_SKIP() << "needs the ffmpeg program";
    EXPECT_THAT(failing_when_resealed(), ElementsAre("no tag of a tool, a time or a file in the videos"));
    EXPECT_THAT(details_, HasSubstr("comment = \"rendered-at-night\""));
}

TEST_F(CheckStudy, SeesSoundThatEndsTooEarly) {
    if (!remake("-c:a aac -af atrim=0:0.4")) GTEST_SKIP() << "needs the ffmpeg program";
    EXPECT_THAT(failing_when_resealed(), ElementsAre("sound and picture begin and end together"));
    EXPECT_THAT(details_, HasSubstr("ms apart, at most a frame of 33 ms is allowed"));
}

TEST_F(CheckStudy, SeesALouderVideo) {
    testing::write_tiny_video(videos_of_c1()[1],
                              {.size = {.width = 64, .height = 48}, .fps = {}, .frames = 21, .gain = 0.2f});
    make_sizes_equal(videos_of_c1());
    rekey();
    EXPECT_THAT(failing_when_resealed(), ElementsAre("videos of a clip with the same speech sound the same",
                                                     "videos of a clip are equally loud"));
    EXPECT_THAT(details_, HasSubstr(" LUFS"));
}

TEST_F(CheckStudy, SeesTheKeyInPublic) {
    fs::copy_file(study_ / "private/key.json", study_ / "public/key.json");
    reset_times_and_permissions(study_ / "public");
    EXPECT_THAT(failing(), ElementsAre("public/ holds nothing else"));
}

TEST_F(CheckStudy, SeesOrdersThatRevealACondition) {
    testing::write_sample_inputs(folder_.path());
    Json json = sample_plan();
    json["render"]["size"] = {64, 48};
    const Json clip = json["clips"][0];
    json["clips"] = Json::array();
    for (int i = 0; i < 16; ++i) {
        json["clips"].push_back(clip);
        json["clips"].back()["id"] = format("clip {}", i);
    }
    json["layout"] = "single";
    write_json(folder_ / "plan.json", json);
    build_study(read_plan(folder_ / "plan.json"), {.out = folder_ / "many", .seed = 1, .quiet = true},
                testing::tiny_maker(FakeMaker()));
    study_ = folder_ / "many";
    EXPECT_THAT(failing(), ::testing::IsEmpty()) << details_;
    // Puts the pages with "ours" first, in every clip.
    const Json key = read_json(study_ / "private/key.json");
    std::vector<Json> ours, theirs;
    for (const Json& page : key["pages"])
        (page["places"][0]["condition"] == "ours" ? ours : theirs).push_back(page);
    change_key([&](Json& changed) {
        for (std::size_t i = 0; i < 16; ++i) {
            changed["pages"][i] = ours[i];
            changed["pages"][16 + i] = theirs[i];
        }
    });
    change("public/pages.json", [&](Json& pages) {
        const Json before = pages["pages"];
        for (std::size_t i = 0; i < 32; ++i) {
            const Json page = i < 16 ? ours[i] : theirs[i - 16];
            for (const Json& each : before) {
                if (each["id"] == page["page"]) pages["pages"][i] = each;
            }
        }
    });
    EXPECT_THAT(failing_when_resealed(), Contains("nothing but pictures and sounds predicts a condition"));
    EXPECT_THAT(details_, HasSubstr("best by page of the list: 100 % of 32 videos"));
}

TEST_F(CheckStudy, SeesAMissingSound) {
    if (!remake("-an")) GTEST_SKIP() << "needs the ffmpeg program";
    EXPECT_THAT(failing_when_resealed(), ElementsAre("sound and picture begin and end together"));
    EXPECT_THAT(details_, HasSubstr("has no sound"));
}

TEST_F(CheckStudy, SeesAVideoOfAnotherSize) {
    testing::write_tiny_video(videos_of_c1()[1],
                              {.size = {.width = 66, .height = 48}, .fps = {}, .frames = 21});
    make_sizes_equal(videos_of_c1());
    rekey();
    EXPECT_THAT(failing_when_resealed(),
                ElementsAre("videos of a clip have the same size, rate and encoding"));
    EXPECT_THAT(details_, HasSubstr("66x48 at 30"));
}

TEST_F(CheckStudy, SeesAShorterVideo) {
    testing::write_tiny_video(videos_of_c1()[1],
                              {.size = {.width = 64, .height = 48}, .fps = {}, .frames = 20});
    make_sizes_equal(videos_of_c1());
    rekey();
    change_key([&](Json& key) {
        for (Json& video : key["videos"]) {
            if (file_of(video) == videos_of_c1()[1]) video["frames"] = 20;
        }
    });
    EXPECT_THAT(failing_when_resealed(), ElementsAre("videos of a clip are equally long",
                                                     "videos of a clip with the same speech sound the same"));
    EXPECT_THAT(details_, HasSubstr("0.700 s; 0.667 s"));
}

TEST_F(CheckStudy, SeesAVideoWithOtherFramesThanRecorded) {
    change_key([](Json& key) { key["videos"][0]["frames"] = 22; });
    EXPECT_THAT(failing_when_resealed(), ElementsAre("every video is whole"));
    EXPECT_THAT(details_, HasSubstr(" has 21 frames, 22 were recorded"));
}

TEST_F(CheckStudy, SeesATruncatedVideo) {
    const fs::path file = videos_of_c1()[0];
    fs::resize_file(file, fs::file_size(file) / 2);
    rekey();
    EXPECT_THAT(failing_when_resealed(), Contains("every video is whole"));
    EXPECT_THAT(details_, HasSubstr(file.filename().string()));
}

TEST_F(CheckStudy, SeesAVideoOfAnotherNumberOfBytes) {
    const fs::path file = videos_of_c1()[0];
    pad_clip(file, fs::file_size(file) + kLeastPadding);
    rekey();
    EXPECT_THAT(failing_when_resealed(), ElementsAre("videos of a clip have the same number of bytes"));
}

TEST_F(CheckStudy, SeesATimeOrPermissionsOfItsOwn) {
    fs::last_write_time(videos_of_c1()[0], fs::file_time_type::clock::now());
    EXPECT_THAT(failing(), ElementsAre("times and permissions are neutral"));
    EXPECT_THAT(details_, HasSubstr(" has a time of its own"));
    reset_times_and_permissions(study_ / "public");
    fs::permissions(study_ / "public/style.css", fs::perms::owner_all);
    EXPECT_THAT(failing(), ElementsAre("times and permissions are neutral"));
    EXPECT_EQ(details_, "public/style.css has permissions of its own\n");
}

TEST_F(CheckStudy, SeesSidesThatAreNotBalanced) {
    change_key([](Json& key) { std::swap(key["pages"][0]["places"][0], key["pages"][0]["places"][1]); });
    change("public/pages.json", [](Json& pages) {
        Json& videos = pages["pages"][0]["videos"];
        std::swap(videos[0], videos[1]);
    });
    EXPECT_THAT(failing_when_resealed(), ElementsAre("sides are balanced", "orders are balanced"));
    EXPECT_THAT(details_, StartsWith("ours : baseline: one participant sees them 2 apart\n"));
}

TEST_F(CheckStudy, SeesOrdersThatAreNotBalanced) {
    change("public/pages.json", [](Json& pages) { pages["sheets"][2] = pages["sheets"][0]; });
    EXPECT_THAT(failing_when_resealed(), Contains("orders are balanced"));
    EXPECT_THAT(details_, HasSubstr("they are not those that the seed draws\n"));
}

TEST_F(CheckStudy, SeesSidesThatSwapTooOften) {
    change("public/pages.json", [](Json& pages) {
        for (Json& sheet : pages["sheets"]) {
            for (Json& shown : sheet["pages"]) shown[1] = {0, 1};
        }
    });
    EXPECT_THAT(failing_when_resealed(), ElementsAre("sides are balanced", "orders are balanced"));
    EXPECT_THAT(details_, HasSubstr("one page is shown either way 4 apart"));
}

// Two clips in two orders: a row of two places and the other one, then every page the same way.
TEST_F(CheckStudy, JudgesPlacesOfParallelPages) {
    build_with({{"layout", "parallel"}});
    EXPECT_THAT(failing(), IsEmpty()) << details_;
    EXPECT_EQ(
        detail_of("sides are balanced"),
        "1 pair of conditions, at each place of a page to within 1 over all orders, not for each participant; "
        "at most 0 apart over all orders");
    change("public/pages.json", [](Json& pages) {
        for (Json& sheet : pages["sheets"]) {
            for (Json& shown : sheet["pages"]) shown[1] = {0, 1};
        }
    });
    EXPECT_THAT(failing_when_resealed(), ElementsAre("sides are balanced", "orders are balanced"));
    EXPECT_THAT(details_, HasSubstr(": its conditions stand at its places 2 apart, at most 1 is balanced\n"));
}

// Three conditions at three places take six orders. Of one order each participant adds to what the last one left.
TEST_F(CheckStudy, SeesOrdersThatFavourConditionsTheMoreParticipantsTakeThem) {
    Json plan = {
        {"layout", "parallel"},
        {"conditions", {"ours", "baseline", {{"name", "frozen"}, {"from", "ours"}, {"by", "frozen"}}}}};
    build_with(plan);
    EXPECT_EQ(read_json(study_ / "public/pages.json")["sheets"].size(), 6u);
    EXPECT_THAT(failing(), IsEmpty()) << details_;
    EXPECT_THAT(detail_of("sides are balanced"), HasSubstr("at most 0 apart over all orders"));
    plan["orders"] = 2;
    build_with(plan);
    EXPECT_THAT(failing(), ElementsAre("sides are balanced"));
    EXPECT_EQ(
        details_,
        "2 orders leave the conditions of a page 2 apart at its places each time that all are taken, at most 0 is "
        "balanced; build the study with \"orders\": 6, or without \"orders\"\n");
    plan["participants"] = 2;
    build_with(plan);
    EXPECT_THAT(failing(), IsEmpty()) << details_;
    // A study of an earlier version, whose plan does not say how many orders there are.
    plan["participants"] = 40;
    build_with(plan);
    change("private/plan.json", [](Json& used) { used.erase("orders"); });
    EXPECT_THAT(failing_when_resealed(), ElementsAre("sides are balanced"));
    EXPECT_EQ(
        details_,
        "2 orders leave the conditions of a page 40 apart at its places after 40 participants, at most 2 is "
        "balanced; build the study again, as this version of the program makes 6 orders\n");
}

TEST_F(CheckStudy, SaysThatSidesInOneVideoStayAsTheyAre) {
    build_with({{"presentation", "one video"}});
    EXPECT_THAT(detail_of("sides are balanced"),
                HasSubstr("each either way to within 1 for each participant, a page always the same way"));
}

TEST_F(CheckStudy, SeesAnInstructionInATrial) {
    change_key([](Json& key) {
        key["videos"][0]["instruction"] = {{"text", "Answer B"}, {"spoken", false}};
    });
    EXPECT_THAT(failing_when_resealed(),
                ElementsAre("instructions stand in attention checks alone, each with its answer"));
    EXPECT_THAT(details_, HasSubstr(" is a trial with 1 instruction"));
}

// ---- Refusals

TEST_F(CheckStudy, RefusesWhatIsNoStudy) {
    EXPECT_EQ(refusal_of([&] { check_study(folder_ / "none"); }),
              (folder_ / "none").string() + ": there is no such folder; name the folder of a study");
    EXPECT_EQ(
        refusal_of([&] { check_study(study_ / "public"); }),
        (study_ / "public").string() +
            ": holds no study (private/manifest.json and public/ are needed); name the folder that a study "
            "was built into");
    fs::create_directories(folder_ / "begun/private/work");
    EXPECT_EQ(refusal_of([&] { check_study(folder_ / "begun"); }),
              (folder_ / "begun").string() + ": this study is not finished; run the same build again");
}

TEST_F(CheckStudy, RefusesAKeyThatNamesWhatTheStudyLacks) {
    const Json whole = read_json(study_ / "private/key.json");
    const auto refusal_after = [&](const std::function<void(Json&)>& edit) {
        change_key(edit);
        const std::string refusal = refusal_of([&] { check_study(study_); });
        write_json(study_ / "private/key.json", whole);
        return refusal;
    };
    EXPECT_THAT(refusal_after([](Json& key) { key["pages"][0]["places"][0]["condition"] = "theirs"; }),
                HasSubstr("key.json: pages[0].places[0].condition: is \"theirs\", which is none of"));
    EXPECT_THAT(refusal_after([](Json& key) { key["pages"][0]["places"][0]["video"] = "0a"; }),
                HasSubstr("key.json: pages[0].places[0].video: is \"0a\", which is none of"));
    EXPECT_THAT(refusal_after([](Json& key) { key["pages"][0]["clip"] = "c9"; }),
                HasSubstr("key.json: pages[0].clip: is \"c9\", which is none of \"c1\""));
    EXPECT_THAT(refusal_after([](Json& key) { key["design"]["moving"] = "round"; }),
                HasSubstr("key.json: design.moving: is \"round\", which is none of \"fixed\""));
    EXPECT_THAT(refusal_after([](Json& key) { key["pages"] = Json::array(); }),
                HasSubstr("key.json: pages: has 0 entries, at least 1 are needed"));
}

TEST_F(CheckStudy, RefusesSheetsThatCannotBeShown) {
    const Json whole = read_json(study_ / "public/pages.json");
    const std::vector<std::pair<Json, std::string>> broken = {
        {{{0, {0, 1}}, {0, {0, 1}}}, "sheets[0].pages[1][0]: stands twice on this sheet"},
        {{{0, {0, 1}}, {7, {0, 1}}}, "sheets[0].pages[1][0]: is 7, a whole number from 0 to 1 is needed"},
        {{{0, {0, 0}}, {1, {0, 1}}}, "is [0,0], each video of the page is needed once"},
        {{{0, {0}}, {1, {0, 1}}}, "is [0], each video of the page is needed once"}};
    for (const auto& [pages_of_sheet, fault] : broken) {
        Json pages = whole;
        pages["sheets"][0]["pages"] = pages_of_sheet;
        write_json(study_ / "public/pages.json", pages);
        EXPECT_THAT(refusal_of([&] { check_study(study_); }), HasSubstr(fault));
    }
}

TEST_F(CheckStudy, RefusesADamagedKeyOrList) {
    for (const auto& [file, lost] :
         {std::pair("private/key.json", "seed"), std::pair("private/manifest.json", "outputs"),
          std::pair("public/pages.json", "sheets")}) {
        const std::string whole = read_text(study_ / file);
        change(file, [&](Json& json) { json.erase(lost); });
        EXPECT_EQ(refusal_of([&] { check_study(study_); }),
                  format("{}: {}: is missing; add it", (study_ / file).string(), lost));
        write_text(study_ / file, whole);
    }
    change("public/pages.json", [](Json& json) { json["format"] = "chironomia pages 9"; });
    EXPECT_THAT(
        refusal_of([&] { check_study(study_); }),
        HasSubstr("pages.json: format: is \"chironomia pages 9\", which is none of \"chironomia pages 2\""));
}

}  // namespace
}  // namespace chironomia::study
