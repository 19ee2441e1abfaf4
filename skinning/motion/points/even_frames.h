// Frames at even times from those that a file has, whose steps may be uneven, as of a webcam, or leave frames out, as
// where a detector found nobody.
#pragma once

#include <functional>
#include <string>
#include <string_view>
#include <vector>

#include "skinning/motion/points/keypoint_data.h"

namespace chironomia {

// Where each frame of a file lies: where(t) stands before what is said of frame t, such as "a.csv:5: ".
using FramePlaces = std::function<std::string(size_t)>;

// Sets the rate from the times of the frames, in s, ms, us, ticks of 100 ns or ns, whichever makes their usual step one
// of a motion.
// Times that are even to a quarter of a frame, as they may be rounded to hundredths of a second, leave the frames as
// they are. Otherwise these are laid onto even times at the rate of the mean step, gaps left out: a point lies on the
// line between the two frames around it, comes from the nearer one where only one of them sees it, and is missing in
// gaps of 1.5 steps and more where no frame is within half a step. Notes say so. Fewer than two times set nothing,
// nor do whole numbers that go up by one, which are numbers of frames.
// Throws Error if a time is no number, does not advance, or if over nine tenths of the frames would be missing.
void even_out_times(KeypointData& data, std::vector<double> times, const FramePlaces& where);

// The same of numbers of frames, which go up by one where none is missing; the rate is not set. Fewer than two change
// nothing. Throws Error if they are not whole, do not advance, or advance by more than two everywhere.
void fill_missing_numbers(KeypointData& data, const std::vector<double>& numbers, const FramePlaces& where);

struct NumberedFrames {
    size_t held;         // that are there
    size_t first, last;  // numbers
};

// How many frames there are from the first to the last number. Throws Error with `where`, and `holder`, "a file" or "a
// folder", if more than half of them are missing, or they are more than a million.
size_t count_numbered(const NumberedFrames& frames, const std::string& where, std::string_view holder);

// Keeps that the first frame of the file has this number, if that is above 1, so that the motion begins later than a
// sound of the whole recording; a note says so.
void note_first_number(KeypointData& data, double first);

}  // namespace chironomia
