// head_table FILE.bvh ...: how near the pitch of lifted heads comes to the true one. Each motion moves avatars whose
// own faces a camera sees from in front and from 25 degrees to either side.
#include <CLI/CLI.hpp>
#include <cstdio>

#include "core/error.h"
#include "skinning/gltf/gltf.h"
#include "skinning/motion/motion_file.h"
#include "tests/skinning/lift/head_trial.h"

using namespace chironomia;
using namespace chironomia::testing;

int main(int count, char** arguments) {
    CLI::App app("How near the pitch of lifted heads comes to the true one");
    std::vector<std::filesystem::path> files;
    std::vector<std::filesystem::path> avatars = {"assets/avatars/female2.glb", "assets/avatars/male2.glb"};
    app.add_option("files", files, "BVH files")->required();
    app.add_option("--avatar", avatars, "Whose faces are seen [female2, male2]");
    CLI11_PARSE(app, count, arguments);
    try {
        std::puts(
            "| avatar | points | off [deg] | found less true [deg] | turn a frame [deg] | frames |\n"
            "| --- | --- | --- | --- | --- | --- |");
        for (const std::filesystem::path& file : avatars) {
            const Avatar avatar = read_avatar(file);
            std::array<PitchError, 2> errors;
            for (const std::filesystem::path& motion_file : files) {
                const Motion motion = read_motion(motion_file);
                for (const bool mouth : {false, true}) {
                    for (const double yaw : {0.0, 25.0, -25.0})
                        errors[mouth] += judge_head(
                            avatar, film_head(avatar, motion, {.yaw_deg = yaw, .sees_mouth = mouth}));
                }
            }
            for (const bool mouth : {false, true}) {
                const PitchError& error = errors[mouth];
                const double frames = static_cast<double>(std::max<size_t>(1, error.frames));
                std::printf("| %s | %s | %.1f | %.1f | %.2f | %zu |\n", file.stem().c_str(),
                            mouth ? "and mouth" : "nose, eyes, ears", error.off / frames, error.bias / frames,
                            error.turned / frames, error.frames);
            }
        }
    } catch (const Error& error) {
        std::fprintf(stderr, "%s\n", error.what());
        return 3;
    }
}
