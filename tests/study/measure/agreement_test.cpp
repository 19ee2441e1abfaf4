#include "study/measure/agreement.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <map>

#include "core/random.h"
#include "tests/study/measure/oracle.h"

namespace chironomia::study {
namespace {

using testing::kOraclePrecision;

std::vector<Rating> ratings_of(const std::vector<std::vector<double>>& units) {
    std::vector<Rating> ratings;
    for (std::size_t unit = 0; unit < units.size(); ++unit) {
        for (std::size_t rater = 0; rater < units[unit].size(); ++rater)
            ratings.push_back({unit, rater, units[unit][rater]});
    }
    return ratings;
}

// Krippendorff 2011, section D: four observers, twelve units, values missing.
const std::vector<std::vector<double>> kKrippendorff = {
    {1, 1, 1},    {2, 2, 3, 2}, {3, 3, 3, 3}, {3, 3, 3, 3}, {2, 2, 2, 2}, {1, 2, 3, 4},
    {4, 4, 4, 4}, {1, 1, 2, 1}, {2, 2, 2, 2}, {5, 5, 5},    {1, 1},       {3}};

TEST(KrippendorffAlpha, KnowsKrippendorffsExample) {
    const std::vector<Rating> ratings = ratings_of(kKrippendorff);
    const auto nominal = krippendorff_alpha(ratings, ValueScale::nominal, 1);
    EXPECT_EQ(nominal->units, 11u);
    EXPECT_EQ(nominal->ratings, 40u);
    EXPECT_NEAR(nominal->alpha, 0.743, 5e-4);
    EXPECT_NEAR(krippendorff_alpha(ratings, ValueScale::ordinal, 1)->alpha, 0.815, 5e-4);
    EXPECT_NEAR(krippendorff_alpha(ratings, ValueScale::interval, 1)->alpha, 0.849, 5e-4);
}

TEST(KrippendorffAlpha, AgreesWithACountOfAllPairs) {
    const std::map<std::string, ValueScale> scales = {{"nominal", ValueScale::nominal},
                                                      {"ordinal", ValueScale::ordinal},
                                                      {"interval", ValueScale::interval}};
    for (const Json& each : testing::oracle("alpha")) {
        const auto ratings = ratings_of(each["units"].get<std::vector<std::vector<double>>>());
        for (const auto& [name, scale] : scales) {
            EXPECT_NEAR(krippendorff_alpha(ratings, scale, 1)->alpha, each[name].get<double>(),
                        kOraclePrecision);
        }
    }
}

TEST(KrippendorffAlpha, ItsIntervalHoldsItAndTheSameSeedGivesTheSame) {
    const std::vector<Rating> ratings = ratings_of(kKrippendorff);
    const auto a = krippendorff_alpha(ratings, ValueScale::nominal, 1),
               b = krippendorff_alpha(ratings, ValueScale::nominal, 1);
    EXPECT_LT(a->alpha_95->low, a->alpha - 0.1);
    EXPECT_GT(a->alpha_95->high, a->alpha + 0.1);
    EXPECT_LE(a->alpha_95->high, 1);
    EXPECT_EQ(a->alpha_95->low, b->alpha_95->low);
}

TEST(KrippendorffAlpha, IsOneWhereAllAgreeAndNothingWhereNothingVaries) {
    EXPECT_DOUBLE_EQ(krippendorff_alpha(ratings_of({{1, 1}, {4, 4, 4}}), ValueScale::ordinal, 1)->alpha, 1);
    EXPECT_FALSE(krippendorff_alpha(ratings_of({{2, 2}, {2, 2}}), ValueScale::nominal, 1));
    EXPECT_FALSE(krippendorff_alpha(ratings_of({{1}, {2}}), ValueScale::nominal, 1));
    EXPECT_FALSE(krippendorff_alpha(ratings_of({{1, 2}}), ValueScale::nominal, 1)->alpha_95);
}

TEST(KrippendorffAlpha, HasNoIntervalOfTwoRaters) {
    EXPECT_FALSE(krippendorff_alpha(ratings_of({{1, 2}, {2, 2}, {3, 1}}), ValueScale::ordinal, 1)->alpha_95);
    EXPECT_TRUE(
        krippendorff_alpha(ratings_of({{1, 2, 1}, {2, 2, 3}, {3, 1, 3}}), ValueScale::ordinal, 1)->alpha_95);
}

// Raters who answer each page by chance, each around a middle of their own, agree on nothing: in all but
// about one study of twenty the interval holds 0.
TEST(KrippendorffAlpha, ItsIntervalHoldsNothingWhereRatersAgreeByChanceAlone) {
    constexpr std::size_t kStudies = 100, kUnits = 8, kRaters = 20;
    Random random(1);
    std::size_t missed = 0;
    for (std::size_t study = 0; study < kStudies; ++study) {
        std::vector<double> middles;
        for (std::size_t rater = 0; rater < kRaters; ++rater) middles.push_back(3 + random.normal());
        std::vector<std::vector<double>> units(kUnits);
        for (std::vector<double>& unit : units) {
            for (const double middle : middles)
                unit.push_back(std::clamp(std::round(middle + 1.5 * random.normal()), 1.0, 5.0));
        }
        const auto alpha = krippendorff_alpha(ratings_of(units), ValueScale::interval, study);
        missed += alpha->alpha_95->low > 0 || alpha->alpha_95->high < 0;
    }
    RecordProperty("missed", static_cast<int>(missed));
    EXPECT_LE(missed, 9u);
}

// Shrout and Fleiss, table 4: .29, .62 (the mean of four judges) and .71.
TEST(IntraclassCorrelations, KnowShroutAndFleissJudges) {
    const auto table = testing::oracle("intraclass")[0]["ratings"].get<std::vector<std::vector<double>>>();
    const auto icc = intraclass_correlations(table);
    EXPECT_EQ(icc->targets, 6u);
    EXPECT_EQ(icc->raters, 4u);
    EXPECT_NEAR(icc->one_rater.value, 0.29, 5e-3);
    EXPECT_NEAR(icc->mean_rating.value, 0.62, 5e-3);
    EXPECT_NEAR(icc->fixed_rater.value, 0.71, 6e-3);
}

void expect_correlation(const Correlation& correlation, const Json& expected) {
    EXPECT_NEAR(correlation.value, expected[0].get<double>(), kOraclePrecision);
    EXPECT_NEAR(correlation.value_95->low, expected[1].get<double>(), kOraclePrecision);
    EXPECT_NEAR(correlation.value_95->high, expected[2].get<double>(), kOraclePrecision);
}

TEST(IntraclassCorrelations, AgreeWithPsychOfR) {
    for (const Json& each : testing::oracle("intraclass")) {
        const auto icc = intraclass_correlations(each["ratings"].get<std::vector<std::vector<double>>>());
        expect_correlation(icc->one_rater, each["one_rater"]);
        expect_correlation(icc->mean_rating, each["mean_rating"]);
        expect_correlation(icc->fixed_rater, each["fixed_rater"]);
    }
}

TEST(IntraclassCorrelations, FixedRatersMayDifferByAShift) {
    const auto icc = intraclass_correlations({{1, 3}, {2, 4}, {5, 7}});
    EXPECT_DOUBLE_EQ(icc->fixed_rater.value, 1);
    EXPECT_LT(icc->one_rater.value, 1);
    EXPECT_FALSE(icc->one_rater.value_95);
    EXPECT_FALSE(intraclass_correlations({{2, 2}, {2, 2}}));
    EXPECT_FALSE(intraclass_correlations({{2, 3}}));
}

// Every target has the mean 0, so that the interval of ICC(2,1) has no degrees of freedom.
TEST(IntraclassCorrelations, HaveNoIntervalWhereAllTargetsHaveOneMean) {
    const auto icc = intraclass_correlations({{1, -1}, {2, -2}, {-1, 1}, {2, -2}});
    EXPECT_FALSE(icc->one_rater.value_95);
    EXPECT_FALSE(icc->mean_rating.value_95);
    EXPECT_TRUE(icc->fixed_rater.value_95);
}

// By hand: the variances of the items are 1, 1 and 4, that of their sums 4, 8 and 9 is 7.
TEST(CronbachAlpha, IsOfVariancesOfItemsAndOfTheirSum) {
    EXPECT_NEAR(*cronbach_alpha(std::vector<std::vector<double>>{{1, 2, 1}, {2, 3, 3}, {3, 1, 5}}), 3.0 / 14,
                1e-12);
    EXPECT_NEAR(*cronbach_alpha(std::vector<std::vector<double>>{{1, 1}, {3, 3}, {4, 4}}), 1, 1e-12);
}

TEST(CronbachAlpha, AgreesWithTheMatrixOfCovariances) {
    for (const Json& each : testing::oracle("cronbach")) {
        EXPECT_NEAR(*cronbach_alpha(each["answers"].get<std::vector<std::vector<double>>>()),
                    each["alpha"].get<double>(), kOraclePrecision);
    }
}

TEST(CronbachAlpha, NeedsAnswersThatVary) {
    EXPECT_FALSE(cronbach_alpha(std::vector<std::vector<double>>{{1, 2}}));
    EXPECT_FALSE(cronbach_alpha(std::vector<std::vector<double>>{{1, 2}, {1, 2}}));
    EXPECT_FALSE(cronbach_alpha(std::vector<std::vector<double>>{{1, 2}, {2, 1}})) << "sums are the same";
}

}  // namespace
}  // namespace chironomia::study
