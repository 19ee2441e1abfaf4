// The seeds and the kept findings of all fuzzers, through the function that libFuzzer calls: the fuzzers work, and what
// they found stays mended.
#include "tests/fuzz/fuzz_reader.h"

#include <gtest/gtest.h>
#include <sys/resource.h>

#include <algorithm>
#include <cstdio>
#include <memory>

#include "core/files/files.h"
#include "core/text.h"
#include "tests/support/support.h"

namespace chironomia {
namespace {

namespace fs = std::filesystem;
using testing::source_dir;

std::vector<fs::path> files_in(const fs::path& folder) {
    std::vector<fs::path> files;
    if (fs::exists(folder))
        for (const auto& entry : fs::directory_iterator(folder)) files.push_back(entry.path());
    std::sort(files.begin(), files.end());
    return files;
}

// Those of seeds.txt, each line of which has a reader and a file, and those of the reader's own folder.
std::vector<fs::path> seeds_of(const std::string& reader) {
    std::vector<fs::path> files = files_in(source_dir() / "tests/fuzz/seeds" / reader);
    const std::string list = read_text(source_dir() / "tests/fuzz/seeds.txt");
    for (const std::string_view line : split(list, '\n')) {
        if (line.starts_with(reader + " ")) files.push_back(source_dir() / line.substr(reader.size() + 1));
    }
    return files;
}

std::vector<std::uint8_t> bytes_of(const fs::path& file) {
    const std::vector<std::byte> bytes = read_bytes(file);
    std::vector<std::uint8_t> result(bytes.size());
    std::transform(bytes.begin(), bytes.end(), result.begin(),
                   [](std::byte b) { return std::to_integer<std::uint8_t>(b); });
    return result;
}

class FuzzedReader : public ::testing::TestWithParam<std::string> {
  protected:
    // No finding may need the 2 GB that fuzzers have.
    void TearDown() override {
        rusage usage{};
        getrusage(RUSAGE_SELF, &usage);
        EXPECT_LT(usage.ru_maxrss, 2 << 20) << "kilobytes at the highest";
    }
};

TEST_P(FuzzedReader, AcceptsASeed) {
    bool accepted = false;
    for (const fs::path& seed : seeds_of(GetParam())) {
        SCOPED_TRACE(seed.string());
        EXPECT_NO_THROW(accepted = testing::is_accepted(GetParam(), bytes_of(seed)) || accepted);
    }
    EXPECT_TRUE(accepted) << "a fuzzer begins with a file that its reader reads";
}

TEST_P(FuzzedReader, RefusesNoBytesAtAll) {
    EXPECT_FALSE(testing::is_accepted(GetParam(), {}));
}

TEST_P(FuzzedReader, ReadsOrRefusesEachFinding) {
    testing::choose_fuzz_reader(GetParam());
    for (const fs::path& finding : files_in(source_dir() / "tests/fuzz/findings" / GetParam())) {
        SCOPED_TRACE(finding.string());
        const std::vector<std::uint8_t> bytes = bytes_of(finding);
        EXPECT_NO_THROW(LLVMFuzzerTestOneInput(bytes.data(), bytes.size()));
    }
}

// All that are cut off in the middle, and each with one byte changed.
TEST_P(FuzzedReader, ReadsOrRefusesDamagedSeeds) {
    testing::choose_fuzz_reader(GetParam());
    for (const fs::path& seed : seeds_of(GetParam())) {
        SCOPED_TRACE(seed.string());
        std::vector<std::uint8_t> bytes = bytes_of(seed);
        bytes[bytes.size() / 3] ^= 0x5a;
        EXPECT_NO_THROW(LLVMFuzzerTestOneInput(bytes.data(), bytes.size()));
        EXPECT_NO_THROW(LLVMFuzzerTestOneInput(bytes.data(), bytes.size() / 2));
    }
}

TEST(FuzzCommand, ListsEveryReader) {
    const std::string command = (source_dir() / "tools/fuzz").string() + " --list";
    const std::unique_ptr<FILE, int (*)(FILE*)> listing(popen(command.c_str(), "r"), pclose);
    ASSERT_TRUE(listing);
    std::string expected;
    for (const std::string& name : testing::fuzz_reader_names()) expected += name + "\n";
    std::string listed(expected.size() + 100, '\0');
    listed.resize(std::fread(listed.data(), 1, listed.size(), listing.get()));
    EXPECT_EQ(listed, expected);
}

INSTANTIATE_TEST_SUITE_P(All, FuzzedReader, ::testing::ValuesIn(testing::fuzz_reader_names()),
                         [](const auto& name) { return name.param; });

}  // namespace
}  // namespace chironomia
