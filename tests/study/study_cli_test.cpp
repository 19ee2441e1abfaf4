// Studies from the bundled samples, built and checked by the real binary with the real renderer.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <chrono>
#include <cstdlib>
#include <fstream>
#include <map>
#include <set>

#include "core/files/files.h"
#include "core/files/json.h"
#include "core/text.h"
#include "study/build/study_files.h"
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

class StudyOfSamples : public ::testing::Test {
  protected:
    // The sample plan, small, slow, short and with an avatar that is loaded at once.
    StudyOfSamples() {
        const fs::path samples = source_dir() / "assets/samples";
        Json plan = read_json(samples / "plan.json");
        plan["render"]["size"] = {160, 90};
        plan["render"]["fps"] = 10;
        plan["render"]["avatar"] = "mannequin";
        plan["clips"].erase(1);
        plan["clips"][0]["cut"] = {0, 2};
        fs::copy(samples, folder_.path(), fs::copy_options::recursive);
        write_json(folder_ / "plan.json", plan);
    }

    std::vector<std::string> build_words(const std::string& name, const std::string& jobs = "1") {
        return {"study",
                "build",
                (folder_ / "plan.json").string(),
                "--out",
                (folder_ / name).string(),
                "--seed",
                "3",
                "--jobs",
                jobs,
                "--quiet"};
    }

    Outcome check(const std::string& name) {
        return run_chironomia({"study", "check", (folder_ / name).string()});
    }

    std::map<std::string, std::string> files_of(const std::string& name) {
        std::map<std::string, std::string> files;
        for (const std::string& file : list_files(folder_ / name)) {
            files[file] = read_text(folder_ / name / file);
        }
        return files;
    }

    TemporaryFolder folder_;
};

// With the avatar of the samples, which has pictures on it.
TEST_F(StudyOfSamples, IsBuiltAndProvedWithTheSameBytesForAnyNumberOfJobs) {
    Json plan = read_json(folder_ / "plan.json");
    plan["render"]["avatar"] = "neutral";
    write_json(folder_ / "plan.json", plan);
    const Outcome built = run_chironomia(build_words("alone"));
    ASSERT_EQ(built.exit_code, 0) << built.err;
    EXPECT_THAT(built.out, HasSubstr("1 pages in 2 orders, 2 videos (2 recorded now)"));
    const Outcome proved = check("alone");
    EXPECT_EQ(proved.exit_code, 0) << proved.out;
    ASSERT_EQ(run_chironomia(build_words("both", "2")).exit_code, 0);
    EXPECT_EQ(files_of("both"), files_of("alone"));
    EXPECT_THAT(run_chironomia(build_words("alone")).out, HasSubstr("2 videos (0 recorded now)"));
}

TEST_F(StudyOfSamples, ShowsTheBalanceBeforeAnythingIsRendered) {
    const Outcome planned =
        run_chironomia({"study", "plan", (folder_ / "plan.json").string(), "--seed", "3"});
    EXPECT_EQ(planned.exit_code, 0) << planned.err;
    EXPECT_THAT(planned.out, HasSubstr("conditions    expressive, restrained"));
    EXPECT_THAT(planned.out,
                HasSubstr("Over all 2 orders, times that each page is shown: 2, at each position: 2."));
    EXPECT_FALSE(fs::exists(folder_ / "alone"));
    const Outcome built = run_chironomia(build_words("alone"));
    EXPECT_LT(built.out.find("Over all 2 orders"), built.out.find("2 videos"));
    const Outcome filled = run_chironomia({"study", "plan", (folder_ / "plan.json").string(), "--json"});
    EXPECT_EQ(Json::parse(filled.out)["questions"][0]["kind"], "preference");
}

