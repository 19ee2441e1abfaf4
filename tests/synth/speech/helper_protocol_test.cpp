#include "synth/speech/helper_protocol.h"

#include <gtest/gtest.h>

#include "core/random.h"

namespace chironomia {
namespace {

const SpeakRequest kRequest = {.text = "Hello\nvoice 1 2 3\n",
                               .is_ssml = true,
                               .voice = {"en us\n", "Mr serious", 1, 2, 3},
                               .words = {"Hello", "voice 1", ""}};

const SpeakReply kReply = {
    .outcome = SpeakReply::Outcome::spoken,
    .rate = 22050,
    .alone = {{"h", "oʊ"}, {}},
    .events = {{.kind = SpeakEvent::Kind::word, .sample = 1, .position = 2},
               {.kind = SpeakEvent::Kind::phoneme, .sample = 3, .stress = Stress::primary, .symbol = "oʊ"},
               {.kind = SpeakEvent::Kind::phoneme, .sample = 4}},
    .samples = {0, -32768, 32767, '\n'}};

TEST(HelperProtocol, CarriesARequest) {
    const auto read = read_request(to_bytes(kRequest));
    ASSERT_TRUE(read);
    EXPECT_EQ(read->text, kRequest.text);
    EXPECT_TRUE(read->is_ssml);
    EXPECT_EQ(read->voice.language, "en us\n");
    EXPECT_EQ(read->voice.variant, "Mr serious");
    EXPECT_EQ(read->voice.pitch, 1);
    EXPECT_EQ(read->voice.rate, 2);
    EXPECT_EQ(read->voice.range, 3);
    EXPECT_EQ(read->words, kRequest.words);
}

TEST(HelperProtocol, CarriesWhatWasSpoken) {
    const auto read = read_reply(to_bytes(kReply));
    ASSERT_TRUE(read);
    EXPECT_EQ(read->outcome, SpeakReply::Outcome::spoken);
    EXPECT_EQ(read->rate, 22050);
    EXPECT_EQ(read->samples, kReply.samples);
    EXPECT_EQ(read->alone, kReply.alone);
    ASSERT_EQ(read->events.size(), 3u);
    EXPECT_EQ(read->events[0].kind, SpeakEvent::Kind::word);
    EXPECT_EQ(read->events[0].sample, 1u);
    EXPECT_EQ(read->events[0].position, 2u);
    EXPECT_EQ(read->events[1].symbol, "oʊ");
    EXPECT_EQ(read->events[1].stress, Stress::primary);
    EXPECT_EQ(read->events[2].symbol, "");
}

TEST(HelperProtocol, CarriesTheNamesOfARefusal) {
    const auto read = read_reply(
        to_bytes(SpeakReply{.outcome = SpeakReply::Outcome::no_variant, .names = {"Mr serious", "f1"}}));
    ASSERT_TRUE(read);
    EXPECT_EQ(read->outcome, SpeakReply::Outcome::no_variant);
    EXPECT_EQ(read->names, (std::vector<std::string>{"Mr serious", "f1"}));
}

TEST(HelperProtocol, TakesNoPartForTheWhole) {
    const std::string request = to_bytes(kRequest), reply = to_bytes(kReply);
    for (std::size_t length = 0; length < request.size(); ++length)
        EXPECT_FALSE(read_request(request.substr(0, length))) << length;
    for (std::size_t length = 0; length < reply.size(); ++length)
        EXPECT_FALSE(read_reply(reply.substr(0, length))) << length;
}

TEST(HelperProtocol, TakesNoOtherVersion) {
    for (const char* bytes : {"chironomia_speak 2\nfailed\n", "chironomia_speak 3\nbored\n",
                              "chironomia_speak 3\nspoken -1\nsound 0\n", "chironomia_speak 3\nspoken\n",
                              "chironomia_speak 3\nspoken 8000\nphoneme 1 7 a\nsound 0\n",
                              "chironomia_speak 3\nspoken 8000\nbell 1 7 a\nsound 0\n"})
        EXPECT_FALSE(read_reply(bytes)) << bytes;
}

TEST(HelperProtocol, SurvivesBrokenBytes) {
    Random random(3);
    for (int round = 0; round < 2000; ++round) {
        std::string request = to_bytes(kRequest), reply = to_bytes(kReply);
        request[random.below(static_cast<std::uint32_t>(request.size()))] = static_cast<char>(random.next());
        reply[random.below(static_cast<std::uint32_t>(reply.size()))] = static_cast<char>(random.next());
        if (const auto read = read_request(request)) {
            EXPECT_LT(read->text.size(), 100u);
        }
        if (const auto read = read_reply(reply)) {
            EXPECT_LT(read->samples.size(), 100u);
        }
    }
}

}  // namespace
}  // namespace chironomia
