#include "core/hdf5/file.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>

#include "core/error.h"
#include "core/files/files.h"
#include "tests/support/support.h"

namespace chironomia {
namespace {

using ::testing::ElementsAre;
using ::testing::HasSubstr;
using testing::refusal_of;

using Bytes = std::vector<std::byte>;

Bytes fixture(const std::string& name) {
    return read_bytes(testing::source_dir() / "tests/fixtures/motion" / name);
}

std::span<const std::byte> bytes_of(std::string_view text) {
    return {reinterpret_cast<const std::byte*>(text.data()), text.size()};
}

// The examples that stand in Bob Jenkins' own driver of lookup3.
TEST(Hdf5Checksum, IsLookup3) {
    EXPECT_EQ(hdf5_checksum({}), 0xdeadbeefu);
    EXPECT_EQ(hdf5_checksum(bytes_of("Four score and seven years ago")), 0x17770551u);
}

TEST(Hdf5File, FindsGroupsArraysAndAttributes) {
    const Bytes bytes = fixture("pats_models.h5");
    const Hdf5File file(bytes, "a.h5");
    EXPECT_THAT(file.names_in(""), ElementsAre("audio", "face", "meta", "pose"));
    EXPECT_TRUE(file.names_in("voice").empty());
    EXPECT_TRUE(file.has("pose/data"));
    EXPECT_FALSE(file.has("pose/date"));
    EXPECT_FALSE(file.has("voice/data"));
    EXPECT_THAT(file.shape_of("pose/data"), ElementsAre(3, 22));
    EXPECT_EQ(file.read("face/data").numbers[31], 31);  // of 16 bits, the high byte first
    EXPECT_EQ(file.attribute("meta", "fps"), 20);
    EXPECT_FALSE(file.attribute("meta", "size"));
}

TEST(Hdf5File, ReadsTextsOfBothKinds) {
    for (const char* name : {"h5py.h5", "variable_texts.h5"}) {
        const Bytes bytes = fixture(name);
        const Hdf5Array names = Hdf5File(bytes, name).read("keypoints3d/names");
        EXPECT_TRUE(names.is_text);
        EXPECT_THAT(names.texts, ElementsAre("nose", "left_wrist")) << name;
    }
}

TEST(Hdf5File, SaysWhatItDoesNotRead) {
    const auto refusal = [](const char* name, const char* path) {
        const Bytes bytes = fixture(name);
        return refusal_of([&] { Hdf5File(bytes, "a.h5").read(path); });
    };
    EXPECT_EQ(refusal("pats.h5", "pose/date"), "a.h5: /pose/date is missing");
    EXPECT_EQ(refusal("pats.h5", "pose"), "a.h5: /pose is no array");
    EXPECT_EQ(refusal("pats_lzf.h5", "pose/data"),
              "a.h5: /pose/data is packed by the filter 32000 \"lzf\", which is not read; gzip is");
    EXPECT_EQ(refusal("pats_chunked_latest.h5", "pose/data"),
              "a.h5: /pose/data is kept in chunks in the layout of HDF5 1.10, which is not read; write it "
              "with h5py.File(..., libver=\"v108\") or without libver");
    EXPECT_EQ(refusal("odd.h5", "never_written"),
              "a.h5: /never_written was made, but nothing was ever written into it");
    EXPECT_EQ(refusal("odd.h5", "half_written"),
              "a.h5: /half_written has 1 of its 2 chunks; write all of it");
    EXPECT_EQ(refusal("odd.h5", "huge"), "a.h5: /huge is larger than 1 GiB");
    EXPECT_EQ(refusal("odd.h5", "named_type"),
              "a.h5: /named_type shares its type with another array, which is not read; write it with a type "
              "of its own");
    const Bytes many = fixture("odd_latest.h5");
    EXPECT_THAT(refusal_of([&] { Hdf5File(many, "a.h5").read("many/a3"); }),
                HasSubstr("a.h5: a group of more than 8 entries is kept in a form of the newer layouts"));
}

TEST(Hdf5File, RefusesATruncatedFile) {
    Bytes bytes = fixture("pats.h5");
    bytes.resize(bytes.size() - 1);
    EXPECT_EQ(refusal_of([&] { Hdf5File(bytes, "a.h5"); }),
              "a.h5: the HDF5 file is broken or truncated: it has 9495 bytes of 9496; write it or get it "
              "again");
}

// The chunks of this file are guarded by Fletcher's sum, which the HDF5 library took.
TEST(Hdf5File, NoticesOneChangedBitOfAChunk) {
    const Bytes whole = fixture("pats_packed.h5");
    EXPECT_EQ(Hdf5File(whole, "a.h5").read("pose/data").numbers.size(), 312u);
    int noticed = 0;
    for (size_t i = 0; i < whole.size(); i += 3) {
        Bytes bytes = whole;
        bytes[i] ^= std::byte{4};
        try {
            Hdf5File(bytes, "a.h5").read("pose/data");
        } catch (const Error& error) {
            const std::string message = error.what();
            noticed +=
                message.find("the checksum of a chunk of /pose/data does not fit") != std::string::npos;
        }
    }
    EXPECT_GT(noticed, 100);
}

// The size of an element, by which the bytes of a chunk are shuffled, stands behind the name of the filter.
TEST(Hdf5File, RefusesShuffledElementsLargerThanTheirChunk) {
    Bytes bytes = fixture("pats_packed.h5");
    constexpr std::string_view kName("shuffle\0\x08\0\0\0", 12);
    const auto same = [](std::byte byte, char c) { return static_cast<char>(byte) == c; };
    const auto at = std::search(bytes.begin(), bytes.end(), kName.begin(), kName.end(), same);
    ASSERT_NE(at, bytes.end());
    std::fill(at + 8, at + 12, std::byte{0xff});
    EXPECT_EQ(
        refusal_of([&] { Hdf5File(bytes, "a.h5").read("pose/data"); }),
        "a.h5: the HDF5 file is broken or truncated: a chunk of /pose/data cannot be unpacked; write it "
        "or get it again");
}

// Reads all that a motion would ask for; damage is refused or not noticed.
void read_all(const Bytes& bytes) {
    try {
        const Hdf5File file(bytes, "a.h5");
        for (const std::string& group : file.names_in("")) {
            for (const std::string& name : file.names_in(group)) file.read(group + "/" + name);
            file.attribute(group, "fps");
        }
    } catch (const Error& error) {
        ASSERT_THAT(error.what(), HasSubstr("a.h5: "));
    }
}

// Every thirteenth byte, so that all of a header's fields come up in one of its copies.
TEST(Hdf5File, SurvivesTruncationsAndFlippedBytes) {
    for (const char* name : {"pats_models.h5", "pats_packed.h5", "variable_texts.h5", "pats_latest.h5"}) {
        const Bytes whole = fixture(name);
        for (size_t size = 0; size < whole.size(); size += 13) {
            Bytes bytes = whole;
            bytes[size] ^= std::byte{0xff};
            read_all(bytes);
            bytes[size] = std::byte{0};
            read_all(bytes);
            read_all({whole.begin(), whole.begin() + std::ptrdiff_t(size)});
        }
    }
}

}  // namespace
}  // namespace chironomia
