#include "core/files/json.h"

#include "core/files/files.h"
#include "core/files/json_text.h"

namespace chironomia {

Json read_json(const std::filesystem::path& file) {
    return parse_json(read_text(file), file);
}

void write_json(const std::filesystem::path& file, const Json& value) {
    write_text(file, value.dump(2) + "\n");
}

}  // namespace chironomia
