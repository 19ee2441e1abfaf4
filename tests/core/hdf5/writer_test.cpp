#include "core/hdf5/writer.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <limits>

#include "core/error.h"
#include "core/files/files.h"
#include "core/hdf5/file.h"
#include "core/text.h"
#include "tests/support/support.h"

namespace chironomia {
namespace {

using ::testing::ElementsAre;
using ::testing::HasSubstr;
using testing::refusal_of;

std::vector<std::byte> written(const std::filesystem::path& file) {
    Hdf5Writer writer(file, "a.h5");
    writer.make_group("many");
    const std::vector<float> ramp{0.5f, 1.5f, 2.5f, 3.5f, 4.5f, 5.5f};
    for (int i = 0; i < 60; ++i) writer.write_count(format("many/{}", i), static_cast<std::uint64_t>(i));
    writer.write_floats("packed", {3, 2}, ramp, Hdf5Writer::Packing::deflated);
    writer.write_floats("empty", {0, 2}, {}, Hdf5Writer::Packing::deflated);
    writer.write_bytes("flags", {3}, std::vector<std::uint8_t>{0, 1, 255});
    writer.write_ints("counts", {2}, std::vector<int>{-1, 70000});
    writer.write_doubles("times", {1, 1}, std::vector<double>{0.1});
    writer.write_texts("words", {"well", "naïve"});
    writer.write_floats("float16", {2, 2}, std::vector<float>{1, -0.25f, 65504, 1.0f / 3},
                        Hdf5Writer::Packing::float16);
    writer.write_attribute("version", 3);
    writer.write_attribute("fps", 23.976);
    writer.write_attribute("speaker", "Zoë", "many");
    writer.write_attribute("source", "", "many");
    writer.close();
    return read_bytes(file);
}

TEST(Hdf5Writer, WritesWhatTheReaderReads) {
    const testing::TemporaryFolder folder;
    const std::vector<std::byte> bytes = written(folder.path() / "a.h5");
    const Hdf5File file(bytes, "a.h5");
    EXPECT_EQ(file.names_in("many").size(), 60u);
    EXPECT_THAT(file.read_numbers("many/59", {}), ElementsAre(59));
    EXPECT_THAT(file.read_numbers("packed", {3, 2}), ElementsAre(0.5, 1.5, 2.5, 3.5, 4.5, 5.5));
    EXPECT_THAT(file.read_numbers("empty", {0, 2}), ElementsAre());
    EXPECT_THAT(file.read_numbers("flags", {Hdf5File::kAny}), ElementsAre(0, 1, 255));
    EXPECT_THAT(file.read_numbers("counts", {2}), ElementsAre(-1, 70000));
    EXPECT_THAT(file.read_numbers("times", {1, 1}), ElementsAre(0.1));
    EXPECT_THAT(file.read_texts("words"), ElementsAre("well", "naïve"));
    // A third has the nearest 11 bits.
    EXPECT_THAT(file.read_numbers("float16", {2, 2}), ElementsAre(1, -0.25, 65504, 1365.0 / 4096));
    EXPECT_EQ(file.attribute("", "version"), 3);
    EXPECT_EQ(file.attribute("", "fps"), 23.976);
    EXPECT_EQ(file.text_attribute("many", "speaker"), "Zoë");
    EXPECT_EQ(file.text_attribute("many", "source"), "");
    EXPECT_EQ(file.text_attribute("", "version"), std::nullopt);
    EXPECT_EQ(file.attribute("many", "speaker"), std::nullopt);
}

TEST(Hdf5Writer, WritesTheSameBytes) {
    const testing::TemporaryFolder folder;
    EXPECT_EQ(written(folder.path() / "a.h5"), written(folder.path() / "b.h5"));
}

TEST(Hdf5File, RefusesAnotherShapeAndNumbersThatAreNone) {
    const testing::TemporaryFolder folder;
    {
        Hdf5Writer writer(folder.path() / "a.h5", "a.h5");
        writer.write_floats("pose", {2}, std::vector<float>{1, std::numeric_limits<float>::quiet_NaN()});
        writer.close();
    }
    const std::vector<std::byte> bytes = read_bytes(folder.path() / "a.h5");
    const Hdf5File file(bytes, "a.h5");
    EXPECT_THAT(refusal_of([&] {
                    file.read_numbers("pose", {Hdf5File::kAny, 3});
                }),
                HasSubstr("/pose has the shape (2); (any, 3) is expected"));
    EXPECT_THAT(refusal_of([&] { file.read_numbers("pose", {2}); }),
                HasSubstr("/pose: element 1 is nan; all must be finite and below 1000000000"));
    EXPECT_THAT(refusal_of([&] { file.read_texts("pose"); }), HasSubstr("/pose holds no texts"));
}

TEST(Hdf5Writer, SaysThatAFileCannotBeWritten) {
    EXPECT_EQ(refusal_of([] { Hdf5Writer("/nowhere/a.h5", "a.h5"); }),
              "a.h5: cannot be written; check free space and permissions");
}

}  // namespace
}  // namespace chironomia
