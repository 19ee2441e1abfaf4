#include "synth/corpus/make/speech.h"

#include <algorithm>
#include <cassert>
#include <cmath>

#include "synth/markup/markup.h"
#include "synth/speech/speak.h"

namespace chironomia {
namespace {

// Samples [begin, end) of a sound that stay, and how many were taken out before them.
struct Kept {
    std::size_t begin = 0;
    std::size_t end = 0;
    std::size_t removed = 0;
};

std::vector<Kept> kept_of(const Speech& speech, double longest) {
    const double rate = speech.audio.rate;
    const auto sample_at = [&](double time) {
        return std::min(static_cast<std::size_t>(std::llround(time * rate)), speech.audio.samples.size());
    };
    const std::vector<SpokenWord>& words = speech.words;
    std::vector<Kept> kept;
    std::size_t begin = sample_at(words.front().start), removed = begin;
    for (std::size_t w = 1; w < words.size(); ++w) {
        const double pause = words[w].start - words[w - 1].end;
        if (pause <= longest) continue;
        const double stays = longest * std::min(1.0, 0.5 + 0.5 * pause);
        const std::size_t end = sample_at(words[w - 1].end + stays / 2);
        const std::size_t next = sample_at(words[w].start - stays / 2);
        kept.push_back({begin, end, removed});
        removed += next - end;
        begin = next;
    }
    kept.push_back({begin, sample_at(words.back().end), removed});
    return kept;
}

}  // namespace

Speech say_aloud(const std::vector<Sentence>& sentences, const Voice& voice) {
    return speak(
        parse_marked_text({.text = aplm_of(sentences), .name = "grammar", .language = voice.language}),
        voice);
}

std::vector<CorpusWord> corpus_words(const Speech& speech) {
    std::vector<CorpusWord> words;
    for (const SpokenWord& word : speech.words) words.push_back({word.text, word.start, word.end});
    return words;
}

Speech in_one_breath(const Speech& speech, double longest) {
    assert(!speech.words.empty());
    const std::vector<Kept> kept = kept_of(speech, longest);
    const double rate = speech.audio.rate;
    Speech tight = speech;
    tight.audio.samples.clear();
    for (const Kept& part : kept)
        tight.audio.samples.insert(tight.audio.samples.end(),
                                   speech.audio.samples.begin() + static_cast<std::ptrdiff_t>(part.begin),
                                   speech.audio.samples.begin() + static_cast<std::ptrdiff_t>(part.end));
    const double duration = static_cast<double>(tight.audio.samples.size()) / rate;
    // What lay in a part that was taken out moves to the place where it was.
    const auto moved = [&](double time) {
        double to = 0;
        for (const Kept& part : kept) {
            if (time * rate < static_cast<double>(part.begin)) break;
            to = std::min(time, static_cast<double>(part.end) / rate) -
                 static_cast<double>(part.removed) / rate;
        }
        return std::clamp(to, 0.0, duration);
    };
    for (SpokenWord& word : tight.words) {
        word.start = moved(word.start);
        word.end = moved(word.end);
    }
    for (SpokenPhoneme& phoneme : tight.phonemes) {
        phoneme.start = moved(phoneme.start);
        phoneme.end = moved(phoneme.end);
    }
    return tight;
}

}  // namespace chironomia
