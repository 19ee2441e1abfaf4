// Stands in for the renderer: its clips hold the recipe that they were made by, and no pictures.
#pragma once

#include <atomic>
#include <map>
#include <memory>

#include "core/error.h"
#include "core/files/files.h"
#include "core/hash.h"
#include "study/build/videos.h"
#include "tests/study/tiny_clips.h"

namespace chironomia::testing {

using namespace study;

struct FakeMaker {
    std::map<std::string, double> lengths;  // of motions by what their files hold [s]; 2 s for all others
    std::string faced = "no motion";        // what a file holds whose motion has a face
    std::shared_ptr<int> recorded = std::make_shared<int>(0);  // in this process
    std::function<void(const ClipJob&)> before = [](const ClipJob&) {};

    double length_of(const std::filesystem::path& motion) const {
        const auto found = lengths.find(read_text(motion));
        return found == lengths.end() ? 2.0 : found->second;
    }

    static std::filesystem::path source_of(const Performer& performer) {
        return performer.film.empty() ? performer.motion : performer.film;
    }

    static Json recipe(const ClipJob& job) {
        Json recipe = {{"size", {job.size.width, job.size.height}},
                       {"fps", to_text(job.fps)},
                       {"upper_body", job.upper_body},
                       {"renderer", to_text(job.drawing.renderer)},
                       {"samples", job.drawing.samples},
                       {"scene", job.scene.string()},
                       {"at_least", job.at_least.value_or(0)}};
        for (const Performer& performer : job.performers) {
            recipe["motions"].push_back(sha256_of_file(source_of(performer)));
            recipe["modes"].push_back(to_json(performer.modes));
            if (performer.anchor) recipe["anchors"].push_back(to_text(*performer.anchor));
        }
        if (job.audio) recipe["audio"] = sha256_of_file(*job.audio);
        if (job.notice) recipe["notice"] = job.notice->text;
        if (job.spoken) recipe["spoken"] = job.spoken->text;
        return recipe;
    }

    double motion_length(const ClipJob& job) const {
        double longest = 0;
        for (const Performer& performer : job.performers)
            longest = std::max(longest, length_of(source_of(performer)));
        return longest;
    }

    ClipMotions motions(const ClipJob& job) const {
        ClipMotions all{.length = motion_length(job), .shown_face = {}};
        all.is_film = !job.performers.front().film.empty();
        for (const Performer& performer : job.performers)
            all.shown_face.push_back(performer.face || read_text(source_of(performer)) == faced);
        return all;
    }

    ClipResult record(const ClipJob& job) const {
        before(job);
        ++*recorded;
        // A longer file for some, so that sizes differ before they are padded.
        const std::string hash = sha256(recipe(job).dump());
        const std::string payload = hash + std::string(static_cast<std::size_t>(hash[0]) % 7, '.');
        write_text(job.out, job.out.extension() == ".webm" ? tiny_webm(payload) : tiny_mp4(payload));
        const double seconds = job.at_least.value_or(0);
        ClipResult result{.frames = static_cast<std::size_t>(seconds * job.fps.per_second() + 0.5),
                          .seconds = seconds,
                          .warnings = {},
                          .report = {{"mean_mm", 1.5}}};
        if (motion_length(job) < seconds) result.warnings.push_back("the last pose is held for a while");
        return result;
    }

    ClipMaker maker() const {
        return {.record = [self = *this](const ClipJob& job) { return self.record(job); },
                .recipe = recipe,
                .motions = [self = *this](const ClipJob& job) { return self.motions(job); }};
    }
};

}  // namespace chironomia::testing
