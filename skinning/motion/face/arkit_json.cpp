#include "skinning/motion/face/arkit_json.h"

#include <algorithm>
#include <cmath>
#include <vector>

#include "core/error.h"
#include "core/text.h"
#include "skinning/motion/face/arkit_csv.h"

namespace chironomia {
namespace {

constexpr double kRounding = 0.01;  // beyond 0 and 1

std::vector<std::string> names_in(const Json& json) {
    std::vector<std::string> names;
    const auto found = json.find("names");
    if (found == json.end() || !found->is_array()) return names;
    for (const Json& name : *found) names.push_back(name.is_string() ? name.get<std::string>() : "");
    return names;
}

// Writes the table that has the same face.
class ArkitTable {
  public:
    ArkitTable(const Json& json, const std::string& where)
        : frames_(json.at("frames")), where_(where), names_(names_in(json)) {}

    std::string run() {
        has_times_ = frames_.at(0).is_object() && frames_.at(0).contains("time");
        std::string table = has_times_ ? "time" : "frame";
        for (const std::string& name : names_) table += "," + name;
        for (std::size_t t = 0; t < frames_.size(); ++t) table += "\n" + row(t);
        return table + "\n";
    }

    // [1/s]
    double written_rate(const Json& json) const {
        const auto metadata = json.find("metadata");
        if (has_times_ || metadata == json.end() || !metadata->is_object() || !metadata->contains("fps"))
            return 0;
        const Json& fps = metadata->at("fps");
        return fps.is_number() ? fps.get<double>() : 0;
    }

    bool has_rotations() const { return has_rotations_; }

  private:
    [[noreturn]] void refuse(std::size_t t, const std::string& fault) const {
        throw Error(format("{}: frame {}: {}", where_, t, fault));
    }

    std::string row(std::size_t t) {
        const Json& frame = frames_[t];
        const auto weights = frame.is_object() ? frame.find("weights") : frame.end();
        if (!frame.is_object() || weights == frame.end() || !weights->is_array() ||
            weights->size() != names_.size())
            refuse(t,
                   format("has no list \"weights\" of {} numbers, one for each of \"names\"", names_.size()));
        std::string cells = has_times_ ? time(t) : format("{}", t);
        for (std::size_t i = 0; i < names_.size(); ++i) cells += "," + weight(t, names_[i], (*weights)[i]);
        const auto rotation = frame.find("rotation");
        has_rotations_ |= rotation != frame.end() && rotation->is_array() &&
                          std::ranges::any_of(*rotation, [](const Json& turn) { return turn != 0; });
        return cells;
    }

    std::string time(std::size_t t) {
        if (!frames_[t].contains("time")) refuse(t, "has no \"time\", and the first frame has one");
        std::string text = number(t, "time", frames_[t].at("time"));
        const double time = frames_[t].at("time").get<double>();
        if (t > 0 && time <= last_time_)
            refuse(t, format("its time is {} s, and the frame before is at {:.9g} s; frames go on in time",
                             text, last_time_));
        last_time_ = time;
        return text;
    }

    std::string number(std::size_t t, const std::string& name, const Json& value) const {
        if (value.is_number()) return format("{}", value.get<double>());
        refuse(t, format("\"{}\" is {}, a number is needed", name, value.dump().substr(0, 40)));
    }

    std::string weight(std::size_t t, const std::string& name, const Json& value) const {
        std::string text = number(t, name, value);
        const double weight = value.get<double>();
        if (weight >= -kRounding && weight <= 1 + kRounding) return text;
        refuse(t,
               format("\"{}\" is {}; 0 to 1 is expected, cut off what a model puts out beyond", name, text));
    }

    const Json& frames_;
    const std::string& where_;
    std::vector<std::string> names_;
    bool has_times_ = false, has_rotations_ = false;
    double last_time_ = 0;  // [s]
};

}  // namespace

bool holds_arkit(const Json& json) {
    if (!json.is_object()) return false;
    const auto frames = json.find("frames");
    return frames != json.end() && frames->is_array() && !frames->empty() && looks_like_arkit(names_in(json));
}

Motion face_of_arkit_json(const Json& json, const std::string& where, std::optional<double> fps) {
    ArkitTable table(json, where);
    const std::string text = table.run();
    if (const double rate = table.written_rate(json); !fps && rate > 0) fps = rate;
    Motion motion = face_of_arkit(text, where + " as a table", fps);
    motion.source = where;
    if (table.has_rotations())
        motion.notes.emplace_back(
            "rotation: left out, for it does not say what turns; give the head's turns in a table");
    return motion;
}

}  // namespace chironomia
