#include "synth/speech/timed_words.h"

#include <algorithm>
#include <cstddef>
#include <optional>
#include <set>
#include <utility>

#include "core/error.h"
#include "core/files/files.h"
#include "core/text.h"
#include "core/utf8.h"
#include "synth/markup/letters.h"
#include "synth/markup/script_words.h"
#include "synth/speech/captions.h"
#include "synth/speech/elan.h"
#include "synth/speech/phonetics.h"
#include "synth/speech/textgrid.h"
#include "synth/speech/word_json.h"
#include "synth/speech/word_table.h"
#include "synth/speech/word_text.h"
#include "synth/speech/xsampa.h"

namespace chironomia {
namespace {

namespace fs = std::filesystem;

constexpr double kBridgedOverlap = 0.05;  // [s]
constexpr double kBridgedEnd = 0.1;       // [s]
constexpr double kLongestFilling = 0.05;  // [s] of a word without length

// The text of a file as UTF-8.
std::string read_any_utf(const fs::path& file) {
    std::string bytes = read_text(file);
    const bool is_little = bytes.starts_with("\xff\xfe"), is_big = bytes.starts_with("\xfe\xff");
    if (is_little || is_big) {
        auto text = utf8_from_utf16(std::string_view(bytes).substr(2), is_big);
        if (!text) throw Error(format("{}: its UTF-16 is broken; save it as UTF-8", file.string()));
        return std::move(*text);
    }
    if (const auto fault = fault_in_utf8(bytes))
        throw Error(format("{}: byte {} is not UTF-8; save it as UTF-8", file.string(), *fault + 1));
    return bytes;
}

// Keeps the words of one speaker, or refuses those of a second one.
void keep_speaker(std::vector<TimedLabel>& words, std::string_view speaker, const std::string& file) {
    if (!speaker.empty()) {
        std::set<std::string> names;
        for (const TimedLabel& word : words)
            if (!word.speaker.empty()) names.insert(word.speaker);
        std::erase_if(words, [&](const TimedLabel& word) { return word.speaker != speaker; });
        if (!words.empty()) return;
        throw Error(format("{}: nothing in it is said by \"{}\"; {}", file, speaker,
                           names.empty() ? "it names no speakers, leave --words-speaker out"
                                         : "it names " + join({names.begin(), names.end()})));
    }
    std::string before;
    for (const TimedLabel& word : words) {
        if (word.speaker.empty()) continue;
        if (!before.empty() && word.speaker != before) {
            throw Error(format(
                "{}: {} is said by \"{}\", what is before it by \"{}\"; keep the words of one speaker, or "
                "choose one by --words-speaker",
                file, word.where, word.speaker, before));
        }
        before = word.speaker;
    }
}

TimedLabels read_labels(const fs::path& file, std::string_view text, double duration) {
    const std::string name = file.string();
    const std::string_view content = trim(text);
    if (content.starts_with('[') || content.starts_with('{')) return read_word_json(file, duration);
    if (are_captions(content)) return read_captions(text, name);
    if (is_label_file(content)) return read_label_file(text);
    if (is_ctm(content)) return read_ctm(text, name);
    return read_word_table(text, name);
}

TimedLabels read_labels(const fs::path& file, double duration, std::string_view speaker) {
    const std::string text = read_any_utf(file);
    const std::string name = file.string();
    if (is_textgrid(trim(text))) return read_textgrid(text, name, speaker);
    if (is_elan(trim(text))) return read_elan(text, name, speaker);
    if (const auto tiers = find_tiers(text, name)) return labels_of_tiers(*tiers, name, speaker);
    TimedLabels labels = read_labels(file, text, duration);
    keep_speaker(labels.words, speaker, name);
    return labels;
}

// As aligners mark what is not said.
bool is_silence(const TimedLabel& label) {
    static constexpr std::string_view kSilences[] = {
        "",    "sil",  "sp",   "spn",  "<eps>", "<sil>", "<p>",   "<p:>", "<nib>", "#",
        "pau", "ssil", "!sil", "{sl}", "!null", "h#",    "[sil]", "<s>",  "</s>"};
    const std::string text = to_lower(trim(label.text));
    return std::ranges::find(kSilences, text) != std::end(kSilences);
}

// "[noise]", "<VOCNOISE>", "{LG}", "(laughs)", and "xxx" of CHAT. Several words in round brackets may be said.
bool is_event(const TimedLabel& label) {
    const std::string_view text = trim(label.text);
    if (text == "xxx") return true;
    if (text.size() < 2) return false;
    const auto lies_in = [&](char opening, char closing) {
        return text.front() == opening && text.back() == closing && text.find(closing) == text.size() - 1;
    };
    if (lies_in('(', ')')) return text.find_first_of(" \t") == std::string_view::npos;
    return lies_in('[', ']') || lies_in('<', '>') || lies_in('{', '}');
}

void leave_events_out(TimedLabels& labels, const std::string& file) {
    std::erase_if(labels.words, is_silence);
    const auto first = std::ranges::find_if(labels.words, is_event);
    if (first == labels.words.end()) return;
    const std::string shown = format("{}: \"{}\"", first->where, trim(first->text));
    const auto count = std::erase_if(labels.words, is_event);
    labels.notes.push_back(
        format("{}: {} labels name sounds that are no words, and were left out; the first is {}", file, count,
               shown));
}

struct WordFile {
    std::string file;
    double duration = 0;  // of the sound [s]
};

// Checks the times of labels that should follow one another, and corrects small overlaps.
class Times {
  public:
    Times(const WordFile& place, const char* noun) : place_(place), noun_(noun) {}

