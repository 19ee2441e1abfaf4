#include "skinning/face_region/head_scan.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "core/body/face.h"
#include "core/body/rest.h"
#include "core/text.h"

namespace chironomia {
namespace {

constexpr size_t kHeights = 96;
constexpr size_t kFewest = 12;  // vertices of a head
constexpr float kCarried = 0.5f;

// Where a face has its parts, of the way from the chin to the crown or to the eyes: the eyes lie halfway up a
// head, and the line between the lips a good third of the way from the chin to them.
constexpr float kEyesOfHead = 0.49f;
constexpr float kMouthOfEyes = 0.37f;

using Words = std::vector<std::string_view>;

bool names_one_of(const std::string& name, const Words& words) {
    const std::string lower = to_lower(name);
    return std::any_of(words.begin(), words.end(),
                       [&](std::string_view word) { return lower.find(word) != std::string::npos; });
}

std::vector<bool> joints_below(const Skeleton& skeleton, const std::vector<int>& tops) {
    std::vector<bool> below(skeleton.joints.size(), false);
    for (const int top : tops) below[static_cast<size_t>(top)] = true;
    for (size_t j = 0; j < below.size(); ++j) {
        const int parent = skeleton.joints[j].parent;
        if (parent >= 0 && below[static_cast<size_t>(parent)]) below[j] = true;
    }
    return below;
}

std::string names_of(const Avatar& avatar, const Surface& surface) {
    const bool bare = surface.material < 0;
    return surface.name + " " + (bare ? "" : avatar.materials[static_cast<size_t>(surface.material)].name);
}

// What lies on or in a face without being its skin.
bool is_face_detail(const Avatar& avatar, const Surface& surface) {
    return names_one_of(names_of(avatar, surface),
                        {"eye", "brow", "lash", "teeth", "tongue", "beard", "glass"});
}

bool moves_face(const Surface& surface) {
    return surface.morphs.size() > 1;
}

// The surface with the most vertices on the head; one with morphs before any without.
std::optional<size_t> find_skin(const Avatar& avatar, const std::vector<std::vector<float>>& on_head) {
    std::optional<size_t> skin;
    std::pair<bool, long> best{false, static_cast<long>(kFewest) - 1};
    for (size_t s = 0; s < avatar.surfaces.size(); ++s) {
        const Surface& surface = avatar.surfaces[s];
        const auto carried = std::count_if(on_head[s].begin(), on_head[s].end(),
                                           [](float weight) { return weight > kCarried; });
        if (carried < static_cast<long>(kFewest)) continue;
        if (is_hair(avatar, surface) || is_face_detail(avatar, surface)) continue;
        const std::pair<bool, long> rank{moves_face(surface), carried};
        if (skin && rank <= best) continue;
        best = rank;
        skin = s;
    }
    return skin;
}

void take_box(HeadScan& scan) {
    scan.low = Vec3(std::numeric_limits<float>::max());
    scan.high = -scan.low;
    for (size_t v = 0; v < scan.on_head[scan.skin].size(); ++v) {
        if (scan.on_head[scan.skin][v] <= kCarried) continue;
        const Vec3& place = scan.rest.surfaces[scan.skin].positions[v];
        scan.low = glm::min(scan.low, place);
        scan.high = glm::max(scan.high, place);
    }
}

// Heights that no edge crosses take the value of the nearest that one does.
void fill_gaps(std::vector<float>& values, float none) {
    for (size_t i = 1; i < values.size(); ++i) {
        if (values[i] == none) values[i] = values[i - 1];
    }
    for (size_t i = values.size() - 1; i-- > 0;) {
        if (values[i] == none) values[i] = values[i + 1];
    }
}

// Where the edges of the skin lie near the middle, looked at in steps finer than the heights.
void take_front(HeadScan& scan, const Surface& surface) {
    constexpr float kNone = -std::numeric_limits<float>::max();
    constexpr int kSteps = 8;
    scan.front.assign(kHeights, kNone);
    const auto& places = scan.rest.surfaces[scan.skin].positions;
    const float band = 0.12f * (scan.high.x - scan.low.x);
    const float per_height = static_cast<float>(kHeights - 1) / std::max(scan.high.y - scan.low.y, 1e-6f);
    for (size_t i = 0; i < surface.triangles.size(); ++i) {
        const size_t next = i % 3 == 2 ? i - 2 : i + 1;
        const Vec3 &a = places[surface.triangles[i]], &b = places[surface.triangles[next]];
        if (scan.on_head[scan.skin][surface.triangles[i]] <= kCarried ||
            scan.on_head[scan.skin][surface.triangles[next]] <= kCarried)
            continue;
        for (int step = 0; step <= kSteps; ++step) {
            const Vec3 place = glm::mix(a, b, static_cast<float>(step) / kSteps);
            if (std::abs(place.x - scan.middle().x) > band) continue;
            float& front = scan.front[static_cast<size_t>((place.y - scan.low.y) * per_height + 0.5f)];
            front = std::max(front, place.z);
        }
    }
    fill_gaps(scan.front, kNone);
}

// Where morphs move a surface most: the middle of what moves at least half as far as what moves furthest, as
// a mean over the morphs, and how far to either side it lies.
template <typename Counts>
std::optional<FacePlace> moved_most(const Avatar& avatar, const HeadScan& scan, Counts counts) {
    const Surface& surface = avatar.surfaces[scan.skin];
    Vec3 sum(0);
    float half_width = 0;
    int morphs = 0;
    for (const Morph& morph : surface.morphs) {
        if (!counts(morph.name)) continue;
        float furthest = 0;
        for (const Vec3& move : morph.moves) furthest = std::max(furthest, length(move));
        Vec3 places(0);
        int moved = 0;
        for (size_t i = 0; i < morph.vertices.size(); ++i) {
            const size_t v = morph.vertices[i];
            if (length(morph.moves[i]) < 0.5f * furthest || scan.on_head[scan.skin][v] <= kCarried) continue;
            const Vec3& place = scan.rest.surfaces[scan.skin].positions[v];
            half_width = std::max(half_width, std::abs(place.x - scan.middle().x));
            places += place;
            ++moved;
        }
        if (moved == 0 || furthest == 0) continue;
        sum += places / static_cast<float>(moved);
        ++morphs;
    }
    if (morphs == 0) return std::nullopt;
    const Vec3 mean = sum / static_cast<float>(morphs);
    return FacePlace{
        .place = {scan.middle().x, mean.y, mean.z}, .half_width = half_width, .found_by = "its morphs"};
}

bool is_blink(const std::string& name) {
    const auto channel = face_channel_named(name);
    if (channel) return channel->unit == 45;
    return names_one_of(name, {"blink", "eyeclose", "eye_close", "eyesclose", "closeeye", "eyelidclose"});
}

// Not the jaw, which moves the chin most.
bool is_mouth_morph(const std::string& name) {
    static const std::vector<int> units = {10, 12, 14, 15, 16, 18, 20, 22, 23, 24, 25, 28};
    static const Words shapes = {"a", "i", "u", "e", "o", "aa", "ih", "ou", "ee", "oh"};
    const auto channel = face_channel_named(name);
    if (channel) return std::find(units.begin(), units.end(), channel->unit) != units.end();
    if (std::find(shapes.begin(), shapes.end(), to_lower(name)) != shapes.end()) return true;
    return names_one_of(name, {"mouth", "lip", "smile", "viseme", "_mth_"}) && !names_one_of(name, {"shrug"});
}

std::optional<Vec3> eye_joints(const Avatar& avatar) {
    const HumanoidMap& parts = avatar.humanoid;
    if (!parts.has(HumanJoint::left_eye) || !parts.has(HumanJoint::right_eye)) return std::nullopt;
    const auto joints = world_from_joints(avatar.skeleton, rest_transforms(avatar.skeleton));
    return (origin(joints[static_cast<size_t>(parts[HumanJoint::left_eye])]) +
            origin(joints[static_cast<size_t>(parts[HumanJoint::right_eye])])) *
           0.5f;
}

// The middle of the surfaces that are named after eyes and lie on the head.
std::optional<Vec3> eye_surfaces(const Avatar& avatar, const HeadScan& scan) {
    Vec3 low(std::numeric_limits<float>::max()), high = -low;
    for (size_t s = 0; s < avatar.surfaces.size(); ++s) {
        const std::string names = names_of(avatar, avatar.surfaces[s]);
        if (!names_one_of(names, {"eye", "iris", "pupil"}) || names_one_of(names, {"brow", "lash", "glass"}))
            continue;
        for (size_t v = 0; v < scan.on_head[s].size(); ++v) {
            if (scan.on_head[s][v] <= kCarried) continue;
            low = glm::min(low, scan.rest.surfaces[s].positions[v]);
            high = glm::max(high, scan.rest.surfaces[s].positions[v]);
        }
    }
    if (low.x > high.x) return std::nullopt;
    return (low + high) * 0.5f;
}

// Eyes lie between a quarter and four fifths of the way from the chin to the crown, on any face.
bool may_be_eyes(const HeadScan& scan, const Vec3& chin, const Vec3& eyes) {
    const float height = scan.high.y - chin.y;
    return eyes.y > chin.y + 0.25f * height && eyes.y < chin.y + 0.8f * height;
}

}  // namespace

float HeadScan::front_at(float y) const {
    const float place = (y - low.y) / std::max(high.y - low.y, 1e-6f) * static_cast<float>(kHeights - 1);
    return front[static_cast<size_t>(std::clamp(place + 0.5f, 0.0f, static_cast<float>(kHeights - 1)))];
}

std::vector<std::vector<float>> weights_below(const Avatar& avatar, const std::vector<int>& tops) {
    const std::vector<bool> below = joints_below(avatar.skeleton, tops);
    const auto is_below = [&](int joint) { return joint >= 0 && below[static_cast<size_t>(joint)]; };
    std::vector<std::vector<float>> all;
    for (const Surface& surface : avatar.surfaces) {
        const bool carried = surface.skin < 0 && is_below(surface.joint);
        auto& weights = all.emplace_back(surface.positions.size(), carried ? 1.0f : 0.0f);
        if (surface.skin < 0) continue;
        const Skin& skin = avatar.skins[static_cast<size_t>(surface.skin)];
        for (size_t v = 0; v < weights.size(); ++v) {
            for (auto i = surface.first_influence[v]; i < surface.first_influence[v + 1]; ++i) {
                const Influence& influence = surface.influences[i];
                if (is_below(skin.joints[influence.joint])) weights[v] += influence.weight;
            }
        }
    }
    return all;
}

bool is_hair(const Avatar& avatar, const Surface& surface) {
    return names_one_of(names_of(avatar, surface),
                        {"hair", "ponytail", "braid", "afro", "bob0", "hat", "helmet"});
}

std::optional<HeadScan> scan_head(const Avatar& avatar, int head) {
    HeadScan scan{.rest = rest_mesh(avatar), .on_head = weights_below(avatar, {head}), .front = {}};
    const auto skin = find_skin(avatar, scan.on_head);
    if (!skin) return std::nullopt;
    scan.skin = *skin;
    take_box(scan);
    take_front(scan, avatar.surfaces[scan.skin]);
    return scan;
}

Vec3 find_chin(const HeadScan& scan) {
    const float furthest = *std::max_element(scan.front.begin(), scan.front.end());
    const float turned_back = scan.middle().z + 0.4f * (furthest - scan.middle().z);
    const auto lowest =
        std::find_if(scan.front.begin(), scan.front.end(), [&](float front) { return front > turned_back; });
    const float way = static_cast<float>(lowest - scan.front.begin()) / static_cast<float>(kHeights - 1);
    return {scan.middle().x, glm::mix(scan.low.y, scan.high.y, way), *lowest};
}

FacePlace find_eyes(const Avatar& avatar, const HeadScan& scan, const Vec3& chin) {
    if (const auto joints = eye_joints(avatar); joints && may_be_eyes(scan, chin, *joints)) {
        return {.place = {scan.middle().x, joints->y, joints->z}, .found_by = "the eye joints"};
    }
    if (auto moved = moved_most(avatar, scan, is_blink); moved && may_be_eyes(scan, chin, moved->place)) {
        moved->found_by = "the morphs that close them";
        return *moved;
    }
    if (const auto named = eye_surfaces(avatar, scan); named && may_be_eyes(scan, chin, *named)) {
        return {.place = {scan.middle().x, named->y, named->z}, .found_by = "surfaces named after them"};
    }
    const float y = chin.y + kEyesOfHead * (scan.high.y - chin.y);
    return {.place = {scan.middle().x, y, scan.front_at(y)}, .found_by = "the shape of the head"};
}

FacePlace find_mouth(const Avatar& avatar, const HeadScan& scan, const Vec3& chin, const Vec3& eyes) {
    const float height = eyes.y - chin.y;
    if (auto moved = moved_most(avatar, scan, is_mouth_morph);
        moved && moved->place.y > chin.y + 0.1f * height && moved->place.y < chin.y + 0.7f * height) {
        return *moved;
    }
    const float y = chin.y + kMouthOfEyes * height;
    return {.place = {scan.middle().x, y, scan.front_at(y)}, .found_by = "the shape of the head"};
}

}  // namespace chironomia
