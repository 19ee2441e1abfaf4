// Many participants at once, with a record of what the server sent and acknowledged to each.
#pragma once

#include <atomic>
#include <cstddef>
#include <functional>
#include <map>
#include <string>
#include <vector>

#include "study/server/served_study.h"

namespace chironomia::testing {

using namespace study;

struct Crowd {
    std::size_t people = 10;
    // The port to go to now; asked again whenever a connection fails, since the server may have been started
    // anew.
    std::function<int()> port;
    std::atomic<std::size_t>* acknowledged = nullptr;  // counts answers as they are; may be null
    bool watches = false;  // fetches the videos of each page before it is answered
};

// What one of them saw.
struct Visit {
    std::string name;
    std::size_t sheet = 0;
    std::size_t acknowledged = 0;  // answers; the first ones of the sheet
    bool finished = false;
    std::string trouble;  // what must not happen; empty: nothing
    // of each request, by "begin", "video", "answer", "finish"
    std::map<std::string, std::vector<double>> seconds;
    std::size_t bytes = 0;  // of videos
};

// All come at the same time, answer their whole sheets, send every third answer twice, and finish. A
// connection that fails is opened again, the session begun again, and what was not acknowledged sent again.
std::vector<Visit> send_crowd(const server::ServedStudy& study, const Crowd& crowd);

// What is wrong with the answers in a database: lost, doubled or misassigned ones, one line each; "" if
// nothing is.
std::string fault_of_answers(const server::ServedStudy& study, const std::filesystem::path& database,
                             const std::vector<Visit>& visits);

}  // namespace chironomia::testing
