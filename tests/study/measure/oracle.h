// Numbers of independent implementations (tests/fixtures/statistics/make_statistics.py).
#pragma once

#include <gtest/gtest.h>

#include <string>
#include <vector>

#include "core/files/json.h"
#include "study/measure/descriptive.h"
#include "tests/support/support.h"

namespace chironomia::testing {

using namespace study;

inline constexpr double kOraclePrecision = 1e-6;

// The cases of one kind of statistic.
inline Json oracle(const std::string& kind) {
    return read_json(source_dir() / "tests/fixtures/statistics/statistics.json").at(kind);
}

inline std::vector<double> numbers(const Json& list) {
    return list.get<std::vector<double>>();
}

inline void expect_interval(const Interval& interval, const Json& expected) {
    EXPECT_NEAR(interval.low, expected[0].get<double>(), kOraclePrecision);
    EXPECT_NEAR(interval.high, expected[1].get<double>(), kOraclePrecision);
}

}  // namespace chironomia::testing
