// How motions move, and how near they are to a reference: every metric that two files allow.
#pragma once

#include <optional>
#include <span>
#include <string>
#include <vector>

#include "core/audio.h"
#include "core/body/motion.h"
#include "core/files/json.h"
#include "study/analysis/table.h"
#include "study/measure/movement.h"

namespace chironomia::study {

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
// middle of the shoulders if one has no neck. Of the face: how much each unit is active, how fast the head turns.
std::vector<MotionMeasures> measure_motions(std::span<const Motion> motions);

// The motion is brought to the reference's rate, and both are cut to the shorter one. Poses are compared in space where
// both have it, else in the picture. Throws Error if they share neither a body nor a face.
void measure_against(const Motion& motion, const Motion& reference, MotionMeasures& measures);

// How far the motion has come from the style of `source` to that of `target`: Dist_avg (style_distance.h) of the points
// that all three have, at the lowest of the three rates, each over its whole length; in the picture unless all are in
// space. Throws Error if one has no shoulders.
void measure_style(const Motion& motion, const Motion& source, const Motion& target,
                   MotionMeasures& measures);

// Throws Error if one of both faces has no AU12.
void measure_pair(const Motion& motion, const Motion& partner, MotionMeasures& measures);

// Beat alignment (BC) with the onsets of the sound of the upper body, relative to the middle of the shoulders
// (beat_alignment.h). A motion without shoulders has none, which a note says. Throws Error if the sound is shorter than
// 32 ms.
void measure_beats(const Motion& motion, const Audio& sound, MotionMeasures& measures);

// Of a folder, which `of` names: the mean over its files of each number, of features that all of them have; the notes say what was left out, and how many
// files have no PCC or the like.
MotionMeasures mean_of(const std::string& of, std::span<const MotionMeasures> all);

// The upper bodies of many pairs of a motion and its reference, in widths of the shoulders and relative to their middle:
// all poses of the ones against all of the others, by the squared Frechet distance (frechet.h), and so the changes from
// frame to frame, at the rates of the references. No learned encoder is in between, so these are not the FGD of papers.
class PoseClouds {
  public:
    PoseClouds();

    void add(const Motion& motion, const Motion& reference);
    // As a row of `near`: null where there are too few frames. None without a pair that has both shoulders. A point
    // counts if all files have it, depth if all have it.
    std::optional<Json> row() const;

  private:
    struct Cloud {
        PointPaths poses, changes;
    };

    std::vector<bool> shared_;  // by point of the upper body
    bool flat_ = false;
    Cloud people_, model_;
};

// "body", "face", "near", "style", "pair", "beats": those that have rows.
std::vector<analysis::Table> tables_of(const std::vector<MotionMeasures>& all);
Json to_json(const MotionMeasures& measures);

}  // namespace chironomia::study
