// How motions move, and how near they are to a reference: every metric that two files allow.
#pragma once

#include <optional>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "core/audio.h"
#include "core/body/motion.h"
#include "core/files/json.h"
#include "study/analysis/table.h"

namespace chironomia::study {

inline Json or_null(std::optional<double> value) {
    return value ? Json(*value) : Json();
}

// What was measured of one motion: rows of numbers by name, null where they are not defined.
struct MotionMeasures {
    std::string source;
    std::vector<Json> body{};          // one row, or none
    std::vector<Json> face{};          // by feature
    std::vector<Json> near{};          // by feature that it shares with the reference, and of the body
    std::vector<Json> style{};         // by metric of style_distance.h
    std::vector<Json> pair{};          // of the smiles of both people
    std::vector<Json> beats{};         // one row, or none: with a sound
    std::vector<std::string> notes{};  // what was resampled, cut or left out
};

// Each by itself, at the lowest of their rates; at least one motion. Of the body: velocity, acceleration and jerk of
// the points that all motions with a body have, and of the wrists, the perimeter of their box from the front and their
// extent, in widths of the shoulders where both are known, else in the file's unit, relative to the neck, or to the
// middle of the shoulders if one has no neck. Of the face: how much each unit is active, how fast the head turns, over
// the frames that were seen.
std::vector<MotionMeasures> measure_motions(std::span<const Motion> motions);

// The motion is brought to the reference's rate, and both are cut to the shorter one. Poses are compared in space where
// both have it, else in the picture; faces in the frames in which both were seen. Throws Error if they share neither a
// body nor a face, or have no such frame.
void measure_against(const Motion& motion, const Motion& reference, MotionMeasures& measures);

// How far the motion has come from the style of `source` to that of `target`: Dist_avg (style_distance.h) of the points
// that all three have, at the lowest of the three rates, each over its whole length; in the picture unless all are in
// space. Throws Error if one has no shoulders.
void measure_style(const Motion& motion, const Motion& source, const Motion& target,
                   MotionMeasures& measures);

// Frames that a reader bridged count, and a note says how many. Throws Error if one of the two faces has no AU12.
void measure_pair(const Motion& motion, const Motion& partner, MotionMeasures& measures);

// Beat alignment (BC) with the onsets of the sound of the upper body, relative to the middle of the shoulders
// (beat_alignment.h). A motion without shoulders has none, which a note says. Throws Error if the sound is shorter than
// 32 ms.
void measure_beats(const Motion& motion, const Audio& sound, MotionMeasures& measures);

// At the rate of `other` and cut to the shorter of both, with a note of what was changed.
std::pair<Motion, Motion> aligned(const Motion& motion, const Motion& other, std::vector<std::string>& notes);

// "body", "face", "near", "style", "pair", "beats": those that have rows.
std::vector<analysis::Table> tables_of(const std::vector<MotionMeasures>& all);
Json to_json(const MotionMeasures& measures);

}  // namespace chironomia::study
