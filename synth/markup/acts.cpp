#include "synth/markup/acts.h"

#include <algorithm>
#include <optional>

#include "core/error.h"
#include "core/text.h"

namespace chironomia {
namespace {

// "; did you mean greet? Known are greet, inform"
std::string advice(std::string_view typo, const std::vector<std::string>& known) {
    const std::optional<std::string> nearest = nearest_name(typo, known);
    return nearest ? format("did you mean {}? Known are {}", *nearest, join(known))
                   : format("write one of {}", join(known));
}

// An attribute that adds an act of its own to the element's.
struct AddedAct {
    std::string_view attribute;
    MarkKind kind;
};
constexpr AddedAct kAdded[] = {
    {"affect", MarkKind::emotion},
    {"emotion", MarkKind::emotion},
    {"belief-relation", MarkKind::belief_relation},
    {"certainty", MarkKind::certainty},
    {"deictic", MarkKind::deictic},
    {"adjectival", MarkKind::world},
    {"x-pitchaccent", MarkKind::pitch_accent},
};

const AddedAct* added_by(std::string_view attribute, MarkKind own) {
    const bool is_structure = own == MarkKind::theme || own == MarkKind::rheme || own == MarkKind::emphasis ||
                              own == MarkKind::performative;
    if (!is_structure) return nullptr;
    for (const AddedAct& added : kAdded)
        if (added.attribute == attribute) return &added;
    return nullptr;
}

bool is_value_attribute(std::string_view attribute, const FunctionKind& kind) {
    if (kind.kind == MarkKind::emphasis && attribute == "level") return true;
    if (kind.kind == MarkKind::gesture && attribute == "name") return true;
    return (!kind.values.empty() || kind.is_open) && attribute == "type";
}

std::string checked_value(const FunctionKind& kind, const XmlAttribute& attribute, const Place& place) {
    std::string value = known_value(kind, attribute.value);
    if (!value.empty()) return value;
    const std::vector<std::string> known = values_of(kind);
    const bool is_own = kind.is_open && !known.empty();
    throw Error(format(
        "{}: {} \"{}\" is no value of {}; {}{}", place.to_text(), attribute.name, attribute.value,
        kind.element, known.empty() ? "write the name of one of the lexicon" : advice(attribute.value, known),
        is_own ? "; one of your own lexicon begins with x-" : ""));
}

std::vector<std::string> attributes_known(const FunctionKind& kind) {
    std::vector<std::string> known = {"weight", "oac", "spc", "tmp", "flt", "pwr", "rep", "id"};
    for (const std::string_view name : {"type", "level", "name"})
        if (is_value_attribute(name, kind)) known.emplace_back(name);
    for (const AddedAct& added : kAdded)
        if (added_by(added.attribute, kind.kind)) known.emplace_back(added.attribute);
    if (kind.kind == MarkKind::gesture) known.emplace_back("reference");
    return known;
}

class ElementReader {
  public:
    ElementReader(const FunctionKind& kind, const Place& place) : kind_(kind), place_(place) {
        marks_.push_back({.kind = kind.kind});
    }

    // Whether the attribute belongs to acts.
    bool read(const XmlAttribute& attribute) {
        if (attribute.name == "id") return true;
        if (attribute.name == "weight" || attribute.name == "importance") {
            weight_ = parse_number_in(attribute.value, {}, place_, attribute.name);
        } else if (const std::optional<Expressivity> dimension = expressivity_named(attribute.name)) {
            const double number =
                parse_number_in(attribute.value, {least_of(*dimension), 1}, place_, attribute.name);
            manner_[*dimension] = number;
        } else if (is_value_attribute(attribute.name, kind_)) {
            marks_.front().value = checked_value(kind_, attribute, place_);
        } else if (const AddedAct* added = added_by(attribute.name, kind_.kind)) {
            const FunctionKind& other = function_kind(added->kind);
            marks_.push_back({.kind = other.kind, .value = checked_value(other, attribute, place_)});
        } else if (kind_.kind == MarkKind::gesture && attribute.name == "reference") {
            marks_.front().reference = attribute.value;
        } else {
            return false;
        }
        return true;
    }

    std::vector<Mark> marks() && {
        Mark& own = marks_.front();
        if (own.value.empty()) own.value = kind_.usual;
        const bool has_values = !kind_.values.empty() || kind_.is_open;
        if (own.value.empty() && has_values)
            throw Error(format("{}: <{}> says no type; {}", place_.to_text(), kind_.element,
                               kind_.values.empty()
                                   ? "write name=\"...\", a gesture of the lexicon"
                                   : format("write type=\"...\", one of {}", join(values_of(kind_)))));
        for (Mark& mark : marks_) {
            mark.weight = weight_.value_or(default_weight(mark.kind, mark.value));
            mark.manner = manner_;
        }
        return std::move(marks_);
    }

  private:
    const FunctionKind& kind_;
    const Place& place_;
    std::vector<Mark> marks_;
    std::optional<double> weight_;
    LocalManner manner_;
};

}  // namespace

double parse_number_in(std::string_view text, NumberRange range, const Place& place, std::string_view what) {
    const std::optional<double> number = parse_number(text);
    if (!number)
        throw Error(format("{}: {} \"{}\" is no number; write one such as 0.5", place.to_text(), what, text));
    if (!(*number >= range.least && *number <= range.most))
        throw Error(format("{}: {} {} is outside its range; it goes from {} to {}", place.to_text(), what,
                           text, range.least, range.most));
    return *number;
}

std::vector<Mark> marks_of_element(const XmlNode& element, const FunctionKind& kind, const XmlSource& source,
                                   std::span<const std::string_view> others) {
    const Place place{element, source};
    ElementReader reader(kind, place);
    for (const XmlAttribute& attribute : element.attributes) {
        if (std::find(others.begin(), others.end(), attribute.name) != others.end()) continue;
        if (reader.read(attribute)) continue;
        throw Error(format("{}: <{}> has no attribute {}; {}", place.to_text(), element.name, attribute.name,
                           advice(attribute.name, attributes_known(kind))));
    }
    return std::move(reader).marks();
}

void refuse_element(const XmlNode& element, const XmlSource& source, std::string_view language,
                    const std::vector<std::string>& known) {
    throw Error(format("{}: <{}> is no element of {}; {}", Place{element, source}.to_text(), element.name,
                       language, advice(element.name, known)));
}

}  // namespace chironomia
