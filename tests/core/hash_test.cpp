#include "core/hash.h"

#include <gtest/gtest.h>

#include "core/files/files.h"
#include "tests/support/support.h"

namespace chironomia {
namespace {

// FIPS 180-4 example.
TEST(Sha256, GivesThePublishedDigest) {
    EXPECT_EQ(sha256(std::string_view("abc")),
              "ba7816bf8f01cfea414140de5dae2223b00361a396177a9cb410ff61f20015ad");
}

// RFC 4231, test case 2.
TEST(KeyedSha256, GivesThePublishedDigest) {
    EXPECT_EQ(keyed_sha256("Jefe", "what do ya want for nothing?"),
              "5bdcc146bf60754e6a042426089575c75a003f089d2739839dec58b964ec3843");
}

TEST(Sha256OfFile, AgreesWithTheDigestOfItsBytes) {
    const testing::TemporaryFolder folder;
    const std::string text(200000, 'x');
    write_text(folder / "x", text);
    EXPECT_EQ(sha256_of_file(folder / "x"), sha256(std::string_view(text)));
}

TEST(Sha256OfFile, RefusesAMissingFile) {
    EXPECT_EQ(testing::refusal_of([] { sha256_of_file("/nowhere/x"); }),
              "/nowhere/x: there is no such file; check the path");
}

}  // namespace
}  // namespace chironomia
