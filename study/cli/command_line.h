// The command line as plain data.
#pragma once

#include <optional>
#include <string>

#include "study/cli/options/commands.h"

namespace chironomia::study {

// Either a command, or a text that was asked for (help, version) or that says what is wrong with the line.
struct CommandLine {
    std::optional<Command> command;
    std::string text;
    int exit_code = 0;  // of the text: 0 asked for, 2 wrong command line
};

CommandLine parse_command_line(int argc, const char* const* argv);

}  // namespace chironomia::study
