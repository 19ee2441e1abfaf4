#include "synth/presence/dialog_file.h"

#include <string>

#include "core/error.h"
#include "core/files/files.h"
#include "core/files/json_value.h"
#include "core/math.h"
#include "core/text.h"
#include "synth/markup/markup.h"
#include "synth/speakers/speakers.h"

namespace chironomia {
namespace {

namespace fs = std::filesystem;

const std::vector<std::string> kScriptKeys = {"text", "aplm", "bml", "ssml", "file"};

// What may be a bundled name, or a file beside the dialog.
Speaker speaker_in(const JsonValue& value, const fs::path& folder) {
    const std::string name = value.text();
    try {
        return speaker_named(fs::path(name).has_extension() ? (folder / name).string() : name);
    } catch (const Error& fault) {
        value.refuse(fault.what());
    }
}

DialogScript::Person person_in(const JsonValue& value, const fs::path& folder) {
    constexpr double kFarthest = 45;  // to either side; ours [degrees]
    value.allow_only({"speaker", "language", "partner_deg"});
    DialogScript::Person person{.speaker = speaker_in(value.at("speaker"), folder)};
    if (const auto language = value.find("language")) person.speaker.voice.language = language_in(*language);
    if (const auto partner = value.find("partner_deg"))
        person.partner = radians(partner->number(-kFarthest, kFarthest));
    return person;
}

Coupling coupling_in(const JsonValue& value) {
    value.allow_only({"strength", "delay_s"});
    // The ranges of the corpora that we make; see Coupling.
    constexpr double kStrongest = 0.8, kShortestDelay = 0.3, kLongestDelay = 1.2;  // the delays in [s]
    Coupling coupling;
    if (const auto strength = value.find("strength")) coupling.strength = strength->number(0, kStrongest);
    if (const auto delay = value.find("delay_s"))
        coupling.delay = delay->number(kShortestDelay, kLongestDelay);
    return coupling;
}

// The one script of a turn, under any of kScriptKeys.
JsonValue script_in(const JsonValue& turn) {
    std::vector<JsonValue> scripts;
    for (const std::string& key : kScriptKeys)
        if (const auto script = turn.find(key)) scripts.push_back(*script);
    if (scripts.size() != 1)
        turn.refuse(
            format("has {} scripts, 1 is needed; write one of {}", scripts.size(), join(kScriptKeys)));
    return scripts.front();
}

DialogTurn turn_in(const JsonValue& value, const DialogScript& dialog, const fs::path& file) {
    std::vector<std::string> keys = kScriptKeys;
    keys.push_back("person");
    value.allow_only(keys);
    DialogTurn turn{.person = static_cast<std::size_t>(value.at("person").integer(0, 1))};
    const JsonValue script = script_in(value);
    const std::string& language = dialog.people[turn.person].speaker.voice.language;
    const std::string key = script.key().substr(script.key().rfind('.') + 1);
    if (key == "file") {
        const fs::path named = file.parent_path() / script.text();
        turn.text =
            parse_marked_text({.text = read_text(named), .name = named.string(), .language = language});
        return turn;
    }
    // JsonValue::text() refuses line breaks, which a script may have.
    if (!script.json().is_string())
        script.refuse(format("is {}, a text in quotes is needed", script.shown()));
    const MarkupSource source{.text = script.json().get<std::string>(),
                              .name = format("{}: {}", file.string(), script.key()),
                              .language = language};
    turn.text =
        parse_marked_text(source, key == "text" ? MarkupLanguage::plain : *markup_language_named(key));
    return turn;
}

}  // namespace

DialogScript read_dialog(const fs::path& file) {
    constexpr double kLongestPause = 5;  // ours [s]
    const Json json = read_json(file);
    const JsonValue whole(json, file.string());
    whole.allow_only({"$schema", "people", "coupling", "pause_s", "turns"});
    const std::vector<JsonValue> people = whole.at("people").items(2);
    if (people.size() > 2) whole.at("people").refuse(format("has {} entries, 2 are needed", people.size()));
    DialogScript dialog;
    for (std::size_t i = 0; i < 2; ++i) dialog.people[i] = person_in(people[i], file.parent_path());
    if (const auto coupling = whole.find("coupling")) dialog.coupling = coupling_in(*coupling);
    if (const auto pause = whole.find("pause_s")) dialog.pause = pause->number(0, kLongestPause);
    for (const JsonValue& turn : whole.at("turns").items(1))
        dialog.turns.push_back(turn_in(turn, dialog, file));
    return dialog;
}

}  // namespace chironomia
