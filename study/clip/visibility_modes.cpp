#include "study/clip/visibility_modes.h"

#include <algorithm>

namespace chironomia::study {
namespace {

template <typename Mode>
std::string word_for(const std::map<std::string, Mode>& words, Mode mode) {
    return std::find_if(words.begin(), words.end(), [&](const auto& word) { return word.second == mode; })
        ->first;
}

}  // namespace

const std::map<std::string, FaceMode>& face_modes() {
    static const std::map<std::string, FaceMode> words = {{"au", FaceMode::au},
                                                          {"neutral", FaceMode::neutral},
                                                          {"mask", FaceMode::mask},
                                                          {"blur", FaceMode::blur},
                                                          {"mouth-blur", FaceMode::mouth_blur}};
    return words;
}

const std::map<std::string, HandsMode>& hands_modes() {
    static const std::map<std::string, HandsMode> words = {
        {"motion", HandsMode::motion}, {"relaxed", HandsMode::relaxed}, {"hidden", HandsMode::hidden}};
    return words;
}

std::string to_text(FaceMode mode) {
    return word_for(face_modes(), mode);
}

std::string to_text(HandsMode mode) {
    return word_for(hands_modes(), mode);
}

Json to_json(const Modes& modes) {
    return {{"face_mode", to_text(modes.face_mode)}, {"hands", to_text(modes.hands)}};
}

}  // namespace chironomia::study
