#include "skinning/gltf/fbx_file.h"

#include <cstdint>
#include <optional>
#include <string>

#include "core/error.h"
#include "core/text.h"

namespace chironomia {
namespace {

// The first bytes of every binary FBX file, and the version behind them: 7400 is 7.4.
constexpr std::string_view kBinaryMagic{"Kaydara FBX Binary  \0\x1a\0", 23};

constexpr std::uint32_t kOldestOfBlender = 7100;  // Blender reads no older binary one, and none as text

std::uint32_t version_of_binary(std::string_view content) {
    std::uint32_t version = 0;
    for (size_t i = 0; i < 4; ++i)
        version |= static_cast<std::uint32_t>(static_cast<unsigned char>(content[kBinaryMagic.size() + i]))
                   << 8 * i;
    return version;
}

// "; FBX 7.3.0 project file": the version, or nothing if it is no FBX as text.
std::optional<std::string> version_of_text(std::string_view content) {
    const std::string_view line = trim(content.substr(0, content.substr(0, 200).find('\n')));
    constexpr std::string_view kBegin = "; FBX ";
    if (!line.starts_with(kBegin) || line.find("project file") == std::string_view::npos) return std::nullopt;
    return std::string(split(line.substr(kBegin.size()), ' ').front());
}

}  // namespace

void refuse_fbx(const std::filesystem::path& file, std::string_view content) {
    std::string kind, blender;
    const std::string from = file.string(),
                      to = std::filesystem::path(file).replace_extension(".glb").string();
    if (content.starts_with(kBinaryMagic) && content.size() >= kBinaryMagic.size() + 4) {
        const std::uint32_t version = version_of_binary(content);
        kind = format("a binary FBX file of version {}.{}", version / 1000, version % 1000 / 100);
        if (version >= kOldestOfBlender) {
            blender = format(
                "Blender: blender --background --python-expr \"import bpy; "
                "bpy.ops.wm.read_factory_settings(use_empty=True); bpy.ops.import_scene.fbx(filepath='{}'); "
                "bpy.ops.export_scene.gltf(filepath='{}')\" or with ",
                from, to);
        }
    } else if (const auto version = version_of_text(content)) {
        kind = format("an FBX file of version {} as text", *version);
    } else {
        return;
    }
    throw Error(format(
        "{}: is {}, and glTF 2.0 is read; make glTF of it with {}FBX2glTF: FBX2glTF --binary --input {} "
        "--output {}",
        from, kind, blender, from, to));
}

}  // namespace chironomia
