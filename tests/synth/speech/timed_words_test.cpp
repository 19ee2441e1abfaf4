#include "synth/speech/timed_words.h"

#include <gmock/gmock.h>

#include "core/error.h"
#include "core/files/files.h"
#include "core/random.h"
#include "synth/speech/align.h"
#include "tests/support/support.h"
#include "tests/synth/speech/speech_support.h"

namespace chironomia {
namespace {

namespace fs = std::filesystem;

using ::testing::Contains;
using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::IsEmpty;
using testing::refusal_of;
using testing::TemporaryFolder;
using testing::test_file;

constexpr double kDuration = 10;  // [s] of the sound

class TimedWordsOf : public ::testing::Test {
  protected:
    TimedWords read(const std::string& content, const std::string& speaker = "") const {
        write_text(file(), content);
        return read_timed_words(file(), kDuration, speaker);
    }
    std::string refusal(const std::string& content, const std::string& speaker = "") const {
        std::string message = refusal_of([&] { read(content, speaker); });
        const std::string name = file().string() + ": ";
        return message.starts_with(name) ? message.substr(name.size()) : message;
    }

  private:
    fs::path file() const { return folder_ / "words"; }

    TemporaryFolder folder_;
};

// "hello 0.5-0.9"
std::vector<std::string> with_times(const std::vector<SpokenWord>& words) {
    std::vector<std::string> texts;
    for (const SpokenWord& word : words)
        texts.push_back(format("{} {:g}-{:g}", word.text, word.start, word.end));
    return texts;
}

std::vector<std::string> with_times(const std::vector<SpokenPhoneme>& phonemes) {
    std::vector<std::string> texts;
    for (const SpokenPhoneme& phoneme : phonemes) {
        const char* stress = phoneme.stress == Stress::primary     ? "'"
                             : phoneme.stress == Stress::secondary ? ","
                                                                   : "";
        texts.push_back(format("{}{} {:g}-{:g}", stress, phoneme.symbol, phoneme.start, phoneme.end));
    }
    return texts;
}

const std::vector<std::string> kHelloWorld = {"hello 0.5-0.9", "world 1-1.5"};

std::string short_textgrid(const std::string& tiers) {
    return "File type = \"ooTextFile\"\nObject class = \"TextGrid\"\n\n0\n2\n<exists>\n" + tiers;
}

std::string short_tier(const std::string& name, const std::vector<std::string>& intervals) {
    return "\"IntervalTier\"\n\"" + name + "\"\n0\n2\n" + std::to_string(intervals.size()) + "\n" +
           join(intervals, "\n") + "\n";
}

const std::string kWordTier =
    short_tier("words", {"0 0.5 \"\"", "0.5 0.9 \"hello\"", "0.9 1 \"sil\"", "1 1.5 \"world\""});

TEST_F(TimedWordsOf, ReadShortTextGrids) {
    EXPECT_EQ(with_times(read(short_textgrid("1\n" + kWordTier)).words), kHelloWorld);
}

TEST_F(TimedWordsOf, ReadLongTextGridsWithCommentsQuotesAndPoints) {
    const TimedWords timed = read(R"(File type = "ooTextFile"
Object class = "TextGrid"

xmin = 0
xmax = 2
tiers? <exists>
size = 2
item []:
    item [1]:
        class = "TextTier"
        name = "bell"
        xmin = 0
        xmax = 2
        points: size = 1
        points [1]:
            number = 0.3
            mark = "ding"
    item [2]:
        class = "IntervalTier"
        name = "Mary"    ! 5 "of" hers
        xmin = 0
        xmax = 2
        intervals: size = 2
        intervals [1]:
            xmin = 0.5
            xmax = 0.9
            text = """hello,"""
        intervals [2]:
            xmin = 1
            xmax = 1.5
            text = "world
"
)");
    EXPECT_EQ(with_times(timed.words), kHelloWorld);
    EXPECT_THAT(timed.notes, IsEmpty());
}

TEST_F(TimedWordsOf, ReadTextGridsInUtf16) {
    const std::string text = short_textgrid(
        "1\n" + short_tier("words", {"0.5 0.9 \"h\xc3\xa9llo\"", "1 1.5 \"\xf0\x9f\x98\x80z\""}));
    for (const bool is_big : {false, true}) {
        std::string bytes = is_big ? "\xfe\xff" : "\xff\xfe";
        const auto add = [&](int unit) {
            const char high = static_cast<char>(unit >> 8), low = static_cast<char>(unit & 255);
            bytes += is_big ? high : low;
            bytes += is_big ? low : high;
        };
        for (const char byte : text) {
            if (byte == '\xc3') add(0xe9);
            if (byte == '\xf0') add(0xd83d), add(0xde00);
            if (static_cast<unsigned char>(byte) < 0x80) add(byte);
        }
        EXPECT_THAT(with_times(read(bytes).words),
                    ElementsAre("h\xc3\xa9llo 0.5-0.9", "\xf0\x9f\x98\x80z 1-1.5"));
        EXPECT_EQ(refusal(bytes + "\x01"), "its UTF-16 is broken; save it as UTF-8");
    }
}

TEST_F(TimedWordsOf, ReadPhonemesInArpabetAsIpa) {
    const TimedWords timed =
        read(short_textgrid("2\n" + kWordTier +
                            short_tier("phones", {"0 0.5 \"sil\"", "0.5 0.6 \"HH\"", "0.6 0.7 \"AH0\"",
                                                  "0.7 0.8 \"L\"", "0.8 0.9 \"OW1\"", "0.9 1 \"\"",
                                                  "1 1.1 \"W\"", "1.1 1.3 \"ER2\"", "1.3 1.5 \"LD\""})));
    EXPECT_THAT(with_times(timed.phonemes), ::testing::Contains("LD 1.3-1.5"))
        << "no ARPAbet: taken as it is";
    const TimedWords arpabet = read(
        short_textgrid("2\n" + kWordTier +
                       short_tier("phones", {"0 0.5 \"sil\"", "0.5 0.6 \"HH\"", "0.6 0.7 \"AH0\"",
                                             "0.7 0.8 \"L\"", "0.8 0.9 \"OW1\"", "0.9 1 \"\"", "1 1.1 \"W\"",
                                             "1.1 1.3 \"ER2\"", "1.3 1.4 \"l\"", "1.4 1.5 \"d\""})));
    EXPECT_THAT(with_times(arpabet.phonemes),
                ElementsAre("_ 0-0.5", "h 0.5-0.6", "ə 0.6-0.7", "l 0.7-0.8", "'oʊ 0.8-0.9", "_ 0.9-1",
                            "w 1-1.1", ",ɝ 1.1-1.3", "l 1.3-1.4", "d 1.4-1.5"));
    EXPECT_EQ(arpabet.words[0].first_phoneme, 1u);
    EXPECT_EQ(arpabet.words[0].end_phoneme, 5u);
    EXPECT_EQ(arpabet.words[1].first_phoneme, 6u);
    EXPECT_EQ(arpabet.words[1].end_phoneme, 10u);
}

TEST_F(TimedWordsOf, ReadPhonemesInIpaWithTheirStressAtTheVowel) {
    const TimedWords timed = read(short_textgrid(
        "2\n" + kWordTier +
        short_tier("Mary - phones", {"0.5 0.6 \"ˈʁ\"", "0.6 0.9 \"ɑ̃\"", "1 1.2 \"ˌy\"", "1.2 1.5 \"ʃ\""})));
    EXPECT_THAT(with_times(timed.phonemes), ElementsAre("ʁ 0.5-0.6", "'ɑ̃ 0.6-0.9", ",y 1-1.2", "ʃ 1.2-1.5"));
}

// As the aligner of Penn writes it; the tier is ARPAbet all the same.
TEST_F(TimedWordsOf, ReadALaughAmongArpabetAsAPause) {
    const TimedWords timed = read(short_textgrid(
        "2\n" + kWordTier + short_tier("phones", {"0.5 0.7 \"B\"", "0.7 0.9 \"AY1\"", "0.9 1.4 \"{LG}\""})));
    EXPECT_THAT(with_times(timed.phonemes), ElementsAre("b 0.5-0.7", "'aɪ 0.7-0.9", "_ 0.9-1.4"));
}

// WebMAUS writes X-SAMPA.
TEST_F(TimedWordsOf, ReadThePhonemesOfWebMaus) {
    const std::string words = short_tier("ORT-MAU", {"0 0.5 \"<nib>\"", "0.5 0.9 \"bonjour\"", "0.9 2 \"\""});
    const std::string forms = short_tier("KAN-MAU", {"0 0.5 \"\"", "0.5 0.9 \"b o~ Z u R\"", "0.9 2 \"\""});
    const std::string phones =
        short_tier("MAU", {"0 0.5 \"<nib>\"", "0.5 0.6 \"b\"", "0.6 0.7 \"o~\"", "0.7 0.75 \"Z\"",
                           "0.75 0.85 \"u\"", "0.85 0.9 \"R\"", "0.9 2 \"<p:>\""});
    const TimedWords timed = read(short_textgrid("3\n" + words + forms + phones));
    EXPECT_THAT(with_times(timed.words), ElementsAre("bonjour 0.5-0.9"));
    EXPECT_THAT(with_times(timed.phonemes),
                ElementsAre("_ 0-0.5", "b 0.5-0.6", "o\u0303 0.6-0.7", "ʒ 0.7-0.75", "u 0.75-0.85",
                            "ʁ 0.85-0.9", "_ 0.9-2"));
    EXPECT_EQ(timed.words[0].first_phoneme, 1u);
    EXPECT_EQ(timed.words[0].end_phoneme, 6u);
}

TEST_F(TimedWordsOf, AreRefusedIfATextGridIsBroken) {
    EXPECT_EQ(refusal(short_textgrid("1\n\"IntervalTier\"\n\"words\"\n0\n2\n1\n0.5 0.9")),
              "line 13: the TextGrid ends too early; save it again");
    EXPECT_EQ(refusal(short_textgrid("1\n\"IntervalTier\"\n\"words\"\n0\n2\n1\n0.5 0.9 7")),
              "line 13: \"7\" stands where the text of an interval should be; save the TextGrid again");
    EXPECT_EQ(refusal(short_textgrid("1\n\"IntervalTier\"\n\"words\n0\n2\n1\n0.5 0.9 7")),
              "line 9: a text has no closing quotation mark; save the TextGrid again");
    EXPECT_EQ(refusal(short_textgrid("1\n\"IntervalTier\"\n\"words\"\n0\n2\n99999\n0.5 0.9 \"a\"")),
              "line 12: the number of intervals is 99999, which the file cannot hold; save it again");
    EXPECT_EQ(refusal(short_textgrid("2\n" + short_tier("A", {}) + short_tier("B", {}))),
              "none of its tiers (\"A\", \"B\") is named \"words\"; name the tier of words so");
    EXPECT_EQ(refusal(short_textgrid("0\n")),
              "none of its tiers (none) is named \"words\"; name the tier of words so");
    EXPECT_EQ(
        refusal(short_textgrid("2\n" + short_tier("A - words", {}) + short_tier("B - words", {}))),
        "the tiers \"A - words\" and \"B - words\" are both named as words; keep those of one speaker, or choose "
        "one by --words-speaker");
}

// An utterance whose words have times, of which the one in the middle is left to ELAN; and a gesture.
std::string elan(const std::string& tier, const std::string& second_time = "") {
    return format(R"(<?xml version="1.0" encoding="UTF-8"?>
<ANNOTATION_DOCUMENT AUTHOR="" DATE="2026-01-01T00:00:00+01:00" FORMAT="3.0" VERSION="3.0">
<HEADER MEDIA_FILE="" TIME_UNITS="milliseconds"></HEADER>
<TIME_ORDER>
<TIME_SLOT TIME_SLOT_ID="ts1" TIME_VALUE="500"/><TIME_SLOT TIME_SLOT_ID="ts2"{}/>
<TIME_SLOT TIME_SLOT_ID="ts3" TIME_VALUE="1500"/><TIME_SLOT TIME_SLOT_ID="ts4" TIME_VALUE="2000"/>
</TIME_ORDER>
<TIER LINGUISTIC_TYPE_REF="w" TIER_ID="{}">
<ANNOTATION><ALIGNABLE_ANNOTATION ANNOTATION_ID="a2" TIME_SLOT_REF1="ts2" TIME_SLOT_REF2="ts3">
<ANNOTATION_VALUE>&lt;eps&gt;</ANNOTATION_VALUE></ALIGNABLE_ANNOTATION></ANNOTATION>
<ANNOTATION><ALIGNABLE_ANNOTATION ANNOTATION_ID="a1" TIME_SLOT_REF1="ts1" TIME_SLOT_REF2="ts2">
<ANNOTATION_VALUE>hello</ANNOTATION_VALUE></ALIGNABLE_ANNOTATION></ANNOTATION>
<ANNOTATION><ALIGNABLE_ANNOTATION ANNOTATION_ID="a3" TIME_SLOT_REF1="ts3" TIME_SLOT_REF2="ts4">
<ANNOTATION_VALUE>world</ANNOTATION_VALUE></ALIGNABLE_ANNOTATION></ANNOTATION>
</TIER>
<TIER LINGUISTIC_TYPE_REF="g" TIER_ID="gesture">
<ANNOTATION><ALIGNABLE_ANNOTATION ANNOTATION_ID="a4" TIME_SLOT_REF1="ts1" TIME_SLOT_REF2="ts4">
<ANNOTATION_VALUE>beat</ANNOTATION_VALUE></ALIGNABLE_ANNOTATION></ANNOTATION>
</TIER>
<TIER LINGUISTIC_TYPE_REF="r" PARENT_REF="gesture" TIER_ID="word">
<ANNOTATION><REF_ANNOTATION ANNOTATION_ID="a5" ANNOTATION_REF="a4"><ANNOTATION_VALUE>no time</ANNOTATION_VALUE>
</REF_ANNOTATION></ANNOTATION>
</TIER>
</ANNOTATION_DOCUMENT>
)",
                  second_time, tier);
}

TEST_F(TimedWordsOf, ReadAnnotationsOfElan) {
    for (const char* tier : {"words", "Word", "anna - words", "word@anna"})
        EXPECT_THAT(with_times(read(elan(tier)).words), ElementsAre("hello 0.5-1", "world 1.5-2")) << tier;
    EXPECT_THAT(with_times(read(elan("words", " TIME_VALUE=\"900\"")).words),
                ElementsAre("hello 0.5-0.9", "world 1.5-2"));
}

TEST_F(TimedWordsOf, ComeLaterWhereElanSynchronisedTheMedium) {
    const auto with_media = [](const std::string& media) {
        std::string text = elan("words");
        return text.replace(text.find("</HEADER>"), 0, media);
    };
    const std::string moved = "<MEDIA_DESCRIPTOR MEDIA_URL=\"file:///a.wav\" TIME_ORIGIN=\"1000\"/>";
    const TimedWords timed = read(with_media(moved));
    EXPECT_THAT(with_times(timed.words), ElementsAre("hello 1.5-2", "world 2.5-3"));
    EXPECT_THAT(timed.notes,
                Contains(HasSubstr("its medium begins at 1 s (TIME_ORIGIN), so words come that much later")));
    const TimedWords both = read(with_media(moved + "<MEDIA_DESCRIPTOR MEDIA_URL=\"file:///a.mp4\"/>"));
    EXPECT_THAT(with_times(both.words), ElementsAre("hello 0.5-1", "world 1.5-2"));
    EXPECT_THAT(both.notes, Contains(HasSubstr("its media begin at 0 s and 1 s")));
    EXPECT_THAT(refusal(with_media("<MEDIA_DESCRIPTOR TIME_ORIGIN=\"x\"/>")),
                HasSubstr("the TIME_ORIGIN x is no number"));
}

TEST_F(TimedWordsOf, AreRefusedIfAnnotationsOfElanAreBroken) {
    EXPECT_EQ(
        refusal(elan("text")),
        "none of its tiers (\"text\", \"gesture\", \"word\") is named \"words\"; name the tier of words so");
    EXPECT_THAT(refusal(elan("words", " TIME_VALUE=\"x\"")),
                ::testing::EndsWith(":5:50: the time x is no number; save it again with ELAN"));
    std::string lost = elan("words");
    lost.replace(lost.find("\"ts3\""), 5, "\"ts9\"");
    EXPECT_THAT(refusal(lost), HasSubstr("the time slot ts3 is not there; save it again with ELAN"));
}

TEST_F(TimedWordsOf, ReadCaptionsOfAWordEach) {
    EXPECT_EQ(with_times(read("WEBVTT - hers\n\nNOTE\n00:07.000 --> 00:08.000\nno\n\nSTYLE\n::cue {}\n\n"
                              "1\n00:00:00.500 --> 00:00:00.900 align:start\n<v Mary>hello</v>,\n\n"
                              "00:01.000 --> 00:01.500\nw&lrm;orld&nbsp;\n")
                             .words),
              kHelloWorld);
    EXPECT_EQ(
        with_times(
            read("1\r\n00:00:00,500 --> 00:00:00,900\r\nhello\r\n\r\n2\r\n00:00:01,000 --> 00:00:01,500\r\n"
                 "world!\r\n")
                .words),
        kHelloWorld);
}

TEST_F(TimedWordsOf, ReadTimesInsideOfCaptions) {
    const TimedWords timed = read(
        "WEBVTT\n\n00:00.500 --> 00:02.000\n<c>hello</c> <00:00:00.900><i>big</i>\n"
        "<00:01.000>world<00:01.500>\n");
    EXPECT_THAT(with_times(timed.words), ElementsAre("hello 0.5-0.9", "big 0.9-1", "world 1-1.5"));
    EXPECT_THAT(timed.notes, IsEmpty());
}

TEST_F(TimedWordsOf, GoOnBehindALineOfSpacesInACaption) {
    EXPECT_EQ(
        with_times(
            read("WEBVTT\n\n00:00.500 --> 00:00.900\n \nhello\n\n00:01.000 --> 00:01.500\nworld\n \n").words),
        kHelloWorld);
    EXPECT_EQ(
        with_times(
            read("1\n00:00:00,500 --> 00:00:00,900\nhello\n \n2\n00:00:01,000 --> 00:00:01,500\nworld\n")
                .words),
        kHelloWorld);
}

TEST_F(TimedWordsOf, CountLinesThatRollingCaptionsShowAgainOnce) {
    const TimedWords timed = read(
        "WEBVTT\nKind: captions\n\n00:00:00.500 --> 00:00:01.500 align:start\n \n"
        "hello<00:00:01.000><c> world</c>\n\n00:00:01.500 --> 00:00:01.510\nhello world\n \n\n"
        "00:00:01.510 --> 00:00:02.000\nhello world\nyes\n\n00:00:02.000 --> 00:00:02.010\nyes\n \n\n"
        "00:00:02.010 --> 00:00:03.000\nyes\nyes\n");
    EXPECT_THAT(with_times(timed.words),
                ElementsAre("hello 0.5-1", "world 1-1.5", "yes 1.51-2", "yes 2.01-3"));
    EXPECT_THAT(timed.notes,
                ElementsAre(HasSubstr(": 4 lines that were shown again in the next cue count once")));
}

TEST_F(TimedWordsOf, TakeTheUnderlinedWordOfCuesWithOneText) {
    const TimedWords timed = read(
        "1\n00:00:00,500 --> 00:00:01,200\n<u>Hello</u> 19 worlds.\n\n"
        "2\n00:00:01,200 --> 00:00:01,300\nHello 19 worlds.\n\n"
        "3\n00:00:01,300 --> 00:00:01,500\nHello 19 <u>worlds.</u>\n\n"
        "4\n00:00:02,000 --> 00:00:02,500\n<u>Yes.</u>\n\n5\n00:00:03,000 --> 00:00:03,500\n<u>Yes.</u>\n");
    EXPECT_THAT(with_times(timed.words),
                ElementsAre("Hello 0.5-1", "19 1-1.2", "worlds 1.3-1.5", "Yes 2-2.5", "Yes 3-3.5"));
    EXPECT_THAT(with_times(read("1\n00:00:01,000 --> 00:00:02,000\nI <u>am</u> a\n").words),
                ElementsAre("I 1-1.25", "am 1.25-1.75", "a 1.75-2"));
}

TEST_F(TimedWordsOf, AreRefusedIfCuesRepeatTheirWords) {
    const std::string fault =
        "the same words stand in successive cues (line 2 and line 6: \"hello world\"); write each word once, or give "
        "the captions in which each word has its time (<00:00:01.500> in WebVTT, <u> in SubRip)";
    EXPECT_EQ(refusal("1\n00:00:01,000 --> 00:00:02,000\nhello world\n\n2\n00:00:02,000 --> 00:00:02,010\n"
                      "hello world\n\n3\n00:00:02,010 --> 00:00:03,000\nhello world\nand you\n"),
              fault);
    EXPECT_EQ(read("1\n00:00:01,000 --> 00:00:02,000\nhello world\n\n2\n00:00:02,000 --> 00:00:03,000\n"
                   "hello world\n\n3\n00:00:03,000 --> 00:00:04,000\nand you\n")
                  .words.size(),
              6u);
}

TEST_F(TimedWordsOf, LeaveOutEffectsAndSoundsInBrackets) {
    const TimedWords timed = read(
        "1\n00:00:00,500 --> 00:00:00,900\n{\\an8}<i>hello</i> [door\nslams]\n\n"
        "2\n00:00:01,000 --> 00:00:01,500\n[Music] world\n");
    EXPECT_EQ(with_times(timed.words), kHelloWorld);
    EXPECT_THAT(timed.notes, ElementsAre(HasSubstr(": 2 sounds in brackets, such as [music], are no words")));
}

TEST_F(TimedWordsOf, SpreadAStretchOfWordsByTheirLettersAndSaySo) {
    const TimedWords timed = read("WEBVTT\n\n00:01.000 --> 00:02.000\nI said: hello!\n");
    EXPECT_THAT(with_times(timed.words), ElementsAre("I 1-1.1", "said 1.1-1.5", "hello 1.5-2"));
    ASSERT_EQ(timed.notes.size(), 1u);
    EXPECT_THAT(timed.notes[0],
                HasSubstr(": 1 stretches hold several words, whose times were spread by their letters"));
}

TEST_F(TimedWordsOf, KeepThePunctuationAsItWasWritten) {
    const TimedWords timed = read(
        "WEBVTT\n\n00:00.000 --> 00:01.000\n\u201cWell, who?\u201d - No.\n\n"
        "00:02.000 --> 00:02.500\n!\n\n00:03.000 --> 00:03.500\nyes\n");
    EXPECT_THAT(timed.written, ElementsAre("\u201cWell,", "who?\u201d", "No.!", "yes"));
    ASSERT_EQ(timed.words.size(), 4u);
    EXPECT_EQ(timed.words[1].text, "who");
}

TEST_F(TimedWordsOf, LoseThePunctuationOfOtherScripts) {
    const TimedWords timed = read("你好？,0,1\nحالك؟,1,2\nनमस्ते।,2,3\n");
    EXPECT_THAT(with_times(timed.words), ElementsAre("你好 0-1", "حالك 1-2", "नमस्ते 2-3"));
}

TEST_F(TimedWordsOf, AreRefusedIfATimingIsBroken) {
    EXPECT_EQ(refusal("WEBVTT\n\n00:0x.000 --> 00:02.000\nhello\n"),
              "line 3: \"00:0x.000 --> 00:02.000\" is no timing; write it as 00:01.000 --> 00:02.500");
    EXPECT_EQ(refusal("WEBVTT\n\n00:01.000 -->\nhello\n"),
              "line 3: \"00:01.000 -->\" is no timing; write it as 00:01.000 --> 00:02.500");
    EXPECT_EQ(refusal("WEBVTT\n\n"), "it holds no word; give a file of words in time");
}

TEST_F(TimedWordsOf, ReadTablesWithAndWithoutNamesOfColumns) {
    for (const char* table :
         {"word,start,end\nhello,0.5,0.9\nworld,1,1.5\n", "hello,0.5,0.9\r\n\r\nworld,1,1.5\r\n",
          "word,start_s,end_s\nhello,0.5,0.9\nworld,1,1.5\n",
          "\xef\xbb\xbf"
          "0.5\t0.9\thello\n1\t1.5\tworld",
          "start_time;END;n;Text\n0.5;0.9;1;\"hello, \"\n1;1.5;2;\"\"\"world\"\"\"\n",
          "#hello,0.5,0.9\nworld,1,1.5\n"})
        EXPECT_EQ(with_times(read(table).words), kHelloWorld) << table;
    EXPECT_THAT(with_times(read("0.5\t0.9\t20\n1\t1.5\tworld\n").words),
                ElementsAre("20 0.5-0.9", "world 1-1.5"));
}

TEST_F(TimedWordsOf, AreRefusedIfATableIsBroken) {
    EXPECT_EQ(refusal("hello world\n"),
              "line 1: its cells (hello world) are neither a word, a start and an end nor their names; write "
              "word,start,end in the first line");
    EXPECT_EQ(refusal("word,start,end\nhello,0.5\n"),
              "line 2: it has 2 cells, and 3 are needed; write word,start,end");
    EXPECT_EQ(refusal("word,start,end\nhello,a,0.9\n"),
              "line 2: the start is \"a\" and no number; write seconds");
    EXPECT_EQ(refusal("word,start,end\nhello,0.5,\n"),
              "line 2: the end is \"\" and no number; write seconds");
    EXPECT_EQ(refusal("\",0.5,0.6\nhello,0.7,0.9\n\",1,1.1\n"),
              "line 1: a word has several lines; double each quote within a cell");
    EXPECT_EQ(refusal(""), "it is empty; write word,start,end");
    EXPECT_EQ(refusal("caf\xe9,1,2\n"), "byte 4 is not UTF-8; save it as UTF-8");
}

TEST_F(TimedWordsOf, ReadJsonAsRecognisersWriteIt) {
    for (
        const char* json :
        {R"([{"word": "hello", "start": 0.5, "end": 0.9}, {"text": "world", "start": 1, "end": 1.5, "p": 1}])",
         R"({"words": [{"word": " hello,", "start": 0.5, "end": 0.9}, {"word": " world.", "start": 1, "end": 1.5}]})",
         R"({"text": "x", "segments": [{"id": 0, "words": [{"word": "hello", "start": 0.5, "end": 0.9}]},
              {"text": " world", "start": 1, "end": 1.5}]})",
         R"({"task": "transcribe", "duration": 3, "words": [{"word": "hello", "start": 0.5, "end": 0.9},
              {"word": "world", "start": 1, "end": 1.5}], "segments": [{"id": 0, "text": "hello world", "start": 0, "end": 3}]})",
         R"({"word_segments": [{"word": "hello", "start": 0.5, "end": 0.9}, {"word": "world", "start": 1, "end": 1.5}]})",
         R"({"transcription": [{"offsets": {"from": 500, "to": 900}, "text": " hello"},
              {"offsets": {"from": 1000, "to": 1200}, "text": " wor"},
              {"offsets": {"from": 1200, "to": 1500}, "text": "ld"}]})",
         R"({"result": [{"conf": 1, "end": 0.9, "start": 0.5, "word": "hello"},
              {"conf": 0.7, "end": 1.5, "start": 1, "word": "world"}], "text": "hello world"})",
         R"([{"text": ""}, {"result": [{"conf": 1, "end": 0.9, "start": 0.5, "word": "hello"}], "text": "hello"},
              {"result": [{"conf": 1, "end": 1.5, "start": 1, "word": "world"}], "text": "world"}])",
         R"([{"id": 1, "start": 0, "end": 0.9, "text": " hello", "words": [{"start": 0.5, "end": 0.9, "word": " hello"}]},
              {"id": 2, "start": 1, "end": 2, "text": " world.", "words": [{"start": 1, "end": 1.5, "word": " world."}]}])",
         R"({"transcription": [{"offsets": {"from": 0, "to": 3000}, "text": " hello world.", "tokens": [
              {"text": "[_BEG_]", "offsets": {"from": 0, "to": 0}}, {"text": " hello", "offsets": {"from": 500, "to": 900}},
              {"text": " wor", "offsets": {"from": 1000, "to": 1200}}, {"text": "ld", "offsets": {"from": 1200, "to": 1500}},
              {"text": ".", "offsets": {"from": 1500, "to": 3000}}, {"text": "[_TT_150]", "offsets": {"from": 3000, "to": 3000}}]}]})",
         R"([{"alternatives": [{"transcript": "hello world", "words": [
              {"word": "hello", "start_time": "0.500s", "end_time": "0.900s"},
              {"word": "world", "start_time": "1s", "end_time": "1.500s"}]}]}])",
         R"({"start": 0, "end": 3, "tiers": {"phones": {"type": "interval", "entries": []}, "words": {"type": "interval",
              "entries": [[0, 0.5, ""], [0.5, 0.9, "hello"], [1, 1.5, "world"]]}}})",
         R"({"metadata": {"channels": 1}, "results": {"channels": [{"alternatives": [{"transcript": "hello world", "words": [
              {"word": "hello", "start": 0.5, "end": 0.9}, {"word": "world", "start": 1, "end": 1.5}]}]}]}})",
         R"({"results": [{"alternatives": [{"words": [{"word": "hello", "startTime": "0.5s", "endTime": "0.9s"}]}, {}]},
              {"alternatives": [{"words": [{"word": "world", "startTime": "1s", "endTime": "1.5s"}]}]}]})"})
        EXPECT_EQ(with_times(read(json).words), kHelloWorld) << json;
}

