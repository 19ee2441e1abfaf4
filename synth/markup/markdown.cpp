#include "synth/markup/markdown.h"

#include <md4c.h>

#include "core/text.h"
#include "synth/markup/script_words.h"

namespace chironomia {
namespace {

// md4c calls it for each beginning, end and text.
class Reader {
  public:
    std::optional<SpokenMarkdown> read(std::string_view text) {
        has_hashes_ = text.find('#') != std::string_view::npos;
        MD_PARSER parser{};
        parser.flags = MD_FLAG_NOHTML;
        parser.enter_block = [](MD_BLOCKTYPE type, void* detail, void* reader) {
            return static_cast<Reader*>(reader)->enter_block(type, detail);
        };
        parser.leave_block = [](MD_BLOCKTYPE type, void*, void* reader) {
            return static_cast<Reader*>(reader)->leave_block(type);
        };
        parser.enter_span = [](MD_SPANTYPE type, void*, void* reader) {
            return static_cast<Reader*>(reader)->enter_span(type);
        };
        parser.leave_span = [](MD_SPANTYPE type, void*, void* reader) {
            return static_cast<Reader*>(reader)->leave_span(type);
        };
        parser.text = [](MD_TEXTTYPE type, const MD_CHAR* begin, MD_SIZE size, void* reader) {
            return static_cast<Reader*>(reader)->add_text(type, {begin, size});
        };
        const bool is_read = md_parse(text.data(), static_cast<MD_SIZE>(text.size()), &parser, this) == 0;
        if (!is_read || !has_signs_) return std::nullopt;
        return std::move(spoken_);
    }

  private:
    struct List {
        bool is_numbered = false;
        unsigned next = 1;
    };

    int enter_block(MD_BLOCKTYPE type, void* detail) {
        // One that is underlined has no sign that is spoken.
        if (type == MD_BLOCK_H) has_signs_ |= has_hashes_;
        if (type == MD_BLOCK_CODE) has_signs_ |= static_cast<MD_BLOCK_CODE_DETAIL*>(detail)->fence_char != 0;
        if (type == MD_BLOCK_UL) {
            has_signs_ |= static_cast<MD_BLOCK_UL_DETAIL*>(detail)->mark != '-';
            lists_.push_back({});
        }
        if (type == MD_BLOCK_OL)
            lists_.push_back({.is_numbered = true, .next = static_cast<MD_BLOCK_OL_DETAIL*>(detail)->start});
        if (type == MD_BLOCK_LI) {
            end_line();
            if (lists_.back().is_numbered) spoken_.text += format("{}. ", lists_.back().next++);
        }
        return 0;
    }

    int leave_block(MD_BLOCKTYPE type) {
        if (type == MD_BLOCK_UL || type == MD_BLOCK_OL) lists_.pop_back();
        if (type == MD_BLOCK_H || type == MD_BLOCK_LI) end_sentence();
        if (type == MD_BLOCK_P || type == MD_BLOCK_CODE) end_line();
        return 0;
    }

    int enter_span(MD_SPANTYPE type) {
        const bool is_emphasis = type == MD_SPAN_EM || type == MD_SPAN_STRONG;
        // 2*3*4 is no emphasis.
        const bool is_inside = is_emphasis && ends_in_word();
        has_signs_ |= !is_inside;
        if (is_inside) spoken_.text += sign_of(type);
        if (is_emphasis) open_.push_back({.begin = spoken_.text.size(), .is_inside = is_inside});
        return 0;
    }

    int leave_span(MD_SPANTYPE type) {
        if (type != MD_SPAN_EM && type != MD_SPAN_STRONG) return 0;
        const Open open = open_.back();
        open_.pop_back();
        if (open.is_inside) {
            spoken_.text += sign_of(type);
        } else {
            spoken_.emphases.push_back(
                {.begin = open.begin, .end = spoken_.text.size(), .is_strong = type == MD_SPAN_STRONG});
        }
        return 0;
    }

    int add_text(MD_TEXTTYPE type, std::string_view text) {
        spoken_.text += type == MD_TEXT_SOFTBR || type == MD_TEXT_BR ? "\n" : text;
        return 0;
    }

    static std::string_view sign_of(MD_SPANTYPE type) { return type == MD_SPAN_STRONG ? "**" : "*"; }

    // Of Latin letters or digits: other scripts part words without spaces.
    bool ends_in_word() const {
        const char last = spoken_.text.empty() ? ' ' : spoken_.text.back();
        return (last >= '0' && last <= '9') || (last >= 'A' && last <= 'Z') || (last >= 'a' && last <= 'z');
    }

    void end_line() {
        if (!spoken_.text.empty() && !spoken_.text.ends_with('\n')) spoken_.text += '\n';
    }

    void end_sentence() {
        const std::size_t last = spoken_.text.find_last_not_of(" \n");
        if (last != std::string::npos) {
            spoken_.text.resize(last + 1);
            std::size_t character = last;
            while (character > 0 && (static_cast<unsigned char>(spoken_.text[character]) & 0xc0) == 0x80)
                --character;
            if (!is_punctuated(spoken_.text.substr(character))) spoken_.text += '.';
        }
        end_line();
    }

    struct Open {
        std::size_t begin = 0;
        bool is_inside = false;  // of a word
    };

    SpokenMarkdown spoken_;
    std::vector<Open> open_;
    std::vector<List> lists_;
    bool has_signs_ = false, has_hashes_ = false;
};

}  // namespace

std::optional<SpokenMarkdown> read_markdown(std::string_view text) {
    return Reader().read(text);
}

}  // namespace chironomia
