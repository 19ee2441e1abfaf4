// Motions in formats of other programs that are not read: what they are, and what to export instead.
#pragma once

#include <filesystem>
#include <string_view>

namespace chironomia {

// Throws Error if the beginning of a file or the end of its name is that of a table of OptiTrack Motive, Qualisys,
// Vicon Nexus or DeepLabCut, of TRC, C3D, MVNX, AMC and ASF, of NTU RGB+D, of Excel, of a pickle or of PyTorch. Does
// nothing for other files.
void refuse_other_formats(const std::filesystem::path& file, std::string_view content);

// Throws Error if it is a folder, and says which folders are motions; of a folder of YOLO's labels or of JSON files it
// says what to do with them. Does nothing for files.
void refuse_other_folders(const std::filesystem::path& path);

}  // namespace chironomia
