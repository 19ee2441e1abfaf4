// The result of a comparison as JUnit XML, the form that Jenkins, GitLab and most runners of tests show.
#pragma once

#include <string>

#include "raster/images/compare_sets.h"

namespace chironomia::study {

// One test case each: a difference, a missing and an extra file are failures, an unreadable file is an error.
// A case that failed holds its numbers and the paths of its pictures. All times are 0, so that equal results
// are equal bytes; characters that XML cannot hold are shown as U+FFFD.
std::string make_junit(const std::string& suite, const CompareSet& set);

}  // namespace chironomia::study
