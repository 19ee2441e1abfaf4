#include "skinning/gltf/gltf_animation.h"

#include <tiny_gltf.h>

#include <algorithm>
#include <cassert>
#include <cmath>
#include <set>
#include <span>

#include "core/error.h"
#include "core/text.h"
#include "skinning/gltf/gltf_accessor.h"
#include "skinning/gltf/gltf_scene.h"
#include "skinning/skin.h"

namespace chironomia {
namespace {

constexpr float kUnitError = 0.05f;  // of a rotation, which may be stored in bytes

const Json& list_of(const GltfFile& file, const Json& object, const std::string& key,
                    const std::string& what) {
    if (!object.is_object() || !object.contains(key) || !object.at(key).is_array())
        refuse(file, format("{} has no list of {}; the file is broken, get it again", what, key));
    return object.at(key);
}

std::string word_of(const Json& object, const std::string& key, const std::string& otherwise) {
    return object.contains(key) && object.at(key).is_string() ? object.at(key).get<std::string>() : otherwise;
}

// Reads one animation; the parts of a scene that it may move are already known.
class AnimationReader {
  public:
    AnimationReader(GltfScene& scene, const Json& json, size_t index)
        : scene_(scene), json_(json), name_(json.is_object() ? word_of(json, "name", "") : "") {
        label_ = name_.empty() ? format("animation {}", index) : format("animation \"{}\"", name_);
    }

    Animation read() {
        Animation animation{.name = name_, .seconds = 0, .tracks = {}};
        const Json& channels = list_of(scene_.file, json_, "channels", label_);
        for (size_t c = 0; c < channels.size(); ++c) {
            what_ = format("{}, channel {}", label_, c);
            add_track(channels[c], animation.tracks);
        }
        for (const AnimationTrack& track : animation.tracks)
            animation.seconds = std::max<double>(animation.seconds, track.times.back());
        return animation;
    }

  private:
    [[noreturn]] void refuse_here(const std::string& problem) const {
        refuse(scene_.file, format("{} {}", what_, problem));
    }

    // The whole number behind a key; -1 if it is missing.
    long long integer_of(const Json& object, const std::string& key) const {
        if (!object.is_object()) refuse_here("is no object; the file is broken, get it again");
        if (!object.contains(key)) return -1;
        const Json& value = object.at(key);
        if (!value.is_number_integer()) {
            refuse(scene_.file,
                   format("{}: its {} is {}, a whole number is needed; the file is broken, get it again",
                          what_, key, value.dump(-1, ' ', false, Json::error_handler_t::replace)));
        }
        return value.get<long long>();
    }

    void add_track(const Json& channel, std::vector<AnimationTrack>& tracks) {
        if (!channel.is_object() || !channel.contains("target") || !channel.at("target").is_object())
            refuse_here("has no target; the file is broken, get it again");
        const Json& target = channel.at("target");
        const std::string path = word_of(target, "path", "");
        const long long node = integer_of(target, "node");
        if (!target.contains("node") || path == "pointer") return;  // an extension knows what it moves
        const auto nodes = static_cast<long long>(scene_.nodes.joint_of_node.size());
        if (node < 0 || node >= nodes)
            refuse_here(format("moves node {}, there are {}; the file is broken, get it again", node, nodes));
        AnimationTrack track;
        track.joint = scene_.nodes.joint_of_node[static_cast<size_t>(node)];
        if (track.joint < 0) return;
        find_path(path, track);
        if (!targets_.insert({track.joint, track.path}).second)
            refuse_here(
                format("moves the {} of node {} a second time; keep one channel of both", path, node));
        read_keys(integer_of(channel, "sampler"), track);
        tracks.push_back(std::move(track));
    }

    void find_path(const std::string& path, AnimationTrack& track) {
        if (path == "translation" || path == "scale") {
            track.path = path == "scale" ? AnimatedPath::scale : AnimatedPath::translation;
        } else if (path == "rotation") {
            track.path = AnimatedPath::rotation;
            track.width = 4;
        } else if (path == "weights") {
            track.path = AnimatedPath::weights;
            find_weights(track);
        } else {
            refuse_here(
                format("moves \"{}\", which is none of translation, rotation, scale and weights; the "
                       "file is broken, get it again",
                       path));
        }
    }

