#include "synth/corpus/make/text.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <set>

#include "core/files/files.h"
#include "core/text.h"
#include "synth/corpus/make/speech.h"
#include "synth/markup/markup.h"
#include "tests/support/support.h"

namespace chironomia {
namespace {

using ::testing::AllOf;
using ::testing::HasSubstr;
using testing::refusal_of;

// The topics that a template can be about.
std::vector<std::string> topics_of(const Template& of) {
    const Grammar& grammar = bundled_grammar();
    if (of.genre != "common") return grammar.topics_of.at(of.genre);
    std::vector<std::string> all;
    for (const auto& [topic, classes] : grammar.topics) all.push_back(topic);
    return all;
}

TEST(Grammar, HasTemplatesAndWordsForFourGenres) {
    const Grammar& grammar = bundled_grammar();
    EXPECT_GE(grammar.templates.size(), 340u);
    std::set<std::string> words;
    const auto add = [&](const std::map<std::string, WordClass>& classes) {
        for (const auto& [name, from] : classes)
            for (const GrammarWord& word : from.words)
                for (const std::string_view part : split_words(word.base)) words.emplace(part);
    };
    add(grammar.classes);
    for (const auto& [topic, classes] : grammar.topics) add(classes);
    EXPECT_GE(words.size(), 1900u) << "besides those of the templates";
    for (const std::string& genre : genres()) EXPECT_GE(grammar.topics_of.at(genre).size(), 8u) << genre;
}

TEST(Grammar, MakesSentencesThatAreAplmOfEveryTemplateAboutEveryTopic) {
    Random random(1);
    for (const Template& chosen : bundled_grammar().templates) {
        for (const std::string& topic : topics_of(chosen)) {
            const Sentence sentence =
                say(bundled_grammar(), chosen, {.topic = topic, .idiolect = {.seed = 1, .temperature = 1}},
                    random);
            const MarkedText text = parse_marked_text({.text = aplm_of({sentence})}, MarkupLanguage::aplm);
            EXPECT_EQ(text.words.size(), sentence.words) << text.script;
            EXPECT_TRUE(text.notes.empty()) << text.script;
            EXPECT_TRUE(text.script[0] >= 'A' && text.script[0] <= 'Z') << text.script;
            for (const char* slip : {"  ", " .", " ,", " ?", "{", "}", "^", "[", "]", "#", ",.", ".."})
                EXPECT_EQ(text.script.find(slip), std::string::npos) << slip << " in: " << text.script;
        }
    }
}

TEST(Grammar, MakesSentencesThatAreSpoken) {
    Random random(2);
    std::vector<Sentence> sentences;
    std::size_t words = 0;
    for (const Template& chosen : bundled_grammar().templates) {
        sentences.push_back(say(bundled_grammar(), chosen,
                                {.topic = topics_of(chosen).front(), .idiolect = {.seed = 2}}, random));
        words += sentences.back().words;
    }
    const Speech speech = say_aloud(sentences, {.rate = 300});
    ASSERT_EQ(speech.words.size(), words);
    for (const SpokenWord& word : speech.words) EXPECT_GT(word.end, word.start) << word.text;
}

// What a template of our own says.
std::string said(const std::string& text, std::uint64_t seed = 1) {
    Random random(seed);
    const Template own{
        .text = text, .genre = "common", .dialog_act = "Other", .performative = "inform", .weight = {}};
    const Sentence sentence =
        say(bundled_grammar(), own, {.topic = "cooking", .idiolect = {.seed = 1, .temperature = 3}}, random);
    return parse_marked_text({.text = aplm_of({sentence})}).script;
}

TEST(Grammar, GivesWordsTheirForms) {
    const auto verb = [](std::string_view base) {
        const std::vector<GrammarWord>& verbs = bundled_grammar().classes.at("do").words;
        return *std::find_if(verbs.begin(), verbs.end(),
                             [&](const GrammarWord& word) { return word.base == base; });
    };
    EXPECT_EQ(verb("cry").plural, "cries");
    EXPECT_EQ(verb("cry").past, "cried");
    EXPECT_EQ(verb("run").ing, "running");
    EXPECT_EQ(verb("smile").ing, "smiling");
    EXPECT_EQ(verb("sing").participle, "sung");
    EXPECT_EQ(verb("nod").past, "nodded");
    EXPECT_EQ(verb("listen").past, "listened");
    const std::vector<GrammarWord>& things = bundled_grammar().topics.at("cooking").at("thing").words;
    EXPECT_EQ(things[0].plural, "knives");
    EXPECT_EQ(things[3].plural, "tomatoes");
    EXPECT_EQ(things[2].plural, "onions");
}

TEST(Grammar, PutsTheRightArticle) {
    std::set<std::string> found;
    for (std::uint64_t seed = 0; seed < 200; ++seed) {
        const std::string text = said("[A {thing}] (and a {kind} ^{object}).", seed);
        if (text.find("oven") != std::string::npos && text.starts_with("An oven")) found.insert("an oven");
        if (text.find(" a honest") != std::string::npos || text.find(" a onion") != std::string::npos)
            ADD_FAILURE() << text;
        if (text.find(" an honest") != std::string::npos) found.insert("an honest");
    }
    EXPECT_EQ(found, (std::set<std::string>{"an oven", "an honest"}));
}

TEST(Grammar, SaysANumberedWordAgainAndNoOtherTwice) {
    for (std::uint64_t seed = 0; seed < 20; ++seed) {
        const std::string text = said("[{thing#1}] ({thing#1} {thing#1}).", seed);
        const std::vector<std::string_view> words = split_words(text);
        ASSERT_EQ(words.size(), 3u) << text;
        EXPECT_EQ(to_lower(words[0]), words[1]);
        const std::string others = said("({colour} {colour} {colour} {colour} {colour} {colour}).", seed);
        std::set<std::string> different;
        for (const std::string_view word : split_words(others)) different.insert(to_lower(word));
        EXPECT_EQ(different.size(), 6u) << others;
    }
}

std::size_t distinct_words(double temperature) {
    Random random(5);
    std::set<std::string> words;
    for (int i = 0; i < 200; ++i) {
        const Sentence sentence =
            say(bundled_grammar(),
                {.genre = "lecture", .topic = "energy", .idiolect = {.seed = 7, .temperature = temperature}},
                random);
        const MarkedText text = parse_marked_text({.text = aplm_of({sentence})});
        for (const ScriptWord& word : text.words) words.insert(to_lower(word.text));
    }
    return words.size();
}

TEST(Grammar, SaysMoreDifferentWordsAtAHigherTemperature) {
    const std::size_t few = distinct_words(0.3), more = distinct_words(0.8), most = distinct_words(2);
    EXPECT_LT(few, more);
    EXPECT_LT(more, most);
    EXPECT_GT(most, few * 3 / 2);
}

TEST(Grammar, KeepsToTheWishedActs) {
    Random random(3);
    for (int i = 0; i < 50; ++i) {
        const Sentence asked =
            say(bundled_grammar(),
                {.genre = "host", .topic = "film", .idiolect = {}, .dialog_acts = {"Wh-Question"}}, random);
        EXPECT_EQ(asked.dialog_act, "Wh-Question");
        EXPECT_THAT(asked.aplm, AllOf(HasSubstr("performative type=\"ask\""), HasSubstr("?")));
    }
}

// The refusal of a grammar in which one file is another.
std::string refusal_with(const char* name, const std::string& text) {
    const testing::TemporaryFolder folder;
    const std::filesystem::path bundled = testing::source_dir() / "synth/corpus/grammar";
    for (const auto& file : std::filesystem::directory_iterator(bundled))
        std::filesystem::copy(file.path(), folder / file.path().filename());
    write_text(folder / name, text);
    return refusal_of([&] { read_grammar(folder.path()); });
}

TEST(Grammar, RefusesWhatItDoesNotKnow) {
    const auto sentence = [](const std::string& tag, const std::string& act, const std::string& say) {
        return format(R"({{"sentences": [{{"tag": "{}", "act": "{}", "say": ["{}"]}}]}})", tag, act, say);
    };
    EXPECT_THAT(refusal_with("host.json", sentence("Hedge", "inform", "[The {thingy}] (is ^good).")),
                AllOf(HasSubstr("host.json: sentences[0].say[0]"), HasSubstr("no class \"thingy\"")));
    EXPECT_THAT(refusal_with("host.json", sentence("Hedge", "inform", "[The {thing] (is ^good).")),
                AllOf(HasSubstr("host.json: sentences[0].say[0]"), HasSubstr("has a { without a }")));
    EXPECT_THAT(
        refusal_with("classes.json", R"({"big": {"words": "huge,, large"}})"),
        HasSubstr("classes.json: big.words: is \"huge,, large\"; there is nothing between two commas"));
    EXPECT_THAT(refusal_with("host.json", sentence("Hegde", "inform", "[Well].")),
                HasSubstr("sentences[0].tag"));
    EXPECT_THAT(refusal_with("host.json", sentence("Hedge", "informs", "[Well].")),
                HasSubstr("sentences[0].act"));
    EXPECT_THAT(
        refusal_with("classes.json", R"({"big": {"mark": "world=huge", "words": "huge"}})"),
        AllOf(HasSubstr("classes.json: big.mark"), HasSubstr("a function of docs/markup.md is needed")));
    EXPECT_THAT(refusal_with("topics.json", R"({"sea": {"genres": "host"}})"), HasSubstr("topics.json: sea"));
}

}  // namespace
}  // namespace chironomia
