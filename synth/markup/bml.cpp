#include "synth/markup/bml.h"

#include <algorithm>
#include <map>
#include <optional>
#include <utility>

#include "core/error.h"
#include "core/text.h"
#include "synth/markup/acts.h"
#include "synth/markup/bml_lexemes.h"
#include "synth/markup/script_builder.h"
#include "synth/markup/script_words.h"
#include "synth/markup/sync_points.h"
#include "synth/markup/xml.h"

namespace chironomia {
namespace {

// GRETA's names of the dimensions. What has no dimension here is noted.
struct Described {
    std::string_view element;
    Expressivity dimension;
};
constexpr Described kDescribed[] = {
    {"OAC.value", Expressivity::overall_activation}, {"SPC.value", Expressivity::spatial_extent},
    {"TMP.value", Expressivity::temporal_extent},    {"FLD.value", Expressivity::fluidity},
    {"FLT.value", Expressivity::fluidity},           {"PWR.value", Expressivity::power},
    {"REP.value", Expressivity::repetition},
};
constexpr std::string_view kUnshown[] = {"OPN.value", "TEN.value"};

constexpr std::string_view kBehaviours[] = {"gesture", "head",  "face",     "faceLexeme",        "gaze",
                                            "posture", "torso", "shoulder", "headDirectionShift"};
constexpr std::string_view kSpeechAttributes[] = {"id",  "start", "ready",    "stroke", "relax",
                                                  "end", "type",  "language", "voice",  "text"};
// Of standard BML and of FML, without a counterpart here.
constexpr std::string_view kUnreadElements[] = {"constraint", "wait",        "locomotion", "emit",
                                                "lips",       "gazeShift",   "faceFacs",   "faceShift",
                                                "pointing",   "postureShift"};
constexpr std::string_view kUnreadOfFunctions[] = {"ref_type", "ref_id", "prop_type", "prop_value",
                                                   "target",   "main",   "character", "duration"};
constexpr std::string_view kRootAttributes[] = {"id", "composition", "character", "characterId"};
constexpr std::string_view kGestureAttributes[] = {"id",     "lexeme", "type",           "mode",
                                                   "amount", "target", "offsetDirection"};
// Parts of the names of whom the speaker speaks to.
constexpr std::string_view kPartners[] = {"user",    "camera",    "viewer", "listener",
                                          "partner", "addressee", "player", "participant"};
constexpr double kLongestSpeech = 86400;  // [s]
constexpr std::string_view kFunctionTimes[] = {"start", "end", "regulation", "intensity"};

template <std::size_t N>
bool is_one_of(std::string_view name, const std::string_view (&names)[N]) {
    return std::find(std::begin(names), std::end(names), name) != std::end(names);
}

template <std::size_t N>
std::vector<std::string> listed(const std::string_view (&names)[N]) {
    return {std::begin(names), std::end(names)};
}

std::string attribute_or_empty(const XmlNode& element, std::string_view name) {
    for (const XmlAttribute& attribute : element.attributes)
        if (attribute.name == name) return attribute.value;
    return "";
}

std::string text_in(const XmlNode& element) {
    std::string text;
    for (const XmlNode& child : element.children) text += child.text;
    return std::string(trim(text));
}

bool is_blank(const XmlNode& node) {
    return node.is_text() && trim(node.text).empty();
}

class BmlReader {
  public:
    explicit BmlReader(const XmlSource& source) : source_(source), syncs_(source) {}

    MarkedText read(const XmlNode& root) {
        if (root.name != "bml" && root.name != "fml-apml")
            refuse_element(root, source_, "BML that begins a text", {"bml", "fml-apml"});
        read_root_attributes(root);
        sort_children(root);
        if (!speech_)
            throw Error(
                format("{}: <{}> holds no <speech>; write <speech id=\"sp1\"><text>...</text></speech>",
                       Place{root, source_}.to_text(), root.name));
        read_speech();
        for (const XmlNode* behaviour : behaviours_) read_behaviour(*behaviour);
        for (const XmlNode* function : functions_) read_function(*function);
        sort_marks(text_.marks);
        write_notes();
        return std::move(text_);
    }

