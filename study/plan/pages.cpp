#include <algorithm>

#include "core/text.h"
#include "core/web_address.h"
#include "study/plan/attention.h"
#include "study/plan/default_texts.h"
#include "study/plan/parts.h"
#include "study/plan/secret_names.h"

namespace chironomia::study {
namespace {

constexpr long long kMostOrders = 10000;
constexpr long long kMostParticipants = 100000;
constexpr long long kMostChecks = 20;
constexpr double kLongestWait = 600;  // [s]

const std::vector<std::string> kCheckKinds = {"text", "audio"};

// Participants must not read the name of a condition.
void require_no_condition(const JsonValue& value, const std::string& text, const Plan& plan) {
    if (const auto name = find_condition(text, condition_names(plan)))
        value.refuse(format(
            "shows participants the name of the condition \"{}\"; write it without, or rename the condition",
            *name));
}

std::string read_public_text(const JsonValue& value, const Plan& plan) {
    const std::string text = value.text();
    require_no_condition(value, text, plan);
    return text;
}

// One text, or a list of paragraphs.
std::string read_paragraphs(const JsonValue& value, const Plan& plan) {
    if (!value.json().is_array()) return read_public_text(value, plan);
    std::vector<std::string> paragraphs;
    for (const JsonValue& item : value.items(1)) paragraphs.push_back(read_public_text(item, plan));
    return join(paragraphs, "\n");
}

std::vector<Question> read_question_list(const JsonValue& list, const Plan& plan) {
    std::vector<Question> questions = read_questions(list, 1);
    for (std::size_t i = 0; i < questions.size(); ++i) {
        for (const std::string& text : texts_of(questions[i]))
            require_no_condition(list.items(1)[i], text, plan);
    }
    return questions;
}

void require_fit(const JsonValue& item, const Question& question, const Plan& plan) {
    const bool alone = plan.layout == Layout::single;
    if (alone && (question.kind == QuestionKind::preference || is_of_videos(question))) {
        item.refuse(
            format("\"{}\" compares videos, but the layout \"single\" shows one; ask a rating", question.id));
    }
    if (question.sided && plan.layout != Layout::pair && plan.layout != Layout::triplet)
        item.refuse(format("\"{}\" has \"sided\", but the layout \"{}\" has no A and B; leave it out",
                           question.id, to_text(plan.layout)));
    if (question.each && plan.presentation == Presentation::one_video)
        item.refuse(format("\"{}\" is of each video, but one video shows both figures", question.id));
}

// The short form: one preference question.
Question short_question(const JsonValue& whole, const Plan& plan) {
    Question question = default_question(plan);
    if (const auto text = whole.find("question")) question.text = read_public_text(*text, plan);
    const auto answers = whole.find("answers");
    if (!answers) return question;
    if (question.kind != QuestionKind::preference)
        answers->refuse("are of use for a pair or a triplet alone; write \"questions\"");
    const auto listed = answers->items(2);
    question.answers.clear();
    for (const JsonValue& item : listed) {
        const std::string text = read_public_text(item, plan);
        const auto before = std::find(question.answers.begin(), question.answers.end(), text);
        if (before != question.answers.end()) {
            item.refuse(format("\"{}\" is already answers[{}]; give each its own text", text,
                               before - question.answers.begin()));
        }
        question.answers.push_back(text);
    }
    require_sides(*answers, listed.size());
    return question;
}

void read_passes(const JsonValue& value, Plan& plan) {
    std::vector<std::string> ids;
    for (const Question& question : plan.questions) ids.push_back(question.id);
    for (const JsonValue& item : value.items(1)) {
        item.allow_only(keys_of("passes[]"));
        PagePass pass{.sound = has_sound(plan), .questions = {}};
        if (const auto sound = item.find("sound")) {
            pass.sound = sound->flag();
            if (pass.sound && !has_sound(plan)) sound->refuse("is true, but the clips have no sound");
        }
        for (const JsonValue& id : item.at("questions").items(1)) {
            pass.questions.push_back(
                static_cast<std::size_t>(std::find(ids.begin(), ids.end(), id.choice(ids)) - ids.begin()));
        }
        plan.passes.push_back(std::move(pass));
    }
}

// What the checks say must be written in a language that the program does not know.
void require_instruction(const JsonValue& checks, std::string_view key, const Plan& plan) {
    if (checks.find(key) || is_bundled(plan.texts.language)) return;
    checks.refuse(format("has no \"{}\", which the program can say in {} alone; write it in \"{}\"", key,
                         join(bundled_languages(), " and "), plan.texts.language));
}

// What a check says, with the answer in the place of {answer}.
std::string read_instruction(const JsonValue& checks, std::string_view key, const std::string& otherwise,
                             const Plan& plan) {
    const auto value = checks.find(key);
    if (!value) return otherwise;
    const std::string text = read_public_text(*value, plan);
    if (text.find("{answer}") == std::string::npos)
        value->refuse(
            format("is {}, which lacks {{answer}}, where the answer to give stands", value->shown()));
    return text;
}

// Whether speech is heard each time that a page is shown.
bool is_always_heard(const Plan& plan) {
    const auto heard = [](const PagePass& pass) { return pass.sound; };
    return has_sound(plan) && std::all_of(plan.passes.begin(), plan.passes.end(), heard);
}

// A check that nobody need answer, or that no page asks, could neither be passed nor failed.
void require_answered_checks(const JsonValue& checks, const Plan& plan) {
    const Json expected = make_check(plan, 0, 0, 1).expected;
    for (std::size_t i = 0; i < plan.questions.size(); ++i) {
        const Question& question = plan.questions[i];
        if (!expected.contains(question.id)) continue;
        if (question.optional)
            checks.refuse(format(
                "expects an answer to \"{}\", which is optional, so that a participant who leaves it open would "
                "neither pass nor fail; remove \"optional\" from it, or give it a set of answers that differs from "
                "that of the first question that checks ask for",
                question.id));
        const bool is_asked = std::ranges::any_of(plan.passes, [&](const PagePass& pass) {
            return std::ranges::find(pass.questions, i) != pass.questions.end();
        });
        if (!is_asked)
            checks.refuse(format(
                "expects an answer to \"{}\", which no pass asks; add it to one of \"passes\", or remove it",
                question.id));
    }
}

EarlyChecks read_early_checks(const JsonValue& value) {
    if (value.json() == "all") return EarlyChecks::all;
    if (!value.json().is_boolean())
        value.refuse(format("is {}, true, false or \"all\" is needed", value.shown()));
    return value.flag() ? EarlyChecks::first : EarlyChecks::none;
}

void read_checks(const JsonValue& value, Plan& plan) {
    value.allow_only(keys_of("checks"));
    plan.checks.count = static_cast<std::size_t>(value.at("count").integer(0, kMostChecks));
    plan.checks.kinds = {is_always_heard(plan) ? "audio" : "text"};
    if (const auto kinds = value.find("kinds")) {
        plan.checks.kinds.clear();
        for (const JsonValue& item : kinds->items(1)) {
            plan.checks.kinds.push_back(item.choice(kCheckKinds));
            if (plan.checks.kinds.back() == "audio" && !has_sound(plan))
                item.refuse("is \"audio\", but the clips have no sound that participants hear; use \"text\"");
            if (plan.checks.kinds.back() == "audio" && !is_always_heard(plan))
                item.refuse("is \"audio\", but a pass is silent, where nobody hears it; use \"text\"");
        }
    }
    if (const auto at = value.find("at_beginning")) plan.checks.at_beginning = read_early_checks(*at);
    std::optional<InstructedAnswer> asked;
    for (const Question& question : plan.questions)
        if (!asked) asked = instructed_answer(question);
    if (plan.checks.count > 0 && !asked) {
        value.refuse(
            "no question has an answer that a check can ask for; ask a preference, a rating, a slider or a "
            "choice of options");
    }
    if (plan.checks.count > 0)
        require_instruction(value, asked->of_video ? "instruction_of_video" : "instruction", plan);
    plan.checks.instruction =
        read_instruction(value, "instruction", default_instruction(plan.texts.language), plan);
    plan.checks.instruction_of_video = read_instruction(
        value, "instruction_of_video", default_instruction_of_video(plan.texts.language), plan);
    if (plan.checks.count > 0) require_answered_checks(value, plan);
}

void read_exclusion_rules(const JsonValue& value, Plan& plan) {
    value.allow_only(keys_of("exclusions"));
    ExclusionRules& rules = plan.exclusions;
    if (const auto failed = value.find("failed_checks"))
        rules.failed_checks = static_cast<std::size_t>(failed->integer(1, kMostChecks));
    rules.lenient_failed_checks = std::max(rules.lenient_failed_checks, rules.failed_checks);
    if (const auto lenient = value.find("lenient_failed_checks")) {
        rules.lenient_failed_checks = static_cast<std::size_t>(lenient->integer(1, kMostChecks));
        if (rules.lenient_failed_checks < rules.failed_checks) {
            lenient->refuse(
                format("is {}, and failed_checks {}; the lenient rule excludes no more than the strict one",
                       rules.lenient_failed_checks, rules.failed_checks));
        }
    }
    if (const auto fastest = value.find("fastest_seconds"))
        rules.fastest_seconds = fastest->number(0, kLongestWait);
}

void read_completion(const JsonValue& value, Plan& plan) {
    value.allow_only(keys_of("completion"));
    PlanCompletion& completion = plan.completion;
    const auto text = [&](std::string_view key) {
        const auto found = value.find(key);
        return found ? read_public_text(*found, plan) : std::string();
    };
    const auto link = [&](std::string_view key) {
        const std::string address = text(key);
        if (!address.empty() && !is_web_address(address))
            value.at(key).refuse(format("is \"{}\"; write an address that begins with https://", address));
        return address;
    };
    completion = {.url = link("url"),
                  .code = text("code"),
                  .failed_url = link("failed_url"),
                  .failed_code = text("failed_code"),
                  .declined_url = link("declined_url")};
    if (const auto by = value.find("shown_by"))
        completion.by_server = by->choice({"page", "server"}) == "server";
}

void read_page_texts(const JsonValue& value, Plan& plan) {
    std::vector<std::string> known;
    for (const auto& [name, english] : page_texts()) known.push_back(name);
    for (const auto& [name, english] : page_texts()) {
        if (!name.ends_with(".other")) continue;
        for (const char* form : {"zero", "two", "few", "many"})  // of other languages, by the CLDR
            known.push_back(name.substr(0, name.size() - 5) + form);
    }
    value.allow_only(known);
    for (const auto& [name, text] : value.json().items()) read_paragraphs(value.at(name), plan);
    plan.texts.page = value.json();
}

}  // namespace

void read_participants(const JsonValue& whole, const Json& written, Plan& plan) {
    PlanParticipants& who = plan.participants;
    if (const auto wanted = whole.find("participants"))
        who.wanted = static_cast<std::size_t>(wanted->integer(1, kMostParticipants));
    if (const auto orders = whole.find("orders"))
        who.orders = static_cast<std::size_t>(orders->integer(1, kMostOrders));
    if (const auto once = whole.find("each_clip_once")) who.each_clip_once = once->flag();
    std::size_t judged = 0, blocks = 1;
    for (const PlanClip& clip : plan.clips) {
        if (clip.practice) continue;
        ++judged;
        if (clip.block) blocks = std::max(blocks, *clip.block + 1);
    }
    if (const auto count = whole.find("blocks")) {
        who.blocks = static_cast<std::size_t>(count->integer(1, static_cast<long long>(judged)));
    } else {
        who.blocks = blocks;
    }
    if (blocks > who.blocks) {
        whole.at("blocks").refuse(
            format("is {}, but a clip stands in block {}; blocks count from 0", who.blocks, blocks - 1));
    }
    if (const auto pages = whole.find("pages_per_participant")) {
        const std::size_t all = judged * (who.each_clip_once ? 1 : plan.groups.size());
        const bool by_preset = !written.contains("pages_per_participant");
        const auto wanted = static_cast<std::size_t>(
            pages->integer(1, by_preset ? kMostParticipants : static_cast<long long>(all)));
        (wanted <= all ? who.pages_each : who.preset_pages) = wanted;
    }
}

void read_questions(const JsonValue& whole, Plan& plan) {
    if (const auto list = whole.find("questions")) {
        for (const char* shortly : {"question", "answers"}) {
            if (const auto value = whole.find(shortly))
                value->refuse("is the short form of \"questions\", which are given too; keep one of them");
        }
        plan.questions = read_question_list(*list, plan);
        for (std::size_t i = 0; i < plan.questions.size(); ++i)
            require_fit(list->items(1)[i], plan.questions[i], plan);
    } else {
        plan.questions = {short_question(whole, plan)};
    }
    if (const auto passes = whole.find("passes")) {
        read_passes(*passes, plan);
    } else {
        plan.passes = {{.sound = has_sound(plan), .questions = {}}};
        for (std::size_t i = 0; i < plan.questions.size(); ++i) plan.passes[0].questions.push_back(i);
    }
    if (const auto shuffle = whole.find("shuffle_questions")) plan.shuffle_questions = shuffle->flag();
    if (const auto skip = whole.find("skip_after")) plan.skip_after = skip->number(0, kLongestWait);
    if (const auto list = whole.find("questionnaire")) {
        if (!list->json().empty()) plan.questionnaire = read_question_list(*list, plan);
    }
    if (const auto checks = whole.find("checks")) read_checks(*checks, plan);
    if (const auto rules = whole.find("exclusions")) read_exclusion_rules(*rules, plan);
}

void read_scales_of_plan(const JsonValue& whole, Plan& plan) {
    const auto list = whole.find("scales");
    if (!list) return;
    plan.scales = read_scales(*list, plan.questions);
    for (std::size_t i = 0; i < plan.scales.size(); ++i) {
        const std::vector<std::size_t>& items = plan.scales[i].items;
        for (const PagePass& pass : plan.passes) {
            const auto is_asked = [&](std::size_t item) {
                return std::find(pass.questions.begin(), pass.questions.end(), item) != pass.questions.end();
            };
            const auto other = std::find_if(items.begin(), items.end(), [&](std::size_t item) {
                return is_asked(item) != is_asked(items.front());
            });
            if (other == items.end()) continue;
            list->items(1)[i].at("items").refuse(format(
                "has \"{}\" and \"{}\", which are asked in different passes; ask all items of a scale in one",
                plan.questions[items.front()].id, plan.questions[*other].id));
        }
    }
}

void read_texts(const JsonValue& whole, Plan& plan) {
    PlanTexts& texts = plan.texts;
    texts.title = read_public_text(whole.at("title"), plan);
    const auto instructions = whole.find("instructions");
    texts.instructions = instructions ? read_paragraphs(*instructions, plan) : default_instructions(plan);
    if (const auto consent = whole.find("consent")) texts.consent = read_paragraphs(*consent, plan);
    if (const auto training = whole.find("training")) texts.training = read_paragraphs(*training, plan);
    if (const auto page = whole.find("texts")) read_page_texts(*page, plan);
    plan.sound_check = has_sound(plan);
    if (const auto check = whole.find("sound_check")) {
        plan.sound_check = check->flag();
        if (plan.sound_check && !has_sound(plan)) check->refuse("is true, but the clips have no sound");
    }
    if (const auto completion = whole.find("completion")) read_completion(*completion, plan);
}

// No participant reads it: it may name conditions.
void read_preregistration(const JsonValue& whole, Plan& plan) {
    constexpr double kLargestEffect = 2000;  // Elo
    const auto said = whole.find("preregistration");
    if (!said) return;
    said->allow_only(keys_of("preregistration"));
    plan.preregistration = Json::object();
    for (const auto& [key, text] : said->json().items()) {
        const JsonValue value = said->at(key);
        if (key == "smallest_effect") {
            plan.smallest_effect = value.number(0.001, kLargestEffect);
        } else if (text.is_array()) {
            plan.preregistration[key] = value.texts(1);
        } else {
            plan.preregistration[key] = value.text();
        }
    }
}

}  // namespace chironomia::study
