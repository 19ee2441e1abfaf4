// Intervals of one person, as PATS has them with its extension by faces and dialog acts.
#include <algorithm>
#include <cassert>
#include <utility>

#include "core/text.h"
#include "synth/corpus/make/corpus_settings.h"
#include "synth/corpus/make/jobs.h"
#include "synth/corpus/make/pose.h"
#include "synth/corpus/make/speech.h"
#include "synth/corpus/make/units.h"
#include "synth/expressive.h"
#include "synth/features/spectrum.h"
#include "synth/text/dialog_acts.h"
#include "synth/text/interval_text.h"

namespace chironomia {
namespace {

constexpr WordRange kWords{.fewest = 20, .most = 48};  // about 12 s

// The camera of a speaker.
FarCamera camera_of(std::uint64_t seed) {
    constexpr double kMostYaw = 0.26, kLeastScale = 380, kMostScale = 620;
    Random random(seed, 1);
    const double yaw = kMostYaw * (2 * random.uniform() - 1);
    return {.yaw = yaw, .scale = kLeastScale + (kMostScale - kLeastScale) * random.uniform()};
}

// The dialog act of each word.
std::vector<std::size_t> acts_of(const std::vector<Sentence>& sentences) {
    std::vector<std::size_t> acts;
    for (const Sentence& sentence : sentences) {
        const auto known = std::find(kDialogActNames.begin(), kDialogActNames.end(), sentence.dialog_act);
        acts.insert(acts.end(), sentence.words, static_cast<std::size_t>(known - kDialogActNames.begin()));
    }
    return acts;
}

// The GesturePhase of each frame: of the hand that does something, the right one first.
std::vector<int> phases_of(const Motion& motion) {
    std::vector<int> phases(motion.frames, 0);
    for (const std::string_view name : {"left phase", "right phase"}) {
        const auto track = std::find_if(motion.labels.begin(), motion.labels.end(),
                                        [&](const LabelTrack& label) { return label.name == name; });
        assert(track != motion.labels.end());
        for (std::size_t t = 0; t < phases.size(); ++t) {
            const std::string& name_in_track = track->values[static_cast<std::size_t>(track->frames[t])];
            for (int phase = 1; phase <= static_cast<int>(GesturePhase::retraction); ++phase)
                if (name_in_track == name_of(static_cast<GesturePhase>(phase))) phases[t] = phase;
        }
    }
    return phases;
}

struct Shot {
    FarCamera camera;
    std::uint64_t seed = 0;
};

// Without what is said in it.
IntervalRecord make_interval(const UnitPlan& plan, const Speech& speech, const Shot& shot) {
    const Speaker& speaker = plan.speaker.speaker;
    const Performed performed = perform(speech, {.speaker = speaker,
                                                 .lexicon = plan.lexicon,
                                                 .variants = kCorpusVariants,
                                                 .fps = IntervalRecord::kFps,
                                                 .seed = shot.seed});
    const Motion& motion = performed.motion;
    IntervalRecord interval;
    interval.speaker = speaker.name;
    PicturedPerson seen = picture_person(motion, shot.camera, plan.order.noise, Random(shot.seed, 8));
    interval.pose = std::move(seen.pose.places);
    interval.pose_normalized = std::move(seen.pose.normalized);
    interval.pose_confidence = std::move(seen.pose.confidence);
    interval.face = std::move(seen.face.places);
    interval.face_normalized = std::move(seen.face.normalized);
    interval.face_confidence = std::move(seen.face.confidence);
    IntervalSpectra spectra = interval_spectra(speech.audio);
    interval.mel_400 = std::move(spectra.mel_400);
    interval.mel_512 = std::move(spectra.mel_512);
    interval.style = style_of_corpus(speaker);
    interval.phase = phases_of(motion);
    return interval;
}

std::vector<CorpusEntry> make_intervals(const UnitPlan& plan, const FarCamera& camera) {
    const std::string& name = plan.speaker.speaker.name;
    const std::vector<std::vector<Sentence>> texts = texts_of(plan, kWords);
    std::vector<Speech> speeches;
    for (const std::vector<Sentence>& text : texts)
        speeches.push_back(say_aloud(text, plan.speaker.speaker.voice));
    Utterances utterances;
    for (const Speech& speech : speeches) utterances.push_back(texts_in(corpus_words(speech)));
    const std::vector<std::vector<float>> vectors = plan.order.encoder.vectors(utterances);
    std::vector<CorpusEntry> entries;
    for (std::size_t i = 0; i < texts.size(); ++i) {
        IntervalRecord interval =
            make_interval(plan, speeches[i], {.camera = camera, .seed = derived_seed(plan.seed, 3, i)});
        interval.words = corpus_words(speeches[i]);
        interval = with_text(std::move(interval), plan.order.encoder,
                             {.vectors = vectors[i], .acts = acts_of(texts[i])});
        interval.id = format("{}_{:04}", name, plan.first_unit + i);
        write_interval(plan.order.folder, interval);
        entries.push_back({.id = interval.id,
                           .speaker = name,
                           .split = plan.splits[i],
                           .seconds = static_cast<double>(interval.frames()) / IntervalRecord::kFps});
    }
    return entries;
}

}  // namespace

UnitCounts interval_counts(CorpusSize size) {
    if (size == CorpusSize::ci) return {4, 1, 8, 8};
    if (size == CorpusSize::mini) return {8, 3, 50, 50};
    return {16, 6, 100, 100};
}

CorpusPlan plan_intervals(const UnitOrder& order) {
    CorpusPlan plan{.unit = "stretches", .speakers = unit_speakers(order), .jobs = {}};
    for (UnitPlan& units : plan_units(order, plan.speakers)) {
        const FarCamera camera = camera_of(units.speaker.idiolect.seed);
        plan.jobs.push_back([units, camera] { return make_intervals(units, camera); });
    }
    return plan;
}

}  // namespace chironomia
