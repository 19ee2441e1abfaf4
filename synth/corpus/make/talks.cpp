#include "synth/corpus/make/talks.h"

#include <algorithm>
#include <cassert>
#include <cmath>

#include "core/text.h"
#include "synth/corpus/make/corpus_settings.h"
#include "synth/corpus/make/face.h"
#include "synth/corpus/make/jobs.h"
#include "synth/corpus/make/speech.h"
#include "synth/corpus/make/tables.h"
#include "synth/corpus/make/units.h"
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

constexpr WordRange kWordsOfTalk{.fewest = 15, .most = 40};

// An act on one word; `size` from -1 to 1 makes it smaller or larger.
Mark act_on(std::size_t word, MarkKind kind, const char* value, double size) {
    Mark mark{
        .kind = kind, .value = value, .first_word = word, .end_word = word + 1, .weight = 1, .manner = {}};
    mark.manner[Expressivity::spatial_extent] = std::clamp(size, -1.0, 1.0);
    return mark;
}

// What a face adds to some meanings: wide eyes for what is big or many, narrow ones for what is small, a firm
// look for what must be.
std::vector<Mark> looks_of(const std::vector<Mark>& marks) {
    struct Look {
        MarkKind kind;
        std::string_view value;
        const char* emotion;
        double size;
    };
    constexpr Look kLooks[] = {
        {MarkKind::world, "size-big", "surprise", -0.5}, {MarkKind::world, "quantity-many", "surprise", -0.8},
        {MarkKind::world, "up", "surprise", -0.8},       {MarkKind::world, "size-small", "anger", -0.8},
        {MarkKind::emphasis, "high", "anger", -0.4},     {MarkKind::certainty, "certain", "anger", -1}};
    std::vector<Mark> shown;
    for (const Mark& mark : marks)
        for (const Look& look : kLooks)
            if (mark.kind == look.kind && mark.value == look.value)
                shown.push_back(act_on(mark.end_word - 1, MarkKind::emotion, look.emotion, look.size));
    return shown;
}

// How high the voice goes on each word, in standard deviations from the mean of all words, in semitones.
std::vector<double> heights_of(const Speech& speech, const std::vector<float>& f0) {
    constexpr double kSemitones = 12, kLeastSpread = 0.5;
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
    const double spread = std::max(kLeastSpread, std::sqrt(std::max(0.0, square - mean * mean)));
    for (double& height : heights) height = (height - mean) / spread;
    return heights;
}

// Random movements are rare in talks, so that most of a face can be predicted from the speech.
Speaker with_few_random_movements(Speaker speaker) {
    speaker.manner[Expressivity::overall_activation] *= 0.3;
    return speaker;
}

// What is said in a unit.
struct SaidUnit {
    Speech spoken;
    std::vector<CorpusWord> words;  // with the silences between them
};

SaidUnit say_unit(const UnitPlan& talk, const std::vector<Sentence>& text) {
    SaidUnit said{.spoken = in_one_breath(say_aloud(text, talk.speaker.speaker.voice), kLongestPause),
                  .words = {}};
    said.words = speech_units(corpus_words(said.spoken), talk.speaker.speaker.name).front().words;
    return said;
}

