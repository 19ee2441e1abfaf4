// What APLM and FML share: elements that are communicative acts, with their weight and manner.
#pragma once

#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "core/speech.h"
#include "synth/markup/functions.h"
#include "synth/markup/xml.h"

namespace chironomia {

// A number that is written in a text, refused outside [least, most].
struct NumberRange {
    double least = 0;
    double most = 1;
};
// Throws Error with `place` and `what` ("weight") if `text` is no number in the range.
double parse_number_in(std::string_view text, NumberRange range, const Place& place, std::string_view what);

// The marks that one element makes, without their words: its own act, and those that its attributes add
// (affect, belief-relation, certainty, deictic, adjectival, x-pitchaccent).
//   others  attributes that the caller reads itself
// Throws Error if an attribute or a value is unknown, or a number is out of its range.
std::vector<Mark> marks_of_element(const XmlNode& element, const FunctionKind& kind, const XmlSource& source,
                                   std::span<const std::string_view> others = {});

// Throws Error: <name> is none of the elements.
[[noreturn]] void refuse_element(const XmlNode& element, const XmlSource& source, std::string_view language,
                                 const std::vector<std::string>& known);

}  // namespace chironomia
