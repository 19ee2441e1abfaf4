// A study from a text to its archive, by the commands of its users, on one folder.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <atomic>
#include <csignal>
#include <cstdlib>
#include <thread>

#include "core/files/files.h"
#include "core/files/json.h"
#include "core/text.h"
#include "study/server/answers_file.h"
#include "tests/study/process.h"
#include "tests/study/served_sample.h"
#include "tests/study/server/crowd.h"
#include "tests/support/support.h"

namespace chironomia::study::server {
namespace {

namespace fs = std::filesystem;
using ::testing::HasSubstr;
using ::testing::Not;
using testing::Outcome;
using testing::run_chironomia;
using testing::RunningChironomia;
using testing::TemporaryFolder;

using Words = std::vector<std::string>;

// What `sample_entry` answers is asked here too.
void write_plan(const fs::path& folder) {
    Json plan = {{"title", "Two manners"},
                 {"layout", "pair"},
                 {"conditions", {"ours", "baseline"}},
                 {"render", {{"avatar", "stick"}, {"size", {64, 36}}, {"fps", 5}}},
                 {"sound_check", false},
                 {"questions", testing::sample_pages({})["questions"]},
                 {"questionnaire", testing::sample_pages({})["questionnaire"]},
                 {"participants", 6},
                 {"preregistration", {{"hypotheses", "Ours is preferred."}}}};
    plan["clips"] = {
        {{"id", "c"}, {"audio", "c.wav"}, {"motion", {{"ours", "ours.h5"}, {"baseline", "baseline.h5"}}}}};
    write_json(folder / "plan.json", plan);
}

std::vector<Words> commands_of_making(const fs::path& folder) {
    const auto in = [&](const char* name) { return (folder / name).string(); };
    return {{"synth", "--text", "There are two ways.", "--out", in("ours.h5"), "--speech-out", in("c.wav")},
            {"synth", "--text", "There are two ways.", "--speaker", "sluggish", "--out", in("baseline.h5")},
            {"study", "plan", in("plan.json"), "--preregister", in("preregistration.html")},
            {"study", "build", in("plan.json"), "--out", in("study"), "--seed", "3"},
            {"study", "check", in("study")}};
}

int port_in(const std::string& out) {
    const std::string before = "http://127.0.0.1:";
    return std::atoi(out.c_str() + out.find(before) + before.size());
}

TEST(StudyLife, GoesFromATextToAnArchive) {
    const TemporaryFolder folder;
    const fs::path study = folder / "study";
    write_plan(folder.path());
    for (const Words& words : commands_of_making(folder.path())) {
        const Outcome made = run_chironomia(words);
        ASSERT_EQ(made.exit_code, 0) << made.err;
    }
    EXPECT_THAT(read_text(folder / "preregistration.html"), HasSubstr("Ours is preferred."));

    // Six people take part at once; after some answers the server is killed, and another one goes on.
    std::atomic<int> port = 0;
    std::atomic<std::size_t> acknowledged = 0;
    const ServedStudy served = read_served_study(study);
    std::vector<testing::Visit> visits;
    std::thread crowd([&] {
        visits = testing::send_crowd(served, {.people = 6,
                                              .port = [&] { return port.load(); },
                                              .acknowledged = &acknowledged,
                                              .watches = true});
    });
    const Words serve = {"study", "serve", study.string(), "--port", "0", "--rate", "1000"};
    {
        RunningChironomia server(serve);
        port = port_in(server.wait_for_out("token"));
        while (acknowledged < 2) std::this_thread::sleep_for(std::chrono::milliseconds(1));
        server.end(SIGKILL);
    }
    RunningChironomia server(serve);
    port = port_in(server.wait_for_out("token"));
    crowd.join();
    EXPECT_EQ(testing::fault_of_answers(served, default_database(study), visits), "");

    // One of them withdraws while the server runs.
    const Outcome forgotten = run_chironomia({"study", "forget", study.string(), "person-2"});
    EXPECT_EQ(forgotten.exit_code, 0) << forgotten.err;
    EXPECT_EQ(server.end(SIGTERM).exit_code, 0);
    const fs::path answers = folder / "answers.json";
    ASSERT_EQ(run_chironomia({"study", "answers", study.string(), "--out", answers.string()}).exit_code, 0);
    EXPECT_EQ(read_json(answers).size(), 5u);
    EXPECT_THAT(read_text(answers), Not(HasSubstr("person-2")));

    const Outcome analysed = run_chironomia(
        {"study", "analyse", study.string(), "--answers", answers.string(), "--samples", "100"});
    EXPECT_EQ(analysed.exit_code, 0) << analysed.err;
    EXPECT_THAT(read_text(study / "private/analysis/report.html"), HasSubstr("baseline"));
    const fs::path archive = folder / "study.zip";
    EXPECT_EQ(run_chironomia({"study", "pack", study.string(), "--with-key", "--with-answers", "--out",
                              archive.string()})
                  .exit_code,
              0);
    const fs::path unpacked = folder / "unpacked";
    ASSERT_EQ(
        std::system(
            format("/usr/bin/python3 -m zipfile -e '{}' '{}'", archive.string(), unpacked.string()).c_str()),
        0);
    EXPECT_EQ(run_chironomia({"study", "check", unpacked.string()}).exit_code, 0);
}

// In a network of its own, which has no connection to any other.
TEST(StudyLife, NeedsNoNetwork) {
    const char* alone = geteuid() == 0 ? "unshare -n" : "unshare -rn";
    if (std::system(format("{} true 2>/dev/null", alone).c_str()) != 0)
        GTEST_SKIP() << "no network of its own can be made here";
    const TemporaryFolder folder;
    write_plan(folder.path());
    for (const Words& words : commands_of_making(folder.path())) {
        std::string line = format("{} '{}'", alone, testing::chironomia_binary().string());
        for (const std::string& word : words) line += format(" '{}'", word);
        EXPECT_EQ(std::system((line + " >/dev/null").c_str()), 0) << line;
    }
}

}  // namespace
}  // namespace chironomia::study::server
