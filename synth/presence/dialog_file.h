// A dialog in a file: who speaks with whom, how their smiles are coupled, and what they say.
#pragma once

#include <array>
#include <cstddef>
#include <filesystem>
#include <vector>

#include "synth/markup/marked_text.h"
#include "synth/presence/dialog.h"

namespace chironomia {

struct DialogTurn {
    std::size_t person = 0;  // 0 or 1
    MarkedText text;
};

struct DialogScript {
    struct Person {
        Speaker speaker;
        double partner = 0;  // as in Interlocutor [rad]
    };
    std::array<Person, 2> people;
    Coupling coupling;
    double pause = 0.4;             // between turns [s], 0 to 5
    std::vector<DialogTurn> turns;  // at least one
};

// A JSON file as dialog.schema.json has it (docs/dialogs.md). Files that it names are found from its folder.
// Throws Error naming file and key if the file is missing, is no JSON or holds an unknown key or a bad value,
// and as the readers of speakers and of marked-up text do.
DialogScript read_dialog(const std::filesystem::path& file);

}  // namespace chironomia
