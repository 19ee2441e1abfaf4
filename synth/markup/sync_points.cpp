#include "synth/markup/sync_points.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <iterator>

#include "core/error.h"
#include "core/text.h"
#include "synth/markup/word_spans.h"

namespace chironomia {
namespace {

constexpr double kLongest = 86400;        // of a speech [s]
constexpr std::size_t kDeepestTime = 16;  // times that refer to times

// Differences of written times, without the last bits that subtraction leaves.
double to_microseconds(double seconds) {
    return std::round(seconds * 1e6) / 1e6;
}

}  // namespace

std::optional<SyncPoint>& time_named(MarkTimes& times, std::size_t name) {
    const std::array<std::optional<SyncPoint>*, 7> all = {
        &times.start,      &times.ready, &times.stroke_start, &times.stroke,
        &times.stroke_end, &times.relax, &times.end};
    return *all[name];
}

void SyncPoints::add_sync(SpeechSync sync, const XmlNode& element) {
    const auto [other, is_new] = sync_of_.try_emplace(sync.id, syncs_.size());
    if (!is_new)
        throw Error(format("{}: a second sync point is called {}; give each an id of its own",
                           Place{element, source_}.to_text(), other->first));
    syncs_.push_back(std::move(sync));
}

void SyncPoints::add_behaviour(const XmlNode& element) {
    for (const XmlAttribute& attribute : element.attributes)
        if (attribute.name == "id" && !behaviours_.try_emplace(attribute.value, &element).second)
            throw Error(format("{}: a second behaviour is called {}; give each an id of its own",
                               Place{element, source_}.to_text(), attribute.value));
}

void SyncPoints::set_speech(std::string id, std::span<const ScriptWord> words, double start) {
    speech_ = std::move(id);
    word_count_ = words.size();
    for (const SpeechSync& sync : syncs_) words_.push_back(word_from(words, sync.byte));
    for (std::size_t i = 0; i < syncs_.size(); ++i)
        if (syncs_[i].time) timed_.push_back(i);
    std::stable_sort(timed_.begin(), timed_.end(),
                     [&](std::size_t a, std::size_t b) { return *syncs_[a].time < *syncs_[b].time; });
    const bool is_clock_of_block = !timed_.empty() && *syncs_[timed_.front()].time >= start;
    start_ = is_clock_of_block ? 0 : start;
}

// Of several sync points before one word the last one stands at its beginning: the others are as much earlier
// as their times say, where they have times.
SyncPoint SyncPoints::at(std::size_t sync) const {
    const std::size_t word = words_[sync];
    const auto behind = std::upper_bound(words_.begin(), words_.end(), word);
    const SpeechSync& last = syncs_[static_cast<std::size_t>(behind - words_.begin()) - 1];
    const double offset = syncs_[sync].time && last.time ? *syncs_[sync].time - *last.time : 0;
    return {word, to_microseconds(offset)};
}

SyncPoint SyncPoints::at_time(double seconds) const {
    seconds = to_microseconds(seconds - start_);
    if (timed_.empty()) return {std::nullopt, seconds};
    const auto behind = std::upper_bound(timed_.begin(), timed_.end(), seconds,
                                         [&](double s, std::size_t sync) { return s < *syncs_[sync].time; });
    const std::size_t nearest = behind == timed_.begin() ? *behind : *(behind - 1);
    SyncPoint point = at(nearest);
    point.offset = to_microseconds(point.offset + seconds - *syncs_[nearest].time);
    return point;
}

std::optional<SyncPoint> SyncPoints::find_of_behaviour(std::string_view id, std::string_view name,
                                                       std::size_t depth) const {
    const auto behaviour = behaviours_.find(std::string(id));
    if (behaviour == behaviours_.end()) return std::nullopt;
    for (const XmlAttribute& attribute : behaviour->second->attributes)
        if (attribute.name == name) return find_offset(attribute.value, depth + 1);
    return std::nullopt;
}

// "T2", "sp1:T2", "sp1:end", "p1:stroke"
std::optional<SyncPoint> SyncPoints::find(std::string_view target, std::size_t depth) const {
    const std::size_t colon = target.rfind(':');
    const std::string_view owner = colon == std::string_view::npos ? speech_ : target.substr(0, colon);
    const std::string_view name = colon == std::string_view::npos ? target : target.substr(colon + 1);
    if (owner != speech_) return find_of_behaviour(owner, name, depth);
    if (const auto sync = sync_of_.find(std::string(name)); sync != sync_of_.end()) return at(sync->second);
    if (name == "start") return SyncPoint{std::size_t{0}, 0};
    if (name == "end") return SyncPoint{word_count_, 0};
    return std::nullopt;
}

std::optional<SyncPoint> SyncPoints::find_offset(std::string_view written, std::size_t depth) const {
    if (depth > kDeepestTime) return std::nullopt;
    written = trim(written);
    if (const std::optional<double> seconds = parse_number(written))
        return *seconds >= 0 && *seconds <= kLongest ? std::optional(at_time(*seconds)) : std::nullopt;
    if (const std::optional<SyncPoint> point = find(written, depth)) return point;
    const std::size_t sign = written.find_last_of("+-");
    if (sign == std::string_view::npos) return std::nullopt;
    std::string digits;  // "- 0.25" is a way to write it, too
    std::copy_if(written.begin() + static_cast<std::ptrdiff_t>(sign), written.end(),
                 std::back_inserter(digits), [](char c) { return c != ' '; });
    const std::optional<double> offset = parse_number(digits);
    if (!offset || !(std::abs(*offset) <= kLongest)) return std::nullopt;
    std::optional<SyncPoint> point = find(trim(written.substr(0, sign)), depth);
    if (point) point->offset = to_microseconds(point->offset + *offset);
    return point;
}

std::string SyncPoints::known_syncs() const {
    constexpr std::size_t kNamed = 8;
    std::vector<std::string> ids;
    for (std::size_t i = 0; i < std::min(syncs_.size(), kNamed); ++i) ids.push_back(syncs_[i].id);
    return ids.empty() ? "no sync points" : join(ids) + (syncs_.size() > kNamed ? ", ..." : "");
}

SyncPoint SyncPoints::resolve(std::string_view written, const XmlNode& element,
                              std::string_view attribute) const {
    if (const std::optional<SyncPoint> point = find_offset(written, 0)) return *point;
    if (parse_number(written))
        throw Error(format("{}: {} {} is outside its range; times go from 0 to {} s",
                           Place{element, source_}.to_text(), attribute, written, kLongest));
    throw Error(format("{}: {} \"{}\" is no time and no sync point; {} has {}, start and end",
                       Place{element, source_}.to_text(), attribute, written, speech_, known_syncs()));
}

}  // namespace chironomia
