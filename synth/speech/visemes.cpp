#include "synth/speech/visemes.h"

#include <algorithm>
#include <cmath>
#include <vector>

#include "core/quantile.h"
#include "core/smooth_step.h"
#include "synth/speech/mouth_shapes.h"

namespace chironomia {
namespace {

constexpr double kOpeningRange = 0.035;   // [s] in which the dominance of a phoneme falls to 37 %
constexpr double kRoundingRange = 0.075;  // [s]
constexpr double kPlateau = 0.25;         // share of a phoneme before and after its middle
constexpr double kReach = 1;              // [s] beyond which a phoneme counts for nothing
constexpr double kEdge = 0.12;            // [s] of a pause in which the mouth still moves
constexpr double kShutting = 0.04;        // [s] in which lips meet and part
constexpr double kLouder = 0.02;          // of the jaw's way for each dB
constexpr double kMostLouder = 0.25;
// At the end of a pause the mouth already opens for the next word.
constexpr MouthShape kPause = {.opening = 0.3, .rounding = 0.15};
constexpr double kSilentBelow = -70;  // [dB]
constexpr int kPressUnit = 24;
constexpr double kPress = 2;  // of lips that are shut

// The target shape of the mouth over one interval.
struct Segment {
    double start = 0;  // [s]
    double end = 0;    // [s]
    MouthShape shape;  // of a pause: nothing
    bool is_pause = false;

