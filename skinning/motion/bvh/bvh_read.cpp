#include "skinning/motion/bvh/bvh.h"

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>

#include "core/error.h"
#include "core/text.h"
#include "skinning/signal/frame_rate.h"

namespace chironomia {
namespace {

using Place = glm::dvec3;

enum class Channel { x_position, y_position, z_position, x_rotation, y_rotation, z_rotation };

constexpr std::array<std::string_view, 6> kChannelNames = {"Xposition", "Yposition", "Zposition",
                                                           "Xrotation", "Yrotation", "Zrotation"};

// Not nan, and no larger than any place or angle of a body in any unit.
bool is_sane(double value) {
    return std::abs(value) < 1e9;
}

bool is_position(Channel channel) {
    return channel <= Channel::z_position;
}

int axis_of(Channel channel) {
    return static_cast<int>(channel) % 3;
}

struct ReadJoint {
    std::string name;
    int parent = -1;
    std::optional<Place> offset;
    std::vector<Channel> channels;
    bool has_channels = false;  // the word CHANNELS was there, perhaps with 0
    bool is_end = false;
};

struct Hierarchy {
    std::vector<ReadJoint> joints;
    size_t channels = 0;  // C, of all joints
};

struct Rows {
    std::vector<double> values;  // (T, C)
    size_t frames = 0;
    double fps = 0;
    std::string rate_note;
};

// Words and lines of a text, with their line numbers.
class Scanner {
  public:
    Scanner(std::string_view text, std::string where) : text_(text), where_(std::move(where)) {}

    // The next word; braces are words of their own. Empty at the end.
    std::string_view word() {
        skip_space();
        line_ = next_line_;
        const size_t begin = at_;
        while (at_ < text_.size() && !is_space(text_[at_])) {
            const bool brace = text_[at_] == '{' || text_[at_] == '}';
            if (brace && at_ > begin) break;
            ++at_;
            if (brace) break;
        }
        return text_.substr(begin, at_ - begin);
    }

    // What is left of the current line, up to an opening brace.
    std::string_view rest_of_line() {
        const size_t end = std::min(text_.find_first_of("{\r\n", at_), text_.size());
        const std::string_view rest = text_.substr(at_, end - at_);
        at_ = end;
        return trim(rest);
    }

    // The next line that holds anything. Empty at the end.
    std::string_view line() {
        skip_space();
        line_ = next_line_;
        const size_t end = std::min(text_.find_first_of("\r\n", at_), text_.size());
        const std::string_view whole = text_.substr(at_, end - at_);
        at_ = end;
        return whole;
    }

    // "file.bvh:12: ", the line of the word or line read last.
    std::string here() const { return format("{}:{}: ", where_, line_); }
    const std::string& where() const { return where_; }
    size_t left() const { return text_.size() - at_; }  // characters

    [[noreturn]] void refuse(const std::string& message) const { throw Error(here() + message); }

  private:
    static bool is_space(char c) {
        return c == ' ' || c == '\t' || c == '\r' || c == '\n' || c == '\f' || c == '\v';
    }

    void skip_space() {
        while (at_ < text_.size() && is_space(text_[at_])) {
            // A line ends with \n, with \r\n, or with \r alone.
            const bool pair = text_[at_] == '\r' && at_ + 1 < text_.size() && text_[at_ + 1] == '\n';
            if (text_[at_] == '\n' || (text_[at_] == '\r' && !pair)) ++next_line_;
            ++at_;
        }
    }

    std::string_view text_;
    std::string where_;
    size_t at_ = 0;
    size_t line_ = 1;
    size_t next_line_ = 1;
};

bool same_word(std::string_view word, std::string_view keyword) {
    return to_lower(word) == to_lower(keyword);
}

class HierarchyReader {
  public:
    explicit HierarchyReader(Scanner& scanner) : scanner_(scanner) {}

    // Reads up to and with the word MOTION.
    Hierarchy read() {
        if (const auto first = scanner_.word(); !same_word(first, "HIERARCHY")) {
            scanner_.refuse(format("this is no BVH motion: it begins with \"{}\", not with HIERARCHY",
                                   first.substr(0, 40)));
        }
        for (std::string_view word = scanner_.word(); !same_word(word, "MOTION"); word = scanner_.word()) {
            read_statement(word);
        }
        if (!open_.empty()) refuse_open();
        finish();
        return std::move(hierarchy_);
    }

