// Sentences out of a grammar: what the speakers of made corpora say. The lists are JSON files in grammar/.
#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "core/random.h"
#include "core/speech.h"

namespace chironomia {

// A word that a slot can take, with its forms.
struct GrammarWord {
    std::string base;                   // "take", "black hole"
    std::string plural;                 // of a verb: "takes"
    std::string past, participle, ing;  // of a verb alone
};

struct WordClass {
    std::vector<GrammarWord> words;
    std::optional<MarkKind> mark;  // what all of its words do, and how
    std::string value;             // "size-big"
    double weight = 0.5;
};

struct Template {
    std::string text;          // "[The {thing}] (is ^{quality})."
    std::string genre;         // "lecture"; "common": every genre
    std::string dialog_act;    // of kDialogActNames
    std::string performative;  // "inform"
    std::optional<double> weight;
};

struct Grammar {
    std::map<std::string, WordClass> classes;                        // of every topic
    std::map<std::string, std::map<std::string, WordClass>> topics;  // topic -> class
    std::map<std::string, std::vector<std::string>> topics_of;       // genre -> topics
    std::vector<Template> templates;
};

// "lecture", "host", "tutorial", "sermon".
const std::vector<std::string>& genres();

// Of the files in a folder: classes.json, topics.json, common.json and one for each genre. Throws Error with
// file and key if one is missing or no JSON, a key, an act or a mark is unknown, or a slot names no class.
Grammar read_grammar(const std::filesystem::path& folder);

// Of the files beside the program.
const Grammar& bundled_grammar();

// A person's preferences among words and sentences. A temperature near 0 repeats the same few, a high one uses
// all equally often.
struct Idiolect {
    std::uint64_t seed = 0;
    double temperature = 1;
};

struct SentenceRequest {
    std::string_view genre;
    std::string_view topic;
    Idiolect idiolect;
    std::vector<std::string_view> dialog_acts{};  // one of these; none: any
    std::vector<std::string_view> avoided{};      // none of these
};

struct Sentence {
    std::string aplm;  // "<performative type=...>...</performative> <boundary type="LL"/>"
    std::string dialog_act;
    std::size_t words = 0;
};

// One that fits the request, drawn by the idiolect. A sentence says no word of a class twice while others are
// left.
Sentence say(const Grammar& grammar, const SentenceRequest& request, Random& random);

// Of one template with the words of the topic and the idiolect that are asked for; a test asks every template.
Sentence say(const Grammar& grammar, const Template& chosen, const SentenceRequest& request, Random& random);

// A document that parse_marked_text reads.
std::string aplm_of(const std::vector<Sentence>& sentences);

}  // namespace chironomia