  private:
    void read_root_attributes(const XmlNode& root) {
        std::vector<std::string> unread;
        for (const XmlAttribute& attribute : root.attributes) {
            const std::string& name = attribute.name;
            if (name.find(':') != std::string::npos || is_one_of(name, kRootAttributes)) continue;
            if (root.name == "bml")
                throw Error(format("{}: <{}> has no attribute {}; leave it out",
                                   Place{root, source_}.to_text(), root.name, name));
            unread.push_back(name);
        }
        if (!unread.empty()) note(root, format("{} of <{}> change nothing here", join(unread), root.name));
    }

    void refuse_text(const XmlNode& node) const {
        if (!is_blank(node))
            throw Error(format("{}: text lies outside <text>; words go into <speech><text>",
                               Place{node, source_}.to_text()));
    }

    // What a block holds, by its kind.
    void sort_children(const XmlNode& block) {
        for (const XmlNode& node : block.children) {
            if (node.is_text())
                refuse_text(node);
            else if (node.name == "speech")
                take_speech(node);
            else if (node.name == "fml")
                take_functions(node);
            else if ((node.name == "bml" && block.name == "fml-apml") || node.name == "required")
                sort_children(node);
            else if (is_one_of(node.name, kUnreadElements) || node.name.find(':') != std::string::npos)
                note(node, format("<{}> is not shown", node.name));
            else if (is_one_of(node.name, kBehaviours))
                take_behaviour(node);
            else
                refuse_element(node, source_, "BML", listed(kBehaviours));
        }
    }

    void take_speech(const XmlNode& node) {
        if (speech_)
            throw Error(
                format("{}: a second <speech>; put all words into one", Place{node, source_}.to_text()));
        speech_ = &node;
    }

    void take_behaviour(const XmlNode& node) {
        behaviours_.push_back(&node);
        syncs_.add_behaviour(node);
    }

    void take_functions(const XmlNode& block) {
        for (const XmlNode& node : block.children) {
            if (node.is_text())
                refuse_text(node);
            else
                functions_.push_back(&node);
        }
    }

    void read_speech() {
        for (const XmlAttribute& attribute : speech_->attributes)
            if (!is_one_of(attribute.name, kSpeechAttributes))
                throw Error(format("{}: <speech> has no attribute {}; it has {}",
                                   Place{*speech_, source_}.to_text(), attribute.name,
                                   join(listed(kSpeechAttributes))));
        read_words(*speech_);
        text_.script = script_.script();
        text_.words = find_words(text_.script);
        if (text_.words.empty())
            throw Error(format("{}: <speech> holds no word; write what is to be said inside <text>",
                               Place{*speech_, source_}.to_text()));
        const std::string id = attribute_or_empty(*speech_, "id");
        syncs_.set_speech(id.empty() ? "speech" : id, text_.words, speech_start());
    }

    // On the clock of the block [s].
    double speech_start() {
        const std::string written = attribute_or_empty(*speech_, "start");
        if (written.empty()) return 0;
        const std::optional<double> start = parse_number(trim(written));
        if (start && *start >= 0 && *start <= kLongestSpeech) return *start;
        note(*speech_,
             format("start \"{}\" of <speech> is no time from 0 to {} s; times in seconds count from its "
                    "first word",
                    written, kLongestSpeech));
        return 0;
    }

    void read_words(const XmlNode& parent) {
        for (const XmlNode& node : parent.children) {
            if (node.is_text()) {
                script_.add(node.text);
            } else if (node.name == "text" && &parent == speech_) {
                read_words(node);
            } else if (node.name == "sync" || node.name == "tm") {
                read_sync(node);
            } else if (node.name == "voice") {
                note(node, "<voice> is spoken as the words around it");
                read_words(node);
            } else if (node.name == "boundary" || node.name == "pitchaccent") {
                functions_.push_back(&node);
            } else if (node.name != "description") {
                refuse_element(node, source_, "a speech",
                               {"text", "sync", "tm", "voice", "boundary", "pitchaccent"});
            }
        }
    }

