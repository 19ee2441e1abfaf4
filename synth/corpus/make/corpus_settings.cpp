#include "synth/corpus/make/corpus_settings.h"

#include "synth/gestures/lexicon.h"

namespace chironomia {
namespace {

void free_hands(Gesture& gesture) {
    for (KeyPose& pose : gesture.poses) {
        if (pose.right) pose.right->fixed.shape = false;
        if (pose.left) pose.left->fixed.shape = false;
    }
}

}  // namespace

Lexicon read_corpus_lexicon() {
    Lexicon lexicon = read_lexicon(bundled_lexicon_files());
    for (Gesture& gesture : lexicon.gestures) {
        if (gesture.category == GestureCategory::beat || gesture.category == GestureCategory::metaphoric)
            free_hands(gesture);
    }
    return lexicon;
}

}  // namespace chironomia
