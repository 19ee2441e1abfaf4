#include "synth/gestures/lexicon.h"

#include <algorithm>
#include <cassert>
#include <optional>

#include "core/error.h"
#include "core/files/files.h"
#include "core/files/json.h"
#include "core/text.h"
#include "synth/gestures/lexicon_parts.h"
#include "synth/markup/functions.h"

namespace chironomia {
namespace fs = std::filesystem;
namespace {

const std::map<std::string, GestureCategory> kCategories = {
    {"beat", GestureCategory::beat},     {"metaphoric", GestureCategory::metaphoric},
    {"iconic", GestureCategory::iconic}, {"deictic", GestureCategory::deictic},
    {"emblem", GestureCategory::emblem}, {"adaptor", GestureCategory::adaptor}};
const std::map<std::string, GestureHands> kHands = {{"either", GestureHands::either},
                                                    {"both", GestureHands::both}};

// Hartmann, Mancini, Pelachaud 2005, "Augmented gesture specification language": iconics must keep what they
// show, emblems all of it; beats and metaphorics bend to the manner. Pointing hands and hands on the body are
// as meant only if they stay.
FixedFeatures usually_fixed(GestureCategory category) {
    const bool is_free = category == GestureCategory::beat || category == GestureCategory::metaphoric;
    const bool stays = category == GestureCategory::emblem || category == GestureCategory::adaptor;
    return {.wrist_x = stays, .wrist_y = stays, .wrist_z = stays, .palm = !is_free, .shape = !is_free};
}

// Lower-case words as in file and function names.
std::string read_id(const JsonValue& value) {
    const std::string id = value.text();
    const bool plain = std::all_of(id.begin(), id.end(), [](char c) {
        return (c >= 'a' && c <= 'z') || (c >= '0' && c <= '9') || c == '_';
    });
    if (!plain) {
        value.refuse(format("is \"{}\"; an id has small letters a to z, digits and _ only, such as \"{}\"",
                            id, "open_offer"));
    }
    return id;
}

// Puts the entry of a JSON value at its place: at the end, or over the one of an earlier file that it replaces.
template <typename Entry>
void put(std::vector<Entry>& entries, Entry entry, std::size_t of_earlier_files, const JsonValue& value) {
    const auto answer = value.find("replaces");
    const bool replaces = answer && read_answer(*answer);
    const auto same =
        std::find_if(entries.begin(), entries.end(), [&](const Entry& e) { return e.id == entry.id; });
    const bool is_earlier = same < entries.begin() + static_cast<std::ptrdiff_t>(of_earlier_files);
    if (same != entries.end() && !is_earlier)
        value.refuse(format("there are two of the id \"{}\" in this file; rename one", entry.id));
    if (replaces && same == entries.end()) {
        value.refuse(
            format("replaces \"{}\", which no earlier file has; correct the id or remove "
                   "\"replaces\"",
                   entry.id));
    }
    if (same == entries.end()) return entries.push_back(std::move(entry));
    if (!replaces) {
        value.refuse(
            format("an earlier file has the id \"{}\" already; choose another, or add "
                   "\"replaces\": true to take its place",
                   entry.id));
    }
    *same = std::move(entry);
}

// One file of a lexicon.
struct LexiconFile {
    std::string name;
    Json json;

