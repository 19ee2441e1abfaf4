#include "synth/corpus/make/text.h"

#include <algorithm>
#include <array>
#include <cassert>
#include <cmath>

#include "core/text.h"
#include "synth/markup/functions.h"
#include "synth/markup/script_words.h"
#include "synth/text/stable_hash.h"

namespace chironomia {
namespace {

// How much a speaker likes something, above 0.
double liking(const Idiolect& idiolect, std::string_view thing) {
    return std::exp(Random(idiolect.seed, stable_hash(thing)).normal() / idiolect.temperature);
}

std::size_t draw(const std::vector<double>& weights, Random& random) {
    double total = 0;
    for (const double weight : weights) total += weight;
    double left = random.uniform() * total;
    for (std::size_t i = 0; i < weights.size(); ++i) {
        left -= weights[i];
        if (left < 0) return i;
    }
    return weights.size() - 1;
}

// Whether "an" goes before a word.
bool sounds_like_a_vowel(std::string_view word) {
    const std::string lower = to_lower(word);
    for (const std::string_view silent : {"hour", "honest", "heir", "honour"})
        if (lower.starts_with(silent)) return true;
    for (const std::string_view y_or_w : {"uni", "use", "usu", "eu", "one", "once"})
        if (lower.starts_with(y_or_w)) return false;
    return !lower.empty() && std::string_view("aeiou").find(lower[0]) != std::string_view::npos;
}

bool is_letter(char c) {
    return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z');
}

// Walks over the letters between tags: "a" before a vowel becomes "an", and the first letter a capital.
std::string polished(const std::string& aplm) {
    std::string polished;
    std::optional<std::size_t> article;  // where an "a" ended after which no word came yet
    bool is_first = true;
    for (std::size_t at = 0; at < aplm.size();) {
        if (aplm[at] == '<') {
            const std::size_t end = aplm.find('>', at) + 1;
            polished += aplm.substr(at, end - at);
            at = end;
        } else if (is_letter(aplm[at])) {
            std::size_t end = at;
            while (end < aplm.size() && (is_letter(aplm[end]) || aplm[end] == '-' || aplm[end] == '\''))
                ++end;
            std::string word = aplm.substr(at, end - at);
            if (article && sounds_like_a_vowel(word)) polished.insert(*article, 1, 'n');
            if (is_first && word[0] >= 'a') word[0] = static_cast<char>(word[0] - 'a' + 'A');
            is_first = false;
            polished += word;
            article = word == "a" || word == "A" ? std::optional(polished.size()) : std::nullopt;
            at = end;
        } else {
            polished += aplm[at++];
        }
    }
    return polished;
}

std::string without_tags(std::string_view aplm) {
    std::string text;
    bool is_in_tag = false;
    for (const char c : aplm) {
        is_in_tag = c == '<' || (is_in_tag && c != '>');
        if (!is_in_tag && c != '>') text += c;
    }
    return text;
}

// "{act.ed#1}": class, form and number.
struct Slot {
    std::string_view name;
    std::string_view form;
    std::string_view number;
};

Slot slot_of(std::string_view inside) {
    Slot slot;
    const std::size_t hash = inside.find('#');
    if (hash != std::string_view::npos) slot.number = inside.substr(hash + 1);
    inside = inside.substr(0, hash);
    const std::size_t point = inside.find('.');
    if (point != std::string_view::npos) slot.form = inside.substr(point + 1);
    slot.name = inside.substr(0, point);
    return slot;
}

const std::string& form_of(const GrammarWord& word, std::string_view form) {
    if (form == "s") return word.plural;
    if (form == "ed") return word.past;
    if (form == "en") return word.participle;
    if (form == "ing") return word.ing;
    return word.base;
}

// Fills one template.
class Filler {
  public:
    Filler(const Grammar& grammar, std::string_view topic, const Idiolect& idiolect, Random& random)
        : grammar_(grammar),
          topic_(grammar.topics.at(std::string(topic))),
          idiolect_(idiolect),
          random_(random) {}

    std::string filled(std::string_view text) {
        std::string aplm;
        for (std::size_t at = 0; at < text.size();) at = add_next(text, at, aplm);
        return aplm;
    }

