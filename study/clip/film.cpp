#include "study/clip/film.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <fstream>
#include <string>

#include "core/error.h"
#include "core/text.h"

namespace chironomia::study {
namespace {

const Performer& shown_in_film(const ClipJob& job) {
    const auto found = std::find_if(job.performers.begin(), job.performers.end(),
                                    [](const Performer& performer) { return !performer.film.empty(); });
    assert(found != job.performers.end());
    return *found;
}

CutFrames frames_shown(const ClipJob& job) {
    const Performer& performer = shown_in_film(job);
    const std::filesystem::path& file = performer.film;
    if (job.performers.size() != 1) {
        throw Error(
            format("{}: a film is shown alone, but the clip has {} performers; give it a clip of its own",
                   file.string(), job.performers.size()));
    }
    const double seconds = FilmReader(file, {.size = job.size, .fps = job.fps}).seconds();
    if (const auto& cut = cut_of(performer, job)) return cut_frames(*cut, seconds, job.fps, file);
    const long long frames = std::llround(seconds * job.fps.per_second());
    return {.first = 0, .count = static_cast<std::size_t>(std::max(1LL, frames))};
}

}  // namespace

bool is_film(const std::filesystem::path& file) {
    std::error_code none;
    if (!std::filesystem::is_regular_file(file, none)) return false;
    std::ifstream in(file, std::ios::binary);
    std::string head(12, '\0');
    if (!in || !in.read(head.data(), static_cast<std::streamsize>(head.size()))) return false;
    const bool mp4 = head.compare(4, 4, "ftyp") == 0;
    const bool webm = head.compare(0, 4, "\x1a\x45\xdf\xa3") == 0;
    const bool avi = head.compare(0, 4, "RIFF") == 0 && head.compare(8, 4, "AVI ") == 0;
    return mp4 || webm || avi;
}

Film::Film(const ClipJob& job) : Film(job, frames_shown(job)) {}

Film::Film(const ClipJob& job, const CutFrames& shown)
    : reader_(job.performers.front().film,
              {.size = job.size, .fps = job.fps, .begin = job.fps.seconds(shown.first)}),
      frames_(shown.count) {}

const Frame& Film::next() {
    if (shown_++ < frames_) picture_ = reader_.next();
    return picture_;
}

}  // namespace chironomia::study
