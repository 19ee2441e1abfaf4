#include "core/render/rate.h"

#include <gtest/gtest.h>

#include "core/random.h"

namespace chironomia {
namespace {

TEST(ParseRate, TakesWholeNumbersDecimalsAndRatiosExactly) {
    EXPECT_EQ(parse_rate("30"), (Rate{30, 1}));
    EXPECT_EQ(parse_rate(" 25.0 "), (Rate{25, 1}));
    EXPECT_EQ(parse_rate("12.5"), (Rate{25, 2}));
    EXPECT_EQ(parse_rate("9.99"), (Rate{999, 100}));
    EXPECT_EQ(parse_rate("30000/1001"), (Rate{30000, 1001}));
    EXPECT_EQ(parse_rate("50/2"), (Rate{25, 1}));
}

TEST(ParseRate, KnowsTheShortFormsOfTelevisionRates) {
    EXPECT_EQ(parse_rate("29.97"), (Rate{30000, 1001}));
    EXPECT_EQ(parse_rate("23.976"), (Rate{24000, 1001}));
    EXPECT_EQ(parse_rate("23.98"), (Rate{24000, 1001}));
    EXPECT_EQ(parse_rate("59.94"), (Rate{60000, 1001}));
    EXPECT_EQ(parse_rate("119.88"), (Rate{120000, 1001}));
    EXPECT_EQ(parse_rate("14.985"), (Rate{15000, 1001}));
}

TEST(ParseRate, DoesNotMistakeAnotherDecimalForOne) {
    EXPECT_EQ(parse_rate("29.96"), (Rate{749, 25}));
    EXPECT_EQ(parse_rate("29.9"), (Rate{299, 10}));
    EXPECT_EQ(parse_rate("30.00"), (Rate{30, 1}));
}

TEST(ParseRate, RefusesWhatIsNoRate) {
    for (const char* text : {"", "0", "-30", "fast", "30/0", "30/", "/1", "1e3", "nan", "inf", "1001",
                             "30/-1", "0.0000001", "30 fps", "1000000000000000000000", "3..0"}) {
        EXPECT_EQ(parse_rate(text), std::nullopt) << text;
    }
}

TEST(ToText, IsReadBackAsTheSameRate) {
    EXPECT_EQ(to_text({30, 1}), "30");
    EXPECT_EQ(to_text({25, 2}), "12.5");
    EXPECT_EQ(to_text({30000, 1001}), "30000/1001");
    Random random(7);
    for (int i = 0; i < 2000; ++i) {
        const int denominator = static_cast<int>(1 + random.below(2000));
        const int numerator = static_cast<int>(denominator + random.below(200000)) % (1000 * denominator) + 1;
        const std::optional<Rate> rate =
            parse_rate(std::to_string(numerator) + "/" + std::to_string(denominator));
        ASSERT_TRUE(rate);
        EXPECT_EQ(parse_rate(to_text(*rate)), rate) << to_text(*rate);
    }
}

TEST(Rate, SaysHowLongFramesLast) {
    EXPECT_DOUBLE_EQ((Rate{30000, 1001}).seconds(30000), 1001.0);
    EXPECT_DOUBLE_EQ((Rate{25, 2}).per_second(), 12.5);
}

}  // namespace
}  // namespace chironomia
