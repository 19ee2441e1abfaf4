#include "raster/embree/ray_scene.h"

#include <bit>
#include <cassert>
#include <cmath>

#include "core/error.h"
#include "core/text.h"
#include "raster/embree/embree.h"

namespace chironomia {
namespace {

constexpr std::uint32_t kSight = 1, kLight = 2;  // ray masks
constexpr std::uint32_t kMasks[kOpacities] = {kSight | kLight, kSight | kLight, kSight};

// One thread builds and refits, so that the order of triangles never depends on the machine. AVX2 at most:
// the last digits of a hit are the same on machines with AVX-512.
constexpr const char* kConfig = "threads=1,max_isa=avx2";

struct DeviceCloser {
    void operator()(RTCDeviceTy* device) const { rtcReleaseDevice(device); }
};
struct SceneCloser {
    void operator()(RTCSceneTy* scene) const { rtcReleaseScene(scene); }
};
struct GeometryCloser {
    void operator()(RTCGeometryTy* geometry) const { rtcReleaseGeometry(geometry); }
};
using Device = std::unique_ptr<RTCDeviceTy, DeviceCloser>;
using EmbreeScene = std::unique_ptr<RTCSceneTy, SceneCloser>;
using Geometry = std::unique_ptr<RTCGeometryTy, GeometryCloser>;

Device open_device() {
    Device device(rtcNewDevice(kConfig));
    if (!device) {
        throw Error(
            format("Embree: cannot be started (error {0}); install libembree{1}-{1} or use --renderer tiles",
                   static_cast<int>(rtcGetDeviceError(nullptr)), RTC_VERSION_MAJOR));
    }
    return device;
}

// What the filters need to know of a group of triangles.
struct Group {
    const RayFigure* figure = nullptr;
    std::uint32_t first = 0;  // triangle
    bool has_single_sided = false;
    bool has_cut_outs = false;
};

// Lets rays of sight through the backs of single-sided surfaces and through what alpha cuts out.
void filter_sight(const RTCFilterFunctionNArguments* arguments) {
    const Group& group = *static_cast<const Group*>(arguments->geometryUserPtr);
    for (unsigned i = 0; i < arguments->N; ++i) {
        if (arguments->valid[i] == 0) continue;
        const RTCRay ray = rtcGetRayFromRayN(arguments->ray, arguments->N, i);
        const RTCHit hit = rtcGetHitFromHitN(arguments->hit, arguments->N, i);
        const TrianglePlace place{group.first + hit.primID, hit.u, hit.v};
        const bool from_behind = hit.Ng_x * ray.dir_x + hit.Ng_y * ray.dir_y + hit.Ng_z * ray.dir_z > 0;
        const bool unseen =
            (from_behind && !group.figure->material_at(place.triangle).material.double_sided) ||
            (group.has_cut_outs && group.figure->is_cut_out(place));
        if (unseen) arguments->valid[i] = 0;
    }
}

void filter_light(const RTCFilterFunctionNArguments* arguments) {
    const Group& group = *static_cast<const Group*>(arguments->geometryUserPtr);
    for (unsigned i = 0; i < arguments->N; ++i) {
        if (arguments->valid[i] == 0) continue;
        const RTCHit hit = rtcGetHitFromHitN(arguments->hit, arguments->N, i);
        if (group.figure->is_cut_out({group.first + hit.primID, hit.u, hit.v})) arguments->valid[i] = 0;
    }
}

void fill(RTCRay8& rays, const RayPack& pack, std::uint32_t mask) {
    for (size_t i = 0; i < kLanes; ++i) {
        const Ray& ray = pack.rays[i];
        rays.org_x[i] = ray.origin.x;
        rays.org_y[i] = ray.origin.y;
        rays.org_z[i] = ray.origin.z;
        rays.tnear[i] = ray.near;
        rays.dir_x[i] = ray.direction.x;
        rays.dir_y[i] = ray.direction.y;
        rays.dir_z[i] = ray.direction.z;
        rays.time[i] = ray.moment;
        rays.tfar[i] = ray.far;
        rays.mask[i] = mask;
        rays.id[i] = 0;
        rays.flags[i] = 0;
    }
}

struct alignas(32) Valid {
    Lanes<int> lanes;
    explicit Valid(LaneMask active) {
        for (size_t i = 0; i < kLanes; ++i) lanes[i] = (active >> i) & 1u ? -1 : 0;
    }
};

}  // namespace

struct RayScene::Parts {
    Parts(const RayFigure& figure_);
    void build();
    void attach(size_t opacity);
    void place(std::span<const RayMoment> moments, RTCBuildQuality quality);

