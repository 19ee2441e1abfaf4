// Several figures as one, so that whatever draws one figure draws all of them, each with its shadow on the
// others.
#pragma once

#include <span>

#include "core/body/avatar.h"
#include "core/render/scene.h"
#include "scenes/framing.h"

namespace chironomia {

// Brings a figure from where its file has it to its place on a floor at height 0: turned from its own facing
// to the heading, with the middle between its shoulders over the place. Rigid.
Transform world_from_figure(const FigureMeasures& figure, const Placement& place);

// The surfaces, materials, images, skins, morphs and skeletons of `figures` one after the other, each under a
// joint of its own at `places` (one for each figure, scaled evenly or not at all), with Surface::figure
// counting them. Images that are alike are kept once. The humanoid map is that of the first figure.
Avatar join_figures(std::span<const Avatar* const> figures, std::span<const Transform> places);

// The posed meshes of figures, each in its own world, as the mesh of the avatar that join_figures made.
PosedMesh join_meshes(std::span<const PosedMesh> meshes, std::span<const Transform> places);

}  // namespace chironomia
