#include "study/server/serve.h"

#include <fcntl.h>
#include <sys/file.h>
#include <unistd.h>

#include <algorithm>
#include <cmath>

#include "core/error.h"
#include "core/files/files.h"
#include "core/text.h"
#include "study/record/study_folder.h"
#include "study/server/answer_validation.h"
#include "study/server/answers_file.h"
#include "study/server/secrets.h"
#include "study/server/site.h"

namespace chironomia::study::server {
namespace {

namespace fs = std::filesystem;

constexpr std::size_t kShortestToken = 16;

fs::path lock_file_of(const fs::path& database) {
    return database.string() + ".lock";
}

void expect_lock(const OpenFile& lock, const fs::path& database) {
    if (flock(lock.descriptor(), LOCK_EX | LOCK_NB) == 0) return;
    throw Error(format("{}: another server uses this database; stop that one first", database.string()));
}

// Refuses a database that another server uses, or that holds something else, before anything is made or written.
const fs::path& checked(const fs::path& database, const std::string& study) {
    const OpenFile lock(open(lock_file_of(database).c_str(), O_RDONLY | O_CLOEXEC));
    if (lock.descriptor() >= 0) expect_lock(lock, database);
    return check_database(database, study);
}

// Held while a server uses a database; the system lets go of it when the program ends, however it ends.
OpenFile lock_of(const fs::path& database) {
    const fs::path file = lock_file_of(database);
    OpenFile lock(open(file.c_str(), O_RDWR | O_CREAT | O_CLOEXEC, 0600));
    if (lock.descriptor() < 0) {
        throw Error(format("{}: cannot be written; check the path of the database and its permissions",
                           file.string()));
    }
    expect_lock(lock, database);
    return lock;
}

// Held while the pages are shown, together with other servers, so that no build replaces them meanwhile.
OpenFile lock_of_pages(const fs::path& study) {
    const fs::path folder = StudyFolder{study}.open();
    OpenFile lock(open(folder.c_str(), O_RDONLY | O_DIRECTORY | O_CLOEXEC));
    if (lock.descriptor() < 0 || flock(lock.descriptor(), LOCK_SH | LOCK_NB) != 0) {
        throw Error(
            format("{}: cannot be shown now; check its permissions, and wait for a build that is at work "
                   "there",
                   folder.string()));
    }
    return lock;
}

bool is_token(const std::string& text) {
    return text.size() >= kShortestToken && std::all_of(text.begin(), text.end(), [](char c) {
               return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9') ||
                      c == '-' || c == '_';
           });
}

std::string token_for(const ServeOptions& options) {
    const bool in_file = !options.token_file.empty();
    if (!in_file && options.token.empty()) return draw_secret();
    const std::string written = in_file ? read_text(options.token_file) : options.token;
    const std::string token(trim(written));
    if (!is_token(token)) {
        throw Error(format("{}: has {} letters; at least {} of a-z, A-Z, 0-9, \"-\" and \"_\" are needed",
                           in_file ? options.token_file.string() : "the operator's token", token.size(),
                           kShortestToken));
    }
    return token;
}

// A code of the plan belongs to the plan's link.
void note_code_left_out(const ServeOptions& options, const std::string& option, const std::string& code) {
    if (code.empty()) return;
    options.complain(
        format("note: {} replaces the link of the plan, so its code \"{}\" is not shown", option, code));
}

ServedStudy study_for(const ServeOptions& options) {
    ServedStudy study = read_served_study(options.study);
    Completion& completion = study.completion;
    if (options.participants) study.wanted = options.participants;
    if (!options.completion_url.empty() && options.completion_url != completion.url) {
        note_code_left_out(options, "--completion-url", completion.code);
        completion.url = options.completion_url;
        completion.code.clear();
    }
    if (!options.failed_url.empty() && options.failed_url != completion.failed_url) {
        note_code_left_out(options, "--failed-url", completion.failed_code);
        completion.failed_url = options.failed_url;
        completion.failed_code.clear();
    }
    return study;
}

}  // namespace

struct StudyServer::Parts {
    explicit Parts(const ServeOptions& options)
        : study(study_for(options)),
          database(checked(options.database.empty() ? default_database(options.study) : options.database,
                           study.pages.study)),
          token(token_for(options)),
          pages_lock(lock_of_pages(options.study)),
          http(
              {.host = options.host,
               .port = options.port,
               .most_of_client = options.connections,
               .behind_proxy = options.behind_proxy},
              [this](const HttpRequest& request) { return site.gate(request); },
              [this](const HttpRequest& request) { return site.answer(request); },
              [this](const std::string& why) { site.note_failure(why); }),
          lock(lock_of(database)),
          store(database, Database::Use::write, study.pages.study),
          queue(store),
          site(study, queue,
               {.database = database,
                .token = token,
                .timeout = std::llround(options.timeout_minutes * 60'000),
                .requests = options.requests,
                .newcomers = options.newcomers,
                .behind_proxy = options.behind_proxy,
                .clocks = options.clocks,
                .complain = options.complain,
                .sent_away = [this] { return http.sent_away(); }}) {
        leave_mark(options.study);
        check_sheets();
        store.limit_last_active(options.clocks.unix_time());
        warn_if_full(options);
    }

    // A second wave needs a new number; without a word its participants would be sent away.
    void warn_if_full(const ServeOptions& options) {
        const std::int64_t timeout = std::llround(options.timeout_minutes * 60'000);
        const std::size_t taken =
            count_taken(store.loads(study.sheets.size(), options.clocks.unix_time() - timeout));
        if (!study.wanted || taken < *study.wanted) return;
        options.complain(
            format("note: {} of {} participants have finished or are at work, so newcomers are sent away; "
                   "--participants N lets N take part in all",
                   taken, *study.wanted));
    }

    // A build must not replace a study whose answers lie elsewhere. Where nothing can be written nothing can be built.
    void leave_mark(const fs::path& folder) const {
        const fs::path mark = StudyFolder{folder}.database_elsewhere();
        if (database == default_database(folder) || fs::exists(mark)) return;
        try {
            write_text(mark, fs::absolute(database).string() + "\n");
        } catch (const Error&) {
        }
    }

    // A study that was built again may have other sheets: answers must not be taken for those to other pages.
    void check_sheets() {
        for (const Participant& participant : store.participants()) {
            bool known = participant.sheet < study.sheets.size();
            for (const StoredAnswer& answer : store.answers_of(participant.id)) {
                known = known && fits_sheet(answer, study.sheets[participant.sheet]);
            }
            if (known) continue;
            throw Error(
                format("{}: participant \"{}\" has sheet {} of another build of this study; put the database "
                       "aside, or give another file with --database",
                       database.string(), participant.name, participant.sheet));
        }
    }

    bool fits_sheet(const StoredAnswer& answer, const std::vector<Step>& steps) const {
        return answer.number < steps.size() &&
               fault_of_entry(study.pages, steps[answer.number], Json::parse(answer.entry)).order.empty();
    }

    ServedStudy study;
    fs::path database;
    std::string token;
    OpenFile pages_lock;
    HttpServer http;  // before the database, which is not to be made where the port is taken
    OpenFile lock;
    AnswerStore store;
    CommitQueue queue;
    Site site;
};

StudyServer::StudyServer(const ServeOptions& options) : parts_(std::make_unique<Parts>(options)) {}

StudyServer::~StudyServer() = default;

int StudyServer::port() const {
    return parts_->http.port();
}

const std::string& StudyServer::token() const {
    return parts_->token;
}

const std::string& StudyServer::title() const {
    return parts_->study.pages.title;
}

void StudyServer::run() {
    parts_->http.run();
}

void StudyServer::stop() {
    parts_->http.stop();
}

}  // namespace chironomia::study::server