TEST_F(TimedWordsOf, ReadTablesAsAnnotatorsAndAlignersWriteThem) {
    const std::string rows =
        "words\t\t00:00:00.500\t0.500\t00:00:00.900\t0.900\t00:00:00.400\t0.400\thello\n"
        "words\t\t00:00:01.000\t1.000\t00:00:01.500\t1.500\t00:00:00.500\t0.500\tworld\n";
    for (const std::string& table :
         {rows,
          "Tier\tParticipant\tBegin Time - hh:mm:ss.ms\tBegin Time - ss.msec\tEnd Time - hh:mm:ss.ms\t"
          "End Time - ss.msec\tDuration - hh:mm:ss.ms\tDuration - ss.msec\tspeech\n" +
              rows,
          std::string("Begin Time - ss.msec\tEnd Time - ss.msec\tsaid\n0.5\t0.9\thello\n1\t1.5\tworld\n"),
          std::string("Begin,End,Label,Type,Speaker\n0.5,0.9,hello,words,s\n1,1.5,world,words,s\n"
                      "0.5,0.7,HH,phones,s\n"),
          std::string(";; by sclite\ntalk 1 0.5 0.4 hello 0.98\ntalk 1 1.0 0.5 world 0.97\n")})
        EXPECT_EQ(with_times(read(table).words), kHelloWorld) << table;
    EXPECT_EQ(
        refusal("talk A 0.5 0.4 hello\ntalk B 1.0 0.5 world\n"),
        "line 2: it is of \"talk B\", what is before it of \"talk A\"; keep the words of one recording and "
        "channel");
}

