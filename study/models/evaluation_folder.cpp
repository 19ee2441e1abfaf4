#include "study/models/evaluation_folder.h"

#include <algorithm>
#include <map>

#include "core/text.h"
#include "study/measure/chunk_scores.h"
#include "study/models/upper_body.h"

namespace chironomia::study {
namespace {

std::string feature_of(const Json& row) {
    return row.value("feature", row.value("metric", ""));
}

// The mean of the rows of one feature, one of each file.
Json mean_row(const std::string& feature, const std::vector<const Json*>& rows,
              std::vector<std::string>& notes) {
    Json mean;
    for (const auto& [key, first] : rows[0]->items()) {
        if (first.is_string()) mean[key] = first;
        if (first.is_string() || key == "ks_p") continue;
        ChunkScores values;
        for (const Json* row : rows) {
            const Json value = row->value(key, Json());
            if (!value.is_number()) continue;
            values.sum += value.get<double>();
            ++values.count;
        }
        mean[key] = or_null(values.mean());
        const auto known = static_cast<std::size_t>(values.count);
        if (known > 0 && known < rows.size()) {
            notes.push_back(
                format("the mean of {}{} is that of {} of {} files; it is not defined in the others", feature,
                       feature.empty() ? key : " " + key, known, rows.size()));
        }
    }
    return mean;
}

std::vector<Json> mean_rows(std::span<const MotionMeasures> all, std::vector<Json> MotionMeasures::*group,
                            std::vector<std::string>& notes) {
    std::vector<std::string> features;
    std::map<std::string, std::vector<const Json*>> rows;
    for (const MotionMeasures& one : all) {
        for (const Json& row : one.*group) {
            const std::string feature = feature_of(row);
            if (rows[feature].empty()) features.push_back(feature);
            rows[feature].push_back(&row);
        }
    }
    std::vector<Json> means;
    for (const std::string& feature : features) {
        if (rows[feature].size() == all.size()) {
            means.push_back(mean_row(feature, rows[feature], notes));
        } else {
            notes.push_back(format("{} of {} files have {}, so it has no mean", rows[feature].size(),
                                   all.size(), feature.empty() ? "a body" : feature));
        }
    }
    return means;
}

void append(PointPaths& all, const PointPaths& paths, const std::vector<std::size_t>& places) {
    for (std::size_t t = 0; t < paths.frames(); ++t) {
        for (const std::size_t place : places) {
            const bool known = place < paths.joints && paths.has(t, place);
            all.points.push_back(known ? paths.points[t * paths.joints + place] : Vec3(0));
            all.missing.push_back(!known);
        }
    }
}

PointPaths changes_of(const PointPaths& paths) {
    PointPaths changes{.fps = paths.fps, .joints = paths.joints, .points = {}};
    for (std::size_t t = 1; t < paths.frames(); ++t) {
        for (std::size_t j = 0; j < paths.joints; ++j) {
            const std::size_t now = t * paths.joints + j, before = now - paths.joints;
            changes.points.push_back((paths.points[now] - paths.points[before]) *
                                     static_cast<float>(paths.fps));
            changes.missing.push_back(!paths.has(t, j) || !paths.has(t - 1, j));
        }
    }
    return changes;
}

}  // namespace

MotionMeasures mean_of(const std::string& of, std::span<const MotionMeasures> all) {
    MotionMeasures mean{.source = format("{}: mean of {}", of, all.size())};
    for (const auto group : {&MotionMeasures::body, &MotionMeasures::face, &MotionMeasures::near,
                             &MotionMeasures::style, &MotionMeasures::pair, &MotionMeasures::beats})
        mean.*group = mean_rows(all, group, mean.notes);
    for (std::string& note : mean.notes) note = format("{}: {}", of, note);
    return mean;
}

PoseClouds::PoseClouds() : shared_(kUpperBody.size(), true) {
    for (PointPaths* paths : {&people_.poses, &people_.changes, &model_.poses, &model_.changes})
        paths->joints = kUpperBody.size();
}

void PoseClouds::add(const Motion& motion, const Motion& reference) {
    std::vector<std::string> notes;  // measure_against has them
    const auto [ours, truth] = aligned(motion, reference, notes);
    const auto people = body_of(truth, Origin::shoulders), model = body_of(ours, Origin::shoulders);
    if (!people || !model || !people->in_shoulders || !model->in_shoulders) return;
    for (const auto& [body, cloud] : {std::pair{&*people, &people_}, std::pair{&*model, &model_}}) {
        std::vector<std::size_t> places;
        for (std::size_t k = 0; k < kUpperBody.size(); ++k) {
            const auto found = std::ranges::find(body->points, kUpperBody[k]);
            places.push_back(static_cast<std::size_t>(found - body->points.begin()));
            if (found == body->points.end()) shared_[k] = false;
        }
        flat_ = flat_ || !is_in_space(body->paths);
        append(cloud->poses, body->paths, places);
        append(cloud->changes, changes_of(body->paths), places);
    }
}

std::optional<Json> PoseClouds::row() const {
    std::vector<std::size_t> points;
    for (std::size_t k = 0; k < shared_.size(); ++k)
        if (shared_[k]) points.push_back(k);
    if (people_.poses.points.empty() || points.empty()) return std::nullopt;
    const Axes axes = flat_ ? Axes::picture : Axes::space;
    const auto distance = [&](const PointPaths& people, const PointPaths& model) {
        return or_null(pose_distance(paths_of(people, points), paths_of(model, points), axes));
    };
    return Json{{"feature", "body"},
                {"frames", people_.poses.frames()},
                {"points", points.size()},
                {"frechet", distance(people_.poses, model_.poses)},
                {"velocity_frechet", distance(people_.changes, model_.changes)}};
}

}  // namespace chironomia::study
