#include "study/record/questions.h"

#include <algorithm>
#include <cassert>
#include <map>

#include "core/text.h"

namespace chironomia::study {
namespace {

constexpr int kMostPoints = 11;
constexpr int kFarthest = 1000000;  // of a slider or a number
constexpr std::size_t kMostAnswers = 9;

const std::vector<std::pair<std::string, QuestionKind>> kKinds = {
    {"preference", QuestionKind::preference},
    {"rating", QuestionKind::rating},
    {"slider", QuestionKind::slider},
    {"choice", QuestionKind::choice},
    {"rank", QuestionKind::rank},
    {"text", QuestionKind::text},
    {"number", QuestionKind::number},
};

// What each kind holds beside id, kind, text and optional.
const std::map<QuestionKind, std::vector<std::string>> kKeysOfKind = {
    {QuestionKind::preference, {"answers", "reasons"}},
    {QuestionKind::rating, {"points", "labels", "each", "sided"}},
    {QuestionKind::slider, {"least", "most", "labels", "each", "sided"}},
    {QuestionKind::choice, {"options", "of_videos"}},
    {QuestionKind::rank, {"options", "of_videos"}},
    {QuestionKind::text, {}},
    {QuestionKind::number, {"least", "most"}},
};

QuestionKind read_kind(const JsonValue& value) {
    std::vector<std::string> names;
    for (const auto& [name, kind] : kKinds) names.push_back(name);
    const std::string name = value.choice(names);
    return std::find_if(kKinds.begin(), kKinds.end(), [&](const auto& each) { return each.first == name; })
        ->second;
}

std::vector<std::string> read_texts(const JsonValue& list, std::size_t at_least) {
    std::vector<std::string> texts;
    for (const JsonValue& item : list.items(at_least)) {
        const std::string text = item.text();
        const auto before = std::find(texts.begin(), texts.end(), text);
        if (before != texts.end()) {
            item.refuse(format("\"{}\" is already {}[{}]; give each its own text", text, list.key(),
                               before - texts.begin()));
        }
        texts.push_back(text);
    }
    return texts;
}

std::vector<QuestionOption> read_options(const JsonValue& list, std::size_t at_least) {
    std::vector<QuestionOption> options;
    for (const JsonValue& item : list.items(at_least)) {
        item.allow_only({"id", "text"});
        const std::string id = read_id(item.at("id"));
        const auto is_same = [&](const QuestionOption& option) { return option.id == id; };
        const auto before = std::find_if(options.begin(), options.end(), is_same);
        if (before != options.end()) {
            item.at("id").refuse(format("\"{}\" is already the id of {}[{}]; give each its own", id,
                                        list.key(), before - options.begin()));
        }
        options.push_back({.id = id, .text = item.at("text").text()});
    }
    return options;
}

void read_preference(const JsonValue& value, Question& question) {
    const JsonValue answers = value.at("answers");
    question.answers = read_texts(answers, 2);
    require_sides(answers, question.answers.size());
    const auto reasons = value.filled("reasons");
    if (!reasons) return;
    reasons->allow_only({"text", "options", "other", "unless"});
    Reasons read{.text = reasons->at("text").text(), .options = read_options(reasons->at("options"), 1)};
    if (const auto other = reasons->find("other")) read.other = other->text();
    if (const auto unless = reasons->find("unless"))
        read.unless = static_cast<int>(unless->integer(1, static_cast<long long>(question.answers.size())));
    question.reasons = std::move(read);
}

void read_rating(const JsonValue& value, Question& question) {
    question.points = static_cast<int>(value.at("points").integer(2, kMostPoints));
    const auto labels = value.find("labels");
    if (!labels) return;
    std::vector<std::string> points;
    for (int i = 1; i <= question.points; ++i) points.push_back(std::to_string(i));
    labels->allow_only(points);
    for (int i = 1; i <= question.points; ++i) {
        if (const auto label = labels->find(std::to_string(i))) question.labels.emplace(i, label->text());
    }
}

void read_limits(const JsonValue& value, Question& question) {
    if (const auto least = value.find("least"))
        question.least = static_cast<int>(least->integer(-kFarthest, kFarthest));
    if (const auto most = value.find("most"))
        question.most = static_cast<int>(most->integer(-kFarthest, kFarthest));
    if (question.least && question.most && *question.least >= *question.most) {
        value.at("most").refuse(
            format("is {}, more than \"least\", which is {}, is needed", *question.most, *question.least));
    }
}

void read_slider(const JsonValue& value, Question& question) {
    question.least = 0;
    question.most = 100;
    read_limits(value, question);
    if (const auto labels = value.find("labels")) question.marks = read_texts(*labels, 2);
}

void read_choice(const JsonValue& value, Question& question) {
    const auto options = value.find("options");
    const auto of_videos = value.find("of_videos");
    const bool videos = of_videos && of_videos->flag();
    if (options.has_value() == videos) {
        value.refuse("needs \"options\", or \"of_videos\": true, and not both");
    }
    if (options) question.options = read_options(*options, 2);
}

}  // namespace

const std::string& to_text(QuestionKind kind) {
    return std::find_if(kKinds.begin(), kKinds.end(), [&](const auto& each) { return each.second == kind; })
        ->first;
}

ScoreRange range_of_scores(const Question& question) {
    if (question.kind == QuestionKind::rating) return {.least = 1, .most = question.points};
    assert(question.kind == QuestionKind::slider);
    return {.least = question.least.value_or(0), .most = question.most.value_or(100)};
}

std::string read_id(const JsonValue& value) {
    const std::string id = value.text();
    const bool plain = std::all_of(id.begin(), id.end(), [](unsigned char c) {
        return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9') || c == '_' ||
               c == '-';
    });
    if (!plain) value.refuse(format("is {}; use letters, digits, - and _", value.shown()));
    return id;
}

void require_sides(const JsonValue& answers, std::size_t count) {
    if (count == 2 || (count % 2 == 1 && count >= 3 && count <= kMostAnswers)) return;
    answers.refuse(
        format("has {} entries, 2 or an odd number from 3 to {} are needed: from A clearly to B clearly",
               count, kMostAnswers));
}

Question read_question(const JsonValue& value) {
    Question question;
    question.kind = read_kind(value.at("kind"));
    std::vector<std::string> keys = {"id", "kind", "text", "optional"};
    const auto& more = kKeysOfKind.at(question.kind);
    keys.insert(keys.end(), more.begin(), more.end());
    value.allow_only(keys);
    question.id = read_id(value.at("id"));
    question.text = value.at("text").text();
    if (const auto flag = value.find("optional")) question.optional = flag->flag();
    if (const auto flag = value.find("each")) question.each = flag->flag();
    if (const auto flag = value.find("sided")) {
        question.sided = flag->flag();
        if (*question.sided && question.each)
            flag->refuse("is true, but each video is rated by itself (\"each\"); leave one of them out");
    }
    switch (question.kind) {
        case QuestionKind::preference:
            read_preference(value, question);
            break;
        case QuestionKind::rating:
            read_rating(value, question);
            break;
        case QuestionKind::slider:
            read_slider(value, question);
            break;
        case QuestionKind::choice:
        case QuestionKind::rank:
            read_choice(value, question);
            break;
        case QuestionKind::number:
            read_limits(value, question);
            break;
        case QuestionKind::text:
            break;
    }
    return question;
}

std::vector<Question> read_questions(const JsonValue& list, std::size_t at_least) {
    std::vector<Question> questions;
    for (const JsonValue& item : list.items(at_least)) {
        Question question = read_question(item);
        for (std::size_t i = 0; i < questions.size(); ++i) {
            if (questions[i].id != question.id) continue;
            item.at("id").refuse(
                format("\"{}\" is already the id of {}[{}]; give each its own", question.id, list.key(), i));
        }
        questions.push_back(std::move(question));
    }
    return questions;
}

bool is_of_videos(const Question& question) {
    const bool chooses = question.kind == QuestionKind::choice || question.kind == QuestionKind::rank;
    return chooses && question.options.empty();
}

namespace {

Json options_json(const std::vector<QuestionOption>& options) {
    Json list = Json::array();
    for (const QuestionOption& option : options) list.push_back({{"id", option.id}, {"text", option.text}});
    return list;
}

Json reasons_json(const Reasons& reasons) {
    Json json = {{"text", reasons.text}, {"options", options_json(reasons.options)}};
    if (!reasons.other.empty()) json["other"] = reasons.other;
    if (reasons.unless > 0) json["unless"] = reasons.unless;
    return json;
}

}  // namespace

Json to_json(const Question& question) {
    Json json = {{"id", question.id}, {"kind", to_text(question.kind)}, {"text", question.text}};
    if (question.optional) json["optional"] = true;
    if (!question.answers.empty()) json["answers"] = question.answers;
    if (question.reasons) json["reasons"] = reasons_json(*question.reasons);
    if (question.points > 0) json["points"] = question.points;
    for (const auto& [point, label] : question.labels) json["labels"][std::to_string(point)] = label;
    if (question.least) json["least"] = *question.least;
    if (question.most) json["most"] = *question.most;
    if (!question.marks.empty()) json["labels"] = question.marks;
    if (question.each) json["each"] = true;
    if (question.sided) json["sided"] = *question.sided;
    if (is_of_videos(question)) json["of_videos"] = true;
    if (!question.options.empty()) json["options"] = options_json(question.options);
    return json;
}

Json to_json(const std::vector<Question>& questions) {
    Json list = Json::array();
    for (const Question& question : questions) list.push_back(to_json(question));
    return list;
}

std::vector<std::string> texts_of(const Question& question) {
    std::vector<std::string> texts = {question.text};
    const auto add_options = [&](const std::vector<QuestionOption>& options) {
        for (const QuestionOption& option : options) {
            texts.push_back(option.id);
            texts.push_back(option.text);
        }
    };
    texts.insert(texts.end(), question.answers.begin(), question.answers.end());
    texts.insert(texts.end(), question.marks.begin(), question.marks.end());
    for (const auto& [point, label] : question.labels) texts.push_back(label);
    add_options(question.options);
    texts.push_back(question.id);
    if (!question.reasons) return texts;
    texts.push_back(question.reasons->text);
    add_options(question.reasons->options);
    if (!question.reasons->other.empty()) texts.push_back(question.reasons->other);
    return texts;
}

const std::vector<std::string>& question_keys() {
    static const std::vector<std::string> keys = [] {
        std::vector<std::string> all = {"id", "kind", "text", "optional"};
        for (const auto& [kind, more] : kKeysOfKind) {
            for (const std::string& key : more) {
                if (std::find(all.begin(), all.end(), key) == all.end()) all.push_back(key);
            }
        }
        return all;
    }();
    return keys;
}

}  // namespace chironomia::study