TEST_F(TimedWordsOf, ShareTheTimeThatTheirNeighboursLeaveInSegments) {
    EXPECT_THAT(with_times(read(R"({"segments": [{"start": 0, "end": 3, "words": [
                    {"word": "In"}, {"word": "hello", "start": 0.5, "end": 1}, {"word": "19"}, {"word": "84"},
                    {"word": "world", "start": 2, "end": 2.5}, {"word": "1"}]}]})")
                               .words),
                ElementsAre("In 0-0.5", "hello 0.5-1", "19 1-1.5", "84 1.5-2", "world 2-2.5", "1 2.5-3"));
}

TEST_F(TimedWordsOf, ShareTheTimeThatTheirNeighboursLeaveInAList) {
    const TimedWords timed = read(R"({"words": [{"case": "not-found-in-audio", "word": "Oh"},
        {"word": "hello", "start": 0.5, "end": 1}, {"case": "not-found-in-audio", "word": "big"},
        {"word": "world", "start": 2, "end": 9.5}, {"word": "and"}, {"word": "you"}]})");
    EXPECT_THAT(with_times(timed.words), ElementsAre("Oh 0.2-0.5", "hello 0.5-1", "big 1-2", "world 2-9.5",
                                                     "and 9.5-9.75", "you 9.75-10"));
    EXPECT_THAT(timed.notes,
                ElementsAre(HasSubstr(": 4 words have no times and share what their neighbours leave")));
}

