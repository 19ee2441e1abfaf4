#include "tests/support/glb_file.h"

#include <cstdint>
#include <cstring>

#include "core/files/files.h"

namespace chironomia::testing {

namespace fs = std::filesystem;

Glb read_glb(const fs::path& file) {
    const std::string bytes = read_text(file);
    std::uint32_t length = 0;
    std::memcpy(&length, bytes.data() + 12, sizeof length);
    return {.json = Json::parse(bytes.substr(20, length)), .binary = bytes.substr(20 + length + 8)};
}

void write_glb(const fs::path& file, Glb glb) {
    glb.binary.resize((glb.binary.size() + 3) / 4 * 4);
    if (!glb.json.contains("buffers")) glb.json["buffers"] = Json::array({Json::object()});
    glb.json["buffers"][0] = {{"byteLength", glb.binary.size()}};
    std::string text = glb.json.dump();
    text.resize((text.size() + 3) / 4 * 4, ' ');
    std::string bytes = "glTF";
    const auto number = [&](std::size_t value) {
        const auto little = static_cast<std::uint32_t>(value);
        bytes.append(reinterpret_cast<const char*>(&little), sizeof little);
    };
    number(2);
    number(12 + 8 + text.size() + 8 + glb.binary.size());
    number(text.size());
    bytes += "JSON" + text;
    number(glb.binary.size());
    bytes += std::string("BIN\0", 4) + glb.binary;
    write_text(file, bytes);
}

std::size_t start_of(const Glb& glb, const Json& accessor) {
    const Json& view = glb.json["bufferViews"][accessor["bufferView"].get<std::size_t>()];
    return view.value("byteOffset", std::size_t{0}) + accessor.value("byteOffset", std::size_t{0});
}

}  // namespace chironomia::testing