    double middle() const { return (start + end) / 2; }
};

double level_of(const Audio& sound, double start, double end) {
    const auto sample_at = [&](double time) {
        return std::min(sound.length(), static_cast<std::size_t>(std::max(0.0, time * sound.rate)));
    };
    const auto channels = static_cast<std::size_t>(sound.channels);
    const std::size_t first = sample_at(start) * channels, last = sample_at(end) * channels;
    double power = 0;
    for (std::size_t i = first; i < last; ++i)
        power += static_cast<double>(sound.samples[i]) * sound.samples[i];
    return 10 * std::log10(power / static_cast<double>(std::max<std::size_t>(1, last - first)) + 1e-9);
}

// How far the jaw opens for each phoneme, by how loud it is among the others.
std::vector<double> gains_of(const Speech& speech) {
    std::vector<double> levels, heard;
    for (const SpokenPhoneme& phoneme : speech.phonemes) {
        levels.push_back(level_of(speech.audio, phoneme.start, phoneme.end));
        if (phoneme.symbol != "_") heard.push_back(levels.back());
    }
    const double middle = heard.empty() ? 0 : median(heard);
    for (double& level : levels)
        level = 1 + std::clamp(kLouder * (level - middle), -kMostLouder, kMostLouder);
    return levels;
}

// The parts of a phoneme; the first of two vowels lasts longer than the second.
void add_parts(const SpokenPhoneme& phoneme, double gain, std::vector<Segment>& segments) {
    const std::vector<MouthShape> shapes = shapes_of(phoneme.symbol);
    const double length = phoneme.end - phoneme.start;
    const double first = shapes.size() == 1 ? 1 : 1.2 / static_cast<double>(shapes.size());
    double time = phoneme.start;
    for (std::size_t i = 0; i < shapes.size(); ++i) {
        const double share = i == 0 ? first : (1 - first) / static_cast<double>(shapes.size() - 1);
        Segment segment{.start = time, .end = time + share * length, .shape = shapes[i]};
        segment.shape[MouthPart::jaw] *= gain;
        const double opens = time + segment.shape.shut * (segment.end - segment.start);
        time = segment.end;
        // A stop is released at its end, with the lips in the shape of its neighbours.
        if (segment.shape.shut > 0 && segment.shape.shut < 1) {
            segments.push_back({.start = segment.start, .end = opens, .shape = segment.shape});
            segment = {.start = opens, .end = time, .shape = shapes_of("h")[0]};
        }
        segments.push_back(segment);
    }
}

// All of the time from 0 on; what lies between phonemes is a pause.
std::vector<Segment> segments_of(const Speech& speech, double end) {
    const std::vector<double> gains = gains_of(speech);
    std::vector<Segment> segments;
    double time = 0;
    const auto pause_until = [&](double start) {
        if (start > time)
            segments.push_back({.start = time, .end = start, .shape = kPause, .is_pause = true});
    };
    for (std::size_t i = 0; i < speech.phonemes.size(); ++i) {
        if (speech.phonemes[i].symbol == "_") continue;
        pause_until(speech.phonemes[i].start);
        add_parts(speech.phonemes[i], gains[i], segments);
        time = speech.phonemes[i].end;
    }
    pause_until(std::max(end, time) + 2 * kReach);
    return segments;
}

bool is_rounding(std::size_t part) {
    const auto name = static_cast<MouthPart>(part);
    return name == MouthPart::pucker || name == MouthPart::funnel || name == MouthPart::stretch;
}

// How far a time lies outside of [start, end].
double distance_to(double time, double start, double end) {
    return std::max({0.0, start - time, time - end});
}

// The blend of the target shapes of all segments around a time.
MouthShape blended(const std::vector<Segment>& segments, double time) {
    std::array<double, kMouthParts> sums{}, weights{};
    const auto first = std::partition_point(segments.begin(), segments.end(), [&](const Segment& segment) {
        return segment.end < time - kReach;
    });
    for (auto segment = first; segment != segments.end() && segment->start < time + kReach; ++segment) {
        const double half = kPlateau * (segment->end - segment->start);
        const double inside = segment->is_pause ? (segment->end - segment->start) / 2 : half;
        const double distance = distance_to(time, segment->middle() - inside, segment->middle() + inside);
        const double opening = segment->shape.opening * std::exp(-distance / kOpeningRange);
        const double rounding = segment->shape.rounding * std::exp(-distance / kRoundingRange);
        for (std::size_t part = 0; part < kMouthParts; ++part) {
            const double weight = is_rounding(part) ? rounding : opening;
            sums[part] += weight * segment->shape.wanted[part];
            weights[part] += weight;
        }
    }
    MouthShape shape;
    for (std::size_t part = 0; part < kMouthParts; ++part)
        shape.wanted[part] = weights[part] > 0 ? sums[part] / weights[part] : 0;
    return shape;
}

// 1 where speech is heard, 0 in pauses but for their edges.
double activity_at(const std::vector<Segment>& segments, double time) {
    double nearest = kEdge;
    const auto first = std::partition_point(
        segments.begin(), segments.end(), [&](const Segment& segment) { return segment.end < time - kEdge; });
    for (auto segment = first; segment != segments.end() && segment->start < time + kEdge; ++segment)
        if (!segment->is_pause) nearest = std::min(nearest, distance_to(time, segment->start, segment->end));
    return smooth_step(1 - nearest / kEdge);
}

// 1 while lips are shut, and for a frame at least; 0 far from it.
double shutness_at(const std::vector<Segment>& segments, double time, double frame) {
    double shutness = 0;
    const auto first = std::partition_point(segments.begin(), segments.end(), [&](const Segment& segment) {
        return segment.end < time - kShutting - frame;
    });
    for (auto segment = first; segment != segments.end() && segment->start < time + kShutting + frame;
         ++segment) {
        if (segment->shape.shut == 0) continue;
        const double spare = std::max(0.0, frame - (segment->end - segment->start)) / 2;
        const double distance = distance_to(time, segment->start - spare, segment->end + spare);
        shutness = std::max(shutness, smooth_step(1 - distance / kShutting));
    }
    return shutness;
}

MouthShape shape_at(const std::vector<Segment>& segments, double time, double frame) {
    MouthShape shape = blended(segments, time);
    const double opening = 1 - shutness_at(segments, time, frame);
    const double activity = activity_at(segments, time);
    for (std::size_t part = 0; part < kMouthParts; ++part)
        shape.wanted[part] *= is_rounding(part) ? activity : activity * opening;
    shape.shut = (1 - opening) * activity;
    return shape;
}

// Without phonemes: the mouth opens as the sound gets louder, from 25 dB under its loudest moments on.
std::vector<MouthShape> shapes_by_loudness(const Audio& sound, std::size_t frames, double fps) {
    constexpr double kHalf = 0.03;  // [s] around a frame
    std::vector<double> levels;
    for (std::size_t t = 0; t < frames; ++t) {
        const double time = static_cast<double>(t) / fps;
        levels.push_back(level_of(sound, time - kHalf, time + kHalf));
    }
    const double loudest = levels.empty() ? 0 : *std::max_element(levels.begin(), levels.end());
    std::vector<MouthShape> shapes(frames);
    for (std::size_t t = 0; t < frames; ++t) {
        const bool is_silent = loudest < kSilentBelow;
        const double loudness = is_silent ? 0 : smooth_step((levels[t] - loudest + 25) / 25);
        shapes[t][MouthPart::lips] = 1.8 * loudness;
        shapes[t][MouthPart::jaw] = 1.6 * loudness;
    }
    return shapes;
}

std::vector<MouthShape> shapes_by_phonemes(const Speech& speech, std::size_t frames, double fps) {
    const std::vector<Segment> segments = segments_of(speech, static_cast<double>(frames) / fps);
    std::vector<MouthShape> shapes;
    for (std::size_t t = 0; t < frames; ++t)
        shapes.push_back(shape_at(segments, static_cast<double>(t) / fps, 1 / fps));
    return shapes;
}

}  // namespace

FaceTrack shape_mouth(const Speech& speech, std::size_t frames, double fps) {
    const std::vector<MouthShape> shapes = speech.phonemes.empty()
                                               ? shapes_by_loudness(speech.audio, frames, fps)
                                               : shapes_by_phonemes(speech, frames, fps);
    FaceTrack track;
    for (const int unit : kMouthUnits) track.channels.push_back({.unit = unit});
    track.channels.push_back({.unit = kPressUnit});
    for (const MouthShape& shape : shapes) {
        for (const double intensity : shape.wanted)
            track.intensities.push_back(static_cast<float>(intensity));
        track.intensities.push_back(static_cast<float>(kPress * shape.shut));
    }
    return track;
}

}  // namespace chironomia
