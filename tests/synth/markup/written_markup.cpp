#include "tests/synth/markup/written_markup.h"

#include <algorithm>
#include <span>
#include <string_view>
#include <utility>
#include <vector>

#include "core/files/xml_text.h"
#include "core/text.h"
#include "synth/markup/functions.h"
#include "synth/markup/sync_points.h"

namespace chironomia::testing {
namespace {

// ' type="greet" weight="0.3" spc="1"'
std::string attributes_of(const Mark& mark) {
    std::string text;
    const FunctionKind& kind = function_kind(mark.kind);
    if (!mark.value.empty())
        text +=
            format(" {}=\"{}\"", mark.kind == MarkKind::gesture ? "name" : "type", escape_xml(mark.value));
    if (!mark.reference.empty()) text += format(" reference=\"{}\"", escape_xml(mark.reference));
    if (mark.weight != default_weight(kind.kind, mark.value)) text += format(" weight=\"{}\"", mark.weight);
    for (std::size_t i = 0; i < kExpressivities; ++i)
        if (const std::optional<double> value = mark.manner.values[i])
            text += format(" {}=\"{}\"", symbol_of(static_cast<Expressivity>(i)), *value);
    return text;
}

class AplmWriter {
  public:
    explicit AplmWriter(const MarkedText& text) : text_(text), marks_(text.marks) { sort_marks(marks_); }

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

constexpr std::pair<std::string_view, Expressivity> kDescribed[] = {
    {"OAC.value", Expressivity::overall_activation},
    {"SPC.value", Expressivity::spatial_extent},
    {"TMP.value", Expressivity::temporal_extent},
    {"FLD.value", Expressivity::fluidity},
    {"PWR.value", Expressivity::power},
    {"REP.value", Expressivity::repetition},
};

// Over the sync points T0, T1, ... before each word of "sp1".
std::string written_time(const SyncPoint& point) {
    if (!point.word) return format("{}", point.offset);
    return point.offset == 0 ? format("sp1:T{}", *point.word)
                             : format("sp1:T{}{:+.6f}", *point.word, point.offset);
}

std::string written_speech(const MarkedText& text) {
    std::string written = "<speech id=\"sp1\" start=\"0\"><text>";
    std::size_t at = 0;
    for (std::size_t word = 0; word < text.words.size(); ++word) {
        const auto piece = [&](std::size_t end) {
            return escape_xml(std::string_view(text.script).substr(at, end - at));
        };
        written += format("{}<sync id=\"T{}\"/>", piece(text.words[word].begin), word);
        at = text.words[word].begin;
        written += piece(text.words[word].end);
        at = text.words[word].end;
    }
    written += format("<sync id=\"T{}\"/>{}", text.words.size(),
                      escape_xml(std::string_view(text.script).substr(at)));
    return written + "</text></speech>\n";
}

std::string written_gesture(const Mark& mark, std::size_t id) {
    std::string written = format("<gesture id=\"g{}\" lexeme=\"{}\"", id, escape_xml(mark.value));
    MarkTimes times = mark.times;
    if (times == MarkTimes{}) {
        times.start = SyncPoint{mark.first_word, 0};
        times.end = SyncPoint{mark.end_word, 0};
    }
    for (std::size_t name = 0; name < std::size(kSyncNames); ++name)
        if (const std::optional<SyncPoint>& point = time_named(times, name))
            written += format(" {}=\"{}\"", kSyncNames[name], written_time(*point));
    written +=
        format("><description priority=\"1\" type=\"gretabml\"><intensity>{}</intensity>", mark.weight);
    if (!mark.reference.empty()) written += format("<reference>{}</reference>", escape_xml(mark.reference));
    for (const auto& [element, dimension] : kDescribed)
        if (mark.manner[dimension]) written += format("<{0}>{1}</{0}>", element, *mark.manner[dimension]);
    return written + "</description></gesture>\n";
}

std::string written_function(const Mark& mark) {
    return format("<{}{} start=\"sp1:T{}\" end=\"sp1:T{}\"/>\n", function_kind(mark.kind).element,
                  attributes_of(mark), mark.first_word, mark.end_word);
}

}  // namespace

std::string to_aplm(const MarkedText& text) {
    return AplmWriter(text).write();
}

std::string to_bml(const MarkedText& text) {
    std::string behaviours;
    std::string functions;
    for (std::size_t i = 0; i < text.marks.size(); ++i) {
        if (text.marks[i].kind == MarkKind::gesture)
            behaviours += written_gesture(text.marks[i], i);
        else
            functions += written_function(text.marks[i]);
    }
    const std::string block = "<bml>\n" + written_speech(text) + behaviours + "</bml>\n";
    return functions.empty() ? block
                             : "<fml-apml>\n" + block + "<fml>\n" + functions + "</fml>\n</fml-apml>\n";
}

}  // namespace chironomia::testing
