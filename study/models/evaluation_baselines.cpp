#include "study/models/evaluation_baselines.h"

#include <algorithm>
#include <cmath>
#include <map>

#include "core/error.h"
#include "core/text.h"
#include "study/models/recorded_rows.h"

namespace chironomia::study {
namespace {

constexpr double kHeld = 0.5;  // [s]

// Sums over frames, by feature and on its scale.
class Means {
  public:
    explicit Means(const Predictions& of) : sums_(of.features.size()), counts_(of.features.size()) {
        for (std::size_t f = 0; f < of.features.size(); ++f) place_[of.features[f]] = f;
        scale_ = of.scale;
    }

    void add(const std::vector<std::string>& names, const std::vector<float>& rows) {
        for (std::size_t i = 0; i < rows.size(); ++i) {
            const auto found = place_.find(names[i % names.size()]);
            if (found == place_.end()) continue;
            const auto [low, high] = scale_[found->second];
            sums_[found->second] += std::clamp((rows[i] - low) / (high - low), 0.0, 1.0);
            ++counts_[found->second];
        }
    }

    // Throws Error if nothing was added for a feature.
    std::vector<double> means(const std::string& corpus) const {
        std::vector<double> all(sums_.size());
        for (const auto& [name, f] : place_) {
            if (counts_[f] == 0) {
                throw Error(format("{}: its training records have no \"{}\"; leave out --against mean",
                                   corpus, name));
            }
            all[f] = sums_[f] / counts_[f];
        }
        return all;
    }

  private:
    std::map<std::string, std::size_t> place_;
    std::vector<std::array<double, 2>> scale_;
    std::vector<double> sums_, counts_;
};

std::vector<double> training_means(const Predictions& of, const CorpusIndex& corpus) {
    Means means(of);
    for (const CorpusEntry& entry : corpus.of(Split::train))
        for (const RecordedRows& person : recorded_rows(corpus, entry))
            means.add(person.features, person.values);
    return means.means(corpus.folder.string());
}

Predictions held(Predictions predictions) {
    const std::size_t width = predictions.features.size();
    const auto late = static_cast<std::size_t>(std::lround(kHeld * predictions.fps));
    for (PredictedItem& item : predictions.items) {
        for (std::size_t i = 0; i < item.prediction.size(); ++i) {
            const std::size_t frame = i / width;
            item.prediction[i] = item.truth[(frame < late ? 0 : frame - late) * width + i % width];
        }
    }
    return predictions;
}

Predictions constant(Predictions predictions, const std::vector<double>& means) {
    for (PredictedItem& item : predictions.items) {
        for (std::size_t i = 0; i < item.prediction.size(); ++i)
            item.prediction[i] = static_cast<float>(means[i % means.size()]);
    }
    return predictions;
}

}  // namespace

const std::vector<std::string>& baseline_names() {
    static const std::vector<std::string> names = {"hold", "mean"};
    return names;
}

void check_baseline(const std::string& name, const CorpusIndex& corpus) {
    if (name != "mean" || corpus.kind != CorpusKind::intervals) return;
    throw Error(format(
        "{}: --against mean is made of faces, in talks and dyads, and this corpus has intervals, which "
        "are of bodies; leave it out",
        corpus.folder.string()));
}

Predictions baseline(const std::string& name, const Predictions& of, const CorpusIndex& corpus) {
    check_baseline(name, corpus);
    Predictions made = name == "hold" ? held(of) : constant(of, training_means(of, corpus));
    made.model = name;
    return made;
}

}  // namespace chironomia::study
