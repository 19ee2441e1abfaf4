// FBX files given to the real binary.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <filesystem>
#include <string>

#include "core/files/files.h"
#include "tests/study/process.h"
#include "tests/support/support.h"

namespace chironomia::study {
namespace {

namespace fs = std::filesystem;
using ::testing::AllOf;
using ::testing::HasSubstr;
using ::testing::Not;
using testing::Outcome;
using testing::run_chironomia;
using testing::TemporaryFolder;

TEST(FbxCli, SaysWhichFbxABinaryOneIsAndHowItBecomesGltf) {
    const TemporaryFolder folder;
    const std::string fbx = (folder / "host.fbx").string(), glb = (folder / "host.glb").string();
    write_text(fbx, std::string("Kaydara FBX Binary  \0\x1a\0\xe8\x1c\0\0", 27) + std::string(100, '\0'));
    for (const std::string what : {"--avatar", "--motion"}) {
        const Outcome outcome =
            run_chironomia({"render", what, fbx, "--out", (folder / "clip.mp4").string()});
        EXPECT_EQ(outcome.exit_code, 3);
        EXPECT_THAT(
            outcome.err,
            AllOf(HasSubstr(fbx + ": is a binary FBX file of version 7.4, and glTF 2.0 is read"),
                  HasSubstr("blender --background"), HasSubstr("import_scene.fbx(filepath='" + fbx + "')"),
                  HasSubstr("export_scene.gltf(filepath='" + glb + "')"),
                  HasSubstr("FBX2glTF --binary --input " + fbx + " --output " + glb)));
        EXPECT_FALSE(fs::exists(folder / "clip.mp4"));
    }
    EXPECT_EQ(run_chironomia({"info", fbx}).exit_code, 3);
}

TEST(FbxCli, SendsWhatBlenderCannotReadToFbx2gltfAlone) {
    const TemporaryFolder folder;
    const std::string fbx = (folder / "host.fbx").string();
    write_text(fbx, "; FBX 7.3.0 project file\n; ----------------------\n\nFBXHeaderExtension:  {\n}\n");
    const Outcome outcome = run_chironomia({"info", fbx});
    EXPECT_EQ(outcome.exit_code, 3);
    EXPECT_THAT(outcome.err, AllOf(HasSubstr(fbx + ": is an FBX file of version 7.3.0 as text"),
                                   HasSubstr("FBX2glTF --binary"), Not(HasSubstr("blender --background"))));
    write_text(fbx, std::string("Kaydara FBX Binary  \0\x1a\0\xd4\x17\0\0", 27) + std::string(100, '\0'));
    EXPECT_THAT(run_chironomia({"info", fbx}).err, AllOf(HasSubstr("is a binary FBX file of version 6.1"),
                                                         Not(HasSubstr("blender --background"))));
}

}  // namespace
}  // namespace chironomia::study