// Two manners of a text, and of a recording whose words are known, are performed, rendered, proved and built again.
TEST_F(StudyOfSamples, PerformsMannersOfTheEngine) {
    Json plan = read_json(folder_ / "plan.json");
    plan["conditions"] = {{{"name", "generic"}, {"from", "neutral"}, {"manner", Json::object()}},
                          {{"name", "spc high"}, {"from", "generic"}, {"manner", {{"spc", 0.8}}}}};
    plan["clips"] = {{{"id", "spoken"}, {"text", "Two ways."}, {"cut", {0, 2}}},
                     {{"id", "recorded"},
                      {"audio", "speech/two-ways.wav"},
                      {"words", "speech/two-ways.words.csv"},
                      {"cut", {0, 2}}}};
    write_json(folder_ / "plan.json", plan);
    const Outcome built = run_chironomia(build_words("study"));
    ASSERT_EQ(built.exit_code, 0) << built.err;
    EXPECT_THAT(built.out, HasSubstr("4 videos (4 recorded now)"));
    const Outcome proved = run_chironomia(
        {"study", "check", (folder_ / "study").string(), "--again", (folder_ / "plan.json").string()});
    EXPECT_EQ(proved.exit_code, 0) << proved.out;
    ASSERT_EQ(run_chironomia(build_words("again", "2")).exit_code, 0);
    EXPECT_EQ(files_of("again"), files_of("study"));
    plan["conditions"][1]["manner"]["spc"] = 8;
    write_json(folder_ / "plan.json", plan);
    const Outcome refused = run_chironomia(build_words("none"));
    EXPECT_EQ(refused.exit_code, 3);
    EXPECT_THAT(refused.err, HasSubstr("conditions[1].manner.spc: is 8, a number from -1 to 1 is needed"));
}

TEST_F(StudyOfSamples, ListsTheProtocolsOfTheField) {
    const Outcome listed = run_chironomia({"study", "presets"});
    EXPECT_EQ(listed.exit_code, 0) << listed.err;
    EXPECT_THAT(listed.out, HasSubstr("realism-2025\n"));
    EXPECT_THAT(listed.out,
                HasSubstr("participants 105, conditions 3, clips 30, blocks 3, pages per participant 10"));
    const Json all = Json::parse(run_chironomia({"study", "presets", "--json"}).out);
    const std::filesystem::directory_iterator files(testing::source_dir() / "study/presets");
    EXPECT_EQ(all.size(), std::ranges::count_if(
                              files, [](const auto& file) { return file.path().extension() == ".json"; }));
    EXPECT_EQ(all[0]["name"], "face-and-head");
}

// The questions of the thesis speak of "the baseline video"; a text of the user's own must not.
TEST_F(StudyOfSamples, MayHaveAConditionThatAPrintedQuestionNames) {
    Json plan = read_json(folder_ / "plan.json");
    const auto motion_of = [&](const char* name) { return plan["clips"][0]["motion"][name]; };
    plan["clips"][0]["motion"] = {{"ours", motion_of("expressive")}, {"baseline", motion_of("restrained")}};
    plan["conditions"] = {
        "ours", "baseline", {{"name", "half"}, {"from", "ours"}, {"by", "damped"}, {"factor", 0.5}}};
    for (const char* key : {"title", "layout", "question", "answers", "instructions"}) plan.erase(key);
    plan["checks"] = {{"count", 0}};
    plan["participants"] = 2;
    plan["reference"] = "baseline";
    for (const std::string variant : {"", "-unseen", "-mix-stage"}) {
        plan["preset"] = "thesis-3d-style-transfer" + variant;
        write_json(folder_ / "plan.json", plan);
        const Outcome planned = run_chironomia({"study", "plan", (folder_ / "plan.json").string()});
        EXPECT_EQ(planned.exit_code, 0) << planned.err;
        const Outcome built = run_chironomia(build_words("study" + variant));
        ASSERT_EQ(built.exit_code, 0) << built.err;
        const Outcome proved = check("study" + variant);
        EXPECT_EQ(proved.exit_code, 0) << proved.out;
    }
    plan["title"] = "Better than the baseline?";
    write_json(folder_ / "plan.json", plan);
    const Outcome refused = run_chironomia(build_words("none"));
    EXPECT_EQ(refused.exit_code, 3);
    EXPECT_THAT(refused.err,
                HasSubstr("title: shows participants the name of the condition \"baseline\"; write it "
                          "without, or rename the condition"));
    plan.erase("title");
    plan["conditions"][2]["name"] = "A";
    write_json(folder_ / "plan.json", plan);
    EXPECT_THAT(
        run_chironomia(build_words("none")).err,
        HasSubstr("questions[0]: shows participants the name of the condition \"A\"; write it without, or "
                  "rename the condition"));
}

