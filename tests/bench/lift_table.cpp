// lift_table FILE.bvh ...: each motion is filmed from in front and from 30 degrees to either side, without
// and with a detector's noise, lifted back, and compared with what it was. Lengths are in shoulder widths.
#include <CLI/CLI.hpp>
#include <cstdio>
#include <ctime>

#include "core/error.h"
#include "core/text.h"
#include "skinning/motion/motion_file.h"
#include "tests/skinning/lift/lift_trial.h"

using namespace chironomia;
using namespace chironomia::testing;

namespace {

void print_row(const std::string& name, const Motion& motion, const TrialCamera& camera) {
    const Trial trial = film(motion, camera);
    const std::clock_t begin = std::clock();
    const Lift lifted = lift(trial.picture);
    const double spent = 1000.0 * static_cast<double>(std::clock() - begin) / CLOCKS_PER_SEC;
    const TrialResult result = judge(trial, lifted);
    std::printf("| %-28s | %4.0f | %3.1f | %6.3f | %6.3f | %6.3f | %4zu | %5.2f | %7.2f | %3d | %6.2f |\n",
                name.c_str(), camera.yaw_deg, camera.noise, result.elbows, result.wrists, result.mean,
                result.longest_flip, result.jerk_ratio, result.strokes, result.lag,
                spent / static_cast<double>(motion.frames));
}

}  // namespace

int main(int count, char** arguments) {
    CLI::App app("How near lifted motions come to true ones");
    std::vector<std::filesystem::path> files;
    TrialCamera camera;
    app.add_option("files", files, "BVH files")->required();
    app.add_option("--seed", camera.seed, "Of the noise [1]");
    app.add_option("--distance", camera.distance, "Of the camera [4 m]");
    app.add_flag("--stays", camera.stays, "It stays where it was in the first frame [goes along]");
    app.add_flag("--known", camera.known, "The lifter knows its lens");
    CLI11_PARSE(app, count, arguments);
    std::puts(
        "| motion                       |  yaw |  px | elbows | wrists |   mean | flip |  jerk | strokes | "
        "lag | "
        "ms CPU |\n"
        "|------------------------------|------|-----|--------|--------|--------|------|-------|---------|---"
        "--|"
        "--------|");
    try {
        for (const std::filesystem::path& file : files) {
            const Motion motion = read_motion(file);
            for (const double yaw : {0.0, 30.0, -30.0}) {
                camera.yaw_deg = yaw;
                for (const double noise : {0.0, 1.5}) {
                    camera.noise = noise;
                    camera.drop_outs = noise > 0 ? 0.05 : 0;
                    print_row(file.stem().string(), motion, camera);
                }
            }
        }
    } catch (const Error& error) {
        std::fprintf(stderr, "%s\n", error.what());
        return 3;
    }
}
