#include "synth/learned/faces/face_animation.h"

#include <algorithm>
#include <cmath>

#include "core/error.h"
#include "core/files/files.h"
#include "core/hdf5/file.h"
#include "core/hdf5/writer.h"
#include "core/text.h"
#include "synth/features/contour.h"

namespace chironomia {

namespace fs = std::filesystem;

namespace {

std::vector<float> floats_of(const std::vector<double>& numbers) {
    return {numbers.begin(), numbers.end()};
}

std::vector<CorpusWord> read_words(const Hdf5File& hdf5) {
    const std::vector<std::string> texts = hdf5.read_texts("words");
    const std::vector<double> times = hdf5.read_numbers("times", {texts.size(), 2});
    std::vector<CorpusWord> words;
    double end = 0;
    for (std::size_t i = 0; i < texts.size(); ++i) {
        words.push_back({.text = texts[i], .start = times[2 * i], .end = times[2 * i + 1]});
        if (words[i].start < end - 1e-6 || words[i].end <= words[i].start) {
            hdf5.refuse(
                format("word {} (\"{}\") is from {} to {} s, the one before it ends at {} s; bring the "
                       "words in order",
                       i + 1, texts[i], words[i].start, words[i].end, end));
        }
        end = words[i].end;
    }
    return words;
}

}  // namespace

SpokenFile read_spoken(const fs::path& file) {
    const auto bytes = read_bytes(file);
    const Hdf5File hdf5(bytes, file.string());
    SpokenFile spoken{.text_encoder = hdf5.read_texts("text_encoder").at(0)};
    SpokenWords& speech = spoken.speech;
    speech.words = read_words(hdf5);
    speech.vectors = floats_of(hdf5.read_numbers("vectors", {speech.words.size(), kWordVector}));
    speech.frames =
        static_cast<std::size_t>(std::ceil(std::max(0.0, hdf5.read_numbers("seconds", {})[0]) * speech.fps));
    auto pitch = fill_pitch(floats_of(hdf5.read_numbers("f0", {Hdf5File::kAny})), IpuRecord::kSpeechRate,
                            speech.words);
    if (!pitch) hdf5.refuse("no word is voiced: /f0 is 0 in all of them; give the pitch of speech");
    speech.f0 = std::move(*pitch);
    return spoken;
}

std::vector<FaceUnit> units_of_speech(SpokenWords speech, const UnitCut& cut) {
    speech.cut = cut;
    std::vector<FaceUnit> units;
    for (std::size_t begin = 0; begin < speech.words.size();) {
        std::size_t end = begin + 1;
        while (end < speech.words.size() &&
               speech.words[end].start - speech.words[end - 1].end <= kUnitSilence)
            ++end;
        for (FaceUnit& unit : spoken_units(speech, begin, end)) units.push_back(std::move(unit));
        begin = end;
    }
    return units;
}

void write_animation(const fs::path& file, const FaceAnimation& animation) {
    const FaceMotion& motion = animation.motion;
    const auto bridged =
        bridge_gaps({.values = motion.values, .width = kFaceChannels, .success = motion.said})
            .value_or(std::vector<float>(motion.values.size()));
    const std::vector<float> smooth = smoothed(bridged, kFaceChannels, animation.smooth * animation.fps);
    const auto scale = face_scale();
    std::vector<float> units, head;
    for (std::size_t i = 0; i < smooth.size(); ++i) {
        const std::size_t c = i % kFaceChannels;
        const double value = scale[c][0] + smooth[i] * (scale[c][1] - scale[c][0]);
        (c < IpuRecord::kUnits ? units : head).push_back(static_cast<float>(value));
    }
    PendingOutput output(file, PendingOutput::Kind::file);
    Hdf5Writer writer(output.path(), file.string());
    writer.write_number("fps", animation.fps);
    writer.write_floats("units", {motion.frames(), IpuRecord::kUnits}, units);
    writer.write_floats("head", {motion.frames(), IpuRecord::kAngles}, head);
    writer.close();
    output.commit();
}

}  // namespace chironomia
