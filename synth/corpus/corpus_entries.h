// The records of an index as JSON: {id, speaker, split, seconds}, and {recording, start} of what was cut from one.
#pragma once

#include "core/files/json_value.h"
#include "synth/corpus/corpus.h"

namespace chironomia {

Json json_of(const CorpusEntry& entry);
// Throws Error with the key for what is missing, unknown or out of range.
CorpusEntry entry_of(const JsonValue& value);

}  // namespace chironomia
