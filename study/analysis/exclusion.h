// Whose answers count.
#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "study/analysis/dataset.h"

namespace chironomia {

enum class Strictness { strict, lenient };

const char* to_text(Strictness strictness);

// Of each rater why the answers do not count; empty: they do. Strict: as many failed checks as the key's
// "failed_checks" or more, or not finished. Lenient: as many as "lenient_failed_checks" or more. A pass that
// was answered faster than "fastest_seconds" is a failed check. Who answered nothing counts under neither.
std::vector<std::string> reasons_to_exclude(const Dataset& data, Strictness strictness);

// What the raters whose reason is empty answered; the numbers of raters stay. Rows and raters are kept whole.
Dataset without_excluded(const Dataset& data, const std::vector<std::string>& reasons);

}  // namespace chironomia
