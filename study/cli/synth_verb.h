// The verb that makes motion from text or speech.
#pragma once

#include <CLI/CLI.hpp>

#include <optional>

#include "study/cli/command_line.h"

namespace chironomia {

void add_synth(CLI::App& app, std::optional<Command>& result);

}  // namespace chironomia