    const RayFigure& figure;
    Device device;
    EmbreeScene scene;
    std::array<Group, kOpacities> groups;
    std::array<Geometry, kOpacities> geometries;  // null: no such triangles
    size_t moment_count = 0;
};

RayScene::Parts::Parts(const RayFigure& figure_) : figure(figure_), device(open_device()) {
    for (size_t opacity = 0; opacity < kOpacities; ++opacity) {
        Group& group = groups[opacity];
        group = {.figure = &figure, .first = figure.first_of[opacity]};
        for (std::uint32_t i = group.first; i < figure.first_of[opacity + 1]; ++i) {
            const Material& material = figure.material_at(i).material;
            group.has_single_sided |= !material.double_sided;
            group.has_cut_outs |= material.alpha_mode == AlphaMode::mask;
        }
    }
    build();
}

// A scene of two levels: a tree over the groups, and one in each group that is refitted when the figure
// moves.
void RayScene::Parts::build() {
    scene.reset(rtcNewScene(device.get()));
    rtcSetSceneFlags(scene.get(), static_cast<RTCSceneFlags>(RTC_SCENE_FLAG_DYNAMIC | RTC_SCENE_FLAG_ROBUST));
    moment_count = figure.moments.size();
    for (size_t opacity = 0; opacity < kOpacities; ++opacity) attach(opacity);
    // Always from the same pose, so that the trees, and ties in them, do not depend on the first frame.
    if (moment_count == 1) place(std::span(&figure.rest, 1), RTC_BUILD_QUALITY_MEDIUM);
}

void RayScene::Parts::attach(size_t opacity) {
    const size_t count = figure.first_of[opacity + 1] - figure.first_of[opacity];
    if (count == 0) return;
    geometries[opacity].reset(rtcNewGeometry(device.get(), RTC_GEOMETRY_TYPE_TRIANGLE));
    RTCGeometryTy* geometry = geometries[opacity].get();
    rtcSetGeometryTimeStepCount(geometry, static_cast<unsigned>(moment_count));
    rtcSetSharedGeometryBuffer(geometry, RTC_BUFFER_TYPE_INDEX, 0, RTC_FORMAT_UINT3,
                               figure.triangles.data() + 3 * static_cast<size_t>(groups[opacity].first), 0,
                               3 * sizeof(std::uint32_t), count);
    rtcSetGeometryMask(geometry, kMasks[opacity]);
    rtcSetGeometryUserData(geometry, &groups[opacity]);
    if (groups[opacity].has_single_sided || groups[opacity].has_cut_outs)
        rtcSetGeometryIntersectFilterFunction(geometry, filter_sight);
    if (groups[opacity].has_cut_outs) rtcSetGeometryOccludedFilterFunction(geometry, filter_light);
    rtcAttachGeometryByID(scene.get(), geometry, static_cast<unsigned>(opacity));
}

void RayScene::Parts::place(std::span<const RayMoment> moments, RTCBuildQuality quality) {
    for (const Geometry& geometry : geometries) {
        if (!geometry) continue;
        for (size_t i = 0; i < moments.size(); ++i) {
            const std::vector<Vec3>& positions = moments[i].positions;
            rtcSetSharedGeometryBuffer(geometry.get(), RTC_BUFFER_TYPE_VERTEX, static_cast<unsigned>(i),
                                       RTC_FORMAT_FLOAT3, positions.data(), 0, sizeof(Vec3),
                                       positions.size() - 1);
        }
        rtcSetGeometryBuildQuality(geometry.get(), quality);
        rtcCommitGeometry(geometry.get());
    }
    rtcCommitScene(scene.get());
    assert(rtcGetDeviceError(device.get()) == RTC_ERROR_NONE);
}

RayScene::RayScene(const RayFigure& figure) : parts_(std::make_unique<Parts>(figure)) {}

RayScene::~RayScene() = default;

void RayScene::follow_figure() {
    const std::vector<RayMoment>& moments = parts_->figure.moments;
    if (parts_->moment_count != moments.size()) parts_->build();
    // Trees of moving triangles are built anew.
    parts_->place(moments, moments.size() == 1 ? RTC_BUILD_QUALITY_REFIT : RTC_BUILD_QUALITY_MEDIUM);
}

HitPack RayScene::nearest(const RayPack& pack) const {
    const Valid valid(pack.active);
    RTCRayHit8 traced;
    fill(traced.ray, pack, kSight);
    for (size_t i = 0; i < kLanes; ++i) traced.hit.geomID[i] = RTC_INVALID_GEOMETRY_ID;
    intersect(valid.lanes.data(), parts_->scene.get(), traced);
    HitPack result;
    for (size_t i = 0; i < kLanes; ++i) {
        const unsigned group = traced.hit.geomID[i];
        if (!((pack.active >> i) & 1u) || group == RTC_INVALID_GEOMETRY_ID) continue;
        result.hit |= 1u << i;
        result.hits[i] = {
            .place = {parts_->groups[group].first + traced.hit.primID[i], traced.hit.u[i], traced.hit.v[i]},
            .distance = traced.ray.tfar[i]};
    }
    return result;
}

LaneMask RayScene::hidden(const RayPack& pack) const {
    if (pack.active == 0) return 0;
    const Valid valid(pack.active);
    RTCRay8 rays;
    fill(rays, pack, kLight);
    occlude(valid.lanes.data(), parts_->scene.get(), rays);
    LaneMask hidden = 0;
    for (size_t i = 0; i < kLanes; ++i) {
        if (rays.tfar[i] < 0) hidden |= 1u << i;
    }
    return hidden & pack.active;
}

}  // namespace chironomia
