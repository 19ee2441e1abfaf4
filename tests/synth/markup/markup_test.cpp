#include "synth/markup/markup.h"

#include <gmock/gmock.h>

#include "core/files/files.h"
#include "tests/support/support.h"

namespace chironomia {
namespace {

using testing::refusal_of;
using ::testing::StartsWith;

std::string refusal(const std::string& text) {
    return refusal_of([&] { parse_marked_text({.text = text, .name = "talk"}); });
}

TEST(RecogniseMarkup, LooksAtTheFirstElement) {
    EXPECT_EQ(recognise_markup("Hello <there>"), MarkupLanguage::plain);
    EXPECT_EQ(recognise_markup("\xef\xbb\xbf<?xml version=\"1.0\"?>\n<!-- <bml> --><APLM>"),
              MarkupLanguage::aplm);
    EXPECT_EQ(recognise_markup("<!DOCTYPE aplm [<!ELEMENT a (b)>]>\n<aplm>"), MarkupLanguage::aplm);
    EXPECT_EQ(recognise_markup("<bml id=\"b\">"), MarkupLanguage::bml);
    EXPECT_EQ(recognise_markup("<fml-apml>"), MarkupLanguage::bml);
    EXPECT_EQ(recognise_markup("<APML>"), MarkupLanguage::aplm);
    EXPECT_EQ(recognise_markup("<speak>"), MarkupLanguage::ssml);
    EXPECT_EQ(recognise_markup(""), MarkupLanguage::plain);
}

TEST(MarkupLanguage, HasANameForEach) {
    for (const MarkupLanguage language :
         {MarkupLanguage::plain, MarkupLanguage::aplm, MarkupLanguage::bml, MarkupLanguage::ssml})
        EXPECT_EQ(markup_language_named(name_of(language)), language);
    EXPECT_EQ(markup_language_named("html"), std::nullopt);
}

TEST(ParseMarkedText, RefusesTextsThatAreNone) {
    EXPECT_EQ(refusal(""), "talk:1:1: holds no word; write what is to be said");
    EXPECT_EQ(refusal("... !"), "talk:1:1: holds no word; write what is to be said");
    EXPECT_EQ(refusal("a\xffz"), "talk:1:2: byte 0xff is no UTF-8; save the text as UTF-8");
    EXPECT_EQ(refusal(std::string((1 << 20) + 1, 'a')),
              "talk: holds 1048577 bytes, at most 1048576 are read; part it");
    EXPECT_EQ(refusal("<html>a</html>"),
              "talk: <html> begins none of the input languages; they begin with <APLM>, <bml>, <fml-apml> or "
              "<speak>");
}

TEST(ParseMarkedText, LeavesOutTheMarkBeforeUtf8) {
    EXPECT_EQ(parse_marked_text({.text = "\xef\xbb\xbfHello"}).script, "Hello");
}

TEST(ParseMarkedText, RefusesMalformedXmlWithItsPlace) {
    EXPECT_EQ(refusal("<APLM>\n  <rheme>a</theme></APLM>"),
              "talk:2:13: </theme> closes <rheme> of 2:4; close <rheme> before");
    EXPECT_EQ(refusal("<APLM><rheme>a"), "talk:1:8: <rheme> is not closed; write </rheme> where it ends");
    EXPECT_EQ(refusal("<APLM>a</APLM></APLM>"),
              "talk:1:17: a tag closes an element that is not open; remove it, or open the element before");
    EXPECT_EQ(refusal("<APLM>Q & A</APLM>"),
              "talk:1:9: \"&\" begins no entity; write &amp; for the sign itself");
    EXPECT_EQ(
        refusal("<APLM>&eacute;</APLM>"),
        "talk:1:7: &eacute; is no entity of XML (lt, gt, amp, quot, apos, #233); write the character itself");
    EXPECT_THAT(refusal("<APLM>&#0;</APLM>"), StartsWith("talk:1:7: &#0; is no entity "));
    EXPECT_EQ(refusal("<APLM>3 < 4</APLM>"),
              "talk:1:9: \"<\" begins no tag here; write &lt; for the sign itself, or close the tag with >");
    EXPECT_EQ(refusal("<APLM a=1>a</APLM>"),
              "talk:1:9: an attribute is not written as name=\"value\"; write it so");
    EXPECT_EQ(refusal("<APLM>a</APLM"), "talk:1:13: a closing tag does not end with \">\"; write </name>");
    EXPECT_EQ(refusal("<APLM>a<!-- b</APLM>"), "talk:1:8: a comment is not closed; end it with -->");
    EXPECT_EQ(refusal("<APLM><![CDATA[b</APLM>"), "talk:1:7: a CDATA section is not closed; end it with ]]>");
    EXPECT_EQ(refusal("<APLM>a</APLM>b"), "talk:1:15: text lies outside the first element; move it into it");
    EXPECT_EQ(refusal("<APLM>a</APLM><b/>"),
              "talk:1:16: <b> follows the end of <APLM>; a text has one outermost element");
    EXPECT_EQ(refusal("<APLM><rheme spc=\"0\" spc=\"1\">a</rheme></APLM>"),
              "talk:1:8: <rheme> has the attribute spc twice, \"0\" and \"1\"; keep one");
    EXPECT_EQ(refusal_of([] { parse_marked_text({.text = "a"}, MarkupLanguage::aplm); }),
              "text:1:1: text lies outside the first element; move it into it");
    EXPECT_EQ(refusal_of([] { parse_marked_text({.text = "<!-- a -->"}, MarkupLanguage::aplm); }),
              "text:1:1: holds no element; begin with one, such as <APLM>");
}

TEST(ParseMarkedText, RefusesBombs) {
    std::string deep = "<APLM>";
    for (int i = 0; i < 70; ++i) deep += "<rheme>";
    deep += "a";
    for (int i = 0; i < 70; ++i) deep += "</rheme>";
    EXPECT_EQ(refusal(deep + "</APLM>"),
              "talk:1:449: <rheme> lies 65 elements deep, at most 64 are read; nest less");
    std::string wide = "<APLM";
    for (int i = 0; i < 40; ++i) wide += " xml" + std::to_string(i) + "=\"\"";
    EXPECT_EQ(refusal(wide + ">a</APLM>"),
              "talk:1:2: <APLM> has more than 32 attributes; leave out what does not belong to it");
    EXPECT_THAT(refusal("<!DOCTYPE APLM [<!ENTITY a \"b\"><!ENTITY c \"&a;&a;\">]><APLM>&c;</APLM>"),
                StartsWith("talk:1:60: &c; is no entity of X"));
}

TEST(ReadMarkupSource, TakesAFileOrTheTextItself) {
    const testing::TemporaryFolder folder;
    const std::string file = (folder / "talk.aplm").string();
    write_text(file, "<APLM>Hello</APLM>");
    EXPECT_EQ(read_markup_source(file, "--text").text, "<APLM>Hello</APLM>");
    EXPECT_EQ(read_markup_source(file, "--text").name, file);
    EXPECT_EQ(read_markup_source("Hello, you.", "--text").text, "Hello, you.");
    EXPECT_EQ(read_markup_source("Hello, you.", "--text").name, "--text");
    EXPECT_EQ(refusal_of([] { read_markup_source("nowhere/talk.bml", "--text"); }),
              "--text: \"nowhere/talk.bml\" is no file; check the path, or write the text itself");
    for (const char* name : {"talk.docx", "notes/talk.md", "my talk.txt"})
        EXPECT_THAT(refusal_of([&] { read_markup_source(name, "--text"); }),
                    ::testing::HasSubstr("is no file"));
    for (const char* text : {"Look at talk.docx", "3.14", "Hm...", "U.S.A."})
        EXPECT_EQ(read_markup_source(text, "--text").text, text);
}

}  // namespace
}  // namespace chironomia
