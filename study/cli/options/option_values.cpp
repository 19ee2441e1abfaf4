#include "study/cli/options/option_values.h"

#include <charconv>
#include <cmath>
#include <limits>

#include "core/error.h"
#include "core/text.h"

namespace chironomia::study {
namespace {

constexpr long long kSmallestSide = 16;
constexpr long long kLargestSide = 8192;
constexpr double kLongestCut = 1e6;  // [s]
constexpr long long kMostShards = 100000;

std::size_t parse_frame(std::string_view number, std::string_view range) {
    const auto frame = parse_integer(number);
    if (!frame || *frame < 0) {
        throw Error(
            format("\"{}\" is no range of frames; write FIRST:END such as 0:90, counted from 0", range));
    }
    return static_cast<std::size_t>(*frame);
}

}  // namespace

RenderSize parse_size(std::string_view text) {
    const auto sides = split(text, 'x');
    const auto width = parse_integer(sides.front());
    const auto height = parse_integer(sides.back());
    if (sides.size() != 2 || !width || !height) {
        throw Error(format("\"{}\" is no size; write WIDTHxHEIGHT such as 1280x720", text));
    }
    for (const long long side : {*width, *height}) {
        if (side < kSmallestSide || side > kLargestSide) {
            throw Error(format("\"{}\" has a side of {} pixels; both must be {} to {}", text, side,
                               kSmallestSide, kLargestSide));
        }
    }
    return {.width = static_cast<int>(*width), .height = static_cast<int>(*height)};
}

Rate parse_clip_rate(std::string_view text) {
    const auto rate = parse_rate(text);
    if (!rate)
        throw Error(
            format("\"{}\" is no frame rate; write a number above 0 and up to 1000 such as 30 or "
                   "30000/1001",
                   text));
    return *rate;
}

double parse_motion_rate(std::string_view text) {
    const auto rate = parse_number(text);
    if (!rate || !(*rate > 0) || !std::isfinite(*rate))
        throw Error(format("\"{}\" is no frame rate; write a number above 0 such as 15", text));
    return *rate;
}

FrameRange parse_frame_range(std::string_view text) {
    const auto ends = split(text, ':');
    if (ends.size() != 2) {
        throw Error(
            format("\"{}\" is no range of frames; write FIRST:END such as 0:90, counted from 0", text));
    }
    FrameRange range;
    if (!ends[0].empty()) range.first = parse_frame(ends[0], text);
    if (!ends[1].empty()) range.last = parse_frame(ends[1], text);
    if (range.last && *range.last <= range.first) {
        throw Error(
            format("\"{}\" is an empty range of frames; the end must come after the beginning", text));
    }
    return range;
}

Cut parse_cut(std::string_view text) {
    const auto ends = split(text, ':');
    const auto seconds = [&](std::string_view number) {
        const auto value = parse_number(number);
        if (!value || !(*value >= 0) || *value > kLongestCut)
            throw Error(format("\"{}\" is no range of seconds; write BEGIN:END such as 2.5:10", text));
        return *value;
    };
    if (ends.size() != 2) seconds("");
    Cut cut;
    if (!ends[0].empty()) cut.begin = seconds(ends[0]);
    if (!ends[1].empty()) cut.end = seconds(ends[1]);
    if (cut.end && *cut.end <= cut.begin)
        throw Error(
            format("\"{}\" is an empty range of seconds; the end must come after the beginning", text));
    return cut;
}

std::uint64_t parse_seed(std::string_view text) {
    std::uint64_t seed = 0;
    const auto [end, fault] = std::from_chars(text.data(), text.data() + text.size(), seed);
    if (fault != std::errc() || end != text.data() + text.size()) {
        throw Error(format("\"{}\" is no seed; write a whole number from 0 to {}", text,
                           std::numeric_limits<std::uint64_t>::max()));
    }
    return seed;
}

Shard parse_shard(std::string_view text) {
    const auto numbers = split(text, '/');
    const auto number = parse_integer(numbers.front());
    const auto count = parse_integer(numbers.back());
    if (numbers.size() != 2 || !number || !count)
        throw Error(format("\"{}\" is no part of the work; write PART/PARTS such as 1/8", text));
    if (*count < 1 || *count > kMostShards)
        throw Error(format("\"{}\" has {} parts; their number must be 1 to {}", text, *count, kMostShards));
    if (*number < 1 || *number > *count)
        throw Error(
            format("\"{}\" is part {} of {}; parts are counted from 1 to {}", text, *number, *count, *count));
    return {.number = static_cast<std::size_t>(*number), .count = static_cast<std::size_t>(*count)};
}

std::map<std::string, double> parse_strengths(std::string_view text) {
    std::map<std::string, double> strengths;
    std::string name;
    for (const std::string_view part : split(text, ',')) {
        const std::size_t equals = part.rfind('=');
        if (equals == part.npos) {
            name += format("{},", part);
            continue;
        }
        name += part.substr(0, equals);
        const auto strength = parse_number(part.substr(equals + 1));
        if (name.empty() || !strength || !std::isfinite(*strength))
            throw Error(format("\"{}\" is no list of strengths; write NAME=NUMBER,NAME=NUMBER", text));
        if (!strengths.emplace(name, *strength).second)
            throw Error(format("\"{}\" names \"{}\" twice; give each one strength", text, name));
        name.clear();
    }
    if (!name.empty())
        throw Error(format("\"{}\" is no list of strengths; write NAME=NUMBER,NAME=NUMBER", text));
    return strengths;
}

}  // namespace chironomia::study
