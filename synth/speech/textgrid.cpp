#include "synth/speech/textgrid.h"

#include <algorithm>
#include <cstddef>
#include <optional>

#include "core/error.h"
#include "core/text.h"
#include "synth/speech/label_tiers.h"

namespace chironomia {
namespace {

struct Token {
    enum class Kind { number, text, flag };

    Kind kind = Kind::number;
    std::string text;
    double number = 0;
    std::size_t line = 1;
};

// Numbers, quoted texts and flags, one after the other.
class Tokens {
  public:
    Tokens(std::string_view text, const std::string& file) : rest_(text), file_(file) {}

    double number(const char* what) { return next(Token::Kind::number, what).number; }
    std::string text(const char* what) { return next(Token::Kind::text, what).text; }
    void flag(const char* what) { next(Token::Kind::flag, what); }
    std::size_t line() const { return line_; }

    std::size_t count(const char* what) {
        const double value = number(what);
        // Each interval takes up more than one byte.
        if (value < 0 || value > static_cast<double>(rest_.size() + 1) ||
            value != static_cast<std::size_t>(value)) {
            throw Error(format("{}: line {}: the {} is {}, which the file cannot hold; save it again", file_,
                               line_, what, value));
        }
        return static_cast<std::size_t>(value);
    }

  private:
    Token next(Token::Kind kind, const char* what) {
        for (;;) {
            const std::optional<Token> token = token_or_word();
            if (!token) continue;
            if (token->kind == kind) return *token;
            throw Error(format("{}: line {}: \"{}\" stands where the {} should be; save the TextGrid again",
                               file_, token->line, token->text, what));
        }
    }

    // Nothing for a word that is there for the reader's eyes.
    std::optional<Token> token_or_word() {
        skip_space();
        if (rest_.empty())
            throw Error(format("{}: line {}: the TextGrid ends too early; save it again", file_, line_));
        if (rest_[0] == '"') return quoted();
        const std::string_view word = take(std::min(rest_.find_first_of(" \t\r\n"), rest_.size()));
        if (word[0] == '!') {
            take(std::min(rest_.find('\n'), rest_.size()));
            return std::nullopt;
        }
        if (word[0] == '<') return Token{.kind = Token::Kind::flag, .text = std::string(word), .line = line_};
        const std::optional<double> number = parse_number(word);
        if (!number) return std::nullopt;
        return Token{
            .kind = Token::Kind::number, .text = std::string(word), .number = *number, .line = line_};
    }

    // "He said ""yes""." over any number of lines.
    Token quoted() {
        Token token{.kind = Token::Kind::text, .line = line_};
        take(1);
        for (;;) {
            const std::size_t end = rest_.find('"');
            if (end == std::string_view::npos) {
                throw Error(
                    format("{}: line {}: a text has no closing quotation mark; save the TextGrid again",
                           file_, token.line));
            }
            token.text += take(end);
            take(1);
            if (!rest_.starts_with('"')) return token;
            token.text += take(1);
        }
    }

    void skip_space() { take(std::min(rest_.find_first_not_of(" \t\r\n"), rest_.size())); }

    std::string_view take(std::size_t bytes) {
        const std::string_view part = rest_.substr(0, bytes);
        line_ += static_cast<std::size_t>(std::count(part.begin(), part.end(), '\n'));
        rest_.remove_prefix(part.size());
        return part;
    }

    std::string_view rest_;
    std::string file_;
    std::size_t line_ = 1;
};

LabelTier read_tier(Tokens& tokens) {
    LabelTier tier;
    tier.has_intervals = tokens.text("class of a tier") == "IntervalTier";
    tier.name = tokens.text("name of a tier");
    tokens.number("start of a tier");
    tokens.number("end of a tier");
    const std::size_t count = tokens.count("number of intervals");
    for (std::size_t i = 0; i < count; ++i) {
        TimedLabel label;
        label.start = tokens.number("start of an interval");
        label.where = format("line {}", tokens.line());
        if (tier.has_intervals) label.end = tokens.number("end of an interval");
        label.text = tokens.text("text of an interval");
        tier.labels.push_back(label);
    }
    return tier;
}

}  // namespace

bool is_textgrid(std::string_view text) {
    const std::string_view head = text.substr(0, 400);
    return head.find("ooTextFile") != std::string_view::npos &&
           head.find("TextGrid") != std::string_view::npos;
}

TimedLabels read_textgrid(std::string_view text, const std::string& file, std::string_view speaker) {
    Tokens tokens(text, file);
    tokens.text("kind of file");
    tokens.text("kind of object");
    tokens.number("start");
    tokens.number("end");
    tokens.flag("mark that tiers exist");
    std::vector<LabelTier> tiers(tokens.count("number of tiers"));
    for (LabelTier& tier : tiers) tier = read_tier(tokens);
    return labels_of_tiers(tiers, file, speaker);
}

}  // namespace chironomia
