// A study under load: participants walk it all at once, with videos, through the real program on this machine, and the same
// videos are fetched from a plain file server beside it (nginx if it is installed, else Python's http.server).
// `build/release/bin/serve_load [--people 200] [--pages 20] [--kilobytes 300] [--kills 0] [--slow 0]`
// It prints p50 and p99 of each kind of request, the ratio to the file server, and what was lost. Everything is bounded:
// people, pages, and 30 s for one request; it ends by itself.
#include <CLI/CLI.hpp>

#include <arpa/inet.h>
#include <fcntl.h>
#include <netinet/in.h>
#include <sys/prctl.h>
#include <sys/socket.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <atomic>
#include <chrono>
#include <csignal>
#include <cstdio>
#include <cstdlib>
#include <memory>
#include <thread>

#include "core/files/files.h"
#include "core/text.h"
#include "study/server/answers_file.h"
#include "tests/study/process.h"
#include "tests/study/raw_client.h"
#include "tests/study/served_sample.h"
#include "tests/study/server/crowd.h"
#include "tests/support/support.h"

namespace chironomia {

using namespace study;
namespace {

namespace fs = std::filesystem;
using testing::Crowd;
using testing::RawClient;
using testing::RunningChironomia;
using testing::Visit;

struct Load {
    std::size_t people = 200;
    std::size_t pages = 20;
    std::size_t kilobytes =
        300;  // of a video; a clip of 10 s of 1280x720 has about 1000, one of 640x360 about 300
    std::size_t kills = 0;
    std::size_t slow = 0;  // connections that send a request, a letter at a time
};

using Clock = std::chrono::steady_clock;

double seconds_since(Clock::time_point begun) {
    return std::chrono::duration<double>(Clock::now() - begun).count();
}

double share_of(std::vector<double> values, double share) {
    if (values.empty()) return 0;
    std::sort(values.begin(), values.end());
    return values[std::min(values.size() - 1,
                           static_cast<std::size_t>(share * static_cast<double>(values.size())))];
}

void print_line(const std::string& what, const std::vector<double>& seconds) {
    std::printf("%-28s %8zu  p50 %8.2f ms  p99 %8.2f ms\n", what.c_str(), seconds.size(),
                1000 * share_of(seconds, 0.5), 1000 * share_of(seconds, 0.99));
}

// A plain file server of a folder; ended with this program.
class FileServer {
  public:
    FileServer(const fs::path& folder, const fs::path& work) {
        port_ = free_port();
        const fs::path nginx = find_program("nginx");
        name_ = nginx.empty() ? "Python's http.server" : "nginx";
        std::string conf = format(
            "{0}daemon off; worker_processes auto; pid {1}/nginx.pid; error_log /dev/null;\n"
            "events {{ worker_connections 4096; }}\n"
            "http {{ access_log off; sendfile on; keepalive_requests 100000;\n"
            "server {{ listen 127.0.0.1:{2}; root {3}; }}\n",
            geteuid() == 0 ? "user root; " : "", work.string(), port_, folder.string());
        for (const char* kind : {"client_body", "proxy", "fastcgi", "uwsgi", "scgi"})
            conf += format("{}_temp_path {}/{};\n", kind, work.string(), kind);
        write_text(work / "nginx.conf", conf + "}\n");
        child_ = fork();
        if (child_ == 0) {
            prctl(PR_SET_PDEATHSIG, SIGTERM);
            const int nowhere = open("/dev/null", O_WRONLY | O_CLOEXEC);
            dup2(nowhere, STDOUT_FILENO);
            dup2(nowhere, STDERR_FILENO);
            const std::string file = (work / "nginx.conf").string(), port = format("{}", port_);
            if (!nginx.empty()) execl(nginx.c_str(), "nginx", "-c", file.c_str(), nullptr);
            execl("/usr/bin/python3", "python3", "-m", "http.server", port.c_str(), "--bind", "127.0.0.1",
                  "--protocol", "HTTP/1.1", "--directory", folder.c_str(), nullptr);
            _exit(127);
        }
        for (int i = 0; i < 500 && !RawClient(port_).connected(); ++i)
            std::this_thread::sleep_for(std::chrono::milliseconds(20));
    }
    ~FileServer() {
        kill(child_, SIGTERM);
        waitpid(child_, nullptr, 0);
    }
    FileServer(const FileServer&) = delete;
    FileServer& operator=(const FileServer&) = delete;