  private:
    void read_statement(std::string_view word) {
        if (word.empty()) refuse_end();
        if (same_word(word, "ROOT")) return open_root();
        if (open_.empty()) {
            scanner_.refuse(format("\"{}\" stands outside the joints; ROOT or MOTION is expected here",
                                   word.substr(0, 40)));
        }
        if (same_word(word, "JOINT")) return open_joint(std::string(scanner_.rest_of_line()), false);
        if (same_word(word, "End")) return open_end_site();
        if (same_word(word, "OFFSET")) return read_offset();
        if (same_word(word, "CHANNELS")) return read_channels();
        if (word == "}") return close_joint();
        scanner_.refuse(
            format("\"{}\" in joint \"{}\" is not known; OFFSET, CHANNELS, JOINT, End Site or }} is "
                   "expected here",
                   word.substr(0, 40), joint().name));
    }

    [[noreturn]] void refuse_end() {
        if (!open_.empty()) refuse_open();
        scanner_.refuse("the file ends before the word MOTION; it is truncated or holds no motion");
    }

    [[noreturn]] void refuse_open() {
        scanner_.refuse(
            format("the hierarchy ends inside joint \"{}\" with {} braces open; the file is truncated or "
                   "a }} is missing",
                   joint().name, open_.size()));
    }

    ReadJoint& joint() { return hierarchy_.joints[static_cast<size_t>(open_.back())]; }

    void open_root() {
        const std::string name(scanner_.rest_of_line());
        if (!hierarchy_.joints.empty()) {
            scanner_.refuse(
                format("a second ROOT \"{}\" after \"{}\"; one figure per file is supported, split the "
                       "file",
                       name, hierarchy_.joints[0].name));
        }
        open_joint(name, false);
    }

    void open_joint(const std::string& name, bool is_end) {
        if (name.empty()) scanner_.refuse("a joint has no name");
        const int parent = open_.empty() ? -1 : open_.back();
        if (const auto brace = scanner_.word(); brace != "{") {
            scanner_.refuse(
                format("joint \"{}\" is followed by \"{}\", not by {{", name, brace.substr(0, 40)));
        }
        open_.push_back(static_cast<int>(hierarchy_.joints.size()));
        hierarchy_.joints.push_back(
            {.name = name, .parent = parent, .offset = {}, .channels = {}, .is_end = is_end});
    }

    void open_end_site() {
        // Some writers put a name behind it, which means nothing.
        if (const auto site = scanner_.rest_of_line(); !same_word(site.substr(0, 4), "Site")) {
            scanner_.refuse(format("\"End {}\" is not known; End Site is expected here", site.substr(0, 40)));
        }
        if (joint().is_end) scanner_.refuse("an End Site inside an End Site");
        open_joint(joint().name + "_end", true);
    }

    void close_joint() {
        if (!joint().offset) scanner_.refuse(format("joint \"{}\" has no OFFSET", joint().name));
        open_.pop_back();
    }

    void read_offset() {
        if (joint().offset) scanner_.refuse(format("joint \"{}\" has a second OFFSET", joint().name));
        Place offset;
        for (int axis = 0; axis < 3; ++axis) {
            const std::string_view word = scanner_.word();
            const auto number = parse_number(word);
            if (!number || !is_sane(*number)) {
                scanner_.refuse(format("OFFSET of joint \"{}\": \"{}\" is no number; three are expected",
                                       joint().name, word.substr(0, 40)));
            }
            offset[axis] = *number;
        }
        joint().offset = offset;
    }

    void read_channels() {
        if (joint().has_channels) scanner_.refuse(format("joint \"{}\" has a second CHANNELS", joint().name));
        if (joint().is_end) scanner_.refuse(format("the End Site of \"{}\" has CHANNELS", joint().name));
        joint().has_channels = true;
        const std::string_view word = scanner_.word();
        const auto count = parse_integer(word);
        if (!count || *count < 0) {
            scanner_.refuse(
                format("CHANNELS of joint \"{}\": \"{}\" is no count", joint().name, word.substr(0, 40)));
        }
        for (long long i = 0; i < *count; ++i) joint().channels.push_back(read_channel(i + 1, *count));
        hierarchy_.channels += joint().channels.size();
    }

