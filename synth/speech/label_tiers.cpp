#include "synth/speech/label_tiers.h"

#include <algorithm>
#include <initializer_list>
#include <string_view>

#include "core/error.h"
#include "core/text.h"

namespace chironomia {
namespace {

bool is_named(const LabelTier& tier, std::initializer_list<std::string_view> names) {
    const std::string name = to_lower(trim(tier.name));
    return tier.has_intervals && std::any_of(names.begin(), names.end(), [&](std::string_view wanted) {
               return name == wanted || name.ends_with(" - " + std::string(wanted)) ||
                      name.starts_with(std::string(wanted) + "@");
           });
}

std::string names_of(const std::vector<LabelTier>& tiers) {
    std::vector<std::string> names;
    for (const LabelTier& tier : tiers) names.push_back("\"" + tier.name + "\"");
    return join(names);
}

// The tier that has one of these names; nothing if none has.
const LabelTier* find_tier(const std::vector<LabelTier>& tiers, std::initializer_list<std::string_view> names,
                           const std::string& file) {
    std::vector<const LabelTier*> found;
    for (const LabelTier& tier : tiers)
        if (is_named(tier, names)) found.push_back(&tier);
    if (found.size() > 1) {
        throw Error(format(
            "{}: the tiers \"{}\" and \"{}\" are both named as {}; keep those of one speaker, or choose one by --words-speaker",
            file, found[0]->name, found[1]->name, *names.begin()));
    }
    return found.empty() ? nullptr : found[0];
}

std::vector<LabelTier> tiers_of(const std::vector<LabelTier>& tiers, std::string_view speaker,
                                const std::string& file) {
    const std::string name(speaker);
    std::vector<LabelTier> kept;
    for (const LabelTier& tier : tiers) {
        const std::string_view whole = trim(tier.name);
        if (whole == name || whole.starts_with(name + " - ") || whole.ends_with("@" + name))
            kept.push_back(tier);
    }
    if (kept.empty())
        throw Error(
            format("{}: none of its tiers is of \"{}\"; they are {}", file, speaker, names_of(tiers)));
    return kept;
}

}  // namespace

TimedLabels labels_of_tiers(const std::vector<LabelTier>& all, const std::string& file,
                            std::string_view speaker) {
    const std::vector<LabelTier> tiers = speaker.empty() ? all : tiers_of(all, speaker, file);
    const LabelTier* words = find_tier(tiers, {"words", "word", "ort-mau"}, file);
    const LabelTier* phones =
        find_tier(tiers, {"phones", "phone", "phonemes", "phoneme", "segments", "mau"}, file);
    const LabelTier* only = nullptr;
    const auto is_intervals = [](const LabelTier& tier) { return tier.has_intervals; };
    if (words == nullptr && phones == nullptr && std::count_if(tiers.begin(), tiers.end(), is_intervals) == 1)
        only = words = &*std::find_if(tiers.begin(), tiers.end(), is_intervals);
    if (words == nullptr && phones == nullptr) {
        throw Error(format("{}: none of its tiers ({}) is named \"words\"; name the tier of words so", file,
                           tiers.empty() ? "none" : names_of(tiers)));
    }
    TimedLabels labels;
    if (words != nullptr) labels.words = words->labels;
    if (phones != nullptr) labels.phones = phones->labels;
    if (only != nullptr && tiers.size() == 1) {
        labels.notes.push_back(
            format("{}: its only tier, \"{}\", was taken for the words", file, only->name));
    }
    return labels;
}

}  // namespace chironomia
