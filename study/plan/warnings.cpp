#include <algorithm>
#include <regex>
#include <set>
#include <string>

#include "core/text.h"
#include "study/plan/default_texts.h"
#include "study/plan/plan.h"

namespace chironomia::study {
namespace {

bool are_shown_alike(const Plan& plan, const PlanClip& clip, std::size_t a, std::size_t b) {
    const bool same_faces = clip.faces.empty() || clip.faces[a] == clip.faces[b];
    return plan.conditions[a].making == Making::given && plan.conditions[b].making == Making::given &&
           clip.motions[a] == clip.motions[b] && same_faces && plan.modes[a] == plan.modes[b];
}

void warn_of_same_motions(const Plan& plan, std::vector<std::string>& warnings) {
    for (std::size_t a = 0; a < plan.conditions.size(); ++a) {
        for (std::size_t b = a + 1; b < plan.conditions.size(); ++b) {
            const auto is_same = [&](const PlanClip& clip) { return are_shown_alike(plan, clip, a, b); };
            const auto first = std::ranges::find_if(plan.clips, is_same);
            if (first == plan.clips.end()) continue;
            warnings.push_back(
                format("{}: \"{}\" and \"{}\" show the same in {} of {} clips, such as {} in \"{}\"",
                       plan.file.string(), plan.conditions[a].name, plan.conditions[b].name,
                       std::ranges::count_if(plan.clips, is_same), plan.clips.size(),
                       path_in_plan(plan, first->motions[a]), first->id));
        }
    }
}

// One person who stands on both sides, or whose voice is heard from both.
void warn_of_partners_alike(const Plan& plan, std::vector<std::string>& warnings) {
    const auto warn = [&](const char* what, auto is_alike) {
        const auto first = std::ranges::find_if(plan.clips, is_alike);
        if (first == plan.clips.end()) return;
        warnings.push_back(format("{}: agent and partner have the same {} in {} of {} clips, such as \"{}\"",
                                  plan.file.string(), what, std::ranges::count_if(plan.clips, is_alike),
                                  plan.clips.size(), first->id));
    };
    warn("motion", [](const PlanClip& clip) {
        return clip.partner && std::ranges::find(clip.motions, clip.partner->motion) != clip.motions.end();
    });
    warn("audio", [](const PlanClip& clip) {
        return clip.partner && !clip.audio.empty() && clip.audio == clip.partner->audio;
    });
}

// A text that counts is there if one of its forms is.
void warn_of_english_texts(const Plan& plan, std::vector<std::string>& warnings) {
    if (is_bundled(plan.texts.language)) return;
    std::vector<std::string> missing;
    for (const auto& [name, english] : page_texts()) {
        const std::string stem = name.substr(0, name.find('.') + 1);
        const bool is_there = std::ranges::any_of(plan.texts.page.items(), [&](const auto& text) {
            return text.key() == name || (!stem.empty() && text.key().starts_with(stem));
        });
        if (!is_there) missing.push_back(name);
    }
    if (missing.empty()) return;
    warnings.push_back(
        format("{}: texts: {} of {} texts of the page are left in English, such as \"{}\"; "
               "docs/page.md lists all",
               plan.file.string(), missing.size(), page_texts().size(), missing.front()));
}

// "{n}" and the like, for which the page puts something.
std::set<std::string> marks_in(const std::string& text) {
    static const std::regex mark(R"(\{\w+\})");
    return {std::sregex_token_iterator(text.begin(), text.end(), mark), std::sregex_token_iterator()};
}

// What stands for the number may be left out of forms that are about one number alone.
std::set<std::string> marks_needed(const std::string& name) {
    const std::string stem = name.substr(0, name.find('.') + 1), form = name.substr(stem.size());
    std::set<std::string> needed;
    for (const PageText& text : page_texts()) {
        if (text.name == name || (!stem.empty() && text.name == stem + "other"))
            needed = marks_in(text.english);
        if (text.name == name) break;
    }
    if (!stem.empty() && (form == "zero" || form == "one" || form == "two")) needed.erase("{n}");
    return needed;
}

void warn_of_lost_marks(const Plan& plan, std::vector<std::string>& warnings) {
    for (const auto& [name, text] : plan.texts.page.items()) {
        // One of several paragraphs is a list.
        const std::set<std::string> there =
            marks_in(text.is_string() ? text.get<std::string>() : text.dump());
        for (const std::string& mark : marks_needed(name)) {
            if (there.contains(mark)) continue;
            warnings.push_back(format(
                "{}: texts: \"{}\" has no {}, in whose place the page writes what participants need to know; "
                "docs/page.md has the English text",
                plan.file.string(), name, mark));
        }
    }
}

void warn_of_fewer_pages(const Plan& plan, std::vector<std::string>& warnings) {
    if (!plan.participants.preset_pages) return;
    warnings.push_back(
        format("{}: a participant sees all clips, as there are fewer than the {} pages of \"{}\"",
               plan.file.string(), *plan.participants.preset_pages, plan.preset));
}

// One value for all videos of a page says nothing of their conditions. Presets are as their papers asked.
void warn_of_scores_of_pages(const Plan& plan, std::vector<std::string>& warnings) {
    if (plan.layout == Layout::single || plan.presentation == Presentation::one_video || !plan.preset.empty())
        return;
    for (const Question& question : plan.questions) {
        const bool is_score = question.kind == QuestionKind::rating || question.kind == QuestionKind::slider;
        if (!is_score || question.each || question.sided || plan.right_answers.contains(question.id))
            continue;
        if (plan.layout == Layout::triplet && question.kind == QuestionKind::rating) {
            warnings.push_back(format(
                "{}: questions: \"{}\" is analysed as similarity of the reference to A (1) or to B ({}), and turned "
                "with the videos; say that it is by \"sided\": true, or by \"sided\": false that it is not about A and B",
                plan.file.string(), question.id, question.points));
            continue;
        }
        warnings.push_back(format(
            "{}: questions: \"{}\" is asked once of all videos of a page, so no condition gets a score; if each "
            "video is to be rated, give the question \"each\": true{}",
            plan.file.string(), question.id,
            plan.layout == Layout::parallel
                ? ""
                : "; if it goes from A to B, \"sided\": true, which is turned with the videos; if it is about the page "
                  "as a whole, \"sided\": false"));
    }
}

void warn_of_rules_without_effect(const Plan& plan, std::vector<std::string>& warnings) {
    const std::size_t failed = plan.exclusions.failed_checks, checks = plan.checks.count;
    if (checks == 0 || failed <= checks) return;
    warnings.push_back(
        format("{}: exclusions: nobody can fail {} of {} attention checks, so they exclude nobody",
               plan.file.string(), failed, checks));
}

}  // namespace

std::vector<std::string> plan_warnings(const Plan& plan) {
    std::vector<std::string> warnings;
    warn_of_same_motions(plan, warnings);
    warn_of_partners_alike(plan, warnings);
    warn_of_english_texts(plan, warnings);
    warn_of_lost_marks(plan, warnings);
    warn_of_fewer_pages(plan, warnings);
    warn_of_scores_of_pages(plan, warnings);
    warn_of_rules_without_effect(plan, warnings);
    return warnings;
}

}  // namespace chironomia::study
