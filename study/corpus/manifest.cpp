#include "study/corpus/manifest.h"

#include <set>

#include "core/files/json_value.h"
#include "core/text.h"
#include "synth/corpus/record_checks.h"

namespace chironomia {
namespace {

namespace fs = std::filesystem;

class ManifestReader {
  public:
    explicit ManifestReader(const fs::path& file)
        : json_(read_json(file)), value_(json_, file.string()), folder_(file.parent_path()) {
        manifest_.file = file;
    }

    ImportManifest run() {
        value_.allow_only({"kind", "limits", "recordings"});
        const bool talks = value_.at("kind").choice({"talks", "dyads"}) == "talks";
        manifest_.kind = talks ? CorpusKind::talks : CorpusKind::dyads;
        if (const auto limits = value_.find("limits")) manifest_.limits = limits_of(*limits);
        for (const JsonValue& recording : value_.at("recordings").items(1)) {
            if (talks)
                manifest_.talks.push_back(talk_of(recording));
            else
                manifest_.dyads.push_back(dyad_of(recording));
        }
        return std::move(manifest_);
    }

  private:
    static ShotLimits limits_of(const JsonValue& value) {
        value.allow_only({"least_seconds", "least_success", "least_sure", "least_confidence", "most_yaw_deg",
                          "most_pitch_deg", "least_words"});
        ShotLimits limits;
        const auto read = [&value](const char* name, double& limit, double most) {
            if (const auto found = value.find(name)) limit = found->number(0, most);
        };
        read("least_seconds", limits.least_seconds, 3600);
        read("least_success", limits.least_success, 1);
        read("least_sure", limits.least_sure, 1);
        read("least_confidence", limits.least_confidence, 1);
        read("most_yaw_deg", limits.most_yaw_deg, 180);
        read("most_pitch_deg", limits.most_pitch_deg, 180);
        if (const auto found = value.find("least_words"))
            limits.least_words = static_cast<std::size_t>(found->integer(1, 1000));
        return limits;
    }

    TalkRecording talk_of(const JsonValue& value) {
        value.allow_only({"id", "speaker", "face", "audio", "speech", "voice", "words", "shots", "split"});
        TalkRecording talk{.id = id_of(value), .speaker = name_of_person(value.at("speaker"))};
        talk.person = person_of(value);
        if (talk.person.audio.empty() && talk.person.voice.empty())
            value.refuse(
                "there is \"speech\", but not \"voice\" of openSMILE's eGeMAPS; add it, or \"audio\"");
        talk.words = path_of(value.at("words"));
        if (const auto shots = value.find("shots")) talk.shots = path_of(*shots);
        talk.split = split_of(value);
        return talk;
    }

    DyadRecording dyad_of(const JsonValue& value) {
        value.allow_only({"id", "language", "people", "split"});
        DyadRecording dyad{.id = id_of(value)};
        if (const auto language = value.find("language")) dyad.language = language->text();
        const auto people = value.at("people").items(2);
        if (people.size() != 2)
            value.at("people").refuse(format("there are {}; a dyad has 2", people.size()));
        for (std::size_t p = 0; p < 2; ++p) {
            people[p].allow_only({"participant", "role", "face", "audio", "speech"});
            dyad.participants[p] = name_of_person(people[p].at("participant"));
            if (const auto role = people[p].find("role")) dyad.roles[p] = role->text();
            dyad.people[p] = person_of(people[p]);
        }
        if (dyad.participants[0] == dyad.participants[1]) {
            people[1]
                .at("participant")
                .refuse(format("is \"{}\", as the other person is", dyad.participants[1]));
        }
        dyad.split = split_of(value);
        return dyad;
    }

    RecordedPerson person_of(const JsonValue& value) const {
        RecordedPerson person{.face = path_of(value.at("face"))};
        if (const auto audio = value.find("audio")) person.audio = path_of(*audio);
        if (const auto speech = value.find("speech")) person.speech = path_of(*speech);
        if (const auto voice = value.find("voice")) person.voice = path_of(*voice);
        if (person.audio.empty() == person.speech.empty()) {
            value.refuse(
                "the voice comes either from a sound (\"audio\") or from a table of openSMILE (\"speech\"); "
                "name one of them");
        }
        return person;
    }

    std::string id_of(const JsonValue& value) {
        const JsonValue id = value.at("id");
        const std::string name = plain(id);
        if (!ids_.insert(name).second) id.refuse(format("\"{}\" comes twice", name));
        return name;
    }

    static std::string plain(const JsonValue& value) {
        std::string name = value.text();
        if (!is_plain_name(name))
            value.refuse(format("\"{}\" cannot name a file; use letters, digits and . _ -", name));
        return name;
    }

    // In the index two names are joined by "+".
    static std::string name_of_person(const JsonValue& value) {
        std::string name = plain(value);
        if (name.find('+') != std::string::npos)
            value.refuse(format("\"{}\" has a +, which joins the people of a dyad", name));
        return name;
    }

    fs::path path_of(const JsonValue& value) const {
        fs::path path = folder_ / value.text();
        if (!fs::is_regular_file(path)) value.refuse(format("there is no file {}", path.string()));
        return path;
    }

    std::optional<Split> split_of(const JsonValue& value) {
        const auto named = value.find("split");
        if (!has_splits_) has_splits_ = named.has_value();
        if (*has_splits_ != named.has_value())
            value.refuse("some recordings have a \"split\" and some have none; give it to all or to none");
        if (!named) return std::nullopt;
        return split_named(named->choice({"train", "validation", "test", "unseen"}));
    }

    Json json_;
    JsonValue value_;
    fs::path folder_;
    std::set<std::string> ids_;
    std::optional<bool> has_splits_;  // of the first recording
    ImportManifest manifest_;
};

}  // namespace

ImportManifest read_import_manifest(const fs::path& file) {
    return ManifestReader(file).run();
}

}  // namespace chironomia
