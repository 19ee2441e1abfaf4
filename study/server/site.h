// The addresses of the server and who answers them: the page's files, its requests, and the operator's page.
#pragma once

#include <cstdint>
#include <filesystem>
#include <string>

#include "study/server/commit_queue.h"
#include "study/server/front_desk.h"
#include "study/server/http_server.h"
#include "study/server/public_files.h"
#include "study/server/rate_limit.h"
#include "study/server/served_study.h"

namespace chironomia {

struct SiteOptions {
    std::filesystem::path database;
    std::string token;          // of the operator
    std::int64_t timeout = 0;   // ms after which a silent participant has dropped out
    double requests = 50;       // a second and client; ten times as many at once
    bool behind_proxy = false;  // a client's address is the last of X-Forwarded-For
};

// Any thread may ask.
class Site {
  public:
    Site(const ServedStudy& study, CommitQueue& queue, SiteOptions options);

    // What is wrong with a request whose body has not been read; status 200 if nothing is.
    HttpResponse gate(const HttpRequest& request);

    HttpResponse answer(const HttpRequest& request);

  private:
    HttpResponse route(const HttpRequest& request);
    HttpResponse answer_page(const HttpRequest& request);
    HttpResponse send_file(const HttpRequest& request);
    HttpResponse answer_operator(const HttpRequest& request);
    HttpResponse log_in(const HttpRequest& request) const;
    bool is_operator(const HttpRequest& request) const;
    std::string cookie() const;
    std::string client_of(const HttpRequest& request) const;

    const ServedStudy& study_;
    CommitQueue& queue_;
    SiteOptions options_;
    FrontDesk desk_;
    PublicFiles files_;
    RateLimit limit_;
    RateLimit login_limit_;
};

}  // namespace chironomia
