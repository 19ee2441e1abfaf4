// Motions and faces: text forms, arrays, HDF5 and folders of OpenPose.
#include "core/files/files.h"
#include "core/hdf5/file.h"
#include "core/text.h"
#include "skinning/motion/motion_file.h"
#include "tests/fuzz/fuzz_reader.h"
#include "tests/support/support.h"

namespace chironomia::testing {
namespace {

void read_as_motion(const FuzzInput& input) {
    MotionHints hints;
    hints.fps = 25;
    read_motion(input.file(), hints);
}

void read_with_own_rate(const FuzzInput& input) {
    read_motion(input.file());
}

// Its frames are parted by form feeds, which JSON has nowhere.
void read_openpose_frames(const FuzzInput& input) {
    const std::filesystem::path folder = fuzz_folder() / "openpose";
    std::filesystem::remove_all(folder);
    std::filesystem::create_directory(folder);
    size_t number = 0;
    for (const std::string_view frame : split(input.text(), '\f'))
        write_text(folder / format("clip_{:012}_keypoints.json", number++), frame);
    MotionHints hints;
    hints.fps = 25;
    read_motion(folder, hints);
}

void read_with_names(const FuzzInput& input) {
    MotionHints hints;
    hints.fps = 25;
    hints.name_map = input.file();
    read_motion(source_dir() / "tests/fuzz/seeds/motion_csv/wide.csv", hints);
}

// Beside the array that it describes.
void read_description(const FuzzInput& input) {
    const std::filesystem::path file = input.file();
    static const bool copied = std::filesystem::copy_file(source_dir() / "tests/fixtures/motion/fortran.npy",
                                                          file.parent_path() / "x.npy");
    (void)copied;
    read_motion(file);
}

constexpr int kDeepestGroup = 6;  // a damaged group may lie in itself

void read_all_below(const Hdf5File& file, const std::string& path, int depth) {
    if (depth > kDeepestGroup) return;
    for (const std::string& name : file.names_in(path)) {
        const std::string inner = path.empty() ? name : path + "/" + name;
        if (!file.names_in(inner).empty()) {
            read_all_below(file, inner, depth + 1);
        } else {
            file.read(inner);
            file.attribute(inner, "fps");
            file.text_attribute(inner, "format");
        }
    }
}

void read_hdf5(const FuzzInput& input) {
    const Hdf5File file(input.bytes(), "x.h5");
    read_all_below(file, "", 0);
}

const AddFuzzReader kBvh({"bvh", "x.bvh", read_with_own_rate});
const AddFuzzReader kNumpy({"numpy", "x.npz", read_as_motion});
const AddFuzzReader kMotionCsv({"motion_csv", "x.csv", read_as_motion});
const AddFuzzReader kFaceCsv({"face_csv", "x.csv", read_with_own_rate});
const AddFuzzReader kPointsJson({"points_json", "x.json", read_as_motion});
const AddFuzzReader kMediapipe({"mediapipe", "x.json", read_with_own_rate});
const AddFuzzReader kOpenpose({"openpose", "x", read_openpose_frames});
const AddFuzzReader kNameMap({"name_map", "x.json", read_with_names});
const AddFuzzReader kArrayJson({"array_json", "array/x.json", read_description});
const AddFuzzReader kMotionHdf5({"motion_hdf5", "x.h5", read_with_own_rate});
const AddFuzzReader kHdf5({"hdf5", "x.h5", read_hdf5});

}  // namespace
}  // namespace chironomia::testing
