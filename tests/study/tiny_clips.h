// Files that are built like clips but hold no pictures: for tests of names, sizes and times.
#pragma once

#include <string>

namespace chironomia::testing {

// `ftyp` (16 bytes), `moov` (16 bytes) and `mdat` with `payload`; `moov` holds `note`, cut or filled to 8
// bytes.
inline std::string tiny_mp4(const std::string& payload, std::string note = "") {
    const auto box = [](const std::string& type, const std::string& body) {
        const auto size = static_cast<unsigned>(body.size() + 8);
        std::string bytes;
        for (int shift = 24; shift >= 0; shift -= 8) bytes += static_cast<char>(size >> shift & 0xff);
        return bytes + type + body;
    };
    if (note.size() < 8) note.resize(8, '\0');
    return box("ftyp", std::string("isom\0\0\2\0", 8)) + box("moov", note) + box("mdat", payload);
}

// An EBML header, and a segment of an info element with `note` and one cluster with `payload`; both under 100
// bytes.
inline std::string tiny_webm(const std::string& payload, const std::string& note = "") {
    const auto element = [](const std::string& id, const std::string& body) {
        return id + static_cast<char>(0x80 | body.size()) + body;
    };
    return element("\x1a\x45\xdf\xa3", "webm") +
           element("\x18\x53\x80\x67",
                   element("\x15\x49\xa9\x66", note) + element("\x1f\x43\xb6\x75", payload));
}

}  // namespace chironomia::testing
