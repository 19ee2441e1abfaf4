#include "skinning/gltf/rehang.h"

#include <cmath>
#include <utility>

namespace chironomia {
namespace {

bool is_sheared(const Mat4& matrix) {
    Mat3 axes(matrix);
    for (int axis = 0; axis < 3; ++axis) {
        if (length(axes[axis]) < 1e-12f) return true;
        axes[axis] = normalize(axes[axis]);
    }
    return std::abs(dot(axes[0], axes[1])) > 0.001f || std::abs(dot(axes[1], axes[2])) > 0.001f ||
           std::abs(dot(axes[2], axes[0])) > 0.001f;
}

void drop_from(Json& holder, const char* key, int node) {
    if (!holder.contains(key)) return;
    Json kept = Json::array();
    for (const Json& child : holder[key]) {
        if (child != node) kept.push_back(child);
    }
    if (kept.empty())
        holder.erase(key);
    else
        holder[key] = std::move(kept);
}

}  // namespace

std::optional<Transform> rest_below(const GltfFile& file, const std::vector<Mat4>& world, int joint,
                                    int parent) {
    const Mat4 rest = inverse(world[static_cast<size_t>(parent)]) * world[static_cast<size_t>(joint)];
    if (is_sheared(rest)) return std::nullopt;
    return decompose(rest, file, "a joint");
}

void hang_node(Json& json, int node, int onto, const Transform& rest) {
    for (Json& other : json["nodes"]) drop_from(other, "children", node);
    if (json.contains("scenes")) {
        for (Json& scene : json["scenes"]) drop_from(scene, "nodes", node);
    }
    json["nodes"][static_cast<size_t>(onto)]["children"].push_back(node);
    Json& hung = json["nodes"][static_cast<size_t>(node)];
    hung.erase("matrix");
    const Vec3 &t = rest.translation, &s = rest.scale;
    const Quat& q = rest.rotation;
    hung["translation"] = {t.x, t.y, t.z};
    hung["rotation"] = {q.x, q.y, q.z, q.w};
    hung["scale"] = {s.x, s.y, s.z};
}

}  // namespace chironomia
