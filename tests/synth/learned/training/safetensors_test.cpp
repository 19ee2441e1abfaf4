#include "synth/learned/training/safetensors.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cstring>

#include "core/error.h"
#include "core/files/files.h"
#include "core/random.h"
#include "core/text.h"
#include "tests/support/support.h"

namespace chironomia {
namespace {

using ::testing::AllOf;
using ::testing::HasSubstr;

// A file with this header and `payload` bytes, all zero.
std::filesystem::path file_of(const testing::TemporaryFolder& folder, const std::string& header,
                              const std::string& payload) {
    const std::uint64_t length = header.size();
    std::string bytes(sizeof length, '\0');
    std::memcpy(bytes.data(), &length, sizeof length);
    write_text(folder / "a.safetensors", bytes + header + payload);
    return folder / "a.safetensors";
}

std::string refusal(const std::string& header, std::size_t payload) {
    const testing::TemporaryFolder folder;
    return testing::refusal_of(
        [&] { read_safetensors(file_of(folder, header, std::string(payload, '\0'))); });
}

TEST(Safetensors, GiveBackWhatWasWritten) {
    const testing::TemporaryFolder folder;
    const Tensors tensors{{"a", torch::arange(6, torch::kFloat32).reshape({2, 3})},
                          {"b/c", torch::full({1}, std::int64_t{1} << 40, torch::kInt64)},
                          {"empty", torch::zeros({0, 4})},
                          {"scalar", torch::full({}, 0.1f)}};
    write_safetensors(folder / "t.safetensors", tensors);
    const Tensors found = read_safetensors(folder / "t.safetensors");
    ASSERT_EQ(found.size(), tensors.size());
    for (const auto& [name, tensor] : tensors) EXPECT_TRUE(torch::equal(found.at(name), tensor)) << name;
}

// Known by hand: 1.5 is 0x3e00 as a half and 0x3fc0 as a bfloat16; -2 is 0xc000 as both.
TEST(Safetensors, ReadsHalvesOfBothKindsAsFloats) {
    const testing::TemporaryFolder folder;
    const auto file = file_of(folder,
                              R"({"h":{"dtype":"F16","shape":[2],"data_offsets":[0,4]},
                                  "b":{"dtype":"BF16","shape":[2],"data_offsets":[4,8]},
                                  "__metadata__":{"format":"pt"}})",
                              std::string("\x00\x3e\x00\xc0\xc0\x3f\x00\xc0", 8));
    const Tensors found = read_safetensors(file);
    ASSERT_EQ(found.size(), 2u);
    for (const auto& [name, tensor] : found)
        EXPECT_TRUE(torch::equal(tensor, torch::tensor({1.5f, -2.0f}))) << name;
}

TEST(Safetensors, RefusesWhatIsNoSuchFile) {
    const testing::TemporaryFolder folder;
    write_text(folder / "short", "abc");
    EXPECT_THAT(testing::refusal_of([&] { read_safetensors(folder / "short"); }),
                HasSubstr("short: has 3 bytes, no safetensors file is as short"));
    write_text(folder / "text", "Some text that is long enough to be looked at.");
    EXPECT_THAT(testing::refusal_of([&] { read_safetensors(folder / "text"); }),
                AllOf(HasSubstr("its header should have"), HasSubstr("the file has 46")));
    EXPECT_THAT(refusal("[1, 2]", 0), HasSubstr("its header is no JSON object"));
}

