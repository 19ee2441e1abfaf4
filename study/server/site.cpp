#include "study/server/site.h"

#include <sys/stat.h>

#include "core/error.h"
#include "core/files/files.h"
#include "core/hash.h"
#include "core/text.h"
#include "study/build/pages.h"
#include "study/build/participant_pages.h"
#include "study/record/link_parameters.h"
#include "study/server/answer_validation.h"
#include "study/server/answers_file.h"
#include "study/server/clock.h"
#include "study/server/forget.h"
#include "study/server/operator_page.h"
#include "study/server/secrets.h"

namespace chironomia::study::server {
namespace {

constexpr double kLoginsASecond = 0.2;
constexpr double kLoginsAtOnce = 10;
constexpr std::int64_t kBetweenComplaints = 60'000;  // ms

constexpr const char* kOperatorStyle = R"(
body { font: 16px/1.5 system-ui, sans-serif; margin: 2rem; color: #1b1f24; background: #fff; }
main { max-width: 70rem; margin: 0 auto; }
table { border-collapse: collapse; display: block; overflow-x: auto; }
th, td { text-align: left; padding: 0.25rem 1rem 0.25rem 0; border-bottom: 1px solid #d0d7de; }
th { font-weight: 600; }
td { font-variant-numeric: tabular-nums; }
input, button { font: inherit; padding: 0.25rem 0.5rem; }
a { color: #0550ae; }
[role=alert] { color: #a40e26; }
@media (max-width: 40rem) { body { margin: 1rem; } th, td { padding-right: 0.75rem; } }
)";

// Nothing from elsewhere, nothing inline, in no frame of others; no address of the study in the logs of
// others.
const std::map<std::string, std::string> kHeaders = {
    {"Content-Security-Policy",
     "default-src 'none'; script-src 'self'; style-src 'self'; img-src 'self' data: blob:; media-src "
     "'self' blob:; font-src 'self'; connect-src 'self'; form-action 'self'; base-uri 'none'; "
     "frame-ancestors 'none'"},
    {"Cross-Origin-Opener-Policy", "same-origin"},
    {"Cross-Origin-Resource-Policy", "same-origin"},
    {"Permissions-Policy", "camera=(), microphone=(), geolocation=()"},
    {"Referrer-Policy", "no-referrer"},
    {"X-Content-Type-Options", "nosniff"},
    {"X-Frame-Options", "DENY"},
    {"X-Robots-Tag", "noindex"},
};

HttpResponse json_response(int status, const Json& body) {
    return {.status = status,
            .headers = {{"Cache-Control", "no-store"}},
            .type = "application/json",
            .body = body.dump() + "\n"};
}

HttpResponse refusal(int status, const std::string& why) {
    return json_response(status, {{"error", why}});
}

// The videos of all sheets by the names of their showings.
std::unordered_map<std::string, std::string> name_showings(const ServedStudy& study) {
    std::unordered_map<std::string, std::string> files;
    for (std::size_t sheet = 0; sheet < study.sheets.size(); ++sheet) {
        for (const Step& step : study.sheets[sheet]) {
            for (std::size_t place = 0; place < step.order.size() && step.pass == 0; ++place) {
                const std::string& video = study.pages.pages[step.page].videos[step.order[place]];
                const VideoShowing showing = {.sheet = sheet, .at = step.at, .place = place};
                files["/" + video_of_showing(video, showing, study.key.secret)] = "/" + video;
            }
        }
    }
    return files;
}

HttpResponse html_response(int status, std::string html) {
    return {.status = status,
            .headers = {{"Cache-Control", "no-store"}},
            .type = "text/html; charset=utf-8",
            .body = std::move(html)};
}

std::string header_of(const HttpRequest& request, const std::string& name) {
    const auto found = request.headers.find(name);
    return found == request.headers.end() ? "" : found->second;
}

bool is_below(const std::string& path, const std::string& folder) {
    return path == folder || path.starts_with(folder + "/");
}

constexpr const char* kLogin = "/operator/login";
constexpr std::size_t kMostIncidents = 20;

// Changes when another file takes the place of this one, or it is written.
std::string version_of(const std::filesystem::path& file) {
    struct stat status {};
    if (stat(file.c_str(), &status) != 0) return "";
    return format("{} {} {} {}", status.st_ino, status.st_size, status.st_ctim.tv_sec,
                  status.st_ctim.tv_nsec);
}

}  // namespace

Site::Site(const ServedStudy& study, CommitQueue& queue, SiteOptions options)
    : study_(study),
      queue_(queue),
      options_(std::move(options)),
      since_(options_.clocks.unix_time()),
      sessions_(study, options_.timeout),
      files_(study.folder / "public"),
      index_page_(with_data(read_text(study.folder / "public" / "index.html"), open_pages(study.data))),
      open_pages_(open_pages(study.data).dump(2) + "\n"),
      version_(version_of(study.folder / "public" / "pages.json")),
      files_of_showings_(name_showings(study)),
      limit_(options_.requests, 10 * options_.requests),
      login_limit_(kLoginsASecond, kLoginsAtOnce),
      newcomer_limit_(options_.newcomers / 3600, options_.newcomers) {}

// Participants at work when somebody sets the clock still are.
std::int64_t Site::now() {
    const std::int64_t time = options_.clocks.unix_time();
    const std::int64_t jump = clock_.jump(time, options_.clocks.steady_time());
    if (jump == 0) return time;
    queue_.run([&](AnswerStore& store) { store.shift_last_active(jump); });
    const std::string what = format(
        "the clock of this machine was set {} by {} s; times of answers before and after do not compare",
        jump > 0 ? "forward" : "back", std::abs(jump) / 1000);
    options_.complain(format("{}: {}", utc_text(time), what));
    const std::lock_guard lock(mutex_);
    if (incidents_.size() < kMostIncidents) incidents_.push_back({.what = what, .time = time});
    return time;
}

// The pages in memory are those of the files as they were when the server began.
std::string Site::fault_of_study() const {
    const std::filesystem::path file = study_.folder / "public" / "pages.json";
    if (version_of(file) == version_) return "";
    try {
        if (read_json(file) == study_.data) return "";
    } catch (const Error&) {
        // missing, or half written
    }
    return format("{}: changed while it is served; nobody can begin until the server is started again",
                  file.string());
}

void Site::note_proxy(const HttpRequest& request) {
    if (options_.behind_proxy || !request.headers.contains("x-forwarded-for")) return;
    std::call_once(proxy_noted_, [&] {
        options_.complain(
            "note: requests come through a proxy (X-Forwarded-For); without --behind-proxy all participants "
            "share the limits of one client");
    });
}

void Site::note_unfilled_link(const Json& body) {
    if (!has_unfilled(body.value("arrived_with", Json::object()))) return;
    std::call_once(unfilled_link_noted_, [&] {
        options_.complain(
            "note: somebody came by a link that the panel had not filled in, such as {{%PROLIFIC_PID%}}; their name is "
            "drawn; correct the link");
    });
}

void Site::note_failure(const std::string& why) {
    const std::int64_t now = steady_milliseconds();
    const std::lock_guard lock(mutex_);
    failures_ = {.count = failures_.count + 1, .last = why, .time = options_.clocks.unix_time()};
    if (complained_ && now < *complained_ + kBetweenComplaints) return;
    complained_ = now;
    options_.complain(format("{}: a request was not answered ({} since the start): {}",
                             utc_text(failures_.time), failures_.count, why));
}

HttpResponse Site::gate(const HttpRequest& request) {
    note_proxy(request);
    const std::int64_t now = steady_milliseconds();
    const bool logs_in = request.path == kLogin;
    if (!limit_.allows(request.client, now) || (logs_in && !login_limit_.allows(request.client, now))) {
        HttpResponse slow_down = refusal(429, "too many requests; wait a moment");
        slow_down.headers.emplace("Retry-After", "1");
        return slow_down;
    }
    if (request.method != "POST") return {};
    if (logs_in) return {};
    if (!is_below(request.path, "/api")) return refusal(405, "only GET and HEAD are answered here");
    // From a page of another site this type needs a CORS preflight, which is refused.
    if (!to_lower(header_of(request, "content-type")).starts_with("application/json")) {
        return refusal(415, "the body must be application/json");
    }
    return {};
}

HttpResponse Site::answer(const HttpRequest& request) {
    HttpResponse response = route(request);
    for (const auto& [name, value] : kHeaders) response.headers.emplace(name, value);
    return response;
}

HttpResponse Site::route(const HttpRequest& request) {
    if (is_below(request.path, "/api")) return answer_page(request);
    if (is_below(request.path, "/operator")) return answer_operator(request);
    return send_file(request);
}

Reply Site::begin(const HttpRequest& request, const Json& body) {
    if (const std::string fault = fault_of_study(); !fault.empty()) throw Error(fault);
    Reply reply;
    std::optional<bool> admitted;  // a change may be run twice
    const auto admits = [&] {
        if (!admitted) admitted = newcomer_limit_.allows(request.client, steady_milliseconds());
        return *admitted;
    };
    const Arrival arrival = {.now = now(), .session = draw_secret(), .admits = admits};
    queue_.run([&](AnswerStore& store) { reply = sessions_.begin(store, body, arrival); });
    if (reply.status == 200) note_unfilled_link(body);
    return reply;
}

// The answers go at once; what is left in the log and in copies is deleted after that, and the operator learns of it if
// that fails.
Reply Site::withdraw(const Json& body) {
    ParticipantSessions::Withdrawal withdrawal;
    queue_.run([&](AnswerStore& store) { withdrawal = sessions_.withdraw(store, body); });
    if (withdrawal.name.empty()) return withdrawal.reply;
    const std::lock_guard lock(copies_mutex_);
    try {
        forget_in_copies(study_.folder, options_.database, withdrawal.name);
        if (!Database(options_.database, Database::Use::write).empty_log())
            note_failure("somebody withdrew while the database was read; its log is emptied later");
    } catch (const std::exception& problem) {
        note_failure(
            format("somebody withdrew, but copies of the answers could not be changed: {}", problem.what()));
    }
    return withdrawal.reply;
}

HttpResponse Site::answer_page(const HttpRequest& request) {
    if (request.method != "POST") return refusal(405, "only POST is answered here");
    const std::optional<Json> body = parse_body(request.body);
    if (!body) return refusal(400, "the body is no JSON, or nested too deeply");
    const std::int64_t time = now();
    Reply reply{
        .status = 404,
        .body = {{"error", "there is no such request; begin, answer, finish, decline, stored, withdraw"}}};
    if (request.path == "/api/begin") {
        reply = begin(request, *body);
    } else if (request.path == "/api/answer") {
        queue_.run([&](AnswerStore& store) { reply = sessions_.answer(store, *body, time); });
    } else if (request.path == "/api/finish") {
        queue_.run([&](AnswerStore& store) { reply = sessions_.finish(store, *body, time); });
    } else if (request.path == "/api/decline") {
        queue_.run([&](AnswerStore& store) { reply = sessions_.decline(store, *body); });
    } else if (request.path == "/api/stored") {
        AnswerStore store(options_.database, Database::Use::read, study_.pages.study);
        reply = sessions_.stored(store, *body);
    } else if (request.path == "/api/withdraw") {
        reply = withdraw(*body);
    }
    HttpResponse response = json_response(reply.status, reply.body);
    if (reply.status == 429) response.headers.emplace("Retry-After", "60");
    return response;
}

HttpResponse Site::send_text(const HttpRequest& request, const std::string& text,
                             const std::string& type) const {
    const std::string tag = format("\"{}\"", sha256(text).substr(0, 32));
    HttpResponse response{.status = 200,
                          .headers = {{"Cache-Control", "private, no-cache"}, {"ETag", tag}},
                          .type = type,
                          .body = text};
    if (header_of(request, "if-none-match") == tag) {
        response.status = 304;
        response.type.clear();
        response.body.clear();
    }
    return response;
}

// Two showings of one video have two tags.
std::optional<PublicFile> Site::open_file(const std::string& path) {
    const auto shows = files_of_showings_.find(path);
    if (shows == files_of_showings_.end()) return files_.open(path);
    std::optional<PublicFile> found = files_.open(shows->second);
    if (found) found->tag = format("\"{}\"", sha256(path + found->tag).substr(0, 32));
    return found;
}

HttpResponse Site::send_file(const HttpRequest& request) {
    if (request.path == "/" || request.path == "/index.html")
        return send_text(request, index_page_, "text/html; charset=utf-8");
    if (request.path == "/pages.json") return send_text(request, open_pages_, "application/json");
    std::optional<PublicFile> found = open_file(request.path);
    if (!found) return refusal(404, "there is no such file");
    // The browser asks each time whether its copy is the right one: a study that was built again shows no old
    // clip.
    HttpResponse response{
        .status = 200,
        .headers = {{"Cache-Control", "private, no-cache"}, {"ETag", found->tag}, {"Accept-Ranges", "bytes"}},
        .type = found->type};
    if (header_of(request, "if-none-match") == found->tag) {
        response.status = 304;
        response.type.clear();
        return response;
    }
    const std::string if_range = header_of(request, "if-range");
    const bool same = if_range.empty() || if_range == found->tag;
    const ByteRange range = same ? parse_range(header_of(request, "range"), found->size) : ByteRange{};
    if (range.kind == ByteRange::Kind::unsatisfiable) {
        HttpResponse beyond = refusal(416, "the file is not so long");
        beyond.headers["Content-Range"] = format("bytes */{}", found->size);
        return beyond;
    }
    const bool part = range.kind == ByteRange::Kind::part;
    if (part) {
        response.status = 206;
        response.headers["Content-Range"] =
            format("bytes {}-{}/{}", range.first, range.first + range.length - 1, found->size);
    }
    response.file = std::move(found->file);
    response.first = part ? range.first : 0;
    response.length = part ? range.length : found->size;
    return response;
}

// The cookie is made from the token, but does not reveal it.
std::string Site::cookie() const {
    return keyed_sha256(options_.token, "operator of " + study_.pages.study);
}

bool Site::is_operator(const HttpRequest& request) const {
    constexpr std::string_view kBearer = "Bearer ";
    const std::string authorization = header_of(request, "authorization");
    if (authorization.starts_with(kBearer)) {
        return equal_in_constant_time(authorization.substr(kBearer.size()), options_.token);
    }
    const std::string cookies = header_of(request, "cookie");
    for (const std::string_view part : split(cookies, ';')) {
        constexpr std::string_view kName = "operator=";
        const std::string_view cookie_text = trim(part);
        if (cookie_text.starts_with(kName)) {
            return equal_in_constant_time(cookie_text.substr(kName.size()), cookie());
        }
    }
    return false;
}

// The token comes in the body: an address would stay in logs and histories.
HttpResponse Site::log_in(const HttpRequest& request) const {
    constexpr std::string_view kField = "token=";
    const std::string_view body = trim(request.body);
    const bool right =
        body.starts_with(kField) && equal_in_constant_time(body.substr(kField.size()), options_.token);
    if (!right) return html_response(403, login_page(true));
    const bool secure = header_of(request, "x-forwarded-proto") == "https";
    return {.status = 303,
            .headers = {{"Location", "/operator"},
                        {"Cache-Control", "no-store"},
                        {"Set-Cookie", format("operator={}; Path=/operator; HttpOnly; SameSite=Strict{}",
                                              cookie(), secure ? "; Secure" : "")}}};
}

Json Site::progress() {
    const std::int64_t time = now();
    AnswerStore store(options_.database, Database::Use::read, study_.pages.study);
    Json progress = study_progress(study_, store, time, options_.timeout);
    const HttpServer::SentAway sent_away = options_.sent_away();
    progress["serving_since"] = utc_text(since_);
    progress["sent_away"] = {{"connections", sent_away.connections}, {"requests", sent_away.requests}};
    const std::lock_guard lock(mutex_);
    progress["failures"] = to_json(failures_);
    std::vector<Incident> incidents = incidents_;
    if (const std::string fault = fault_of_study(); !fault.empty())
        incidents.push_back({.what = fault, .time = time});
    progress["incidents"] = to_json(incidents);
    return progress;
}

HttpResponse Site::answer_operator(const HttpRequest& request) {
    if (request.path == "/operator/style.css") {
        return {.status = 200, .headers = {}, .type = "text/css; charset=utf-8", .body = kOperatorStyle};
    }
    if (request.path == kLogin && request.method == "POST") return log_in(request);
    if (!is_operator(request)) {
        return request.path == "/operator" ? html_response(401, login_page(false))
                                           : refusal(401, "the operator's token is needed");
    }
    if (request.path == "/operator/answers.json") {
        AnswersFile answers = open_answers(options_.database, study_.pages.study);
        return {.status = 200,
                .headers = {{"Cache-Control", "no-store"},
                            {"Content-Disposition", "attachment; filename=\"answers.json\""}},
                .type = "application/json",
                .file = std::move(answers.file),
                .length = answers.size};
    }
    if (request.path == "/operator/progress.json") return json_response(200, progress());
    if (request.path == "/operator") return html_response(200, operator_page(study_, progress()));
    return refusal(404, "there is no such page");
}

}  // namespace chironomia::study::server
