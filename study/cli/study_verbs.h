// The verbs below `study` that run a study and hand it on.
#pragma once

#include <CLI/CLI.hpp>

#include <optional>

#include "study/cli/command_line.h"

namespace chironomia {

void add_study_serve(CLI::App& study, std::optional<Command>& result);
void add_study_answers(CLI::App& study, std::optional<Command>& result);
void add_study_plan(CLI::App& study, std::optional<Command>& result);
void add_study_presets(CLI::App& study, std::optional<Command>& result);
void add_study_export(CLI::App& study, std::optional<Command>& result);
void add_study_plan(CLI::App& study, std::optional<Command>& result);
void add_study_analyse(CLI::App& study, std::optional<Command>& result);
void add_study_rehearse(CLI::App& study, std::optional<Command>& result);

}  // namespace chironomia
