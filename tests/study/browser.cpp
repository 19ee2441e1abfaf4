#include "tests/study/browser.h"

#include <fcntl.h>
#include <gtest/gtest.h>
#include <signal.h>
#include <sys/wait.h>
#include <unistd.h>

#include <array>
#include <chrono>
#include <cstdlib>
#include <map>
#include <thread>

#include "core/text.h"

namespace chironomia::testing {
namespace {

// Chromium reads calls from descriptor 3 and answers on 4; messages are JSON that ends with a zero byte.
[[noreturn]] void become_browser(int calls, int answers, const std::string& profile) {
    const int read_end = ::fcntl(calls, F_DUPFD, 10);
    const int write_end = ::fcntl(answers, F_DUPFD, 10);
    ::dup2(read_end, 3);
    ::dup2(write_end, 4);
    const int nowhere = ::open("/dev/null", O_RDWR);
    for (int stream : {0, 1, 2}) ::dup2(nowhere, stream);
    ::setpgid(0, 0);
    ::execlp("chromium", "chromium", "--headless=new", "--no-sandbox", "--disable-gpu",
             "--disable-dev-shm-usage", "--no-first-run", "--remote-debugging-pipe",
             "--autoplay-policy=no-user-gesture-required", ("--user-data-dir=" + profile).c_str(),
             "about:blank", nullptr);
    ::_exit(127);
}

Json evaluation_of(const std::string& script) {
    return {{"expression", script}, {"awaitPromise", true}, {"returnByValue", true}, {"userGesture", true}};
}

}  // namespace

bool Browser::is_installed() {
    return std::system("command -v chromium > /dev/null 2>&1") == 0;
}

Browser::Browser(const std::filesystem::path& folder) {
    std::array<int, 2> calls{}, answers{};
    if (::pipe(calls.data()) != 0 || ::pipe(answers.data()) != 0) return;
    const std::string profile = (folder / "profile").string();
    id_ = ::fork();
    if (id_ == 0) become_browser(calls[0], answers[1], profile);
    ::close(calls[0]);
    ::close(answers[1]);
    to_browser_ = calls[1];
    from_browser_ = answers[0];
    const Json target = call("Target.createTarget", {{"url", "about:blank"}});
    session_ =
        call("Target.attachToTarget", {{"targetId", target["targetId"]}, {"flatten", true}})["sessionId"];
}

Browser::~Browser() {
    ::close(to_browser_);
    ::close(from_browser_);
    if (id_ > 0) {
        ::kill(-id_, SIGKILL);  // its own group: the processes of its tabs too
        ::waitpid(id_, nullptr, 0);
    }
}

Json Browser::call(const std::string& method, const Json& parameters) {
    const Json answer = exchange(method, parameters);
    EXPECT_FALSE(answer.contains("error")) << answer.dump();
    return answer.value("result", Json::object());
}

Json Browser::exchange(const std::string& method, const Json& parameters) {
    Json message = {{"id", ++last_call_}, {"method", method}, {"params", parameters}};
    if (!session_.empty()) message["sessionId"] = session_;
    const std::string text = message.dump() + '\0';
    if (::write(to_browser_, text.data(), text.size()) != static_cast<ssize_t>(text.size())) {
        ADD_FAILURE() << "the browser has gone";
        return {};
    }
    for (;;) {
        const std::size_t end = unread_.find('\0');
        if (end == std::string::npos) {
            std::array<char, 65536> block{};
            const ssize_t got = ::read(from_browser_, block.data(), block.size());
            if (got <= 0) {
                ADD_FAILURE() << "the browser has gone";
                return {};
            }
            unread_.append(block.data(), static_cast<std::size_t>(got));
            continue;
        }
        Json answer = Json::parse(unread_.substr(0, end));
        unread_.erase(0, end + 1);
        if (answer.value("id", 0) == last_call_) return answer;  // others are events
    }
}

void Browser::open(const std::string& url) {
    call("Page.navigate", {{"url", url}});
    EXPECT_TRUE(wait_for(format("document.readyState === 'complete' && location.href.startsWith('{}')", url)))
        << url;
}

Json Browser::evaluate(const std::string& script) {
    const Json answer = call("Runtime.evaluate", evaluation_of(script));
    EXPECT_FALSE(answer.contains("exceptionDetails")) << script << "\n" << answer.dump();
    return answer.value("result", Json::object()).value("value", Json());
}

bool Browser::wait_for(const std::string& script) {
    const auto end = std::chrono::steady_clock::now() + std::chrono::seconds(30);
    while (std::chrono::steady_clock::now() < end) {
        // No value if the page is loaded anew meanwhile, or misses what the script names.
        const Json answer = exchange("Runtime.evaluate", evaluation_of(format("Boolean({})", script)));
        if (answer.value(Json::json_pointer("/result/result/value"), Json()) == true) return true;
        std::this_thread::sleep_for(std::chrono::milliseconds(10));
    }
    return false;
}

void Browser::press(const std::string& key) {
    const std::map<std::string, int> codes = {{"Enter", 13},      {"Tab", 9},        {" ", 32},
                                              {"ArrowRight", 39}, {"ArrowLeft", 37}, {"Escape", 27}};
    const auto code = codes.find(key);
    for (const char* type : {"keyDown", "keyUp"}) {
        Json event = {{"type", type}, {"key", key}};
        if (code != codes.end()) event["windowsVirtualKeyCode"] = code->second;
        const bool writes = key.size() == 1 || key == "Enter";
        if (writes && std::string(type) == "keyDown") event["text"] = key == "Enter" ? "\r" : key;
        call("Input.dispatchKeyEvent", event);
    }
}

void Browser::resize(int width, int height) {
    call("Emulation.setDeviceMetricsOverride",
         {{"width", width}, {"height", height}, {"deviceScaleFactor", 1}, {"mobile", false}});
}

void Browser::force_colors() {
    call("Emulation.setEmulatedMedia", {{"features", {{{"name", "forced-colors"}, {"value", "active"}}}}});
}

std::string Browser::picture() {
    return call("Page.captureScreenshot", Json::object())["data"];
}

}  // namespace chironomia::testing