    Channel read_channel(long long number, long long count) {
        const std::string_view word = scanner_.word();
        for (size_t i = 0; i < kChannelNames.size(); ++i) {
            if (!same_word(word, kChannelNames[i])) continue;
            const auto channel = static_cast<Channel>(i);
            const auto& earlier = joint().channels;
            if (is_position(channel) && std::count(earlier.begin(), earlier.end(), channel) > 0) {
                scanner_.refuse(format("joint \"{}\" has the channel {} twice", joint().name, word));
            }
            return channel;
        }
        scanner_.refuse(
            format("channel {} of {} of joint \"{}\" is \"{}\"; Xposition, Yposition, Zposition, "
                   "Xrotation, Yrotation or Zrotation is expected",
                   number, count, joint().name, word.substr(0, 40)));
    }

    void finish() {
        if (hierarchy_.joints.empty()) scanner_.refuse("the hierarchy has no ROOT");
        if (hierarchy_.channels == 0) scanner_.refuse("no joint has CHANNELS, so nothing can move");
    }

    Scanner& scanner_;
    Hierarchy hierarchy_;
    std::vector<int> open_;  // joints whose } has not come yet
};

class RowReader {
  public:
    RowReader(Scanner& scanner, const Hierarchy& hierarchy) : scanner_(scanner), hierarchy_(hierarchy) {}

    Rows read(std::optional<double> fps) {
        const std::string_view count = value_after("Frames");
        const auto promised = parse_integer(count);
        if (!promised || *promised < 1) {
            scanner_.refuse(
                format("Frames is \"{}\"; a count of at least 1 is expected", count.substr(0, 40)));
        }
        read_rate(fps);
        // As many values as promised, as far as the text can hold them: a digit and a blank each.
        const auto rows = static_cast<size_t>(*promised);
        if (rows <= scanner_.left() / 2 / hierarchy_.channels)
            rows_.values.reserve(rows * hierarchy_.channels);
        for (std::string_view line = scanner_.line(); !line.empty(); line = scanner_.line()) read_row(line);
        if (rows_.frames != static_cast<size_t>(*promised)) {
            scanner_.refuse(
                format("Frames says {}, but {} rows follow; the file is truncated or the count is wrong",
                       *promised, rows_.frames));
        }
        return std::move(rows_);
    }

  private:
    // "Frames: 12", "Frames : 12", "Frame Time:0.1", "Frames 12"
    std::string_view value_after(std::string_view key) {
        const std::string_view line = scanner_.line();
        if (!same_word(line.substr(0, key.size()), key)) {
            scanner_.refuse(format("\"{}:\" is expected here, not \"{}\"", key, line.substr(0, 40)));
        }
        std::string_view value = trim(line.substr(key.size()));
        if (value.starts_with(':')) value.remove_prefix(1);
        return trim(value);
    }

    void read_rate(std::optional<double> fps) {
        const std::string_view text = value_after("Frame Time");
        const auto seconds = parse_number(text);
        const bool usable = seconds && std::isfinite(*seconds) && *seconds > 0 && std::isfinite(1 / *seconds);
        if (!usable && !fps) {
            scanner_.refuse(format(
                "Frame Time is \"{}\"; a time above 0 s with a decimal point is expected, or set the rate with "
                "--motion-fps",
                text.substr(0, 40)));
        }
        rows_.fps = fps ? *fps : rate_of_frame_time(text);
        if (!is_rate_of_motion(rows_.fps)) {
            scanner_.refuse(
                format("Frame Time is {} s, which are {:.6g} frames/s; a motion has {} to {}{}, or set the "
                       "rate with --motion-fps",
                       text.substr(0, 40), rows_.fps, kSlowestMotion, kFastestMotion,
                       seconds ? meant_by_frame_time(*seconds) : ""));
        }
        rows_.rate_note =
            fps ? format("rate: {:.6g} frames/s, set by hand (frame time in the file: {} s)", *fps, text)
                : format("rate: {:.6g} frames/s (frame time {} s)", rows_.fps, text);
    }

    void read_row(std::string_view line) {
        const size_t before = rows_.values.size();
        for (const char* at = line.data(); (at = skip_blanks(at, line.data() + line.size())) != nullptr;) {
            at = read_value(at, line.data() + line.size(), rows_.values.size() - before);
        }
        const size_t count = rows_.values.size() - before;
        if (count != hierarchy_.channels) {
            scanner_.refuse(format("row {} has {} values, the joints have {} channels", rows_.frames + 1,
                                   count, hierarchy_.channels));
        }
        ++rows_.frames;
    }

