// The verbs below `corpus`.
#pragma once

#include <CLI/CLI.hpp>

#include <optional>

#include "study/cli/command_line.h"

namespace chironomia {

void add_corpus(CLI::App& app, std::optional<Command>& result);

}  // namespace chironomia