TEST_F(TimedWordsOf, HaveTheLanguageThatJsonNames) {
    const std::string words = R"("segments": [{"text": "a", "start": 0, "end": 1}]})";
    EXPECT_EQ(read(R"({"language": "fr", )" + words).language, "fr");
    EXPECT_EQ(read(R"({"language": "English", )" + words).language, "en");
    EXPECT_EQ(read("{" + words).language, "");
    EXPECT_EQ(
        read(
            R"({"result": {"language": "de"}, "transcription": [{"offsets": {"from": 0, "to": 900}, "text": "a"}]})")
            .language,
        "de");
}

TEST_F(TimedWordsOf, AreRefusedIfTwoSpeakersSayThem) {
    EXPECT_EQ(
        refusal(
            R"({"segments": [{"speaker": "A", "words": [{"word": "a", "start": 0, "end": 1, "speaker": "A"},
        {"word": "b", "start": 1, "end": 2, "speaker": "B"}]}]})"),
        "segments[0].words[1] is said by \"B\", what is before it by \"A\"; keep the words of one speaker, or "
        "choose one by --words-speaker");
    EXPECT_EQ(
        refusal(
            R"([{"word": "a", "start": 0, "end": 1, "speaker": 0}, {"word": "b", "start": 1, "end": 2, "speaker": 1}])"),
        "[1] is said by \"1\", what is before it by \"0\"; keep the words of one speaker, or choose one by "
        "--words-speaker");
    EXPECT_THAT(refusal("word,start,end,speaker\nhello,0.5,0.9,Ann\nworld,1,1.5,Ben\n"),
                HasSubstr("line 3 is said by \"Ben\""));
    EXPECT_THAT(refusal("WEBVTT\n\n00:00.500 --> 00:00.900\n<v Ann>hello\n\n00:01.000 --> "
                        "00:01.500\n<v.loud Ben>world</v>\n"),
                HasSubstr("line 6 is said by \"Ben\", what is before it by \"Ann\""));
}

