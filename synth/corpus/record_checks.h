// Checks that every record must pass: matching lengths, the rates that models need, numbers in their ranges.
// Readers and writers both use them.
#pragma once

#include <string>

#include "synth/corpus/records.h"

namespace chironomia {

// Arrays are called as in the files (synth/corpus/README.md). Throw Error with `where` and the array.
void check_record(const IpuRecord& record, const std::string& where);
void check_record(const DyadRecord& record, const std::string& where);
void check_record(const IntervalRecord& record, const std::string& where);

// Whether it may name a folder or a file: letters, digits, and . _ - +, the first one no point.
bool is_plain_name(std::string_view name);

}  // namespace chironomia
