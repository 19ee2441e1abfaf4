// The sync points of a BML block: places between its words, and times that refer to them.
#pragma once

#include <cstddef>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <unordered_map>
#include <vector>

#include "core/speech.h"
#include "synth/markup/marked_text.h"
#include "synth/markup/xml.h"

namespace chironomia {

// One <sync> or <tm> of the speech.
struct SpeechSync {
    std::string id;
    std::size_t byte = 0;  // in the script, of the next word or before
    std::optional<double> time;
};

// The seven of BML, in their order.
inline constexpr std::string_view kSyncNames[] = {"start",     "ready", "strokeStart", "stroke",
                                                  "strokeEnd", "relax", "end"};
std::optional<SyncPoint>& time_named(MarkTimes& times, std::size_t name);

class SyncPoints {
  public:
    explicit SyncPoints(const XmlSource& source) : source_(source) {}

    // Throws Error if two have one id.
    void add_sync(SpeechSync sync, const XmlNode& element);
    // A behaviour whose times others may refer to.
    void add_behaviour(const XmlNode& element);
    //   start  of the speech on the clock of the block, to which times in seconds refer [s]
    void set_speech(std::string id, std::span<const ScriptWord> words, double start);

    // The time that `written` is. A time in seconds that no word gives counts from the start of the speech, and is
    // below 0 before it. Where sync points have times of their own, those count from the start of the speech if the
    // first is before it, else on the clock of the block. Throws Error if it is neither a number from 0 on nor a sync
    // point that is there.
    SyncPoint resolve(std::string_view written, const XmlNode& element, std::string_view attribute) const;

  private:
    std::optional<SyncPoint> find(std::string_view target, std::size_t depth) const;
    std::optional<SyncPoint> find_offset(std::string_view written, std::size_t depth) const;
    std::optional<SyncPoint> find_of_behaviour(std::string_view id, std::string_view name,
                                               std::size_t depth) const;
    SyncPoint at(std::size_t sync) const;
    SyncPoint at_time(double seconds) const;
    std::string known_syncs() const;

    const XmlSource& source_;
    std::string speech_ = "speech";
    std::vector<SpeechSync> syncs_;   // ascending by place
    std::vector<std::size_t> words_;  // the word after each of them
    std::vector<std::size_t> timed_;  // of syncs_, ascending by time
    std::size_t word_count_ = 0;
    double start_ = 0;  // of the clock of written times, on that of the block [s]
    std::unordered_map<std::string, std::size_t> sync_of_;
    std::unordered_map<std::string, const XmlNode*> behaviours_;
};

}  // namespace chironomia
