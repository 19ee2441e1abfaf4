// Text that becomes part of an XML file.
#pragma once

#include <string>
#include <string_view>

namespace chironomia {

// For a place between tags or in a quoted attribute. Characters that XML 1.0 cannot hold, and bytes that are
// no UTF-8, become U+FFFD.
std::string escape_xml(std::string_view text);

}  // namespace chironomia
