#include "synth/speech/label_tiers.h"

#include <algorithm>
#include <array>
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
        throw Error(format("{}: the tiers \"{}\" and \"{}\" are both named as {}; keep those of one speaker",
                           file, found[0]->name, found[1]->name, *names.begin()));
    }
    return found.empty() ? nullptr : found[0];
}

bool is_silence(const TimedLabel& label) {
    static constexpr std::array<std::string_view, 10> kSilences = {"",      "sil", "sp",   "spn",   "<eps>",
                                                                   "<sil>", "<p>", "<p:>", "<nib>", "#"};
    const std::string text = to_lower(trim(label.text));
    return std::find(kSilences.begin(), kSilences.end(), text) != kSilences.end();
}

}  // namespace

TimedLabels labels_of_tiers(const std::vector<LabelTier>& tiers, const std::string& file) {
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
    std::erase_if(labels.words, is_silence);
    if (only != nullptr && tiers.size() == 1) {
        labels.notes.push_back(
            format("{}: its only tier, \"{}\", was taken for the words", file, only->name));
    }
    return labels;
}

}  // namespace chironomia
