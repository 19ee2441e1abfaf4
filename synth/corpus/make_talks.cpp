#include "synth/corpus/make_talks.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <memory>

#include "core/text.h"
#include "synth/corpus/make_face.h"
#include "synth/corpus/make_jobs.h"
#include "synth/corpus/make_speech.h"
#include "synth/expressive.h"
#include "synth/features/contour.h"
#include "synth/features/pitch.h"
#include "synth/features/speech_features.h"
#include "synth/features/speech_units.h"
#include "synth/markup/functions.h"
#include "synth/markup/script_words.h"
#include "synth/markup/vocabulary.h"

namespace chironomia {
namespace {

constexpr std::size_t kFewestWords = 15, kMostWords = 40;

// How many speakers and units a corpus has.
struct TalkSize {
    std::size_t seen, unseen;
    std::size_t units, units_of_unseen;  // of each speaker
};

TalkSize size_of(CorpusSize size) {
    if (size == CorpusSize::ci) return {4, 1, 12, 6};
    if (size == CorpusSize::mini) return {10, 3, 30, 10};
    return {16, 6, 60, 20};
}

// One in five is said by everybody.
std::size_t parallel_units(const TalkSize& size) {
    return size.units / 5;
}

// A few units of one speaker about one topic.
struct Talk {
    const CorpusOrder& order;
    const Lexicon& lexicon;
    CorpusSpeaker speaker;
    std::size_t number = 0;  // of the speaker's talks; the first one says what everybody says
    std::uint64_t seed = 0;  // of how it is said
    std::size_t first_unit = 0;
    std::vector<Split> splits;  // of its units
};

// Sentences of 15 to 40 words together.
std::vector<Sentence> unit_text(std::string_view genre, std::string_view topic, const Idiolect& idiolect,
                                Random& random) {
    const SentenceWish wish{
        .genre = genre,
        .topic = topic,
        .idiolect = idiolect,
        .avoided = {"Conventional-opening", "Conventional-closing", "Yes answers", "No answers",
                    "Backchannel in question form", "Acknowledge (Backchannel)", "3rd-party-talk"}};
    const std::size_t wanted = kFewestWords + random.below(kMostWords - kFewestWords - 5);
    std::vector<Sentence> sentences;
    for (std::size_t words = 0; words < wanted;) {
        const Sentence sentence = say(bundled_grammar(), wish, random);
        if (words + sentence.words > kMostWords) continue;
        words += sentence.words;
        sentences.push_back(sentence);
    }
    return sentences;
}

std::vector<std::vector<Sentence>> text_of(const Talk& talk) {
    const bool is_parallel = talk.number == 0;
    Random random(is_parallel ? derived_seed(talk.order.seed, 2) : talk.seed, 1);
    // What everybody says is of no genre and no idiolect in particular.
    const Idiolect idiolect =
        is_parallel ? Idiolect{.seed = talk.order.seed, .temperature = 2} : talk.speaker.idiolect;
    const std::string genre = is_parallel
                                  ? genres()[random.below(static_cast<std::uint32_t>(genres().size()))]
                                  : talk.speaker.genre;
    const std::vector<std::string>& topics = bundled_grammar().topics_of.at(genre);
    const std::string& topic = topics[random.below(static_cast<std::uint32_t>(topics.size()))];
    std::vector<std::vector<Sentence>> units;
    for (std::size_t i = 0; i < talk.splits.size(); ++i)
        units.push_back(unit_text(genre, topic, idiolect, random));
    return units;
}

std::vector<CorpusWord> words_of(const Speech& speech) {
    std::vector<CorpusWord> words;
    for (const SpokenWord& word : speech.words) words.push_back({word.text, word.start, word.end});
    return words;
}

IpuRecord make_unit(const Talk& talk, const std::vector<Sentence>& text, std::uint64_t seed) {
    const Speech spoken = in_one_breath(say_aloud(text, talk.speaker.speaker.voice), kLongestPause);
    const PitchTrack pitch = find_pitch(spoken.audio);
    IpuRecord unit;
    unit.words = speech_units(words_of(spoken), talk.speaker.speaker.name).front().words;
    const auto filled = fill_pitch(pitch.f0, pitch.rate, unit.words);
    assert(filled);
    unit.f0 = *filled;
    unit.f0_strength = pitch.strength;
    unit.voice = voice_quality(spoken.audio).values;
    std::vector<std::string> texts;
    for (const CorpusWord& word : unit.words) texts.push_back(word.text);
    unit.vectors = talk.order.encode(texts);
    const Performed performed = perform(with_acts_of_voice(spoken, unit.f0), {.speaker = talk.speaker.speaker,
                                                                              .lexicon = talk.lexicon,
                                                                              .variants = {},
                                                                              .fps = IpuRecord::kFps,
                                                                              .seed = seed});
    TrackedFace face =
        track_face(*performed.motion.face, IpuRecord::kUnitNumbers, talk.order.noise, Random(seed, 9));
    unit.units = std::move(face.units);
    unit.head = std::move(face.head);
    unit.success = std::move(face.success);
    unit.confidence = std::move(face.confidence);
    return unit;
}

std::vector<CorpusEntry> make_talk(const Talk& talk) {
    constexpr double kBetween = 0.5;  // units of a talk [s]
    const std::string& name = talk.speaker.speaker.name;
    const std::vector<std::vector<Sentence>> text = text_of(talk);
    std::vector<CorpusEntry> entries;
    double start = 0;
    for (std::size_t i = 0; i < text.size(); ++i) {
        IpuRecord unit = make_unit(talk, text[i], derived_seed(talk.seed, 3, i));
        unit.id = format("{}_{:04}", name, talk.first_unit + i);
        unit.speaker = name;
        unit.source = format("{}_talk_{:02}", name, talk.number);
        unit.start = start;
        const double seconds = unit.words.back().end;
        start += seconds + kBetween;
        write_ipu(talk.order.folder, unit);
        entries.push_back({.id = unit.id, .speaker = name, .split = talk.splits[i], .seconds = seconds});
    }
    return entries;
}

// Of the units that a speaker says alone: 80 : 10 : 10.
std::vector<Split> drawn_splits(std::size_t count, Random random) {
    const std::size_t few = std::max<std::size_t>(1, (count + 5) / 10);
    std::vector<Split> splits(count, Split::train);
    for (std::size_t i = 0; i < few; ++i) {
        splits[i] = Split::validation;
        splits[few + i] = Split::test;
    }
    random.shuffle(splits);
    return splits;
}

std::vector<Split> splits_of(const CorpusSpeaker& speaker, const TalkSize& size, std::uint64_t seed) {
    if (!speaker.is_seen) return std::vector<Split>(size.units_of_unseen, Split::unseen);
    std::vector<Split> splits(parallel_units(size), Split::test);
    const std::vector<Split> own = drawn_splits(size.units - splits.size(), Random(seed, 4));
    splits.insert(splits.end(), own.begin(), own.end());
    return splits;
}

}  // namespace

Speech with_acts_of_voice(Speech speech, const std::vector<float>& f0) {
    constexpr double kSemitones = 12, kRaised = 0.4, kNodded = 1.2;
    const Vocabulary& vocabulary = Vocabulary::of(speech.language);
    for (Mark& mark : speech.marks) mark.weight = 1;
    // How high the voice goes on each word, in semitones.
    std::vector<double> heights;
    for (const SpokenWord& word : speech.words) {
        const SampleRange range = samples_in(word.start, word.end, IpuRecord::kSpeechRate);
        float highest = 50;
        for (std::size_t s = range.first; s < std::min(range.last, f0.size()); ++s)
            highest = std::max(highest, f0[s]);
        heights.push_back(kSemitones * std::log2(highest));
    }
    double mean = 0, square = 0;
    for (const double height : heights) {
        mean += height / static_cast<double>(heights.size());
        square += height * height / static_cast<double>(heights.size());
    }
    const double spread = std::max(0.5, std::sqrt(std::max(0.0, square - mean * mean)));
    for (std::size_t w = 0; w < heights.size(); ++w) {
        const double stands_out = (heights[w] - mean) / spread;
        if (stands_out < kRaised || vocabulary.is_function_word(plain_letters(speech.words[w].text)))
            continue;
        Mark mark{.kind = MarkKind::emphasis,
                  .value = stands_out < kNodded ? "medium" : "high",
                  .first_word = w,
                  .end_word = w + 1,
                  .weight = 1};
        mark.manner[Expressivity::spatial_extent] = std::clamp(stands_out - 1, -1.0, 1.0);
        speech.marks.push_back(mark);
    }
    sort_marks(speech.marks);
    return speech;
}

CorpusPlan plan_talks(const CorpusOrder& order, const Lexicon& lexicon) {
    const TalkSize size = size_of(order.size);
    CorpusPlan plan{
        .unit = "talks", .speakers = corpus_speakers(size.seen, size.unseen, order.seed), .jobs = {}};
    for (std::size_t i = 0; i < plan.speakers.size(); ++i) {
        const CorpusSpeaker& speaker = plan.speakers[i];
        const std::vector<Split> splits = splits_of(speaker, size, derived_seed(order.seed, 5, i));
        const std::size_t each = parallel_units(size);
        for (std::size_t first = 0, number = 0; first < splits.size(); first += each, ++number) {
            const std::size_t end = std::min(first + each, splits.size());
            const Talk talk{.order = order,
                            .lexicon = lexicon,
                            .speaker = speaker,
                            .number = number,
                            .seed = derived_seed(order.seed, 100 + i, number),
                            .first_unit = first,
                            .splits = {splits.begin() + static_cast<std::ptrdiff_t>(first),
                                       splits.begin() + static_cast<std::ptrdiff_t>(end)}};
            plan.jobs.push_back([talk] { return make_talk(talk); });
        }
    }
    return plan;
}

}  // namespace chironomia
