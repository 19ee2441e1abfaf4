// A running server of one study.
#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <functional>
#include <memory>
#include <optional>
#include <string>

#include "study/server/clock.h"
#include "study/server/http_server.h"

namespace chironomia::study::server {

struct ServeOptions {
    std::filesystem::path study;
    std::string host = "127.0.0.1";
    int port = 8080;                          // 0: the system chooses
    std::filesystem::path database;           // empty: private/answers.sqlite
    std::string token;                        // of the operator; empty: drawn, unless a file has it
    std::filesystem::path token_file;         // holds the token; empty: none does
    double timeout_minutes = 60;              // a silent participant has dropped out
    double requests = 50;                     // a second and client; ten times as many at once
    double newcomers = 20;                    // an hour and client, and at once
    std::size_t connections = 32;             // requests of a client under way at once
    bool behind_proxy = false;                // a client's address is the last of X-Forwarded-For
    std::optional<std::size_t> participants;  // that are wanted in all; none: as the plan says
    std::string completion_url;               // shown without a code; empty: as the plan says
    std::string failed_url;                   // the same, of those who failed attention checks
    Clocks clocks{};
    std::function<void(const std::string&)> complain = [](const std::string&) {};  // to the operator
};

class StudyServer {
  public:
    // Listens from now on; serves once run() is called. Throws Error if the folder holds no study, another
    // server has the database, the token is weak, or the port is taken.
    explicit StudyServer(const ServeOptions& options);
    ~StudyServer();
    StudyServer(const StudyServer&) = delete;
    StudyServer& operator=(const StudyServer&) = delete;

    int port() const;
    const std::string& token() const;
    const std::string& title() const;

    void run();   // until stop()
    void stop();  // from any thread

  private:
    struct Parts;
    std::unique_ptr<Parts> parts_;
};

}  // namespace chironomia::study::server
