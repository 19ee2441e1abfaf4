#include "study/server/public_files.h"

#include <gtest/gtest.h>
#include <sys/stat.h>

#include "core/files/files.h"
#include "tests/support/support.h"

namespace chironomia::study::server {
namespace {

namespace fs = std::filesystem;

class Public : public ::testing::Test {
  protected:
    Public() {
        write_text(folder_ / "public/index.html", "page");
        write_text(folder_ / "public/clips/77.mp4", "video");
        write_text(folder_ / "private/key.json", "secret");
    }

    bool is_there(const std::string& path) { return files_.open(path).has_value(); }

    testing::TemporaryFolder folder_;
    PublicFiles files_{folder_ / "public"};
};

TEST_F(Public, ServesWhatAStudyHas) {
    const std::optional<PublicFile> video = files_.open("/clips/77.mp4");
    ASSERT_TRUE(video);
    EXPECT_EQ(video->size, 5u);
    EXPECT_EQ(video->type, "video/mp4");
    EXPECT_EQ(files_.open("/")->type, "text/html; charset=utf-8");
    EXPECT_TRUE(is_there("/index.html"));
}

TEST_F(Public, HasNoWayOut) {
    write_text(folder_ / "public/.hidden.html", "hidden");
    write_text(folder_ / "public/notes.txt2", "of no kind");
    for (const char* path :
         {"/../private/key.json", "/clips/../../private/key.json", "//private/key.json", "/clips", "/clips/",
          "/.", "/..", "", "index.html", "/.hidden.html", "/notes.txt2", "/clips/77.mp4/", "/clips//77.mp4",
          "/./index.html", "/clips\\77.mp4", "/missing.html", "/a/b/c/d/e.html", "/index.html\n",
          "/%2e%2e/private/key.json"}) {
        EXPECT_FALSE(is_there(path)) << path;
    }
    EXPECT_FALSE(is_there(std::string("/index.html\0.mp4", 16)));
}

TEST_F(Public, FollowsNoLinks) {
    fs::create_symlink("../private/key.json", folder_ / "public/key.json");
    fs::create_directory_symlink("../private", folder_ / "public/more");
    fs::create_symlink("index.html", folder_ / "public/other.html");
    EXPECT_FALSE(is_there("/key.json"));
    EXPECT_FALSE(is_there("/more/key.json"));
    EXPECT_FALSE(is_there("/other.html"));
    fs::create_directory_symlink("private", folder_ / "linked");
    EXPECT_FALSE(PublicFiles(folder_ / "linked").open("/key.json")) << "public/ itself may be no link";
}

TEST_F(Public, OpensFilesAlone) {
    fs::create_directory(folder_ / "public/folder.html");
    ASSERT_EQ(mkfifo((folder_ / "public/pipe.html").c_str(), 0600), 0);
    EXPECT_FALSE(is_there("/folder.html"));
    EXPECT_FALSE(is_there("/pipe.html"));
}

TEST_F(Public, TagsChangeWithTheContentAlone) {
    const std::string tag = files_.open("/clips/77.mp4")->tag;
    EXPECT_EQ(files_.open("/clips/77.mp4")->tag, tag);
    const auto time = fs::last_write_time(folder_ / "public/clips/77.mp4");
    write_text(folder_ / "public/clips/77.mp4", "other");  // as long
    fs::last_write_time(folder_ / "public/clips/77.mp4", time);
    EXPECT_NE(files_.open("/clips/77.mp4")->tag, tag);
    write_text(folder_ / "public/clips/77.mp4", "video");
    EXPECT_EQ(files_.open("/clips/77.mp4")->tag, tag);
}

TEST(ParseRange, CutsAPart) {
    const auto part = [](const char* header) {
        const ByteRange range = parse_range(header, 100);
        EXPECT_EQ(range.kind, ByteRange::Kind::part) << header;
        return std::pair(range.first, range.length);
    };
    EXPECT_EQ(part("bytes=0-0"), std::pair(0ul, 1ul));
    EXPECT_EQ(part("bytes=10-19"), std::pair(10ul, 10ul));
    EXPECT_EQ(part("bytes=90-"), std::pair(90ul, 10ul));
    EXPECT_EQ(part("bytes=90-1000"), std::pair(90ul, 10ul));
    EXPECT_EQ(part("bytes=-5"), std::pair(95ul, 5ul));
    EXPECT_EQ(part("bytes=-500"), std::pair(0ul, 100ul));
}

TEST(ParseRange, RefusesWhatLiesBeyond) {
    for (const char* header : {"bytes=100-", "bytes=100-200", "bytes=-0", "bytes=9223372036854775807-"}) {
        EXPECT_EQ(parse_range(header, 100).kind, ByteRange::Kind::unsatisfiable) << header;
    }
    EXPECT_EQ(parse_range("bytes=0-", 0).kind, ByteRange::Kind::unsatisfiable);
}

TEST(ParseRange, TakesAnythingElseForTheWhole) {
    for (const char* header : {"", "bytes=", "bytes=-", "bytes=5-4", "bytes=a-b", "bytes=0-1,5-6",
                               "bytes=--5", "items=0-1", "bytes=99999999999999999999-", "bytes=1.5-2"}) {
        EXPECT_EQ(parse_range(header, 100).kind, ByteRange::Kind::whole) << header;
    }
}

}  // namespace
}  // namespace chironomia::study::server
