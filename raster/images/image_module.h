// What the module that holds OpenImageIO and FreeType offers to the rest of this folder. Linking OpenImageIO
// costs half a second at every start of a program; loading the module when the first image is read or written
// does not.
#pragma once

#include <cstddef>
#include <filesystem>
#include <span>
#include <string>
#include <vector>

#include "core/render/frame.h"

namespace chironomia {

enum class ImageKind { png, exr };

struct TextStyle {
    std::string font;  // a file
    int size = 0;      // [px]
};

// All throw Error; `name` is the file that its message names. All may be called from several threads.
struct ImageModule {
    std::vector<std::byte> (*encode)(const Frame& frame, ImageKind kind, const std::string& name);
    Frame (*decode)(std::span<const std::byte> bytes, ImageKind kind, const std::string& name);
    int (*text_width)(const std::u32string& line, const TextStyle& style);
    Frame (*draw_text)(const std::u32string& line, const TextStyle& style);
};

// Loads the first of the files that exists. Throws Error if none does, or if it is no such module.
ImageModule load_image_module(const std::vector<std::filesystem::path>& places);

// The one of this program, loaded with the first call.
const ImageModule& image_module();

constexpr const char* kImageModuleFile = "libchironomia_images.so";
constexpr const char* kImageModuleEntry = "chironomia_image_module_2";  // ImageModule f()

}  // namespace chironomia
