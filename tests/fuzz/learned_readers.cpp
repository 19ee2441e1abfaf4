// Weights of learned models.
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

const AddFuzzReader kSafetensors({"safetensors", "x.safetensors", read_safetensors_file});

}  // namespace
}  // namespace chironomia::testing
