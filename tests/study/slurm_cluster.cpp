#include "tests/study/slurm_cluster.h"

#include <fcntl.h>
#include <gtest/gtest.h>
#include <netdb.h>
#include <signal.h>
#include <sys/wait.h>
#include <unistd.h>

#include <array>
#include <chrono>
#include <cstdlib>
#include <fstream>
#include <iterator>
#include <set>
#include <stdexcept>
#include <thread>

#include "core/files/files.h"
#include "core/text.h"

namespace chironomia::testing {
namespace {

namespace fs = std::filesystem;

// Also of /proc, whose files say that they are empty; "" if there is none, as of a process that has ended.
std::string text_of(const fs::path& file) {
    std::ifstream stream(file, std::ios::binary);
    return {std::istreambuf_iterator<char>(stream), {}};
}

pid_t parent_of(pid_t process) {
    const std::string status = text_of(format("/proc/{}/status", process));
    const std::size_t at = status.find("PPid:");
    return at == std::string::npos ? 0 : static_cast<pid_t>(std::stoi(status.substr(at + 5)));
}

bool is_watcher(pid_t process) {
    return text_of(format("/proc/{}/comm", process)).starts_with("slurmstepd");
}

}  // namespace

std::string why_no_slurm() {
    for (const char* program : {"/usr/sbin/slurmctld", "/usr/sbin/slurmd", "/usr/bin/sbatch"}) {
        if (!fs::exists(program)) return "there is no Slurm here; install Debian's slurm-wlm";
    }
    // As Slurm does, even for 127.0.0.1.
    const addrinfo as_slurm = {.ai_flags = AI_ADDRCONFIG, .ai_family = AF_INET};
    addrinfo* found = nullptr;
    if (::getaddrinfo("127.0.0.1", nullptr, &as_slurm, &found) != 0)
        return "Slurm finds no node on a machine that has no address but loopback";
    ::freeaddrinfo(found);
    return "";
}

SlurmCluster::SlurmCluster() {
    std::array<int, 2> ends{};
    if (::pipe2(ends.data(), O_CLOEXEC) != 0) throw std::runtime_error("no pipe");
    const std::string script = (source_dir() / "tests/study/slurm_nodes").string();
    const std::string home = (folder_ / "slurm").string();
    nodes_ = ::fork();
    if (nodes_ == 0) {
        ::dup2(ends[0], STDIN_FILENO);
        ::execl(script.c_str(), script.c_str(), home.c_str(), nullptr);
        ::_exit(127);
    }
    ::close(ends[0]);
    their_stdin_ = ends[1];
    ::setenv("SLURM_CONF", (home + "/slurm.conf").c_str(), 1);
    for (int i = 0; i < 1200 && !fs::exists(folder_ / "slurm/ready"); ++i)
        std::this_thread::sleep_for(std::chrono::milliseconds(100));
    const std::string nodes = text_of(folder_ / "slurm/ready");
    if (nodes.find("idle") != std::string::npos) return;
    stop();
    throw std::runtime_error("the nodes did not come up: " + nodes +
                             text_of(folder_ / "slurm/slurmctld.log") +
                             text_of(folder_ / "slurm/slurmd.n1.log"));
}

SlurmCluster::~SlurmCluster() {
    stop();
}

void SlurmCluster::stop() const {
    ::close(their_stdin_);
    ::waitpid(nodes_, nullptr, 0);
    ::unsetenv("SLURM_CONF");
}

std::vector<pid_t> SlurmCluster::jobs_on(const std::string& node) const {
    const std::string conf = "SLURM_CONF=" + (folder_ / "slurm/slurm.conf").string() + '\0';
    const std::string name = "SLURMD_NODENAME=" + node + '\0';
    std::vector<pid_t> jobs;
    for (const auto& entry : fs::directory_iterator("/proc")) {
        const auto process = parse_integer(entry.path().filename().string());
        if (!process) continue;
        const std::string variables = text_of(entry.path() / "environ");
        if (variables.find(conf) != std::string::npos && variables.find(name) != std::string::npos)
            jobs.push_back(static_cast<pid_t>(*process));
    }
    return jobs;
}

void SlurmCluster::kill_node(const std::string& node) const {
    ::kill(static_cast<pid_t>(std::stoi(read_text(folder_ / "slurm" / (node + ".pid")))), SIGKILL);
    const std::vector<pid_t> jobs = jobs_on(node);
    std::set<pid_t> watchers;
    for (const pid_t job : jobs) {
        if (is_watcher(parent_of(job))) watchers.insert(parent_of(job));
    }
    for (const pid_t watcher : watchers) ::kill(watcher, SIGKILL);
    for (const pid_t job : jobs) ::kill(job, SIGKILL);
}

}  // namespace chironomia::testing
