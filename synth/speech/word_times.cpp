#include "synth/speech/word_times.h"

#include <algorithm>
#include <array>

#include "core/error.h"
#include "core/text.h"
#include "core/utf8.h"
#include "synth/speech/phonetics.h"

namespace chironomia {
namespace {

constexpr double kShortestWord = 0.01;  // [s]

// A phoneme, and the character of the text at which the synthesizer began what it is a part of.
struct Sound {
    std::size_t start = 0;  // [samples]
    std::size_t end = 0;    // [samples]
    std::size_t position = 0;
    Stress stress = Stress::none;
    std::string symbol;

    bool is_pause() const { return symbol == "_"; }
};

// Lengths, tones and the like, which the synthesizer reports as phonemes of their own.
bool is_modifier(std::string_view symbol) {
    static constexpr std::array<std::string_view, 6> kModifiers = {"ː", "ˑ", "ʲ", "ʰ", "ʷ", "\u0303"};
    return std::any_of(kModifiers.begin(), kModifiers.end(),
                       [&](std::string_view modifier) { return symbol.starts_with(modifier); });
}

// The symbol as in the IPA chart: whole characters, without espeak-ng's own additions.
std::string clean(std::string symbol) {
    if (symbol.empty()) return "_";
    if (const auto fault = fault_in_utf8(symbol)) symbol.resize(*fault);
    if (symbol.ends_with(":")) symbol.replace(symbol.size() - 1, 1, "ː");
    std::erase_if(symbol, [](char letter) { return letter == '-' || (letter >= '0' && letter <= '9'); });
    return symbol;
}

// Where the silence that ends at `sample` begins, at the earliest at `earliest`.
std::size_t start_of_silence(const std::vector<std::int16_t>& samples, std::size_t sample,
                             std::size_t earliest) {
    while (sample > earliest && samples[sample - 1] == 0) --sample;
    return sample;
}

// Ends the last sound. The synthesizer reports some phonemes (an l after its vowel) only when they are over:
// those are the last third of the sound before them.
void end_last(std::vector<Sound>& sounds, std::size_t end) {
    Sound& last = sounds.back();
    last.end = end;
    if (last.start < end) return;
    const Sound* before = sounds.size() > 1 ? &sounds[sounds.size() - 2] : nullptr;
    const std::size_t third = before == nullptr || before->is_pause() ? 0 : (before->end - before->start) / 3;
    if (last.is_pause() || third == 0) return sounds.pop_back();
    last.start = sounds[sounds.size() - 2].end = end - third;
}

// Appends a sound, unless it only modifies the last one.
void add(std::vector<Sound>& sounds, Sound sound) {
    if (sound.symbol.empty()) return;
    if (!sounds.empty()) {
        Sound& last = sounds.back();
        if (last.is_pause() && sound.is_pause()) return;
        if (!last.is_pause() && is_modifier(sound.symbol)) {
            last.symbol += sound.symbol;
            return;
        }
        end_last(sounds, sound.start);
    }
    sounds.push_back(std::move(sound));
}

std::vector<Sound> sounds_of(const SpeakReply& reply) {
    std::vector<Sound> sounds;
    std::size_t position = 0, before = 0;
    bool begins_word = false;
    for (const SpeakEvent& event : reply.events) {
        if (event.symbol.starts_with("(")) continue;  // "(fr)" before a word of another language
        const std::size_t sample = std::clamp(event.sample, before, reply.samples.size());
        const bool is_word = event.kind == SpeakEvent::Kind::word;
        if (is_word) {
            position = event.position;
        } else {
            add(sounds, {.start = begins_word ? before : start_of_silence(reply.samples, sample, before),
                         .position = position,
                         .stress = event.stress,
                         .symbol = clean(event.symbol)});
        }
        begins_word = is_word;
        before = sample;
    }
    if (!sounds.empty()) end_last(sounds, reply.samples.size());
    return sounds;
}

SpokenPhoneme phoneme_of(const Sound& sound, double rate) {
    return {.symbol = sound.symbol,
            .start = static_cast<double>(sound.start) / rate,
            .end = static_cast<double>(sound.end) / rate,
            .stress = sound.stress};
}

// The word in which, or beside which, a byte of the script lies.
std::size_t word_at(const MarkedText& text, std::size_t byte) {
    const auto next = std::find_if(text.words.begin(), text.words.end(),
                                   [&](const ScriptWord& word) { return word.end > byte; });
    const auto number = static_cast<std::size_t>(next - text.words.begin());
    if (next == text.words.end()) return number - 1;
    if (number == 0 || next->begin <= byte) return number;
    const std::string_view between = std::string_view(text.script).substr(byte, next->begin - byte);
    return between.find_first_of(" \t\r\n") == std::string_view::npos ? number : number - 1;
}

// The phonemes [first, end) of a word, without pauses around them.
struct Span {
    std::size_t first = 0;
    std::size_t end = 0;

