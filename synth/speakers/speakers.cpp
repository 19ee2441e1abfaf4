#include "synth/speakers/speakers.h"

#include <algorithm>
#include <map>

#include "core/error.h"
#include "core/files/files.h"
#include "core/files/json_value.h"
#include "core/math.h"
#include "core/text.h"
#include "synth/speakers/languages.h"

namespace chironomia {
namespace {

namespace fs = std::filesystem;

constexpr double kMostLean = 17, kMostTurn = 25;  // [degrees]

Manner manner_in(const JsonValue& section) {
    std::vector<std::string> symbols;
    for (std::size_t i = 0; i < kExpressivities; ++i)
        symbols.emplace_back(symbol_of(static_cast<Expressivity>(i)));
    section.allow_only(symbols);
    Manner manner;
    for (const std::string& symbol : symbols) {
        const Expressivity dimension = *expressivity_named(symbol);
        if (const auto value = section.find(symbol))
            manner[dimension] = value->number(least_of(dimension), 1);
    }
    return manner;
}

std::array<double, 3> factors_in(const JsonValue& value) {
    const std::vector<JsonValue> items = value.items(3);
    if (items.size() > 3)
        value.refuse(format("has {} entries, 3 are needed: across, upward, forward", items.size()));
    return {items[0].number(0, 2), items[1].number(0, 2), items[2].number(0, 2)};
}

void read_space(const JsonValue& section, Speaker& speaker) {
    section.allow_only({"above", "below"});
    if (const auto above = section.find("above")) speaker.spatial_above = factors_in(*above);
    if (const auto below = section.find("below")) speaker.spatial_below = factors_in(*below);
}

void read_habits(const JsonValue& section, Speaker& speaker) {
    section.allow_only({"handedness", "lean_deg", "turn_deg", "height", "brow_gain", "nod_gain"});
    const auto angle = [](const JsonValue& value, double most) { return radians(value.number(-most, most)); };
    if (const auto value = section.find("handedness")) speaker.handedness = value->number(-1, 1);
    if (const auto value = section.find("lean_deg")) speaker.lean = angle(*value, kMostLean);
    if (const auto value = section.find("turn_deg")) speaker.turn = angle(*value, kMostTurn);
    if (const auto value = section.find("height")) speaker.height = value->number(-0.2, 0.2);
    if (const auto value = section.find("brow_gain")) speaker.brow_gain = value->number(0, 2);
    if (const auto value = section.find("nod_gain")) speaker.nod_gain = value->number(0, 2);
}

bool is_name_of_voice(const std::string& text) {
    return !text.empty() && std::all_of(text.begin(), text.end(), [](char c) {
        return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9') || c == '-';
    });
}

Voice voice_in(const JsonValue& section) {
    section.allow_only({"language", "variant", "pitch", "rate", "range"});
    Voice voice;
    if (const auto language = section.find("language")) voice.language = language_in(*language);
    if (const auto variant = section.find("variant"); variant && variant->json() != "") {
        voice.variant = variant->text();
        if (!is_name_of_voice(voice.variant))
            variant->refuse(format("is {}, a variant of espeak-ng is needed, such as m1 to m8 or f1 to f5",
                                   variant->shown()));
    }
    const auto whole = [&](const char* key, int usual, int least, int most) {
        const auto value = section.find(key);
        return value ? static_cast<int>(value->integer(least, most)) : usual;
    };
    voice.pitch = whole("pitch", voice.pitch, 0, 100);
    voice.rate = whole("rate", voice.rate, 80, 450);
    voice.range = whole("range", voice.range, 0, 100);
    return voice;
}

}  // namespace

const std::vector<std::string>& speaker_names(SpeakerGroup group) {
    static const std::map<SpeakerGroup, std::vector<std::string>> all = {
        {SpeakerGroup::example, {"neutral", "abrupt", "vigorous", "sluggish"}},
        {SpeakerGroup::seen,
         {"adrian", "beth", "carl", "doris", "edgar", "fiona", "gordon", "hilda", "ian", "jane", "keith",
          "laura", "martin", "nora", "oliver", "paula"}},
        {SpeakerGroup::inside, {"quentin", "rosa", "simon", "tessa"}},
        {SpeakerGroup::outside, {"victor", "wendy"}}};
    return all.at(group);
}

std::vector<std::string> speaker_names() {
    std::vector<std::string> names;
    for (const SpeakerGroup group :
         {SpeakerGroup::example, SpeakerGroup::seen, SpeakerGroup::inside, SpeakerGroup::outside}) {
        const std::vector<std::string>& more = speaker_names(group);
        names.insert(names.end(), more.begin(), more.end());
    }
    return names;
}

Speaker read_speaker(const fs::path& file) {
    const Json json = read_json(file);
    const JsonValue whole(json, file.string());
    whole.allow_only({"$schema", "expressivity", "space", "habits", "voice"});
    Speaker speaker{.name = file.stem().string()};
    if (const auto section = whole.find("expressivity")) speaker.manner = manner_in(*section);
    if (const auto section = whole.find("space")) read_space(*section, speaker);
    if (const auto section = whole.find("habits")) read_habits(*section, speaker);
    if (const auto section = whole.find("voice")) speaker.voice = voice_in(*section);
    return speaker;
}

std::string language_in(const JsonValue& value) {
    std::string language = language_named(value.text());
    if (!is_name_of_voice(language))
        value.refuse(
            format("is {}, a language of espeak-ng is needed, such as en-us, en-gb or fr", value.shown()));
    return language;
}

Speaker speaker_named(const std::string& name_or_file) {
    if (fs::path(name_or_file).has_extension()) return read_speaker(name_or_file);
    const std::vector<std::string> names = speaker_names();
    if (std::find(names.begin(), names.end(), name_or_file) == names.end()) {
        const auto meant = nearest_name(name_or_file, names);
        throw Error(
            format("speaker \"{}\": there is no such speaker; {}choose one of {}, or name a JSON file",
                   name_or_file, meant ? format("did you mean {}? ", *meant) : "", join(names)));
    }
    return read_speaker(find_asset(format("synth/speakers/{}.json", name_or_file)));
}

}  // namespace chironomia