    std::vector<TimedLabel> settle(std::vector<TimedLabel> labels) {
        for (std::size_t i = 0; i < labels.size(); ++i) {
            refuse_wrong_times(labels[i]);
            if (i > 0) part(labels[i - 1], labels[i]);
            if (labels[i].end > place_.duration) end_with_sound(labels[i]);
        }
        for (std::size_t i = 0; i < labels.size(); ++i) {
            const double next = i + 1 < labels.size() ? labels[i + 1].start : place_.duration;
            if (labels[i].end <= labels[i].start) fill(labels[i], next);
        }
        return labels;
    }

    std::vector<std::string> notes() const {
        std::vector<std::string> notes;
        note(notes, overlaps_, "overlapped the next one by up to 50 ms and were cut");
        note(notes, late_, "ended up to 100 ms behind the sound and were cut");
        note(notes, empty_, "had no length and last to the next one, at most 50 ms");
        return notes;
    }

  private:
    [[noreturn]] void refuse(const TimedLabel& label, const std::string& fault) const {
        throw Error(format("{}: {}: \"{}\" {}", place_.file, label.where, trim(label.text), fault));
    }

    void refuse_wrong_times(const TimedLabel& label) const {
        constexpr double kLongest = 1e9;  // [s], 30 years
        if (!(label.start >= 0))
            refuse(label, format("starts at {:.3f} s; write a time from 0 on", label.start));
        if (!(label.end <= kLongest))
            refuse(label, format("ends at {:.3g} s; write a time of up to {:g} s", label.end, kLongest));
        if (!(label.end >= label.start)) {
            refuse(label, format("ends at {:.3f} s, before it starts at {:.3f} s; correct its times",
                                 label.end, label.start));
        }
        if (label.start >= place_.duration || label.end > place_.duration + kBridgedEnd) {
            const bool fit_as_milliseconds = label.end / 1000 <= place_.duration && label.start >= 100;
            refuse(label,
                   format("lies from {:.3f} to {:.3f} s, and the sound ends at {:.3f} s; give the words of "
                          "this sound{}",
                          label.start, label.end, place_.duration,
                          fit_as_milliseconds ? ", in seconds; are these milliseconds?" : ""));
        }
    }

    void part(TimedLabel& before, const TimedLabel& label) {
        if (label.start >= before.end) return;
        if (before.end - label.start > kBridgedOverlap || label.start < before.start) {
            refuse(
                label,
                format("starts at {:.3f} s, before \"{}\" ({}) ends at {:.3f} s; write one voice, in order",
                       label.start, trim(before.text), before.where, before.end));
        }
        before.end = label.start;
        ++overlaps_;
    }

    void end_with_sound(TimedLabel& label) {
        label.end = place_.duration;
        ++late_;
    }

    void fill(TimedLabel& label, double next) {
        label.end = std::min(next, label.start + kLongestFilling);
        if (label.end <= label.start) {
            refuse(label, format("starts and ends at {:.3f} s, where the next one starts; give it a length",
                                 label.start));
        }
        ++empty_;
    }

    void note(std::vector<std::string>& notes, int count, const char* what) const {
        if (count > 0) notes.push_back(format("{}: {} {} {}", place_.file, count, noun_, what));
    }

