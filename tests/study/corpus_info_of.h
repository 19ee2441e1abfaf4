// What `chironomia corpus info --json` tells.
#pragma once

#include <gtest/gtest.h>

#include <filesystem>

#include "core/files/json.h"
#include "tests/study/process.h"

namespace chironomia::testing {

inline Json info_of(const std::filesystem::path& corpus) {
    const Outcome told = run_chironomia({"corpus", "info", corpus.string(), "--json"});
    EXPECT_EQ(told.exit_code, 0) << told.err;
    return Json::parse(told.out);
}

}  // namespace chironomia::testing
