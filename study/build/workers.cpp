#include "study/build/workers.h"

#include <array>
#include <cerrno>
#include <chrono>
#include <csignal>
#include <cstring>
#include <thread>
#include <utility>
#include <vector>

#include <sys/prctl.h>
#include <sys/wait.h>
#include <unistd.h>

#include "core/error.h"
#include "core/text.h"

namespace chironomia::study {
namespace {

constexpr int kRefused = 3;        // exit status of a child whose piece threw an Error
constexpr int kInterrupted = 130;  // exit status of a child that was stopped by the user

// A child process and the pipe through which it says why it failed.
class Child {
  public:
    Child(const Work& work, std::size_t piece);
    ~Child();
    Child(Child&& other) noexcept
        : piece_(other.piece_), id_(std::exchange(other.id_, -1)), words_(std::exchange(other.words_, -1)) {}
    Child& operator=(Child&& other) noexcept {
        std::swap(piece_, other.piece_);
        std::swap(id_, other.id_);
        std::swap(words_, other.words_);
        return *this;
    }

    // Whether it has ended. Throws what its piece threw.
    bool has_ended(const Work& work);

  private:
    [[noreturn]] static void perform(const Work& work, std::size_t piece, int words);
    std::string last_words() const;

    std::size_t piece_;
    pid_t id_ = -1;
    int words_ = -1;
};

Child::Child(const Work& work, std::size_t piece) : piece_(piece) {
    std::array<int, 2> ends{};
    const pid_t parent = ::getpid();
    if (::pipe(ends.data()) != 0 || (id_ = ::fork()) < 0) {
        throw Error(format("{}: no process can be started ({}); use fewer jobs", work.name(piece),
                           std::strerror(errno)));
    }
    if (id_ == 0) {
        // A child that outlived its parent would hold the study and write into it.
        ::prctl(PR_SET_PDEATHSIG, SIGKILL);
        if (::getppid() != parent) ::_exit(kInterrupted);
        ::close(ends[0]);
        perform(work, piece, ends[1]);
    }
    ::close(ends[1]);
    words_ = ends[0];
}

Child::~Child() {
    if (id_ > 0) {
        ::kill(id_, SIGTERM);
        while (::waitpid(id_, nullptr, 0) < 0 && errno == EINTR) {
        }
    }
    if (words_ >= 0) ::close(words_);
}

void Child::perform(const Work& work, std::size_t piece, int words) {
    int status = 0;
    try {
        work.perform(piece);
    } catch (const Interrupted&) {
        status = kInterrupted;
    } catch (const std::exception& error) {
        const std::string_view message = error.what();
        status = ::write(words, message.data(), message.size()) > 0 ? kRefused : kInterrupted;
    }
    // Not exit(): what the parent registered for its own end is not the child's to do.
    ::_exit(status);
}

std::string Child::last_words() const {
    std::string words;
    std::array<char, 4096> block{};
    for (ssize_t got; (got = ::read(words_, block.data(), block.size())) > 0;) {
        words.append(block.data(), static_cast<std::size_t>(got));
    }
    return words;
}

bool Child::has_ended(const Work& work) {
    int status = 0;
    if (::waitpid(id_, &status, WNOHANG) == 0) return false;
    id_ = -1;
    if (WIFEXITED(status) && WEXITSTATUS(status) == 0) return true;
    if (WIFEXITED(status) && WEXITSTATUS(status) == kInterrupted) throw Interrupted();
    if (WIFEXITED(status) && WEXITSTATUS(status) == kRefused) throw Error(last_words());
    std::string how = format("with status {}", WEXITSTATUS(status));
    if (WIFSIGNALED(status)) how = format("by signal {}", WTERMSIG(status));
    if (WIFSIGNALED(status) && WTERMSIG(status) == SIGKILL)
        how += ", as where memory runs out; take fewer --jobs";
    throw Error(format("{}: its process ended {}; render it alone to see why", work.name(piece_), how));
}

void perform_in_children(const Work& work, std::size_t jobs, Progress& progress) {
    std::vector<Child> children;
    std::size_t next = 0;
    while (next < work.count || !children.empty()) {
        while (next < work.count && children.size() < jobs) children.emplace_back(work, next++);
        const std::size_t before = children.size();
        for (std::size_t i = children.size(); i-- > 0;) {
            if (children[i].has_ended(work))
                children.erase(children.begin() + static_cast<std::ptrdiff_t>(i));
        }
        progress.step(before - children.size());
        if (before == children.size()) std::this_thread::sleep_for(std::chrono::milliseconds(10));
    }
}

}  // namespace

void perform_all(const Work& work, int jobs, Progress& progress) {
    if (jobs > 1) return perform_in_children(work, static_cast<std::size_t>(jobs), progress);
    for (std::size_t piece = 0; piece < work.count; ++piece) {
        work.perform(piece);
        progress.step();
    }
}

}  // namespace chironomia::study