    WordFile place_;
    const char* noun_;
    int overlaps_ = 0, late_ = 0, empty_ = 0;
};

// Adds the words of a label, whose times are shared by letters. Returns how many they are.
std::size_t add_words(TimedWords& timed, const TimedLabel& label) {
    std::vector<std::string> texts;
    for (const std::string_view part : split_words(label.text)) {
        const std::string_view word = without_punctuation(part);
        if (!word.empty()) {
            texts.emplace_back(word);
            timed.written.emplace_back(part);
        } else if (!timed.written.empty() && ends_sentence(part)) {
            timed.written.back() += part;  // a sentence's end belongs to the word before
        }
    }
    const std::vector<double> shares = shares_of_letters(texts);
    for (std::size_t i = 0; i < texts.size(); ++i) {
        timed.words.push_back({.text = texts[i],
                               .start = label.start + shares[i] * (label.end - label.start),
                               .end = label.start + shares[i + 1] * (label.end - label.start)});
    }
    return texts.size();
}

// How a tier writes its phonemes.
enum class Notation { ipa, arpabet, xsampa };

Notation notation_of(const std::vector<TimedLabel>& labels) {
    const bool is_arpabet = std::ranges::all_of(labels, [](const TimedLabel& label) {
        return is_bracketed(label.text) || read_arpabet(label.text).has_value();
    });
    if (is_arpabet) return Notation::arpabet;
    std::vector<std::string> texts;
    for (const TimedLabel& label : labels) texts.push_back(label.text);
    return are_xsampa(texts) ? Notation::xsampa : Notation::ipa;
}

PhoneLabel read_phone(const std::string& label, Notation notation) {
    if (notation == Notation::xsampa) return read_xsampa(label);
    const auto arpabet = notation == Notation::arpabet ? read_arpabet(label) : std::nullopt;
    return arpabet ? *arpabet : read_ipa(label);
}

std::vector<SpokenPhoneme> phonemes_of(const std::vector<TimedLabel>& labels) {
    const Notation notation = notation_of(labels);
    std::vector<SpokenPhoneme> phonemes;
    Stress waiting = Stress::none;  // of a mark before the consonants of a syllable
    for (const TimedLabel& label : labels) {
        const PhoneLabel phone = read_phone(label.text, notation);
        if (phone.stress != Stress::none) waiting = phone.stress;
        const bool carries = is_vowel(phone.symbol);
        const bool is_pause = phone.symbol == "_" && !phonemes.empty() && phonemes.back().symbol == "_";
        if (is_pause && phonemes.back().end == label.start) {
            phonemes.back().end = label.end;
            continue;
        }
        phonemes.push_back({.symbol = phone.symbol,
                            .start = label.start,
                            .end = label.end,
                            .stress = carries ? waiting : Stress::none});
        if (carries) waiting = Stress::none;
    }
    return phonemes;
}

}  // namespace

std::vector<SpokenWord> with_phonemes(std::vector<SpokenWord> words,
                                      const std::vector<SpokenPhoneme>& phonemes) {
    std::size_t next = 0;
    const auto middle = [&](std::size_t i) { return (phonemes[i].start + phonemes[i].end) / 2; };
    for (SpokenWord& word : words) {
        while (next < phonemes.size() && middle(next) < word.start) ++next;
        word.first_phoneme = next;
        while (next < phonemes.size() && middle(next) < word.end) ++next;
        word.end_phoneme = next;
    }
    return words;
}

TimedWords read_timed_words(const fs::path& file, double duration, std::string_view speaker) {
    TimedLabels labels = read_labels(file, duration, speaker);
    for (TimedLabel& word : labels.words) word.text = composed(word.text);  // as texts are
    leave_events_out(labels, file.string());
    const WordFile place{.file = file.string(), .duration = duration};
    Times word_times(place, "words"), phone_times(place, "phonemes");
    TimedWords timed;
    int spread = 0;
    for (const TimedLabel& label : word_times.settle(labels.words))
        spread += add_words(timed, label) > 1 ? 1 : 0;
    timed.phonemes = phonemes_of(phone_times.settle(labels.phones));
    if (timed.words.empty() && timed.phonemes.empty())
        throw Error(format("{}: it holds no word; give a file of words in time", place.file));
    timed.words = with_phonemes(std::move(timed.words), timed.phonemes);
    timed.language = labels.language;
    timed.notes = labels.notes;
    for (const Times* times : {&word_times, &phone_times})
        for (const std::string& note : times->notes()) timed.notes.push_back(note);
    if (spread > 0) {
        timed.notes.push_back(
            format("{}: {} stretches hold several words, whose times were spread by their letters",
                   place.file, spread));
    }
    return timed;
}

}  // namespace chironomia
