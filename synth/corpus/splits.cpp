#include "synth/corpus/splits.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <map>
#include <set>

#include "core/error.h"
#include "core/random.h"
#include "core/text.h"

namespace chironomia {
namespace {

constexpr double kUnseenSpeakers = 0.1, kValidation = 0.1, kTest = 0.1;
constexpr std::size_t kFewestForUnseen = 4;

void sort_by_id(std::vector<CorpusEntry>& entries) {
    std::sort(entries.begin(), entries.end(),
              [](const CorpusEntry& a, const CorpusEntry& b) { return a.id < b.id; });
}

// At least one.
std::size_t share_of(std::size_t count, double share) {
    return std::max<std::size_t>(1,
                                 static_cast<std::size_t>(std::lround(share * static_cast<double>(count))));
}

std::set<std::string> unseen_speakers(const std::vector<CorpusEntry>& entries, Random& random) {
    std::set<std::string> names;
    for (const CorpusEntry& entry : entries) names.insert(entry.speaker);
    if (names.size() < kFewestForUnseen) return {};
    std::vector<std::string> speakers(names.begin(), names.end());
    random.shuffle(speakers);
    speakers.resize(share_of(speakers.size(), kUnseenSpeakers));
    return {speakers.begin(), speakers.end()};
}

// Dyads that are linked by common participants.
struct Group {
    std::set<std::string> people;
    std::vector<std::size_t> dyads;  // places in the list
    double seconds = 0;
};

std::vector<Group> linked_groups(const std::vector<CorpusEntry>& entries) {
    std::vector<Group> groups;
    for (std::size_t i = 0; i < entries.size(); ++i) {
        Group joined{.dyads = {i}, .seconds = entries[i].seconds};
        for (const std::string_view person : split(entries[i].speaker, '+')) joined.people.emplace(person);
        const auto is_linked = [&joined](const Group& group) {
            return std::any_of(group.people.begin(), group.people.end(),
                               [&](const std::string& person) { return joined.people.contains(person); });
        };
        const auto linked = std::stable_partition(groups.begin(), groups.end(), std::not_fn(is_linked));
        for (auto group = linked; group != groups.end(); ++group) {
            joined.people.insert(group->people.begin(), group->people.end());
            joined.dyads.insert(joined.dyads.end(), group->dyads.begin(), group->dyads.end());
            joined.seconds += group->seconds;
        }
        groups.erase(linked, groups.end());
        groups.push_back(std::move(joined));
    }
    return groups;
}

struct Part {
    Split split = Split::train;
    double missing = 0;  // [s] that it should still get
    bool is_empty = true;
};

// The split that lacks most; if the remaining groups are only just enough, one of the splits without any group.
Part& neediest(std::array<Part, 3>& parts, std::size_t groups_left) {
    const auto empty = static_cast<std::size_t>(
        std::count_if(parts.begin(), parts.end(), [](const Part& part) { return part.is_empty; }));
    const bool only_empty = empty >= groups_left;
    Part* best = nullptr;
    for (Part& part : parts) {
        if (only_empty && !part.is_empty) continue;
        if (!best || part.missing > best->missing) best = &part;
    }
    return *best;
}

}  // namespace

std::vector<CorpusEntry> split_by_speakers(std::vector<CorpusEntry> entries, std::uint64_t seed) {
    sort_by_id(entries);
    Random random(seed);
    const std::set<std::string> unseen = unseen_speakers(entries, random);
    std::vector<CorpusEntry*> seen;
    for (CorpusEntry& entry : entries) {
        entry.split = unseen.contains(entry.speaker) ? Split::unseen : Split::train;
        if (entry.split == Split::train) seen.push_back(&entry);
    }
    if (seen.size() < 3) return entries;
    random.shuffle(seen);
    const std::size_t validation = share_of(seen.size(), kValidation), test = share_of(seen.size(), kTest);
    for (std::size_t i = 0; i < validation + test; ++i)
        seen[i]->split = i < validation ? Split::validation : Split::test;
    return entries;
}

std::vector<CorpusEntry> split_by_participants(std::vector<CorpusEntry> entries, std::uint64_t seed,
                                               const std::string& where) {
    sort_by_id(entries);
    std::vector<Group> groups = linked_groups(entries);
    if (groups.size() < 3) {
        throw Error(format(
            "{}: {} dyads fall into {} groups of people who never meet those of another, and train, validation "
            "and test need one each; say the \"split\" of each dyad yourself",
            where, entries.size(), groups.size()));
    }
    Random(seed).shuffle(groups);
    std::stable_sort(groups.begin(), groups.end(),
                     [](const Group& a, const Group& b) { return a.seconds > b.seconds; });
    double seconds = 0;
    for (const Group& group : groups) seconds += group.seconds;
    std::array<Part, 3> parts{Part{.split = Split::train, .missing = 0.7 * seconds},
                              Part{.split = Split::test, .missing = 0.2 * seconds},
                              Part{.split = Split::validation, .missing = 0.1 * seconds}};
    for (std::size_t g = 0; g < groups.size(); ++g) {
        Part& part = neediest(parts, groups.size() - g);
        part.missing -= groups[g].seconds;
        part.is_empty = false;
        for (const std::size_t dyad : groups[g].dyads) entries[dyad].split = part.split;
    }
    return entries;
}

}  // namespace chironomia
