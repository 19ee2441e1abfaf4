// What the program takes from the machine: a sound server, a folder for temporary files, ignored signals.
#include <arpa/inet.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <netinet/in.h>
#include <sys/socket.h>
#include <unistd.h>

#include <cstdlib>

#include "core/files/files.h"
#include "core/text.h"
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

// A variable of the environment while the test runs.
class Variable {
  public:
    Variable(const char* name, const std::string& value) : name_(name) {
        if (const char* before = std::getenv(name)) before_ = before;
        ::setenv(name, value.c_str(), 1);
    }
    ~Variable() {
        if (before_)
            ::setenv(name_, before_->c_str(), 1);
        else
            ::unsetenv(name_);
    }
    Variable(const Variable&) = delete;
    Variable& operator=(const Variable&) = delete;

  private:
    const char* name_;
    std::optional<std::string> before_;
};

// Takes connections on this machine and never answers.
class SilentServer {
  public:
    SilentServer() : socket_(::socket(AF_INET, SOCK_STREAM | SOCK_NONBLOCK | SOCK_CLOEXEC, 0)) {
        sockaddr_in address{};
        address.sin_family = AF_INET;
        address.sin_addr.s_addr = htonl(INADDR_LOOPBACK);
        socklen_t size = sizeof address;
        EXPECT_EQ(::bind(socket_, reinterpret_cast<sockaddr*>(&address), size), 0);
        EXPECT_EQ(::listen(socket_, 8), 0);
        ::getsockname(socket_, reinterpret_cast<sockaddr*>(&address), &size);
        port_ = ntohs(address.sin_port);
    }
    ~SilentServer() { ::close(socket_); }
    SilentServer(const SilentServer&) = delete;
    SilentServer& operator=(const SilentServer&) = delete;

    int port() const { return port_; }
    bool has_connection() const { return ::accept(socket_, nullptr, nullptr) >= 0; }

  private:
    int socket_;
    int port_ = 0;
};

TEST(Machine, SpeaksWithoutASoundServer) {
    const TemporaryFolder folder;
    const SilentServer server;
    const Variable pulse("PULSE_SERVER", format("tcp:127.0.0.1:{}", server.port()));
    const Variable home("HOME", (folder / "home").string());
    const Variable temporary("TMPDIR", (folder / "tmp").string());
    for (const char* name : {"home", "tmp"}) fs::create_directory(folder / name);
    const Outcome made = run_chironomia({"synth", "--text", "Hello.", "--out", (folder / "m.h5").string()});
    EXPECT_EQ(made.exit_code, 0) << made.err;
    EXPECT_FALSE(server.has_connection());
    EXPECT_TRUE(fs::is_empty(folder / "home"));
    EXPECT_TRUE(fs::is_empty(folder / "tmp"));
}

TEST(Machine, SaysThatTheFolderForTemporaryFilesIsMissing) {
    const TemporaryFolder folder;
    const fs::path err = folder / "err";
    const int status = std::system(
        format("TMPDIR=/proc/none '{}' bench 2>'{}'", testing::chironomia_binary().string(), err.string())
            .c_str());
    EXPECT_EQ(WEXITSTATUS(status), 3);
    EXPECT_THAT(read_text(err), HasSubstr("bench-"));
    EXPECT_THAT(read_text(err), HasSubstr("let TMPDIR name a folder that can be written in"));
}

// As under nohup: the work is done to its end.
TEST(Machine, GoesOnWhereTheEndOfATerminalIsIgnored) {
    const TemporaryFolder folder;
    ASSERT_NE(std::signal(SIGHUP, SIG_IGN), SIG_ERR);
    const Outcome outcome = testing::signal_chironomia_at(
        folder / ".clip.mp4.partial", SIGHUP,
        {"render", "--motion", (source_dir() / "assets/samples/expressive/two-ways.bvh").string(), "--size",
         "64x64", "--frames", "0:30", "--out", (folder / "clip.mp4").string()});
    std::signal(SIGHUP, SIG_DFL);
    EXPECT_EQ(outcome.exit_code, 0) << outcome.err;
    EXPECT_TRUE(fs::exists(folder / "clip.mp4"));
}

}  // namespace
}  // namespace chironomia::study
