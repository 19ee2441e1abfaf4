#include "study/corpus/manifest.h"

#include <limits>
#include <map>
#include <set>

#include "core/files/json_value.h"
#include "core/text.h"
#include "skinning/motion/picture/openpose.h"
#include "skinning/signal/frame_rate.h"
#include "study/corpus/contents.h"
#include "synth/corpus/record_checks.h"

namespace chironomia::study {
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
        manifest_.kind = *corpus_kind_named(value_.at("kind").choice({"talks", "dyads", "intervals"}));
        if (const auto limits = value_.find("limits")) read_limits(*limits);
        for (const JsonValue& recording : value_.at("recordings").items(1)) read_recording(recording);
        return std::move(manifest_);
    }

  private:
    void read_limits(const JsonValue& value) {
        if (manifest_.kind == CorpusKind::intervals)
            manifest_.interval_limits = interval_limits_of(value);
        else
            manifest_.limits = shot_limits_of(value);
    }

    void read_recording(const JsonValue& value) {
        switch (manifest_.kind) {
            case CorpusKind::talks:
                return manifest_.talks.push_back(talk_of(value));
            case CorpusKind::dyads:
                return manifest_.dyads.push_back(dyad_of(value));
            case CorpusKind::intervals:
                return manifest_.intervals.push_back(interval_of(value));
        }
    }

    // Puts the number of a key, if it is there, in place of `limit`.
    struct Range {
        double least = 0, most = 1;
    };
    static void read(const JsonValue& value, const char* name, double& limit, const Range& range) {
        if (const auto found = value.find(name)) limit = found->number(range.least, range.most);
    }

    static std::size_t words_of(const JsonValue& value, std::size_t otherwise) {
        const auto found = value.find("least_words");
        return found ? static_cast<std::size_t>(found->integer(1, 1000)) : otherwise;
    }

    static ShotLimits shot_limits_of(const JsonValue& value) {
        value.allow_only({"least_seconds", "least_success", "least_sure", "least_confidence", "most_yaw_deg",
                          "most_pitch_deg", "least_words"});
        ShotLimits limits;
        read(value, "least_seconds", limits.least_seconds, {.most = 3600});
        read(value, "least_success", limits.least_success, {});
        read(value, "least_sure", limits.least_sure, {});
        read(value, "least_confidence", limits.least_confidence, {});
        read(value, "most_yaw_deg", limits.most_yaw_deg, {.most = 180});
        read(value, "most_pitch_deg", limits.most_pitch_deg, {.most = 180});
        limits.least_words = words_of(value, limits.least_words);
        return limits;
    }

    static IntervalLimits interval_limits_of(const JsonValue& value) {
        value.allow_only({"least_seconds", "most_seconds", "most_pause_seconds", "most_edge_seconds",
                          "least_words", "least_seen", "least_confidence", "median_frames"});
        IntervalLimits limits;
        read(value, "least_seconds", limits.least_seconds, {.least = 0.1, .most = 3600});
        read(value, "most_seconds", limits.most_seconds, {.least = 0.1, .most = 3600});
        read(value, "most_pause_seconds", limits.most_pause_seconds, {.most = 60});
        read(value, "most_edge_seconds", limits.most_edge_seconds, {.most = 60});
        read(value, "least_seen", limits.least_seen, {});
        read(value, "least_confidence", limits.least_confidence, {.least = 1e-6});
        limits.least_words = words_of(value, limits.least_words);
        if (limits.most_seconds < 2 * limits.least_seconds) {
            value.refuse(
                format("most_seconds is {} and least_seconds {}; what is longer than the one is cut in two, "
                       "neither shorter than the other, so set it to {} or more",
                       limits.most_seconds, limits.least_seconds, 2 * limits.least_seconds));
        }
        if (const auto found = value.find("median_frames")) {
            limits.median_frames = static_cast<std::size_t>(found->integer(1, 15));
            if (limits.median_frames % 2 == 0)
                found->refuse(format("is {}; a median of as many frames before as behind is odd, such as {}",
                                     limits.median_frames, limits.median_frames + 1));
        }
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
        const fs::path shots = talk.shots.empty() ? fs::path() : contents_.first_like(talk.shots);
        take(value.at("face"), talk.person.face, {.id = talk.id, .shots = shots});
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
            take(people[p].at("face"), dyad.people[p].face, {.id = dyad.id});
        }
        if (dyad.participants[0] == dyad.participants[1]) {
            people[1]
                .at("participant")
                .refuse(format("is \"{}\", as the other person is", dyad.participants[1]));
        }
        refuse_one_voice(people[1], dyad.people);
        dyad.split = split_of(value);
        return dyad;
    }

    // A model would hear each of them in the other's place.
    static void refuse_one_voice(const JsonValue& second, const std::array<RecordedPerson, 2>& people) {
        for (const auto file : {&RecordedPerson::audio, &RecordedPerson::speech}) {
            const fs::path &a = people[0].*file, &b = people[1].*file;
            if (a.empty() || b.empty() || !have_same_contents(a, b)) continue;
            const bool is_copy = fs::canonical(a) != fs::canonical(b);
            second.refuse(format(
                "{} is the voice of the other person, too{}; give each one's own microphone, or cut a sound that "
                "has one in each channel: ffmpeg -i both.wav -af \"pan=mono|c0=c0\" first.wav",
                b.string(), is_copy ? format(": it has the bytes of {}", a.string()) : ""));
        }
    }

    IntervalRecording interval_of(const JsonValue& value) {
        value.allow_only(
            {"id", "speaker", "language", "pose", "fps", "audio", "words", "start", "end", "face", "split"});
        IntervalRecording interval{.id = id_of(value), .speaker = name_of_person(value.at("speaker"))};
        if (const auto language = value.find("language")) interval.language = language->text();
        interval.pose = pose_of(value);
        if (const auto fps = value.find("fps")) interval.fps = fps->number(kSlowestMotion, kFastestMotion);
        if (is_openpose_folder(interval.pose) && !interval.fps)
            value.refuse("OpenPose does not write the frame rate; give that of the video as \"fps\"");
        interval.audio = path_of(value.at("audio"));
        interval.words = path_of(value.at("words"));
        constexpr double kLongest = 1e6;  // [s]
        if (const auto start = value.find("start")) interval.start = start->number(0, kLongest);
        if (const auto end = value.find("end")) {
            interval.end = end->number(0, kLongest);
            if (*interval.end <= interval.start.value_or(0))
                end->refuse(format("is {} s, and the part starts at {} s; it must end behind that",
                                   *interval.end, interval.start.value_or(0)));
        }
        take(
            value.at("pose"), interval.pose,
            {.id = interval.id, .start = interval.start.value_or(0), .end = interval.end.value_or(kLongest)});
        if (const auto face = value.find("face")) interval.face = face->flag();
        interval.split = split_of(value);
        return interval;
    }

    fs::path pose_of(const JsonValue& value) const {
        const JsonValue pose = value.at("pose");
        fs::path path = folder_ / pose.text();
        if (fs::is_regular_file(path) || is_openpose_folder(path)) return path;
        pose.refuse(format("{} is neither a file nor a folder with files \"..._keypoints.json\" of OpenPose",
                           path.string()));
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

    // In the index two names are joined by "+". A person with two names may be in two splits.
    std::string name_of_person(const JsonValue& value) {
        std::string name = plain(value);
        if (name.find('+') != std::string::npos)
            value.refuse(format("\"{}\" has a +, which joins the people of a dyad", name));
        const std::string& first = people_.try_emplace(to_lower(name), name).first->second;
        if (first != name)
            value.refuse(
                format("is \"{}\", and \"{}\" comes before; write one person's name in one way, and give "
                       "two people names that differ by more",
                       name, first));
        return name;
    }

    // What a recording takes of a motion. Taken twice it may be in two splits, and a model is judged on what it has
    // learned.
    struct Taken {
        std::string id;
        fs::path shots{};
        double start = 0, end = std::numeric_limits<double>::infinity();  // [s]
    };
    void take(const JsonValue& value, const fs::path& motion, const Taken& part) {
        const fs::path first = contents_.first_like(motion);
        const bool is_copy = fs::canonical(first) != fs::canonical(motion);
        std::vector<Taken>& others = taken_[first];
        for (const Taken& other : others) {
            if (part.shots != other.shots || part.start >= other.end || other.start >= part.end) continue;
            value.refuse(format(
                "{} is of \"{}\" already{}; take no part of a recording twice, for a model would be judged "
                "on what it has learned",
                motion.string(), other.id,
                is_copy ? format(": it has the bytes of {}", first.string()) : ""));
        }
        others.push_back(part);
    }

    fs::path path_of(const JsonValue& value) const {
        fs::path path = folder_ / value.text();
        if (fs::is_directory(path)) value.refuse(format("{} is a folder, a file is needed", path.string()));
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
    std::map<std::string, std::string> people_;     // names as they are first written, by their lower case
    RecordingContents contents_;                    // of motions
    std::map<fs::path, std::vector<Taken>> taken_;  // by the first of the paths with the same contents
    std::optional<bool> has_splits_;                // of the first recording
    ImportManifest manifest_;
};

}  // namespace

ImportManifest read_import_manifest(const fs::path& file) {
    return ManifestReader(file).run();
}

}  // namespace chironomia::study
