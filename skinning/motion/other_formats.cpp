#include "skinning/motion/other_formats.h"

#include <array>

#include "core/error.h"
#include "core/text.h"

namespace chironomia {
namespace {

struct OtherFormat {
    std::string_view begin;   // of the content; "": any
    std::string_view ending;  // of the name, in small letters; "": any
    std::string_view what;
    std::string_view remedy;
};

constexpr std::string_view kTable =
    "give its points one header row NAME_x,NAME_y,NAME_z for each, such as LeftArm_x, and a row a frame";
constexpr std::string_view kArrays = "save its arrays with numpy.savez";

constexpr std::array kOthers = {
    OtherFormat{"Format Version,", "", "a table of OptiTrack Motive", "export the skeleton as BVH"},
    OtherFormat{"NO_OF_FRAMES", "", "a table of Qualisys Track Manager", kTable},
    OtherFormat{"PathFileType", "", "markers in TRC", kTable},
    OtherFormat{"Trajectories", "", "a table of Vicon Nexus", kTable},
    OtherFormat{"scorer,", "", "a table of DeepLabCut",
                "give its points one header row NAME_x,NAME_y,NAME_confidence for each, and a row a frame"},
    OtherFormat{"", ".c3d", "markers in C3D",
                "export BVH from the program that fits a skeleton to them, or a table with a row a frame"},
    OtherFormat{"", ".mvnx", "MVNX of Xsens", "export BVH from MVN"},
    OtherFormat{"", ".amc", "AMC, whose skeleton lies in an ASF", "convert both to BVH"},
    OtherFormat{"", ".asf", "ASF, a skeleton without its motion", "convert it with its AMC to BVH"},
    OtherFormat{"", ".skeleton", "a recording of NTU RGB+D",
                "save the joints of one body as .npy, (frames, 25, 3)"},
    OtherFormat{"", ".xlsx", "a workbook of Excel", "save the sheet with the positions of segments as CSV"},
    OtherFormat{"", ".pkl", "a pickle of Python, in which any program could be", kArrays},
    OtherFormat{"", ".pt", "a file of PyTorch, in which any program could be", kArrays},
    OtherFormat{"", ".pth", "a file of PyTorch, in which any program could be", kArrays},
};

}  // namespace

void refuse_other_formats(const std::filesystem::path& file, std::string_view content) {
    const std::string ending = to_lower(file.extension().string());
    for (const OtherFormat& other : kOthers) {
        const bool is_it = other.begin.empty() ? ending == other.ending : content.starts_with(other.begin);
        if (is_it)
            throw Error(
                format("{}: this is {}, which is not read; {}", file.string(), other.what, other.remedy));
    }
}

void refuse_other_folders(const std::filesystem::path& path) {
    std::error_code none;
    if (!std::filesystem::is_directory(path, none)) return;
    bool has_text = false, has_json = false;
    for (const auto& entry : std::filesystem::directory_iterator(path, none)) {
        has_text = has_text || entry.path().extension() == ".txt";
        has_json = has_json || entry.path().extension() == ".json";
    }
    const char* remedy = "name a file, or the folder in it that has those";
    if (has_text)
        remedy =
            "labels of YOLO, a text a picture, are not read: save the points of all frames as one .npy, "
            "(frames, 17, 3) of x, y in pixels and confidence";
    if (has_json)
        remedy =
            "JSON a picture is not read otherwise: write one JSON, a list of {\"frame_id\": 0, \"instances\": "
            "[{\"keypoints\": [[x, y], ...], \"keypoint_scores\": [...]}]} for each picture";
    throw Error(
        format("{}: this folder is no motion; folders of OpenPose (NAME_NUMBER_keypoints.json) and of CMU "
               "Panoptic (body3DScene_NUMBER.json) are read; {}",
               path.string(), remedy));
}

}  // namespace chironomia
