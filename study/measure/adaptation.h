// Synchrony and entrainment of smiles of two people. Woo et al. (ICAART 2023) measure it by synchrony and
// entrainment loops; their definitions are not at hand, so ours are called "proposed" (ambiguity A67): they
// compare a model with people on the same recordings, never with published numbers. The originals can stand
// beside them in adaptation_measures(). The proposal counts frames; ours are seconds, which hold at any rate.
#pragma once

#include <cstddef>
#include <functional>
#include <span>
#include <string>
#include <vector>

namespace chironomia::study {

// A stretch in which a unit is active, frames [onset, offset).
struct ActiveRun {
    std::size_t onset = 0;
    std::size_t offset = 0;

    std::size_t length() const { return offset - onset; }
    bool operator==(const ActiveRun&) const = default;
};

// Runs above `threshold`, ascending: pauses of at most 0.12 s are bridged, and then runs of less than 0.2 s
// left out (3 and 5 frames at 25 per second).
std::vector<ActiveRun> active_runs(std::span<const float> intensities, double fps, double threshold = 0.5);

// What both people did over so many frames.
struct PairedRuns {
    std::vector<ActiveRun> a;
    std::vector<ActiveRun> u;
    std::size_t frames = 0;
    double fps = 25;
};

// Over every run of a and every run of u that begin at most 2 s apart: the time that they share once their onsets are
// laid over each other, which is the length of the shorter one [s/min].
double synchrony(const PairedRuns& runs);

// Over every run that begins a loop: the other person's first run from then on that begins within 2 s or
// before the run ends, and the first person's first run after that one's onset, which follows it in the same
// way; the loop goes from the first onset to the last offset [s/min].
double entrainment(const PairedRuns& runs);

struct AdaptationMeasure {
    std::string key;     // "sync"
    std::string title;   // "Sync"
    std::string unit;    // "s/min"
    std::string origin;  // whose definition: "proposed"
    std::function<double(const PairedRuns&)> measure;
};

const std::vector<AdaptationMeasure>& adaptation_measures();

}  // namespace chironomia::study