    void read_sync(const XmlNode& node) {
        SpeechSync sync{.id = attribute_or_empty(node, "id"), .byte = script_.size()};
        for (const XmlAttribute& attribute : node.attributes) {
            if (attribute.name == "time")
                sync.time = parse_number_in(attribute.value, {0, kLongestSpeech}, {node, source_}, "time");
            else if (attribute.name != "id")
                throw Error(format("{}: <{}> has no attribute {}; it has id and time",
                                   Place{node, source_}.to_text(), node.name, attribute.name));
        }
        if (sync.id.empty())
            throw Error(
                format("{}: <{}> has no id; write id=\"T0\"", Place{node, source_}.to_text(), node.name));
        script_.part();
        syncs_.add_sync(std::move(sync), node);
    }

    MarkTimes times_of(const XmlNode& node) {
        MarkTimes times;
        for (const XmlAttribute& attribute : node.attributes) {
            const auto name = std::find(std::begin(kSyncNames), std::end(kSyncNames), attribute.name);
            if (name != std::end(kSyncNames)) {
                const auto index = static_cast<std::size_t>(name - std::begin(kSyncNames));
                time_named(times, index) = syncs_.resolve(attribute.value, node, attribute.name);
            } else if (!is_one_of(attribute.name, kGestureAttributes)) {
                if (node.name == "gesture" && attribute.name.find(':') == std::string::npos)
                    throw Error(format("{}: <{}> has no attribute {}; it has {}, {}",
                                       Place{node, source_}.to_text(), node.name, attribute.name,
                                       join(listed(kSyncNames)), join(listed(kGestureAttributes))));
                note(node, format("{} of <{}> changes nothing here", attribute.name, node.name));
            }
        }
        return times;
    }

    // Whether a point is before another one, whenever the words are said.
    static bool is_before(const SyncPoint& point, const SyncPoint& other) {
        if (point.word == other.word) return point.offset < other.offset;
        return point.word && other.word && *point.word < *other.word && point.offset <= other.offset;
    }

    // Times of one gesture follow one another; those before the speech may lie before the motion.
    void check_order(const XmlNode& node, MarkTimes& times) {
        for (std::size_t later = 0; later < std::size(kSyncNames); ++later) {
            const std::optional<SyncPoint>& point = time_named(times, later);
            if (!point) continue;
            const std::string written = attribute_or_empty(node, kSyncNames[later]);
            for (std::size_t earlier = 0; earlier < later; ++earlier) {
                const std::optional<SyncPoint>& before = time_named(times, earlier);
                if (before && is_before(*point, *before))
                    throw Error(
                        format("{}: {} {} lies after {} {}; the times of a gesture follow one another: {}",
                               Place{node, source_}.to_text(), kSyncNames[earlier],
                               attribute_or_empty(node, kSyncNames[earlier]), kSyncNames[later], written,
                               join(listed(kSyncNames))));
            }
            if (!point->word && point->offset < 0)
                note(
                    node,
                    format(
                        "{} {} lies {} s before the speech, which starts at {} s; the motion may begin later",
                        kSyncNames[later], written, -point->offset, attribute_or_empty(*speech_, "start")));
        }
    }

    // What is asked of head, face or gaze, as the planner names it; "" if that is nothing that is shown.
    static std::string_view signal_asked_of(const XmlNode& node) {
        if (node.name == "gaze") {
            const std::string direction = to_lower(attribute_or_empty(node, "offsetDirection"));
            const bool is_aside = !direction.empty() && direction != "none";
            return is_aside ? "look away" : attribute_or_empty(node, "target").empty() ? "" : "look at";
        }
        const bool is_head = node.name == "head";
        if (!is_head && node.name != "face" && node.name != "faceLexeme") return "";
        const auto signal_of = is_head ? signal_of_head : signal_of_face;
        for (const char* attribute : {"lexeme", "type"}) {
            const std::string_view signal = signal_of(attribute_or_empty(node, attribute));
            if (!signal.empty()) return signal;
        }
        for (const XmlNode& child : node.children) {
            if (child.name == "lexeme") return signal_of(attribute_or_empty(child, "lexeme"));
            for (const XmlNode& part : child.children)
                if (part.name == "reference" && text_in(part).find(is_head ? "head" : "faceexp") == 0)
                    return signal_of(text_in(part));
        }
        return "";
    }

