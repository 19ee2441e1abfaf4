#include "study/models/style_engine.h"

#include <cmath>

#include "core/error.h"
#include "core/files/files.h"
#include "core/hdf5/file.h"
#include "core/hdf5/writer.h"
#include "core/text.h"
#include "skinning/motion/picture/pats.h"
#include "synth/features/spectrum.h"
#include "synth/text/interval_text.h"

namespace chironomia::study {
namespace {

namespace fs = std::filesystem;

std::string whole_path(const std::string& path) {
    return fs::absolute(path).lexically_normal().string();
}

void write_words_of_frames(Hdf5Writer& writer, const Speech& speech, const std::string& model,
                           const TextEncoder& encoder) {
    std::vector<CorpusWord> words;
    for (const SpokenWord& word : speech.words)
        if (!word.text.empty()) words.push_back({.text = word.text, .start = word.start, .end = word.end});
    if (words.empty()) {
        throw Error(
            format("--engine {}: it needs to know what is said and when; give --words beside --speech, or a "
                   "text",
                   model));
    }
    const auto frames =
        static_cast<std::size_t>(std::ceil(speech.audio.duration() * IntervalRecord::kFps - 1e-9));
    const std::vector<float> vectors = encoder.vectors({texts_in(words)}).at(0);
    writer.write_texts("text_encoder", {encoder.name});
    writer.write_floats("text", {frames, kWordVector}, vectors_of_frames(words, vectors, frames));
}

}  // namespace

Json style_job(const std::string& text) {
    if (text.ends_with(".h5")) return {{"file", whole_path(text)}};
    const std::size_t colon = text.rfind(':');
    if (colon == std::string::npos) return {{"speaker", text}};
    return {{"corpus", whole_path(text.substr(0, colon))}, {"speaker", text.substr(colon + 1)}};
}

std::string speaker_of_interval(const fs::path& file) {
    return fs::absolute(file).lexically_normal().parent_path().filename().string();
}

void write_style_inputs(const fs::path& file, const Speech& speech, const std::string& model,
                        const TextEncoder* encoder) {
    const IntervalSpectra spectra = interval_spectra(speech.audio);
    const bool hears_64_bands = model == "mix-stage";
    const std::vector<float>& mel = hears_64_bands ? spectra.mel_400 : spectra.mel_512;
    const std::size_t bands = hears_64_bands ? IntervalRecord::kMel400 : IntervalRecord::kMel512;
    Hdf5Writer writer(file, file.string());
    writer.write_floats("mel", {mel.size() / bands, bands}, mel);
    writer.write_number("mel_rate",
                        hears_64_bands ? IntervalRecord::kMel400Rate : IntervalRecord::kMel512Rate);
    if (encoder) write_words_of_frames(writer, speech, model, *encoder);
    writer.close();
}

Motion read_styled_motion(const fs::path& file, const std::string& model) {
    const auto bytes = read_bytes(file);
    return read_pats(Hdf5File(bytes, format("the answer of {}", model)), std::nullopt);
}

}  // namespace chironomia::study
