// What a comparison found, as one HTML file that needs nothing else: no network, no other file.
#pragma once

#include <string>

#include "raster/images/compare_sets.h"

namespace chironomia::study {

// Cases that keep their pictures in a page: more make it too heavy for a browser.
constexpr std::size_t kMostPagePictures = 24;

// Expected, actual and difference side by side for each case that is not the same, with its numbers. The
// pictures are those that the cases kept.
std::string make_compare_page(const std::string& expected, const std::string& actual, const CompareSet& set);

}  // namespace chironomia::study
