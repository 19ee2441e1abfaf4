#include "synth/markup/aplm.h"

#include <vector>

#include "core/error.h"
#include "core/files/xml_text.h"
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

class AplmReader {
  public:
    explicit AplmReader(const XmlSource& source) : source_(source) {}

    MarkedText read(const XmlNode& root) {
        if (to_lower(root.name) != "aplm") refuse_element(root, source_, "APLM that begins a text", {"APLM"});
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

    void place(const Span& span, MarkedText& text) const {
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
        for (Mark& mark : marks_of_element(*span.element, *span.kind, source_)) {
            mark.first_word = first;
            mark.end_word = std::max(first, end);
            text.marks.push_back(std::move(mark));
        }
    }

    XmlSource source_;
    ScriptBuilder script_;
    std::vector<Span> spans_;
};

void refuse_unwritable(const Mark& mark) {
    if (mark.times != MarkTimes{})
        throw Error(format("APLM: the gesture {} has times, and APLM has none; write BML", mark.value));
}

class Writer {
  public:
    explicit Writer(const MarkedText& text) : text_(text), marks_(text.marks) { sort_marks(marks_); }

    std::string write() {
        std::size_t at = 0;
        for (std::size_t word = 0; word < text_.words.size(); ++word) {
            write_places(word);
            write_script(at, text_.words[word].begin);
            open(word);
            write_script(text_.words[word].begin, text_.words[word].end);
            at = text_.words[word].end;
            close(word + 1);
        }
        write_places(text_.words.size());
        write_script(at, text_.script.size());
        return "<APLM>\n" + written_ + "\n</APLM>\n";
    }

  private:
    void write_script(std::size_t begin, std::size_t end) {
        written_ += escape_xml(std::string_view(text_.script).substr(begin, end - begin));
    }

    static std::string_view element_of(const Mark& mark) { return function_kind(mark.kind).element; }

    void write_places(std::size_t word) {
        for (const Mark& mark : marks_at(word))
            if (mark.first_word == mark.end_word)
                written_ += format("<{}{}/>", element_of(mark), attributes_of(mark));
    }

    void open(std::size_t word) {
        for (const Mark& mark : marks_at(word)) {
            if (mark.first_word == mark.end_word) continue;
            refuse_unwritable(mark);
            if (!open_.empty() && open_.back()->end_word < mark.end_word)
                throw Error(
                    format("APLM: {} over the words {} to {} crosses {} over {} to {}, and elements cannot "
                           "cross; write BML",
                           function_of(mark), mark.first_word, mark.end_word, function_of(*open_.back()),
                           open_.back()->first_word, open_.back()->end_word));
            written_ += format("<{}{}>", element_of(mark), attributes_of(mark));
            open_.push_back(&mark);
        }
    }

    void close(std::size_t end_word) {
        for (; !open_.empty() && open_.back()->end_word == end_word; open_.pop_back())
            written_ += format("</{}>", element_of(*open_.back()));
    }

    std::span<const Mark> marks_at(std::size_t word) const {
        const auto is_before = [](const Mark& mark, std::size_t w) { return mark.first_word < w; };
        const auto first = std::lower_bound(marks_.begin(), marks_.end(), word, is_before);
        const auto end = std::lower_bound(first, marks_.end(), word + 1, is_before);
        return {first, end};
    }

    const MarkedText& text_;
    std::vector<Mark> marks_;
    std::vector<const Mark*> open_;
    std::string written_;
};

}  // namespace

MarkedText parse_aplm(const MarkupSource& source) {
    const XmlSource xml{source.text, source.name};
    return AplmReader(xml).read(parse_xml(xml));
}

std::string to_aplm(const MarkedText& text) {
    if (text.is_ssml)
        throw Error(
            "APLM: the text is SSML, whose tags APLM does not have; write the marks of its words alone");
    return Writer(text).write();
}

}  // namespace chironomia
