#include "synth/speakers/speakers.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <set>

#include "core/files/files.h"
#include "core/files/json.h"
#include "core/math.h"
#include "tests/support/support.h"
#include "tests/synth/correlation.h"

namespace chironomia {
namespace {

using testing::correlation;
using testing::refusal_of;
using testing::TemporaryFolder;

constexpr std::size_t kStyles = 12;
using Style = std::array<double, kStyles>;  // in shares of the range of the seen speakers

// Least and most of the 16 seen speakers.
constexpr std::array<std::array<double, 2>, kStyles> kRanges = {{{0.2, 1},
                                                                 {-0.9, 0.9},
                                                                 {-0.9, 0.9},
                                                                 {-0.9, 0.9},
                                                                 {-0.9, 0.9},
                                                                 {-0.9, 0.9},
                                                                 {-1, 1},
                                                                 {-0.1047, 0.1571},
                                                                 {-0.3491, 0.3491},
                                                                 {-0.1, 0.15},
                                                                 {0.4, 1.6},
                                                                 {0.4, 1.6}}};

Style style_of(const std::string& name) {
    const Speaker speaker = speaker_named(name);
    Style style{};
    std::copy(speaker.manner.values.begin(), speaker.manner.values.end(), style.begin());
    const std::array<double, 6> habits = {speaker.handedness, speaker.lean,      speaker.turn,
                                          speaker.height,     speaker.brow_gain, speaker.nod_gain};
    std::copy(habits.begin(), habits.end(), style.begin() + kExpressivities);
    for (std::size_t d = 0; d < kStyles; ++d)
        style[d] = (style[d] - kRanges[d][0]) / (kRanges[d][1] - kRanges[d][0]);
    return style;
}

std::vector<Style> styles_of(SpeakerGroup group) {
    std::vector<Style> styles;
    for (const std::string& name : speaker_names(group)) styles.push_back(style_of(name));
    return styles;
}

std::vector<std::string> known_style_names() {
    const std::vector<std::string> all = speaker_names();
    return {all.begin() + 4, all.end()};
}

double apart(const Style& a, const Style& b, std::size_t dimensions = kStyles) {
    double sum = 0;
    for (std::size_t d = 0; d < dimensions; ++d) sum += (a[d] - b[d]) * (a[d] - b[d]);
    return std::sqrt(sum);
}

Style mean_of(const std::vector<Style>& points) {
    Style mean{};
    for (const Style& point : points)
        for (std::size_t d = 0; d < kStyles; ++d) mean[d] += point[d] / static_cast<double>(points.size());
    return mean;
}

Style between(const Style& from, const Style& to, double share) {
    Style point{};
    for (std::size_t d = 0; d < kStyles; ++d) point[d] = from[d] + share * (to[d] - from[d]);
    return point;
}

// The distance of a point from the convex hull of others, by steps from the farthest corner to the nearest.
double away_from_hull(const std::vector<Style>& corners, const Style& point) {
    std::vector<double> weights(corners.size(), 1.0 / static_cast<double>(corners.size()));
    Style at = mean_of(corners);
    for (int step = 0; step < 20000; ++step) {
        std::size_t to = 0, from = 0;
        std::vector<double> slopes;
        for (const Style& corner : corners) {
            slopes.push_back(0);
            for (std::size_t d = 0; d < kStyles; ++d) slopes.back() += (at[d] - point[d]) * corner[d];
        }
        for (std::size_t i = 0; i < corners.size(); ++i) {
            if (slopes[i] < slopes[to]) to = i;
            if (weights[i] > 0 && (weights[from] <= 0 || slopes[i] > slopes[from])) from = i;
        }
        if (slopes[from] - slopes[to] < 1e-14) break;
        const double length = apart(corners[to], corners[from]);
        const double go = std::min(weights[from], (slopes[from] - slopes[to]) / (length * length));
        weights[to] += go;
        weights[from] -= go;
        for (std::size_t d = 0; d < kStyles; ++d) at[d] += go * (corners[to][d] - corners[from][d]);
    }
    return apart(at, point);
}

TEST(Speakers, HoldTheMannersOfThePaper) {
    using Values = std::array<double, kExpressivities>;
    EXPECT_EQ(speaker_named("neutral").manner, Manner{});
    EXPECT_EQ(speaker_named("abrupt").manner.values, (Values{0.6, 0, 1, -1, 1, -1}));
    EXPECT_EQ(speaker_named("vigorous").manner.values, (Values{0.9, 0.5, 0.5, 0, 0.7, 0.6}));
    EXPECT_EQ(speaker_named("sluggish").manner.values, (Values{0.3, -0.3, -0.8, 0.6, -0.7, -0.6}));
}

// The neutral file says what the program takes for granted, so that it can be read as a template.
TEST(Speakers, AreNeutralWhereAFileIsSilent) {
    const TemporaryFolder folder;
    write_text(folder / "nobody.json", "{}");
    const Speaker silent = read_speaker(folder / "nobody.json");
    const Speaker neutral = speaker_named("neutral");
    EXPECT_EQ(silent.name, "nobody");
    EXPECT_EQ(neutral.name, "neutral");
    for (const Speaker& speaker : {silent, neutral}) {
        EXPECT_EQ(speaker.manner, Manner{});
        EXPECT_EQ(speaker.spatial_above, Speaker{}.spatial_above);
        EXPECT_EQ(speaker.spatial_below, Speaker{}.spatial_below);
        EXPECT_EQ(speaker.handedness, 1);
        EXPECT_EQ(speaker.lean, 0);
        EXPECT_EQ(speaker.turn, 0);
        EXPECT_EQ(speaker.height, 0);
        EXPECT_EQ(speaker.brow_gain, 1);
        EXPECT_EQ(speaker.nod_gain, 1);
        EXPECT_EQ(speaker.voice.language, "en-us");
        EXPECT_EQ(speaker.voice.variant, "");
        EXPECT_EQ(speaker.voice.pitch, 50);
        EXPECT_EQ(speaker.voice.rate, 165);
        EXPECT_EQ(speaker.voice.range, 50);
    }
}

TEST(Speakers, ReadEveryKeyOfAFile) {
    const TemporaryFolder folder;
    const std::string file = (folder / "maria.json").string();
    write_text(file,
               R"({"expressivity": {"spc": -0.5, "oac": 1}, "space": {"above": [1, 2, 0], "below": [0, 1, 2]},
        "habits": {"handedness": -1, "lean_deg": 9, "turn_deg": -18, "height": 0.1, "brow_gain": 0, "nod_gain": 2},
        "voice": {"language": "de_AT", "variant": "f2", "pitch": 1, "rate": 80, "range": 3}})");
    const Speaker speaker = speaker_named(file);
    EXPECT_EQ(speaker.name, "maria");
    EXPECT_EQ(speaker.manner.values, (std::array<double, kExpressivities>{1, -0.5, 0, 0, 0, 0}));
    EXPECT_EQ(speaker.spatial_above, (std::array<double, 3>{1, 2, 0}));
    EXPECT_EQ(speaker.spatial_below, (std::array<double, 3>{0, 1, 2}));
    EXPECT_EQ(speaker.handedness, -1);
    EXPECT_NEAR(speaker.lean, kPi / 20, 1e-6);
    EXPECT_NEAR(speaker.turn, -kPi / 10, 1e-6);
    EXPECT_EQ(speaker.height, 0.1);
    EXPECT_EQ(speaker.brow_gain, 0);
    EXPECT_EQ(speaker.nod_gain, 2);
    EXPECT_EQ(speaker.voice.language, "de-at");
    EXPECT_EQ(speaker.voice.variant, "f2");
    EXPECT_EQ(speaker.voice.pitch, 1);
    EXPECT_EQ(speaker.voice.rate, 80);
    EXPECT_EQ(speaker.voice.range, 3);
}

TEST(Speakers, AreTwentySixWithinTheirLimits) {
    const std::vector<std::string> names = speaker_names();
    EXPECT_EQ(names.size(), 26u);
    EXPECT_EQ(std::set<std::string>(names.begin(), names.end()).size(), 26u);
    for (const std::string& name : names) {
        const Speaker speaker = speaker_named(name);
        EXPECT_EQ(speaker.name, name);
        EXPECT_LE(std::abs(speaker.lean), 0.3);
        EXPECT_LE(std::abs(speaker.turn), 0.44);
    }
}

// One in every sixteenth of every range: no part of any dimension is left out.
TEST(SeenSpeakers, FillEveryRangeEvenly) {
    const std::vector<Style> seen = styles_of(SpeakerGroup::seen);
    ASSERT_EQ(seen.size(), 16u);
    for (std::size_t d = 0; d < kStyles; ++d) {
        std::set<int> filled;
        for (const Style& style : seen) filled.insert(static_cast<int>(std::floor(style[d] * 16)));
        EXPECT_EQ(filled.size(), 16u) << "dimension " << d;
        EXPECT_EQ(*filled.begin(), 0);
        EXPECT_EQ(*filled.rbegin(), 15);
    }
}

TEST(SeenSpeakers, DifferFromEachOtherInMannerAndInAll) {
    const std::vector<Style> seen = styles_of(SpeakerGroup::seen);
    for (std::size_t a = 0; a < seen.size(); ++a) {
        for (std::size_t b = 0; b < a; ++b) {
            EXPECT_GT(apart(seen[a], seen[b], kExpressivities), 0.58) << a << " and " << b;
            EXPECT_GT(apart(seen[a], seen[b]), 0.95) << a << " and " << b;
        }
    }
}

TEST(SeenSpeakers, HaveNoTwoDimensionsOfMannerThatGoTogether) {
    const std::vector<Style> seen = styles_of(SpeakerGroup::seen);
    for (std::size_t d = 0; d < kExpressivities; ++d) {
        for (std::size_t e = 0; e < d; ++e) {
            std::vector<double> a, b;
            for (const Style& style : seen) {
                a.push_back(style[d]);
                b.push_back(style[e]);
            }
            EXPECT_LT(std::abs(correlation(a, b)), 0.31) << d << " and " << e;
        }
    }
}

TEST(UnseenSpeakers, LieInTheHullOfTheSeenOrAFifthBeyondIt) {
    const std::vector<Style> seen = styles_of(SpeakerGroup::seen);
    const Style middle = mean_of(seen);
    EXPECT_EQ(speaker_names(SpeakerGroup::inside).size(), 4u);
    for (const Style& style : styles_of(SpeakerGroup::inside)) {
        EXPECT_LT(away_from_hull(seen, style), 1e-6);
        for (const Style& other : seen) EXPECT_GT(apart(style, other, kExpressivities), 0.5);
    }
    EXPECT_EQ(speaker_names(SpeakerGroup::outside).size(), 2u);
    for (const Style& style : styles_of(SpeakerGroup::outside)) {
        EXPECT_LT(away_from_hull(seen, between(middle, style, 0.99 / 1.2)), 0.003);
        EXPECT_GT(away_from_hull(seen, between(middle, style, 1.03 / 1.2)), 0.01);
        EXPECT_GT(away_from_hull(seen, style), 0.1);
    }
}

TEST(KnownSpeakers, SoundWeaklyAsTheyMove) {
    std::vector<double> activation, power, both, pitch, rate, range;
    for (const std::string& name : known_style_names()) {
        const Speaker speaker = speaker_named(name);
        activation.push_back(speaker.manner[Expressivity::overall_activation]);
        power.push_back(speaker.manner[Expressivity::power]);
        both.push_back(activation.back() / 0.8 + power.back() / 1.8);
        pitch.push_back(speaker.voice.pitch);
        rate.push_back(speaker.voice.rate);
        range.push_back(speaker.voice.range);
    }
    EXPECT_NEAR(correlation(rate, activation), 0.5, 0.05);
    EXPECT_NEAR(correlation(range, power), 0.5, 0.05);
    EXPECT_NEAR(correlation(pitch, both), 0.5, 0.05);
    const auto spans = [](const std::vector<double>& values, double least, double most) {
        EXPECT_EQ(*std::min_element(values.begin(), values.end()), least);
        EXPECT_EQ(*std::max_element(values.begin(), values.end()), most);
    };
    spans(pitch, 25, 75);
    spans(rate, 130, 200);
    spans(range, 20, 80);
}

TEST(KnownSpeakers, HaveVoicesOfTheirOwn) {
    std::map<std::string, int> languages;
    std::set<std::string> variants, whole;
    for (const std::string& name : known_style_names()) {
        const Voice voice = speaker_named(name).voice;
        ++languages[voice.language];
        variants.insert(voice.variant);
        whole.insert(voice.language + "+" + voice.variant + std::to_string(voice.pitch));
    }
    EXPECT_EQ(whole.size(), 22u);
    EXPECT_EQ(variants, (std::set<std::string>{"f1", "f2", "f3", "f4", "f5", "m1", "m2", "m3", "m4", "m5",
                                               "m6", "m7", "m8"}));
    EXPECT_EQ(languages.size(), 3u);
    for (const char* language : {"en-us", "en-gb", "en-gb-scotland"}) EXPECT_GE(languages[language], 6);
}

// The refusal of a file with this text, without the file's name in front.
std::string refusal_of_text(const std::string& text) {
    const TemporaryFolder folder;
    const std::string file = (folder / "someone.json").string();
    write_text(file, text);
    const std::string refusal = refusal_of([&] { read_speaker(file); });
    EXPECT_TRUE(refusal.starts_with(file + ": ")) << refusal;
    return refusal.substr(std::min(refusal.size(), file.size() + 2));
}

TEST(Speakers, RefuseWhatAFileMustNotHold) {
    EXPECT_EQ(refusal_of_text("[1]"), "is [1], an object in curly brackets is needed");
    EXPECT_EQ(refusal_of_text(R"({"habbits": {}})"),
              "habbits: there is no such key; did you mean \"habits\"?");
    EXPECT_EQ(refusal_of_text(R"({"expressivity": {"OAC": 1}})"),
              "expressivity.OAC: there is no such key; did you mean \"oac\"?");
    EXPECT_EQ(refusal_of_text(R"({"expressivity": {"oac": -0.1}})"),
              "expressivity.oac: is -0.1, a number from 0 to 1 is needed");
    EXPECT_EQ(refusal_of_text(R"({"expressivity": {"flt": "smooth"}})"),
              "expressivity.flt: is \"smooth\", a number from -1 to 1 is needed");
    EXPECT_EQ(refusal_of_text(R"({"space": {"above": [1, 1]}})"),
              "space.above: has 2 entries, at least 3 are needed");
    EXPECT_EQ(refusal_of_text(R"({"space": {"below": [1, 1, 1, 1]}})"),
              "space.below: has 4 entries, 3 are needed: across, upward, forward");
    EXPECT_EQ(refusal_of_text(R"({"space": {"below": [1, 3, 1]}})"),
              "space.below[1]: is 3, a number from 0 to 2 is needed");
    EXPECT_EQ(refusal_of_text(R"({"habits": {"lean_deg": 18}})"),
              "habits.lean_deg: is 18, a number from -17 to 17 is needed");
    EXPECT_EQ(refusal_of_text(R"({"habits": {"turn_deg": null}})"),
              "habits.turn_deg: is null, a number from -25 to 25 is needed");
    EXPECT_EQ(refusal_of_text(R"({"voice": {"rate": 500}})"),
              "voice.rate: is 500, a whole number from 80 to 450 is needed");
    EXPECT_EQ(refusal_of_text(R"({"voice": {"language": "en us"}})"),
              "voice.language: is \"en us\", a language of espeak-ng is needed, such as en-us, en-gb or fr");
    EXPECT_EQ(refusal_of_text(R"({"voice": {"variant": "../m1"}})"),
              "voice.variant: is \"../m1\", a variant of espeak-ng is needed, such as m1 to m8 or f1 to f5");
}

TEST(Speakers, RefuseNamesThatNobodyHas) {
    EXPECT_EQ(refusal_of([] { speaker_named("abrubt"); }),
              "speaker \"abrubt\": there is no such speaker; did you mean abrupt? choose one of neutral, "
              "abrupt, vigorous, sluggish, adrian, beth, carl, doris, edgar, fiona, gordon, hilda, ian, "
              "jane, keith, laura, martin, nora, oliver, paula, quentin, rosa, simon, tessa, victor, wendy, "
              "or name a JSON file");
    EXPECT_EQ(refusal_of([] { speaker_named("none.json"); }),
              "none.json: there is no such file; check the path");
}

// The published schema allows what the reader takes, no more and no less.
TEST(SpeakerSchema, SaysWhatTheReaderTakes) {
    const Json properties =
        read_json(testing::source_dir() / "synth/speakers/speaker.schema.json").at("properties");
    for (const auto& [name, section] : properties.items()) {
        if (!section.contains("properties")) continue;
        for (const auto& [key, value] : section.at("properties").items()) {
            if (!value.contains("minimum")) continue;
            for (const char* limit : {"minimum", "maximum"}) {
                const int outward = limit == std::string("minimum") ? -1 : 1;
                Json file;
                file[name][key] = value.at(limit);
                const TemporaryFolder folder;
                write_json(folder / "a.json", file);
                EXPECT_NO_THROW(read_speaker(folder / "a.json")) << file;
                file[name][key] = value.at(limit).get<int>() + outward;
                EXPECT_NE(refusal_of_text(file.dump()), "") << file;
            }
        }
    }
    for (const std::string& name : speaker_names()) {
        const Json file = read_json(testing::source_dir() / "synth/speakers" / (name + ".json"));
        for (const auto& [section, values] : file.items()) {
            ASSERT_TRUE(properties.contains(section)) << section;
            if (!values.is_object()) continue;
            EXPECT_EQ(values.size(), properties.at(section).at("properties").size()) << section;
            for (const auto& [key, value] : values.items())
                EXPECT_TRUE(properties.at(section).at("properties").contains(key)) << key;
        }
    }
}

}  // namespace
}  // namespace chironomia
