#include "synth/speech/textgrid.h"

#include <algorithm>
#include <array>
#include <cstddef>
#include <optional>

#include "core/error.h"
#include "core/text.h"

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

struct Tier {
    std::string name;
    bool has_intervals = false;
    std::vector<TimedLabel> labels;
};

Tier read_tier(Tokens& tokens) {
    Tier tier;
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

bool is_named(const Tier& tier, std::initializer_list<std::string_view> names) {
    const std::string name = to_lower(trim(tier.name));
    return tier.has_intervals && std::any_of(names.begin(), names.end(), [&](std::string_view wanted) {
               return name == wanted || name.ends_with(" - " + std::string(wanted));
           });
}

std::string names_of(const std::vector<Tier>& tiers) {
    std::vector<std::string> names;
    for (const Tier& tier : tiers) names.push_back("\"" + tier.name + "\"");
    return join(names);
}

// The tier that has one of these names; nothing if none has.
const Tier* find_tier(const std::vector<Tier>& tiers, std::initializer_list<std::string_view> names,
                      const std::string& file) {
    std::vector<const Tier*> found;
    for (const Tier& tier : tiers)
        if (is_named(tier, names)) found.push_back(&tier);
    if (found.size() > 1) {
        throw Error(format("{}: the tiers \"{}\" and \"{}\" are both named as {}; keep those of one speaker",
                           file, found[0]->name, found[1]->name, *names.begin()));
    }
    return found.empty() ? nullptr : found[0];
}

bool is_silence(const TimedLabel& label) {
    static constexpr std::array<std::string_view, 9> kSilences = {"",      "sil", "sp",   "spn", "<eps>",
                                                                  "<sil>", "<p>", "<p:>", "#"};
    const std::string text = to_lower(trim(label.text));
    return std::find(kSilences.begin(), kSilences.end(), text) != kSilences.end();
}

}  // namespace

bool is_textgrid(std::string_view text) {
    const std::string_view head = text.substr(0, 400);
    return head.find("ooTextFile") != std::string_view::npos &&
           head.find("TextGrid") != std::string_view::npos;
}

TimedLabels read_textgrid(std::string_view text, const std::string& file) {
    Tokens tokens(text, file);
    tokens.text("kind of file");
    tokens.text("kind of object");
    tokens.number("start");
    tokens.number("end");
    tokens.flag("mark that tiers exist");
    std::vector<Tier> tiers(tokens.count("number of tiers"));
    for (Tier& tier : tiers) tier = read_tier(tokens);

    const Tier* words = find_tier(tiers, {"words", "word", "ort-mau"}, file);
    const Tier* phones = find_tier(tiers, {"phones", "phone", "phonemes", "phoneme", "segments"}, file);
    const auto is_intervals = [](const Tier& tier) { return tier.has_intervals; };
    if (words == nullptr && phones == nullptr && std::count_if(tiers.begin(), tiers.end(), is_intervals) == 1)
        words = &*std::find_if(tiers.begin(), tiers.end(), is_intervals);
    if (words == nullptr && phones == nullptr) {
        throw Error(format("{}: none of its tiers ({}) is named \"words\"; name the tier of words so", file,
                           tiers.empty() ? "none" : names_of(tiers)));
    }
    TimedLabels labels;
    if (words != nullptr) labels.words = words->labels;
    if (phones != nullptr) labels.phones = phones->labels;
    std::erase_if(labels.words, is_silence);
    return labels;
}

}  // namespace chironomia