TEST_F(TimedWordsOf, AreThoseOfTheSpeakerWhoIsChosen) {
    const auto tiers = [](const std::string& ann, const std::string& ben) {
        return short_textgrid("2\n" + short_tier(ann, {"0.5 0.9 \"hello\"", "1 1.5 \"world\""}) +
                              short_tier(ben, {"0.6 2 \"bye\""}));
    };
    for (const std::string& content :
         {tiers("Ann - words", "Ben - words"), tiers("words@Ann", "words@Ben"), tiers("Ann", "Ben"),
          std::string(R"({"segments": [
              {"speaker": "Ann", "words": [{"word": "hello", "start": 0.5, "end": 0.9}]},
              {"speaker": "Ben", "words": [{"word": "bye", "start": 0.6, "end": 2}]},
              {"speaker": "Ann", "text": "world", "start": 1, "end": 1.5}]})"),
          std::string("Begin,End,Label,Type,Speaker\n0.5,0.9,hello,words,Ann\n1,1.5,world,words,Ann\n"
                      "0.6,2,bye,words,Ben\n"),
          std::string("WEBVTT\n\n00:00.500 --> 00:00.900\n<v Ann>hello\n\n00:00.600 --> 00:02.000\n<v.loud "
                      "Ben>bye</v>\n\n00:01.000 --> 00:01.500\n<v Ann>world\n")}) {
        EXPECT_EQ(with_times(read(content, "Ann").words), kHelloWorld) << content;
        EXPECT_THAT(with_times(read(content, "Ben").words), ElementsAre("bye 0.6-2")) << content;
    }
    EXPECT_EQ(refusal(tiers("Ann - words", "Ben - words"), "Eve"),
              "none of its tiers is of \"Eve\"; they are \"Ann - words\", \"Ben - words\"");
    EXPECT_EQ(refusal(R"([{"word": "a", "start": 0, "end": 1, "speaker": "Ann"}])", "Eve"),
              "nothing in it is said by \"Eve\"; it names Ann");
    EXPECT_EQ(refusal("word,start,end\nhello,0.5,0.9\n", "Eve"),
              "nothing in it is said by \"Eve\"; it names no speakers, leave --words-speaker out");
}

