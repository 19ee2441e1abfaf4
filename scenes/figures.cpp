#include "scenes/figures.h"

#include <algorithm>
#include <cassert>
#include <cmath>

namespace chironomia {
namespace {

bool alike(const Image& a, const Image& b) {
    return a.width == b.width && a.height == b.height && a.rgba == b.rgba;
}

// Where each image of `figure` lies in `images`, to which those that are new are added.
std::vector<int> add_images(std::vector<Image>& images, const Avatar& figure) {
    std::vector<int> indices;
    for (const Image& image : figure.images) {
        const auto known = std::find_if(images.begin(), images.end(),
                                        [&](const Image& other) { return alike(image, other); });
        indices.push_back(static_cast<int>(known - images.begin()));
        if (known == images.end()) images.push_back(image);
    }
    return indices;
}

Material with_images(Material material, const std::vector<int>& images) {
    for (Texture* texture :
         {&material.base_colour_texture, &material.normal_texture, &material.metallic_roughness_texture,
          &material.occlusion_texture, &material.emissive_texture, &material.anisotropy_texture}) {
        if (texture->image >= 0) texture->image = images[static_cast<size_t>(texture->image)];
    }
    return material;
}

// An index of a figure in what it is joined to; -1 means nothing and stays.
int moved(int index, size_t by) {
    return index < 0 ? index : index + static_cast<int>(by);
}

Surface moved(Surface surface, const Avatar& all, size_t figure, int place_joint) {
    surface.figure = static_cast<int>(figure);
    surface.joint = surface.joint < 0 ? place_joint : surface.joint + place_joint + 1;
    surface.skin = moved(surface.skin, all.skins.size());
    surface.material = moved(surface.material, all.materials.size());
    surface.first_morph_weight += static_cast<int>(all.rest_morph_weights.size());
    return surface;
}

void add_skeleton(Skeleton& skeleton, const Skeleton& figure, const Transform& place) {
    const int place_joint = static_cast<int>(skeleton.joints.size());
    skeleton.joints.push_back({.name = "place", .parent = -1, .rest = place});
    for (Joint joint : figure.joints) {
        joint.parent = joint.parent < 0 ? place_joint : joint.parent + place_joint + 1;
        skeleton.joints.push_back(std::move(joint));
    }
}

template <typename Item>
void append(std::vector<Item>& all, const std::vector<Item>& more) {
    all.insert(all.end(), more.begin(), more.end());
}

HumanoidMap moved(HumanoidMap map, int by) {
    for (int part = 0; part < kHumanJoints; ++part) {
        int& joint = map[static_cast<HumanJoint>(part)];
        if (joint >= 0) joint += by;
    }
    return map;
}

void add_figure(Avatar& all, const Avatar& figure, size_t index, const Transform& place) {
    all.source += (index > 0 ? " + " : "") + figure.source;
    append(all.companions, figure.companions);
    const int place_joint = static_cast<int>(all.skeleton.joints.size());
    for (const Surface& surface : figure.surfaces) {
        all.surfaces.push_back(moved(surface, all, index, place_joint));
    }
    const HumanoidMap humanoid = moved(figure.humanoid, place_joint + 1);
    if (index == 0) {
        all.humanoid = humanoid;
    } else {
        all.more_humanoids.push_back(humanoid);
    }
    for (Skin skin : figure.skins) {
        for (int& joint : skin.joints) joint += place_joint + 1;
        all.skins.push_back(std::move(skin));
    }
    const std::vector<int> images = add_images(all.images, figure);
    for (const Material& material : figure.materials) all.materials.push_back(with_images(material, images));
    append(all.rest_morph_weights, figure.rest_morph_weights);
    append(all.morph_names, figure.morph_names);
    add_skeleton(all.skeleton, figure.skeleton, place);
}

PosedSurface moved(PosedSurface surface, const Transform& by) {
    const Mat4 move = to_matrix(by);
    const Mat3 turn = glm::mat3_cast(by.rotation);
    for (Vec3& position : surface.positions) position = Vec3(move * Vec4(position, 1));
    for (Vec3& normal : surface.normals) normal = turn * normal;
    for (Vec4& tangent : surface.tangents) tangent = Vec4(turn * Vec3(tangent), tangent.w);
    return surface;
}

}  // namespace

Transform world_from_figure(const FigureMeasures& figure, const Placement& place) {
    const float own_heading = std::atan2(figure.forward.x, figure.forward.z);
    const Quat turn = glm::angleAxis(place.heading - own_heading, Vec3(0, 1, 0));
    const Vec3 foot(figure.middle.x, figure.floor, figure.middle.z);
    return {.translation = Vec3(place.x, 0, place.z) - turn * foot, .rotation = turn};
}

Avatar join_figures(std::span<const Avatar* const> figures, std::span<const Transform> places) {
    assert(figures.size() == places.size());
    Avatar all;
    for (size_t i = 0; i < figures.size(); ++i) add_figure(all, *figures[i], i, places[i]);
    return all;
}

PosedMesh join_meshes(std::span<const PosedMesh> meshes, std::span<const Transform> places) {
    assert(meshes.size() == places.size());
    PosedMesh all;
    for (size_t i = 0; i < meshes.size(); ++i) {
        for (const PosedSurface& surface : meshes[i].surfaces)
            all.surfaces.push_back(moved(surface, places[i]));
    }
    return all;
}

}  // namespace chironomia
