#include "synth/markup/text_rules.h"

#include <gmock/gmock.h>

#include "synth/markup/markup.h"
#include "tests/synth/markup/marks_of.h"

namespace chironomia {
namespace {

using ::testing::Contains;
using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::IsEmpty;
using ::testing::IsSupersetOf;
using testing::mark_text;
using testing::marks_in;
using ::testing::Not;
using ::testing::SizeIs;

MarkedText marked(const std::string& text, const std::string& language = "en") {
    return parse_marked_text({.text = text, .language = language}, MarkupLanguage::plain);
}

TEST(MarkedText, NotesWordsOfAnotherLanguage) {
    const auto notes = [](const std::string& text, const std::string& language) {
        return marked(text, language).notes;
    };
    EXPECT_THAT(notes("Je crois que vous êtes arrivés hier, mais le train est parti sans nous.", "en-us"),
                ElementsAre(::testing::AllOf(
                    HasSubstr("of its words are French (\"je\", \"que\", \"vous\"), 0 English"),
                    HasSubstr("--language fr"))));
    EXPECT_THAT(notes("Ich glaube, dass wir das nicht mehr schaffen, aber er ist schon da.", "fr"),
                ElementsAre(HasSubstr("are German")));
    EXPECT_THAT(notes("I think that you have seen it, and we were not there when he left.", "de-at"),
                ElementsAre(HasSubstr("are English")));
    EXPECT_THAT(notes("They said je ne sais quoi, and that was all that we heard of them.", "en"), IsEmpty());
    EXPECT_THAT(notes("One, two, three, four, five, six, seven.", "en"), IsEmpty());
    EXPECT_THAT(notes("Je crois que vous êtes là.", "fr-be"), IsEmpty());
    EXPECT_THAT(notes("I think that you have seen it.", "es"), IsEmpty());
    const auto of_ssml = [](const std::string& tag) {
        return parse_marked_text({.text = tag + "Je crois que vous êtes là.</speak>"}, MarkupLanguage::ssml)
            .notes;
    };
    EXPECT_THAT(of_ssml("<speak>"), ElementsAre(HasSubstr("are French")));
    EXPECT_THAT(of_ssml("<speak xml:lang=\"fr\">"), IsEmpty());
}

TEST(MarkedText, HoldsNoEmoji) {
    const MarkedText text =
        marked("Well done \U0001f44d\U0001f3fd! I \u2764\ufe0f it \U0001f469\u200d\U0001f4bb.");
    std::vector<std::string> words;
    for (const ScriptWord& word : text.words) words.push_back(word.text);
    EXPECT_THAT(words, ElementsAre("Well", "done", "I", "it"));
    EXPECT_EQ(text.script.find('\xf0'), std::string::npos);
    EXPECT_THAT(text.notes, ElementsAre("text: its 3 emoji are not spoken"));
    EXPECT_THAT(marked("C\u266f \u2776 12 \u00a9 caf\u00e9 \u4e16\u754c \u0915\u094d\u200d\u0937").notes,
                IsEmpty());
}

// A sentence that ends has a pause behind it, of which its gestures make a boundary.
TEST(MarkedText, GoesOnAfterInitials) {
    const auto rhemes = [](const std::string& text) { return marks_in(marked(text), MarkKind::rheme); };
    EXPECT_THAT(rhemes("We left the U.S. in May."), SizeIs(1));
    EXPECT_THAT(rhemes("We left the U.S. Then we came back."), SizeIs(2));
}

TEST(Markdown, IsSpokenWithoutItsSigns) {
    const auto script = [](const std::string& text) { return marked(text).script; };
    EXPECT_EQ(script("It is **really** *very* big, __yes__ _indeed_."),
              "It is really very big, yes indeed.\n");
    EXPECT_EQ(script("# Two ways\nOne is `quick`.\n\n* First\n* Second, [slow](https://a.org/b)!\n"),
              "Two ways.\nOne is quick.\nFirst.\nSecond, slow!\n");
    EXPECT_EQ(script("**你好**，*世界*。很*大*的"), "你好，世界。很大的\n");
    EXPECT_EQ(script("3. *Three* of them\n4. Four of them"), "3. Three of them.\n4. Four of them.\n");
    EXPECT_THAT(marked("*Yes*").notes, ElementsAre(HasSubstr("signs of Markdown are not spoken")));
    for (const char* plain :
         {"2 * 3 * 4 is 24.", "2*3*4 is 24.", "a_b_c and \"d\"", "- Hello\n- World", "1. Hello\n2. World",
          "One\ntwo &amp; three <b>four</b>\n\n    five  ", "Wait -- what?\n---\nYes."}) {
        EXPECT_EQ(script(plain), plain);
        EXPECT_THAT(marked(plain).notes, IsEmpty());
    }
}

TEST(Markdown, EmphasisesWhatItsAuthorDid) {
    EXPECT_THAT(marks_in(marked("We *never* saw **the old wheel** there."), MarkKind::emphasis),
                ElementsAre("emphasis=medium(never)", "emphasis=high(the old wheel)"));
}

TEST(TextRules, PartThemeAndRhemeBeforeTheVerbThatSaysSomething) {
    const MarkedText text = marked("The old machine was a present. We left.");
    EXPECT_THAT(marks_in(text, MarkKind::theme), ElementsAre("theme(The old machine)"));
    EXPECT_THAT(marks_in(text, MarkKind::rheme), ElementsAre("rheme(was a present)", "rheme(We left)"));
}

TEST(TextRules, PartClausesAtCommasAndConjunctionsThatHaveSomethingOnBothSides) {
    EXPECT_THAT(marks_in(marked("We walked to the lake and we swam until midnight"), MarkKind::rheme),
                ElementsAre("rheme(We walked to the lake)", "rheme(and we swam until midnight)"));
    EXPECT_THAT(marks_in(marked("Bread and butter"), MarkKind::rheme),
                ElementsAre("rheme(Bread and butter)"));
}

TEST(TextRules, PartSentencesAtTheSignsOfOtherScripts) {
    EXPECT_THAT(marks_in(marked("你好，世界。你去哪里？", "cmn"), MarkKind::performative),
                ElementsAre("performative=inform(你好 世界)", "performative=ask(你去哪里)"));
    EXPECT_THAT(marks_in(marked("नमस्ते। आप", "hi"), MarkKind::performative).size(), 2u);
}

TEST(TextRules, SeeWordsAndSentencesThroughSpacesAndSignsThatAreNotSeen) {
    EXPECT_THAT(
        marks_in(marked("Regardez là\u2011bas\u202f! Bien\u00a0sûr\u202f?", "fr"), MarkKind::performative),
        ElementsAre("performative=order(Regardez là-bas)", "performative=ask(Bien sûr)"));
    EXPECT_THAT(marks_in(marked("e\u0301nor\u00adme", "fr"), MarkKind::world),
                ElementsAre("world=size-big(énorme)"));
    EXPECT_THAT(marks_in(marked("كيف حالك؟\u200f بخير", "ar"), MarkKind::performative),
                ElementsAre("performative=ask(كيف حالك)", "performative=inform(بخير)"));
}

TEST(TextRules, EndSentencesAtAnEllipsisBeforeACapital) {
    const auto acts = [](const std::string& text, const std::string& language) {
        return marks_in(marked(text, language), MarkKind::performative);
    };
    EXPECT_THAT(acts("Es wiegt fast gar\u2026 Sehen Sie ihn?", "de"),
                ElementsAre("performative=inform(Es wiegt fast gar)", "performative=ask(Sehen Sie ihn)"));
    EXPECT_THAT(acts("They left... Émile stayed.", "en"), SizeIs(2));
    EXPECT_THAT(acts("They left... but we stayed.", "en"), SizeIs(1));
    EXPECT_THAT(acts("Then... I'm lost.", "en"), SizeIs(1));
}

TEST(TextRules, PutTheNuclearAccentOnTheLastContentWordOfTheRheme) {
    const MarkedText text = marked("The old machine was given to us.");
    EXPECT_THAT(marks_in(text, MarkKind::pitch_accent),
                ElementsAre("pitch-accent=LplusHstar(old)", "pitch-accent=LplusHstar(machine)",
                            "pitch-accent=Hstar(given)"));
    for (const Mark& mark : text.marks)
        if (mark.kind == MarkKind::pitch_accent) {
            EXPECT_EQ(mark.weight > 0, mark.first_word == 4);
        }
}

TEST(TextRules, FindDialogActs) {
    const auto acts = [](const std::string& text) { return marks_in(marked(text), MarkKind::performative); };
    EXPECT_THAT(acts("Good morning, everybody."), ElementsAre("performative=greet(Good morning everybody)"));
    EXPECT_THAT(acts("Where do you live?"), ElementsAre("performative=ask(Where do you live)"));
    EXPECT_THAT(acts("Look at the wheel."), ElementsAre("performative=order(Look at the wheel)"));
    EXPECT_THAT(acts("Let's go home."), ElementsAre("performative=suggest(Let's go home)"));
    EXPECT_THAT(acts("Thank you very much."), ElementsAre("performative=thank(Thank you very much)"));
    EXPECT_THAT(acts("Sorry for that."), ElementsAre("performative=apologise(Sorry for that)"));
    EXPECT_THAT(acts("Yes, exactly."), Contains("performative=agree(Yes exactly)"));
    EXPECT_THAT(acts("No, he lied."), Contains("performative=refuse(No)"));
    EXPECT_THAT(acts("Goodbye, my friends."), ElementsAre("performative=goodbye(Goodbye my friends)"));
    EXPECT_THAT(acts("The cat sleeps."), ElementsAre("performative=inform(The cat sleeps)"));
}

TEST(TextRules, FormulasStandForThemselvesHoweverShort) {
    const auto acts = [](const std::string& text, const std::string& language = "en") {
        return marks_in(marked(text, language), MarkKind::performative);
    };
    EXPECT_THAT(acts("Thank you very much, and goodbye!"),
                ElementsAre("performative=thank(Thank you very much)", "performative=goodbye(goodbye)"));
    EXPECT_THAT(acts("Thank you and goodbye!"),
                ElementsAre("performative=thank(Thank you)", "performative=goodbye(goodbye)"));
    EXPECT_THAT(acts("It was huge, goodbye!"), ElementsAre("performative=goodbye(goodbye)"));
    EXPECT_THAT(acts("Hello everybody, thank you."),
                ElementsAre("performative=greet(Hello everybody)", "performative=thank(thank you)"));
    EXPECT_THAT(acts("Merci beaucoup, et au revoir !", "fr"),
                ElementsAre("performative=thank(Merci beaucoup)", "performative=goodbye(au revoir)"));
    EXPECT_THAT(acts("Vielen Dank, und auf Wiedersehen!", "de"),
                ElementsAre("performative=thank(Vielen Dank)", "performative=goodbye(auf Wiedersehen)"));
    EXPECT_THAT(acts("She said hello and goodbye."),
                ElementsAre("performative=inform(She said hello and goodbye)"));
    EXPECT_THAT(acts("Thanks to all of you."), ElementsAre("performative=thank(Thanks to all of you)"));
    EXPECT_THAT(acts("Thanks to the rain, we lost."),
                ElementsAre("performative=inform(Thanks to the rain we lost)"));
}

TEST(TextRules, ANegatedFeelingIsNotShown) {
    const auto feelings = [](const std::string& text, const std::string& language = "en") {
        return marks_in(marked(text, language), MarkKind::emotion);
    };
    EXPECT_THAT(feelings("I am not happy at all."), IsEmpty());
    EXPECT_THAT(feelings("She wasn't really afraid."), IsEmpty());
    EXPECT_THAT(feelings("Je ne suis pas content."), IsEmpty());
    EXPECT_THAT(feelings("Ce n'est pas triste.", "fr"), IsEmpty());
    EXPECT_THAT(feelings("Je ne suis pas content.", "fr"), IsEmpty());
    EXPECT_THAT(feelings("Ich bin nicht wütend.", "de"), IsEmpty());
    EXPECT_THAT(feelings("Das ist kein wunderbar neues Haus.", "de"), IsEmpty());
    EXPECT_THAT(feelings("Je suis content.", "fr"), ElementsAre("emotion=joy(content)"));
    EXPECT_THAT(feelings("Je suis plus content.", "fr"), ElementsAre("emotion=joy(content)"));
    EXPECT_THAT(feelings("No, I am happy."), ElementsAre("emotion=joy(happy)"));
    EXPECT_THAT(feelings("I am not only happy."), ElementsAre("emotion=joy(happy)"));
    EXPECT_THAT(feelings("I am not sad but happy."), ElementsAre("emotion=joy(happy)"));
    EXPECT_THAT(feelings("She is no doubt happy."), ElementsAre("emotion=joy(happy)"));
    EXPECT_THAT(feelings("Ich bin wütend, nicht traurig.", "de"), ElementsAre("emotion=anger(wütend)"));
    EXPECT_THAT(feelings("Ich freue mich nicht.", "de"), IsEmpty());
    EXPECT_THAT(feelings("Schön ist das wirklich nicht.", "de"), IsEmpty());
    EXPECT_THAT(feelings("Ich freue mich nicht nur heute.", "de"), ElementsAre("emotion=joy(freue)"));
    EXPECT_THAT(feelings("Ich bin glücklich und du bist es nicht.", "de"),
                ElementsAre("emotion=joy(glücklich)"));
    EXPECT_THAT(feelings("Leider kommt er nicht.", "de"), ElementsAre("emotion=sadness(Leider)"));
    EXPECT_THAT(feelings("Happy people do not cry.", "en"), ElementsAre("emotion=joy(Happy)"));
}

TEST(TextRules, ANegatedAgreementIsNotShown) {
    const auto agreements = [](const std::string& text, const std::string& language) {
        std::vector<std::string> found = marks_in(marked(text, language), MarkKind::performative);
        std::erase_if(found, [](const std::string& mark) { return !mark.starts_with("performative=agree"); });
        return found;
    };
    EXPECT_THAT(agreements("Mais je ne suis pas d'accord.", "fr"), IsEmpty());
    EXPECT_THAT(agreements("Je suis d'accord.", "fr"), ElementsAre("performative=agree(d'accord)"));
    EXPECT_THAT(agreements("Ich bin nicht einverstanden.", "de"), IsEmpty());
    EXPECT_THAT(agreements("Einverstanden bin ich nicht.", "de"), IsEmpty());
    EXPECT_THAT(agreements("Stimmt nicht.", "de"), IsEmpty());
    EXPECT_THAT(agreements("Ich bin einverstanden.", "de"), ElementsAre("performative=agree(einverstanden)"));
}

TEST(TextRules, FindRelationsPropertiesPlacesAndFeelings) {
    EXPECT_THAT(
        marks_in(marked("First we measure, but the big round tank over there might leak because of fear. "
                        "Of course it was wonderful.")),
        IsSupersetOf({"belief-relation=enumerate(First)",
                      "belief-relation=contrast(but the big round tank over there might leak)",
                      "world=size-big(big)", "world=shape-round(round)", "deictic=place-there(over there)",
                      "certainty=uncertain(might)", "belief-relation=cause-effect(because of fear)",
                      "certainty=certain(Of course)", "emotion=joy(wonderful)"}));
}

TEST(TextRules, DoNotTakeDoubtForCertainty) {
    const auto certainty = [](const std::string& text, const std::string& language) {
        return marks_in(marked(text, language), MarkKind::certainty);
    };
    EXPECT_THAT(certainty("Ich bin nicht sicher.", "de"), ElementsAre("certainty=uncertain(nicht sicher)"));
    EXPECT_THAT(certainty("Ich bin sicher.", "de"), ElementsAre("certainty=certain(sicher)"));
    EXPECT_THAT(certainty("Je ne suis pas sûr.", "fr"), ElementsAre("certainty=uncertain(pas sûr)"));
}

TEST(TextRules, TellTheMorningFromTomorrowInGerman) {
    for (const char* text : {"Wir essen heute Morgen.", "Am Morgen essen wir.", "Jeden Morgen essen wir."})
        EXPECT_THAT(marks_in(marked(text, "de"), MarkKind::world), IsEmpty()) << text;
    EXPECT_THAT(marks_in(marked("Morgen essen wir.", "de"), MarkKind::world),
                ElementsAre("world=time-future(Morgen)"));
    const MarkedText greeting = marked("Ich wünsche Ihnen einen guten Morgen.", "de");
    EXPECT_THAT(marks_in(greeting, MarkKind::world), IsEmpty());
    EXPECT_THAT(marks_in(greeting, MarkKind::performative),
                Contains(HasSubstr("performative=greet(einen guten")));
}

TEST(TextRules, OrdinalsCountOnTheFingers) {
    const auto world = [](const std::string& text, const std::string& language) {
        return marks_in(marked(text, language), MarkKind::world);
    };
    const MarkedText english =
        marked("There are two reasons. First, we plan. Second, we build. Third, we test. Finally, we rest.");
    EXPECT_THAT(marks_in(english, MarkKind::world),
                ElementsAre("world=quantity-two(two)", "world=quantity-one(First)",
                            "world=quantity-two(Second)", "world=quantity-three(Third)"));
    EXPECT_EQ(marks_in(english, MarkKind::belief_relation).size(), 4u);
    for (const Mark& mark : english.marks)
        if (mark.kind == MarkKind::world) {
            EXPECT_GT(mark.weight, 0.5) << mark_text(mark, english);
        }
    EXPECT_THAT(world("Premièrement, on pense. En second lieu, on mange. Troisièmement, on dort.", "fr"),
                ElementsAre("world=quantity-one(Premièrement)", "world=quantity-two(En second lieu)",
                            "world=quantity-three(Troisièmement)"));
    EXPECT_THAT(world("Erstens denken wir. Zweitens essen wir. Drittens schlafen wir.", "de"),
                ElementsAre("world=quantity-one(Erstens)", "world=quantity-two(Zweitens)",
                            "world=quantity-three(Drittens)"));
}

TEST(TextRules, CueWordsCountOnlyWhereTheyMeanIt) {
    EXPECT_THAT(marks_in(marked("There is a second house there"), MarkKind::deictic),
                ElementsAre("deictic=place-there(there)"));
    EXPECT_THAT(marks_in(marked("There is a second house"), MarkKind::belief_relation), IsEmpty());
}

TEST(TextRules, PointAtPronounsNowAndThenOnly) {
    EXPECT_THAT(marks_in(marked("You know you can if you want."), MarkKind::deictic),
                ElementsAre("deictic=partner(You)"));
}

TEST(TextRules, HearEmphasisInCapitalsInIntensifiersAndInNews) {
    EXPECT_THAT(marks_in(marked("I will NOT go."), MarkKind::emphasis), ElementsAre("emphasis=high(NOT)"));
    EXPECT_THAT(marks_in(marked("It was really cold."), MarkKind::emphasis),
                ElementsAre("emphasis=high(cold)"));
    EXPECT_THAT(marks_in(marked("It was an extraordinary day."), MarkKind::emphasis),
                ElementsAre("emphasis=medium(extraordinary)"));
    EXPECT_THAT(marks_in(marked("It was a day."), MarkKind::emphasis), IsEmpty());
}

TEST(TextRules, WhatWasSaidBeforeWeighsLess) {
    const MarkedText text =
        marked("He built a computer. It was with us and then with him. She sold the computer.");
    std::vector<double> weights;
    for (const Mark& mark : text.marks)
        if (mark.kind == MarkKind::rheme && mark.weight > 0.1) weights.push_back(mark.weight);
    ASSERT_EQ(weights.size(), 2u);
    EXPECT_NEAR(weights[0] - weights[1], 0.22, 1e-9);
}

// "huge" weighs 0.78; the rheme ends on the next word, and the next one three words further.
TEST(TextRules, HandsHaveNoTimeForTwoWordsInASecond) {
    const MarkedText text =
        marked("We saw a huge elephant. It was only an elephant. And then it was an umbrella.");
    std::vector<std::pair<std::string, double>> shown;
    for (const Mark& mark : text.marks)
        if (mark.kind == MarkKind::world || mark.kind == MarkKind::rheme)
            shown.emplace_back(mark_text(mark, text), mark.weight);
    ASSERT_EQ(shown.size(), 4u);
    EXPECT_EQ(shown[0].second, 0);                                     // elephant, next to huge
    EXPECT_EQ(shown[1].second, 0.78);                                  // huge
    EXPECT_NEAR(shown[2].second, (0.07 * 8 - 0.03 - 0.22) / 2, 1e-3);  // elephant, beside huge
    EXPECT_NEAR(shown[3].second, 0.07 * 8 - 0.03, 1e-3);               // umbrella
}

TEST(TextRules, PicturesGoBeforeBeats) {
    const MarkedText text = marked("She showed three extraordinary machines.");
    for (const Mark& mark : text.marks) {
        const bool is_beat = mark.kind == MarkKind::emphasis || mark.kind == MarkKind::rheme;
        EXPECT_TRUE(!is_beat || mark.weight == 0) << mark_text(mark, text);
        EXPECT_TRUE(mark.kind != MarkKind::world || mark.weight == 0.62) << mark_text(mark, text);
    }
    EXPECT_THAT(marks_in(text, MarkKind::world), ElementsAre("world=quantity-three(three)"));
}

TEST(TextRules, QuestionsAndGreetingsHaveNoTheme) {
    EXPECT_THAT(
        marks_in(marked("Guten Tag und herzlich willkommen. Warum dreht es sich?", "de"), MarkKind::theme),
        IsEmpty());
}

TEST(TextRules, BoundariesDistinguishStatementsQuestionsAndParagraphs) {
    const MarkedText text =
        marked("Do you like it? Why not? I came home, and that surprises me.\n\nThe end.");
    EXPECT_THAT(
        marks_in(text, MarkKind::boundary),
        ElementsAre("boundary=HH()", "boundary=LL()", "boundary=LH()", "boundary=LL()", "boundary=LL()"));
    std::vector<std::size_t> paragraphs;
    for (const Mark& mark : text.marks)
        if (mark.kind == MarkKind::boundary && mark.weight == 1) paragraphs.push_back(mark.first_word);
    EXPECT_THAT(paragraphs, ElementsAre(13u));
}

TEST(TextRules, AFullStopBehindAnAbbreviationEndsNothing) {
    EXPECT_THAT(marks_in(marked("Dr. Smith met Mr. J. Brown."), MarkKind::performative),
                ElementsAre("performative=inform(Dr Smith met Mr J Brown)"));
}

TEST(TextRules, KnowFrench) {
    const MarkedText text =
        marked("Bonjour à tous. L'homme est très grand, mais je ne sais pas pourquoi.", "fr-fr");
    EXPECT_THAT(marks_in(text), IsSupersetOf({"performative=greet(Bonjour à tous)", "theme(L'homme)",
                                              "world=size-big(grand)", "emphasis=high(grand)",
                                              "belief-relation=contrast(mais je ne sais pas pourquoi)",
                                              "certainty=uncertain(je ne sais pas)"}));
}

TEST(TextRules, KnowGerman) {
    const MarkedText text = marked("Guten Tag! Das Haus ist klein, aber natürlich schön. Vielen Dank.", "de");
    EXPECT_THAT(marks_in(text),
                IsSupersetOf({"performative=greet(Guten Tag)", "theme(Das Haus)", "world=size-small(klein)",
                              "belief-relation=contrast(aber natürlich schön)",
                              "certainty=certain(natürlich)", "performative=thank(Vielen Dank)"}));
}

TEST(TextRules, MarkOtherLanguagesByPunctuationAlone) {
    const MarkedText text = marked("La casa è bella, ma il giardino rimane piccolo?", "it");
    EXPECT_THAT(marks_in(text, MarkKind::rheme),
                ElementsAre("rheme(La casa è bella)", "rheme(ma il giardino rimane piccolo)"));
    EXPECT_THAT(marks_in(text, MarkKind::performative),
                ElementsAre("performative=ask(La casa è bella ma il giardino rimane piccolo)"));
    EXPECT_THAT(marks_in(text, MarkKind::world), IsEmpty());
    EXPECT_THAT(marks_in(text, MarkKind::belief_relation), IsEmpty());
}

TEST(TextRules, TakeTheTurnAtTheBeginningAndGiveItAtTheEnd) {
    const MarkedText text = marked("We came.");
    EXPECT_THAT(marks_in(text, MarkKind::turn), ElementsAre("turn=take()", "turn=give()"));
    EXPECT_EQ(text.marks.back().first_word, 2u);
}

}  // namespace
}  // namespace chironomia
