// The addresses of the server and who answers them: the page's files, its requests, and the operator's page.
#pragma once

#include <cstdint>
#include <filesystem>
#include <functional>
#include <mutex>
#include <optional>
#include <string>
#include <unordered_map>
#include <vector>

#include "study/server/clock.h"
#include "study/server/commit_queue.h"
#include "study/server/http_server.h"
#include "study/server/operator_page.h"
#include "study/server/participant_sessions.h"
#include "study/server/public_files.h"
#include "study/server/rate_limit.h"
#include "study/server/served_study.h"

namespace chironomia::study::server {

struct SiteOptions {
    std::filesystem::path database;
    std::string token;          // of the operator
    std::int64_t timeout = 0;   // ms after which a silent participant has dropped out
    double requests = 50;       // a second and client; ten times as many at once
    double newcomers = 20;      // an hour and client; as many at once
    bool behind_proxy = false;  // clients are distinguished by X-Forwarded-For
    Clocks clocks{};
    std::function<void(const std::string&)> complain = [](const std::string&) {};  // to the operator
    std::function<HttpServer::SentAway()> sent_away;
};

// Any thread may ask.
class Site {
  public:
    Site(const ServedStudy& study, CommitQueue& queue, SiteOptions options);

    // What is wrong with a request whose body has not been read; status 200 if nothing is.
    HttpResponse gate(const HttpRequest& request);

    HttpResponse answer(const HttpRequest& request);

    // A request could not be answered, such as on a full disk: the operator's page says so from now on, and
    // at most once a minute it is complained about.
    void note_failure(const std::string& why);

  private:
    std::int64_t now();
    std::string fault_of_study() const;
    Json progress();
    HttpResponse route(const HttpRequest& request);
    HttpResponse answer_page(const HttpRequest& request);
    Reply begin(const HttpRequest& request, const Json& body);
    Reply withdraw(const Json& body);
    HttpResponse send_file(const HttpRequest& request);
    HttpResponse send_text(const HttpRequest& request, const std::string& text,
                           const std::string& type) const;
    std::optional<PublicFile> open_file(const std::string& path);
    HttpResponse answer_operator(const HttpRequest& request);
    HttpResponse log_in(const HttpRequest& request) const;
    bool is_operator(const HttpRequest& request) const;
    std::string cookie() const;
    void note_proxy(const HttpRequest& request);
    void note_unfilled_link(const Json& body);

    const ServedStudy& study_;
    CommitQueue& queue_;
    SiteOptions options_;
    std::int64_t since_;  // ms since 1970
    ParticipantSessions sessions_;
    PublicFiles files_;
    std::string index_page_;  // with what all may see of pages.json
    std::string open_pages_;
    std::string version_;  // of pages.json as it is served
    ClockWatch clock_;
    std::unordered_map<std::string, std::string> files_of_showings_;  // paths of URLs
    RateLimit limit_;
    RateLimit login_limit_;
    RateLimit newcomer_limit_;
    std::once_flag proxy_noted_;
    std::once_flag unfilled_link_noted_;
    std::mutex copies_mutex_;  // one withdrawal at a time changes the copies of answers
    std::mutex mutex_;         // guards failures_, incidents_ and complained_
    Failures failures_;
    std::vector<Incident> incidents_;
    std::optional<std::int64_t> complained_;  // when, steady ms
};

}  // namespace chironomia::study::server
