// Instruction sets for which loops are compiled: the kernels of shadows and of the tile renderer.
#pragma once

#include <string>
#include <vector>

namespace chironomia {

// Those that this program has kernels for and this processor can run, the widest first.
std::vector<std::string> instruction_sets();

// Until the next call the kernels use this one alone; "": the widest. For tests, while nothing is drawn.
void use_instruction_set(const std::string& name);

}  // namespace chironomia
