#include "core/files/wav_file.h"

#include <cstdint>

#include "core/files/files.h"

namespace chironomia {
namespace {

void append_number(std::string& text, std::uint32_t value, int bytes) {
    for (int i = 0; i < bytes; ++i) text.push_back(static_cast<char>(value >> (8 * i) & 255));
}

}  // namespace

std::string to_wav(const Audio& sound) {
    const auto bytes = static_cast<std::uint32_t>(sound.samples.size() * 4);
    const auto rate = static_cast<std::uint32_t>(sound.rate);
    const auto channels = static_cast<std::uint32_t>(sound.channels);
    std::string text = "RIFF";
    append_number(text, 36 + bytes, 4);
    text += "WAVEfmt ";
    append_number(text, 16, 4);
    append_number(text, 3, 2);  // 32-bit float
    append_number(text, channels, 2);
    append_number(text, rate, 4);
    append_number(text, rate * channels * 4, 4);
    append_number(text, channels * 4, 2);
    append_number(text, 32, 2);
    text += "data";
    append_number(text, bytes, 4);
    text.append(reinterpret_cast<const char*>(sound.samples.data()), bytes);
    return text;
}

void write_wav(const std::filesystem::path& file, const Audio& sound) {
    write_text(file, to_wav(sound));
}

}  // namespace chironomia
