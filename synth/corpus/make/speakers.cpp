#include "synth/corpus/make/speakers.h"

#include <algorithm>
#include <cassert>
#include <cmath>

#include "core/error.h"
#include "core/hash.h"
#include "core/random.h"
#include "core/text.h"
#include "core/version.h"
#include "synth/speakers/speakers.h"

namespace chironomia {
namespace {

std::vector<std::string> names_of_unseen(std::size_t count) {
    const std::vector<std::string>&inside = speaker_names(SpeakerGroup::inside),
          &outside = speaker_names(SpeakerGroup::outside);
    std::vector<std::string> names;
    for (std::size_t i = 0; i < std::max(inside.size(), outside.size()); ++i) {
        if (i < inside.size()) names.push_back(inside[i]);
        if (i < outside.size()) names.push_back(outside[i]);
    }
    assert(count <= names.size());
    names.resize(count);
    return names;
}

// From 0.5 to 1.6; its correlation with the overall activation is about 0.2.
double temperature_of(const Speaker& speaker, Random random) {
    const double activation = speaker.manner[Expressivity::overall_activation];
    return 0.5 + 0.9 * random.uniform() + 0.2 * activation;
}

}  // namespace

std::uint64_t derived_seed(std::uint64_t seed, std::uint64_t first, std::uint64_t second) {
    Random random(seed + 0x9e3779b97f4a7c15ull * (first + 1), second);
    return (std::uint64_t{random.next()} << 32) | random.next();
}

std::vector<CorpusSpeaker> corpus_speakers(std::size_t seen, std::size_t unseen, std::uint64_t seed) {
    std::vector<std::string> names = speaker_names(SpeakerGroup::seen);
    assert(seen <= names.size());
    names.resize(seen);
    for (const std::string& name : names_of_unseen(unseen)) names.push_back(name);
    std::vector<CorpusSpeaker> speakers;
    for (std::size_t i = 0; i < names.size(); ++i) {
        const Speaker speaker = speaker_named(names[i]);
        const std::uint64_t own = derived_seed(seed, 1, i);
        speakers.push_back(
            {.speaker = speaker,
             .number = i,
             .is_seen = i < seen,
             .genre = genres()[i % genres().size()],
             .idiolect = {.seed = own, .temperature = temperature_of(speaker, Random(own, 1))}});
    }
    return speakers;
}

std::vector<CorpusSpeaker> chosen_speakers(const std::vector<CorpusSpeaker>& all,
                                           const std::vector<std::string>& names) {
    if (names.empty()) return all;
    std::vector<std::string> known, seen;
    for (const CorpusSpeaker& person : all) {
        known.push_back(person.speaker.name);
        if (person.is_seen) seen.push_back(person.speaker.name);
    }
    for (const std::string& name : names) {
        if (std::find(known.begin(), known.end(), name) == known.end())
            throw Error(
                format("speakers: nobody of this size is called \"{}\"; there are {}", name, join(known)));
    }
    std::vector<CorpusSpeaker> chosen;
    for (const CorpusSpeaker& person : all) {
        if (std::find(names.begin(), names.end(), person.speaker.name) != names.end())
            chosen.push_back(person);
    }
    if (std::none_of(chosen.begin(), chosen.end(), [](const CorpusSpeaker& each) { return each.is_seen; })) {
        throw Error(format("speakers: {} {} unseen, and models learn from seen ones alone; add one of {}",
                           join(names), names.size() == 1 ? "is" : "are", join(seen)));
    }
    return chosen;
}

std::array<float, IntervalRecord::kStyle> style_of_corpus(const Speaker& speaker) {
    std::array<float, IntervalRecord::kStyle> style{};
    const auto own = {speaker.handedness, speaker.lean,      speaker.turn,
                      speaker.height,     speaker.brow_gain, speaker.nod_gain};
    const auto to_float = [](double value) { return static_cast<float>(value); };
    const auto habits =
        std::transform(speaker.manner.values.begin(), speaker.manner.values.end(), style.begin(), to_float);
    std::transform(own.begin(), own.end(), habits, to_float);
    return style;
}

Json origin_of(const CorpusOrder& order, const std::vector<CorpusSpeaker>& speakers) {
    Json origin = {{"made", true},
                   {"version", program_version()},
                   {"size", name_of(order.size)},
                   {"seed", order.seed},
                   {"noise", order.noise}};
    if (!order.encoder.weights.empty()) origin["text_encoder_sha256"] = sha256_of_file(order.encoder.weights);
    for (const CorpusSpeaker& person : speakers) {
        const Voice& voice = person.speaker.voice;
        Json style = Json::array();
        for (const float value : style_of_corpus(person.speaker))
            style.push_back(std::round(value * 1e4) / 1e4);
        origin["speakers"][person.speaker.name] = {
            {"seen", person.is_seen},
            {"genre", person.genre},
            {"temperature", std::round(person.idiolect.temperature * 1e4) / 1e4},
            {"style", std::move(style)},
            {"voice",
             {{"language", voice.language},
              {"variant", voice.variant},
              {"pitch", voice.pitch},
              {"rate", voice.rate},
              {"range", voice.range}}}};
    }
    return origin;
}

}  // namespace chironomia