    int port() const { return port_; }
    const std::string& name() const { return name_; }

  private:
    // Where the shell would find it, or root would; empty: nowhere.
    static fs::path find_program(const std::string& name) {
        const char* path = std::getenv("PATH");
        const std::string folders = std::string(path ? path : "") + ":/usr/sbin";
        for (const std::string_view folder : split(folders, ':')) {
            if (access((fs::path(folder) / name).c_str(), X_OK) == 0) return fs::path(folder) / name;
        }
        return {};
    }

    static int free_port() {
        const int listener = socket(AF_INET, SOCK_STREAM | SOCK_CLOEXEC, 0);
        sockaddr_in address{};
        address.sin_family = AF_INET;
        address.sin_addr.s_addr = htonl(INADDR_LOOPBACK);
        socklen_t size = sizeof(address);
        bind(listener, reinterpret_cast<sockaddr*>(&address), size);
        getsockname(listener, reinterpret_cast<sockaddr*>(&address), &size);
        close(listener);
        return ntohs(address.sin_port);
    }

    int port_ = 0;
    std::string name_;
    pid_t child_ = -1;
};

struct Fetched {
    std::vector<double> seconds;
    std::size_t bytes = 0;
    std::size_t failed = 0;
    double lasted = 0;
};

// All people fetch the videos of their sheets at once, each over one connection.
Fetched fetch_videos(const server::ServedStudy& study, const Load& load, int port) {
    std::vector<Fetched> each(load.people);
    std::vector<std::thread> threads;
    const auto begun = Clock::now();
    for (std::size_t person = 0; person < load.people; ++person) {
        threads.emplace_back([&, person] {
            auto client = std::make_unique<RawClient>(port);
            for (const Step& step : study.sheets[person % study.sheets.size()]) {
                for (const std::size_t place : step.order) {
                    const auto at = Clock::now();
                    const std::string path = "/" + study.pages.pages[step.page].videos[place];
                    std::optional<testing::RawAnswer> got = client->get(path);
                    // A server may close a connection between two requests; browsers open another one.
                    for (int again = 0; again < 5 && !got; ++again) {
                        client = std::make_unique<RawClient>(port);
                        got = client->get(path);
                    }
                    const bool right = got && got->status == 200;
                    each[person].failed += !right;
                    if (!right) continue;
                    each[person].seconds.push_back(seconds_since(at));
                    each[person].bytes += got->body.size();
                }
            }
        });
    }
    for (std::thread& thread : threads) thread.join();
    Fetched all{.seconds = {}, .lasted = seconds_since(begun)};
    for (const Fetched& one : each) {
        all.seconds.insert(all.seconds.end(), one.seconds.begin(), one.seconds.end());
        all.bytes += one.bytes;
        all.failed += one.failed;
    }
    return all;
}

void print_fetched(const std::string& what, const Fetched& fetched) {
    print_line(what, fetched.seconds);
    std::printf("%-28s %.2f s, %.0f MB/s, %zu failed\n", "", fetched.lasted,
                static_cast<double>(fetched.bytes) / 1e6 / fetched.lasted, fetched.failed);
}

int port_in(const std::string& out) {
    const std::string before = "http://127.0.0.1:";
    const std::size_t at = out.find(before);
    return at == std::string::npos ? 0 : std::atoi(out.c_str() + at + before.size());
}

// Opens connections that send a letter of a request each second, from 250 addresses, until they are closed.
class SlowClients {
  public:
    SlowClients(std::size_t count, int port) {
        for (std::size_t i = 0; i < count; ++i) {
            clients_.push_back(std::make_unique<RawClient>(port, format("127.0.1.{}", i % 250 + 1)));
            clients_.back()->send("GET / HTTP/1.1\r\nX: ");
        }
        thread_ = std::thread([this] {
            while (!ends_) {
                for (auto& client : clients_) client->send("x");
                std::this_thread::sleep_for(std::chrono::seconds(1));
            }
        });
    }
    ~SlowClients() {
        ends_ = true;
        thread_.join();
    }
    SlowClients(const SlowClients&) = delete;
    SlowClients& operator=(const SlowClients&) = delete;

