// Annotations of ELAN (.eaf): words and phonemes in tiers with times.
#pragma once

#include <string>
#include <string_view>

#include "synth/speech/timed_label.h"

namespace chironomia {

// Whether a text is XML whose root is ELAN's.
bool is_elan(std::string_view text);

// Reads the tiers whose annotations have times of their own; which of them holds words is said in label_tiers.h. Time
// slots without a value, as between the parts of a subdivided annotation, share what their neighbours leave. See "EAF
// annotation format" of The Language Archive. `file` is named in messages. Throws Error with line and column if the XML
// is broken, a time slot is missing or no number, or as label_tiers.h says.
TimedLabels read_elan(std::string_view text, const std::string& file, std::string_view speaker = {});

}  // namespace chironomia