    void find_weights(AnimationTrack& track) {
        for (const Surface& surface : scene_.avatar.surfaces) {
            if (surface.joint != track.joint || surface.morphs.empty()) continue;
            track.first_weight = surface.first_morph_weight;
            track.width = surface.morphs.size();
            return;
        }
        refuse_here("moves the weights of a node without morphs; remove the channel");
    }

    void read_keys(long long sampler_index, AnimationTrack& track) {
        const Json& samplers = list_of(scene_.file, json_, "samplers", label_);
        if (sampler_index < 0 || sampler_index >= static_cast<long long>(samplers.size())) {
            refuse_here(format("uses sampler {}, there are {}; the file is broken, get it again",
                               sampler_index, samplers.size()));
        }
        const Json& sampler = samplers[static_cast<size_t>(sampler_index)];
        const int input = accessor_of(sampler, "input"), output = accessor_of(sampler, "output");
        find_interpolation(word_of(sampler, "interpolation", "LINEAR"), track);
        track.times = scene_.accessors.floats(input, 1, what_ + ": its times");
        expect_ascending(track.times);
        const size_t components = track.path == AnimatedPath::weights ? 1 : track.width;
        track.values = scene_.accessors.floats(output, components, what_ + ": its values");
        expect_count(track, components);
        if (track.path == AnimatedPath::rotation) expect_rotations(track);
    }

    int accessor_of(const Json& sampler, const std::string& key) const {
        const long long index = integer_of(sampler, key);
        const auto most = static_cast<long long>(scene_.model->accessors.size());
        if (index < 0 || index >= most) {
            refuse_here(format("has {} {}, there are {} accessors; the file is broken, get it again", key,
                               index, most));
        }
        return static_cast<int>(index);
    }

    void find_interpolation(const std::string& word, AnimationTrack& track) {
        if (word == "STEP") {
            track.interpolation = Interpolation::step;
        } else if (word == "CUBICSPLINE") {
            track.interpolation = Interpolation::cubic;
        } else if (word != "LINEAR") {
            refuse_here(
                format("is interpolated \"{}\", which is none of STEP, LINEAR and CUBICSPLINE; the "
                       "file is broken, get it again",
                       word));
        }
    }

    // Times that are rounded to the same float, as exporters at 60 frames/s or more write them, are a step.
    void expect_ascending(const std::vector<float>& times) const {
        if (times.empty()) refuse_here("has no keys; remove the channel");
        if (times[0] < 0)
            refuse_here(format("begins at {} s, its times must not be negative; repair the model", times[0]));
        for (size_t k = 1; k < times.size(); ++k) {
            if (times[k] < times[k - 1]) {
                refuse_here(format("has key {} at {} s after {} s, times must ascend; repair the model", k,
                                   times[k], times[k - 1]));
            }
        }
    }

    void expect_count(const AnimationTrack& track, size_t components) const {
        const size_t parts = track.interpolation == Interpolation::cubic ? 3 : 1;
        const size_t needed = track.times.size() * parts * (track.width / components);
        if (track.values.size() != needed * components) {
            refuse_here(format("has {} values for {} keys, {} are needed; the file is broken, get it again",
                               track.values.size() / components, track.times.size(), needed));
        }
    }

    void expect_rotations(const AnimationTrack& track) const {
        const bool cubic = track.interpolation == Interpolation::cubic;
        for (size_t k = 0; k < track.times.size(); ++k) {
            const float* q = &track.values[(cubic ? 3 * k + 1 : k) * 4];
            const float size = std::sqrt(q[0] * q[0] + q[1] * q[1] + q[2] * q[2] + q[3] * q[3]);
            if (!(std::abs(size - 1) <= kUnitError)) {
                refuse_here(format("has a rotation of length {:.4g} at key {}, 1 is needed; repair the model",
                                   size, k));
            }
        }
    }