  private:
    std::vector<std::unique_ptr<RawClient>> clients_;
    std::atomic<bool> ends_ = false;
    std::thread thread_;
};

// Everybody walks the whole study; the server is killed so often meanwhile, and started again.
std::vector<Visit> walk(const server::ServedStudy& study, const Load& load, std::size_t& kills) {
    const std::vector<std::string> words = {
        "study",       "serve",   study.folder.string(), "--port", "0", "--rate", "1000000",
        "--newcomers", "1000000", "--connections",       "1000"};
    std::atomic<int> port = 0;
    std::atomic<std::size_t> acknowledged = 0;
    std::atomic<bool> all_done = false;
    std::vector<Visit> visits;
    std::thread crowd([&] {
        while (port == 0) std::this_thread::sleep_for(std::chrono::milliseconds(5));
        visits = testing::send_crowd(study, {.people = load.people,
                                             .port = [&] { return port.load(); },
                                             .acknowledged = &acknowledged,
                                             .watches = true});
        all_done = true;
    });
    for (std::size_t i = 1; !all_done; ++i) {
        RunningChironomia server(words);
        port = port_in(server.wait_for_out("token"));
        std::unique_ptr<SlowClients> slow;
        if (load.slow > 0) slow = std::make_unique<SlowClients>(load.slow, port);
        const std::size_t share = load.people * load.pages * i / (load.kills + 1);
        while (!all_done && (kills == load.kills || acknowledged < share))
            std::this_thread::sleep_for(std::chrono::milliseconds(1));
        kills += !all_done;
        server.end(SIGKILL);
    }
    crowd.join();
    return visits;
}

int run(const Load& load) {
    const testing::TemporaryFolder folder, work;
    testing::write_sample_study(folder.path(), {.trials = load.pages, .checks = 0, .sheets = 8});
    const server::ServedStudy study = server::read_served_study(folder.path());
    for (const StudyPage& page : study.pages.pages) {
        for (const std::string& video : page.videos)
            write_text(folder / "public" / video, std::string(load.kilobytes * 1000, 'v') + video);
    }
    fs::permissions(folder.path(), fs::perms(0755));
    std::printf("%zu people, %zu pages each, two videos of %zu kB a page\n", load.people, load.pages,
                load.kilobytes);

    Fetched plain, ours;
    {
        const FileServer server(folder / "public", work.path());
        plain = fetch_videos(study, load, server.port());
        print_fetched("videos, " + server.name(), plain);
    }
    {
        RunningChironomia server({"study", "serve", folder.path().string(), "--port", "0", "--rate",
                                  "1000000", "--connections", "1000"});
        ours = fetch_videos(study, load, port_in(server.wait_for_out("token")));
        print_fetched("videos, study serve", ours);
    }
    std::printf("%-28s time %.2f, p50 %.2f, p99 %.2f times the file server\n", "ratio",
                ours.lasted / plain.lasted, share_of(ours.seconds, 0.5) / share_of(plain.seconds, 0.5),
                share_of(ours.seconds, 0.99) / share_of(plain.seconds, 0.99));

    std::size_t kills = 0;
    const auto begun = Clock::now();
    const std::vector<Visit> visits = walk(study, load, kills);
    const double lasted = seconds_since(begun);
    std::map<std::string, std::vector<double>> seconds;
    std::size_t finished = 0;
    for (const Visit& visit : visits) {
        finished += visit.finished;
        for (const auto& [kind, each] : visit.seconds)
            seconds[kind].insert(seconds[kind].end(), each.begin(), each.end());
    }
    std::printf("the whole study: %zu of %zu finished in %.2f s, %zu kills, %zu slow connections\n", finished,
                visits.size(), lasted, kills, load.slow);
    for (const char* kind : {"begin", "video", "answer", "finish"}) print_line(kind, seconds[kind]);
    const std::string fault =
        testing::fault_of_answers(study, server::default_database(folder.path()), visits);
    std::printf("lost, doubled or misassigned answers: %s\n", fault.empty() ? "none" : fault.c_str());
    return fault.empty() && finished == visits.size() ? 0 : 1;
}

}  // namespace
}  // namespace chironomia

int main(int argc, char** argv) {
    chironomia::Load load;
    CLI::App app("A study under load, beside a plain file server");
    app.add_option("--people", load.people)->check(CLI::Range(1, 500));
    app.add_option("--pages", load.pages)->check(CLI::Range(1, 100));
    app.add_option("--kilobytes", load.kilobytes)->check(CLI::Range(1, 10'000));
    app.add_option("--kills", load.kills)->check(CLI::Range(0, 500));
    app.add_option("--slow", load.slow)->check(CLI::Range(0, 5000));
    CLI11_PARSE(app, argc, argv);
    return chironomia::run(load);
}