    static const char* skip_blanks(const char* at, const char* end) {
        while (at < end && (*at == ' ' || *at == '\t' || *at == '\f' || *at == '\v')) ++at;
        return at < end ? at : nullptr;
    }

    const char* read_value(const char* at, const char* end, size_t column) {
        double value = 0;
        const char* digits = *at == '+' ? at + 1 : at;
        const auto [stop, problem] = std::from_chars(digits, end, value);
        const bool whole = stop == end || *stop == ' ' || *stop == '\t' || *stop == '\f' || *stop == '\v';
        if (problem != std::errc() || !whole || !is_sane(value)) refuse_value(at, end, column);
        rows_.values.push_back(value);
        return stop;
    }

    [[noreturn]] void refuse_value(const char* at, const char* end, size_t column) {
        const char* stop = std::find_if(at, end, [](char c) { return c == ' ' || c == '\t'; });
        const std::string word(at, std::min(stop, at + 40));
        if (rows_.frames > 0 && column == 0 && !std::isdigit(static_cast<unsigned char>(*at)) && *at != '-') {
            scanner_.refuse(format("\"{}\" follows after row {}; only rows of numbers are expected here",
                                   word, rows_.frames));
        }
        const auto number = parse_number(word);
        const std::string value =
            number && std::isfinite(*number)      ? "above 1e9, which no place or angle of a body is"
            : word.find(',') != std::string::npos ? "no number; numbers have a decimal point, not a comma"
                                                  : "no finite number";
        scanner_.refuse(
            format("row {}, {}: \"{}\" is {}", rows_.frames + 1, channel_name(column), word, value));
    }

    std::string channel_name(size_t column) const {
        for (const ReadJoint& joint : hierarchy_.joints) {
            if (column < joint.channels.size()) {
                const auto channel = static_cast<size_t>(joint.channels[column]);
                return format("{} of joint \"{}\"", kChannelNames[channel], joint.name);
            }
            column -= joint.channels.size();
        }
        return format("value {} after the last channel", column + 1);
    }

