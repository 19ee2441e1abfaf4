// A headless Chromium, driven through its debugging pipe: opens pages and evaluates JavaScript in them.
#pragma once

#include <sys/types.h>

#include <filesystem>
#include <string>

#include "core/files/json.h"

namespace chironomia::testing {

class Browser {
  public:
    static bool is_installed();

    // Keeps its profile in `folder`.
    explicit Browser(const std::filesystem::path& folder);
    ~Browser();
    Browser(const Browser&) = delete;
    Browser& operator=(const Browser&) = delete;

    // Opens the page in the one tab and waits until it is loaded.
    void open(const std::string& url);

    // The value of an expression, as if the user had just clicked; a promise is waited for.
    // Fails the test if it throws.
    Json evaluate(const std::string& script);

    // Waits until the expression is true, at most 30 s, also while pages load; false if it never is.
    bool wait_for(const std::string& script);

    // Presses and releases a key: "1", "Enter", " ", "Tab", "ArrowRight".
    void press(const std::string& key);

    // The size of the page [px].
    void resize(int width, int height);

    // As in the high-contrast mode of a system: few colors, which the reader has chosen.
    void force_colors();

    // What the page shows, as a PNG in base64.
    std::string picture();

  private:
    // The whole answer, also of a call that failed.
    Json exchange(const std::string& method, const Json& parameters);
    // The result; fails the test if there is none.
    Json call(const std::string& method, const Json& parameters);

    pid_t id_ = -1;
    int to_browser_ = -1;
    int from_browser_ = -1;
    int last_call_ = 0;
    std::string session_;
    std::string unread_;
};

}  // namespace chironomia::testing
