// Words and phonemes among the tiers of an annotation, as Praat and ELAN have them.
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "synth/speech/timed_label.h"

namespace chironomia {

struct LabelTier {
    std::string name;
    bool has_intervals = false;  // not points in time, nor parts of other annotations
    std::vector<TimedLabel> labels;
};

// Words are the tier named words, word or ORT-MAU, alone, after "speaker - ", or before "@speaker", or the only tier of
// intervals; phonemes the tier named phones, phone, phonemes, phoneme, segments or MAU. Intervals of silence ("", sil,
// sp, spn, <eps>, <p>, <p:>) and WebMAUS's <nib>, a noise, are no words. `file` is named in messages. Throws Error if
// no tier holds words, or if several do. `speaker` keeps the tiers "speaker", "speaker - ..." and "...@speaker" alone; ""
// keeps all; Error if there is none.
TimedLabels labels_of_tiers(const std::vector<LabelTier>& tiers, const std::string& file,
                            std::string_view speaker = {});

}  // namespace chironomia
