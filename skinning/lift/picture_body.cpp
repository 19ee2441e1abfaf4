#include "skinning/lift/picture_body.h"

#include <cmath>
#include <optional>

#include "skinning/lift/zero_phase.h"

namespace chironomia {
namespace {

constexpr double kLowestCutoff = 1.2;  // [Hz]
constexpr double kSpare = 1.08;        // how much more than noise a cutoff may take, mean square
constexpr size_t kEnoughToJudge = 24;  // samples

constexpr size_t index_of(Landmark landmark) {
    return static_cast<size_t>(landmark);
}

PictureBody seen_points(const PictureTrack& track, size_t frames) {
    PictureBody body;
    body.places.resize(frames);
    body.there.resize(frames);
    const size_t count = track.names.size();
    for (size_t k = 0; k < count; ++k) {
        const auto landmark = landmark_named(track.names[k]);
        if (!landmark) continue;
        size_t seen = 0;
        for (size_t t = 0; t < frames; ++t) seen += track.confidence[t * count + k] >= kSeen;
        if (seen * 10 < frames || seen == 0) continue;
        body.known.set(index_of(*landmark));
        for (size_t t = 0; t < frames; ++t) {
            body.places[t][index_of(*landmark)] = track.points[t * count + k];
            body.there[t][index_of(*landmark)] = track.confidence[t * count + k] >= kSeen;
        }
    }
    return body;
}

LandmarkGaps bridge(PictureBody& body, Landmark landmark, size_t longest) {
    LandmarkGaps gaps{.landmark = landmark};
    const size_t l = index_of(landmark);
    std::optional<size_t> last;
    for (size_t t = 0; t < body.frames(); ++t) {
        if (!body.there[t][l]) continue;
        const size_t missing = last ? t - *last - 1 : t;
        if (last && missing <= longest) {
            for (size_t i = 1; i <= missing; ++i) {
                const float share = static_cast<float>(i) / static_cast<float>(missing + 1);
                body.places[*last + i][l] = glm::mix(body.places[*last][l], body.places[t][l], share);
                body.there[*last + i].set(l);
            }
            gaps.bridged += missing;
        } else {
            gaps.rested += missing;
        }
        last = t;
    }
    gaps.rested += body.frames() - (last ? *last + 1 : 0);
    return gaps;
}

double mean_square(const std::vector<double>& a, const std::vector<double>& b) {
    double sum = 0;
    for (size_t i = 0; i < a.size(); ++i) sum += (a[i] - b[i]) * (a[i] - b[i]);
    return sum / static_cast<double>(a.size());
}

// The lowest cutoff that takes nothing but noise: what is above the highest one is all noise, which is even
// over the frequencies, so that each lower cutoff should take its share more of it. After Winter,
// "Biomechanics and Motor Control of Human Movement", 4th ed., 2009, section 3.4.4.3, residual analysis.
std::vector<double> without_noise(const std::vector<double>& samples, const PictureCleaning& cleaning) {
    const double half_rate = cleaning.fps / 2;
    std::vector<double> best = zero_phase_low_pass(samples, cleaning.cutoff, cleaning.fps);
    if (cleaning.cutoff >= 0.8 * half_rate || samples.size() < kEnoughToJudge) return best;
    const double noise = mean_square(samples, best) / (1 - cleaning.cutoff / half_rate);
    for (double cutoff = kLowestCutoff; cutoff < cleaning.cutoff; cutoff *= 1.25) {
        std::vector<double> lower = zero_phase_low_pass(samples, cutoff, cleaning.fps);
        if (mean_square(samples, lower) <= kSpare * noise * (1 - cutoff / half_rate)) return lower;
    }
    return best;
}

void smooth(PictureBody& body, size_t l, const PictureCleaning& cleaning) {
    for (size_t first = 0; first < body.frames();) {
        size_t last = first;
        while (last < body.frames() && body.there[last][l]) ++last;
        for (int axis = 0; axis < 2 && last > first; ++axis) {
            std::vector<double> samples;
            for (size_t t = first; t < last; ++t)
                samples.push_back(static_cast<double>(body.places[t][l][axis]));
            samples = without_noise(samples, cleaning);
            for (size_t t = first; t < last; ++t)
                body.places[t][l][axis] = static_cast<float>(samples[t - first]);
        }
        first = last + 1;
    }
}

void add_middle(PictureBody& body, Landmark middle, Landmark left, Landmark right) {
    for (size_t t = 0; t < body.frames(); ++t) {
        if (body.sees(t, middle) || !body.sees(t, left) || !body.sees(t, right)) continue;
        body.places[t][index_of(middle)] = (body.at(t, left) + body.at(t, right)) * 0.5f;
        body.there[t].set(index_of(middle));
        body.known.set(index_of(middle));
    }
}

}  // namespace

CleanPicture clean_picture(const PictureTrack& track, size_t frames, const PictureCleaning& cleaning) {
    CleanPicture clean{.body = seen_points(track, frames), .gaps = {}};
    PictureBody& body = clean.body;
    const auto longest = static_cast<size_t>(std::lround(cleaning.longest_bridge * cleaning.fps));
    for (size_t l = 0; l < kLandmarks; ++l) {
        if (!body.known[l]) continue;
        const LandmarkGaps gaps = bridge(body, static_cast<Landmark>(l), longest);
        if (gaps.bridged + gaps.rested > 0) clean.gaps.push_back(gaps);
        if (cleaning.cutoff > 0) smooth(body, l, cleaning);
    }
    add_middle(body, Landmark::thorax, Landmark::left_shoulder, Landmark::right_shoulder);
    add_middle(body, Landmark::pelvis, Landmark::left_hip, Landmark::right_hip);
    return clean;
}

}  // namespace chironomia
