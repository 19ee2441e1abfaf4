// The communicative functions: the values that each kind of mark has, and how important they are by default.
// docs/markup.md prints this table for users; lexicons name functions as function_of() does.
#pragma once

#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "core/speech.h"

namespace chironomia {

struct FunctionValue {
    std::string_view value;
    double weight = 0.5;         // of a mark whose author gave none
    std::string_view also = "";  // other words for it, between spaces, as APLM has them
};

struct FunctionKind {
    MarkKind kind = MarkKind::rheme;
    std::string_view element;  // of APLM and FML
    std::string_view also;     // other names of the element, between spaces
    std::string_view usual;    // value where none is given; "" if one must be given, or there is none
    double weight = 0.5;       // of kinds without values, and of values of one's own
    bool is_open = false;      // lexicons may bring values of their own; they begin with "x-"
    bool is_place = false;     // stands between words
    std::span<const FunctionValue> values;
};

const FunctionKind& function_kind(MarkKind kind);
std::span<const FunctionKind> function_kinds();

// The kind that an element of APLM stands for, or nothing.
const FunctionKind* function_of_element(std::string_view element);

// The value as the lexicon knows it ("question" is "ask"), or "" if the kind has no such value. Upper and
// lower case are one.
std::string known_value(const FunctionKind& kind, std::string_view written);

// The values that may be written, without their other words.
std::vector<std::string> values_of(const FunctionKind& kind);

double default_weight(MarkKind kind, std::string_view value);

// "performative=greet"; "rheme" where there is no value.
std::string function_of(const Mark& mark);

// The order of Speech::marks: by the first word, an act that holds others before these, else as they were.
void sort_marks(std::vector<Mark>& marks);

}  // namespace chironomia
