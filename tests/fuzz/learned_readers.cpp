// Checkpoints of learned models: their JSON and their weights.
#include "synth/learned/training/checkpoint_json.h"
#include "synth/learned/training/safetensors_layout.h"
#include "tests/fuzz/fuzz_reader.h"

namespace chironomia::testing {
namespace {

void read_safetensors_file(const FuzzInput& input) {
    // Each byte is looked at, as it is where tensors are made.
    unsigned sum = 0;
    for (const TensorPlace& place : tensor_places(input.bytes(), "x.safetensors")) {
        for (const std::byte byte : place.bytes) sum += std::to_integer<unsigned>(byte);
    }
    volatile unsigned looked_at = sum;
    (void)looked_at;
}

void read_checkpoint_json(const FuzzInput& input) {
    const Json json = read_json(input.file());
    checkpoint_of(JsonValue(json, "x.json"));
}

const AddFuzzReader kSafetensors({"safetensors", "x.safetensors", read_safetensors_file});
const AddFuzzReader kCheckpoint({"checkpoint", "x.json", read_checkpoint_json});

}  // namespace
}  // namespace chironomia::testing
