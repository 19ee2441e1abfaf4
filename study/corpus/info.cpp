#include "study/corpus/info.h"

#include <algorithm>
#include <array>
#include <functional>
#include <map>
#include <set>

#include "core/math.h"
#include "core/text.h"
#include "study/corpus/words.h"
#include "synth/corpus/moments.h"

namespace chironomia::study {
namespace {

constexpr std::array kSplits = {Split::train, Split::validation, Split::test, Split::unseen};
constexpr std::array<const char*, IpuRecord::kUnits> kTalkUnitNames = {"AU1", "AU2", "AU4",
                                                                       "AU5", "AU6", "AU7"};
constexpr std::array<const char*, IpuRecord::kAngles> kAngles = {"pose_Rx", "pose_Ry", "pose_Rz"};
constexpr std::array<const char*, DyadPerson::kFace> kDyadFace = {
    "gaze_angle_x", "gaze_angle_y", "pose_Rx", "pose_Ry", "pose_Rz", "AU1", "AU2", "AU4", "AU6", "AU12"};
constexpr float kVoiced = 0.3f;  // least strength of a pitch
// Of PATS's 52: shoulders, elbows, wrists, nose, eyes, roots of the hands.
constexpr std::array<std::size_t, 11> kJoints = {1, 2, 3, 4, 5, 6, 7, 8, 9, 10, 31};
constexpr std::size_t kRightShoulder = 1, kLeftShoulder = 4, kRightWrist = 3, kLeftWrist = 6;

// What is gathered of one person over all records.
struct Person {
    std::set<Split> splits;
    std::size_t records = 0;
    double seconds = 0;
    SaidWords said;
    std::set<std::string> roles, partners;
    std::map<std::string, Moments> of;  // by key: "f0_hz", "units/AU1"
    double frames = 0, bridged = 0;
};

using People = std::map<std::string, Person>;

Json json_of(const Moments& moments) {
    return {{"mean", moments.mean}, {"sd", moments.deviation()}};
}

template <std::size_t N>
void add_columns(Person& person, const std::string& group, const std::array<const char*, N>& names,
                 const std::vector<float>& rows) {
    for (std::size_t i = 0; i < rows.size(); ++i) person.of[group + "/" + names[i % N]].add(rows[i]);
}

void add(Person& person, const IpuRecord& record) {
    person.said.add(record);
    for (std::size_t s = 0; s < record.f0.size(); ++s) {
        if (record.f0_strength[s] >= kVoiced) person.of["f0_hz"].add(record.f0[s]);
    }
    add_columns(person, "units", kTalkUnitNames, record.units);
    add_columns(person, "head_rad", kAngles, record.head);
    person.frames += static_cast<double>(record.frames());
    person.bridged += static_cast<double>(std::count(record.success.begin(), record.success.end(), 0));
}

// The points of an interval's frames, x right and y down.
class Body {
  public:
    explicit Body(const IntervalRecord& record) : record_(record) {}

    Vec2 at(std::size_t frame, std::size_t joint) const {
        const std::size_t x = frame * 2 * IntervalRecord::kJoints + joint;
        return {record_.pose_normalized[x], record_.pose_normalized[x + IntervalRecord::kJoints]};
    }
    bool sees(std::size_t frame, std::size_t joint) const {
        return record_.pose_confidence[frame * 2 * IntervalRecord::kJoints + joint] > 0;
    }
    bool sees_all(std::size_t frame) const {
        return std::all_of(kJoints.begin(), kJoints.end(),
                           [&](std::size_t joint) { return sees(frame, joint); });
    }
    // 2 (width + height) of the box around all joints.
    double perimeter(std::size_t frame) const {
        Vec2 least = at(frame, kJoints[0]), most = least;
        for (const std::size_t joint : kJoints) {
            least = glm::min(least, at(frame, joint));
            most = glm::max(most, at(frame, joint));
        }
        return 2.0 * double{most.x - least.x + most.y - least.y};
    }