    // A head, a face or a gaze that is asked for itself and shows no function.
    void read_signal(const XmlNode& node, std::string_view signal) {
        Mark mark{.kind = MarkKind::signal, .value = std::string(signal), .weight = 1};
        mark.times = times_of(node);
        check_order(node, mark.times);
        const std::string amount = attribute_or_empty(node, "amount");
        if (!amount.empty()) {
            // 0.5 is the usual size.
            const double share = parse_number_in(amount, {0, 1}, {node, source_}, "amount");
            mark.manner[Expressivity::spatial_extent] = 2 * share - 1;
        }
        if (node.name == "gaze" && signal == "look at")
            note(node, format("\"{}\", at which <gaze> looks, is where the partner is",
                              attribute_or_empty(node, "target")));
        set_words(mark);
        text_.marks.push_back(std::move(mark));
    }

    // Whether its description refers to a function, which says more than a lexeme.
    static bool shows_function(const XmlNode& node) {
        for (const XmlNode& child : node.children)
            for (const XmlNode& part : child.children)
                if (part.name == "reference") {
                    const std::string text = text_in(part);
                    if (function_of_element(text.substr(0, text.find_first_of("= \t\r\n")))) return true;
                }
        return false;
    }

    void read_behaviour(const XmlNode& node) {
        if (!shows_function(node)) {
            if (const std::string_view signal = signal_asked_of(node); !signal.empty())
                return read_signal(node, signal);
        }
        const bool has_description = std::any_of(node.children.begin(), node.children.end(),
                                                 [](const XmlNode& c) { return c.name == "description"; });
        if (node.name != "gesture" && !has_description) {
            note_unshown(node);
            return;
        }
        Mark mark{.kind = MarkKind::gesture, .weight = 1};
        mark.times = times_of(node);
        if (node.name == "gesture") check_order(node, mark.times);
        if (!attribute_or_empty(node, "mode").empty())
            note(node, format("mode of <{}> is left to the speaker's handedness", node.name));
        for (const XmlNode& child : node.children) {
            if (child.is_text())
                refuse_text(child);
            else if (child.name == "description")
                read_description(child, mark);
            else
                refuse_element(child, source_, "a behaviour", {"description"});
        }
        set_words(mark);
        add_behaviour(node, std::move(mark));
    }

    void note_unshown(const XmlNode& node) {
        note(node, format("<{}> with neither a known lexeme nor a reference to a function is not shown",
                          node.name));
    }

    // What a gesture points at, by its target. Where things are is not known.
    std::string pointed_at(const XmlNode& node) {
        const std::string target = to_lower(attribute_or_empty(node, "target"));
        for (const std::string_view partner : kPartners)
            if (target.find(partner) != std::string::npos) return "partner";
        if (!target.empty())
            note(node, format("the place of \"{}\" is not known; <gesture> points to the side of the hand",
                              attribute_or_empty(node, "target")));
        return "object";
    }

    void add_behaviour(const XmlNode& node, Mark mark) {
        mark.value = attribute_or_empty(node, "lexeme");
        if (node.name != "gesture") {
            if (mark.reference.empty()) {
                note_unshown(node);
                return;
            }
            const std::string function = std::exchange(mark.reference, "");
            const std::size_t sign = function.find('=');
            mark.kind = function_of_element(function.substr(0, sign))->kind;
            mark.value = sign == std::string::npos ? "" : function.substr(sign + 1);
            mark.times = {};
        } else if (mark.value.empty()) {
            mark.value = mark.reference;
        } else if (mark.reference.empty()) {
            mark.reference = function_of_gesture(mark.value);
            if (mark.reference == "deictic=object") mark.reference = "deictic=" + pointed_at(node);
        }
        if (node.name == "gesture" && mark.value.empty())
            throw Error(
                format("{}: <gesture> names neither a lexeme nor a <reference>; write "
                       "lexeme=\"a gesture of the lexicon\"",
                       Place{node, source_}.to_text()));
        if (mark.kind == MarkKind::gesture && mark.reference.empty())
            text_.asked_gestures.push_back({mark.value, Place{node, source_}.to_text()});
        text_.marks.push_back(std::move(mark));
    }

