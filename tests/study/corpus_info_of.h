// The output of `chironomia corpus info --json`.
#pragma once

#include <gtest/gtest.h>

#include <filesystem>

#include "core/files/json.h"
#include "tests/study/process.h"

namespace chironomia::testing {

inline Json info_of(const std::filesystem::path& corpus) {
    const Outcome described = run_chironomia({"corpus", "info", corpus.string(), "--json"});
    EXPECT_EQ(described.exit_code, 0) << described.err;
    return Json::parse(described.out);
}

}  // namespace chironomia::testing
