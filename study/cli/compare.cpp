// chironomia compare
#include <cmath>
#include <cstdio>

#include "core/json.h"
#include "core/text.h"
#include "raster/images/compare_files.h"
#include "study/cli/commands.h"

namespace chironomia {
namespace {

// JSON has no infinity: equal frames have no PSNR there.
Json or_null(double psnr) {
    return std::isinf(psnr) ? Json() : Json(psnr);
}

Json to_json(const FrameComparison& frame) {
    Json json;
    json["within_limits"] = frame.within_limits;
    json["mean_error"] = frame.mean_error;
    json["rms_error"] = frame.rms_error;
    json["psnr_db"] = or_null(frame.psnr);
    json["max_error"] = frame.max_error;
    json["max_at"] = {frame.max_x, frame.max_y};
    json["pixels"] = frame.pixels;
    json["pixels_above_small"] = frame.pixels_above_small;
    json["pixels_above_large"] = frame.pixels_above_large;
    return json;
}

Json to_json(const FileComparison& files) {
    Json json;
    json["within_limits"] = files.within_limits;
    json["size"] = {files.width, files.height};
    json["sound_error"] = files.sound_error ? Json(*files.sound_error) : Json();
    json["worst_frame"] = files.worst;
    for (const FrameComparison& frame : files.frames) json["frames"].push_back(to_json(frame));
    json["difference_images"] = Json::array();
    for (const auto& image : files.difference_images) json["difference_images"].push_back(image.string());
    return json;
}

// Frames beyond the limits, at most a screenful, then the verdict.
std::string to_text(const FileComparison& files) {
    constexpr std::size_t kMostRows = 20;
    std::string text;
    std::size_t beyond = 0;
    for (std::size_t n = 0; n < files.frames.size(); ++n) {
        const FrameComparison& frame = files.frames[n];
        if (frame.within_limits || ++beyond > kMostRows) continue;
        text += format(
            "frame {:5}: {} of {} pixels differ, the most by {:.0f} of 255 at ({}, {}); PSNR {:.1f} dB\n", n,
            frame.pixels_above_small, frame.pixels, 255 * frame.max_error, frame.max_x, frame.max_y,
            frame.psnr);
    }
    if (beyond > kMostRows) text += format("... and {} more frames\n", beyond - kMostRows);
    if (files.sound_error)
        text += format("sound: largest difference of a sample {:.4f}\n", *files.sound_error);
    for (const auto& image : files.difference_images) text += image.string() + "\n";
    text += format("{}: {} of {} frames within the limits; the worst is frame {}\n",
                   files.within_limits ? "the same" : "different", files.frames.size() - beyond,
                   files.frames.size(), files.worst);
    return text;
}

}  // namespace

int run(const CompareCommand& command) {
    const FileComparison result = compare_files(command.a, command.b, command.options);
    std::fputs((command.json ? to_json(result).dump(2) + "\n" : to_text(result)).c_str(), stdout);
    return result.within_limits ? kExitYes : kExitNo;
}

}  // namespace chironomia
