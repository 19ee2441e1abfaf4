// Work that is done in several processes, so that a crash in one piece does not take the others along.
#pragma once

#include <cstddef>
#include <functional>
#include <string>

#include "core/progress.h"

namespace chironomia::study {

struct Work {
    std::size_t count = 0;
    std::function<void(std::size_t)> perform;      // must leave its result in files
    std::function<std::string(std::size_t)> name;  // of a piece, for messages
};

// Performs pieces 0 to count - 1, up to `jobs` at once, and steps `progress` after each. One job works in
// this process; more work in child processes, which end with this one. Call it while the process has no other
// threads. The first piece that throws an Error or crashes stops the others and is thrown as an Error. Throws
// Interrupted if the user stops it.
void perform_all(const Work& work, int jobs, Progress& progress);

}  // namespace chironomia::study
