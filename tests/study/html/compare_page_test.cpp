// The page of a comparison, as text and in a real browser.
#include "study/html/compare_page.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <regex>

#include "core/files/files.h"
#include "core/text.h"
#include "raster/images/image_file.h"
#include "tests/study/browser.h"
#include "tests/support/support.h"

namespace chironomia::study {
namespace {

using testing::Browser;
using ::testing::HasSubstr;
using ::testing::Not;
using testing::TemporaryFolder;

Frame grey(int level) {
    Frame frame{.width = 8, .height = 4, .rgba = std::vector<std::uint8_t>(8 * 4 * 4, 255)};
    for (size_t i = 0; i < frame.rgba.size(); ++i) {
        if (i % 4 != 3) frame.rgba[i] = static_cast<std::uint8_t>(level);
    }
    return frame;
}

// Two references, one of them without a result; names need escaping.
class ComparePage : public ::testing::Test {
  protected:
    void SetUp() override {
        write_image(folder_ / "a/<b>&.png", grey(40));
        write_image(folder_ / "a/gone.png", grey(0));
        write_image(folder_ / "a/same.png", grey(0));
        write_image(folder_ / "b/<b>&.png", grey(90));
        write_image(folder_ / "b/same.png", grey(0));
    }

    CompareSet compared(size_t most = kMostPagePictures) const {
        return compare_sets(folder_ / "a", folder_ / "b", {.most_pictures = most});
    }

    TemporaryFolder folder_;
};

TEST_F(ComparePage, ShowsWhatDiffersWithItsNumbersAndNothingElse) {
    const std::string page = make_compare_page("refs/", "res/", compared());
    EXPECT_THAT(page, HasSubstr("1 of 3 the same, 1 different, 1 missing"));
    EXPECT_THAT(page, HasSubstr("&lt;b&gt;&amp;.png"));
    EXPECT_THAT(page, HasSubstr("<dd>32 of 32</dd>"));
    EXPECT_THAT(page, HasSubstr("50 of 255 at (0, 0)"));
    EXPECT_THAT(page, HasSubstr("gone.png: was expected"));
    EXPECT_THAT(page, Not(HasSubstr("same.png")));
    EXPECT_THAT(page, Not(HasSubstr("<!--")));
    EXPECT_FALSE(std::regex_search(page, std::regex("(src|href)=\"(?!data:)"))) << "it needs no other file";
    EXPECT_THAT(make_compare_page("refs/", "res/", compared(0)),
                HasSubstr("1 more frames differ; only the first 24 show their pictures."));
}

TEST_F(ComparePage, ShowsTheVeryPicturesAndSwapsThem) {
    if (!Browser::is_installed()) GTEST_SKIP() << "needs chromium";
    write_text(folder_ / "page.html", make_compare_page("refs/", "res/", compared()));
    Browser browser(folder_ / "browser");
    browser.open("file://" + (folder_ / "page.html").string());
    // The grey of the first pixel that an image shows.
    browser.evaluate(
        "window.level = (image) => { const c = document.createElement('canvas'); c.width = 8; c.height = 4; const d = "
        "c.getContext('2d'); d.drawImage(image, 0, 0); return d.getImageData(0, 0, 1, 1).data[0]; };window.at = (kind) "
        "=> document.querySelector('.' + kind + ' img')");
    const auto level = [&](const std::string& kind) {
        return browser.evaluate("at('" + kind + "').decode().then(() => level(at('" + kind + "')))");
    };
    EXPECT_EQ(level("expected"), 40);
    EXPECT_EQ(level("actual"), 90);
    EXPECT_EQ(level("difference"), 255);
    browser.evaluate("at('expected').dispatchEvent(new MouseEvent('mouseenter'))");
    EXPECT_EQ(level("expected"), 90);
    browser.evaluate("at('expected').dispatchEvent(new MouseEvent('mouseleave'))");
    EXPECT_EQ(level("expected"), 40);
    browser.press("f");
    EXPECT_EQ(browser.evaluate("document.querySelector('#flicker').getAttribute('aria-pressed')"), "true");
    EXPECT_TRUE(browser.wait_for("at('expected').src === at('actual').own"));
    browser.press("f");
    EXPECT_EQ(level("expected"), 40);
    browser.press("j");
    browser.press("Enter");
    EXPECT_EQ(browser.evaluate("document.querySelector('dialog').open"), true);
    browser.press(" ");
    EXPECT_EQ(browser.evaluate("document.querySelector('dialog p').textContent"),
              "actual  (Space: the next, Escape: back)");
}

}  // namespace
}  // namespace chironomia::study
