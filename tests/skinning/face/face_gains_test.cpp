#include "skinning/face/face_gains.h"

#include <gmock/gmock.h>

#include "tests/support/support.h"

namespace chironomia {
namespace {

using ::testing::HasSubstr;
using testing::refusal_of;

TEST(FaceGains, AreReadAndWrittenAlike) {
    const FaceGains gains = parse_face_gains("12=1.3, 1=0.5");
    EXPECT_EQ(gains, (FaceGains{{1, 0.5}, {12, 1.3}}));
    EXPECT_EQ(to_text(gains), "1=0.5,12=1.3");
    EXPECT_EQ(parse_face_gains(to_text(gains)), gains);
    EXPECT_EQ(to_text(FaceGains{}), "");
}

TEST(FaceGains, RefuseWhatIsNone) {
    const auto refusal = [](const char* text) { return refusal_of([&] { parse_face_gains(text); }); };
    EXPECT_THAT(refusal("12"), HasSubstr("\"12\" is no gain of an action unit; write unit=gain"));
    EXPECT_THAT(refusal("smile=2"), HasSubstr("\"smile=2\" is no gain"));
    EXPECT_THAT(refusal("12=much"), HasSubstr("\"12=much\" is no gain"));
    EXPECT_THAT(refusal(""), HasSubstr("\"\" is no gain"));
    EXPECT_THAT(refusal("3=1"), HasSubstr("AU3 is not known; the known units are 1, 2, 4"));
    EXPECT_THAT(refusal("12=-1"), HasSubstr("the gain of AU12 is -1; use a number from 0 to 10"));
    EXPECT_THAT(refusal("12=nan"), HasSubstr("the gain of AU12 is nan"));
    EXPECT_THAT(refusal("12=1,12=2"), HasSubstr("AU12 has two gains; give it one"));
}

}  // namespace
}  // namespace chironomia
