#include "study/analysis/results.h"

#include <algorithm>

#include "study/analysis/right_results.h"
#include "study/analysis/score_results.h"
#include "study/analysis/vote_results.h"

namespace chironomia::study::analysis {

Results compute_results(const Dataset& data, std::vector<std::string> excluded,
                        const Resampling& resampling) {
    Results results{.excluded = std::move(excluded)};
    results.counted =
        static_cast<std::size_t>(std::count(results.excluded.begin(), results.excluded.end(), ""));
    results.scores = compute_scores(data);
    results.factors = compare_questions(data);
    results.votes = compute_votes(data, resampling);
    results.choices = compute_choices(data);
    results.right = count_right_answers(data);
    results.published = count_as_published(data);
    results.reliability = compute_reliability(data);
    results.agreement = compute_agreement(data);
    return results;
}

}  // namespace chironomia::study::analysis
