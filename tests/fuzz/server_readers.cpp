// The server of a study: requests, through its socket on this machine, and copies of its answers.
#include <arpa/inet.h>
#include <netinet/in.h>
#include <sys/socket.h>
#include <unistd.h>

#include <array>
#include <thread>

#include "core/error.h"
#include "core/files/files.h"
#include "study/record/pages.h"
#include "study/server/answer_store.h"
#include "study/server/answers_file.h"
#include "study/server/forget.h"
#include "study/server/serve.h"
#include "tests/fuzz/fuzz_reader.h"
#include "tests/support/support.h"

namespace chironomia::testing {

using namespace study;
namespace {

namespace fs = std::filesystem;

// A study whose videos are empty, made of the seeds of its key and its pages.
fs::path make_study(const char* name) {
    const fs::path folder = fuzz_folder() / name;
    const fs::path seeds = source_dir() / "tests/fuzz/seeds";
    fs::create_directories(folder / "public");
    fs::create_directories(folder / "private");
    fs::copy_file(seeds / "pages/pages.json", folder / "public/pages.json");
    fs::copy_file(seeds / "key/key.json", folder / "private/key.json");
    write_text(folder / "public/index.html", read_text(source_dir() / "study/web/index.html"));
    for (const StudyPage& page : read_study_pages(folder / "public/pages.json").pages) {
        for (const std::string& video : page.videos) {
            fs::create_directories((folder / "public" / video).parent_path());
            write_text(folder / "public" / video, "");
        }
    }
    return folder;
}

class SeedServer {
  public:
    SeedServer()
        : server_({.study = make_study("served"),
                   .port = 0,
                   .token = "operators-token-of-the-seeds",
                   .requests = 1e9,
                   .newcomers = 1000}),
          thread_([this] { server_.run(); }) {}
    ~SeedServer() {
        server_.stop();
        thread_.join();
    }

    // All that the server says to these bytes, after which the client sends no more.
    std::string answer_to(std::string_view bytes) const {
        const int client = socket(AF_INET, SOCK_STREAM, 0);
        sockaddr_in address{};
        address.sin_family = AF_INET;
        address.sin_port = htons(static_cast<std::uint16_t>(server_.port()));
        address.sin_addr.s_addr = htonl(INADDR_LOOPBACK);
        std::string answer;
        if (connect(client, reinterpret_cast<const sockaddr*>(&address), sizeof address) == 0) {
            for (size_t sent = 0; sent < bytes.size();) {
                const ssize_t count = send(client, bytes.data() + sent, bytes.size() - sent, MSG_NOSIGNAL);
                if (count <= 0) break;
                sent += static_cast<size_t>(count);
            }
            shutdown(client, SHUT_WR);
            std::array<char, 65536> piece{};
            for (ssize_t count; (count = recv(client, piece.data(), piece.size(), 0)) > 0;)
                answer.append(piece.data(), static_cast<size_t>(count));
        }
        // Without a port left waiting for each of millions of connections.
        const linger at_once{1, 0};
        setsockopt(client, SOL_SOCKET, SO_LINGER, &at_once, sizeof at_once);
        close(client);
        return answer;
    }

  private:
    server::StudyServer server_;
    std::thread thread_;
};

void send_request(const FuzzInput& input) {
    static const SeedServer server;
    const std::string answer = server.answer_to(input.text());
    if (answer.starts_with("HTTP/1.1 5")) throw std::logic_error("the server failed: " + answer);
    if (!answer.starts_with("HTTP/1.1 2") && !answer.starts_with("HTTP/1.1 3"))
        throw Error("refused: " + answer);
}

// With a database in which nobody is.
const fs::path& study_without_answers() {
    static const fs::path study = [] {
        const fs::path folder = make_study("unanswered");
        server::AnswerStore(server::default_database(folder), server::Database::Use::write,
                            read_study_pages(folder / "public/pages.json").study);
        return folder;
    }();
    return study;
}

// Without what SQLite left beside the one before.
fs::path copy_of_answers(const FuzzInput& input) {
    fs::remove_all(fuzz_folder() / "copy");
    return input.file();
}

void forget_in_copy(const FuzzInput& input) {
    server::forget_participant(
        {.study = study_without_answers(), .database = {}, .name = "p-1", .also = {copy_of_answers(input)}});
}

void list_answers(const FuzzInput& input) {
    server::write_answers(study_without_answers(), copy_of_answers(input), fuzz_folder() / "answers.json");
}

const AddFuzzReader kHttp({"http", "x", send_request});
const AddFuzzReader kForgetJson({"forget_json", "copy/x.json", forget_in_copy});
const AddFuzzReader kForgetDatabase({"forget_database", "copy/x.sqlite", forget_in_copy});
const AddFuzzReader kDatabase({"database", "copy/x.sqlite", list_answers});

}  // namespace
}  // namespace chironomia::testing
