#include "raster/gl/gl_context.h"

#include <gtest/gtest.h>

#include <array>

#include "tests/support/support.h"

namespace chironomia {
namespace {

using testing::refusal_of;

TEST(OpenLibrary, SaysWhatToInstall) {
    constexpr std::array kNames = {"libNoSuchThing.so.8", "libNoSuchThing.so"};
    const std::string refusal = refusal_of([&] { open_library(kNames, "libnosuch8"); });
    EXPECT_TRUE(refusal.starts_with("libNoSuchThing.so.8: the library is not on this machine (")) << refusal;
    EXPECT_TRUE(refusal.ends_with("); install the package libnosuch8")) << refusal;
}

TEST(LoadGlFunctions, NamesTheFirstFunctionThatIsMissing) {
    EXPECT_EQ(refusal_of([] { load_gl_functions([](const char*) { return GlAddress{}; }); }),
              "OpenGL: the library has no function glActiveTexture, version 4.5 has it; install Mesa 22.3");
}

TEST(GlContext, DescribesItselfTheSameForBothBackends) {
    if (!has_osmesa()) GTEST_SKIP() << "needs OSMesa, which Mesa has until 25.0";
    const std::string description = describe_gl(GlBackend::osmesa);
    EXPECT_NE(description.find("4.5"), std::string::npos) << description;
    EXPECT_EQ(describe_gl(GlBackend::egl), description);
    EXPECT_EQ(describe_gl(GlBackend::any), description);
}

}  // namespace
}  // namespace chironomia
