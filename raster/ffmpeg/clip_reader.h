// The pictures of a clip, one after the other.
#pragma once

#include <cstddef>
#include <filesystem>
#include <memory>
#include <optional>

#include "core/render/frame.h"

namespace chironomia {

class ClipReader {
  public:
    // Throws Error if the file is missing, holds no pictures or is of no known kind.
    explicit ClipReader(const std::filesystem::path& file);
    ~ClipReader();
    ClipReader(ClipReader&&) noexcept;

    // The next picture in sRGB, opaque; nothing after the last. The same bytes every time.
    // Throws Error, naming the frame, if the clip is damaged, is cut off or changes its size.
    std::optional<Frame> next();

  private:
    struct Parts;
    std::unique_ptr<Parts> parts_;
};

}  // namespace chironomia
