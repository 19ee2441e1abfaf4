#include "synth/markup/aplm.h"

#include <gmock/gmock.h>

#include "core/files/files.h"
#include "tests/support/support.h"
#include "tests/synth/markup/marks_of.h"
#include "tests/synth/markup/written_markup.h"

namespace chironomia {
namespace {

using ::testing::ElementsAre;
using testing::marks_in;
using testing::refusal_of;
using ::testing::StartsWith;

MarkedText parsed(const std::string& inside) {
    return parse_marked_text({.text = "<APLM>" + inside + "</APLM>", .name = "talk.aplm"});
}

std::string refusal(const std::string& inside) {
    return refusal_of([&] { parsed(inside); });
}

MarkedText museum() {
    const std::filesystem::path file = testing::source_dir() / "tests/fixtures/markup/museum.aplm";
    return parse_marked_text({.text = read_text(file), .name = "museum.aplm"});
}

TEST(Aplm, GivesTheWordsAndActsOfTheFixture) {
    const MarkedText text = museum();
    EXPECT_FALSE(text.is_ssml);
    EXPECT_EQ(text.script, "Good morning, everybody. This wheel is enormous, & turns of course there.");
    EXPECT_THAT(marks_in(text),
                ElementsAre("performative=greet(Good morning everybody)", "rheme(Good morning everybody)",
                            "emotion=joy(Good morning everybody)", "emphasis=medium(Good)",
                            "pitch-accent=Hstar(Good)", "turn=take()",
                            "performative=inform(This wheel is enormous & turns of course there)",
                            "theme(This wheel)", "emphasis=low(This)", "pitch-accent=LplusHstar(This)",
                            "boundary=LL()", "rheme(is enormous & turns of course there)",
                            "belief-relation=contrast(is enormous & turns of course there)", "boundary=LH()",
                            "world=size-big(enormous)", "certainty=certain(of course)",
                            "deictic=place-there(there)", "turn=give()"));
}

TEST(Aplm, GivesWeightsAndTheMannerOfOneAct) {
    const MarkedText text = museum();
    const auto mark_of = [&](MarkKind kind, std::size_t nth) {
        for (const Mark& mark : text.marks)
            if (mark.kind == kind && nth-- == 0) return mark;
        return Mark{};
    };
    EXPECT_EQ(mark_of(MarkKind::performative, 0).weight, 0.9);  // the default of greetings
    EXPECT_EQ(mark_of(MarkKind::performative, 1).weight, 0.6);
    EXPECT_EQ(mark_of(MarkKind::performative, 1).manner[Expressivity::spatial_extent], 0.5);
    EXPECT_EQ(mark_of(MarkKind::deictic, 0).manner[Expressivity::temporal_extent], -0.25);
    EXPECT_EQ(mark_of(MarkKind::deictic, 0).manner[Expressivity::spatial_extent], std::nullopt);
}

TEST(Aplm, LeadsTheWordsOfItsAuthorsToOurFunctions) {
    EXPECT_THAT(
        marks_in(
            parsed("<performative type=\"Question\">Why</performative> <affect type=\"sorry-for\">so</affect>"
                   " <turn type=\"take\"/><world type=\"x-spiral\">round</world>")),
        ElementsAre("performative=ask(Why)", "emotion=sadness(so)", "world=x-spiral(round)", "turn=take()"));
}

TEST(Aplm, PartsThePhrasesButNotTheSyllables) {
    EXPECT_EQ(parsed("<theme>One</theme><rheme>two, un<emphasis>believ</emphasis>able</rheme>").script,
              "One two, unbelievable");
    EXPECT_THAT(marks_in(parsed("un<emphasis>believ</emphasis>able")),
                ElementsAre("emphasis=medium(unbelievable)"));
}

TEST(Aplm, ReadsBackWhatItWrites) {
    for (const MarkedText& text :
         {museum(),
          parsed(
              "a/<rheme>b</rheme> <gesture name=\"open\" reference=\"rheme\" weight=\"0.25\">c</gesture>")}) {
        const MarkedText again = parse_aplm({.text = testing::to_aplm(text)});
        EXPECT_EQ(again.script, text.script);
        EXPECT_EQ(again.words, text.words);
        EXPECT_EQ(again.marks, text.marks) << testing::to_aplm(text);
    }
}

TEST(Aplm, RefusesUnknownElementsAttributesAndValues) {
    EXPECT_THAT(refusal("<rhemee>a</rhemee>"),
                StartsWith("talk.aplm:1:8: <rhemee> is no element of APLM; did you mean rheme?"));
    EXPECT_THAT(refusal("<rheme wieght=\"1\">a</rheme>"),
                StartsWith("talk.aplm:1:8: <rheme> has no attribute wieght; did you mean weig"));
    EXPECT_EQ(
        refusal("<emotion type=\"joi\">a</emotion>"),
        "talk.aplm:1:8: type \"joi\" is no value of emotion; did you mean joy? Known are joy, sadness, anger, "
        "fear, surprise, disgust; one of your own lexicon begins with x-");
    EXPECT_EQ(refusal("<emphasis level=\"x-huge\">a</emphasis>"),
              "talk.aplm:1:8: level \"x-huge\" is no value of emphasis; write one of low, medium, high");
    EXPECT_THAT(refusal("<world>a</world>"),
                StartsWith("talk.aplm:1:8: <world> says no type; write type=\"...\", one of shape-rou"));
    EXPECT_EQ(refusal("<gesture>a</gesture>"),
              "talk.aplm:1:8: <gesture> says no type; write name=\"...\", a gesture of the lexicon");
    EXPECT_EQ(refusal("<gesture name=\"\">a</gesture>"),
              "talk.aplm:1:8: name \"\" is no value of gesture; write the name of one of the lexicon");
}

TEST(Aplm, RefusesNumbersOutsideTheirRange) {
    EXPECT_EQ(refusal("\n<rheme weight=\"1.5\">a</rheme>"),
              "talk.aplm:2:2: weight 1.5 is outside its range; it goes from 0 to 1");
    EXPECT_EQ(refusal("<rheme oac=\"-0.1\">a</rheme>"),
              "talk.aplm:1:8: oac -0.1 is outside its range; it goes from 0 to 1");
    EXPECT_EQ(refusal("<rheme flt=\"-2\">a</rheme>"),
              "talk.aplm:1:8: flt -2 is outside its range; it goes from -1 to 1");
    EXPECT_EQ(refusal("<rheme pwr=\"nan\">a</rheme>"),
              "talk.aplm:1:8: pwr nan is outside its range; it goes from -1 to 1");
    EXPECT_EQ(refusal("<rheme pwr=\"much\">a</rheme>"),
              "talk.aplm:1:8: pwr \"much\" is no number; write one such as 0.5");
}

TEST(Aplm, RefusesActsWithoutWords) {
    EXPECT_EQ(refusal(" "), "talk.aplm:1:2: <APLM> holds no word; write what is to be said inside");
    EXPECT_EQ(refusal("a <rheme> - </rheme>"),
              "talk.aplm:1:10: <rheme> holds no word; put it around the words that it is about");
    EXPECT_EQ(refusal("<boundary>a</boundary>"),
              "talk.aplm:1:8: <boundary> holds words; write <boundary type=\"LL\"/> behind them");
    EXPECT_EQ(refusal_of([] { parse_aplm({.text = "<APLM spc=\"1\">a</APLM>"}); }),
              "text:1:2: <APLM> has no attribute spc; give the manner to the acts inside");
    EXPECT_EQ(refusal_of([] { parse_aplm({.text = "<a>b</a>"}); }),
              "text:1:2: <a> is no element of APLM that begins a text; write one of APLM");
}

// As apml.dtd of MARY TTS has it, and as GRETA's EmotionMixer wrote it.
TEST(Aplm, ReadsTheOlderApmlAndNotesWhatIsNotShown) {
    const MarkedText text = parse_marked_text(
        {.text = "<apml><turnallocation type=\"take\"><performative type=\"announce\" onset=\"0\">This is "
                 "<emphasis deictic=\"u\" intensity=\"0.4\">new</emphasis></performative></turnallocation>"
                 "<affective type=\"joy\">Hey</affective></apml>",
         .name = "old.apml"});
    EXPECT_THAT(marks_in(text), ElementsAre("turn=take(This is new)", "performative=inform(This is new)",
                                            "emphasis=medium(new)", "emotion=joy(Hey)"));
    EXPECT_THAT(text.notes, ElementsAre("old.apml:1:2: <apml> is read as <APLM>",
                                        "old.apml:1:84: deictic \"u\" shows nothing here",
                                        "old.apml:1:2: attribute intensity changes nothing here",
                                        "old.apml:1:2: attribute onset changes nothing here"));
}

}  // namespace
}  // namespace chironomia
