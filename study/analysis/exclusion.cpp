#include "study/analysis/exclusion.h"

#include "core/text.h"

namespace chironomia::study::analysis {
namespace {

std::string description_of(const FailedCheck& failed) {
    if (failed.fastest > 0)
        return format("{} where {} is needed on page {}", failed.given, failed.expected, failed.page);
    return format("{} is {}, expected {} on page {}", failed.question, failed.given, failed.expected,
                  failed.page);
}

std::string reason_of(const Rater& rater, const ExclusionRules& rules, Strictness strictness) {
    if (rater.answered == 0) return "answered nothing";
    const bool strict = strictness == Strictness::strict;
    const std::size_t limit = strict ? rules.failed_checks : rules.lenient_failed_checks;
    std::vector<std::string> reasons;
    if (rater.failed.size() >= limit) {
        std::vector<std::string> each;
        for (const FailedCheck& failed : rater.failed) each.push_back(description_of(failed));
        reasons.push_back(format("failed {} check{}: {}", rater.failed.size(), each.size() == 1 ? "" : "s",
                                 join(each, "; ")));
    }
    if (strict && !rater.finished) reasons.push_back("did not finish");
    return join(reasons, "; ");
}

template <typename Answer>
void keep(std::vector<Answer>& answers, const std::vector<std::string>& reasons) {
    std::erase_if(answers, [&](const Answer& answer) { return !reasons[answer.participant].empty(); });
}

}  // namespace

const char* to_text(Strictness strictness) {
    return strictness == Strictness::strict ? "strict" : "lenient";
}

std::vector<std::string> reasons_to_exclude(const Dataset& data, Strictness strictness) {
    std::vector<std::string> reasons;
    for (const Rater& rater : data.raters) reasons.push_back(reason_of(rater, data.rules, strictness));
    return reasons;
}

Dataset without_excluded(const Dataset& data, const std::vector<std::string>& reasons) {
    Dataset kept = data;
    keep(kept.preferences, reasons);
    keep(kept.scores, reasons);
    keep(kept.scale_answers, reasons);
    keep(kept.choices, reasons);
    keep(kept.judged, reasons);
    return kept;
}

}  // namespace chironomia::study::analysis