    Scanner& scanner_;
    const Hierarchy& hierarchy_;
    Rows rows_;
};

// Whether position channels count from OFFSET instead of replacing it.
struct Additive {
    bool root = false;
    bool others = false;
};

bool has_position(const ReadJoint& joint) {
    return std::any_of(joint.channels.begin(), joint.channels.end(), is_position);
}

// The values of one joint's position channels in a row, `otherwise` where it has none.
Place position_in(const ReadJoint& joint, const double* values, const Place& otherwise) {
    Place place = otherwise;
    for (size_t c = 0; c < joint.channels.size(); ++c) {
        if (is_position(joint.channels[c])) place[axis_of(joint.channels[c])] = values[c];
    }
    return place;
}

// The root: its positions lack the height that OFFSET has. Others: nearer to zero than to their OFFSET.
Additive find_additive(const Hierarchy& hierarchy, const Rows& rows) {
    double from_zero = 0, from_offset = 0, along_root = 0;
    const double root_length = glm::length(*hierarchy.joints[0].offset);
    for (size_t t = 0; t < rows.frames; ++t) {
        const double* values = rows.values.data() + t * hierarchy.channels;
        for (size_t j = 0; j < hierarchy.joints.size(); ++j) {
            const ReadJoint& joint = hierarchy.joints[j];
            if (has_position(joint)) {
                const Place place = position_in(joint, values, Place(0));
                if (j == 0 && root_length > 0)
                    along_root += glm::dot(place, *joint.offset) / (root_length * root_length);
                if (j > 0) from_zero += glm::length(place);
                if (j > 0) from_offset += glm::length(place - *joint.offset);
            }
            values += joint.channels.size();
        }
    }
    const bool root_moves = has_position(hierarchy.joints[0]) && root_length > 0;
    return {.root = root_moves && along_root / static_cast<double>(rows.frames) < 0.1,
            .others = from_zero < from_offset};
}

// The turn of all rotation channels, the first one outermost; double until the end keeps it exact to 1e-7.
Quat turn_in(const ReadJoint& joint, const double* values) {
    glm::dquat turn(1, 0, 0, 0);
    for (size_t c = 0; c < joint.channels.size(); ++c) {
        if (is_position(joint.channels[c])) continue;
        const double half = values[c] * (kDegree / 2);
        glm::dquat step(std::cos(half), 0, 0, 0);
        step[axis_of(joint.channels[c])] = std::sin(half);
        turn = turn * step;
    }
    return normalize(Quat(turn));
}

JointTrack make_track(const Hierarchy& hierarchy, const Rows& rows, const Additive& additive) {
    JointTrack track;
    for (const ReadJoint& joint : hierarchy.joints) {
        track.skeleton.joints.push_back({joint.name, joint.parent, {.translation = Vec3(*joint.offset)}});
    }
    track.turns.reserve(rows.frames * hierarchy.joints.size());
    track.translations.reserve(rows.frames * hierarchy.joints.size());
    const double* values = rows.values.data();
    for (size_t t = 0; t < rows.frames; ++t) {
        for (const ReadJoint& joint : hierarchy.joints) {
            const bool adds = joint.parent < 0 ? additive.root : additive.others;
            const Place place = adds ? *joint.offset + position_in(joint, values, Place(0))
                                     : position_in(joint, values, *joint.offset);
            track.turns.push_back(turn_in(joint, values));
            track.translations.push_back(Vec3(place));
            values += joint.channels.size();
        }
    }
    return track;
}

// Removes End Sites without length, because they give no direction.
void drop_empty_ends(Hierarchy& hierarchy) {
    std::vector<int> new_index(hierarchy.joints.size(), -1);
    std::vector<ReadJoint> kept;
    for (size_t j = 0; j < hierarchy.joints.size(); ++j) {
        ReadJoint joint = hierarchy.joints[j];
        if (joint.is_end && *joint.offset == Place(0)) continue;
        if (joint.parent >= 0) joint.parent = new_index[static_cast<size_t>(joint.parent)];
        new_index[j] = static_cast<int>(kept.size());
        kept.push_back(std::move(joint));
    }
    hierarchy.joints = std::move(kept);
}

std::string rotation_orders(const Hierarchy& hierarchy) {
    std::vector<std::string> orders;
    for (const ReadJoint& joint : hierarchy.joints) {
        std::string order;
        for (const Channel channel : joint.channels) {
            if (!is_position(channel)) order += "XYZ"[axis_of(channel)];
        }
        if (!order.empty() && std::find(orders.begin(), orders.end(), order) == orders.end())
            orders.push_back(order);
    }
    return join(orders);
}

std::string duplicate_names(const Hierarchy& hierarchy) {
    std::vector<std::string> names;
    for (const ReadJoint& joint : hierarchy.joints) names.push_back(joint.name);
    std::sort(names.begin(), names.end());
    std::vector<std::string> twice;
    for (size_t i = 1; i < names.size(); ++i) {
        const bool again = names[i] == names[i - 1];
        if (again && (twice.empty() || twice.back() != names[i])) twice.push_back(names[i]);
    }
    return join(twice);
}

std::vector<std::string> dialect_notes(const Hierarchy& hierarchy, const Rows& rows,
                                       const Additive& additive) {
    const auto ends = std::count_if(hierarchy.joints.begin(), hierarchy.joints.end(),
                                    [](const ReadJoint& joint) { return joint.is_end; });
    const auto moving = std::count_if(hierarchy.joints.begin(), hierarchy.joints.end(), has_position);
    std::vector<std::string> notes;
    notes.push_back(format("BVH: {} joints, {} end sites, {} channels, rotations {}, {} with positions",
                           hierarchy.joints.size() - static_cast<size_t>(ends), ends, hierarchy.channels,
                           rotation_orders(hierarchy), moving));
    notes.push_back(rows.rate_note);
    if (additive.root) notes.push_back("positions of the root are added to its OFFSET, which they leave out");
    if (additive.others)
        notes.push_back("positions of the other joints are added to OFFSET, they stay near zero");
    if (const std::string twice = duplicate_names(hierarchy); !twice.empty()) {
        notes.push_back("names of several joints: " + twice);
    }
    return notes;
}

}  // namespace

Motion parse_bvh(std::string_view text, const std::string& where, std::optional<double> fps) {
    Scanner scanner(text, where);
    Hierarchy hierarchy = HierarchyReader(scanner).read();
    const Rows rows = RowReader(scanner, hierarchy).read(fps);
    drop_empty_ends(hierarchy);
    const Additive additive = find_additive(hierarchy, rows);
    Motion motion{
        .source = where, .fps = rows.fps, .frames = rows.frames, .joints = {}, .keypoints = {}, .notes = {}};
    motion.joints = make_track(hierarchy, rows, additive);
    motion.notes = dialect_notes(hierarchy, rows, additive);
    return motion;
}

}  // namespace chironomia
