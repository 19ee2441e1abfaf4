#include "core/body/face.h"

#include <gtest/gtest.h>

namespace chironomia {
namespace {

TEST(FaceChannel, IsWrittenAndReadInOneWay) {
    for (const int unit : known_action_units()) {
        for (const FaceSide side : {FaceSide::both, FaceSide::left, FaceSide::right}) {
            const FaceChannel channel{.unit = unit, .side = side};
            EXPECT_EQ(face_channel_named(to_text(channel)), channel);
        }
    }
    EXPECT_EQ(to_text({.unit = 12, .side = FaceSide::left}), "AU12_L");
}

TEST(FaceChannel, IsNoOtherText) {
    for (const char* text : {"", "AU", "AU3", "AU12_", "AU12_X", "12", "AU12.5", "au12"}) {
        EXPECT_FALSE(face_channel_named(text)) << text;
    }
}

TEST(NameOfUnit, IsThatOfFacs) {
    EXPECT_EQ(name_of_unit(12), "lip corner puller");
    EXPECT_EQ(name_of_unit(45), "blink");
    EXPECT_EQ(name_of_unit(3), "");
}

}  // namespace
}  // namespace chironomia
