#include "synth/speakers/languages.h"

#include <gtest/gtest.h>

namespace chironomia {
namespace {

TEST(LanguageNamed, IsTheOneThatEspeakSpeaks) {
    EXPECT_EQ(language_named("de"), "de");
    EXPECT_EQ(language_named("EN"), "en");
    EXPECT_EQ(language_named("fr_FR"), "fr-fr");
    EXPECT_EQ(language_named("Castilian"), "es");
    EXPECT_EQ(language_named("zh_Hans_CN"), "cmn-latn-pinyin");
    EXPECT_EQ(language_named("cmn-Hans-CN"), "cmn-latn-pinyin");
    EXPECT_EQ(language_named("cmn"), "cmn-latn-pinyin");
    EXPECT_EQ(language_named("zh-HK"), "yue");
    EXPECT_EQ(language_named("zh-yue"), "yue");
    EXPECT_EQ(language_named("xx"), "xx");
    EXPECT_EQ(language_named(""), "");
}

TEST(IsSpeltBy, KnowsWhichLettersAVoiceReads) {
    EXPECT_TRUE(is_spelt_by("en-us", U'ж'));
    EXPECT_TRUE(is_spelt_by("es", U'お'));
    EXPECT_FALSE(is_spelt_by("ru", U'ж'));
    EXPECT_TRUE(is_spelt_by("hr", U'λ'));
    EXPECT_FALSE(is_spelt_by("grc", U'λ'));
}

}  // namespace
}  // namespace chironomia
