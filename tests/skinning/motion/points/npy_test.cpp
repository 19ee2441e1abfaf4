#include "skinning/motion/points/npy.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cstring>

#include "core/files/files.h"
#include "tests/support/support.h"

namespace chironomia {
namespace {

using ::testing::ElementsAre;
using ::testing::HasSubstr;
using testing::refusal_of;

std::vector<std::byte> fixture(const std::string& name) {
    return read_bytes(testing::source_dir() / "tests/fixtures/motion" / name);
}

std::vector<std::byte> bytes_of(std::string_view text) {
    std::vector<std::byte> bytes(text.size());
    std::memcpy(bytes.data(), text.data(), text.size());
    return bytes;
}

// Version 1 with any header and data.
std::vector<std::byte> npy(const std::string& header, const std::string& data) {
    return bytes_of(std::string("\x93NUMPY\x01\x00", 8) + static_cast<char>(header.size()) + '\0' + header +
                    data);
}

const NumpyArray& named(const std::vector<NumpyArray>& arrays, const std::string& name) {
    for (const NumpyArray& array : arrays) {
        if (array.name == name) return array;
    }
    throw std::out_of_range(name);
}

TEST(ParseNpy, ReadsFortranOrderAndHalfFloats) {
    const NumpyArray array = parse_npy(fixture("fortran.npy"), "a.npy");
    EXPECT_EQ(array.type, "<f2");
    EXPECT_THAT(array.shape, ElementsAre(2, 17, 3));
    // Frame 1, point 13 (the left wrist): (170, -20, 850 + 100); all of it fits into a half.
    EXPECT_EQ(array.numbers[(17 + 13) * 3 + 0], 170);
    EXPECT_EQ(array.numbers[(17 + 13) * 3 + 1], -20);
    EXPECT_EQ(array.numbers[(17 + 13) * 3 + 2], 950);
    EXPECT_EQ(array.numbers[13 * 3 + 2], 850);
}

TEST(ParseNpy, ReadsBigEndianIntegers) {
    EXPECT_THAT(parse_npy(fixture("integers.npy"), "a.npy").numbers, ElementsAre(-3, -2, -1, 0, 1, 2));
}

TEST(ParseNpy, ReadsSpecialHalves) {
    // 1, -2, the smallest above 0 (2^-24), the largest (65504), infinity.
    const auto bytes = npy("{'descr': '<f2', 'fortran_order': False, 'shape': (5,), }",
                           std::string("\x00\x3c\x00\xc0\x01\x00\xff\x7b\x00\x7c", 10));
    EXPECT_THAT(parse_npy(bytes, "a.npy").numbers, ElementsAre(1, -2, 1.0 / (1 << 24), 65504, INFINITY));
}

TEST(ParseNpy, LeavesObjectsAlone) {
    const NumpyArray array = parse_npy(fixture("objects.npy"), "a.npy");
    EXPECT_EQ(array.type, "|O");
    EXPECT_TRUE(array.numbers.empty());
    EXPECT_TRUE(array.texts.empty());
}

TEST(ParseNpz, ReadsStoredAndDeflatedArrays) {
    const auto stored = parse_npz(fixture("stored.npz"), "a.npz");
    const auto deflated = parse_npz(fixture("deflated.npz"), "a.npz");
    EXPECT_EQ(named(stored, "keypoints").numbers, named(deflated, "keypoints").numbers);
    EXPECT_EQ(named(stored, "keypoints").numbers.size(), 2u * 17 * 3);
    EXPECT_THAT(named(stored, "fps").numbers, ElementsAre(50));
    EXPECT_THAT(named(stored, "fps").shape, ElementsAre());
    EXPECT_EQ(named(deflated, "names").texts[9], "Neck/Nose");
    EXPECT_EQ(named(parse_npz(fixture("flat.npz"), "a.npz"), "names").texts[16], "RWrist");
    EXPECT_EQ(describe(named(stored, "keypoints")), "keypoints (2, 17, 3)");
}

TEST(ParseNpy, RefusesBrokenArrays) {
    EXPECT_THAT(refusal_of([] { parse_npy(bytes_of("\x93NUMPY"), "a.npy"); }),
                HasSubstr("a.npy: this is no whole .npy"));
    EXPECT_THAT(refusal_of([] { parse_npy(npy("{'shape': (1,), }", ""), "a.npy"); }),
                HasSubstr("a.npy: the .npy header is broken"));
    EXPECT_THAT(refusal_of([] {
                    parse_npy(npy("{'descr': '<f4', 'fortran_order': False, 'shape': (-1,), }", ""), "a.npy");
                }),
                HasSubstr("header is broken"));
    std::vector<std::byte> cut = fixture("integers.npy");
    cut.resize(cut.size() - 2);
    EXPECT_THAT(
        refusal_of([&] { parse_npy(cut, "a.npy"); }),
        HasSubstr("the array of shape (1, 2, 3) needs more elements of type >i2 than the 5 in the file"));
    cut.resize(60);
    EXPECT_THAT(refusal_of([&] { parse_npy(cut, "a.npy"); }), HasSubstr("bytes) does not fit into 60 bytes"));
    const auto huge =
        npy("{'descr': '<f4', 'fortran_order': False, 'shape': (9999999999, 9999999999), }", "1234");
    EXPECT_THAT(refusal_of([&] { parse_npy(huge, "a.npy"); }), HasSubstr("than the 1 in the file"));
}

TEST(ParseNpz, RefusesBrokenArchives) {
    std::vector<std::byte> cut = fixture("deflated.npz");
    cut.resize(cut.size() / 2);
    EXPECT_THAT(refusal_of([&] { parse_npz(cut, "a.npz"); }),
                HasSubstr("a.npz: this is no whole zip archive"));
    std::vector<std::byte> wrong = fixture("deflated.npz");
    for (size_t i = 60; i < 90; ++i) wrong[i] = std::byte{0x55};
    EXPECT_THAT(refusal_of([&] { parse_npz(wrong, "a.npz"); }),
                HasSubstr("keypoints.npy: cannot be unpacked"));
}

// Ten million zeros of one byte each, in 10 kB.
TEST(ParseNpz, RefusesWhatAFewBytesUnpackTo) {
    EXPECT_THAT(refusal_of([] { parse_npz(fixture("zeros.npz"), "a.npz"); }),
                HasSubstr("a.npz: poses.npy: the array of shape (10000000) has more than the 90"));
}

}  // namespace
}  // namespace chironomia
