// The texts in a list that Python has pickled, as pandas keeps a column of them in HDF5.
#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace chironomia {

// The texts of the last list in a pickle of the protocols 2 to 5 of a numpy array of objects, in order;
// nothing if the list holds anything but texts or more than 16 MiB of them, or the pickle has a part that
// such arrays do not have. Nothing is built or called: of Python's pickle machine only the stack of
// texts is followed.
std::optional<std::vector<std::string>> pickled_texts(std::string_view pickle);

}  // namespace chironomia
