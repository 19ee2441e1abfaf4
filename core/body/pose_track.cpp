#include "core/body/pose_track.h"

#include <algorithm>
#include <bit>
#include <cassert>
#include <cstring>
#include <type_traits>

namespace chironomia {
namespace {

static_assert(std::is_trivially_copyable_v<Transform> && sizeof(Transform) == 10 * sizeof(float),
              "a transform is ten numbers without gaps");

// Not by value: two zeros of different sign are equal, and a number that is none is not equal to itself.
bool same_bits(float a, float b) {
    return std::bit_cast<std::uint32_t>(a) == std::bit_cast<std::uint32_t>(b);
}

}  // namespace

Pose PoseTrack::operator[](std::size_t frame) const {
    assert(frame < size());
    std::vector<float> row(width());
    read_row(frame, row);
    Pose pose{.joints = std::vector<Transform>(joints_), .morph_weights = std::vector<float>(morphs_)};
    const std::size_t turning = row.size() - morphs_;
    if (joints_ > 0)
        std::memcpy(static_cast<void*>(pose.joints.data()), row.data(), joints_ * sizeof(Transform));
    std::copy(row.begin() + static_cast<std::ptrdiff_t>(turning), row.end(), pose.morph_weights.begin());
    return pose;
}

void PoseTrack::push_back(const Pose& pose) {
    if (empty()) {
        joints_ = pose.joints.size();
        morphs_ = pose.morph_weights.size();
    }
    assert(pose.joints.size() == joints_ && pose.morph_weights.size() == morphs_);
    const std::size_t begin = open_.size();
    open_.resize(begin + width());
    if (joints_ > 0) std::memcpy(open_.data() + begin, pose.joints.data(), joints_ * sizeof(Transform));
    std::copy(pose.morph_weights.begin(), pose.morph_weights.end(),
              open_.end() - static_cast<std::ptrdiff_t>(morphs_));
    if (++open_frames_ < kStretch) return;
    packed_.push_back(pack());
    open_.clear();
    open_frames_ = 0;
}

void PoseTrack::hold_to(std::size_t frames) {
    assert(!empty());
    const Pose last = back();
    while (size() < frames) push_back(last);
    if (size() == frames) return;
    // The stretch that ends within is opened again.
    std::vector<float> rows(frames % kStretch * width());
    for (std::size_t i = 0; i < frames % kStretch; ++i)
        read_row(frames - frames % kStretch + i, std::span(rows).subspan(i * width(), width()));
    packed_.resize(frames / kStretch);
    open_ = std::move(rows);
    open_frames_ = frames % kStretch;
}

void PoseTrack::read_row(std::size_t frame, std::span<float> row) const {
    const std::size_t within = frame % kStretch;
    if (frame / kStretch == packed_.size()) {
        const auto from = open_.begin() + static_cast<std::ptrdiff_t>(within * width());
        std::copy(from, from + static_cast<std::ptrdiff_t>(width()), row.begin());
        return;
    }
    const Stretch& stretch = packed_[frame / kStretch];
    std::copy(stretch.first.begin(), stretch.first.end(), row.begin());
    const std::size_t count = stretch.moving.size();
    for (std::size_t i = 0; i < count; ++i) row[stretch.moving[i]] = stretch.values[within * count + i];
}

PoseTrack::Stretch PoseTrack::pack() const {
    const std::size_t width = this->width();
    Stretch stretch;
    stretch.first.assign(open_.begin(), open_.begin() + static_cast<std::ptrdiff_t>(width));
    for (std::size_t n = 0; n < width; ++n) {
        bool moves = false;
        for (std::size_t t = 1; t < kStretch && !moves; ++t)
            moves = !same_bits(open_[t * width + n], open_[n]);
        if (moves) stretch.moving.push_back(static_cast<std::uint32_t>(n));
    }
    stretch.moving.shrink_to_fit();
    stretch.values.reserve(kStretch * stretch.moving.size());
    for (std::size_t t = 0; t < kStretch; ++t) {
        for (const std::uint32_t n : stretch.moving) stretch.values.push_back(open_[t * width + n]);
    }
    return stretch;
}

}  // namespace chironomia
