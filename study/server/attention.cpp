#include "study/server/attention.h"

#include <algorithm>

namespace chironomia {
namespace {

bool is_mirrored(const std::vector<std::size_t>& order) {
    return order.front() > order.back();
}

bool names_videos(const AskedQuestion& question) {
    return question.each || (question.kind == QuestionKind::rank && question.of_videos);
}

// Questions of other passes are not judged here.
bool is_missed(const StudyPages& study, const Step& step, const Json& expected, const Json& values) {
    for (const std::size_t index : study.pages[step.page].passes[step.pass].questions) {
        const AskedQuestion& question = study.questions[index];
        const auto wanted = expected.find(question.id);
        if (wanted == expected.end()) continue;
        if (!values.contains(question.id)) return true;
        if (values.at(question.id) != expected_as_shown(question, *wanted, step.order)) return true;
    }
    return false;
}

}  // namespace

Json expected_as_shown(const AskedQuestion& question, const Json& expected,
                       const std::vector<std::size_t>& order) {
    if (names_videos(question) && expected.is_array() && expected.size() == order.size()) {
        Json shown = Json::array();
        for (const std::size_t video : order) shown.push_back(expected[video]);
        return shown;
    }
    if (question.kind == QuestionKind::preference && is_mirrored(order)) {
        return static_cast<int>(question.most) + 1 - expected.get<int>();
    }
    if (question.kind == QuestionKind::choice && question.of_videos && order.size() > 1) {
        return std::find(order.begin(), order.end(), expected.get<std::size_t>()) - order.begin();
    }
    return expected;
}

bool fails_attention(const StudyPages& study, const StudyKey& key, const Step& step, const Json& entry) {
    if (const auto& fastest = key.exclusions.fastest_seconds;
        fastest && entry["seconds"].get<double>() < *fastest)
        return true;
    const Json& expected = key.pages[step.page].expected;
    return !expected.is_null() && is_missed(study, step, expected, entry["values"]);
}

}  // namespace chironomia
