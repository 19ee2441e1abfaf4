#include "skinning/face/face_report.h"

#include "core/text.h"

namespace chironomia {
namespace {

// "AU12_L lip corner puller"
std::string words_for(const FaceChannel& channel) {
    return format("{} {}", to_text(channel), name_of_unit(channel.unit));
}

}  // namespace

Json to_json(const FaceReport& report) {
    Json shown = Json::object(), hidden = Json::array(), full = Json::object();
    for (const ShownChannel& each : report.channels) {
        if (each.by.empty()) {
            hidden.push_back({{"unit", to_text(each.channel)}, {"name", name_of_unit(each.channel.unit)}});
        } else {
            shown[to_text(each.channel)] = each.by;
        }
    }
    for (const auto& [unit, frames] : report.full) full[to_text(FaceChannel{.unit = unit})] = frames;
    return {{"frames", report.frames},  {"bridged_frames", report.bridged},
            {"shown", shown},           {"cannot_show", hidden},
            {"frames_past_full", full}, {"head", report.head},
            {"gaze", report.gaze},      {"frames_gaze_held", report.gaze_held}};
}

std::vector<std::string> warnings_of(const FaceReport& report) {
    std::vector<std::string> hidden, warnings;
    for (const ShownChannel& each : report.channels) {
        if (each.by.empty()) hidden.push_back(words_for(each.channel));
    }
    if (!hidden.empty()) {
        const std::string why = report.morphs == 0
                                    ? "it has no morphs"
                                    : format("none of its {} morphs is named for it", report.morphs);
        warnings.push_back(format("{}: cannot show {}: {}", report.avatar, join(hidden), why));
    }
    if (report.gaze == "none") {
        warnings.push_back(
            format("{}: cannot turn its eyes: it has neither eye joints nor look morphs", report.avatar));
    }
    if (report.head == "no joint") {
        warnings.push_back(
            format("{}: cannot turn its head: no joint lies between shoulders and head", report.avatar));
    }
    if (report.gaze_held > 0) {
        warnings.push_back(
            format("{}: the gaze goes further than its eyes turn in {} of {} frames; they "
                   "stop there",
                   report.avatar, report.gaze_held, report.frames));
    }
    return warnings;
}

}  // namespace chironomia