  private:
    const IntervalRecord& record_;
};

void add(Person& person, const IntervalRecord& record) {
    person.said.add(record);
    const Body body(record);
    for (std::size_t t = 0; t < record.frames(); ++t) {
        if (body.sees_all(t)) person.of["box_perimeter"].add(body.perimeter(t));
        if (body.sees(t, kLeftShoulder) && body.sees(t, kRightShoulder))
            person.of["shoulders"].add(distance(body.at(t, kLeftShoulder), body.at(t, kRightShoulder)));
        for (const std::size_t wrist : {kLeftWrist, kRightWrist}) {
            if (t == 0 || !body.sees(t, wrist) || !body.sees(t - 1, wrist)) continue;
            person.of["wrist_speed"].add(distance(body.at(t, wrist), body.at(t - 1, wrist)) *
                                         IntervalRecord::kFps);
        }
    }
}

void add_record(People& people, const CorpusIndex& corpus, const CorpusEntry& entry) {
    const auto person = [&](const std::string& name) -> Person& {
        Person& found = people[name];
        found.splits.insert(entry.split);
        ++found.records;
        found.seconds += entry.seconds;
        return found;
    };
    switch (corpus.kind) {
        case CorpusKind::talks:
            add(person(entry.speaker), read_ipu(corpus, entry));
            break;
        case CorpusKind::intervals:
            add(person(entry.speaker), read_interval(corpus, entry));
            break;
        case CorpusKind::dyads: {
            const DyadRecord record = read_dyad(corpus, entry);
            for (std::size_t p = 0; p < 2; ++p) {
                Person& one = person(record.people[p].participant);
                one.roles.insert(record.people[p].role);
                one.partners.insert(record.people[1 - p].participant);
                add_columns(one, "face", kDyadFace, record.people[p].face);
            }
        }
    }
}

// In widths of the person's shoulders, so that people compare whatever their size in the picture.
void scale_by_shoulders(Person& person) {
    const double width = person.of["shoulders"].mean;
    person.of.erase("shoulders");
    for (auto& [key, moments] : person.of) {
        if (width <= 0) continue;
        moments.mean /= width;
        moments.squares /= width * width;
    }
}

Json json_of(const std::string& name, Person person, CorpusKind kind) {
    Json json = {{"speaker", name}, {"splits", Json::array()}};
    for (const Split split : person.splits) json["splits"].push_back(name_of(split));
    json["records"] = person.records;
    json["minutes"] = person.seconds / 60;
    if (kind == CorpusKind::dyads) {
        json["roles"] = person.roles;
        json["partners"] = person.partners;
    } else {
        json["words_per_minute"] =
            person.seconds > 0 ? static_cast<double>(person.said.texts().size()) / (person.seconds / 60) : 0;
    }
    if (kind == CorpusKind::talks) json["bridged"] = person.bridged / person.frames;
    if (kind == CorpusKind::intervals) scale_by_shoulders(person);
    for (const auto& [key, moments] : person.of) {
        const std::size_t slash = key.find('/');
        if (slash == std::string::npos)
            json[key] = json_of(moments);
        else
            json[key.substr(0, slash)][key.substr(slash + 1)] = json_of(moments);
    }
    return json;
}

double minutes_of(const std::vector<CorpusEntry>& entries) {
    double seconds = 0;
    for (const CorpusEntry& entry : entries) seconds += entry.seconds;
    return seconds / 60;
}

std::size_t speakers_of(const std::vector<CorpusEntry>& entries) {
    std::set<std::string> speakers;
    for (const CorpusEntry& entry : entries) {
        for (const std::string_view person : split(entry.speaker, '+')) speakers.emplace(person);
    }
    return speakers.size();
}

std::string mean_text(const Json& value, const char* number) {
    return format(fmt::runtime(format("{{:{}}} ({{:{}}})", number, number)), value["mean"].get<double>(),
                  value["sd"].get<double>());
}

// Lines of cells, each column as wide as its widest cell.
std::string table_text(const std::vector<std::vector<std::string>>& rows) {
    std::vector<std::size_t> widths;
    for (const auto& row : rows) {
        widths.resize(std::max(widths.size(), row.size()));
        for (std::size_t c = 0; c < row.size(); ++c) widths[c] = std::max(widths[c], row[c].size());
    }
    std::string text;
    for (const auto& row : rows) {
        std::string line;
        for (std::size_t c = 0; c < row.size(); ++c) line += format("{:<{}}", row[c], widths[c] + 2);
        text += line.substr(0, line.find_last_not_of(' ') + 1) + "\n";
    }
    return text;
}

// What a column of the table of people is called, and what it says of one of them.
struct Column {
    std::string name;
    std::function<std::string(const Json&)> cell;
};

Column mean_column(const std::string& name, const std::string& path, const char* number) {
    return {name, [path, number](const Json& person) {
                const Json::json_pointer place("/" + path);
                return person.contains(place) ? mean_text(person[place], number) : std::string("-");
            }};
}

Column lexical_column(const std::string& name, const char* key) {
    return {name, [key](const Json& person) {
                const Json value = person.value("lexical", Json::object()).value(key, Json());
                if (value.is_null()) return std::string("-");
                return value.is_number_float() ? format("{:.2f}", value.get<double>()) : value.dump();
            }};
}

std::vector<Column> columns_of(const std::string& kind) {
    const auto list = [](const char* key) {
        return [key](const Json& person) { return join(person[key].get<std::vector<std::string>>()); };
    };
    std::vector<Column> columns = {
        {"speaker", [](const Json& person) { return person["speaker"].get<std::string>(); }},
        {"minutes", [](const Json& person) { return format("{:.1f}", person["minutes"].get<double>()); }},
        {"splits", list("splits")}};
    if (kind == name_of(CorpusKind::dyads)) {
        columns.push_back({"roles", list("roles")});
        columns.push_back({"with", list("partners")});
        for (const char* name : kDyadFace)
            columns.push_back(mean_column(name, format("face/{}", name), ".2f"));
        return columns;
    }
    columns.push_back({"words/min", [](const Json& person) {
                           return format("{:.0f}", person["words_per_minute"].get<double>());
                       }});
    columns.push_back(lexical_column("distinct", "diversity"));
    columns.push_back(lexical_column("of 1000", "diversity_per_1000"));
    columns.push_back(lexical_column("alike", "cluster"));
    if (kind == name_of(CorpusKind::intervals)) {
        columns.push_back(mean_column("box", "box_perimeter", ".2f"));
        columns.push_back(mean_column("wrists/s", "wrist_speed", ".2f"));
        return columns;
    }
    columns.push_back(mean_column("f0 [Hz]", "f0_hz", ".0f"));
    for (const char* name : kTalkUnitNames)
        columns.push_back(mean_column(name, format("units/{}", name), ".2f"));
    for (const char* name : kAngles) columns.push_back(mean_column(name, format("head_rad/{}", name), ".2f"));
    return columns;
}

std::string people_text(const Json& description) {
    const std::vector<Column> columns = columns_of(description["kind"].get<std::string>());
    std::vector<std::vector<std::string>> rows(1);
    for (const Column& column : columns) rows[0].push_back(column.name);
    for (const Json& person : description["people"]) {
        rows.emplace_back();
        for (const Column& column : columns) rows.back().push_back(column.cell(person));
    }
    return table_text(rows);
}

}  // namespace

Json describe_corpus(const CorpusIndex& corpus) {
    People people;
    for (const CorpusEntry& entry : corpus.entries) add_record(people, corpus, entry);
    Json json = {{"kind", name_of(corpus.kind)},        {"folder", corpus.folder.string()},
                 {"text_encoder", corpus.text_encoder}, {"records", corpus.entries.size()},
                 {"speakers", people.size()},           {"minutes", minutes_of(corpus.entries)}};
    for (const Split split : kSplits) {
        const std::vector<CorpusEntry> entries = corpus.of(split);
        json["splits"][std::string(name_of(split))] = {{"records", entries.size()},
                                                       {"minutes", minutes_of(entries)},
                                                       {"speakers", speakers_of(entries)}};
    }
    std::map<std::string, SaidWords> said;
    for (const auto& [name, person] : people) said.emplace(name, person.said);
    const std::map<std::string, Json> lexical = lexical_of(said);
    json["people"] = Json::array();
    for (const auto& [name, person] : people) {
        json["people"].push_back(json_of(name, person, corpus.kind));
        if (const auto about = lexical.find(name); about != lexical.end())
            json["people"].back()["lexical"] = about->second;
    }
    if (corpus.origin.contains("left_out")) json["left_out"] = corpus.origin["left_out"];
    return json;
}

std::string corpus_text(const Json& description) {
    std::string text = format("{} of {} records, {} speakers, {:.1f} min, words by {}\n",
                              description["kind"].get<std::string>(), description["records"].get<int>(),
                              description["speakers"].get<int>(), description["minutes"].get<double>(),
                              description["text_encoder"].get<std::string>());
    for (const auto& [name, part] : description["splits"].items()) {
        text += format("{:<12}{} records, {} speakers, {:.1f} min\n", name, part["records"].get<int>(),
                       part["speakers"].get<int>(), part["minutes"].get<double>());
    }
    if (description.contains("left_out")) {
        for (const auto& [why, count] : description["left_out"].items())
            text += format("left out    {}: {}\n", why, count.get<int>());
    }
    return text + "\n" + people_text(description);
}

}  // namespace chironomia::study
