#include "study/clip/walkers.h"

#include <algorithm>
#include <cmath>

#include "core/error.h"
#include "core/text.h"
#include "study/clip/camera_path.h"

namespace chironomia::study {
namespace {

// The first part that there is: stick figures may lack any.
std::size_t middle_joint(const HumanoidMap& parts) {
    using enum HumanJoint;
    for (const HumanJoint part : {hips, neck, head})
        if (parts.has(part)) return static_cast<std::size_t>(parts[part]);
    return 0;
}

Vec3 level_place(const Performance& performance, const std::vector<Transform>& joints, std::size_t joint) {
    const Vec3 place = origin(world_from_joints(performance.avatar.skeleton, joints)[joint]);
    return {place.x, 0, place.z};
}

// Where the hips are over the floor in each frame, (T) level, from where they are at rest [m].
std::vector<Vec3> hips_of(const Performance& performance) {
    const std::size_t hips = middle_joint(performance.avatar.humanoid);
    const Vec3 rest = level_place(performance, rest_transforms(performance.avatar.skeleton), hips);
    std::vector<Vec3> places;
    for (const Pose& pose : performance.fit.poses)
        places.push_back(level_place(performance, pose.joints, hips) - rest);
    return places;
}

std::vector<Vec3> from_the_first(std::vector<Vec3> places) {
    const Vec3 first = places.front();
    for (Vec3& place : places) place -= first;
    return places;
}

// The middle between the outermost of several people, as long as the last of them moves.
std::vector<Vec3> middle_of(const std::vector<std::vector<Vec3>>& people) {
    std::size_t frames = 0;
    for (const auto& places : people) frames = std::max(frames, places.size());
    std::vector<Vec3> middle;
    for (std::size_t t = 0; t < frames; ++t) {
        Vec3 low = people.front()[std::min(t, people.front().size() - 1)], high = low;
        for (const auto& places : people) {
            const Vec3& place = places[std::min(t, places.size() - 1)];
            low = glm::min(low, place);
            high = glm::max(high, place);
        }
        middle.push_back(0.5f * (low + high));
    }
    return middle;
}

// Ours: a person who comes nearer by so much, 3 to 5 m from the camera, is 5 to 9 % larger, for which scenes leave room
// [m].
constexpr float kFarthestOff = 0.25f;

// How far from the middle of the view a person may be: half of the middle third of its width, at the distance of
// the target [m].
float limit_in(const View& view) {
    const Camera& camera = view.scene.camera;
    const float half_height = distance(camera.eye, camera.target) * std::tan(camera.fov_y / 2);
    const float half_width =
        half_height * static_cast<float>(view.size.width) / static_cast<float>(view.size.height);
    return std::min(half_width / 3, kFarthestOff);
}

// Of all whom the camera of `performer` follows.
std::vector<std::vector<Vec3>> followed_places(const Performer& performer, const Performance& own,
                                               const ClipJob& job) {
    if (performer.followed.empty()) return {hips_of(own)};
    std::vector<std::vector<Vec3>> places;
    for (Performer plain : performer.followed) {
        plain.modes = {};
        places.push_back(hips_of(perform(plain, job)));
    }
    return places;
}

}  // namespace

void follow_walkers(std::vector<Performance>& people, const ClipJob& job, const Stage& stage) {
    if (job.travel == Travel::in_place) {
        for (Performance& person : people) person.travelled = from_the_first(hips_of(person));
    }
    if (job.travel != Travel::follow) return;
    for (const StagedView& staged : stage.views) {
        if (staged.view.figures.size() > 1) {
            throw Error(
                format("scene {}: shows {} people in one picture, a camera that follows goes along with 1; "
                       "choose split, let them step in place, or leave the camera where it is",
                       job.scene.string(), staged.view.figures.size()));
        }
        const std::size_t person = staged.view.figures.front();
        const auto places = followed_places(job.performers[person], people[person], job);
        people[person].travelled =
            camera_path(middle_of(places), {.limit = limit_in(staged.view), .fps = job.fps.per_second()});
    }
}

}  // namespace chironomia::study
