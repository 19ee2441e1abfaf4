#include "raster/images/image_file.h"

#include <dlfcn.h>

#include <fstream>
#include <optional>
#include <string_view>

#include "core/error.h"
#include "core/files/files.h"
#include "core/input_file.h"
#include "core/text.h"
#include "raster/images/image_module.h"

namespace chironomia {
namespace fs = std::filesystem;
namespace {

// Where the module may lie: beside the program, installed below it, or where it was built.
std::vector<fs::path> module_places() {
    std::error_code ignored;
    const fs::path folder = fs::read_symlink("/proc/self/exe", ignored).parent_path();
    return {folder / kImageModuleFile, folder.parent_path() / "lib/chironomia" / kImageModuleFile,
            fs::path(CHIRONOMIA_IMAGE_MODULE_FOLDER) / kImageModuleFile};
}

std::optional<ImageKind> kind_of_content(std::string_view bytes) {
    if (bytes.starts_with("\x89PNG\r\n\x1a\n")) return ImageKind::png;
    if (bytes.starts_with("\x76\x2f\x31\x01")) return ImageKind::exr;
    return std::nullopt;
}

ImageKind kind_of_name(const fs::path& file) {
    const std::string ending = to_lower(file.extension().string());
    if (ending == ".png") return ImageKind::png;
    if (ending == ".exr") return ImageKind::exr;
    throw Error(format("{}: an image cannot end in \"{}\"; name it .png or .exr", file.string(), ending));
}

}  // namespace

ImageModule load_image_module(const std::vector<fs::path>& places) {
    std::vector<std::string> missing;
    for (const fs::path& place : places) {
        if (!fs::exists(place)) {
            missing.push_back(place.string());
            continue;
        }
        void* library = dlopen(place.c_str(), RTLD_NOW | RTLD_LOCAL);
        void* entry = library ? dlsym(library, kImageModuleEntry) : nullptr;
        if (!entry) {
            throw Error(format("{}: cannot be loaded ({}); install it and OpenImageIO again", place.string(),
                               dlerror()));
        }
        return reinterpret_cast<ImageModule (*)()>(entry)();
    }
    throw Error(
        format("{}: not found, and images need it; it was looked for at {}; install it beside the program",
               kImageModuleFile, join(missing)));
}

const ImageModule& image_module() {
    static const ImageModule module = load_image_module(module_places());
    return module;
}

Frame read_image(const fs::path& file) {
    const std::vector<std::byte> bytes = read_bytes(file);
    const auto kind = kind_of_content({reinterpret_cast<const char*>(bytes.data()), bytes.size()});
    if (!kind) throw Error(format("{}: is neither PNG nor EXR; convert it to one of them", file.string()));
    return image_module().decode(bytes, *kind, file.string());
}

void write_image(const fs::path& file, const Frame& frame) {
    const ImageKind kind = kind_of_name(file);
    write_bytes(file, image_module().encode(frame, kind, file.string()));
}

std::vector<std::byte> encode_png(const Frame& frame) {
    return image_module().encode(frame, ImageKind::png, "picture.png");
}

bool is_image(const fs::path& file) {
    expect_file(file);
    std::ifstream stream(file, std::ios::binary);
    if (!stream)
        throw Error(format("{}: cannot be opened; check the path and its permissions", file.string()));
    std::string head(8, '\0');
    stream.read(head.data(), static_cast<std::streamsize>(head.size()));
    return kind_of_content(head.substr(0, static_cast<size_t>(stream.gcount()))).has_value();
}

bool has_image_name(const fs::path& file) {
    const std::string ending = to_lower(file.extension().string());
    return ending == ".png" || ending == ".exr";
}

}  // namespace chironomia