TEST_F(TimedWordsOf, ReadMillisecondsAsWhisperTabulatesThem) {
    const TimedWords timed = read("start\tend\ttext\n500\t900\thello\n1000\t1500\tworld\n");
    EXPECT_EQ(with_times(timed.words), kHelloWorld);
    EXPECT_THAT(timed.notes, ElementsAre(HasSubstr(": its times are milliseconds, as Whisper writes them")));
    EXPECT_EQ(with_times(read("start\tend\ttext\n1\t4\thello\n5\t9\tworld\n").words),
              (std::vector<std::string>{"hello 1-4", "world 5-9"}));
    EXPECT_THAT(refusal("hello,500,900\nworld,1000,1500\n"),
                HasSubstr("give the words of this sound, in seconds; are these milliseconds?"));
}

TEST_F(TimedWordsOf, AreRefusedIfJsonIsOfAnotherKind) {
    EXPECT_EQ(
        refusal(R"({"hello": 1})"),
        "it holds no list of words, \"words\", \"segments\", \"chunks\" or \"transcription\"; write [{\"word\": \"hello\", "
        "\"start\": 0.1, \"end\": 0.4}]");
    EXPECT_EQ(refusal(R"({"segments": [{"words": [{"start": 1, "end": 2}]}]})"),
              "segments[0].words[0] has no \"word\"; write its text");
    EXPECT_EQ(refusal(R"([{"word": "a", "end": 2}])"),
              "[0] has no \"start\"; write its time, or leave it out");
    EXPECT_EQ(refusal(R"([{"word": "a", "start": "x", "end": 2}])"),
              "the \"start\" of [0] is \"x\" and no number; write its time, or leave it out");
    EXPECT_EQ(refusal(R"({"transcription": [{"text": "a"}]})"),
              "transcription[0] has no \"offsets\"; write it again");
    EXPECT_THAT(refusal("[{]"), HasSubstr("words:1:3: this is no valid JSON"));
}

