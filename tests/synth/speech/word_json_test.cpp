#include "synth/speech/word_json.h"

#include <gmock/gmock.h>

#include "core/files/files.h"
#include "core/text.h"
#include "synth/speech/timed_words.h"
#include "tests/support/support.h"

namespace chironomia {
namespace {

using ::testing::ElementsAre;

TimedWords read(const std::string& json) {
    const testing::TemporaryFolder folder;
    write_text(folder / "words.json", json);
    return read_timed_words(folder / "words.json", 10);
}

// "Hello, 1-1.5"
std::vector<std::string> written(const TimedWords& timed) {
    std::vector<std::string> texts;
    for (std::size_t w = 0; w < timed.words.size(); ++w)
        texts.push_back(format("{} {:g}-{:g}", timed.written[w], timed.words[w].start, timed.words[w].end));
    return texts;
}

// As openai-whisper and faster-whisper part them.
TEST(WordsInJson, GoOnWhereNoSpaceBeginsThem) {
    EXPECT_THAT(
        written(read(R"({"segments": [
                    {"start": 1, "end": 2, "words": [{"word": " Aujourd", "start": 1, "end": 1.5},
                        {"word": "'hui", "start": 1.5, "end": 2}, {"word": ",", "start": 2, "end": 2.5}]},
                    {"start": 3, "end": 5, "words": [{"word": "Voyez", "start": 3, "end": 3.5},
                        {"word": " là", "start": 3.5, "end": 4}, {"word": "-bas.", "start": 4, "end": 4.5},
                        {"word": " Oui.", "start": 5, "end": 5.5}, {"word": " Non.", "start": 6, "end": 6.5}]}]})")),
        ElementsAre("Aujourd'hui, 1-2", "Voyez 3-3.5", "là-bas. 3.5-4.5", "Oui. 5-5.5", "Non. 6-6.5"));
}

TEST(WordsInJson, AreWholeWhereMostBeginWithoutASpace) {
    EXPECT_THAT(written(read(R"({"words": [{"word": "Well,", "start": 1, "end": 1.5},
                    {"word": "there", "start": 2, "end": 2.5}, {"word": " you", "start": 3, "end": 3.5}]})")),
                ElementsAre("Well, 1-1.5", "there 2-2.5", "you 3-3.5"));
}

TEST(WordsInJson, AreComposed) {
    EXPECT_EQ(read(R"([{"word": "e\u0301norme", "start": 0, "end": 1}])").words[0].text, "énorme");
}

TEST(WordsInJson, NameTheirLanguageAsVoicesDo) {
    const auto language = [](const std::string& name) {
        return read(R"({"language": ")" + name + R"(", "words": [{"word": "a", "start": 0, "end": 1}]})")
            .language;
    };
    EXPECT_EQ(language("spanish"), "es");
    EXPECT_EQ(language("Arabic"), "ar");
    EXPECT_EQ(language("haitian creole"), "ht");
    EXPECT_EQ(language("chinese"), "cmn-latn-pinyin");
    EXPECT_EQ(language("zh"), "cmn-latn-pinyin");
    EXPECT_EQ(language("zh-CN"), "cmn-latn-pinyin");
    EXPECT_EQ(language("es-ES"), "es-es");
}

}  // namespace
}  // namespace chironomia
