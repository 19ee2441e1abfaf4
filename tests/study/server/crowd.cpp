#include "tests/study/server/crowd.h"

#include <chrono>
#include <map>
#include <memory>
#include <thread>

#include "core/text.h"
#include "study/server/answers_file.h"
#include "tests/study/raw_client.h"
#include "tests/study/served_sample.h"

namespace chironomia::testing {

using namespace study;
namespace {

constexpr int kMostTries = 2000;
const std::string kBegin = "/api/begin";

std::string mark_of(const std::string& name, std::size_t number) {
    return format("{} {}", name, number);
}

class Person {
  public:
    Person(const server::ServedStudy& study, const Crowd& crowd, std::string name)
        : study_(study), crowd_(crowd) {
        visit_.name = std::move(name);
    }

    Visit visit() {
        begin();
        while (visit_.trouble.empty() && visit_.acknowledged < steps().size()) answer(visit_.acknowledged);
        if (visit_.trouble.empty()) finish();
        return visit_;
    }

  private:
    const std::vector<Step>& steps() const { return study_.sheets.at(visit_.sheet); }

    void begin() {
        const Json answer = ask(kBegin, {{"participant", visit_.name}, {"browser", "crowd"}});
        if (!visit_.trouble.empty()) return;
        const std::size_t sheet = answer["sheet"];
        if (!session_.empty() && sheet != visit_.sheet) visit_.trouble = "another sheet than before";
        if (answer["answered"] < visit_.acknowledged) {
            visit_.trouble = format("{} answers were acknowledged, {} are there", visit_.acknowledged,
                                    answer["answered"].get<std::size_t>());
        }
        visit_.sheet = sheet;
        session_ = answer["session"];
        pages_ = answer["pages"];
    }

    // The videos of a step, as the page shows them.
    void watch(std::size_t number) {
        const Json videos = pages_[steps()[number].at]["videos"];  // begun again, there are others
        for (const Json& video : videos) {
            const std::string path = "/" + video.get<std::string>();
            const auto got = request(path, "video", [&] { return client_->get(path); });
            if (got) visit_.bytes += got->body.size();
        }
    }

    void answer(std::size_t number) {
        if (crowd_.watches) watch(number);
        const Json entry = sample_entry(study_.pages, steps()[number], mark_of(visit_.name, number));
        const int times = number % 3 == 0 ? 2 : 1;
        for (int i = 0; i < times && visit_.trouble.empty(); ++i) {
            const Json answer =
                ask("/api/answer", {{"session", session_}, {"number", number}, {"answer", entry}});
            if (visit_.trouble.empty() && answer["stored"] != number + 1) {
                visit_.trouble = format("answer {} was stored as {}", number, answer["stored"].dump());
            }
        }
        ++visit_.acknowledged;
        if (crowd_.acknowledged) ++*crowd_.acknowledged;
    }

    void finish() {
        ask("/api/finish", {{"session", session_}, {"questionnaire", {{"age", 30}}}});
        visit_.finished = visit_.trouble.empty();
    }

    Json ask(const std::string& path, const Json& body) {
        const auto got =
            request(path, path.substr(path.rfind('/') + 1), [&] { return client_->post(path, body); });
        return got ? got->json() : Json();
    }

    // The answer, or trouble and nothing. Until there is one the same is sent again, as a page does.
    template <typename Send>
    std::optional<RawAnswer> request(const std::string& path, const std::string& kind, Send send) {
        for (int i = 0; i < kMostTries; ++i) {
            if (!client_ || !client_->connected()) {
                client_ = std::make_unique<RawClient>(crowd_.port());
                // Perhaps to another server: it must know all that the one before acknowledged.
                if (client_->connected() && !session_.empty() && path != kBegin) begin();
                if (!visit_.trouble.empty()) return std::nullopt;
                if (!client_) continue;
            }
            const auto begun = std::chrono::steady_clock::now();
            const auto answer = client_->connected() ? send() : std::nullopt;
            const std::chrono::duration<double> lasted = std::chrono::steady_clock::now() - begun;
            if (answer && answer->status == 200) {
                visit_.seconds[kind].push_back(lasted.count());
                return answer;
            }
            if (answer && answer->status != 503 && answer->status != 429) {
                visit_.trouble = format("{}: {} {}", path, answer->status, answer->body);
                return std::nullopt;
            }
            client_.reset();
            std::this_thread::sleep_for(std::chrono::milliseconds(20));
        }
        visit_.trouble = path + ": the server never answered";
        return std::nullopt;
    }

    const server::ServedStudy& study_;
    const Crowd& crowd_;
    std::unique_ptr<RawClient> client_;
    std::string session_;
    Json pages_;
    Visit visit_;
};

}  // namespace

std::vector<Visit> send_crowd(const server::ServedStudy& study, const Crowd& crowd) {
    std::vector<Visit> visits(crowd.people);
    std::vector<std::thread> threads;
    for (std::size_t i = 0; i < crowd.people; ++i) {
        threads.emplace_back([&, i] { visits[i] = Person(study, crowd, format("person-{}", i)).visit(); });
    }
    for (std::thread& thread : threads) thread.join();
    return visits;
}

std::string fault_of_answers(const server::ServedStudy& study, const std::filesystem::path& database,
                             const std::vector<Visit>& visits) {
    server::AnswerStore store(database, server::Database::Use::read, study.pages.study);
    std::map<std::string, server::Participant> stored;
    for (const server::Participant& participant : store.participants())
        stored[participant.name] = participant;
    std::string faults;
    if (stored.size() != visits.size())
        faults += format("{} participants for {}\n", stored.size(), visits.size());
    for (const Visit& visit : visits) {
        if (!visit.trouble.empty()) faults += format("{}: {}\n", visit.name, visit.trouble);
        const server::Participant& participant = stored[visit.name];
        const std::vector<server::StoredAnswer> answers = store.answers_of(participant.id);
        const bool right = participant.sheet == visit.sheet &&
                           participant.finished.has_value() == visit.finished &&
                           answers.size() >= visit.acknowledged;
        if (!right)
            faults += format("{}: {} answers on sheet {}\n", visit.name, answers.size(), participant.sheet);
        for (std::size_t i = 0; i < answers.size(); ++i) {
            const Step& step = study.sheets[participant.sheet][i];
            const std::string expected = sample_entry(study.pages, step, mark_of(visit.name, i)).dump();
            if (answers[i].number != i || answers[i].entry != expected) {
                faults += format("{}: answer {} is {}\n", visit.name, i, answers[i].entry);
            }
        }
    }
    return faults;
}

}  // namespace chironomia::testing
