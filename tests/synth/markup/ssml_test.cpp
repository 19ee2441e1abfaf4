#include "synth/markup/ssml.h"

#include <gmock/gmock.h>

#include "core/files/files.h"
#include "tests/support/support.h"
#include "tests/synth/markup/marks_of.h"

namespace chironomia {
namespace {

using ::testing::Contains;
using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::IsEmpty;
using testing::marks_in;
using ::testing::Not;
using testing::refusal_of;
using ::testing::SizeIs;
using ::testing::StartsWith;
using testing::words_in;

MarkedText parsed(const std::string& inside) {
    return parse_marked_text({.text = "<speak>" + inside + "</speak>", .name = "talk.ssml"});
}

std::string refusal(const std::string& inside) {
    return refusal_of([&] { parsed(inside); });
}

MarkedText museum() {
    return parse_marked_text(
        {.text = read_text(testing::source_dir() / "tests/fixtures/markup/museum.ssml")});
}

TEST(Ssml, GivesTheVoiceTheElementWithoutComments) {
    const MarkedText text = museum();
    EXPECT_TRUE(text.is_ssml);
    EXPECT_TRUE(text.script.starts_with("<speak version"));
    EXPECT_TRUE(text.script.ends_with("</speak>"));
    EXPECT_THAT(text.script, Not(HasSubstr("slows down")));
    EXPECT_THAT(text.script, HasSubstr("and revolutions per minute hardly"));
}

TEST(Ssml, GivesTheWordsBetweenTheTagsAndTheirBytes) {
    const MarkedText text = museum();
    EXPECT_THAT(words_in(text),
                ElementsAre("Hello", "&", "welcome", "This", "machine", "weighs", "nine", "tons", "and",
                            "revolutions", "per", "minute", "hardly", "matter"));
    EXPECT_EQ(text.script.substr(text.words[1].begin, text.words[1].end - text.words[1].begin), "&amp;");
    EXPECT_EQ(text.script.substr(text.words[6].begin, text.words[6].end - text.words[6].begin), "nine");
}

TEST(Ssml, MarksEmphasisAsWrittenAndTheRestByRules) {
    const MarkedText text = museum();
    EXPECT_THAT(marks_in(text, MarkKind::emphasis), Contains("emphasis=high(nine)"));
    EXPECT_THAT(
        marks_in(text, MarkKind::rheme),
        ElementsAre("rheme(Hello & welcome)", "rheme(weighs nine tons)", "rheme(per minute hardly matter)"));
    EXPECT_THAT(marks_in(text, MarkKind::performative), Contains("performative=greet(Hello & welcome)"));
}

TEST(Ssml, WhereTheAuthorEmphasisedTheRulesDoNot) {
    EXPECT_THAT(
        marks_in(parsed("An <emphasis level=\"reduced\">extraordinary</emphasis> day"), MarkKind::emphasis),
        ElementsAre("emphasis=low(extraordinary)"));
    EXPECT_THAT(marks_in(parsed("One <emphasis>two <emphasis>three</emphasis></emphasis> <s>four</s>"),
                         MarkKind::emphasis),
                ElementsAre("emphasis=medium(two three)", "emphasis=medium(three)"));
    EXPECT_THAT(marks_in(parsed("An extraordinary day"), MarkKind::emphasis), Not(IsEmpty()));
    EXPECT_THAT(
        marks_in(parsed("An <emphasis level=\"none\">extraordinary</emphasis> day"), MarkKind::emphasis),
        IsEmpty());
}

TEST(Ssml, SpeaksAliasesInPlaceOfWhatIsWritten) {
    const MarkedText text = parsed(
        "a<sub alias=\"b &amp; c\">d <sub alias=\"e\"/> f</sub>, <sub alias=\"g\"/><emphasis>h</emphasis>");
    EXPECT_EQ(text.script, "<speak>ab &amp; c, g<emphasis>h</emphasis></speak>");
    EXPECT_THAT(marks_in(text, MarkKind::emphasis), ElementsAre("emphasis=medium(h)"));
    // A comment that begins like one that is over, with a tag in it.
    EXPECT_THAT(parsed("<!--->- <sub alias=\"c\">d</sub> --><sub alias=\"a\">b</sub> c").words, SizeIs(2));
    EXPECT_EQ(refusal("<sub>a</sub>"),
              "talk.ssml:1:9: <sub> says no alias; write alias=\"what is to be said\"");
}

TEST(Ssml, SpeaksTheTextOfWhatTheVoiceCannotExpress) {
    const MarkedText text = parsed(
        "<mstts:express-as style=\"sad\">A <phoneme ph=\"x\">tomato</phoneme></mstts:express-as> <w>and</w> "
        "<audio src=\"x.wav\">a bark</audio>");
    EXPECT_THAT(words_in(text), ElementsAre("A", "tomato", "and", "a", "bark"));
    EXPECT_EQ(text.script.find_first_of("<>", 7), text.script.size() - 8);  // those of <speak> alone
    EXPECT_THAT(
        text.notes,
        ElementsAre("talk.ssml:1:9: <mstts:express-as> is left out, and the text in it spoken as it is",
                    "talk.ssml:1:41: <phoneme> is left out, and the text in it spoken as it is",
                    "talk.ssml:1:93: <w> is left out, and the text in it spoken as it is",
                    "talk.ssml:1:104: <audio> is left out, and the text in it spoken as it is"));
}

TEST(Ssml, LeavesOutTheBookmarksOfAzure) {
    const MarkedText text = parsed("Look <bookmark mark=\"x\"/>here.");
    EXPECT_THAT(words_in(text), ElementsAre("Look", "here"));
    EXPECT_THAT(text.notes,
                ElementsAre("talk.ssml:1:14: <bookmark> is left out, and the text in it spoken as it is"));
}

TEST(Ssml, SpeaksCdataAsText) {
    const MarkedText text = parsed("<w/><![CDATA[Tom & <Jerry>]]> <emphasis>run</emphasis>");
    EXPECT_EQ(text.script, "<speak>    Tom &amp; &lt;Jerry&gt; <emphasis>run</emphasis></speak>");
    EXPECT_THAT(words_in(text), ElementsAre("Tom", "&", "Jerry", "run"));
    EXPECT_THAT(marks_in(text, MarkKind::emphasis), ElementsAre("emphasis=medium(run)"));
    EXPECT_EQ(text.notes.size(), 1u);
}

TEST(Ssml, SpeaksTheLanguageThatItNames) {
    const std::string text = "<speak xml:lang=\"fr\">merci</speak>";
    EXPECT_THAT(marks_in(parse_ssml({.text = text}), MarkKind::performative),
                ElementsAre("performative=thank(merci)"));
}

TEST(Ssml, RefusesWhatTheVoiceCannotSpeak) {
    EXPECT_THAT(refusal("<emphsis>a</emphsis>"),
                StartsWith("talk.ssml:1:9: <emphsis> is no element of SSML; did you mean emphas"));
    EXPECT_EQ(
        refusal("<emphasis level=\"loud\">a</emphasis>"),
        "talk.ssml:1:9: level \"loud\" of <emphasis> cannot be spoken; write one of [strong moderate none "
        "reduced], or nothing else");
    EXPECT_EQ(
        refusal("a<break time=\"long\"/>"),
        "talk.ssml:1:10: time \"long\" of <break> cannot be spoken; write a time such as 500ms or 0.5s");
    for (const char* time : {"nans", "infs", "1e300s", "-1s"})
        EXPECT_THAT(refusal("a<break time=\"" + std::string(time) + "\"/>"), HasSubstr("cannot be spoken"));
    for (const char* rate : {"nan%", "+infdB", "1e30%", "inf"})
        EXPECT_THAT(refusal("<prosody rate=\"" + std::string(rate) + "\">a</prosody>"),
                    HasSubstr("cannot be spoken; write one of"));
    EXPECT_THAT(refusal("<prosody rate=\"quick\">a</prosody>"),
                StartsWith("talk.ssml:1:9: rate \"quick\" of <prosody> cannot be spoken; write one o"));
    EXPECT_EQ(refusal("<prosody speed=\"2\">a</prosody>"),
              "talk.ssml:1:9: <prosody> has no attribute speed; it has rate, pitch, range, volume");
    EXPECT_EQ(refusal("<break/>"), "talk.ssml:1:2: <speak> holds no word; write what is to be said inside");
    EXPECT_EQ(refusal_of([] { parse_ssml({.text = "<s>a</s>"}); }),
              "text:1:2: <s> is no element of SSML that begins a text; write one of speak");
}

TEST(Ssml, TakesEveryWayToWriteAnAmount) {
    for (const char* rate : {"slow", "80%", "+10%", "1.5", "-2st", "120Hz"})
        EXPECT_NO_THROW(parsed("<prosody rate=\"" + std::string(rate) + "\">a</prosody>")) << rate;
    EXPECT_NO_THROW(parsed("a<break time=\"500ms\"/>b<break strength=\"x-strong\" time=\"1.5s\"/>"));
}

}  // namespace
}  // namespace chironomia
