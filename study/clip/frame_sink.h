// Where finished frames go, whatever the output is: a clip, or a stack of pictures.
#pragma once

#include <deque>
#include <future>
#include <memory>
#include <optional>

#include "core/audio.h"
#include "core/render/frame.h"
#include "study/clip/clip.h"

namespace chironomia::study {

// Encodes and writes on another thread, in order, holding a bounded number of frames.
class FrameSink {
  public:
    // `sound` is as long as the clip; a stack of frames has none. Throws Error if `job.out` is no clip or
    // stack or cannot be written.
    FrameSink(const ClipJob& job, const std::optional<Audio>& sound);
    ~FrameSink();

    void write(Frame frame);  // throws Error if an earlier frame could not be written
    void finish();            // everything is written and gets its final name

  private:
    struct Target;

    void finish_oldest();

    std::unique_ptr<Target> target_;
    std::size_t written_ = 0;
    std::deque<std::future<void>> under_way_;
};

}  // namespace chironomia::study