TEST_F(TimedWordsOf, ReadLabelFilesOfPhonemes) {
    const TimedWords timed = read(
        "0 5000000 x^x-pau+hh=iy@x_x/A:0\n5000000 9000000 x^sil-hh+iy=t@1_2\n"
        "9000000 15000000 sil^hh-iy+t=er@2\n");
    EXPECT_THAT(with_times(timed.phonemes), ElementsAre("_ 0-0.5", "h 0.5-0.9", "i 0.9-1.5"));
    EXPECT_THAT(timed.words, IsEmpty());
}

TEST_F(TimedWordsOf, AreRefusedIfTheirTimesCannotBe) {
    EXPECT_EQ(refusal("hello,1.5,1\n"),
              "line 1: \"hello\" ends at 1.000 s, before it starts at 1.500 s; correct its times");
    EXPECT_EQ(refusal("hello,-0.5,1\n"), "line 1: \"hello\" starts at -0.500 s; write a time from 0 on");
    EXPECT_EQ(refusal("hello,nan,1\n"), "line 1: \"hello\" starts at nan s; write a time from 0 on");
    EXPECT_EQ(refusal("hello,1,1e12\n"), "line 1: \"hello\" ends at 1e+12 s; write a time of up to 1e+09 s");
    EXPECT_EQ(
        refusal("hello,1,2\nworld,1.5,3\n"),
        "line 2: \"world\" starts at 1.500 s, before \"hello\" (line 1) ends at 2.000 s; write one voice, in "
        "order");
    EXPECT_EQ(
        refusal("hello,9,10.2\n"),
        "line 1: \"hello\" lies from 9.000 to 10.200 s, and the sound ends at 10.000 s; give the words of this "
        "sound");
    EXPECT_EQ(refusal("hello,1,1\nworld,1,2\n"),
              "line 1: \"hello\" starts and ends at 1.000 s, where the next one starts; give it a length");
}