    bool empty() const { return first == end; }
};

std::vector<Span> spans_of(const MarkedText& text, const std::vector<Sound>& sounds) {
    const std::vector<std::size_t> starts = starts_of_characters(text.script);
    std::vector<Span> spans(text.words.size());
    std::size_t word = 0;
    for (std::size_t i = 0; i < sounds.size(); ++i) {
        // The synthesizer may point back into an abbreviation, but it never speaks backwards.
        word = std::max(word, word_at(text, starts[std::min(sounds[i].position, starts.size() - 1)]));
        if (sounds[i].is_pause()) continue;
        if (spans[word].empty()) spans[word].first = i;
        spans[word].end = i + 1;
    }
    return spans;
}

// Whether two symbols are of one phoneme; lengths and tones may be missing in one of them.
bool is_same(std::string_view a, std::string_view b) {
    return a.starts_with(b) || b.starts_with(a);
}

// Cost of a substitution in the edit distance; a deletion or an insertion costs 1.
double cost_of(std::string_view a, std::string_view b) {
    if (is_same(a, b)) return 0;
    return is_vowel(a) == is_vowel(b) ? 0.7 : 1.9;
}

using Symbols = std::vector<std::string_view>;

// Edit distances of every beginning of `heard` (rows) from every beginning of `expected` (columns).
class Distances {
  public:
    Distances(const Symbols& heard, const Symbols& expected)
        : heard_(heard), expected_(expected), cells_((heard.size() + 1) * (expected.size() + 1)) {
        for (std::size_t i = 0; i <= heard.size(); ++i)
            for (std::size_t j = 0; j <= expected.size(); ++j) at(i, j) = least(i, j);
    }

    double last() const { return cells_.back(); }

    // For each number of expected phonemes, how many of the heard ones they are.
    std::vector<std::size_t> heard_for() const {
        std::vector<std::size_t> counts(expected_.size() + 1);
        std::size_t i = heard_.size(), j = expected_.size();
        counts[j] = i;
        while (j > 0) {
            if (i > 0 && at(i, j) == at(i - 1, j - 1) + cost_of(heard_[i - 1], expected_[j - 1])) {
                counts[--j] = --i;
            } else if (i > 0 && at(i, j) == at(i - 1, j) + 1) {
                --i;
            } else {
                counts[--j] = i;
            }
        }
        return counts;
    }

  private:
    double least(std::size_t i, std::size_t j) const {
        if (i == 0 || j == 0) return static_cast<double>(i + j);
        return std::min({at(i - 1, j - 1) + cost_of(heard_[i - 1], expected_[j - 1]), at(i - 1, j) + 1,
                         at(i, j - 1) + 1});
    }
    double& at(std::size_t i, std::size_t j) { return cells_[i * (expected_.size() + 1) + j]; }
    double at(std::size_t i, std::size_t j) const { return cells_[i * (expected_.size() + 1) + j]; }