// As the thesis prints of its studies of faces.
TEST_F(StudyOfSamples, AsksAllChecksAtTheBeginning) {
    Json plan = read_json(folder_ / "plans/thesis-sd.json");
    plan["render"] = {{"size", {160, 120}}, {"fps", 10}};
    plan["checks"] = {{"count", 2}, {"kinds", {"text"}}, {"instruction", "{answer}"}};
    for (Json& clip : plan["clips"]) clip["cut"] = {0.5, 0.8};
    const fs::path file = folder_ / "plans/tiny.json";
    write_json(file, plan);
    const Outcome built = run_chironomia(
        {"study", "build", file.string(), "--out", (folder_ / "study").string(), "--seed", "3", "--quiet"});
    ASSERT_EQ(built.exit_code, 0) << built.err;
    EXPECT_EQ(check("study").exit_code, 0);
    const Json pages = read_json(folder_ / "study/public/pages.json");
    const Json key = read_json(folder_ / "study/private/key.json");
    std::set<std::string> checks;
    for (const Json& page : key["pages"])
        if (page["kind"] == "check") checks.insert(page["page"]);
    ASSERT_EQ(checks.size(), 2u);
    std::set<std::size_t> places;
    for (const Json& sheet : pages["sheets"]) {
        std::size_t found = 0;
        for (std::size_t i = 0; i < sheet["pages"].size(); ++i) {
            const Json& page = pages["pages"][sheet["pages"][i][0].get<std::size_t>()];
            if (!checks.contains(page["id"])) continue;
            EXPECT_LT(i, 5u) << "before one of the first three trials";
            places.insert(i);
            ++found;
        }
        EXPECT_EQ(found, 2u);
    }
    EXPECT_GE(places.size(), 4u) << "not always the same ones";
}

// Each arm alone, and a body that turns, before the triplets of stick figures.
TEST_F(StudyOfSamples, ShowsShotsInItsTraining) {
    Json plan = read_json(folder_ / "plans/thesis-style-seen.json");
    plan["render"] = {{"size", {96, 96}}, {"fps", 10}};
    plan["checks"] = {{"count", 0}};
    plan["blocks"] = 1;
    plan["clips"].erase(plan["clips"].begin() + 4, plan["clips"].end());
    for (Json& clip : plan["clips"]) clip["cut"] = {0.5, 1.5};
    const fs::path file = folder_ / "plans/tiny.json";
    write_json(file, plan);
    EXPECT_THAT(run_chironomia({"study", "plan", file.string()}).out,
                HasSubstr("clips         1, and 3 for practice"));
    const Outcome built = run_chironomia(
        {"study", "build", file.string(), "--out", (folder_ / "study").string(), "--seed", "3", "--quiet"});
    ASSERT_EQ(built.exit_code, 0) << built.err;
    const Outcome proved = check("study");
    EXPECT_EQ(proved.exit_code, 0) << proved.out;
    const Json pages = read_json(folder_ / "study/public/pages.json");
    ASSERT_EQ(pages["training"]["pages"].size(), 3u);
    const std::size_t first = pages["training"]["pages"][0];
    EXPECT_EQ(pages["pages"][first]["caption"], "Here the figure gestures with its right arm.");
}

TEST_F(StudyOfSamples, ShowsAPartnerAndIsProved) {
    Json plan = read_json(folder_ / "plan.json");
    plan["render"]["scene"] = "dyad";
    plan["render"]["cue"] = "light";
    const std::string condition = plan["conditions"][0];
    plan["clips"][0]["partner"] = {{"motion", plan["clips"][0]["motion"][condition]},
                                   {"audio", plan["clips"][0]["audio"]}};
    write_json(folder_ / "plan.json", plan);
    const Outcome built = run_chironomia(build_words("study"));
    ASSERT_EQ(built.exit_code, 0) << built.err;
    const Outcome proved = check("study");
    EXPECT_EQ(proved.exit_code, 0) << proved.out;
    EXPECT_THAT(proved.out, HasSubstr("aac 48000 Hz 2 channels"));
}

TEST_F(StudyOfSamples, GoesOnAfterAnInterruptAndAKill) {
    ASSERT_EQ(run_chironomia(build_words("whole")).exit_code, 0);
    for (const auto& [signal, jobs] : {std::pair{SIGINT, "2"}, {SIGKILL, "2"}, {SIGKILL, "1"}}) {
        const Outcome stopped = testing::signal_chironomia_at(folder_ / "stopped/private/work", signal,
                                                              build_words("stopped", jobs));
        EXPECT_EQ(stopped.exit_code, signal == SIGKILL ? 128 + SIGKILL : 130) << stopped.err;
        EXPECT_FALSE(fs::exists(folder_ / "stopped/public"));
        const Outcome again = run_chironomia(build_words("stopped"));
        ASSERT_EQ(again.exit_code, 0) << again.err;
        EXPECT_EQ(files_of("stopped"), files_of("whole"));
        fs::remove_all(folder_ / "stopped");
    }
}

