// Weights of learned models.
#include "synth/learned/training/safetensors.h"
#include "tests/fuzz/fuzz_reader.h"

namespace chironomia::testing {
namespace {

const AddFuzzReader kSafetensors({"safetensors", "x.safetensors",
                                  [](const FuzzInput& input) { read_safetensors(input.file()); }});

}  // namespace
}  // namespace chironomia::testing
