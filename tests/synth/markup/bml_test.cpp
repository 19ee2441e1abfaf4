#include "synth/markup/bml.h"

#include <gmock/gmock.h>

#include "core/files/files.h"
#include "tests/support/support.h"
#include "tests/synth/markup/marks_of.h"
#include "tests/synth/markup/written_markup.h"

namespace chironomia {
namespace {

using ::testing::ElementsAre;
using ::testing::IsEmpty;
using testing::marks_in;
using testing::refusal_of;
using ::testing::StartsWith;
using testing::words_in;

const std::string kSpeech =
    "<speech id=\"s\"><text>One <sync id=\"A\"/>two <sync id=\"B\"/>three</text></speech>";

MarkedText parsed(const std::string& behaviours) {
    return parse_marked_text({.text = "<bml>" + kSpeech + behaviours + "</bml>", .name = "talk.bml"});
}

std::string refusal(const std::string& behaviours) {
    return refusal_of([&] { parsed(behaviours); });
}

// The example of Fares, "Multimodal Expressive Gesturing With Style", figure 3.5, with the root that was lost
// in print.
MarkedText quite_well() {
    const std::filesystem::path file = testing::source_dir() / "tests/fixtures/markup/quite_well.bml";
    return parse_marked_text({.text = read_text(file), .name = "quite_well.bml"});
}

TEST(Bml, GivesTheWordsAndTheGestureOfTheThesis) {
    const MarkedText text = quite_well();
    EXPECT_EQ(text.script, "Quite well thank you");
    EXPECT_THAT(words_in(text), ElementsAre("Quite", "well", "thank", "you"));
    ASSERT_EQ(text.marks.size(), 1u);
    const Mark& gesture = text.marks.front();
    EXPECT_EQ(gesture.kind, MarkKind::gesture);
    EXPECT_EQ(gesture.value, "ask_Ges_B");
    EXPECT_EQ(gesture.reference, "performative=ask");
    EXPECT_EQ(gesture.weight, 1);
    EXPECT_EQ(gesture.first_word, 0u);
    EXPECT_EQ(gesture.end_word, 4u);
    EXPECT_THAT(text.notes, IsEmpty());
}

TEST(Bml, GivesTheMannerOfTheGestureByGretasNames) {
    const Mark gesture = quite_well().marks.front();
    EXPECT_EQ(gesture.manner[Expressivity::overall_activation], std::nullopt);
    EXPECT_EQ(gesture.manner[Expressivity::spatial_extent], 0.0);
    EXPECT_EQ(gesture.manner[Expressivity::temporal_extent], 0.05);
    EXPECT_EQ(gesture.manner[Expressivity::fluidity], -0.05);
    EXPECT_EQ(gesture.manner[Expressivity::power], 0.1);
    EXPECT_EQ(gesture.manner[Expressivity::repetition], -0.1);
}

// "Quite" begins at 0.05 s and "you" ends at 1.61 s: 0.03 s is 20 ms before the one, 1.7 s 90 ms after the
// other.
TEST(Bml, TimesFollowTheWordsNextToThem) {
    const MarkTimes times = quite_well().marks.front().times;
    EXPECT_EQ(times.ready, (SyncPoint{0, -0.02}));
    EXPECT_EQ(times.relax, (SyncPoint{4, 0.09}));
    EXPECT_FALSE(times.start || times.stroke_start || times.stroke || times.stroke_end || times.end);
}

// "well" ends with T3, 0.15 s before "thank" begins with T4.
TEST(Bml, ASyncPointBeforeAPauseIsEarlierThanTheNextWord) {
    std::string file = read_text(testing::source_dir() / "tests/fixtures/markup/quite_well.bml");
    file.replace(file.find("ready=\"0.03\""), 12, "stroke=\"sp1:T3\" strokeEnd=\"T4+0.1\"");
    const MarkTimes times = parse_bml({.text = file}).marks.front().times;
    EXPECT_EQ(times.stroke, (SyncPoint{2, -0.15}));
    EXPECT_EQ(times.stroke_end, (SyncPoint{2, 0.1}));
}

TEST(Bml, ResolvesSyncPointsOfTheSpeechAndOfOtherGestures) {
    const MarkedText text = parsed(
        "<gesture id=\"g1\" lexeme=\"a\" start=\"s:start\" stroke=\"s:A\" end=\"s:end - 0.25\"/>"
        "<gesture id=\"g2\" lexeme=\"b\" stroke=\"g1:stroke+0.5\"/><gesture id=\"g3\" lexeme=\"c\" "
        "start=\"2.5\"/>");
    ASSERT_EQ(text.marks.size(), 3u);
    EXPECT_EQ(text.marks[0].value, "a");
    EXPECT_EQ(text.marks[0].times.start, (SyncPoint{0, 0}));
    EXPECT_EQ(text.marks[0].times.stroke, (SyncPoint{1, 0}));
    EXPECT_EQ(text.marks[0].times.end, (SyncPoint{3, -0.25}));
    EXPECT_EQ(text.marks[1].value, "c");
    EXPECT_EQ(text.marks[1].times.start, (SyncPoint{std::nullopt, 2.5}));
    EXPECT_EQ(text.marks[2].times.stroke, (SyncPoint{1, 0.5}));
    EXPECT_THAT(marks_in(text),
                ElementsAre("gesture=a(One two three)", "gesture=c(One two three)", "gesture=b(two)"));
}

// The block's clock shows 3 s when the first word is said.
TEST(Bml, TimesInSecondsCountFromTheStartOfTheSpeech) {
    const auto text_of = [](const std::string& start, const std::string& syncs) {
        return parse_bml(
            {.text = "<bml><speech id=\"s\" start=\"" + start + "\"><text>" + syncs +
                     "</text></speech><gesture id=\"g\" lexeme=\"a\" start=\"2.5\" stroke=\"3.8\" "
                     "relax=\"s:end\"/><gesture lexeme=\"b\" stroke=\"g:stroke+0.5\"/></bml>"});
    };
    const MarkedText text = text_of("3.0", "One two");
    EXPECT_EQ(text.marks[0].times.start, (SyncPoint{std::nullopt, -0.5}));
    EXPECT_EQ(text.marks[0].times.stroke, (SyncPoint{std::nullopt, 0.8}));
    EXPECT_EQ(text.marks[0].times.relax, (SyncPoint{2, 0}));
    EXPECT_EQ(text.marks[1].times.stroke, (SyncPoint{std::nullopt, 1.3}));
    EXPECT_THAT(
        text.notes,
        ElementsAre(
            "text:1:63: start 2.5 lies 0.5 s before the speech, which starts at 3.0 s; the motion may begin later"));

    const MarkedText same_clock =
        text_of("3", "<sync id=\"A\" time=\"3\"/>One <sync id=\"B\" time=\"3.4\"/>two");
    EXPECT_EQ(same_clock.marks[0].times.stroke, (SyncPoint{1, 0.4}));
    const MarkedText own_clock =
        text_of("3", "<sync id=\"A\" time=\"0\"/>One <sync id=\"B\" time=\"0.4\"/>two");
    EXPECT_EQ(own_clock.marks[0].times.stroke, (SyncPoint{1, 0.4}));

    EXPECT_EQ(text_of("s2:end+1", "One two").marks[0].times.stroke, (SyncPoint{std::nullopt, 3.8}));
    EXPECT_THAT(text_of("s2:end+1", "One two").notes,
                ElementsAre("text:1:7: start \"s2:end+1\" of <speech> is no time from 0 to 86400 s; times in "
                            "seconds count from its first word"));
}

TEST(Bml, RefusesTimesOfAGestureThatRunBackwards) {
    const std::string order =
        "the times of a gesture follow one another: start, ready, strokeStart, stroke, strokeEnd, relax, end";
    EXPECT_EQ(refusal("<gesture lexeme=\"a\" start=\"s:B\" stroke=\"s:A\" end=\"s:end\"/>"),
              "talk.bml:1:85: start s:B lies after stroke s:A; " + order);
    EXPECT_EQ(refusal("<gesture lexeme=\"a\" end=\"0.2\" stroke=\"0.9\"/>"),
              "talk.bml:1:85: stroke 0.9 lies after end 0.2; " + order);
    EXPECT_EQ(refusal("<gesture lexeme=\"a\" relax=\"s:A+0.5\" end=\"s:A+0.2\"/>"),
              "talk.bml:1:85: relax s:A+0.5 lies after end s:A+0.2; " + order);
    // How long "two" takes is known when it is said.
    EXPECT_EQ(parsed("<gesture lexeme=\"a\" start=\"s:B-0.5\" stroke=\"s:A\"/>").marks.size(), 1u);
}

TEST(Bml, ReadsFunctionsBesideTheBehaviours) {
    const std::string fml =
        "<fml><performative type=\"greet\" start=\"s:start\" end=\"s:A\" importance=\"0.3\"/>"
        "<boundary type=\"LL\" start=\"s:B\"/><rheme id=\"r\" start=\"s:A\"/></fml>";
    const MarkedText text =
        parse_marked_text({.text = "<fml-apml><bml>" + kSpeech + "</bml>" + fml + "</fml-apml>"});
    EXPECT_THAT(marks_in(text), ElementsAre("performative=greet(One)", "rheme(two three)", "boundary=LL()"));
    EXPECT_EQ(text.marks[0].weight, 0.3);
}

// As GRETA and the translator of ARIA-Valuspa write it.
TEST(Bml, NotesWhatGretaWritesAndNothingHereShows) {
    const MarkedText text = parse_marked_text(
        {.text = R"(<fml-apml composition="replace" reaction_type="none" social_attitude="neutral">
<bml><speech id="s1"><tm id="a"/><voice emotion="none">Hello <tm id="b"/>human!</voice> <tm id="c"/>
<pitchaccent id="p1" type="HStar" level="medium" start="s1:a" end="s1:b" importance="0.8"/>
<pitchaccent id="p2" type="Lstar" start="s1:b" end="s1:c"/></speech></bml>
<fml><performative id="f1" type="greet" start="s1:a" end="s1:c" character="Greta"/>
<emotion id="f2" type="neutral" start="s1:a" end="s1:c"/><emotion id="f7" type="joyStrong" start="s1:b" end="s1:c"/>
<world id="f3" ref_type="person" ref_id="self" start="s1:a" end="s1:b"/>
<world id="f4" ref_type="thing" type="size-big" start="s1:b" end="s1:c"/>
<backchannel id="f5" type="agreement" start="1" end="2"/>
<laugh id="f6" start="s1:a" end="s1:b"/></fml></fml-apml>)",
         .name = "greta.xml"});
    EXPECT_EQ(text.script, "Hello human!");
    EXPECT_THAT(marks_in(text), ElementsAre("performative=greet(Hello human)", "pitch-accent=Hstar(Hello)",
                                            "emotion=joy(human)", "world=size-big(human)",
                                            "pitch-accent=Lstar(human)"));
    EXPECT_THAT(
        text.notes,
        ElementsAre("greta.xml:1:2: reaction_type, social_attitude of <fml-apml> change nothing here",
                    "greta.xml:2:35: <voice> is spoken as the words around it",
                    "greta.xml:3:2: level of <pitchaccent> changes nothing here",
                    "greta.xml:5:7: character of <performative> changes nothing here",
                    "greta.xml:6:2: emotion neutral is not shown",
                    "greta.xml:7:2: <world> without a type is not shown",
                    "greta.xml:8:2: ref_type of <world> changes nothing here",
                    "greta.xml:9:2: <backchannel> at a time that no sync point of the speech gives is not "
                    "shown",
                    "greta.xml:10:2: <laugh> of FML is not shown"));
}

TEST(Bml, NotesWhatStandardBmlHasAndNothingHereShows) {
    const MarkedText text = parsed(
        "<constraint><synchronize><sync ref=\"s:A\"/></synchronize></constraint>\n"
        "<head id=\"h\" lexeme=\"DOWN_ASIDE_LEFT\" repetition=\"2\" start=\"x:y\"/>\n"
        "<face amount=\"1\" overshoot=\"0.1\"><description><reference>emotion=joy</reference></description></face>\n"
        "<required><gesture lexeme=\"a\" own:speed=\"2\"/></required><own:dance/>");
    EXPECT_THAT(marks_in(text), ElementsAre("emotion=joy(One two three)", "gesture=a(One two three)"));
    EXPECT_THAT(text.notes, ElementsAre("talk.bml:1:85: <constraint> is not shown",
                                        "talk.bml:2:2: <head> with neither a known lexeme nor a reference to "
                                        "a function is not shown",
                                        "talk.bml:3:2: overshoot of <face> changes nothing here",
                                        "talk.bml:4:12: own:speed of <gesture> changes nothing here",
                                        "talk.bml:4:58: <own:dance> is not shown"));
}

TEST(Bml, ReadsTheFunctionsThatHeadAndFaceShow) {
    const MarkedText text = parsed(
        "<face id=\"f\" lexeme=\"smile\" "
        "start=\"s:A\"><description><reference>emotion=happy</reference></description></face>"
        "<head id=\"h\" lexeme=\"UP\" start=\"s:A\"/><head id=\"i\" lexeme=\"UP\" start=\"s:B\"/>");
    EXPECT_THAT(marks_in(text), ElementsAre("emotion=joy(two)"));
    EXPECT_THAT(
        text.notes,
        ElementsAre("talk.bml:1:195: <head> with neither a known lexeme nor a reference to a function is "
                    "not shown (2 times)"));
}

TEST(Bml, ReadsHeadsFacesAndGazesThatAreAskedFor) {
    const MarkedText text = parsed(
        "<head id=\"h\" lexeme=\"NOD\" start=\"s:A\" end=\"s:B\" amount=\"0.75\"/>"
        "<head type=\"Head_Shake\" stroke=\"s:B\"/>"
        "<faceLexeme lexeme=\"RAISE_MOUTH_CORNERS\" start=\"s:A\" end=\"s:end+0.5\"/>"
        "<face start=\"s:A\"><description><reference>faceexp=Eyebrows_Raise</reference></description></face>"
        "<face start=\"s:A\"><lexeme lexeme=\"LOWER_BROWS\"/></face>"
        "<gaze target=\"Camera\" start=\"s:B\"/><gaze target=\"user\" offsetDirection=\"LEFT\" start=\"s:start\"/>");
    EXPECT_THAT(marks_in(text, MarkKind::signal),
                ElementsAre("signal=look away(One)", "signal=smile(two three)", "signal=nod(two)",
                            "signal=brow raise(two)", "signal=frown(two)", "signal=shake(three)",
                            "signal=look at(three)"));
    const Mark& nod = text.marks[2];
    EXPECT_EQ(nod.times.start, (SyncPoint{1, 0}));
    EXPECT_EQ(nod.times.end, (SyncPoint{2, 0}));
    EXPECT_EQ(nod.manner[Expressivity::spatial_extent], 0.5);
    EXPECT_EQ(nod.weight, 1);
    EXPECT_THAT(
        text.notes,
        ElementsAre(::testing::EndsWith("\"Camera\", at which <gaze> looks, is where the partner is")));
    EXPECT_THAT(refusal("<head lexeme=\"NOD\" start=\"x:y\"/>"), StartsWith("talk.bml:1:"));
    EXPECT_THAT(refusal("<head lexeme=\"NOD\" start=\"s:B\" end=\"s:A\"/>"), StartsWith("talk.bml:1:"));
    EXPECT_THAT(refusal("<head lexeme=\"NOD\" amount=\"2\"/>"), StartsWith("talk.bml:1:"));
}

TEST(Bml, ReadsTheGesturesOfItsCoreAsWhatTheyShow) {
    const MarkedText text =
        parsed("<gesture lexeme=\"BEAT\"/><gesture lexeme=\"WAVE\"/><gesture lexeme=\"hop\"/>");
    ASSERT_EQ(text.marks.size(), 3u);
    EXPECT_EQ(text.marks[0].reference, "emphasis");
    EXPECT_EQ(text.marks[1].reference, "performative=greet");
    EXPECT_EQ(parsed("<gesture lexeme=\"POINT\"/>").marks.at(0).reference, "deictic=object");
    EXPECT_EQ(parsed("<gesture lexeme=\"POINT\" target=\"User1\"/>").marks.at(0).reference,
              "deictic=partner");
    EXPECT_THAT(
        parsed("<gesture lexeme=\"POINT\" target=\"greenBox\"/>").notes,
        ElementsAre(
            "talk.bml:1:85: the place of \"greenBox\" is not known; <gesture> points to the side of the hand"));
    ASSERT_EQ(text.asked_gestures.size(), 1u);
    EXPECT_EQ(text.asked_gestures[0].name, "hop");
}

TEST(Bml, NotesWhatHasNoPlaceInTheManner) {
    const MarkedText text = parsed(
        "<gesture id=\"g\" lexeme=\"a\" mode=\"LEFT_HAND\"><description><reference>beat=B</reference>"
        "<OPN.value>0.5</OPN.value><TEN.value>0</TEN.value></description></gesture>");
    EXPECT_THAT(text.notes,
                ElementsAre("talk.bml:1:85: mode of <gesture> is left to the speaker's handedness",
                            "talk.bml:1:142: reference \"beat=B\" names no function",
                            "talk.bml:1:171: OPN.value has no dimension of expressivity here"));
    EXPECT_THAT(
        parsed(
            "<gesture lexeme=\"a\"><description><reference>world=blob B</reference></description></gesture>")
            .notes,
        ElementsAre("talk.bml:1:118: reference \"world=blob B\" has no known value and is read as world"));
}

TEST(Bml, ReadsBackWhatItWrites) {
    const MarkedText functions = parse_marked_text(
        {.text = "<fml-apml>" + kSpeech + "<fml><rheme start=\"s:A\" spc=\"0.5\"/></fml></fml-apml>"});
    for (const MarkedText& text :
         {quite_well(), functions,
          parsed("<gesture id=\"g\" lexeme=\"a&lt;b\" start=\"s:A-0.000001\" end=\"0.1\"/>")}) {
        const MarkedText again = parse_bml({.text = testing::to_bml(text)});
        EXPECT_EQ(again.script, text.script);
        EXPECT_EQ(again.words, text.words);
        EXPECT_EQ(again.marks, text.marks) << testing::to_bml(text);
    }
}

TEST(Bml, RefusesTimesThatReferToNothing) {
    EXPECT_EQ(refusal("<gesture lexeme=\"a\" start=\"s:C\"/>"),
              "talk.bml:1:85: start \"s:C\" is no time and no sync point; s has A, B, start and end");
    EXPECT_EQ(refusal("<gesture id=\"g\" lexeme=\"a\" start=\"g:end\" end=\"g:start\"/>"),
              "talk.bml:1:85: start \"g:end\" is no time and no sync point; s has A, B, start and end");
    EXPECT_EQ(refusal("<gesture lexeme=\"a\" start=\"-1\"/>"),
              "talk.bml:1:85: start -1 is outside its range; times go from 0 to 86400 s");
    EXPECT_EQ(
        refusal_of([] {
            parse_bml({.text = "<fml-apml><speech>a</speech><fml><rheme start=\"1\"/></fml></fml-apml>"});
        }),
        "text:1:35: start 1 is a time, and no sync point of the speech gives its word; write one such as "
        "sp1:start");
    EXPECT_EQ(
        refusal_of([] {
            parse_bml({.text = "<fml-apml><speech>a</speech><fml><rheme end=\"start\"/></fml></fml-apml>"});
        }),
        "text:1:35: <rheme> begins before word 1 and ends before word 1; it must hold a word");
}

TEST(Bml, RefusesWhatItDoesNotKnow) {
    EXPECT_THAT(refusal("<gestur/>"),
                StartsWith("talk.bml:1:85: <gestur> is no element of BML; did you mean gesture"));
    EXPECT_THAT(refusal("<gesture lexem=\"a\"/>"),
                StartsWith("talk.bml:1:85: <gesture> has no attribute lexem; it "));
    EXPECT_EQ(refusal("<gesture/>"),
              "talk.bml:1:85: <gesture> names neither a lexeme nor a <reference>; write "
              "lexeme=\"a gesture of the lexicon\"");
    EXPECT_EQ(refusal("<gesture lexeme=\"a\"><b/></gesture>"),
              "talk.bml:1:105: <b> is no element of a behaviour; write one of description");
    EXPECT_THAT(
        refusal("<gesture lexeme=\"a\"><description><FLX.value>1</FLX.value></description></gesture>"),
        StartsWith("talk.bml:1:118: <FLX.value> is no element of a description; did you mean FLD.value? K"));
    EXPECT_EQ(refusal("<gesture lexeme=\"a\"><description><PWR.value>3</PWR.value></description></gesture>"),
              "talk.bml:1:118: PWR.value 3 is outside its range; it goes from -1 to 1");
    EXPECT_EQ(refusal("hello"), "talk.bml:1:84: text lies outside <text>; words go into <speech><text>");
    EXPECT_EQ(refusal(kSpeech), "talk.bml:1:85: a second <speech>; put all words into one");
    EXPECT_EQ(refusal("<gesture id=\"g\" lexeme=\"a\"/><gesture id=\"g\" lexeme=\"a\"/>"),
              "talk.bml:1:113: a second behaviour is called g; give each an id of its own");
}

TEST(Bml, RefusesBrokenSpeech) {
    const auto refused = [](const std::string& text) {
        return refusal_of([&] { parse_bml({.text = text}); });
    };
    EXPECT_EQ(refused("<bml/>"),
              "text:1:2: <bml> holds no <speech>; write <speech id=\"sp1\"><text>...</text></speech>");
    EXPECT_EQ(refused("<bml a=\"1\"/>"), "text:1:2: <bml> has no attribute a; leave it out");
    EXPECT_THAT(refused("<bmx/>"), StartsWith("text:1:2: <bmx> is no element of BML that begins a text;"));
    EXPECT_EQ(refused("<bml><speech> - </speech></bml>"),
              "text:1:7: <speech> holds no word; write what is to be said inside <text>");
    EXPECT_THAT(refused("<bml><speech pace=\"1\">a</speech></bml>"),
                StartsWith("text:1:7: <speech> has no attribute pace; it h"));
    EXPECT_EQ(refused("<bml><speech>a<sync/></speech></bml>"),
              "text:1:16: <sync> has no id; write id=\"T0\"");
    EXPECT_EQ(refused("<bml><speech>a<sync id=\"x\" t=\"1\"/></speech></bml>"),
              "text:1:16: <sync> has no attribute t; it has id and time");
    EXPECT_EQ(refused("<bml><speech>a<sync id=\"x\"/>b<sync id=\"x\"/></speech></bml>"),
              "text:1:31: a second sync point is called x; give each an id of its own");
    EXPECT_THAT(refused("<bml><speech>a<b>c</b></speech></bml>"),
                StartsWith("text:1:16: <b> is no element of a speech; writ"));
    EXPECT_THAT(refused("<fml-apml><speech>a</speech><fml><gesture/></fml></fml-apml>"),
                StartsWith("text:1:35: <gesture> is no element of FML; writ"));
    EXPECT_THAT(refused("<fml-apml><speech>a</speech><fml><performativ/></fml></fml-apml>"),
                StartsWith("text:1:35: <performativ> is no element of FML; did you mean performative?"));
}

// As printed, the thesis's example has no beginning and an end of another name.
TEST(Bml, RefusesTheExampleAsItWasPrinted) {
    std::string printed = read_text(testing::source_dir() / "tests/fixtures/markup/quite_well.bml");
    printed.replace(printed.find("</bml>"), 6, "</hml>");
    EXPECT_EQ(refusal_of([&] { parse_bml({.text = printed, .name = "printed.bml"}); }),
              "printed.bml:28:3: </hml> closes <bml> of 2:2; close <bml> before");
}

}  // namespace
}  // namespace chironomia
