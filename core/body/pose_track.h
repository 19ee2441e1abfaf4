// The poses of a clip without what they repeat: a long clip would fill the memory otherwise.
#pragma once

#include <cstddef>
#include <cstdint>
#include <initializer_list>
#include <span>
#include <utility>
#include <vector>

#include "core/body/avatar.h"

namespace chironomia {

// T poses of one avatar, read and written one after the other. Within a stretch of frames each number that
// does not change is kept once; what is read is what was written, bit by bit.
class PoseTrack {
  public:
    class Iterator {
      public:
        using value_type = Pose;
        using difference_type = std::ptrdiff_t;
        using reference = Pose;
        using pointer = void;
        using iterator_category = std::input_iterator_tag;

        Iterator(const PoseTrack& track, std::size_t frame) : track_(&track), frame_(frame) {}
        Pose operator*() const { return (*track_)[frame_]; }
        Iterator& operator++() {
            ++frame_;
            return *this;
        }
        bool operator==(const Iterator&) const = default;

      private:
        const PoseTrack* track_;
        std::size_t frame_;
    };

    PoseTrack() = default;
    PoseTrack(std::initializer_list<Pose> poses) {
        for (const Pose& pose : poses) push_back(pose);
    }

    std::size_t size() const { return packed_.size() * kStretch + open_frames_; }
    bool empty() const { return size() == 0; }
    Pose operator[](std::size_t frame) const;  // `frame` is below size()
    Pose front() const { return (*this)[0]; }
    Pose back() const { return (*this)[size() - 1]; }
    Iterator begin() const { return {*this, 0}; }
    Iterator end() const { return {*this, size()}; }

    // All poses have as many joints and as many morph weights as the first.
    void push_back(const Pose& pose);

    // From now on so many frames: later ones are dropped, or the last one is held. There must be one.
    void hold_to(std::size_t frames);

    // Makes each pose what `change` (frame, pose) returns, of the same shape, from the first to the last.
    template <typename Change>
    void change(Change change) {
        PoseTrack changed;
        const std::size_t frames = size();
        for (std::size_t t = 0; t < frames; ++t) {
            changed.push_back(change(t, (*this)[t]));
            if ((t + 1) % kStretch == 0) packed_[t / kStretch] = {};
        }
        *this = std::move(changed);
    }

  private:
    static constexpr std::size_t kStretch = 64;  // frames; ours: below, the first row of each would weigh

    // kStretch rows of numbers.
    struct Stretch {
        std::vector<float> first;           // the first row
        std::vector<std::uint32_t> moving;  // which numbers differ from it in a later one
        std::vector<float> values;          // of those in each row
    };

    std::size_t width() const { return joints_ * sizeof(Transform) / sizeof(float) + morphs_; }
    void read_row(std::size_t frame, std::span<float> row) const;
    Stretch pack() const;

    std::size_t joints_ = 0, morphs_ = 0;
    std::vector<Stretch> packed_;
    std::vector<float> open_;  // rows that do not make up a stretch yet
    std::size_t open_frames_ = 0;
};

}  // namespace chironomia
