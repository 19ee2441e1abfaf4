#include "study/plan/secret_names.h"

#include <algorithm>
#include <cassert>
#include <cstring>
#include <set>
#include <span>

#include "core/files/files.h"
#include "core/text.h"
#include "study/clip/container.h"
#include "study/plan/plan.h"
#include "study/plan/presets.h"

namespace chironomia::study {
namespace fs = std::filesystem;
namespace {

constexpr std::size_t kShortestInClip = 4;     // letters
constexpr std::size_t kShortestInPayload = 8;  // letters

// Texts that every clip has, whatever it shows.
const std::vector<std::string> kFixedTexts = {"videohandler",
                                              "soundhandler",
                                              std::string("vide") + std::string(12, '\0') + "video",
                                              std::string("soun") + std::string(12, '\0') + "sound",
                                              "matroska",
                                              "webm",
                                              "lavf"};

std::set<std::string> parts_of(const Plan& plan, const fs::path& path) {
    std::set<std::string> parts;
    for (const fs::path& part : path.lexically_relative(plan.file.parent_path())) {
        if (part != "." && part != "..") parts.insert(part.stem().string());
    }
    return parts;
}

// What the paths of a clip's motions, or of its faces, do not all share.
std::set<std::string> revealing_parts(const Plan& plan, std::vector<fs::path> files) {
    std::erase_if(files, [](const fs::path& file) { return file.empty(); });  // of what the program makes
    if (files.empty()) return {};
    std::set<std::string> shared = parts_of(plan, files.front());
    std::set<std::string> all;
    for (const fs::path& file : files) {
        const std::set<std::string> parts = parts_of(plan, file);
        std::erase_if(shared, [&](const std::string& part) { return parts.count(part) == 0; });
        all.insert(parts.begin(), parts.end());
    }
    std::erase_if(all, [&](const std::string& part) { return shared.count(part) > 0; });
    return all;
}

bool is_letter(unsigned char c) {
    return (c >= 'a' && c <= 'z') || (c >= '0' && c <= '9') || c == '_' || c >= 0x80;
}

std::string as_utf16(std::string_view text, bool high_first) {
    std::string wide;
    for (const char c : text) {
        if (high_first) wide += '\0';
        wide += c;
        if (!high_first) wide += '\0';
    }
    return wide;
}

// The characters of Base64 that `text` is sure to make when `before` bytes (0 to 2) stand in front of it.
std::string as_base64(std::string_view text, std::size_t before) {
    static constexpr std::string_view kDigits =
        "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
    std::string encoded;
    unsigned bits = 0;
    int held = 0;
    // The first whole digit of `text` begins 0, 4 or 2 bits into it.
    int skip = before == 0 ? 0 : before == 1 ? 4 : 2;
    for (const char c : text) {
        bits = bits << 8 | static_cast<unsigned char>(c);
        held += 8 - skip;
        skip = 0;
        for (; held >= 6; held -= 6) encoded += kDigits[bits >> (held - 6) & 63];
    }
    return encoded;
}

// Two digits for each byte.
std::string as_hex(std::string_view text) {
    std::string digits;
    for (const char c : text) digits += format("{:02x}", static_cast<unsigned char>(c));
    return digits;
}

// Each letter of a text in lower case becomes the one that is 13 further in the alphabet.
std::string as_rot13(std::string text) {
    for (char& c : text) {
        if (c >= 'a' && c <= 'z') c = static_cast<char>('a' + (c - 'a' + 13) % 26);
    }
    return text;
}

std::uint32_t first_four(std::string_view bytes) {
    std::uint32_t number = 0;
    std::memcpy(&number, bytes.data(), sizeof number);
    return number;
}

std::size_t first_two(std::string_view bytes) {
    return static_cast<std::size_t>(static_cast<unsigned char>(bytes[0]) << 8 |
                                    static_cast<unsigned char>(bytes[1]));
}

bool is_payload(const ContainerBox& box) {
    return box.type == "mdat" || box.type == "1f43b675";  // the latter: a cluster of WebM
}

// Everything of a clip but its compressed pictures and sounds, without what every clip holds.
std::string structure_of(const std::string& bytes, const std::vector<ContainerBox>& boxes) {
    std::string structure;
    for (const ContainerBox& box : boxes) {
        const std::uint64_t end = is_payload(box) ? box.body : box.end;
        structure.append(bytes, box.begin, end - box.begin);
    }
    const std::string lower = to_lower(structure);
    for (const std::string& fixed : kFixedTexts) {
        for (std::size_t at = lower.find(fixed); at != std::string::npos; at = lower.find(fixed, at + 1)) {
            structure.replace(at, fixed.size(), fixed.size(), '\0');
        }
    }
    return structure;
}

}  // namespace

std::vector<std::string> secret_names(const Plan& plan) {
    std::set<std::string> names;
    names.insert(plan.render.avatar.stem().string());
    for (const PlanClip& clip : plan.clips) {
        if (!clip.audio.empty()) names.insert(clip.audio.stem().string());
        if (!clip.script.empty()) names.insert(clip.script.stem().string());
        if (!clip.partner) continue;
        const PlanPartner& partner = *clip.partner;
        for (const fs::path& file : {partner.motion, partner.face, partner.audio, partner.avatar}) {
            if (!file.empty()) names.insert(file.stem().string());
        }
    }
    for (const std::string& bundled : avatar_names()) names.erase(bundled);
    for (const PlanCondition& condition : plan.conditions) names.insert(condition.name);
    for (const PlanClip& clip : plan.clips) {
        names.insert(clip.id);
        names.merge(revealing_parts(plan, clip.motions));
        names.merge(revealing_parts(plan, clip.faces));
    }
    return {names.begin(), names.end()};
}

std::optional<std::string> find_word(std::string_view text, const std::vector<std::string>& names) {
    const std::string lower_text = to_lower(text);
    for (const std::string& name : names) {
        const std::string lower = to_lower(name);
        for (std::size_t at = lower_text.find(lower); at != std::string::npos;
             at = lower_text.find(lower, at + 1)) {
            const std::size_t end = at + lower.size();
            const bool begins = at == 0 || !is_letter(static_cast<unsigned char>(lower_text[at - 1]));
            const bool ends =
                end == lower_text.size() || !is_letter(static_cast<unsigned char>(lower_text[end]));
            if (begins && ends) return name;
        }
    }
    return std::nullopt;
}

std::optional<std::string> find_condition(std::string_view text, const std::vector<std::string>& conditions) {
    for (const std::string_view line : split(text, '\n')) {
        if (is_text_of_a_preset(line)) continue;
        if (auto name = find_word(line, conditions)) return name;
    }
    return std::nullopt;
}

void SoughtTexts::add(std::string text, std::size_t name) {
    assert(text.size() >= sizeof(std::uint32_t));
    may_begin_[first_two(text)] = true;
    const std::uint32_t begin = first_four(text);
    texts_.emplace(begin, Text{std::move(text), name});
}

std::optional<std::size_t> SoughtTexts::find(std::string_view bytes) const {
    std::optional<std::size_t> least;
    for (; bytes.size() >= sizeof(std::uint32_t); bytes.remove_prefix(1)) {
        if (!may_begin_[first_two(bytes)]) continue;
        const auto [begin, end] = texts_.equal_range(first_four(bytes));
        for (auto text = begin; text != end; ++text) {
            const bool is_first = !least || text->second.name < *least;
            if (is_first && bytes.starts_with(text->second.bytes)) least = text->second.name;
        }
    }
    return least;
}

NamesInClips::NamesInClips(std::vector<std::string> names) : names_(std::move(names)) {
    for (std::size_t i = 0; i < names_.size(); ++i) {
        const std::string& name = names_[i];
        if (name.size() < kShortestInClip) continue;
        const std::string lower = to_lower(name);
        for (const std::string& form : {lower, as_utf16(lower, true), as_utf16(lower, false), as_hex(lower),
                                        as_hex(name), as_rot13(lower)})
            in_lower_structure_.add(form, i);
        for (std::size_t before = 0; before < 3; ++before) {
            const std::string encoded = as_base64(name, before);
            if (encoded.size() >= kShortestInClip) in_structure_.add(encoded, i);
        }
        if (name.size() >= kShortestInPayload) in_lower_bytes_.add(lower, i);
    }
}

std::optional<std::string> NamesInClips::find(const fs::path& clip) const {
    const std::vector<ContainerBox> boxes = read_boxes(clip);
    const std::string bytes = read_text(clip);
    const std::string structure = structure_of(bytes, boxes);
    std::optional<std::size_t> least;
    for (const auto& found : {in_lower_structure_.find(to_lower(structure)), in_structure_.find(structure),
                              in_lower_bytes_.find(to_lower(bytes))}) {
        if (found && (!least || *found < *least)) least = found;
    }
    return least ? std::optional(names_[*least]) : std::nullopt;
}

}  // namespace chironomia::study
