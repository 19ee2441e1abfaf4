// Programs of our own that work for the main one: each has a library that starts slowly, or that must not
// live as long as the main program does.
#pragma once

#include <cstdio>
#include <filesystem>
#include <span>
#include <string>

namespace chironomia {

struct HelperProgram {
    const char* name;          // "chironomia_speak"
    const char* variable;      // of the environment, which holds its path: "CHIRONOMIA_SPEAK"
    const char* needed_by;     // for messages: "speech"
    const char* built_folder;  // where the build puts it
    const char* remedy;        // what to do where it is missing: "install chironomia again"
    std::span<const char* const> environment = {};  // "NAME=VALUE" each, which it gets instead of ours
};

// Looked for where the variable says, or else beside this program, in lib/chironomia beside its folder, and
// where it was built. Throws Error naming every place that was tried.
std::filesystem::path find_helper(const HelperProgram& program);

// What is left on a stream: the request on a helper's stdin.
std::string read_stream(std::FILE* stream);

struct HelperAnswer {
    std::string bytes;  // what it wrote on stdout
    int exit_code = 0;  // -1: it was killed
};

// Starts the program, gives it `request` on stdin, and waits for its end; its stderr is ours.
// May be called from several threads.
// SIGINT and SIGTERM are handed on to it, if this program watches for them.
// Throws Error if it cannot be started or no file can be opened; Interrupted if it was such a signal that
// ended it.
HelperAnswer ask_program(const std::filesystem::path& helper, const HelperProgram& program,
                         const std::string& request);

}  // namespace chironomia
