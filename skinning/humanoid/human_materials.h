// What glTF cannot say of a person's materials: that light scatters in skin and teeth, and that eyes are wet.
#pragma once

#include "core/body/avatar.h"

namespace chironomia {

enum class HumanMaterial { other, skin, eye, teeth, mouth };

// By the words of the material's name. "face", "head" and "body" are skin only if most of the base colour is
// of a hue that skin has, because clothes are called so too.
HumanMaterial human_material_of(const Material& material, const std::vector<Image>& images);

// Gives skin, eyes, teeth and tongue their scatter and coat, and says what lies in the mouth. What a file says itself
// (KHR_materials_clearcoat, or the extra "scatter") stays.
void finish_human_materials(Avatar& avatar);

}  // namespace chironomia
