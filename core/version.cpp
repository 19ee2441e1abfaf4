#include "core/version.h"

#include "core/hash.h"

namespace chironomia {

std::string_view program_version() {
    return CHIRONOMIA_VERSION;
}

std::string_view library_versions() {
    return CHIRONOMIA_LIBRARIES;
}

std::string_view torch_version() {
    return CHIRONOMIA_TORCH;
}

std::string program_hash() {
    return sha256_of_file("/proc/self/exe");
}

}  // namespace chironomia
