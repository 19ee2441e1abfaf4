// Which sheet the next participant gets.
#pragma once

#include <cstddef>
#include <vector>

namespace chironomia::study::server {

// How many participants have a sheet.
struct SheetLoad {
    std::size_t finished = 0;  // whose answers count: to the end, and without too many failed checks
    std::size_t active = 0;    // on their way, and heard of lately
};

// The sheet that fewest participants have; of several the first, so that participants who come one after the
// other take the sheets in turn. `loads` has an entry for each sheet and is not empty.
std::size_t most_needed_sheet(const std::vector<SheetLoad>& loads);

// Finished and active participants of all sheets.
std::size_t count_taken(const std::vector<SheetLoad>& loads);

}  // namespace chironomia::study::server