    JsonValue whole() const { return JsonValue(json, name); }
};

// Shapes as bends, so that others may be like them.
struct NamedBends {
    std::string id;
    HandBends bends;
};

void read_shapes(const LexiconFile& file, std::vector<NamedBends>& shapes) {
    const auto section = file.whole().find("shapes");
    if (!section) return;
    const std::size_t earlier = shapes.size();
    if (!section->json().is_object()) {
        section->refuse(format("is {}, an object of shapes by their ids is needed", section->shown()));
    }
    for (const auto& [id, json] : section->json().items()) {
        const JsonValue value = section->at(id).called(format("shape \"{}\"", id));
        check_keys(value, "shapes.*");
        HandBends start;
        if (const auto like = value.find("like")) {
            std::vector<std::string> known;
            for (const NamedBends& shape : shapes) known.push_back(shape.id);
            const std::string model = like->choice(known);
            start = std::find_if(shapes.begin(), shapes.end(), [&](const NamedBends& s) {
                        return s.id == model;
                    })->bends;
        }
        put(shapes, NamedBends{.id = id, .bends = read_hand_bends(value, start)}, earlier, value);
    }
}

// "performative=greet", "rheme": what a mark in a text can ask a gesture for. Where no gesture shows it,
// planners look for its stem ("world=shape" of "world=shape-round") and its kind ("world").
std::vector<std::string> known_functions() {
    std::vector<std::string> names;
    for (const FunctionKind& kind : function_kinds()) {
        const bool asks = kind.kind != MarkKind::pitch_accent && kind.kind != MarkKind::boundary &&
                          kind.kind != MarkKind::gesture;
        if (!asks) continue;
        names.emplace_back(name_of(kind.kind));
        for (const std::string& known : values_of(kind)) {
            names.push_back(format("{}={}", name_of(kind.kind), known));
            const std::size_t stem = known.find('-');
            if (stem != std::string::npos)
                names.push_back(names.back().substr(0, names.back().rfind(known) + stem));
        }
    }
    return names;
}

// A value of one's own: "world=x-spiral".
bool is_own_function(const std::string& function) {
    return std::any_of(function_kinds().begin(), function_kinds().end(), [&](const FunctionKind& kind) {
        const std::string start = format("{}=x-", name_of(kind.kind));
        return kind.is_open && function.starts_with(start) && function.size() > start.size();
    });
}

std::string read_function(const JsonValue& value) {
    const std::string function = value.text();
    const std::vector<std::string> known = known_functions();
    if (is_own_function(function)) return function;
    if (std::find(known.begin(), known.end(), function) != known.end()) return function;
    const auto meant = nearest_name(function, known);
    value.refuse(
        format("is \"{}\", which no text can ask for; {}write a function that docs/markup.md lists, or a "
               "value of your own that begins with x-, such as \"world=x-spiral\"",
               function, meant ? format("did you mean \"{}\"? ", *meant) : ""));
}

Gesture read_gesture(const JsonValue& value, const std::vector<HandShape>& shapes) {
    check_keys(value, "gestures[]");
    Gesture gesture;
    gesture.id = read_id(value.at("id"));
    gesture.category = read_meaning(value.at("category"), kCategories);
    gesture.hands = read_meaning(value.at("hands"), kHands);
    for (const JsonValue& function : value.at("functions").items(0))
        gesture.functions.push_back(read_function(function));
    if (const auto answer = value.find("repeats")) gesture.repeats = read_answer(*answer);
    gesture.note = value.at("note").text();
    const auto fixed = value.find("fixed");
    const PoseReader reader{.shapes = shapes,
                            .hands = gesture.hands,
                            .fixed = fixed ? read_fixed(*fixed) : usually_fixed(gesture.category)};
    gesture.poses = reader.read(value.at("poses"));
    return gesture;
}

void read_gestures(const LexiconFile& file, Lexicon& lexicon) {
    const auto section = file.whole().find("gestures");
    if (!section) return;
    const std::size_t earlier = lexicon.gestures.size();
    for (const JsonValue& value : section->items(0)) {
        const JsonValue named = value.called(format("gesture \"{}\"", read_id(value.at("id"))));
        put(lexicon.gestures, read_gesture(named, lexicon.shapes), earlier, named);
    }
}

std::vector<HandShape> shapes_of(const std::vector<NamedBends>& named) {
    std::vector<HandShape> shapes;
    for (const NamedBends& shape : named) shapes.push_back({.id = shape.id, .turns = turns_of(shape.bends)});
    // The hand at rest comes first.
    const auto relax =
        std::find_if(shapes.begin(), shapes.end(), [](const HandShape& s) { return s.id == "relax"; });
    if (relax != shapes.end()) std::rotate(shapes.begin(), relax, relax + 1);
    return shapes;
}

}  // namespace

const std::vector<LexiconKeys>& lexicon_keys() {
    static const std::vector<LexiconKeys> keys = {
        {.object = "", .keys = {"$schema", "shapes", "gestures"}, .required = {}},
        {.object = "shapes.*",
         .keys = {"like", "replaces", "thumb", "fingers", "index", "middle", "ring", "little"},
         .required = {}},
        {.object = "shapes.*.thumb", .keys = {"flexion", "spread", "oppose"}, .required = {}},
        {.object = "shapes.*.index", .keys = {"flexion", "spread"}, .required = {}},
        {.object = "gestures[]",
         .keys = {"id", "category", "hands", "functions", "fixed", "repeats", "replaces", "note", "poses"},
         .required = {"id", "category", "hands", "functions", "note", "poses"}},
        {.object = "gestures[].poses[]",
         .keys = {"phase", "speed", "path", "arm", "right", "left"},
         .required = {"phase"}},
        {.object = "arm",
         .keys = {"wrist", "palm", "fingers", "shape", "swivel", "fixed", "touches"},
         .required = {}},
        {.object = "wrist", .keys = {"x", "y", "z"}, .required = {}},
        {.object = "path", .keys = {"shape", "radius", "turns", "axis"}, .required = {"shape"}}};
    return keys;
}

void check_keys(const JsonValue& value, const std::string& object) {
    const std::vector<LexiconKeys>& all = lexicon_keys();
    const auto known =
        std::find_if(all.begin(), all.end(), [&](const LexiconKeys& k) { return k.object == object; });
    assert(known != all.end());
    value.allow_only(known->keys);
    for (const std::string& key : known->required) value.at(key);
}

bool read_answer(const JsonValue& value) {
    if (!value.json().is_boolean()) value.refuse(format("is {}, true or false is needed", value.shown()));
    return value.json().get<bool>();
}

std::vector<fs::path> bundled_lexicon_files() {
    std::vector<fs::path> files;
    for (const char* name : {"shapes", "beats", "metaphorics", "iconics", "deictics", "emblems", "adaptors"})
        files.push_back(find_asset(format("synth/gestures/lexicon/{}.json", name)));
    return files;
}

Lexicon read_lexicon(std::span<const fs::path> files) {
    std::vector<LexiconFile> read;
    std::vector<NamedBends> shapes;
    Lexicon lexicon;
    for (const fs::path& file : files) {
        read.push_back({.name = file.string(), .json = read_json(file)});
        check_keys(read.back().whole(), "");
        read_shapes(read.back(), shapes);
        lexicon.sources.push_back(file.string());
    }
    lexicon.shapes = shapes_of(shapes);
    if (!find_shape(lexicon, "relax")) {
        throw Error(
            format("{}: there is no hand shape \"relax\", which hands at rest have; add it, or read the "
                   "bundled lexicon first",
                   join(lexicon.sources)));
    }
    for (const LexiconFile& file : read) read_gestures(file, lexicon);
    return lexicon;
}

}  // namespace chironomia
