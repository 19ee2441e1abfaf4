#include "skinning/motion/bvh/bvh.h"

#include <algorithm>
#include <cmath>

#include "core/error.h"
#include "core/files/files.h"
#include "core/text.h"

namespace chironomia {
namespace {

using Turn = glm::dquat;
using Place = glm::dvec3;

constexpr double kCentimetres = 100;
constexpr double kDegrees = 1 / kDegree;

// A joint in a skeleton whose rest pose has no turns and no scale: all that BVH can say.
struct WrittenJoint {
    std::string name;
    int parent = -1;
    std::vector<size_t> children;
    Place offset{0};                                        // [cm]
    Turn rest_world{1, 0, 0, 0}, parent_world{1, 0, 0, 0};  // turns of the rest pose that BVH leaves out
    Place parent_scale{1};
    bool moves = false;  // its place changes
    bool is_end = false;
};

// Rotations about z, then x, then y, in the order of the channels [degrees].
Place euler_zxy(const Turn& turn) {
    const glm::dmat3 m = glm::mat3_cast(turn);  // m[column][row]
    const double cosine = std::hypot(m[0][2], m[2][2]);
    const double x = std::atan2(m[1][2], cosine);
    // Looking straight up or down, z and y turn about the same axis; all of it is given to z.
    if (cosine < 1e-7) return Place(std::atan2(m[0][1], m[0][0]), x, 0) * kDegrees;
    return Place(std::atan2(-m[1][0], m[1][1]), x, std::atan2(-m[0][2], m[2][2])) * kDegrees;
}

// BVH's readers part names at spaces.
std::string written_name(const Joint& joint, size_t index) {
    std::string name = joint.name.empty() ? format("joint_{}", index) : joint.name;
    for (char& c : name) {
        if (static_cast<unsigned char>(c) <= ' ' || c == '{' || c == '}') c = '_';
    }
    return name;
}

class BvhWriter {
  public:
    explicit BvhWriter(const Motion& motion) : motion_(motion), track_(*motion.joints) {
        for (size_t j = 0; j < count(); ++j) add_joint(j);
        for (size_t j = 0; j < count(); ++j) find_movement(j);
        for (size_t j = 0; j < count(); ++j) joints_[j].is_end = is_end_site(j);
    }

    std::string write() {
        text_ = "HIERARCHY\n";
        write_roots();
        text_ += format("MOTION\nFrames: {}\nFrame Time: {:.10g}\n", motion_.frames, 1 / motion_.fps);
        for (size_t t = 0; t < motion_.frames; ++t) write_row(t);
        return std::move(text_);
    }

  private:
    size_t count() const { return track_.skeleton.joints.size(); }

    void add_joint(size_t index) {
        const Joint& joint = track_.skeleton.joints[index];
        WrittenJoint bvh{.name = written_name(joint, index), .parent = joint.parent, .children = {}};
        if (joint.parent >= 0) {
            WrittenJoint& parent = joints_[static_cast<size_t>(joint.parent)];
            bvh.parent_world = parent.rest_world;
            bvh.parent_scale =
                parent.parent_scale * Place(track_.skeleton.joints[size_t(joint.parent)].rest.scale);
            parent.children.push_back(index);
        }
        bvh.rest_world = normalize(bvh.parent_world * Turn(joint.rest.rotation));
        bvh.offset = place_in_bvh(bvh, joint.rest.translation);
        joints_.push_back(std::move(bvh));
    }

    static Place place_in_bvh(const WrittenJoint& joint, const Vec3& translation) {
        return joint.parent_world * (joint.parent_scale * Place(translation)) * kCentimetres;
    }

    Place place(size_t t, size_t j) const {
        return place_in_bvh(joints_[j], track_.translations[t * count() + j]);
    }

    // With W the world turns of the rest pose: W_parent * turn * W^-1 keeps every world direction.
    Turn turn(size_t t, size_t j) const {
        const Turn local = normalize(Turn(track_.turns[t * count() + j]));
        return joints_[j].parent_world * local * glm::conjugate(joints_[j].rest_world);
    }

    void find_movement(size_t j) {
        for (size_t t = 0; t < motion_.frames && !joints_[j].moves; ++t) {
            joints_[j].moves =
                glm::distance(place(t, j), joints_[j].offset) > 1e-4;  // a thousandth of a millimetre
        }
    }

