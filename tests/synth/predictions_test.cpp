#include "synth/predictions.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <functional>

#include "core/files/files.h"
#include "core/hdf5/writer.h"
#include "tests/support/support.h"

namespace chironomia {
namespace {

using ::testing::ElementsAre;
using ::testing::HasSubstr;
using testing::refusal_of;

Predictions two_people() {
    return {.model = "amii",
            .corpus = "dyads",
            .split = "test",
            .fps = 25,
            .features = {"AU12", "Rx"},
            .scale = {{0, 5}, {-0.5, 0.5}},
            .items = {{"d0:0", "p1", "", {0.1f, 0.2f}, {0.3f, 0.4f}, {0.5f, 0.6f}},
                      {"d0:1", "p2", "", {1, 0, 0.5f, 0.25f}, {0, 1, 0.75f, 0}, {0, 0, 0, 0.125f}}}};
}

TEST(Predictions, AreReadAsTheyWereWritten) {
    const testing::TemporaryFolder folder;
    write_predictions(folder / "p.h5", two_people());
    const Predictions read = read_predictions(folder / "p.h5");
    EXPECT_EQ(read.model, "amii");
    EXPECT_EQ(read.corpus, "dyads");
    EXPECT_EQ(read.split, "test");
    EXPECT_EQ(read.fps, 25);
    EXPECT_THAT(read.features, ElementsAre("AU12", "Rx"));
    EXPECT_EQ(read.scale[1][0], -0.5);
    ASSERT_EQ(read.items.size(), 2u);
    EXPECT_EQ(read.items[0].id, "d0:0");
    EXPECT_EQ(read.items[1].speaker, "p2");
    EXPECT_THAT(read.items[1].truth, ElementsAre(1, 0, 0.5f, 0.25f));
    EXPECT_THAT(read.items[0].prediction, ElementsAre(0.3f, 0.4f));
    EXPECT_THAT(read.items[1].partner, ElementsAre(0, 0, 0, 0.125f));
}

TEST(Predictions, KeepWhoseStyleIsShown) {
    const testing::TemporaryFolder folder;
    Predictions made = two_people();
    made.items[0].style = "p2";
    made.items[1].style = "p1";
    write_predictions(folder / "p.h5", made);
    const Predictions read = read_predictions(folder / "p.h5");
    EXPECT_EQ(read.items[0].style, "p2");
    EXPECT_EQ(read.items[1].style, "p1");
}

TEST(Predictions, HaveNoPartnerOutsideOfDyads) {
    const testing::TemporaryFolder folder;
    Predictions alone = two_people();
    for (PredictedItem& item : alone.items) item.partner.clear();
    write_predictions(folder / "p.h5", alone);
    EXPECT_TRUE(read_predictions(folder / "p.h5").items[1].partner.empty());
}

TEST(Predictions, GiveTheSameBytes) {
    const testing::TemporaryFolder folder;
    write_predictions(folder / "a.h5", two_people());
    write_predictions(folder / "b.h5", two_people());
    EXPECT_EQ(read_bytes(folder / "a.h5"), read_bytes(folder / "b.h5"));
}

// What reading says about predictions that were changed by `spoil`.
std::string refusal(const std::function<void(Predictions&)>& spoil) {
    const testing::TemporaryFolder folder;
    Predictions predictions = two_people();
    spoil(predictions);
    write_predictions(folder / "p.h5", predictions);
    return refusal_of([&] { read_predictions(folder / "p.h5"); });
}

TEST(Predictions, AreRefusedWhereTheyMakeNoSense) {
    EXPECT_THAT(refusal([](Predictions& p) { p.fps = 0; }),
                HasSubstr("p.h5: /fps is 0; it must be the rate of a motion, 1 to 1000"));
    EXPECT_THAT(refusal([](Predictions& p) { p.fps = 0.01; }), HasSubstr("/fps is 0.01; it must be"));
    EXPECT_THAT(refusal([](Predictions& p) {
                    p.scale[0] = {5, 5};
                }),
                HasSubstr("/scale of AU12 goes from 5 to 5; the second must be larger"));
    EXPECT_THAT(refusal([](Predictions& p) { p.items[1].id = "d0:0"; }),
                HasSubstr("/ids: \"d0:0\" stands behind \"d0:0\"; they must be ascending, no two the same"));
    EXPECT_THAT(refusal([](Predictions& p) {
                    for (auto* rows : {&p.items[0].truth, &p.items[0].prediction, &p.items[0].partner})
                        rows->clear();
                    p.items[1].partner.clear();
                    p.items.erase(p.items.begin() + 1);
                }),
                HasSubstr("/frames of d0:0 is 0; it must be at least 1"));
    EXPECT_THAT(refusal([](Predictions& p) { p.items[0].prediction[1] = 0.0f / 0.0f; }),
                HasSubstr("/prediction"));
}

// A file with some of the arrays alone.
std::string refusal_of_arrays(const std::function<void(Hdf5Writer&)>& write) {
    const testing::TemporaryFolder folder;
    const std::filesystem::path file = folder / "p.h5";
    Hdf5Writer writer(file, "p.h5");
    write(writer);
    writer.close();
    return refusal_of([&] { read_predictions(file); });
}

TEST(Predictions, AreRefusedWhereSomethingIsMissing) {
    EXPECT_THAT(refusal_of_arrays([](Hdf5Writer& writer) { writer.write_number("fps", 25); }),
                HasSubstr("/model"));
    EXPECT_THAT(refusal_of_arrays([](Hdf5Writer& writer) {
                    writer.write_texts("model", {"a", "b"});
                }),
                HasSubstr("/model holds 2 texts; it must hold one"));
    EXPECT_THAT(refusal_of_arrays([](Hdf5Writer& writer) {
                    for (const char* name : {"model", "corpus", "split", "features"})
                        writer.write_texts(name, {"AU1"});
                    writer.write_number("fps", 25);
                    writer.write_doubles("scale", {1, 2}, std::vector<double>{0, 5});
                    writer.write_texts("ids", {"a", "b"});
                    writer.write_texts("speakers", {"s"});
                }),
                HasSubstr("/speakers has 1 entries but /ids has 2"));
    EXPECT_THAT(refusal_of([] { read_predictions("none.h5"); }), HasSubstr("none.h5"));
}

}  // namespace
}  // namespace chironomia
