#include "synth/speech/word_json.h"

#include <algorithm>
#include <array>
#include <initializer_list>
#include <set>
#include <string>
#include <string_view>
#include <utility>

#include "core/error.h"
#include "core/files/json.h"
#include "core/files/json_text.h"
#include "core/text.h"
#include "synth/speakers/languages.h"
#include "synth/speech/word_text.h"

namespace chironomia {
namespace {

namespace fs = std::filesystem;

class Reader {
  public:
    Reader(const fs::path& file, double duration)
        : file_(file.string()), json_(read_json(file)), duration_(duration) {}

    TimedLabels read() {
        if (has_list(json_, "result")) {
            read_words(json_["result"], "result");
        } else if (has_any(json_, "result")) {
            read_results();
        } else if (has_any(json_, "alternatives")) {
            read_alternatives(json_, "");
        } else if (has_list(json_, "results") && has_any(json_["results"], "alternatives")) {
            read_alternatives(json_["results"], "results");
        } else if (json_.is_object() && has_list(json_.value("results", Json()), "channels")) {
            read_alternatives(json_["results"]["channels"], "results.channels");  // Deepgram's
        } else if (has_any(json_, "words")) {
            read_segments(json_, "");
        } else if (json_.is_array()) {
            read_words(with_times_between(json_), "");
        } else if (has_list(json_, "segments") && !has_words_beside_segments()) {
            read_segments(json_["segments"], "segments");
        } else if (has_list(json_, "words")) {
            read_words(with_times_between(json_["words"]), "words");
        } else if (has_list(json_, "word_segments")) {
            read_words(with_times_between(json_["word_segments"]), "word_segments");
        } else if (has_list(json_, "chunks")) {
            read_words(words_of_chunks(), "chunks");
        } else if (has_list(json_, "transcription")) {
            read_transcription(json_["transcription"]);
        } else {
            throw Error(format(
                "{}: it holds no list of words, \"words\", \"segments\", \"chunks\" or \"transcription\"; write "
                "[{{\"word\": \"hello\", \"start\": 0.1, \"end\": 0.4}}]",
                file_));
        }
        join_pieces();
        labels_.language = language();
        if (untimed_ > 0) {
            labels_.notes.push_back(
                format("{}: {} words have no times and share what their neighbours leave", file_, untimed_));
        }
        return std::move(labels_);
    }

  private:
    static bool has_list(const Json& object, const char* key) {
        return object.is_object() && object.contains(key) && object[key].is_array();
    }

    // Whether it is a list with such a list in one of its objects.
    static bool has_any(const Json& list, const char* key) {
        return list.is_array() &&
               std::any_of(list.begin(), list.end(), [&](const Json& part) { return has_list(part, key); });
    }

    // OpenAI's service lists the words of a recording beside its segments, which hold none.
    bool has_words_beside_segments() const {
        return !has_any(json_["segments"], "words") &&
               std::ranges::any_of(std::array{"words", "word_segments"}, [&](const char* key) {
                   return has_list(json_, key) && std::any_of(json_[key].begin(), json_[key].end(), is_timed);
               });
    }

    // What Google heard in one stretch of sound after the other, the likeliest first.
    void read_alternatives(const Json& results, const std::string& place) {
        for (std::size_t i = 0; i < results.size(); ++i) {
            if (!has_list(results[i], "alternatives") || results[i]["alternatives"].empty()) continue;
            const Json& best = results[i]["alternatives"][0];
            if (has_list(best, "words"))
                read_words(best["words"], format("{}[{}].alternatives[0].words", place, i));
        }
    }

    // Hugging Face's: {"text": " hello", "timestamp": [0.1, 0.4]}, of which the last one may have no end.
    Json words_of_chunks() const {
        Json words = Json::array();
        for (const Json& chunk : json_["chunks"]) {
            Json& word = words.emplace_back(chunk);
            if (!has_list(chunk, "timestamp") || chunk["timestamp"].size() != 2) continue;
            word["start"] = chunk["timestamp"][0];
            word["end"] = chunk["timestamp"][chunk["timestamp"][1].is_null() ? 0 : 1];
        }
        return words;
    }

    // What Vosk says of one stretch of sound after the other; where it heard nothing there are no words.
    void read_results() {
        for (std::size_t i = 0; i < json_.size(); ++i) {
            if (has_list(json_[i], "result")) read_words(json_[i]["result"], format("[{}].result", i));
        }
    }

    // As voices name it; "" if the file does not say.
    std::string language() const {
        const Json& about = json_.is_object() && json_.contains("result") ? json_["result"] : json_;
        if (!about.is_object() || !about.contains("language") || !about["language"].is_string()) return "";
        return language_named(about["language"].get<std::string>());
    }

