// The verbs that judge models and motions: train, evaluate and measure.
#pragma once

#include <CLI/CLI.hpp>

#include <optional>

#include "study/cli/command_line.h"

namespace chironomia {

void add_train(CLI::App& app, std::optional<Command>& result);
void add_evaluate(CLI::App& app, std::optional<Command>& result);
void add_measure(CLI::App& app, std::optional<Command>& result);

}  // namespace chironomia
