#include "study/models/evaluation_motion.h"

#include <algorithm>
#include <array>
#include <numeric>
#include <optional>
#include <set>
#include <span>

#include "core/error.h"
#include "core/text.h"
#include "skinning/signal/late_beginning.h"
#include "skinning/signal/resample.h"
#include "study/measure/adaptation.h"
#include "study/measure/beat_alignment.h"
#include "study/measure/chunk_scores.h"
#include "study/measure/kolmogorov.h"
#include "study/measure/lagged_correlation.h"
#include "study/measure/likeness.h"
#include "study/measure/movement.h"
#include "study/measure/pointwise.h"
#include "study/measure/pose_errors.h"
#include "study/measure/style_distance.h"
#include "study/measure/time_warping.h"
#include "study/models/upper_body.h"
#include "synth/corpus/face_features.h"
#include "synth/features/spectrum.h"

namespace chironomia::study {
namespace {

constexpr double kActiveIntensity = 0.5;  // of an intensity
constexpr int kSmileUnit = 12;

std::vector<std::size_t> wrists_of(const std::vector<Landmark>& points) {
    std::vector<std::size_t> wrists;
    for (std::size_t i = 0; i < points.size(); ++i) {
        if (points[i] == Landmark::left_wrist || points[i] == Landmark::right_wrist) wrists.push_back(i);
    }
    return wrists;
}

Json describe_body(const PointPaths& paths, const BodyPaths& body, const std::vector<Landmark>& points) {
    const Kinematics all = kinematics(paths), hands = kinematics(paths_of(paths, wrists_of(points)));
    const auto missing = std::count(paths.missing.begin(), paths.missing.end(), true);
    return {{"points", points.size()},
            {"unit", body.in_shoulders ? "shoulders" : "file"},
            {"missing", static_cast<double>(missing) / static_cast<double>(paths.missing.size())},
            {"velocity", or_null(all.velocity)},
            {"acceleration", or_null(all.acceleration)},
            {"jerk", or_null(all.jerk)},
            {"wrist_velocity", or_null(hands.velocity)},
            {"wrist_acceleration", or_null(hands.acceleration)},
            {"wrist_jerk", or_null(hands.jerk)},
            {"box", or_null(box_perimeter(paths))},
            {"extent", or_null(spatial_extent(paths))}};
}

// A face as columns: units by number, then what it has of head and gaze, in OpenFace's terms.
struct FaceColumns {
    std::string source;
    std::vector<std::string> names;
    std::vector<std::vector<float>> series;  // by column, (T)
    std::vector<bool> seen;                  // (T) false: the frame was bridged by its reader
};

std::vector<int> units_of(const FaceTrack& face) {
    std::set<int> units;
    for (const FaceChannel& channel : face.channels) units.insert(channel.unit);
    return {units.begin(), units.end()};
}

FaceColumns columns_of(const Motion& motion) {
    const FaceTrack& face = *motion.face;
    FaceColumns columns{.source = motion.source};
    columns.seen.assign(motion.frames, true);
    for (std::size_t t = 0; t < face.confidence.size(); ++t) columns.seen[t] = face.confidence[t] > 0;
    const std::vector<int> units = units_of(face);
    const std::vector<float> rows = intensities_of(face, motion.frames, units);
    for (std::size_t u = 0; u < units.size(); ++u) {
        columns.names.push_back(format("AU{}", units[u]));
        columns.series.emplace_back();
        for (std::size_t t = 0; t < motion.frames; ++t)
            columns.series.back().push_back(rows[t * units.size() + u]);
    }
    if (!face.head.empty()) {
        for (int axis = 0; axis < 3; ++axis) {
            columns.names.push_back(format("R{}", "xyz"[axis]));
            columns.series.emplace_back();
            for (const Quat& head : face.head) columns.series.back().push_back(openface_angles(head)[axis]);
        }
    }
    if (!face.gaze.empty()) {
        for (int axis = 0; axis < 2; ++axis) {
            columns.names.push_back(format("gaze_angle_{}", "xy"[axis]));
            columns.series.emplace_back();
            for (std::size_t t = 0; t < motion.frames; ++t) {
                const Quat head = face.head.empty() ? Quat(1, 0, 0, 0) : face.head[t];
                columns.series.back().push_back(openface_gaze(face.gaze[t], head)[axis]);
            }
        }
    }
    return columns;
}

// Of frames that were seen.
Json describe_series(std::span<const float> series, const std::vector<bool>& seen, double fps) {
    ChunkScores values, squares, ways, active;
    for (std::size_t t = 0; t < series.size(); ++t) {
        if (!seen[t]) continue;
        values.sum += series[t];
        ++values.count;
        active.sum += series[t] > kActiveIntensity;
        ++active.count;
        if (t == 0 || !seen[t - 1]) continue;
        ways.sum += std::abs(double(series[t]) - series[t - 1]);
        ++ways.count;
    }
    const auto mean = values.mean(), change = ways.mean();
    for (std::size_t t = 0; mean && t < series.size(); ++t)
        if (seen[t]) squares.sum += (series[t] - *mean) * (series[t] - *mean);
    squares.count = values.count;
    return {{"mean", or_null(mean)},
            {"sd", mean ? Json(std::sqrt(*squares.mean())) : Json()},
            {"per_second", change ? Json(*change * fps) : Json()},
            {"active", or_null(active.mean())}};
}

Json describe_face(const Motion& motion) {
    Json rows = Json::array();
    const FaceColumns columns = columns_of(motion);
    const auto lost = std::count(columns.seen.begin(), columns.seen.end(), false);
    for (std::size_t c = 0; c < columns.names.size(); ++c) {
        Json row = {{"feature", columns.names[c]},
                    {"missing", static_cast<double>(lost) / static_cast<double>(columns.seen.size())}};
        row.update(describe_series(columns.series[c], columns.seen, motion.fps));
        if (!columns.names[c].starts_with("AU")) row.erase("active");
        rows.push_back(std::move(row));
    }
    return rows;
}

// More than rounding lets turns differ that were the same angles in the file [intensities, rad].
bool varies(std::span<const float> series) {
    const auto [least, most] = std::ranges::minmax(series);
    return most - least > 1e-6f;
}

Json compare_series(const std::string& name, std::span<const float> truth, std::span<const float> ours) {
    const PairSums sums = sums_of(truth, ours, kActiveIntensity);
    const KolmogorovSmirnov spread = kolmogorov_smirnov(truth, ours);
    const bool vary = varies(truth) && varies(ours);
    Json row = {{"feature", name},
                {"frames", truth.size()},
                {"rmse", or_null(rmse(sums))},
                {"mae", or_null(mean_absolute_error(sums))},
                {"pcc", vary ? or_null(pearson(truth, ours)) : Json()},
                {"ks", spread.distance},
                {"ks_p", spread.p}};
    if (!name.starts_with("AU")) return row;
    const HitRates rates = hit_rates(sums);
    row["ahr"] = or_null(rates.ahr);
    row["nahr"] = or_null(rates.nahr);
    row["precision"] = or_null(rates.precision);
    row["recall"] = or_null(rates.recall);
    return row;
}

// The numbers of the frames in which both faces were seen.
std::vector<float> seen_in_both(const std::vector<float>& series, const FaceColumns& a,
                                const FaceColumns& b) {
    std::vector<float> seen;
    for (std::size_t t = 0; t < series.size(); ++t)
        if (a.seen[t] && b.seen[t]) seen.push_back(series[t]);
    return seen;
}

// What a face has and the other lacks is compared with nothing.
void note_missing(const FaceColumns& face, const FaceColumns& other, std::vector<std::string>& notes) {
    std::vector<std::string> missing;
    for (const std::string& name : face.names)
        if (std::ranges::find(other.names, name) == other.names.end()) missing.push_back(name);
    if (!missing.empty())
        notes.push_back(
            format("{}: has {}, which {} lacks; not compared", face.source, join(missing), other.source));
}

// Minkowski's and Frechet's distances and content preservation take the frames in which both have all points that they
// share.
std::optional<Json> compare_bodies(const BodyPaths& truth, const BodyPaths& ours, Axes axes) {
    const std::vector<Landmark> shared = shared_points(std::array{truth, ours});
    PointPaths a = paths_of(truth, shared), b = paths_of(ours, shared);
    for (std::size_t i = 0; i < a.missing.size(); ++i)
        a.missing[i] = b.missing[i] = a.missing[i] || b.missing[i];
    std::vector<float> x, z;
    for (std::size_t t = 0; t < a.frames(); ++t) {
        bool known = true;
        for (std::size_t j = 0; j < a.joints; ++j) known = known && a.has(t, j);
        for (std::size_t j = 0; known && j < a.joints; ++j) {
            const Vec3 &p = a.points[t * a.joints + j], &q = b.points[t * a.joints + j];
            x.insert(x.end(), {p.x, p.y, p.z});
            z.insert(z.end(), {q.x, q.y, q.z});
        }
    }
    if (x.empty()) return std::nullopt;
    const std::size_t width = 3 * a.joints;
    const PoseErrors errors = pose_errors(a, b, axes);
    return Json{{"feature", "body"},
                {"frames", x.size() / width},
                {"minkowski_1", minkowski_distance(x, z, width, 1)},
                {"minkowski_2", minkowski_distance(x, z, width, 2)},
                {"minkowski_3", minkowski_distance(x, z, width, 3)},
                {"content", or_null(content_preservation(x, z))},
                {"content_centred", or_null(content_preservation(x, z, Centring::centred))},
                {"l1", or_null(errors.l1)},
                {"velocity_l1", or_null(errors.velocity_l1)},
                {"pck_01", or_null(errors.pck_01)},
                {"pck_02", or_null(errors.pck_02)},
                {"frechet", or_null(pose_distance(a, b, axes))}};
}

// TLCC, DTW and the like need series without gaps.
void note_bridged(const Motion& motion, std::vector<std::string>& notes) {
    const std::vector<float>& sure = motion.face->confidence;
    const auto lost =
        std::count_if(sure.begin(), sure.end(), [](float confidence) { return confidence <= 0; });
    if (lost > 0)
        notes.push_back(format(
            "{}: the face is lost in {} of {} frames; smiles of both people take lines over these gaps",
            motion.source, lost, sure.size()));
}

std::vector<float> smile_of(const Motion& motion) {
    const bool known = motion.face && [&] {
        const std::vector<int> units = units_of(*motion.face);
        return std::find(units.begin(), units.end(), kSmileUnit) != units.end();
    }();
    if (!known) {
        throw Error(format("{}: it has no AU12, by which two people are compared; give a face with it",
                           motion.source));
    }
    return intensities_of(*motion.face, motion.frames, std::array<int, 1>{kSmileUnit});
}

}  // namespace

std::pair<Motion, Motion> aligned(const Motion& motion, const Motion& other,
                                  std::vector<std::string>& notes) {
    if (motion.fps != other.fps) {
        notes.push_back(format("{}: {:g} frames/s, resampled to the {:g} of {}", motion.source, motion.fps,
                               other.fps, other.source));
    }
    const auto first = late_beginning_of(motion), other_first = late_beginning_of(other);
    if (first.value_or(0) != other_first.value_or(0)) {
        notes.push_back(
            format("{}: its times begin at {:.6g} s, those of {} at {:.6g} s; compared from their first "
                   "frames on",
                   motion.source, first.value_or(0), other.source, other_first.value_or(0)));
    }
    const Motion same_rate = motion.fps == other.fps ? motion : resample(motion, other.fps);
    const size_t frames = std::min(same_rate.frames, other.frames);
    if (same_rate.frames != other.frames) {
        notes.push_back(format("{}: {:.2f} s and {:.2f} s of {}; compared over the first {:.2f} s",
                               motion.source, duration(motion), duration(other), other.source,
                               static_cast<double>(frames) / other.fps));
    }
    return {resample(same_rate, other.fps, frames), resample(other, other.fps, frames)};
}

std::vector<MotionMeasures> measure_motions(std::span<const Motion> motions) {
    std::vector<const Motion*> with_bodies;
    for (const Motion& motion : motions) {
        if (body_of(motion, Origin::shoulders)) with_bodies.push_back(&motion);
    }
    const Origin origin = shared_origin(with_bodies);
    std::vector<BodyPaths> bodies;
    for (const Motion* motion : with_bodies) bodies.push_back(*body_of(*motion, origin));
    const std::vector<Landmark> points = shared_points(bodies);
    const Motion& slowest = *std::ranges::min_element(motions, {}, &Motion::fps);
    const bool has_space =
        std::ranges::any_of(bodies, [](const BodyPaths& body) { return is_in_space(body.paths); });
    std::vector<MotionMeasures> all;
    auto body = bodies.begin();
    for (const Motion& motion : motions) {
        MotionMeasures& measures = all.emplace_back(MotionMeasures{.source = motion.source});
        if (motion.fps != slowest.fps) {
            measures.notes.push_back(
                format("{}: {:g} frames/s, measured at the {:g} of {}, so that velocity and jerk compare",
                       motion.source, motion.fps, slowest.fps, slowest.source));
        }
        if (body != bodies.end() && &motion == with_bodies[std::size_t(body - bodies.begin())]) {
            if (!points.empty())
                measures.body.push_back(
                    describe_body(paths_at(paths_of(*body, points), slowest.fps), *body, points));
            if (points.size() < body->points.size()) {
                measures.notes.push_back(
                    format("{}: measured over {} of its {} points, those that all motions have",
                           motion.source, points.size(), body->points.size()));
            }
            if (has_space && !is_in_space(body->paths)) {
                measures.notes.push_back(
                    format("{}: it has no depth, and others here have; in space velocities and the like are "
                           "greater, so compare it with them by --against",
                           motion.source));
            }
            ++body;
        }
        if (measures.body.empty() && !motion.face) {
            measures.notes.push_back(format(
                "{}: neither shoulders nor a face are known in it, so nothing was measured", motion.source));
        }
        if (!motion.face) continue;
        for (Json& row : describe_face(motion.fps == slowest.fps ? motion : resample(motion, slowest.fps)))
            measures.face.push_back(std::move(row));
    }
    return all;
}

void measure_against(const Motion& motion, const Motion& reference, MotionMeasures& measures) {
    const auto [ours, truth] = aligned(motion, reference, measures.notes);
    if (ours.face && truth.face) {
        const FaceColumns a = columns_of(truth), b = columns_of(ours);
        note_missing(b, a, measures.notes);
        note_missing(a, b, measures.notes);
        for (std::size_t c = 0; c < b.names.size(); ++c) {
            const auto found = std::find(a.names.begin(), a.names.end(), b.names[c]);
            if (found == a.names.end()) continue;
            const auto& series = a.series[static_cast<std::size_t>(found - a.names.begin())];
            const std::vector<float> known = seen_in_both(series, a, b);
            if (known.empty()) {
                throw Error(format(
                    "{} and {}: there is no frame in which both faces were seen; give recordings that share some",
                    motion.source, reference.source));
            }
            measures.near.push_back(compare_series(b.names[c], known, seen_in_both(b.series[c], a, b)));
        }
    }
    const Origin origin = shared_origin(std::array{&truth, &ours});
    auto a = body_of(truth, origin), b = body_of(ours, origin);
    if (a && b) {
        const bool in_space = is_in_space(a->paths) && is_in_space(b->paths);
        if (is_in_space(a->paths) != is_in_space(b->paths)) {
            measures.notes.push_back(format("{} and {}: one has no depth; compared as seen from the front",
                                            motion.source, reference.source));
            a = body_of(truth, origin, Axes::picture);
            b = body_of(ours, origin, Axes::picture);
        }
        const bool in_shoulders = a->in_shoulders && b->in_shoulders;
        if (auto row =
                in_shoulders ? compare_bodies(*a, *b, in_space ? Axes::space : Axes::picture) : std::nullopt)
            measures.near.push_back(std::move(*row));
    }
    if (measures.near.empty()) {
        throw Error(
            format("{} and {}: they share neither a feature of a face nor a point of a body; give a "
                   "reference of the same kind",
                   motion.source, reference.source));
    }
}

void measure_style(const Motion& motion, const Motion& source, const Motion& target,
                   MotionMeasures& measures) {
    const std::array people = {&source, &target, &motion};
    const Origin origin = shared_origin(people);
    const Motion& slowest =
        **std::ranges::min_element(people, {}, [](const Motion* one) { return one->fps; });
    if (std::ranges::any_of(people, [&](const Motion* one) { return one->fps != slowest.fps; })) {
        measures.notes.push_back(
            format("{}: its style is measured at the {:g} frames/s of {}, the slowest of the three",
                   motion.source, slowest.fps, slowest.source));
    }
    std::vector<BodyPaths> bodies;
    for (const Motion* one : people) {
        const auto body = body_of(*one, origin);
        if (!body || !body->in_shoulders) {
            throw Error(
                format("{}: it has no body with both shoulders, in whose widths styles are compared; "
                       "give a motion that has them",
                       one->source));
        }
        bodies.push_back(*body);
    }
    const std::vector<Landmark> shared = shared_points(bodies);
    std::vector<PointPaths> paths;
    for (const BodyPaths& body : bodies) paths.push_back(paths_at(paths_of(body, shared), slowest.fps));
    const bool in_space = std::ranges::all_of(paths, is_in_space);
    std::vector<StyleMetrics> metrics;
    for (PointPaths& one : paths) {
        if (!in_space) {
            for (Vec3& point : one.points) point.z = 0;
        }
        metrics.push_back(style_metrics(one, wrists_of(shared)));
    }
    const ClipStyles clip{.source = metrics[0], .target = metrics[1], .model = metrics[2]};
    const auto distances = style_distances(std::span(&clip, 1));
    for (std::size_t m = 0; m < kStyleMetricNames.size(); ++m) {
        const auto& distance = distances[m];
        measures.style.push_back({{"metric", kStyleMetricNames[m]},
                                  {"source", or_null(clip.source[m])},
                                  {"target", or_null(clip.target[m])},
                                  {"model", or_null(clip.model[m])},
                                  {"dist_avg_source", distance ? Json(distance->source) : Json()},
                                  {"dist_avg_model", distance ? Json(distance->model) : Json()}});
    }
}

void measure_pair(const Motion& motion, const Motion& partner, MotionMeasures& measures) {
    const auto [a, u] = aligned(motion, partner, measures.notes);
    const std::vector<float> mine = smile_of(a), theirs = smile_of(u);
    for (const Motion* person : {&a, &u}) note_bridged(*person, measures.notes);
    const LaggedCorrelation lagged = lagged_correlation(mine, theirs, u.fps);
    ChunkScores lags{.count = static_cast<double>(lagged.peaks.size())};
    lags.sum = std::accumulate(lagged.peaks.begin(), lagged.peaks.end(), 0.0);
    const ChunkScores costs = warping_costs(mine, theirs, u.fps);
    if (!lagged.scores.mean()) measures.notes.push_back("TLCC: there are no 8 s in which both smiles vary");
    if (!costs.mean()) measures.notes.push_back("DTW: both together are shorter than 60 s");
    Json row = {{"tlcc", or_null(lagged.scores.mean())},
                {"lag", or_null(lags.mean())},
                {"dtw", or_null(costs.mean())}};
    const PairedRuns runs{
        .a = active_runs(mine, u.fps), .u = active_runs(theirs, u.fps), .frames = mine.size(), .fps = u.fps};
    for (const AdaptationMeasure& measure : adaptation_measures()) row[measure.key] = measure.measure(runs);
    measures.pair.push_back(std::move(row));
}

void measure_beats(const Motion& motion, const Audio& sound, MotionMeasures& measures) {
    const auto body = body_of(motion, Origin::shoulders);
    if (!body || !body->in_shoulders) {
        measures.notes.push_back(
            format("{}: has no shoulders, so its beats were not measured", motion.source));
        return;
    }
    const FeatureTrack mel = log_mel_400(sound);
    constexpr double kMiddle = 256.0 / 16000;  // [s] of its first frame
    std::vector<double> onsets =
        onset_times({.values = mel.values, .bands = mel.width(), .rate = mel.rate, .first = kMiddle});
    const double seconds = std::min(duration(motion), sound.duration());
    if (std::abs(duration(motion) - sound.duration()) > 0.5) {
        measures.notes.push_back(
            format("{}: {:.2f} s, and its sound {:.2f} s; beats are those of the first {:.2f} s",
                   motion.source, duration(motion), sound.duration(), seconds));
    }
    std::vector<double> beats = kinematic_beats(body->paths);
    for (std::vector<double>* times : {&beats, &onsets})
        std::erase_if(*times, [&](double time) { return time > seconds; });
    const double sigma = BeatOptions{}.sigma;
    measures.beats.push_back({{"beats", beats.size()},
                              {"onsets", onsets.size()},
                              {"alignment", or_null(beat_alignment(beats, onsets, sigma))},
                              {"chance", or_null(chance_alignment(beats, onsets, sigma, seconds))}});
}

}  // namespace chironomia::study
