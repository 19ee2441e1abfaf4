#include "synth/learned/training/checkpoint.h"

#include <system_error>
#include <utility>

#include "core/error.h"
#include "core/files/files.h"
#include "core/hash.h"
#include "core/text.h"

namespace chironomia {
namespace fs = std::filesystem;
namespace {

constexpr const char* kWeights = ".safetensors";
constexpr const char* kResume = ".resume.safetensors";

fs::path beside(const fs::path& stem, std::string_view ending) {
    return stem.parent_path() / (stem.filename().string() + std::string(ending));
}

// Tensors wait under this name until the JSON that names them by their hash stands; then they are moved.
fs::path waiting(const fs::path& stem, std::string_view ending) {
    return stem.parent_path() / ("." + stem.filename().string() + std::string(ending) + ".next");
}

bool is_there(const fs::path& file) {
    std::error_code ignored;
    return fs::exists(file, ignored);
}

bool has_hash(const fs::path& file, const std::string& hash) {
    return is_there(file) && sha256_of_file(file) == hash;
}

// The file with the bytes that the JSON names: in its place, or waiting because the writer was killed.
fs::path file_with(const fs::path& stem, std::string_view ending, const std::string& hash) {
    const fs::path place = beside(stem, ending);
    if (has_hash(place, hash)) return place;
    if (has_hash(waiting(stem, ending), hash)) return waiting(stem, ending);
    const fs::path json = beside(stem, ".json");
    if (!is_there(place)) {
        throw Error(format("{}: {} is missing beside it; copy both files of the checkpoint", json.string(),
                           place.filename().string()));
    }
    throw Error(
        format("{}: these are not the bytes that {} names (SHA-256 {}); it is damaged, truncated or "
               "of another checkpoint, copy both files again",
               place.string(), json.filename().string(), hash));
}

void move_waiting(const fs::path& stem, std::string_view ending) {
    std::error_code problem;
    fs::rename(waiting(stem, ending), beside(stem, ending), problem);
    if (problem)
        throw Error(
            format("{}: cannot be put in place ({})", beside(stem, ending).string(), problem.message()));
}

// Ends what a killed writer began, so that what waits is never lost to the next one.
void finish_last_write(const fs::path& stem) {
    const fs::path json = beside(stem, ".json");
    if (!is_there(json)) return;
    const Json value = read_json(json);
    for (const auto& [key, ending] : {std::pair{"weights", kWeights}, {"resume", kResume}}) {
        const Json hash = value.is_object() ? value.value(key, Json()) : Json();
        if (hash.is_string() && !has_hash(beside(stem, ending), hash.get<std::string>()) &&
            has_hash(waiting(stem, ending), hash.get<std::string>()))
            move_waiting(stem, ending);
    }
}

std::vector<std::string> names_of(const std::vector<Feature>& features) {
    std::vector<std::string> names;
    for (const Feature& feature : features) names.push_back(feature.name);
    return names;
}

void check_order(const fs::path& file, const char* what, const std::vector<Feature>& features,
                 const std::vector<std::string>& needed) {
    if (needed.empty() || names_of(features) == needed) return;
    throw Error(format("{}: its {} are {}, needed are {}; use a checkpoint that was trained with these",
                       file.string(), what, join(names_of(features)), join(needed)));
}

Json read_description(const fs::path& stem) {
    const fs::path json = beside(stem, ".json"), weights = beside(stem, kWeights);
    if (fs::exists(weights) && !fs::exists(json)) {
        throw Error(
            format("{}: has no {} beside it, by which train describes each of its models; it is not one of "
                   "them, or give back its file",
                   weights.string(), json.filename().string()));
    }
    if (!fs::exists(json))
        throw Error(format("{}: there is no such checkpoint, and no {} beside it; check the path",
                           weights.string(), json.filename().string()));
    return read_json(json);
}

}  // namespace

fs::path checkpoint_stem(const fs::path& file) {
    const std::string ending = file.extension().string();
    return ending == ".json" || ending == kWeights ? fs::path(file).replace_extension() : file;
}

void write_checkpoint(const fs::path& file, const StoredCheckpoint& checkpoint) {
    const fs::path stem = checkpoint_stem(file);
    finish_last_write(stem);
    Json json = json_of(checkpoint.description);
    const auto lay_down = [&](const char* key, const char* ending, const Tensors& tensors) {
        write_safetensors(waiting(stem, ending), tensors);
        json[key] = sha256_of_file(waiting(stem, ending));
    };
    lay_down("weights", kWeights, checkpoint.weights);
    if (!checkpoint.resume.empty()) lay_down("resume", kResume, checkpoint.resume);
    write_json(beside(stem, ".json"), json);
    move_waiting(stem, kWeights);
    if (!checkpoint.resume.empty()) move_waiting(stem, kResume);
}

StoredCheckpoint read_checkpoint(const fs::path& file, CheckpointParts parts) {
    const fs::path stem = checkpoint_stem(file);
    const Json json = read_description(stem);
    const JsonValue value(json, beside(stem, ".json").string());
    StoredCheckpoint checkpoint{.description = checkpoint_of(value)};
    // A description that stands beside other weights describes nothing.
    const fs::path weights = file_with(stem, kWeights, value.at("weights").text());
    if (parts == CheckpointParts::description) return checkpoint;
    checkpoint.weights = read_safetensors(weights);
    if (parts == CheckpointParts::weights) return checkpoint;
    if (!value.find("resume"))
        value.refuse("was written without the state of its training, which cannot go on; train anew");
    checkpoint.resume = read_safetensors(file_with(stem, kResume, value.at("resume").text()));
    return checkpoint;
}

TensorShapes read_weight_shapes(const fs::path& file) {
    const fs::path stem = checkpoint_stem(file);
    const Json json = read_description(stem);
    const JsonValue value(json, beside(stem, ".json").string());
    return read_tensor_shapes(file_with(stem, kWeights, value.at("weights").text()));
}

void check_fits(const fs::path& file, const Checkpoint& checkpoint, const CheckpointNeed& need) {
    const auto check = [&](const char* what, const std::string& has, const std::string& needed) {
        if (!needed.empty() && has != needed)
            throw Error(
                format("{}: its {} is {}, {} is needed; use another", file.string(), what, has, needed));
    };
    check("model", checkpoint.model, need.model);
    check("preset", checkpoint.preset, need.preset);
    check_order(file, "inputs", checkpoint.inputs, need.inputs);
    check_order(file, "outputs", checkpoint.outputs, need.outputs);
}

}  // namespace chironomia
