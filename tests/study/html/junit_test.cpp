#include "study/html/junit.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cstdlib>

#include "core/files/files.h"
#include "core/files/xml_text.h"
#include "core/text.h"
#include "tests/support/support.h"

namespace chironomia::study {
namespace {

using ::testing::HasSubstr;
using testing::TemporaryFolder;

CompareCase one(const std::string& name, CaseOutcome outcome, const std::string& message = "") {
    return {.name = name,
            .outcome = outcome,
            .message = message,
            .frame = {},
            .expected = "refs/" + name,
            .actual = "res/" + name,
            .difference = outcome == CaseOutcome::different ? "diff/" + name : "",
            .pictures = {}};
}

CompareSet sample() {
    CompareSet set;
    set.cases = {
        one("same.png", CaseOutcome::same), one("walk/far/1.png", CaseOutcome::different, "3 < 4 & \"5\""),
        one("gone.png", CaseOutcome::missing, "was expected"), one("new.png", CaseOutcome::extra, "was not"),
        one("torn.png", CaseOutcome::unreadable, "cut\nshort")};
    return set;
}

TEST(Junit, HasACaseForEachFrameWithMessageNumbersAndPaths) {
    EXPECT_EQ(make_junit("refs", sample()),
              R"(<?xml version="1.0" encoding="UTF-8"?>
<testsuites name="chironomia compare" tests="5" failures="3" errors="1" time="0">
  <testsuite name="refs" tests="5" failures="3" errors="1" time="0" skipped="0">
    <testcase name="same.png" classname="compare" time="0"/>
    <testcase name="walk/far/1.png" classname="compare.walk.far" time="0">
      <failure message="3 &lt; 4 &amp; &quot;5&quot;" type="different">3 &lt; 4 &amp; &quot;5&quot;
expected:   refs/walk/far/1.png
actual:     res/walk/far/1.png
difference: diff/walk/far/1.png
</failure>
    </testcase>
    <testcase name="gone.png" classname="compare" time="0">
      <failure message="was expected" type="missing">was expected
expected:   refs/gone.png
actual:     res/gone.png
</failure>
    </testcase>
    <testcase name="new.png" classname="compare" time="0">
      <failure message="was not" type="extra">was not
expected:   refs/new.png
actual:     res/new.png
</failure>
    </testcase>
    <testcase name="torn.png" classname="compare" time="0">
      <error message="cut
short" type="unreadable">cut
short
expected:   refs/torn.png
actual:     res/torn.png
</error>
    </testcase>
  </testsuite>
</testsuites>
)");
}

// What libxml2 says of a text as JUnit XML.
int validity_of(const std::string& xml) {
    const TemporaryFolder folder;
    write_text(folder / "r.xml", xml);
    const std::string schema = (testing::source_dir() / "tests/fixtures/junit.xsd").string();
    return std::system(format("xmllint --nonet --noout --schema '{}' '{}' >/dev/null 2>&1", schema,
                              (folder / "r.xml").string())
                           .c_str());
}

TEST(Junit, IsValidWhateverTheNamesAre) {
    EXPECT_EQ(validity_of(make_junit("refs", sample())), 0);
    EXPECT_EQ(validity_of(make_junit("", {})), 0);
    EXPECT_NE(validity_of("<testsuites tests=\"1\"><testcase/></testsuites>"), 0) << "the schema refuses";
    CompareSet set;
    std::string every_byte;
    for (int c = 1; c < 256; ++c) every_byte += static_cast<char>(c);
    for (const std::string& name :
         {every_byte, std::string("]]>"), std::string("\xed\xa0\x80"), std::string("\xef\xbf\xbf"),
          std::string("\xf4\x90\x80\x80"), std::string("\xc0\xaf"), std::string("\xe0\x80\xaf"),
          std::string("\xf0\x9f\x98")})
        set.cases.push_back(one(name, CaseOutcome::different, name));
    EXPECT_EQ(validity_of(make_junit(every_byte, set)), 0);
}

TEST(EscapeXml, KeepsEveryCharacterThatXmlHolds) {
    EXPECT_EQ(escape_xml("a\tb \xc3\xa4 \xe2\x82\xac \xf0\x9f\x98\x80"),
              "a\tb \xc3\xa4 \xe2\x82\xac \xf0\x9f\x98\x80");
    EXPECT_EQ(escape_xml(std::string("\x01|\xff|\xc3", 5)), "\xef\xbf\xbd|\xef\xbf\xbd|\xef\xbf\xbd");
}

}  // namespace
}  // namespace chironomia::study
