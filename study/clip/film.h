// A film of a real person as the stimulus of a condition.
#pragma once

#include <cstddef>

#include "core/render/frame.h"
#include "raster/ffmpeg/film_reader.h"
#include "study/clip/clip.h"

namespace chironomia::study {

// Whether a file is a film (MP4, WebM, AVI), by its first bytes; false if it cannot be read.
bool is_film(const std::filesystem::path& file);

// The frames of a clip of which the only performer is a film.
class Film {
  public:
    // Throws Error if there is somebody else in the clip, if the film cannot be read, or if the cut reaches
    // beyond its end.
    explicit Film(const ClipJob& job);

    std::size_t frames() const { return frames_; }  // without holding its last; at least 1

    // The next frame; after the last one, the last one again.
    const Frame& next();

  private:
    Film(const ClipJob& job, const CutFrames& shown);

    FilmReader reader_;
    std::size_t frames_;
    std::size_t shown_ = 0;
    Frame picture_;
};

}  // namespace chironomia::study
