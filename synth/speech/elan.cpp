#include "synth/speech/elan.h"

#include <algorithm>
#include <map>
#include <optional>
#include <set>
#include <vector>

#include "core/error.h"
#include "core/text.h"
#include "synth/markup/xml.h"
#include "synth/speech/label_tiers.h"

namespace chironomia {
namespace {

class ElanReader {
  public:
    explicit ElanReader(const XmlSource& source) : source_(source), root_(parse_xml(source)) {}

    TimedLabels read(std::string_view speaker) {
        for (const XmlNode& node : root_.children)
            if (node.name == "TIME_ORDER") read_times(node);
        const MediaOrigin origin = read_origin();
        for (auto& [slot, time] : times_) time += origin.seconds;
        std::vector<LabelTier> tiers;
        for (const XmlNode& node : root_.children)
            if (node.name == "TIER") tiers.push_back(read_tier(node));
        TimedLabels labels = labels_of_tiers(tiers, std::string(source_.name), speaker);
        labels.notes.insert(labels.notes.end(), origin.notes.begin(), origin.notes.end());
        return labels;
    }

  private:
    // Where the media begin in the time of the annotations.
    struct MediaOrigin {
        double seconds = 0;
        std::vector<std::string> notes;
    };

    // Media that were synchronised have offsets; ELAN plays a medium from its TIME_ORIGIN on [ms] at time 0.
    MediaOrigin read_origin() const {
        std::set<double> origins;
        for (const XmlNode& header : root_.children) {
            if (header.name != "HEADER") continue;
            for (const XmlNode& medium : header.children) {
                if (medium.name != "MEDIA_DESCRIPTOR") continue;
                const std::string written = find_attribute(medium, "TIME_ORIGIN").value_or("0");
                const auto milliseconds = parse_number(written);
                if (!milliseconds) refuse(medium, format("the TIME_ORIGIN {} is no number", written));
                origins.insert(*milliseconds / 1000);
            }
        }
        if (origins.size() > 1) {
            return {.notes = {format(
                        "{}: its media begin at {} s and {} s; words have the times of ELAN, which are "
                        "those of a medium that begins at 0 s",
                        source_.name, *origins.begin(), *origins.rbegin())}};
        }
        const double origin = origins.empty() ? 0 : *origins.begin();
        if (origin == 0) return {};
        return {.seconds = origin,
                .notes = {
                    format("{}: its medium begins at {} s (TIME_ORIGIN), so words come that much later in it",
                           source_.name, origin)}};
    }

    [[noreturn]] void refuse(const XmlNode& node, const std::string& what) const {
        throw Error(format("{}: {}; save it again with ELAN", Place{node, source_}.to_text(), what));
    }

    std::string attribute(const XmlNode& node, std::string_view name) const {
        if (auto value = find_attribute(node, name)) return *std::move(value);
        refuse(node, format("{} has no {}", node.name, name));
    }

    void read_times(const XmlNode& order) {
        std::vector<std::string> names;
        std::vector<double> times;
        std::size_t untimed = 0;  // slots behind the last that has a value
        for (const XmlNode& slot : order.children) {
            if (slot.name != "TIME_SLOT") continue;
            names.push_back(attribute(slot, "TIME_SLOT_ID"));
            times.push_back(times.empty() ? 0 : times.back());
            const auto value = find_attribute(slot, "TIME_VALUE");
            ++untimed;
            if (!value) continue;
            const auto milliseconds = parse_number(*value);
            if (!milliseconds) refuse(slot, format("the time {} is no number", *value));
            const std::size_t last = times.size() - 1, first = last + 1 - untimed;
            const double from = first > 0 ? times[first - 1] : 0, to = *milliseconds / 1000;
            for (std::size_t i = first; i <= last; ++i)
                times[i] =
                    from + (to - from) * static_cast<double>(i + 1 - first) / static_cast<double>(untimed);
            untimed = 0;
        }
        for (std::size_t i = 0; i < names.size(); ++i) times_[names[i]] = times[i];
    }

    double time(const XmlNode& annotation, std::string_view reference) const {
        const auto found = times_.find(attribute(annotation, reference));
        if (found != times_.end()) return found->second;
        refuse(annotation, format("the time slot {} is not there", attribute(annotation, reference)));
    }

    LabelTier read_tier(const XmlNode& node) const {
        LabelTier tier{.name = attribute(node, "TIER_ID"), .has_intervals = false, .labels = {}};
        for (const XmlNode& annotation : node.children) {
            for (const XmlNode& aligned : annotation.children) {
                if (aligned.name != "ALIGNABLE_ANNOTATION") continue;
                tier.has_intervals = true;
                tier.labels.push_back(
                    {.where = format("annotation {} of \"{}\"", tier.labels.size() + 1, tier.name),
                     .text = value_of(aligned),
                     .start = time(aligned, "TIME_SLOT_REF1"),
                     .end = time(aligned, "TIME_SLOT_REF2")});
            }
        }
        std::ranges::stable_sort(tier.labels, {}, &TimedLabel::start);
        return tier;
    }

    static std::string value_of(const XmlNode& annotation) {
        std::string text;
        for (const XmlNode& value : annotation.children)
            for (const XmlNode& part : value.children) text += part.text;
        return text;
    }

    XmlSource source_;
    XmlNode root_;
    std::map<std::string, double> times_;  // [s]
};

}  // namespace

bool is_elan(std::string_view text) {
    return root_name(text) == "ANNOTATION_DOCUMENT";
}

TimedLabels read_elan(std::string_view text, const std::string& file, std::string_view speaker) {
    return ElanReader({text, file}).read(speaker);
}

}  // namespace chironomia
