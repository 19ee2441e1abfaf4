// What the lexemes of BML's heads, faces and gestures ask for.
#pragma once

#include <string_view>

namespace chironomia {

// The signal, as synth/planner/behaviour.h names it, that is asked of a head or a face by a lexeme of BML 1.0 or of
// GRETA ("NOD", "RAISE_BROWS", "faceexp=raise_eyebrows"), or by an emotion; "" if none is known.
std::string_view signal_of_head(std::string_view lexeme);
std::string_view signal_of_face(std::string_view lexeme);

// The function that a gesture of core BML shows ("BEAT": "emphasis"), for a lexicon without one of that name; "" for
// others.
std::string_view function_of_gesture(std::string_view lexeme);

}  // namespace chironomia
