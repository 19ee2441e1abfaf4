#include "study/analysis/answers.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <set>

#include "core/error.h"
#include "core/files/files.h"
#include "core/files/json_value.h"
#include "core/text.h"
#include "study/record/answer_values.h"
#include "study/record/link_parameters.h"

namespace chironomia::study::analysis {
namespace {

namespace fs = std::filesystem;

constexpr std::string_view kFormat = "chironomia answers 2";
constexpr long long kMost = 1000000;

double read_seconds(const JsonValue& value) {
    const bool fits = value.json().is_number() && value.json().get<double>() >= 0;
    if (!fits) value.refuse(format("is {}, a number of seconds is needed", value.shown()));
    return value.json().get<double>();
}

std::size_t read_page_index(const JsonValue& value, const StudyKey& key) {
    const std::string token = value.text();
    const auto found = std::find_if(key.pages.begin(), key.pages.end(),
                                    [&](const KeyPage& page) { return page.token == token; });
    if (found == key.pages.end())
        value.refuse(
            format("is {}, which is no page of the study; give the key of the study that was answered",
                   value.shown()));
    return static_cast<std::size_t>(found - key.pages.begin());
}

// Which place of the page stands where. A page whose one video shows both figures is as its places are.
std::vector<std::size_t> read_order(const JsonValue& list, const KeyPage& page) {
    const bool one_video = std::all_of(page.places.begin(), page.places.end(), [&](const KeyPlace& place) {
        return place.video == page.places.front().video;
    });
    const std::vector<JsonValue> shown = list.items(1);
    const std::size_t needed = one_video ? 1 : page.places.size();
    if (shown.size() != needed && !(one_video && shown.size() == page.places.size()))
        list.refuse(format("has {} entries, the page has {} videos", shown.size(), needed));
    std::vector<std::size_t> order;
    for (const JsonValue& item : shown) {
        const std::string token = item.text();
        std::size_t place = 0;
        while (place < page.places.size() && (page.places[place].video != token ||
                                              std::find(order.begin(), order.end(), place) != order.end()))
            ++place;
        if (place == page.places.size())
            item.refuse(format("is {}, which is no video of this page, or stands there twice", item.shown()));
        order.push_back(place);
    }
    for (std::size_t place = order.size(); one_video && place < page.places.size(); ++place)
        order.push_back(place);
    return order;
}

void check_reasons(const JsonValue& reasons, const StudyKey& key) {
    for (const Question& question : key.questions) {
        const auto given = reasons.filled(question.id);
        if (!given) continue;
        if (!question.reasons) given->refuse("the question asks for no reasons; remove them");
        // Not every host asks for reasons as the page does, so that none need be there.
        const std::string fault = fault_of_reasons(question, nullptr, given->json());
        if (!fault.empty()) given->refuse(format("is {}: {}", given->shown(), fault));
    }
}

PageAnswer read_page_answer(const JsonValue& value, const StudyKey& key) {
    PageAnswer answer{.page = read_page_index(value.at("page"), key),
                      .pass = static_cast<std::size_t>(value.at("pass").integer(0, kMost))};
    const KeyPage& page = key.pages[answer.page];
    answer.order = read_order(value.at("videos"), page);
    answer.skipped = value.at("skipped").flag();
    answer.seconds = read_seconds(value.at("seconds"));
    const JsonValue values = value.at("values");
    std::vector<std::string> ids;
    for (const Question& question : key.questions) ids.push_back(question.id);
    values.allow_only(ids);
    if (!answer.skipped && values.json().empty())
        values.refuse("is empty, but the page was not skipped; a page that was seen has answers");
    if (answer.skipped && !values.json().empty())
        values.refuse(format("is {}, but the page was skipped; it can have no answers", values.shown()));
    for (const Question& question : key.questions) {
        const auto given = values.find(question.id);
        const std::string needed = given ? fault_of_answer(question, given->json(), page.places.size()) : "";
        if (!needed.empty()) given->refuse(format("is {}; {}", given->shown(), needed));
    }
    answer.values = values.json();
    if (const auto reasons = value.find("reasons")) {
        reasons->allow_only(ids);
        check_reasons(*reasons, key);
        answer.reasons = reasons->json();
    }
    return answer;
}

// Names come from links that anybody can change: one control character must not stop the analysis of all.
// It is shown as JSON writes it, such as \u0000.
std::string read_name(const JsonValue& value) {
    if (!value.json().is_string()) return value.text();  // refuses it
    const auto& name = value.json().get_ref<const std::string&>();
    const std::string one_form = plain_name(name);
    const bool plain =
        std::none_of(one_form.begin(), one_form.end(), [](unsigned char c) { return c < 0x20 || c == 0x7f; });
    if (plain && !one_form.empty()) return one_form;
    return value.json().dump(-1, ' ', true);
}

Respondent read_respondent(const JsonValue& value, const fs::path& file, const StudyKey& key) {
    const JsonValue written = value.at("format");
    if (written.text() != kFormat)
        written.refuse(format("is {}, \"{}\" is needed", written.shown(), kFormat));
    const JsonValue study = value.at("study");
    if (study.text() != key.study)
        study.refuse(format("is {}, the key is of study \"{}\"; give each study its own answers",
                            study.shown(), key.study));
    Respondent participant{.name = read_name(value.at("participant")),
                           .file = file.string(),
                           .sheet = static_cast<std::size_t>(value.at("sheet").integer(0, kMost))};
    if (const auto simulated = value.find("simulated")) participant.simulated = simulated->flag();
    participant.finished = !value.at("finished").json().is_null();
    if (const auto asked = value.find("questionnaire"); asked && !asked->json().is_null()) {
        if (!asked->json().is_object()) asked->refuse(format("is {}, an object is needed", asked->shown()));
        participant.questionnaire = asked->json();
    }
    std::set<std::pair<std::size_t, std::size_t>> passes;
    for (const JsonValue& item : value.at("answers").items(0)) {
        participant.answers.push_back(read_page_answer(item, key));
        const PageAnswer& answer = participant.answers.back();
        if (!passes.insert({answer.page, answer.pass}).second)
            item.refuse(format("pass {} of page \"{}\" is answered a second time; remove one answer",
                               answer.pass, key.pages[answer.page].token));
    }
    return participant;
}

// People whom a service knows by one name are one person, whatever the page called them.
std::string known_as(const JsonValue& value) {
    const auto arrived = value.find("arrived_with");
    if (!arrived || !arrived->json().is_object()) return "";
    const auto found = arrived->json().find("PROLIFIC_PID");
    if (found == arrived->json().end() || !found->is_string()) return "";
    const std::string name = plain_name(found->get_ref<const std::string&>());
    return is_unfilled(name) ? "" : name;
}

void refuse_twice(std::map<std::string, std::string>& seen, const std::string& name, const std::string& what,
                  const std::string& file) {
    if (name.empty()) return;
    const auto [before, is_new] = seen.emplace(name, file);
    if (!is_new)
        throw Error(format(
            "{}: {} \"{}\" is already in {}; give the answers of each participant once; if these are two "
            "people, as of two waves, rename one of them",
            file, what, name, before->second));
}

bool has_visit(const Json& answers) {
    return answers.is_object() && answers.value("participant", Json()).is_string() &&
           answers.value("started", Json()).is_string() && answers.value("answers", Json()).is_array();
}

// Whether one visit, as it was while it went on, is the beginning of another file's.
bool goes_on_in(const Json& earlier, const Json& later) {
    const Json &some = earlier["answers"], &all = later["answers"];
    const bool is_longer =
        all.size() > some.size() || (all.size() == some.size() && !later.value("finished", Json()).is_null());
    return is_longer && earlier.value("finished", Json()).is_null() &&
           earlier.value("started", Json()) == later.value("started", Json()) &&
           earlier.value("sheet", Json()) == later.value("sheet", Json()) &&
           std::equal(some.begin(), some.end(), all.begin());
}

// A front end that keeps answers as they are given may write a file after each page. Of these the last one counts.
std::set<const Json*> beginnings_in(const std::vector<Json>& files) {
    std::map<std::string, std::vector<const Json*>> visits;
    const auto add = [&](const Json& answers) {
        if (has_visit(answers)) visits[answers["participant"]].push_back(&answers);
    };
    for (const Json& file : files) {
        if (!file.is_array()) {
            add(file);
        } else {
            for (const Json& answers : file) add(answers);
        }
    }
    std::set<const Json*> beginnings;
    for (const auto& [name, of_one] : visits) {
        for (const Json* earlier : of_one) {
            for (const Json* later : of_one) {
                if (earlier != later && goes_on_in(*earlier, *later)) beginnings.insert(earlier);
            }
        }
    }
    return beginnings;
}

struct AnswersFolder {
    std::vector<fs::path> files;       // of answers
    std::vector<std::string> folders;  // names
    std::vector<std::string> others;   // names
};

AnswersFolder look_into(const fs::path& folder) {
    AnswersFolder inside;
    for (const auto& entry : fs::directory_iterator(folder)) {
        const std::string extension = extension_of(entry.path());
        const std::string name = entry.path().filename().string();
        // As macOS leaves them beside files: "._a.json".
        if (name.starts_with('.')) continue;
        if (entry.is_directory()) {
            inside.folders.push_back(name);
        } else if (entry.is_regular_file() && (extension == ".json" || extension == ".csv")) {
            inside.files.push_back(entry.path());
        } else {
            inside.others.push_back(name);
        }
    }
    std::sort(inside.files.begin(), inside.files.end());
    std::sort(inside.folders.begin(), inside.folders.end());
    std::sort(inside.others.begin(), inside.others.end());
    return inside;
}

// "a", "b", "c" and 7 more
std::string some_of(const std::vector<std::string>& names) {
    constexpr std::size_t kMostNamed = 5;
    std::vector<std::string> quoted;
    for (std::size_t i = 0; i < std::min(names.size(), kMostNamed); ++i)
        quoted.push_back(format("\"{}\"", names[i]));
    const std::string text = join(quoted, ", ");
    return names.size() <= kMostNamed ? text : format("{} and {} more", text, names.size() - kMostNamed);
}

std::vector<std::string> notes_on(const AnswersFolder& inside, const fs::path& folder) {
    std::vector<std::string> notes;
    // Results are the same wherever the folder lies.
    const std::string name = fs::weakly_canonical(folder).filename().string();
    if (!inside.folders.empty())
        notes.push_back(
            format("{}: holds folders, which are not looked into: {}.", name, some_of(inside.folders)));
    if (!inside.others.empty())
        notes.push_back(format("{}: holds files that are no .json or .csv, which are not read: {}.", name,
                               some_of(inside.others)));
    return notes;
}

// The same answers would count twice, by whichever path their file is named.
void refuse_files_twice(const std::vector<fs::path>& files) {
    std::map<fs::path, fs::path> seen;
    for (const fs::path& file : files) {
        std::error_code unknown;
        const auto [before, is_new] = seen.emplace(fs::weakly_canonical(file, unknown), file);
        if (!is_new && !unknown)
            throw Error(format("{}: is the same file as {}, which is named before it; name each file once",
                               file.string(), before->second.string()));
    }
}

void refuse_mixture(const std::vector<Respondent>& participants) {
    const auto simulated = std::count_if(participants.begin(), participants.end(),
                                         [](const Respondent& each) { return each.simulated; });
    const auto people = static_cast<std::ptrdiff_t>(participants.size()) - simulated;
    if (simulated > 0 && people > 0)
        throw Error(format("the answers: {} participants are simulated and {} are not; analyse them apart",
                           simulated, people));
}

}  // namespace

std::string extension_of(const fs::path& file) {
    return to_lower(file.extension().string());
}

AnswerFiles files_of_answers(const std::vector<fs::path>& paths) {
    AnswerFiles answers;
    for (const fs::path& path : paths) {
        if (!fs::exists(path)) throw Error(format("{}: there is no such file or folder", path.string()));
        if (!fs::is_directory(path)) {
            answers.files.push_back(path);
            continue;
        }
        const AnswersFolder inside = look_into(path);
        if (inside.files.empty())
            throw Error(
                format("{}: holds no .json and no .csv file; give the folder of the answers", path.string()));
        answers.files.insert(answers.files.end(), inside.files.begin(), inside.files.end());
        for (std::string& note : notes_on(inside, path)) answers.notes.push_back(std::move(note));
    }
    refuse_files_twice(answers.files);
    return answers;
}

void refuse_folder_of_answers(const fs::path& results) {
    if (!fs::is_directory(results)) return;
    for (const auto& entry : fs::directory_iterator(results)) {
        if (!entry.is_regular_file() || extension_of(entry.path()) != ".json") continue;
        // So begin those of this program and of HEMVIP, damaged ones too.
        const std::string text = read_text(entry.path());
        if (text.find(kFormat) == std::string::npos && text.find("\"userId\"") == std::string::npos) continue;
        throw Error(
            format("{}: holds the answers {}, beside which results would be read as answers; name another "
                   "folder for them",
                   results.string(), entry.path().filename().string()));
    }
}

std::vector<Respondent> read_answers(const std::vector<fs::path>& files, const StudyKey& key) {
    std::vector<Respondent> participants;
    std::map<std::string, std::string> names, known;
    std::vector<Json> whole_files;
    for (const fs::path& file : files) whole_files.push_back(read_json(file));
    const std::set<const Json*> beginnings = beginnings_in(whole_files);
    for (std::size_t i = 0; i < files.size(); ++i) {
        const fs::path& file = files[i];
        const Json& json = whole_files[i];
        const JsonValue whole(json, file.string());
        for (const JsonValue& value : json.is_array() ? whole.items(0) : std::vector<JsonValue>{whole}) {
            if (beginnings.contains(&value.json())) continue;
            participants.push_back(read_respondent(value, file, key));
            refuse_twice(names, participants.back().name, "participant", file.string());
            refuse_twice(known, known_as(value), "the PROLIFIC_PID", file.string());
        }
    }
    refuse_mixture(participants);
    return participants;
}

void require_replaceable(const fs::path& file, bool by_simulated) {
    if (!fs::exists(file)) return;
    const Json held = Json::parse(read_text(file), nullptr, false);
    const Json all = held.is_array() ? held : Json::array({held});
    for (const Json& one : all) {
        if (!one.is_object() || one.value("format", Json()) != kFormat)
            throw Error(format("{}: is there already and holds no answers; name a new file", file.string()));
        if (by_simulated && one.value("simulated", Json()) != true) {
            throw Error(
                format("{}: holds answers of people, which simulated ones would replace; name a new file",
                       file.string()));
        }
    }
}

}  // namespace chironomia::study::analysis
