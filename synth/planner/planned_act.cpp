#include "synth/planner/planned_act.h"

#include <algorithm>
#include <optional>

namespace chironomia {
namespace {

// What a mark sets for the marks inside it.
struct Enclosing {
    std::size_t end_word = 0;
    LocalManner manner;
};

LocalManner merged(LocalManner outer, const LocalManner& inner) {
    for (std::size_t i = 0; i < kExpressivities; ++i)
        if (inner.values[i]) outer.values[i] = inner.values[i];
    return outer;
}

// A whole clause or more is shown with its nuclear accent, a word with its own stress.
std::size_t word_of(const Mark& mark, const Accents& accents, std::size_t word_count) {
    if (mark.first_word == mark.end_word) return std::min(mark.first_word, word_count - 1);
    const bool is_wide = mark.kind == MarkKind::rheme || mark.kind == MarkKind::theme ||
                         mark.kind == MarkKind::performative || mark.kind == MarkKind::belief_relation ||
                         mark.kind == MarkKind::emotion || mark.kind == MarkKind::turn;
    if (is_wide) {
        if (const std::optional<std::size_t> word = accents.nuclear_word(mark.first_word, mark.end_word))
            return *word;
    } else if (const Accents::Range range = accents.within(mark.first_word, mark.end_word); !range.empty()) {
        return accents.all()[range.first].word;
    }
    return accents.last_content_word(mark.first_word, mark.end_word);
}

}  // namespace

std::vector<PlannedAct> perform(const Speech& speech, const Accents& accents, const Manner& speaker) {
    std::vector<PlannedAct> acts;
    std::vector<Enclosing> enclosing;
    for (std::size_t i = 0; i < speech.marks.size(); ++i) {
        const Mark& mark = speech.marks[i];
        while (!enclosing.empty() && enclosing.back().end_word <= mark.first_word) enclosing.pop_back();
        LocalManner manner = mark.manner;
        const auto around = std::find_if(enclosing.rbegin(), enclosing.rend(),
                                         [&](const Enclosing& one) { return one.end_word >= mark.end_word; });
        if (around != enclosing.rend()) manner = merged(around->manner, manner);
        if (mark.manner != LocalManner{}) enclosing.push_back({mark.end_word, manner});

        PlannedAct act{.mark = i, .manner = overridden(speaker, manner)};
        act.sets_activation = manner[Expressivity::overall_activation].has_value();
        act.word = word_of(mark, accents, speech.words.size());
        act.moment = stressed_moment(speech, act.word);
        acts.push_back(act);
    }
    return acts;
}

double threshold_of(const PlannedAct& act, double weight) {
    if (!act.sets_activation) return 1 - weight;
    return act.manner[Expressivity::overall_activation] > 1 - weight ? -1 : 2;
}

}  // namespace chironomia