    void read_segments(const Json& segments, const std::string& list) {
        for (std::size_t i = 0; i < segments.size(); ++i) {
            const std::string place = format("{}[{}]", list, i);
            if (has_list(segments[i], "words")) {
                speaker_ = speaker_in(segments[i], "");
                const Json& words = segments[i]["words"];
                const bool has_ends = has_number(segments[i], "start") && has_number(segments[i], "end");
                read_words(has_ends ? with_times(words, segments[i]["start"], segments[i]["end"])
                                    : with_times_between(words),
                           place + ".words");
                speaker_.clear();
            } else {
                read_word(segments[i], place);
            }
        }
    }

    static bool has_number(const Json& object, const char* key) {
        return object.is_object() && object.contains(key) && object[key].is_number();
    }

    static bool is_timed(const Json& word) { return has_number(word, "start") && has_number(word, "end"); }

    // WhisperX gives no times to numbers and other words that it cannot align, Gentle none to those that it does not
    // hear. Such words share the time between their neighbours, or `from` and `to` [s].
    Json with_times(Json words, double from, double to) {
        const auto is_untimed = [](const Json& word) {
            return word.is_object() && !word.contains("start") && !word.contains("end");
        };
        for (std::size_t first = 0; first < words.size(); ++first) {
            if (is_timed(words[first])) from = words[first]["end"];
            std::size_t last = first;
            while (last < words.size() && is_untimed(words[last])) ++last;
            if (last == first) continue;
            const bool has_next = last < words.size() && is_timed(words[last]);
            const double until = std::max(from, has_next ? words[last]["start"].get<double>() : to);
            const double each = (until - from) / static_cast<double>(last - first);
            untimed_ += last - first;
            for (std::size_t i = first; i < last; ++i, from += each) {
                words[i]["start"] = from;
                words[i]["end"] = from + each;
            }
            first = last - 1;
        }
        return words;
    }

    // The same of a list that says neither when it begins nor when it ends.
    Json with_times_between(const Json& words) {
        // of one before the first or behind the last that has times, at most [s]
        constexpr double kWord = 0.3;
        const auto first = std::find_if(words.begin(), words.end(), is_timed);
        if (first == words.end()) return words;
        auto last = words.end() - 1;
        while (!is_timed(*last)) --last;
        const auto before = static_cast<double>(first - words.begin());
        const auto behind = static_cast<double>(words.end() - 1 - last);
        return with_times(words, std::max(0.0, (*first)["start"].get<double>() - kWord * before),
                          std::min(duration_, (*last)["end"].get<double>() + kWord * behind));
    }

    void read_words(const Json& words, const std::string& place) {
        for (std::size_t i = 0; i < words.size(); ++i) {
            read_word(words[i], format("{}[{}]", place, i));
            // The first word of a segment may lack its space.
            if (i > 0 && !begins_with_space(labels_.words.back())) pieces_.insert(labels_.words.size() - 1);
        }
    }

    static bool begins_with_space(const TimedLabel& word) { return word.text.starts_with(' '); }

    // Whisper parts "l'homme" and "là-bas", and shows by a space where a word begins. Where most words have none they
    // are whole.
    void join_pieces() {
        const auto spaces = std::ranges::count_if(labels_.words, begins_with_space);
        if (2 * static_cast<std::size_t>(spaces) < labels_.words.size()) return;
        std::vector<TimedLabel> words;
        for (std::size_t i = 0; i < labels_.words.size(); ++i) {
            TimedLabel& word = labels_.words[i];
            if (pieces_.contains(i) && word.speaker == words.back().speaker)
                append(words.back(), word.text, word.end);
            else
                words.push_back(std::move(word));
        }
        labels_.words = std::move(words);
    }

    // Signs alone do not make a word longer.
    static void append(TimedLabel& word, const std::string& text, double end) {
        word.text += text;
        if (!without_punctuation(text).empty()) word.end = end;
    }

    void read_transcription(const Json& parts) {
        for (std::size_t i = 0; i < parts.size(); ++i) {
            const std::string place = format("transcription[{}]", i);
            if (!has_list(parts[i], "tokens")) {
                read_piece(parts[i], place);
                continue;
            }
            const Json& tokens = parts[i]["tokens"];
            for (std::size_t k = 0; k < tokens.size(); ++k)
                read_piece(tokens[k], format("{}.tokens[{}]", place, k));
        }
    }

