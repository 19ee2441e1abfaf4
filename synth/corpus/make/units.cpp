#include "synth/corpus/make/units.h"

#include <algorithm>
#include <cassert>

namespace chironomia {
namespace {

std::vector<Sentence> unit_text(const SentenceRequest& request, const WordRange& range, Random& random) {
    // Leaves room for the last sentence.
    constexpr std::size_t kRoom = 5;
    const std::size_t wanted =
        range.fewest + random.below(static_cast<std::uint32_t>(range.most - range.fewest - kRoom));
    std::vector<Sentence> sentences;
    for (std::size_t words = 0; words < wanted;) {
        Sentence sentence = say(bundled_grammar(), request, random);
        if (words + sentence.words > range.most) continue;
        if (sentence.dialog_act == "Conventional-opening" && words > 0) continue;
        if (sentence.dialog_act == "Conventional-closing" && words + sentence.words < wanted) continue;
        words += sentence.words;
        sentences.push_back(std::move(sentence));
    }
    return sentences;
}

const std::string& one_of(const std::vector<std::string>& names, Random& random) {
    return names[random.below(static_cast<std::uint32_t>(names.size()))];
}

// In talks nobody answers, and a unit is neither the first nor the last of a talk. Intervals may be anything
// that is said in a show; models read which acts they are.
std::vector<std::string_view> avoided_in(CorpusKind kind) {
    if (kind == CorpusKind::intervals) return {};
    return {"Conventional-opening",         "Conventional-closing",      "Yes answers",    "No answers",
            "Backchannel in question form", "Acknowledge (Backchannel)", "3rd-party-talk", "Other"};
}

std::vector<Split> splits_of(const CorpusSpeaker& speaker, const UnitCounts& counts, Random random) {
    if (!speaker.is_seen) return std::vector<Split>(counts.of_unseen, Split::unseen);
    const std::size_t count = counts.of_seen - counts.shared();
    const std::size_t few = std::max<std::size_t>(1, (count + 5) / 10);
    assert(count > 2 * few);
    std::vector<Split> own(count, Split::train);
    std::fill_n(own.begin(), few, Split::validation);
    std::fill_n(own.begin() + static_cast<std::ptrdiff_t>(few), few, Split::test);
    random.shuffle(own);
    std::vector<Split> splits(counts.shared(), Split::test);
    splits.insert(splits.end(), own.begin(), own.end());
    return splits;
}

}  // namespace

std::vector<CorpusSpeaker> unit_speakers(const UnitOrder& order) {
    return chosen_speakers(corpus_speakers(order.counts.seen, order.counts.unseen, order.order.seed),
                           order.order.speakers.names);
}

std::vector<UnitPlan> plan_units(const UnitOrder& order, const std::vector<CorpusSpeaker>& speakers) {
    std::vector<UnitPlan> plans;
    const std::uint64_t seed = order.order.seed;
    const std::size_t each = order.counts.shared();
    for (const CorpusSpeaker& speaker : speakers) {
        const std::vector<Split> splits =
            splits_of(speaker, order.counts, Random(derived_seed(seed, 5, speaker.number)));
        for (std::size_t first = 0, number = 0; first < splits.size(); first += each, ++number) {
            const auto begin = splits.begin() + static_cast<std::ptrdiff_t>(first);
            const auto end = begin + static_cast<std::ptrdiff_t>(std::min(each, splits.size() - first));
            plans.push_back({.order = order.order,
                             .lexicon = order.lexicon,
                             .speaker = speaker,
                             .number = number,
                             .first_unit = first,
                             .splits = {begin, end},
                             .seed = derived_seed(seed, 100 + speaker.number, number)});
        }
    }
    return plans;
}

std::vector<std::vector<Sentence>> texts_of(const UnitPlan& plan, const WordRange& range) {
    // Parallel units, which everybody says, are drawn without an idiolect.
    const bool is_parallel = plan.number == 0;
    Random random(is_parallel ? derived_seed(plan.order.seed, 2) : plan.seed, 1);
    const Idiolect common{.seed = plan.order.seed, .temperature = 2};
    const std::string genre = is_parallel ? one_of(genres(), random) : plan.speaker.genre;
    const std::string topic = one_of(bundled_grammar().topics_of.at(genre), random);
    const SentenceRequest request{.genre = genre,
                                  .topic = topic,
                                  .idiolect = is_parallel ? common : plan.speaker.idiolect,
                                  .dialog_acts = {},
                                  .avoided = avoided_in(plan.order.kind)};
    std::vector<std::vector<Sentence>> texts;
    for (std::size_t i = 0; i < plan.splits.size(); ++i) texts.push_back(unit_text(request, range, random));
    return texts;
}

}  // namespace chironomia
