#include "synth/speech/word_json.h"

#include <algorithm>
#include <string>

#include "core/error.h"
#include "core/files/json.h"
#include "core/text.h"

namespace chironomia {
namespace {

namespace fs = std::filesystem;

class Reader {
  public:
    explicit Reader(const fs::path& file) : file_(file.string()), json_(read_json(file)) {}

    TimedLabels read() {
        if (json_.is_array()) {
            read_words(json_, "");
        } else if (has_list(json_, "segments")) {
            read_segments(json_["segments"]);
        } else if (has_list(json_, "words")) {
            read_words(json_["words"], "words");
        } else if (has_list(json_, "word_segments")) {
            read_words(json_["word_segments"], "word_segments");
        } else if (has_list(json_, "transcription")) {
            read_transcription(json_["transcription"]);
        } else {
            throw Error(
                format("{}: it holds no list of words, \"words\", \"segments\" or \"transcription\"; write "
                       "[{{\"word\": \"hello\", \"start\": 0.1, \"end\": 0.4}}]",
                       file_));
        }
        return std::move(labels_);
    }

  private:
    static bool has_list(const Json& object, const char* key) {
        return object.is_object() && object.contains(key) && object[key].is_array();
    }

    void read_segments(const Json& segments) {
        for (std::size_t i = 0; i < segments.size(); ++i) {
            const std::string place = format("segments[{}]", i);
            if (has_list(segments[i], "words")) {
                read_words(with_all_times(segments[i]), place + ".words");
            } else {
                read_word(segments[i], place);
            }
        }
    }

    static bool has_number(const Json& object, const char* key) {
        return object.is_object() && object.contains(key) && object[key].is_number();
    }

    // WhisperX gives no times to numbers and other words that it cannot align. Such words share the time between
    // their neighbours, or to the ends of their segment.
    static Json with_all_times(const Json& segment) {
        Json words = segment["words"];
        if (!has_number(segment, "start") || !has_number(segment, "end")) return words;
        const auto is_timed = [](const Json& word) {
            return has_number(word, "start") && has_number(word, "end");
        };
        const auto is_untimed = [](const Json& word) {
            return word.is_object() && !word.contains("start") && !word.contains("end");
        };
        double from = segment["start"];
        for (std::size_t first = 0; first < words.size(); ++first) {
            if (is_timed(words[first])) from = words[first]["end"];
            std::size_t last = first;
            while (last < words.size() && is_untimed(words[last])) ++last;
            if (last == first) continue;
            const bool has_next = last < words.size() && is_timed(words[last]);
            const double to =
                std::max(from, has_next ? words[last]["start"].get<double>() : segment["end"].get<double>());
            const double each = (to - from) / static_cast<double>(last - first);
            for (std::size_t i = first; i < last; ++i, from += each) {
                words[i]["start"] = from;
                words[i]["end"] = from + each;
            }
            first = last - 1;
        }
        return words;
    }

    void read_words(const Json& words, const std::string& place) {
        for (std::size_t i = 0; i < words.size(); ++i) read_word(words[i], format("{}[{}]", place, i));
    }

    void read_transcription(const Json& parts) {
        for (std::size_t i = 0; i < parts.size(); ++i) {
            const std::string place = format("transcription[{}]", i);
            if (!parts[i].is_object() || !parts[i].contains("offsets"))
                throw Error(format("{}: {} has no \"offsets\"; write it again", file_, place));
            const Json& offsets = parts[i]["offsets"];
            const std::string text = text_in(parts[i], place);
            const double end = number_in(offsets, "to", place + ".offsets") / 1000;
            // Pieces of words: a space begins a new one.
            if (i > 0 && !labels_.words.empty() && !text.empty() && text[0] != ' ') {
                labels_.words.back().text += text;
                labels_.words.back().end = end;
                continue;
            }
            labels_.words.push_back({.where = place,
                                     .text = text,
                                     .start = number_in(offsets, "from", place + ".offsets") / 1000,
                                     .end = end});
        }
    }

    void read_word(const Json& word, const std::string& place) {
        labels_.words.push_back({.where = place,
                                 .text = text_in(word, place),
                                 .start = number_in(word, "start", place),
                                 .end = number_in(word, "end", place)});
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
    TimedLabels labels_;
};

}  // namespace

TimedLabels read_word_json(const fs::path& file) {
    return Reader(file).read();
}

}  // namespace chironomia
