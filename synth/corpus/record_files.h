// The file of each kind of record; the layouts stand at the top of ipu_file.cpp, dyad_file.cpp and
// interval_file.cpp. The same record gives the same bytes.
#pragma once

#include <filesystem>
#include <string_view>

#include "synth/corpus/record_file.h"
#include "synth/corpus/records.h"

namespace chironomia {

inline constexpr std::string_view kIpuFormat = "chironomia talk";
inline constexpr std::string_view kDyadFormat = "chironomia dyad";
inline constexpr int kRecordVersion = 1;

// Throws Error unless the file's attributes say that it is of that format, in this version.
void check_format(const RecordFile& file, std::string_view format);

// Readers and writers throw Error for what check_record refuses; readers also for a file that is broken, and
// for an array that is missing or has another shape.
void write_ipu_file(const std::filesystem::path& path, const IpuRecord& record);
IpuRecord read_ipu_file(const std::filesystem::path& path);

void write_dyad_file(const std::filesystem::path& path, const DyadRecord& record);
DyadRecord read_dyad_file(const std::filesystem::path& path);

// The files of PATS hold neither id nor speaker: both come from the index.
void write_interval_file(const std::filesystem::path& path, const IntervalRecord& record);
IntervalRecord read_interval_file(const std::filesystem::path& path, const std::string& id,
                                  const std::string& speaker);

}  // namespace chironomia
