#include "study/record/scales.h"

#include <algorithm>

#include "core/text.h"
#include "study/record/page_kinds.h"

namespace chironomia::study {
namespace {

std::vector<std::string> item_ids(const std::vector<Question>& questions,
                                  const std::vector<std::size_t>& which) {
    std::vector<std::string> ids;
    for (const std::size_t question : which) ids.push_back(questions[question].id);
    return ids;
}

// "from 1 to 5, of every video"
std::string rated(const Question& question) {
    const ScoreRange range = range_of_scores(question);
    return format("from {} to {}{}", range.least, range.most, question.each ? ", of every video" : "");
}

void require_item(const JsonValue& value, const std::vector<Question>& questions, const Scale& scale,
                  std::size_t item) {
    const Question& question = questions[item];
    if (question.kind != QuestionKind::rating && question.kind != QuestionKind::slider)
        value.refuse(format("is {}, which is no rating and no slider; leave it out", value.shown()));
    if (std::find(scale.items.begin(), scale.items.end(), item) != scale.items.end())
        value.refuse(format("is {}, which is an item already; name each once", value.shown()));
    if (scale.items.empty()) return;
    const Question& first = questions[scale.items.front()];
    if (question.kind != first.kind || rated(question) != rated(first)) {
        value.refuse(format("is {}, a {} {}, but \"{}\" is a {} {}; the items of a scale are rated alike",
                            value.shown(), to_text(question.kind), rated(question), first.id,
                            to_text(first.kind), rated(first)));
    }
}

Scale read_scale(const JsonValue& value, const std::vector<Question>& questions) {
    value.allow_only({"id", "items", "reversed"});
    Scale scale{.id = read_id(value.at("id"))};
    std::vector<std::string> all;
    for (const Question& question : questions) all.push_back(question.id);
    for (const JsonValue& item : value.at("items").items(2)) {
        const std::size_t question = index_of_choice(item, all);
        require_item(item, questions, scale, question);
        scale.items.push_back(question);
    }
    scale.reversed.resize(scale.items.size());
    if (const auto reversed = value.find("reversed")) {
        for (const JsonValue& item : reversed->items(0))
            scale.reversed[index_of_choice(item, item_ids(questions, scale.items))] = true;
    }
    return scale;
}

}  // namespace

std::vector<Scale> read_scales(const JsonValue& list, const std::vector<Question>& questions) {
    std::vector<std::string> taken;
    for (const Question& question : questions) taken.push_back(question.id);
    std::vector<Scale> scales;
    for (const JsonValue& item : list.items(1)) {
        scales.push_back(read_scale(item, questions));
        const std::string& id = scales.back().id;
        if (std::find(taken.begin(), taken.end(), id) != taken.end())
            item.at("id").refuse(
                format("\"{}\" is already the id of a question or of a scale; give each its own", id));
        taken.push_back(id);
    }
    return scales;
}

Json to_json(const std::vector<Scale>& scales, const std::vector<Question>& questions) {
    Json list = Json::array();
    for (const Scale& scale : scales) {
        Json json = {{"id", scale.id}, {"items", item_ids(questions, scale.items)}};
        for (std::size_t i = 0; i < scale.items.size(); ++i) {
            if (scale.reversed[i]) json["reversed"].push_back(questions[scale.items[i]].id);
        }
        list.push_back(std::move(json));
    }
    return list;
}

std::string describe(const Scale& scale, const std::vector<Question>& questions) {
    std::vector<std::string> items = item_ids(questions, scale.items);
    for (std::size_t i = 0; i < items.size(); ++i) items[i] += scale.reversed[i] ? " (reversed)" : "";
    const std::string last = items.back();
    items.pop_back();
    return format("Mean of {} and {}.", join(items), last);
}

bool is_reversed(const std::vector<Scale>& scales, std::size_t question) {
    return std::any_of(scales.begin(), scales.end(), [&](const Scale& scale) {
        const auto item = std::find(scale.items.begin(), scale.items.end(), question);
        return item != scale.items.end() &&
               scale.reversed[static_cast<std::size_t>(item - scale.items.begin())];
    });
}

double reversed_value(const Question& question, double value) {
    const ScoreRange range = range_of_scores(question);
    return range.least + range.most - value;
}

}  // namespace chironomia::study