// Without its vectors of words.
IpuRecord make_unit(const UnitPlan& talk, const SaidUnit& said, const std::string& id, std::uint64_t seed) {
    const PitchTrack pitch = find_pitch(said.spoken.audio);
    FeatureTrack quality = voice_quality(said.spoken.audio);
    IpuRecord unit;
    unit.id = id;
    unit.words = said.words;
    const auto filled = fill_pitch(pitch.f0, pitch.rate, unit.words);
    assert(filled);
    unit.f0 = *filled;
    unit.f0_strength = pitch.strength;
    const Performed performed = perform(with_acts_of_voice(said.spoken, unit.f0),
                                        {.speaker = with_few_random_movements(talk.speaker.speaker),
                                         .lexicon = talk.lexicon,
                                         .variants = kCorpusVariants,
                                         .fps = IpuRecord::kFps,
                                         .seed = seed});
    TrackedFace face =
        track_face(*performed.motion.face, IpuRecord::kUnitNumbers, talk.order.noise, Random(seed, 9));
    if (talk.order.tables) {
        write_tables(talk.order.folder, id,
                     {.face = face,
                      .units = IpuRecord::kUnitNumbers,
                      .fps = IpuRecord::kFps,
                      .speech = speech_features(said.spoken.audio),
                      .sound = said.spoken.audio});
        write_talk_tables(talk.order.folder, id, quality, unit.words);
    }
    if (talk.order.noise) face = cleaned(std::move(face));
    unit.voice = std::move(quality.values);
    unit.units = std::move(face.units);
    unit.head = std::move(face.head);
    unit.success = std::move(face.success);
    unit.confidence = std::move(face.confidence);
    return unit;
}

std::vector<CorpusEntry> make_talk(const UnitPlan& talk) {
    constexpr double kBetween = 0.5;  // units of a talk [s]
    const std::string& name = talk.speaker.speaker.name;
    std::vector<SaidUnit> said;
    for (const std::vector<Sentence>& text : texts_of(talk, kWordsOfTalk))
        said.push_back(say_unit(talk, text));
    Utterances utterances;
    for (const SaidUnit& unit : said) utterances.push_back(texts_in(unit.words));
    std::vector<std::vector<float>> vectors = talk.order.encoder.vectors(utterances);
    std::vector<CorpusEntry> entries;
    double start = 0;
    for (std::size_t i = 0; i < said.size(); ++i) {
        IpuRecord unit = make_unit(talk, said[i], format("{}_{:04}", name, talk.first_unit + i),
                                   derived_seed(talk.seed, 3, i));
        unit.speaker = name;
        unit.source = format("{}_talk_{:02}", name, talk.number);
        unit.start = start;
        unit.vectors = std::move(vectors[i]);
        const double seconds = unit.words.back().end;
        start += seconds + kBetween;
        write_ipu(talk.order.folder, unit);
        entries.push_back({.id = unit.id, .speaker = name, .split = talk.splits[i], .seconds = seconds});
    }
    return entries;
}

}  // namespace

Speech with_acts_of_voice(Speech speech, const std::vector<float>& f0) {
    constexpr double kRaised = 0.8, kNodded = 1.4, kFrowned = -1.1;  // standard deviations of the pitch
    const Vocabulary& vocabulary = Vocabulary::of(speech.language);
    for (Mark& mark : speech.marks) mark.weight = 1;
    std::vector<Mark> shown = looks_of(speech.marks);
    const std::vector<double> heights = heights_of(speech, f0);
    for (std::size_t w = 0; w < heights.size(); ++w) {
        if (vocabulary.is_function_word(plain_letters(speech.words[w].text))) continue;
        if (heights[w] > kRaised)
            shown.push_back(
                act_on(w, MarkKind::emphasis, heights[w] < kNodded ? "medium" : "high", heights[w] - 1.4));
        else if (heights[w] < kFrowned)
            shown.push_back(act_on(w, MarkKind::belief_relation, "contrast", -heights[w] - 2));
    }
    speech.marks.insert(speech.marks.end(), shown.begin(), shown.end());
    sort_marks(speech.marks);
    return speech;
}

UnitCounts talk_counts(CorpusSize size) {
    if (size == CorpusSize::ci) return {4, 1, 12, 6};
    if (size == CorpusSize::mini) return {10, 3, 30, 10};
    return {16, 6, 60, 20};
}

CorpusPlan plan_talks(const UnitOrder& order) {
    CorpusPlan plan{.unit = "talks", .speakers = unit_speakers(order), .jobs = {}};
    for (UnitPlan& units : plan_units(order, plan.speakers))
        plan.jobs.push_back([units] { return make_talk(units); });
    return plan;
}

}  // namespace chironomia
