// Outputs that others on the same machine must not read.
#pragma once

#include "core/files/files.h"

namespace chironomia {

// Lets nobody but the user of this program read a new file. One that is replaced keeps its permissions.
void keep_private(const PendingOutput& output);

// Makes the folder if it is missing, for the user of this program alone. A folder of theirs that is there becomes
// private. Throws Error if it cannot be made.
void make_private_folder(const std::filesystem::path& folder);

}  // namespace chironomia