TEST(Safetensors, RefusesTensorsThatAreNotWhatTheyClaim) {
    EXPECT_THAT(refusal(R"({"a":{"shape":[1],"data_offsets":[0,4]}})", 4),
                HasSubstr("tensor \"a\" has no \"dtype\""));
    EXPECT_THAT(refusal(R"({"a":{"dtype":"F64","shape":[1],"data_offsets":[0,8]}})", 8),
                HasSubstr("tensor \"a\" is of type F64, read are F32, F16, BF16 and I64; convert it"));
    EXPECT_THAT(refusal(R"({"a":{"dtype":"F32","shape":3,"data_offsets":[0,4]}})", 4),
                HasSubstr("tensor \"a\" has no shape of at most 8 counts"));
    EXPECT_THAT(refusal(R"({"a":{"dtype":"F32","shape":[1],"data_offsets":[0]}})", 4),
                HasSubstr("tensor \"a\" has no two data_offsets"));
    EXPECT_THAT(refusal(R"({"a":{"dtype":"F32","shape":[-1],"data_offsets":[0,4]}})", 4),
                HasSubstr("tensor \"a\" has the extent -1, a count is needed"));
    EXPECT_THAT(refusal(R"({"a":{"dtype":"F32","shape":[2],"data_offsets":[0,4]}})", 4),
                HasSubstr("shape [2] lies in the bytes 0 to 4, which is not its size"));
    EXPECT_THAT(refusal(R"({"a":{"dtype":"F32","shape":[4611686018427387904,4],"data_offsets":[0,0]}})", 0),
                HasSubstr("which is not its size"));
}

TEST(Safetensors, RefusesOverlapsGapsAndWrongLengths) {
    const auto two = [](int begin, int end) {
        return format(R"({{"a":{{"dtype":"F32","shape":[1],"data_offsets":[0,4]}},)"
                      R"("b":{{"dtype":"F32","shape":[1],"data_offsets":[{},{}]}}}})",
                      begin, end);
    };
    EXPECT_THAT(refusal(two(0, 4), 8),
                HasSubstr("tensor \"b\" begins at byte 0, where the one before it ends at 4"));
    EXPECT_THAT(refusal(two(8, 12), 12), HasSubstr("tensor \"b\" begins at byte 8"));
    EXPECT_THAT(refusal(two(4, 8), 7), HasSubstr("its tensors need 8 bytes, 7 follow its header"));
    EXPECT_THAT(refusal(two(4, 8), 9), HasSubstr("its tensors need 8 bytes, 9 follow its header"));
}

TEST(Safetensors, NameTheTensorThatIsMissingOrOfAnotherShape) {
    const Tensors tensors{{"a", torch::zeros({2, 3})}};
    EXPECT_THAT(testing::refusal_of([&] {
                    find_tensor(tensors, "b", {2, 3}, "f");
                }),
                HasSubstr("f: tensor \"b\" is missing; give a file of the same model"));
    EXPECT_THAT(testing::refusal_of([&] {
                    find_tensor(tensors, "a", {3, 2}, "f");
                }),
                HasSubstr("f: tensor \"a\" has the shape [2, 3], the model needs [3, 2]"));
}

// Nothing but an Error comes of any change of any byte, or of any shorter file.
TEST(Safetensors, SurviveEveryDamage) {
    const testing::TemporaryFolder folder;
    write_safetensors(folder / "t", {{"a", torch::ones({3, 2})}, {"n", torch::ones({2}, torch::kInt64)}});
    const std::string whole = read_text(folder / "t");
    Random random(1);
    std::size_t read = 0, refused = 0;
    const auto attempt = [&](const std::string& bytes) {
        write_text(folder / "m", bytes);
        try {
            read_safetensors(folder / "m");
            ++read;
        } catch (const Error&) {
            ++refused;
        }
    };
    for (std::size_t length = 0; length < whole.size(); ++length) attempt(whole.substr(0, length));
    EXPECT_EQ(read, 0u);
    for (int i = 0; i < 600; ++i) {
        std::string bytes = whole;
        for (std::uint32_t changes = 1 + random.below(3); changes > 0; --changes)
            bytes[random.below(static_cast<std::uint32_t>(bytes.size()))] =
                static_cast<char>(random.below(256));
        attempt(bytes);
    }
    EXPECT_GT(read, 30u);  // numbers may change
    EXPECT_GT(refused, 300u);
}

}  // namespace
}  // namespace chironomia