    // A joint that the reader made of an End Site and that nobody turned since.
    bool is_end_site(size_t j) const {
        const WrittenJoint& joint = joints_[j];
        if (joint.parent < 0 || !joint.children.empty() || joint.moves || joint.offset == Place(0))
            return false;
        if (joint.name != joints_[static_cast<size_t>(joint.parent)].name + "_end") return false;
        for (size_t t = 0; t < motion_.frames; ++t) {
            if (std::abs(turn(t, j).w) < 1 - 1e-10) return false;
        }
        return true;
    }

    // BVH has one root; several get a still one above them.
    void write_roots() {
        std::vector<size_t> roots;
        for (size_t j = 0; j < count(); ++j) {
            if (joints_[j].parent < 0) roots.push_back(j);
        }
        has_world_ = roots.size() > 1;
        if (!has_world_) return write_joint(roots.front(), 0);
        text_ += "ROOT world\n{\n\tOFFSET 0 0 0\n\tCHANNELS 3 Zrotation Xrotation Yrotation\n";
        for (const size_t root : roots) write_joint(root, 1);
        text_ += "}\n";
    }

    // Depth first, as the channels of a row must follow. The way is kept in a list, for skeletons of any
    // depth.
    void write_joint(size_t top, size_t depth) {
        struct Step {
            size_t joint, depth;
            bool closes;
        };
        std::vector<Step> steps = {{top, depth, false}};
        while (!steps.empty()) {
            const Step step = steps.back();
            steps.pop_back();
            const std::string indent(step.depth, '\t');
            if (step.closes) {
                text_ += indent + "}\n";
                continue;
            }
            open_joint(step.joint, indent);
            steps.push_back({step.joint, step.depth, true});
            const auto& children = joints_[step.joint].children;
            for (auto child = children.rbegin(); child != children.rend(); ++child) {
                steps.push_back({*child, step.depth + 1, false});
            }
        }
    }

    void open_joint(size_t j, const std::string& indent) {
        const WrittenJoint& joint = joints_[j];
        const bool root = joint.parent < 0 && !has_world_;
        if (joint.is_end)
            text_ += format("{}End Site\n", indent);
        else
            text_ += format("{}{} {}\n", indent, root ? "ROOT" : "JOINT", joint.name);
        // Readers that add positions to OFFSET and readers that replace it agree about a root at 0.
        text_ += format("{}{{\n{}\tOFFSET {}\n", indent, indent, numbers(root ? Place(0) : joint.offset));
        if (joint.is_end) return;
        order_.push_back(j);
        text_ += format("{}\tCHANNELS {}Zrotation Xrotation Yrotation\n", indent,
                        has_place(j) ? "6 Xposition Yposition Zposition " : "3 ");
        if (!joint.children.empty()) return;
        text_ +=
            format("{0}\tEnd Site\n{0}\t{{\n{0}\t\tOFFSET 0.000000 0.000000 0.000000\n{0}\t}}\n", indent);
    }

    bool has_place(size_t j) const { return joints_[j].moves || joints_[j].parent < 0; }

    static std::string numbers(const Place& values) {
        const auto plain = [](double value) {
            return std::abs(value) < 5e-7 ? 0.0 : value;
        };  // no "-0.000000"
        return format("{:.6f} {:.6f} {:.6f}", plain(values.x), plain(values.y), plain(values.z));
    }

    void write_row(size_t t) {
        std::string row = has_world_ ? "0 0 0 " : "";
        for (const size_t j : order_) {
            if (has_place(j)) row += numbers(place(t, j)) + " ";
            row += numbers(euler_zxy(turn(t, j))) + " ";
        }
        row.back() = '\n';
        text_ += row;
    }

    const Motion& motion_;
    const JointTrack& track_;
    std::vector<WrittenJoint> joints_;
    std::vector<size_t> order_;  // joints with channels, in the order of the file
    bool has_world_ = false;     // a root above several roots
    std::string text_;
};

}  // namespace

void write_bvh(const std::filesystem::path& file, const Motion& motion) {
    if (!motion.joints || motion.joints->skeleton.joints.empty()) {
        throw Error(format(
            "{}: the motion of {} has no joints, and BVH holds nothing else; put it onto an avatar first",
            file.string(), motion.source));
    }
    write_text(file, BvhWriter(motion).write());
}

}  // namespace chironomia
