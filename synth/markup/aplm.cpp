#include "synth/markup/aplm.h"

#include <algorithm>
#include <iterator>
#include <set>
#include <utility>
#include <vector>

#include "core/error.h"
#include "core/text.h"
#include "synth/markup/acts.h"
#include "synth/markup/script_builder.h"
#include "synth/markup/script_words.h"
#include "synth/markup/word_spans.h"
#include "synth/markup/xml.h"

namespace chironomia {
namespace {

// An element before the words are known.
struct Span {
    const XmlNode* element = nullptr;
    const FunctionKind* kind = nullptr;
    std::size_t begin = 0;  // byte in the script
    std::size_t end = 0;
};

std::vector<std::string> elements_known() {
    std::vector<std::string> names;
    for (const FunctionKind& kind : function_kinds()) names.emplace_back(kind.element);
    return names;
}

// Words of a phrase do not run into those of the next; those of an emphasised part of a word do.
bool is_phrase(MarkKind kind) {
    return kind == MarkKind::theme || kind == MarkKind::rheme || kind == MarkKind::performative ||
           kind == MarkKind::turn || kind == MarkKind::boundary;
}

// Of acts, in apml.dtd as MARY TTS has it (marytts-common/src/main/resources/marytts/dtd/apml.dtd).
constexpr std::string_view kUnread[] = {"duration", "delay",  "intensity",
                                        "onset",    "offset", "meta-cognitive"};

class AplmReader {
  public:
    explicit AplmReader(const XmlSource& source) : source_(source) {}

    MarkedText read(const XmlNode& root) {
        const bool is_apml = to_lower(root.name) == "apml";
        if (to_lower(root.name) != "aplm" && !is_apml)
            refuse_element(root, source_, "APLM that begins a text", {"APLM"});
        if (is_apml) note(root, format("<{}> is read as <APLM>", root.name));
        for (const XmlAttribute& attribute : root.attributes)
            if (!attribute.name.starts_with("xml"))
                throw Error(format("{}: <{}> has no attribute {}; give the manner to the acts inside",
                                   Place{root, source_}.to_text(), root.name, attribute.name));
        read_children(root);
        MarkedText text{.script = script_.script(), .words = find_words(script_.script())};
        if (text.words.empty())
            throw Error(format("{}: <{}> holds no word; write what is to be said inside",
                               Place{root, source_}.to_text(), root.name));
        for (const Span& span : spans_) place(span, text);
        sort_marks(text.marks);
        for (const std::string& attribute : unread_)
            note(root, format("attribute {} changes nothing here", attribute));
        text.notes = std::move(notes_);
        return text;
    }

  private:
    void read_children(const XmlNode& parent) {
        for (const XmlNode& node : parent.children) {
            if (node.is_text())
                script_.add(node.text);
            else
                read_element(node);
        }
    }

    void read_element(const XmlNode& element) {
        const FunctionKind* kind = function_of_element(element.name);
        if (!kind) refuse_element(element, source_, "APLM", elements_known());
        if (is_phrase(kind->kind)) script_.part();
        const std::size_t index = spans_.size();
        spans_.push_back({&element, kind, script_.size(), 0});
        read_children(element);
        spans_[index].end = script_.size();
        if (is_phrase(kind->kind)) script_.part();
    }

    void note(const XmlNode& element, const std::string& what) {
        notes_.push_back(format("{}: {}", Place{element, source_}.to_text(), what));
    }

    // Without what older files say of an act that changes nothing here.
    XmlNode without_unread(const XmlNode& written) {
        XmlNode element{.name = written.name, .at = written.at, .attributes = written.attributes};
        std::erase_if(element.attributes, [&](const XmlAttribute& attribute) {
            const bool is_timing =
                std::find(std::begin(kUnread), std::end(kUnread), attribute.name) != std::end(kUnread);
            const bool is_direction = attribute.name == "deictic" && attribute.value.size() == 1;
            if (is_timing) unread_.insert(attribute.name);
            if (is_direction) note(element, format("deictic \"{}\" shows nothing here", attribute.value));
            return is_timing || is_direction;
        });
        return element;
    }

    void place(const Span& span, MarkedText& text) {
        const bool is_empty = span.begin == span.end;
        const std::size_t first =
            is_empty ? word_from(text.words, span.begin) : word_at(text.words, span.begin);
        const std::size_t end = is_empty ? first : word_from(text.words, span.end);
        if (first >= end && !span.kind->is_place)
            throw Error(format("{}: <{}> holds no word; put it around the words that it is about",
                               Place{*span.element, source_}.to_text(), span.element->name));
        if (!is_empty && span.kind->kind == MarkKind::boundary)
            throw Error(format("{}: <{}> holds words; write <boundary type=\"LL\"/> behind them",
                               Place{*span.element, source_}.to_text(), span.element->name));
        const XmlNode element = without_unread(*span.element);
        for (Mark& mark : marks_of_element(element, *span.kind, source_)) {
            mark.first_word = first;
            mark.end_word = std::max(first, end);
            if (mark.kind == MarkKind::gesture && mark.reference.empty())
                text.asked_gestures.push_back({mark.value, Place{*span.element, source_}.to_text()});
            text.marks.push_back(std::move(mark));
        }
    }

    XmlSource source_;
    ScriptBuilder script_;
    std::vector<Span> spans_;
    std::vector<std::string> notes_;
    std::set<std::string> unread_;  // attributes
};

}  // namespace

MarkedText parse_aplm(const MarkupSource& source) {
    const XmlSource xml{source.text, source.name};
    return AplmReader(xml).read(parse_xml(xml));
}

}  // namespace chironomia