    const Symbols& heard_;
    const Symbols& expected_;
    std::vector<double> cells_;
};

// The phonemes of a stretch, without its pauses, and where each lies among all.
struct Heard {
    Symbols symbols;
    std::vector<std::size_t> places;
};

Heard heard_in(const std::vector<Sound>& sounds, const Span& span) {
    Heard heard;
    for (std::size_t i = span.first; i < span.end; ++i) {
        if (sounds[i].is_pause()) continue;
        heard.symbols.push_back(sounds[i].symbol);
        heard.places.push_back(i);
    }
    return heard;
}

// Whether the phonemes reported for a word in context are those of the word said alone, or nearly so.
bool is_as_alone(const std::vector<std::string>& alone, const std::vector<Sound>& sounds, const Span& span) {
    const Symbols expected(alone.begin(), alone.end());
    const Heard heard = heard_in(sounds, span);
    const std::size_t length = std::max(heard.symbols.size(), expected.size());
    return Distances(heard.symbols, expected).last() <= 0.4 * static_cast<double>(length);
}

// Which words may have phonemes of their neighbours: those without phonemes, the words before them (at the
// beginning the words after them), and those that have other phonemes when said alone.
std::vector<bool> doubts_of(const std::vector<Span>& spans, const std::vector<Sound>& sounds,
                            const std::vector<std::vector<std::string>>& alone) {
    std::vector<bool> doubts(spans.size());
    bool is_after_none = !spans.empty() && spans[0].empty();
    for (std::size_t i = 0; i < spans.size(); ++i) {
        const bool is_before_none = i + 1 < spans.size() && spans[i + 1].empty();
        doubts[i] =
            spans[i].empty() || is_after_none || is_before_none || !is_as_alone(alone[i], sounds, spans[i]);
        is_after_none = is_after_none && spans[i].empty();
    }
    return doubts;
}

// Divides the phonemes of the words in `run` again, by the phonemes of each word said alone.
void divide_phonemes(std::vector<Span>& spans, const Span& run, const std::vector<Sound>& sounds,
                     const std::vector<std::vector<std::string>>& alone) {
    Span all{.first = sounds.size(), .end = 0};
    Symbols expected;
    std::vector<std::size_t> borders = {0};
    for (std::size_t i = run.first; i < run.end; ++i) {
        if (!spans[i].empty()) all = {std::min(all.first, spans[i].first), std::max(all.end, spans[i].end)};
        expected.insert(expected.end(), alone[i].begin(), alone[i].end());
        borders.push_back(expected.size());
    }
    const Heard heard = heard_in(sounds, all);
    const std::vector<std::size_t> counts = Distances(heard.symbols, expected).heard_for();
    std::size_t taken = 0;
    for (std::size_t i = run.first; i < run.end; ++i) {
        const bool is_last = i + 1 == run.end;
        const std::size_t border = is_last ? heard.places.size() : counts[borders[i + 1 - run.first]];
        spans[i] = border == taken ? Span{} : Span{heard.places[taken], heard.places[border - 1] + 1};
        taken = border;
    }
}

// Divides each run of doubtful words again; the length of a run is limited because its table of distances is square.
void redo_doubtful_words(std::vector<Span>& spans, const std::vector<Sound>& sounds,
                         const std::vector<std::vector<std::string>>& alone) {
    constexpr std::size_t kLongestRun = 100;  // words
    const std::vector<bool> doubts = doubts_of(spans, sounds, alone);
    for (std::size_t first = 0; first < spans.size();) {
        std::size_t end = first;
        while (end < spans.size() && doubts[end] && (end - first < kLongestRun || spans[end].empty())) ++end;
        if (end > first + 1) divide_phonemes(spans, {.first = first, .end = end}, sounds, alone);
        first = std::max(end, first + 1);
    }
}

void set_phonemes(std::vector<SpokenWord>& words, const std::vector<Span>& spans,
                  const std::vector<SpokenPhoneme>& phonemes) {
    for (std::size_t i = 0; i < words.size(); ++i) {
        if (spans[i].empty()) continue;
        words[i].first_phoneme = spans[i].first;
        words[i].end_phoneme = spans[i].end;
        words[i].start = phonemes[spans[i].first].start;
        words[i].end = phonemes[spans[i].end - 1].end;
    }
}

// Words [first, end) that are not spoken take a little of the time of the word before them, or at the beginning
// of the word after them.
void give_time(Speech& speech, std::size_t first, std::size_t end) {
    const bool is_behind = first == 0;
    SpokenWord& giver = speech.words[is_behind ? end : first - 1];
    const double time = kShortestWord * static_cast<double>(end - first);
    if (giver.end - giver.start < time + kShortestWord) {
        throw Error(
            format("espeak-ng: \"{}\" (word {} of {}) is not spoken in \"{}\", and \"{}\" beside it is too "
                   "short to share its {:.0f} ms; write it as it is spoken, or leave it out",
                   speech.words[first].text, first + 1, speech.words.size(), speech.language, giver.text,
                   (giver.end - giver.start) * 1000));
    }
    double start = is_behind ? giver.start : giver.end - time;
    (is_behind ? giver.start : giver.end) += is_behind ? time : -time;
    for (std::size_t i = first; i < end; ++i) {
        SpokenWord& word = speech.words[i];
        word.start = start;
        word.end = start += kShortestWord;
        word.first_phoneme = word.end_phoneme = is_behind ? giver.first_phoneme : giver.end_phoneme;
    }
}

void give_time_to_the_silent(Speech& speech, const std::vector<Span>& spans) {
    for (std::size_t first = 0; first < spans.size(); ++first) {
        if (!spans[first].empty()) continue;
        std::size_t end = first;
        while (end < spans.size() && spans[end].empty()) ++end;
        give_time(speech, first, end);
        first = end;
    }
}

}  // namespace

Audio sound_of(const SpeakReply& reply) {
    Audio sound{.rate = reply.rate, .channels = 1, .samples = {}};
    sound.samples.reserve(reply.samples.size());
    for (const std::int16_t sample : reply.samples)
        sound.samples.push_back(static_cast<float>(sample) / 32768);
    return sound;
}

Speech time_words(const MarkedText& text, const SpeakReply& reply, const std::string& language) {
    const std::vector<Sound> sounds = sounds_of(reply);
    Speech speech{.audio = sound_of(reply), .language = language, .marks = text.marks};
    for (const Sound& sound : sounds) speech.phonemes.push_back(phoneme_of(sound, reply.rate));
    for (const ScriptWord& word : text.words) speech.words.push_back({.text = word.text});
    std::vector<Span> spans = spans_of(text, sounds);
    redo_doubtful_words(spans, sounds, reply.alone);
    set_phonemes(speech.words, spans, speech.phonemes);
    give_time_to_the_silent(speech, spans);
    return speech;
}

}  // namespace chironomia