TEST_F(TimedWordsOf, BridgeSmallFaultsAndSaySo) {
    const TimedWords timed = read("a,1,1.54\nb,1.5,2\nc,3,3\nd,3.02,4\ne,5,5\nf,9,10.05\n");
    EXPECT_THAT(with_times(timed.words),
                ElementsAre("a 1-1.5", "b 1.5-2", "c 3-3.02", "d 3.02-4", "e 5-5.05", "f 9-10"));
    ASSERT_EQ(timed.notes.size(), 3u);
    EXPECT_THAT(timed.notes[0], HasSubstr(": 1 words overlapped the next one by up to 50 ms and were cut"));
    EXPECT_THAT(timed.notes[1], HasSubstr(": 1 words ended up to 100 ms behind the sound and were cut"));
    EXPECT_THAT(timed.notes[2], HasSubstr(": 2 words had no length and last to the next one, at most 50 ms"));
}

// Whatever is broken: words in order, or a refusal.
TEST_F(TimedWordsOf, SurviveBrokenFiles) {
    const std::vector<std::string> files = {
        short_textgrid("1\n" + kWordTier),
        "WEBVTT\n\n00:00.500 --> 00:00.900\n<c>hello</c> <00:00:00.700>you &amp; me\n",
        "word,start,end\nhello,0.5,0.9\nworld,1,1.5\n",
        R"({"words": [{"word": "hello", "start": 0.5, "end": 0.9}]})",
        "0 5000000 x^x-pau+hh=iy@x_x/A:0\n5000000 9000000 hh\n"};
    Random random(12);
    for (int round = 0; round < 1500; ++round) {
        std::string bytes = files[random.below(static_cast<std::uint32_t>(files.size()))];
        for (std::uint32_t i = random.below(4) + 1; i > 0; --i)
            bytes[random.below(static_cast<std::uint32_t>(bytes.size()))] =
                "\"<>-:,0.9 \nx\xc3"[random.below(13)];
        if (random.below(3) == 0) bytes.resize(random.below(static_cast<std::uint32_t>(bytes.size())));
        try {
            double end = 0;
            for (const SpokenWord& word : read(bytes).words) {
                EXPECT_GE(word.start, end);
                EXPECT_GT(word.end, word.start);
                end = word.end;
            }
            EXPECT_LE(end, kDuration);
        } catch (const Error& refusal) {
            EXPECT_THAT(refusal.what(), HasSubstr("words:"));
        }
    }
}

// What an aligner knows of a recording.
struct Aligned {
    std::string file;
    double seconds = 0;
    size_t words = 0;
    size_t word = 0;  // one of them, and how it sounds
    std::string text, sounds;
};

TEST(TimedWords, ReadTheTextGridOfAnAligner) {
    for (const Aligned& aligned :
         testing::present<Aligned>({{"tests/fixtures/speech/two-ways.TextGrid", 8.97220, 24, 10,
                                     "something 3.212-3.752", "s 'ʌ m θ ɪ ŋ"},
                                    {"../shared/data/speech/acoustic_corpus.TextGrid", 26.72325, 58, 3,
                                     "acoustic 1.46-1.89", "ə k 'u s t ɪ k"}})) {
        const TimedWords timed = read_timed_words(test_file(aligned.file), aligned.seconds);
        ASSERT_EQ(timed.words.size(), aligned.words);
        EXPECT_EQ(with_times(timed.words)[aligned.word], aligned.text);
        Speech speech{.words = timed.words, .phonemes = timed.phonemes};
        EXPECT_EQ(testing::phonemes_of(speech, aligned.word), aligned.sounds);
        EXPECT_THAT(timed.notes, IsEmpty());
        for (const SpokenWord& word : timed.words)
            EXPECT_LT(word.first_phoneme, word.end_phoneme) << word.text;
    }
}

// An aligner leaves hesitations out.
TEST(TimedWords, AreThoseOfTheTranscript) {
    const TimedWords timed = read_timed_words(test_file("tests/fixtures/speech/two-ways.TextGrid"), 8.97220);
    const Speech recorded{.words = timed.words, .phonemes = timed.phonemes};
    Speech beginning = recorded;
    beginning.words.resize(7);
    EXPECT_EQ(align(testing::script("There are two ways to do it"), beginning).words.size(), 7u);
    EXPECT_THAT(
        refusal_of([&] { align(testing::script("There are two ways to do it, uh, either"), recorded); }),
        HasSubstr("the text says \"uh\" (word 8) and the recording says \"either\" (word 8)"));
}

TEST(TimedWords, AreNoSilencesAndNoEvents) {
    const testing::TemporaryFolder folder;
    write_text(
        folder / "w.ctm",
        "r 1 0.0 0.1 <eps>\nr 1 0.1 0.2 {SL}\nr 1 0.3 0.2 Well\nr 1 0.5 0.1 !SIL\nr 1 0.6 0.2 <laugh>\n"
        "r 1 0.8 0.1 (laughs)\nr 1 0.9 0.1 [noise]\nr 1 1.0 0.1 xxx\nr 1 1.1 0.2 (thanks\nr 1 1.3 0.2 so)\n");
    const TimedWords timed = read_timed_words(folder / "w.ctm", 2);
    EXPECT_THAT(with_times(timed.words), ElementsAre("Well 0.3-0.5", "thanks 1.1-1.3", "so 1.3-1.5"));
    EXPECT_THAT(timed.notes,
                ElementsAre(HasSubstr(
                    "w.ctm: 4 labels name sounds that are no words, and were left out; the first is "
                    "line 5: \"<laugh>\"")));
}

TEST(TimedWords, ReadTheLabelsOfHts) {
    const TimedWords timed = read_timed_words(test_file("tests/fixtures/speech/two-ways_phone.lab"), 9);
    ASSERT_EQ(timed.phonemes.size(), 93u);
    EXPECT_EQ(with_times(timed.phonemes)[1], "ð 0.3-0.38");
    for (const std::string& file : testing::present({"../shared/data/speech/arctic_a0009_phone.lab"})) {
        const TimedWords arctic = read_timed_words(test_file(file), 4);
        ASSERT_EQ(arctic.phonemes.size(), 40u);
        EXPECT_EQ(with_times(arctic.phonemes)[1], "h 0.13-0.205");
    }
}

}  // namespace
}  // namespace chironomia