    GltfScene& scene_;
    const Json& json_;
    std::string name_;
    std::string label_;
    std::string what_;
    std::set<std::pair<int, AnimatedPath>> targets_;
};

// Where a time lies among the keys: between `key` and the next, `share` of the way.
struct Moment {
    size_t key = 0;
    float share = 0;
    float span = 0;  // from the key to the next [s]; 0: the key itself
};

// Keys are stored as float: one that is meant for a frame may lie a little after it.
constexpr double kSameTime = 1e-5;  // [s]

Moment moment_at(const std::vector<float>& times, double time) {
    const auto after = std::upper_bound(times.begin(), times.end(), time + kSameTime);
    if (after == times.begin()) return {};
    const auto key = static_cast<size_t>(after - times.begin()) - 1;
    if (after == times.end()) return {.key = key};
    const float span = times[key + 1] - times[key];
    const auto share = static_cast<float>(std::max(0.0, time - times[key]) / span);
    return {.key = key, .share = share, .span = span};
}

Quat quat_of(std::span<const float> v) {
    return {v[3], v[0], v[1], v[2]};
}

std::vector<float> cubic_value(const AnimationTrack& track, const Moment& at) {
    const float t = at.share, t2 = t * t, t3 = t2 * t;
    const float* here = &track.values[at.key * 3 * track.width];
    const float* next = at.span > 0 ? here + 3 * track.width : here;
    std::vector<float> value(track.width);
    for (size_t i = 0; i < track.width; ++i) {
        const float from = here[track.width + i], leaving = here[2 * track.width + i];
        const float arriving = next[i], to = next[track.width + i];
        value[i] = (2 * t3 - 3 * t2 + 1) * from + at.span * (t3 - 2 * t2 + t) * leaving +
                   (3 * t2 - 2 * t3) * to + at.span * (t3 - t2) * arriving;
    }
    return value;
}

std::vector<float> value_at(const AnimationTrack& track, double time) {
    const Moment at = moment_at(track.times, time);
    if (track.interpolation == Interpolation::cubic) return cubic_value(track, at);
    const std::span here(&track.values[at.key * track.width], track.width);
    std::vector<float> value(here.begin(), here.end());
    if (track.interpolation == Interpolation::step || at.span == 0) return value;
    const std::span next(here.data() + track.width, track.width);
    if (track.path == AnimatedPath::rotation) {
        const Quat turn = slerp(normalize(quat_of(here)), normalize(quat_of(next)), at.share);
        return {turn.x, turn.y, turn.z, turn.w};
    }
    for (size_t i = 0; i < value.size(); ++i) value[i] += at.share * (next[i] - value[i]);
    return value;
}

void apply(const AnimationTrack& track, const std::vector<float>& v, Pose& pose) {
    Transform& transform = pose.joints[static_cast<size_t>(track.joint)];
    switch (track.path) {
        case AnimatedPath::translation:
            transform.translation = {v[0], v[1], v[2]};
            break;
        case AnimatedPath::scale:
            transform.scale = {v[0], v[1], v[2]};
            break;
        case AnimatedPath::rotation: {
            const Quat turn = quat_of(v);
            // A spline may pass through nothing between two turns; then it holds still.
            if (length(turn) > 1e-6f) transform.rotation = normalize(turn);
            break;
        }
        case AnimatedPath::weights:
            std::copy(v.begin(), v.end(), pose.morph_weights.begin() + track.first_weight);
            break;
    }
}

}  // namespace

AnimatedScene read_animated_scene(const std::filesystem::path& path, SceneNeed need) {
    const GltfFile file = open_gltf(path);
    GltfScene scene = read_gltf_parts(file, need);
    std::vector<Animation> animations;
    const Json none = Json::array();
    const Json& list = file.json.contains("animations") ? list_of(file, file.json, "animations", "it") : none;
    for (size_t a = 0; a < list.size(); ++a) animations.push_back(AnimationReader(scene, list[a], a).read());
    return {.scene = std::move(scene.avatar), .animations = std::move(animations)};
}

std::string shown(const Animation& animation) {
    return animation.name.empty() ? "without a name" : format("\"{}\"", animation.name);
}

size_t animation_named(const AnimatedScene& file, const std::string& asked) {
    std::vector<std::string> known;
    for (const Animation& animation : file.animations) {
        if (animation.name == asked) return known.size();
        known.push_back(format("{} {}", known.size(), shown(animation)));
    }
    const auto number = parse_integer(asked);
    if (number && *number >= 0 && *number < static_cast<long long>(file.animations.size()))
        return static_cast<size_t>(*number);
    throw Error(
        format("{}: has no animation \"{}\"; {}", file.scene.source, asked,
               known.empty() ? "it has none at all, leave --animation out" : "choose one of " + join(known)));
}

Pose pose_at(const Avatar& scene, const Animation& animation, double time) {
    Pose pose = rest_pose(scene);
    for (const AnimationTrack& track : animation.tracks) apply(track, value_at(track, time), pose);
    return pose;
}

}  // namespace chironomia
