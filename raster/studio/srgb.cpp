#include "raster/studio/srgb.h"

#include "core/render/srgb.h"

namespace chironomia {

SrgbTables::SrgbTables() {
    for (size_t i = 0; i < linear_.size(); ++i) {
        linear_[i] = static_cast<float>(linear_from_srgb(static_cast<double>(i) / 255));
    }
    for (size_t i = 0; i < level_.size(); ++i) {
        level_[i] = static_cast<float>(255 * srgb_from_linear(static_cast<double>(i) / (kSteps - 1)));
    }
}

const SrgbTables& SrgbTables::get() {
    static const SrgbTables tables;
    return tables;
}

}  // namespace chironomia
