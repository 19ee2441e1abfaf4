// The files that a command reads and writes, known before any work, so that nothing that is read is lost.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "study/cli/options/commands.h"

namespace chironomia::study {

struct InputPath {
    std::string option;  // that names it: "--motion"
    std::filesystem::path path;
    std::vector<std::string> endings{};  // of a folder: how the names of the files end that are read in it
};

struct OutputPath {
    std::string option;
    std::filesystem::path path;  // of a folder that is made, the folder
    std::string ending{};        // of the only kind of file that is written there; empty: any
};

struct FileUse {
    std::vector<InputPath> inputs;  // some may be no files, but names of what is bundled
    std::vector<OutputPath> outputs;
};

FileUse files_of(const Command& command);

// Throws Error if an output is an input, by name or by link, if it lies among the files that are read in a
// folder, or if two outputs are one; if the name of an output has not the ending of its kind of file; if an output
// is "-", as what an option names is never written to standard output; if an output lies in no folder or in one that
// may not be written; if an input is a pipe or a device; or if the name of a file that is read is no UTF-8, as messages
// and reports need it.
void refuse_lost_files(const FileUse& use);

}  // namespace chironomia::study
