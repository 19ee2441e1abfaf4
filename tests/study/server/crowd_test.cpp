// Many participants at once: no answer is lost, doubled or given to somebody else, also when the server is
// killed.
#include <gtest/gtest.h>

#include <chrono>
#include <map>
#include <thread>

#include "study/server/answers_file.h"
#include "study/server/serve.h"
#include "tests/study/process.h"
#include "tests/study/served_sample.h"
#include "tests/study/server/crowd.h"
#include "tests/support/support.h"

namespace chironomia::study::server {
namespace {

using testing::fault_of_answers;
using testing::RunningChironomia;
using testing::send_crowd;
using testing::TemporaryFolder;
using testing::Visit;
using testing::write_sample_study;

constexpr std::size_t kPeople = 200;
constexpr std::size_t kPages = 20;
constexpr std::size_t kSheets = 8;
constexpr int kKills = 10;

std::size_t count_finished(const std::vector<Visit>& visits) {
    return static_cast<std::size_t>(
        std::count_if(visits.begin(), visits.end(), [](const Visit& visit) { return visit.finished; }));
}

TEST(Crowd, Of200LosesNoAnswer) {
    const TemporaryFolder folder;
    write_sample_study(folder.path(), {.trials = kPages, .checks = 0, .sheets = kSheets});
    const ServedStudy study = read_served_study(folder.path());
    StudyServer server(
        {.study = folder.path(), .port = 0, .requests = 1e6, .newcomers = 1e6, .connections = 1000});
    std::thread serving([&] { server.run(); });
    const std::vector<Visit> visits =
        send_crowd(study, {.people = kPeople, .port = [&] { return server.port(); }, .watches = true});
    server.stop();
    serving.join();

    EXPECT_EQ(fault_of_answers(study, default_database(folder.path()), visits), "");
    EXPECT_EQ(count_finished(visits), kPeople);
    std::map<std::size_t, std::size_t> on_sheet;
    for (const Visit& visit : visits) ++on_sheet[visit.sheet];
    for (const auto& [sheet, people] : on_sheet) EXPECT_EQ(people, kPeople / kSheets) << "sheet " << sheet;
}

// The port in the line that says where participants go.
int port_in(const std::string& out) {
    const std::string before = "http://127.0.0.1:";
    const std::size_t at = out.find(before);
    return at == std::string::npos ? 0 : std::atoi(out.c_str() + at + before.size());
}

TEST(Crowd, LosesNothingWhenTheServerIsKilledTenTimes) {
    const TemporaryFolder folder;
    write_sample_study(folder.path(), {.trials = kPages, .checks = 0, .sheets = kSheets});
    const ServedStudy study = read_served_study(folder.path());
    const std::vector<std::string> words = {
        "study",       "serve",   folder.path().string(), "--port", "0", "--rate", "1000000",
        "--newcomers", "1000000", "--connections",        "1000"};
    std::atomic<int> port = 0;
    std::atomic<std::size_t> acknowledged = 0;
    std::atomic<bool> all_done = false;
    std::vector<Visit> visits;
    std::thread crowd([&] {
        visits = send_crowd(study, {.people = kPeople,
                                    .port = [&] { return port.load(); },
                                    .acknowledged = &acknowledged,
                                    .watches = true});
        all_done = true;
    });
    // Each server is killed after a share of the answers, while the others are on their way.
    int kills = 0;
    for (std::size_t i = 1; !all_done; ++i) {
        RunningChironomia server(words);
        port = port_in(server.wait_for_out("token"));
        const std::size_t share = kPeople * kPages * i / (kKills + 1);
        while (!all_done && (kills == kKills || acknowledged < share)) {
            std::this_thread::sleep_for(std::chrono::milliseconds(1));
        }
        kills += !all_done;
        EXPECT_EQ(server.end(SIGKILL).exit_code, 128 + SIGKILL);
    }
    crowd.join();

    EXPECT_EQ(kills, kKills);
    EXPECT_EQ(fault_of_answers(study, default_database(folder.path()), visits), "");
    EXPECT_EQ(count_finished(visits), kPeople);
}

}  // namespace
}  // namespace chironomia::study::server
