// A film of any size, rate and shape, as pictures of one size at one rate.
#pragma once

#include <cstddef>
#include <filesystem>
#include <memory>

#include "core/render/frame.h"
#include "core/render/rate.h"
#include "core/render/renderer.h"

namespace chironomia {

struct FilmSpec {
    RenderSize size = {};  // of the pictures
    Rate fps = {};
    // Time of the first picture [s]; 0 is the first sample of sound, without sound the first frame.
    double begin = 0;
};

class FilmReader {
  public:
    // Throws Error if the file is missing, cut off, holds no pictures, is of no known kind, or is rotated by other than
    // 90-degree steps.
    FilmReader(const std::filesystem::path& file, const FilmSpec& spec);
    ~FilmReader();
    FilmReader(FilmReader&&) noexcept;

    // The next picture: of the film's frames the one nearest in time, of two the earlier; before the film
    // begins its first and after its end its last. It is turned as the file says that it is to be shown,
    // scaled without distortion as large as it fits, with black beside or above. The same bytes every time.
    // Throws Error, naming the frame, if the film is damaged.
    Frame next();

    // How long the film lasts from FilmSpec::begin = 0 on [s].
    double seconds() const;

  private:
    struct Parts;
    std::unique_ptr<Parts> parts_;
};

}  // namespace chironomia