  private:
    // What stands at `at`; returns where it ends.
    std::size_t add_next(std::string_view text, std::size_t at, std::string& aplm) {
        switch (text[at]) {
            case '[':
                aplm += "<theme>";
                return at + 1;
            case ']':
                aplm += " <boundary type=\"LH\"/></theme>";
                return at + 1;
            case '(':
                aplm += "<rheme>";
                return at + 1;
            case ')':
                aplm += "</rheme>";
                return at + 1;
            case '{': {
                const std::size_t end = text.find('}', at);
                aplm += word_for(slot_of(text.substr(at + 1, end - at - 1)));
                return end + 1;
            }
            case '^':
                return add_accent(text, at + 1, aplm);
            default:
                aplm += text[at];
                return at + 1;
        }
    }

    std::size_t add_accent(std::string_view text, std::size_t at, std::string& aplm) {
        aplm += "<pitch-accent type=\"Hstar\">";
        if (text[at] == '{')
            at = add_next(text, at, aplm);
        else
            while (at < text.size() && is_letter(text[at])) aplm += text[at++];
        aplm += "</pitch-accent>";
        return at;
    }

    std::string word_for(const Slot& slot) {
        const std::string name(slot.name);
        const auto own = topic_.find(name);
        const WordClass& from = own != topic_.end() ? own->second : grammar_.classes.at(name);
        const std::string& word = form_of(from.words[chosen(from, slot)], slot.form);
        if (!from.mark) return word;
        const FunctionKind& kind = function_kind(*from.mark);
        return format("<{0} type=\"{1}\" weight=\"{2}\">{3}</{0}>", kind.element, from.value, from.weight,
                      word);
    }

    std::size_t chosen(const WordClass& from, const Slot& slot) {
        std::vector<std::size_t>& used = used_[std::string(slot.name)];
        const std::string key = format("{}#{}", slot.name, slot.number);
        if (!slot.number.empty() && numbered_.contains(key)) return numbered_[key];
        std::vector<double> weights;
        for (std::size_t i = 0; i < from.words.size(); ++i) {
            const bool is_left = std::find(used.begin(), used.end(), i) == used.end();
            weights.push_back(is_left ? liking(idiolect_, from.words[i].base) : 0);
        }
        if (used.size() == from.words.size()) weights.assign(from.words.size(), 1);
        const std::size_t word = draw(weights, random_);
        used.push_back(word);
        if (!slot.number.empty()) numbered_[key] = word;
        return word;
    }

    const Grammar& grammar_;
    const std::map<std::string, WordClass>& topic_;
    const Idiolect& idiolect_;
    Random& random_;
    std::map<std::string, std::vector<std::size_t>> used_;  // by class
    std::map<std::string, std::size_t> numbered_;           // by class and number
};

bool holds(const std::vector<std::string_view>& names, std::string_view name) {
    return std::find(names.begin(), names.end(), name) != names.end();
}

}  // namespace

Sentence say(const Grammar& grammar, const Template& chosen, const SentenceRequest& request, Random& random) {
    const std::string inside =
        polished(Filler(grammar, request.topic, request.idiolect, random).filled(chosen.text));
    const std::string weight = chosen.weight ? format(" weight=\"{}\"", *chosen.weight) : "";
    const bool rises = chosen.dialog_act.find("Yes-No") != std::string::npos ||
                       chosen.dialog_act.find("question") != std::string::npos;
    return {.aplm = format("<performative type=\"{}\"{}>{}</performative> <boundary type=\"{}\"/>",
                           chosen.performative, weight, inside, rises ? "HH" : "LL"),
            .dialog_act = chosen.dialog_act,
            .words = find_words(without_tags(inside)).size()};
}

Sentence say(const Grammar& grammar, const SentenceRequest& request, Random& random) {
    std::vector<const Template*> fitting;
    std::vector<double> weights;
    for (const Template& candidate : grammar.templates) {
        const bool has_genre = candidate.genre == request.genre || candidate.genre == "common";
        const bool is_wanted =
            request.dialog_acts.empty() || holds(request.dialog_acts, candidate.dialog_act);
        if (!has_genre || !is_wanted || holds(request.avoided, candidate.dialog_act)) continue;
        fitting.push_back(&candidate);
        weights.push_back(liking(request.idiolect, candidate.text));
    }
    assert(!fitting.empty());
    return say(grammar, *fitting[draw(weights, random)], request, random);
}

std::string aplm_of(const std::vector<Sentence>& sentences) {
    std::string all = "<aplm>";
    for (const Sentence& sentence : sentences) all += sentence.aplm + " ";
    return all + "</aplm>";
}

}  // namespace chironomia
