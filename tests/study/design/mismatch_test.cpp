#include "study/design/mismatch.h"

#include <gmock/gmock.h>

#include <algorithm>
#include <map>
#include <numeric>
#include <set>

#include "core/random.h"
#include "core/text.h"
#include "tests/support/support.h"

namespace chironomia::study {
namespace {

using ::testing::ElementsAre;
using testing::refusal_of;

std::vector<SpokenClip> clips_of(const std::vector<double>& lengths, const std::string& speaker = "anna") {
    std::vector<SpokenClip> clips;
    for (const double seconds : lengths)
        clips.push_back({.id = format("c{}", clips.size() + 1), .speaker = speaker, .seconds = seconds});
    return clips;
}

bool may_be_paired(const SpokenClip& a, const SpokenClip& b, double tolerance) {
    return a.speaker == b.speaker &&
           std::abs(a.seconds - b.seconds) <= tolerance * std::max(a.seconds, b.seconds) + 1e-9;
}

bool is_mismatch(const std::vector<SpokenClip>& clips, const std::vector<std::size_t>& partners,
                 double tolerance) {
    if (std::set(partners.begin(), partners.end()).size() != clips.size()) return false;
    for (std::size_t i = 0; i < clips.size(); ++i)
        if (partners[i] == i || !may_be_paired(clips[i], clips[partners[i]], tolerance)) return false;
    return true;
}

// By trying them all.
std::set<std::vector<std::size_t>> all_mismatches(const std::vector<SpokenClip>& clips, double tolerance) {
    std::vector<std::size_t> order(clips.size());
    std::iota(order.begin(), order.end(), 0);
    std::set<std::vector<std::size_t>> found;
    do {
        if (is_mismatch(clips, order, tolerance)) found.insert(order);
    } while (std::next_permutation(order.begin(), order.end()));
    return found;
}

TEST(DrawMismatch, SwapsTwo) {
    EXPECT_THAT(draw_mismatch(clips_of({9, 9.5}), {}), ElementsAre(1, 0));
    EXPECT_THAT(draw_mismatch({}, {}), ElementsAre());
}

TEST(DrawMismatch, StaysWithTheSpeaker) {
    std::vector<SpokenClip> clips = clips_of({9, 9, 9, 9});
    clips[1].speaker = clips[3].speaker = "bob";
    EXPECT_THAT(draw_mismatch(clips, {}), ElementsAre(2, 3, 0, 1));
}

// Five clips of lengths on a grid, all ways of them: what trying all permutations finds is found, and nothing
// else.
TEST(DrawMismatch, FindsOneWheneverThereIsOne) {
    const double lengths[] = {10, 10.8, 11.7, 13};
    int possible = 0, impossible = 0;
    for (int code = 0; code < 4 * 4 * 4 * 4 * 4; ++code) {
        std::vector<double> chosen;
        for (int rest = code, i = 0; i < 5; ++i, rest /= 4) chosen.push_back(lengths[rest % 4]);
        std::vector<SpokenClip> clips = clips_of(chosen);
        if (code % 3 == 0) clips[4].speaker = clips[0].speaker = "bob";
        const auto all = all_mismatches(clips, 0.1);
        if (all.empty()) {
            ++impossible;
            EXPECT_NE(refusal_of([&] { draw_mismatch(clips, {.seed = 3}); }), "");
        } else {
            ++possible;
            EXPECT_TRUE(all.contains(draw_mismatch(clips, {.seed = static_cast<std::uint64_t>(code)})));
        }
    }
    EXPECT_GT(possible, 100);
    EXPECT_GT(impossible, 100);
}

// There are 9 permutations of 4 without fixed points.
TEST(DrawMismatch, DrawsEachThatThereIsSoonerOrLater) {
    const std::vector<SpokenClip> clips = clips_of({9, 9, 9, 9});
    std::map<std::vector<std::size_t>, int> drawn;
    for (std::uint64_t seed = 0; seed < 900; ++seed) ++drawn[draw_mismatch(clips, {.seed = seed})];
    EXPECT_EQ(drawn.size(), 9u);
    for (const auto& [partners, times] : drawn) EXPECT_GT(times, 30);
}

TEST(DrawMismatch, IsTheSameForTheSameSeed) {
    std::vector<double> lengths;
    Random random(5);
    for (int i = 0; i < 108; ++i) lengths.push_back(7.73 + 4.27 * random.uniform());
    const std::vector<SpokenClip> clips = clips_of(lengths);
    const auto drawn = draw_mismatch(clips, {.seed = 11});
    EXPECT_TRUE(is_mismatch(clips, drawn, 0.1));
    EXPECT_EQ(drawn, draw_mismatch(clips, {.seed = 11}));
    EXPECT_NE(drawn, draw_mismatch(clips, {.seed = 12}));
}

TEST(DrawMismatch, CountsTheEndOfTheToleranceIn) {
    EXPECT_THAT(draw_mismatch(clips_of({9, 10}), {.tolerance = 0.1}), ElementsAre(1, 0));
    EXPECT_NE(refusal_of([] { draw_mismatch(clips_of({8.99, 10}), {.tolerance = 0.1}); }), "");
}

TEST(DrawMismatch, NamesAClipThatHasNobody) {
    EXPECT_EQ(refusal_of([] {
                  draw_mismatch(clips_of({9, 9.2, 14}), {});
              }),
              "mismatch: speaker \"anna\" has too few other clips whose lengths are within 10 % of \"c3\" "
              "(14.00 s); allow a tolerance of 35.8 %, or add clips of about this length");
    std::vector<SpokenClip> clips = clips_of({9, 9.2, 9.1});
    clips[1].speaker = "bob";
    EXPECT_EQ(
        refusal_of([&] { draw_mismatch(clips, {}); }),
        "mismatch: speaker \"bob\" has too few other clips whose lengths are within 10 % of \"c2\" (9.20 s); "
        "add clips of this speaker, since no tolerance helps");
}

// Both could be paired with the second alone.
TEST(DrawMismatch, NamesClipsThatCompete) {
    EXPECT_EQ(refusal_of([] {
                  draw_mismatch(clips_of({9, 9.9, 10.9}), {});
              }),
              "mismatch: speaker \"anna\" has too few other clips whose lengths are within 10 % of \"c1\" "
              "(9.00 s), \"c3\" (10.90 s); allow a tolerance of 17.5 %, or add clips of about this length");
}

}  // namespace
}  // namespace chironomia::study
