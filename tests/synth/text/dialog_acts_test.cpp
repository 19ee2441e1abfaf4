#include "synth/text/dialog_acts.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <set>

#include "core/text.h"

namespace chironomia {
namespace {

using ::testing::ElementsAre;
using ::testing::IsEmpty;

std::string_view act_of(const std::string& sentence) {
    std::vector<std::string> words;
    for (const std::string_view word : split_words(sentence)) words.emplace_back(word);
    return kDialogActNames[dialog_act_of(words)];
}

TEST(DialogActs, HaveTheOrderOfTheLabelMap) {
    EXPECT_EQ(kDialogActNames.size(), 38u);
    EXPECT_EQ(kDialogActNames[0], "Other");
    EXPECT_EQ(kDialogActNames[12], "Statement-opinion");
    EXPECT_EQ(kDialogActNames[25], "Statement-non-opinion");
    EXPECT_EQ(kDialogActNames[37], "Rhetorical-Questions");
    EXPECT_EQ(std::set<std::string_view>(kDialogActNames.begin(), kDialogActNames.end()).size(), 38u);
}

TEST(DialogActs, AreRecognizedByWords) {
    EXPECT_EQ(act_of("Thank you all for coming ."), "Thanking");
    EXPECT_EQ(act_of("Goodbye , everyone ."), "Conventional-closing");
    EXPECT_EQ(act_of("Hello and welcome ."), "Conventional-opening");
    EXPECT_EQ(act_of("I am so sorry ."), "Apology");
    EXPECT_EQ(act_of("Don’t worry about it ."), "Downplayer");
    EXPECT_EQ(act_of("Uh-huh ."), "Acknowledge (Backchannel)");
    EXPECT_EQ(act_of("Oh , I see ."), "Response Acknowledgement");
    EXPECT_EQ(act_of("Yes ."), "Yes answers");
    EXPECT_EQ(act_of("No , not today ."), "No answers");
    EXPECT_EQ(act_of("Not really ."), "Negative non-no answers");
    EXPECT_EQ(act_of("It is ."), "Affirmative non-yes answers");
    EXPECT_EQ(act_of("That’s right , it does ."), "Agree/Accept");
    EXPECT_EQ(act_of("Maybe it will ."), "Maybe/Accept-part");
    EXPECT_EQ(act_of("I don't know about that ."), "Hedge");
    EXPECT_EQ(act_of("Wow , that is big !"), "Appreciation");
    EXPECT_EQ(act_of("I'm afraid we cannot ."), "Dispreferred answers");
    EXPECT_EQ(act_of("In other words , it fell ."), "Summarize/reformulate");
    EXPECT_EQ(act_of("I think it is big ."), "Statement-opinion");
    EXPECT_EQ(act_of("I will show you ."), "Offers/Options/Commits");
    EXPECT_EQ(act_of("Look at this ."), "Action-directive");
    EXPECT_EQ(act_of("Let's go ."), "Action-directive");
    EXPECT_EQ(act_of("Hold on ."), "Hold before answer/agreement");
    EXPECT_EQ(act_of("\"It fell\""), "Quotation");
    EXPECT_EQ(act_of("The house stands on a hill ."), "Statement-non-opinion");
}

TEST(DialogActs, AreRecognizedByTheFormOfAQuestion) {
    EXPECT_EQ(act_of("Where do they live ?"), "Wh-Question");
    EXPECT_EQ(act_of("Do they live here ?"), "Yes-No-Question");
    EXPECT_EQ(act_of("They live here ?"), "Declarative Yes-No-Question");
    EXPECT_EQ(act_of("They live where ?"), "Declarative Wh-Question");
    EXPECT_EQ(act_of("They live here , don't they ?"), "Tag-Question");
    EXPECT_EQ(act_of("Or do they live there ?"), "Or-Clause");
    EXPECT_EQ(act_of("What do you think of it ?"), "Open-Question");
    EXPECT_EQ(act_of("Who knows ?"), "Rhetorical-Questions");
    EXPECT_EQ(act_of("Really ?"), "Backchannel in question form");
    EXPECT_EQ(act_of("Pardon ?"), "Signal-non-understanding");
    EXPECT_EQ(act_of("Is it big?"), "Yes-No-Question");
}

// The acts of words that are said one behind the other, "|" being a silence of half a second.
std::vector<std::string_view> acts_of(const std::string& text) {
    std::vector<CorpusWord> words;
    double time = 0;
    for (const std::string_view word : split_words(text)) {
        if (word != "|") words.push_back({.text = std::string(word), .start = time, .end = time + 0.3});
        time += word == "|" ? 0.5 : 0.3;
    }
    std::vector<std::string_view> names;
    for (const std::size_t act : dialog_acts_of(words, 0.2)) names.push_back(kDialogActNames[act]);
    return names;
}

TEST(DialogActs, GoWithTheWordsOfTheirSentence) {
    EXPECT_THAT(acts_of("Hello! \u201cIs | it big?\u201d Yes\u2026 It fell"),
                ElementsAre("Conventional-opening", "Yes-No-Question", "Yes-No-Question", "Yes-No-Question",
                            "Yes answers", "Statement-non-opinion", "Statement-non-opinion"));
    EXPECT_THAT(acts_of("hello | thank you | it fell"),
                ElementsAre("Conventional-opening", "Thanking", "Thanking", "Statement-non-opinion",
                            "Statement-non-opinion"))
        << "without marks silences part sentences";
    EXPECT_THAT(acts_of(""), IsEmpty());
}

TEST(DialogActs, AreOtherWithoutWords) {
    EXPECT_EQ(dialog_act_of({}), 0u);
    EXPECT_EQ(act_of("..."), "Other");
}

}  // namespace
}  // namespace chironomia