    void read_description(const XmlNode& description, Mark& mark) {
        for (const XmlNode& node : description.children) {
            if (node.is_text()) {
                refuse_text(node);
                continue;
            }
            const std::string text = text_in(node);
            const Place place{node, source_};
            const auto dimension = std::find_if(std::begin(kDescribed), std::end(kDescribed),
                                                [&](const Described& d) { return d.element == node.name; });
            if (dimension != std::end(kDescribed)) {
                const NumberRange range{least_of(dimension->dimension), 1};
                mark.manner[dimension->dimension] = parse_number_in(text, range, place, node.name);
            } else if (is_one_of(node.name, kUnshown)) {
                if (parse_number_in(text, {-1, 1}, place, node.name) != 0)
                    note(node, format("{} has no dimension of expressivity here", node.name));
            } else if (node.name == "intensity") {
                mark.weight = parse_number_in(text, {}, place, node.name);
            } else if (node.name == "reference") {
                mark.reference = reference_in(node, text);
            } else {
                std::vector<std::string> known = {"reference", "intensity", "OPN.value", "TEN.value"};
                for (const Described& described : kDescribed) known.emplace_back(described.element);
                refuse_element(node, source_, "a description", known);
            }
        }
    }

    // "performative=ask Ges B" shows "performative=ask".
    std::string reference_in(const XmlNode& node, const std::string& text) {
        const std::string function = text.substr(0, text.find_first_of(" \t\r\n"));
        const std::size_t sign = function.find('=');
        const FunctionKind* kind = function_of_element(function.substr(0, sign));
        if (!kind || kind->kind == MarkKind::gesture) {
            note(node, format("reference \"{}\" names no function", text));
            return "";
        }
        std::string name(name_of(kind->kind));
        const std::string value =
            sign == std::string::npos ? "" : known_value(*kind, std::string_view(function).substr(sign + 1));
        if (!value.empty()) return name + "=" + value;
        if (kind->kind == MarkKind::deictic) name += "=object";
        if (sign != std::string::npos)
            note(node, format("reference \"{}\" has no known value and is read as {}", text, name));
        return name;
    }

    // From the first to the last time of the act; over all words if one of these times is not given by a word.
    void set_words(Mark& mark) const {
        const std::size_t count = text_.words.size();
        std::size_t first = count;
        std::size_t end = 0;
        for (std::size_t name = 0; name < std::size(kSyncNames); ++name) {
            const std::optional<SyncPoint>& point = time_named(mark.times, name);
            if (!point) continue;
            first = std::min(first, point->word.value_or(0));
            end = std::max(end, point->word.value_or(count));
        }
        const bool has_times = mark.times != MarkTimes{};
        mark.first_word = has_times ? std::min(first, count - 1) : 0;
        mark.end_word = has_times ? std::max(end, mark.first_word + 1) : count;
    }

    std::size_t word_of(const XmlNode& node, std::string_view attribute, std::size_t otherwise) {
        const std::string written = attribute_or_empty(node, attribute);
        if (written.empty()) return otherwise;
        const SyncPoint point = syncs_.resolve(written, node, attribute);
        if (!point.word)
            throw Error(
                format("{}: {} {} is a time, and no sync point of the speech gives its word; write one such "
                       "as sp1:start",
                       Place{node, source_}.to_text(), attribute, written));
        if (point.offset != 0) note(node, "a function begins and ends with words; the offset is left out");
        return *point.word;
    }

    // The kind of an element of FML; nothing if no behaviour shows it.
    const FunctionKind* kind_in(const XmlNode& node) {
        const FunctionKind* kind = function_of_element(node.name);
        if (kind && kind->kind != MarkKind::gesture) return kind;
        std::vector<std::string> known;
        for (const FunctionKind& each : function_kinds())
            if (each.kind != MarkKind::gesture) known.emplace_back(each.element);
        if (kind || nearest_name(node.name, known)) refuse_element(node, source_, "FML", known);
        note(node, format("<{}> of FML is not shown", node.name));
        return nullptr;
    }

