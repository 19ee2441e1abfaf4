#include "synth/speech/ssml_alias.h"

#include <gmock/gmock.h>

namespace chironomia {
namespace {

using ::testing::ElementsAre;

TEST(WithAliases, PutsAliasesInPlaceOfElements) {
    const SpokenScript script = with_aliases("é <sub alias='öx'>W</sub>b");
    EXPECT_EQ(script.text, "é öxb");
    EXPECT_THAT(script.origins, ElementsAre(0, 1, 18, 18, 25, 26));
}

TEST(WithAliases, LeavesAllElseAlone) {
    for (const char* ssml :
         {"", "<speak>a <b>c</b></speak>", "<sub>a</sub>", "<sub alias='x>a", "<subs alias='x'>a</subs>",
          "<sub alias=x>a</sub>", "<sub", "<sub alias='x'>", "a < b"}) {
        const SpokenScript script = with_aliases(ssml);
        EXPECT_EQ(script.text, ssml);
        for (std::size_t i = 0; i < script.origins.size(); ++i) EXPECT_EQ(script.origins[i], i) << ssml;
    }
}

TEST(WithAliases, ReadsTagsWithQuotedSigns) {
    EXPECT_EQ(with_aliases("<sub alias=\"a &gt; 'b' > c\"\n>x</sub> d").text, "a &gt; 'b' > c d");
}

}  // namespace
}  // namespace chironomia
