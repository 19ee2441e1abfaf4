// The rows of a face file, each at its own time, and the even track that is made of them.
#pragma once

#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "core/body/motion.h"
#include "core/files/csv_table.h"

namespace chironomia {

// N rows of C channels. Of a row that failed only the time means something.
struct FaceRows {
    std::string where;                  // the file's name
    std::vector<FaceChannel> channels;  // (C) no two the same
    std::vector<size_t> lines;          // (N) in the file, from 1
    std::vector<double> times;          // (N) [s]
    double resolution = 0;              // what one step of the times' last digit is worth [s]
    std::vector<float> intensities;     // (N, C) in [0, 5]
    std::vector<Quat> head;             // (N) or empty, as in FaceTrack
    std::vector<Gaze> gaze;             // (N) or empty, as in FaceTrack
    std::vector<float> confidence;      // (N) in [0, 1]; 0: the row failed
    std::string failure;                // what makes a row fail, for messages: "success 0"
    std::vector<std::string> notes;
};

// When the rows of a table were, and how finely that is written.
struct RowTimes {
    std::vector<double> times;  // (N) [s]
    double resolution = 0;      // [s]
};

// The numbers of the column of times (time_columns.h). With `fps` the rows are that many in a second, counted by the
// column of frames if there is one. Throws Error if there is no such column and no `fps`, or a time is no finite
// number.
RowTimes row_times(const CsvTable& table, std::optional<double> fps);

// Columns that belong together, in any case: all of them, or none. Throws Error if some are missing.
std::optional<std::vector<size_t>> find_group(const CsvTable& table, std::span<const std::string_view> names);

// An intensity that `scale` brings to 0..5. What is beyond the ends by up to 0.05 of 5 is drawn in; Throws
// Error with line and column for more.
float intensity_in(const CsvTable& table, const CsvRow& row, size_t column, double scale);
// As number_in, but finite.
double finite_in(const CsvTable& table, const CsvRow& row, size_t column);
// The same in [-most, most] [rad].
float angle_in(const CsvTable& table, const CsvRow& row, size_t column, double most);

// Frame n lies n / fps seconds after the first row, and is a mixture of the good rows before and after it:
// intensities and gaze on the straight line, the head by slerp on the shorter way; a row at that very time
// is taken as it is. The rate is `fps` if given, otherwise that of the median step from row to row, rounded
// to the usual rate that the times' digits allow. A frame is as sure as the less sure of its two rows. It
// is bridged, with confidence 0, where rows failed or are missing (the good ones lie more than 1.5 steps
// apart, and none within half a step); the notes say how many frames are.
// Throws Error if no row is good, times do not advance, or rows are too uneven to be frames.
Motion face_of_rows(const FaceRows& rows, std::optional<double> fps);

}  // namespace chironomia