    // Whether GRETA writes a function so that nothing here shows it.
    bool is_unshown(const XmlNode& node, const FunctionKind& kind) {
        const std::string type = attribute_or_empty(node, "type");
        if (kind.kind == MarkKind::world && type.empty())
            note(node, "<world> without a type is not shown");
        else if (kind.kind == MarkKind::emotion && to_lower(type) == "neutral")
            note(node, "emotion neutral is not shown");
        else if (kind.kind == MarkKind::backchannel && parse_number(attribute_or_empty(node, "start")) &&
                 !syncs_.resolve(attribute_or_empty(node, "start"), node, "start").word)
            note(node, "<backchannel> at a time that no sync point of the speech gives is not shown");
        else
            return false;
        return true;
    }

    // The attributes that change nothing, which are noted, and those that the caller reads.
    std::vector<std::string_view> others_of(const XmlNode& node, const FunctionKind& kind) {
        std::vector<std::string_view> others(std::begin(kFunctionTimes), std::end(kFunctionTimes));
        for (const XmlAttribute& attribute : node.attributes) {
            const bool is_level = attribute.name == "level" && kind.kind == MarkKind::pitch_accent;
            if (!is_level && !is_one_of(attribute.name, kUnreadOfFunctions)) continue;
            note(node, format("{} of <{}> changes nothing here", attribute.name, node.name));
            others.push_back(attribute.name);
        }
        return others;
    }

    void read_function(const XmlNode& node) {
        const FunctionKind* kind = kind_in(node);
        if (!kind || is_unshown(node, *kind)) return;
        for (const XmlNode& child : node.children) refuse_text(child);
        const std::size_t first = word_of(node, "start", 0);
        const std::size_t end = word_of(node, "end", kind->is_place ? first : text_.words.size());
        if (end < first || (end == first && !kind->is_place))
            throw Error(format("{}: <{}> begins before word {} and ends before word {}; it must hold a word",
                               Place{node, source_}.to_text(), node.name, first + 1, end + 1));
        for (Mark& mark : marks_of_element(node, *kind, source_, others_of(node, *kind))) {
            mark.first_word = first;
            mark.end_word = kind->kind == MarkKind::boundary ? first : end;
            text_.marks.push_back(std::move(mark));
        }
    }

    // What cannot be shown is reported once for each kind, with its first place.
    void note(const XmlNode& node, const std::string& what) {
        auto [found, is_new] = notes_.try_emplace(what, Noted{&node, 0});
        ++found->second.count;
    }

    void write_notes() {
        std::vector<std::pair<const XmlNode*, std::string>> notes;
        for (const auto& [what, noted] : notes_)
            notes.emplace_back(noted.first,
                               noted.count == 1 ? what : format("{} ({} times)", what, noted.count));
        std::sort(notes.begin(), notes.end(), [](const auto& a, const auto& b) {
            return std::pair(a.first->at, a.second) < std::pair(b.first->at, b.second);
        });
        constexpr std::size_t kMost = 50;
        for (std::size_t i = 0; i < std::min(notes.size(), kMost); ++i)
            text_.notes.push_back(
                format("{}: {}", Place{*notes[i].first, source_}.to_text(), notes[i].second));
        if (notes.size() > kMost) text_.notes.push_back(format("{} more of this kind", notes.size() - kMost));
    }

    struct Noted {
        const XmlNode* first;
        std::size_t count;
    };

    XmlSource source_;
    SyncPoints syncs_;
    ScriptBuilder script_;
    MarkedText text_;
    const XmlNode* speech_ = nullptr;
    std::vector<const XmlNode*> behaviours_;
    std::vector<const XmlNode*> functions_;
    std::map<std::string, Noted> notes_;
};

}  // namespace

MarkedText parse_bml(const MarkupSource& source) {
    const XmlSource xml{source.text, source.name};
    const XmlNode root = parse_xml(xml);
    return BmlReader(xml).read(root);
}

}  // namespace chironomia