TEST_F(StudyOfSamples, ShowsBothFiguresInOneVideo) {
    Json plan = read_json(folder_ / "plan.json");
    plan["presentation"] = "one video";
    write_json(folder_ / "plan.json", plan);
    const Outcome built = run_chironomia(build_words("study"));
    ASSERT_EQ(built.exit_code, 0) << built.err;
    const Outcome proved = check("study");
    EXPECT_EQ(proved.exit_code, 0) << proved.out;
}

TEST_F(StudyOfSamples, FailsTheCheckWithOneAndAWrongPlanWithThree) {
    ASSERT_EQ(run_chironomia(build_words("study")).exit_code, 0);
    std::ofstream(folder_ / "study/private/plan.json", std::ios::app) << ' ';
    const Outcome proved = check("study");
    EXPECT_EQ(proved.exit_code, 1);
    EXPECT_THAT(proved.out, HasSubstr("private/plan.json has changed"));

    write_text(folder_ / "plan.json", "{\"titl\": \"x\"}");
    const Outcome refused = run_chironomia(build_words("other"));
    EXPECT_EQ(refused.exit_code, 3);
    EXPECT_THAT(refused.err, HasSubstr("titl: there is no such key; did you mean \"title\"?"));
    EXPECT_FALSE(fs::exists(folder_ / "other"));
    EXPECT_EQ(check("none").exit_code, 3);
}

// Python gives each file the time at which it unpacks it, unzip the date of the archive in the zone of the machine.
TEST_F(StudyOfSamples, IsProvedAfterItWasPackedAndUnpacked) {
    ASSERT_EQ(run_chironomia(build_words("study")).exit_code, 0);
    const fs::path archive = folder_ / "study.zip", unpacked = folder_ / "unpacked";
    ASSERT_EQ(run_chironomia(
                  {"study", "pack", (folder_ / "study").string(), "--with-key", "--out", archive.string()})
                  .exit_code,
              0);
    const std::string unpack =
        format("umask 022; /usr/bin/python3 -m zipfile -e '{}' '{}'", archive.string(), unpacked.string());
    ASSERT_EQ(std::system(unpack.c_str()), 0);
    const Outcome proved = check("unpacked");
    EXPECT_EQ(proved.exit_code, 0) << proved.out;
    EXPECT_THAT(proved.out, HasSubstr("files and folders, unpacked in the order of their names"));

    const auto date = fs::file_time_type::clock::now() - std::chrono::hours(24);
    for (const std::string& name : list_files(unpacked)) fs::last_write_time(unpacked / name, date);
    EXPECT_EQ(check("unpacked").exit_code, 0);
    fs::last_write_time(unpacked / "public/index.html", date + std::chrono::hours(1));
    const Outcome touched = check("unpacked");
    EXPECT_EQ(touched.exit_code, 1);
    EXPECT_THAT(touched.out, HasSubstr("is older than index.html, which was packed before it; unpack the "
                                       "archive again, one file after the other"));
    fs::remove(unpacked / "archive.json");
    EXPECT_THAT(check("unpacked").out,
                HasSubstr(" has a time of its own; copy with times kept, or build again"));
}

TEST_F(StudyOfSamples, IsComparedWithWhatItsPlanBuilds) {
    ASSERT_EQ(run_chironomia(build_words("study")).exit_code, 0);
    const auto again = [&] {
        return run_chironomia(
            {"study", "check", (folder_ / "study").string(), "--again", (folder_ / "plan.json").string()});
    };
    const Outcome same = again();
    EXPECT_EQ(same.exit_code, 0) << same.err;
    EXPECT_THAT(same.out, HasSubstr("yes  built again from its plan it has the same bytes"));

    // The motion of one condition is no longer the one that was shown.
    fs::copy_file(folder_ / "restrained/two-ways.bvh", folder_ / "expressive/two-ways.bvh",
                  fs::copy_options::overwrite_existing);
    const Outcome other = again();
    EXPECT_EQ(other.exit_code, 1) << other.err;
    EXPECT_THAT(other.out, HasSubstr("NO   built again from its plan it has the same bytes"));
}

}  // namespace
}  // namespace chironomia::study