    // Of a word: a space begins a new one. Those of the recogniser itself are "[_BEG_]", "[_TT_550]".
    void read_piece(const Json& piece, const std::string& place) {
        if (!piece.is_object() || !piece.contains("offsets"))
            throw Error(format("{}: {} has no \"offsets\"; write it again", file_, place));
        const Json& offsets = piece["offsets"];
        const std::string text = text_in(piece, place);
        if (text.starts_with("[_")) return;
        const double end = number_in(offsets, "to", place + ".offsets") / 1000;
        if (!labels_.words.empty() && !text.empty() && text[0] != ' ') {
            append(labels_.words.back(), text, end);
            return;
        }
        labels_.words.push_back({.where = place,
                                 .text = text,
                                 .start = number_in(offsets, "from", place + ".offsets") / 1000,
                                 .end = end});
    }

    // WhisperX names speakers if it was asked to.
    static std::string speaker_in(const Json& object, const std::string& otherwise) {
        if (!object.is_object() || !object.contains("speaker") || object["speaker"].is_null())
            return otherwise;
        const Json& speaker = object["speaker"];
        return speaker.is_string() ? speaker.get<std::string>() : speaker.dump();
    }

    void read_word(const Json& word, const std::string& place) {
        labels_.words.push_back({.where = place,
                                 .text = text_in(word, place),
                                 .start = time_in(word, {"start", "start_time", "startTime"}, place),
                                 .end = time_in(word, {"end", "end_time", "endTime"}, place),
                                 .speaker = speaker_in(word, speaker_)});
    }

    // Under the first name that is there. Google writes "1.300s".
    double time_in(const Json& word, std::initializer_list<const char*> names,
                   const std::string& place) const {
        for (const char* name : names) {
            if (!word.is_object() || !word.contains(name)) continue;
            const Json& value = word[name];
            if (!value.is_string()) return number_in(word, name, place);
            std::string_view text = value.get_ref<const std::string&>();
            if (text.ends_with('s')) text.remove_suffix(1);
            if (const auto seconds = parse_number(text)) return *seconds;
        }
        return number_in(word, *names.begin(), place);
    }

    std::string text_in(const Json& object, const std::string& place) const {
        for (const char* key : {"word", "text"})
            if (object.is_object() && object.contains(key) && object[key].is_string()) return object[key];
        throw Error(format("{}: {} has no \"word\"; write its text", file_, place));
    }

    double number_in(const Json& object, const char* key, const std::string& place) const {
        if (!object.is_object() || !object.contains(key))
            throw Error(format("{}: {} has no \"{}\"; write its time, or leave it out", file_, place, key));
        if (!object[key].is_number()) {
            throw Error(format("{}: the \"{}\" of {} is {} and no number; write its time, or leave it out",
                               file_, key, place, object[key].dump()));
        }
        return object[key].get<double>();
    }

    std::string file_;
    Json json_;
    double duration_;      // of the sound [s]
    std::string speaker_;  // of the segment that is being read
    std::size_t untimed_ = 0;
    std::set<std::size_t> pieces_;  // words that may go on with the one before
    TimedLabels labels_;
};

}  // namespace

TimedLabels read_word_json(const fs::path& file, double duration) {
    return Reader(file, duration).read();
}

std::optional<std::vector<LabelTier>> find_tiers(std::string_view text, const std::string& file) {
    if (!trim(text).starts_with('{') || text.find("\"tiers\"") == std::string_view::npos) return std::nullopt;
    const Json json = parse_json(std::string(text), file);
    if (!json.contains("tiers") || !json["tiers"].is_object()) return std::nullopt;
    std::vector<LabelTier> tiers;
    for (const auto& [name, tier] : json["tiers"].items()) {
        if (!tier.is_object() || !tier.contains("entries") || !tier["entries"].is_array()) continue;
        tiers.push_back({.name = name, .has_intervals = true, .labels = {}});
        for (const Json& entry : tier["entries"]) {
            const std::string where = format("tiers.{}.entries[{}]", name, tiers.back().labels.size());
            if (!entry.is_array() || entry.size() != 3 || !entry[0].is_number() || !entry[1].is_number() ||
                !entry[2].is_string()) {
                throw Error(format(
                    "{}: {}: is {}; a start, an end and a word are expected, such as [0.1, 0.4, \"hello\"]",
                    file, where, entry.dump(-1, ' ', true, Json::error_handler_t::replace).substr(0, 60)));
            }
            tiers.back().labels.push_back(
                {.where = where, .text = entry[2], .start = entry[0], .end = entry[1]});
        }
    }
    return tiers;
}

}  // namespace chironomia
