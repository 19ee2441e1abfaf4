#include "synth/learned/styles/style_encodings.h"

#include <torch/utils.h>

#include <algorithm>
#include <map>
#include <string>
#include <utility>

#include "core/error.h"
#include "core/hdf5/writer.h"
#include "core/text.h"
#include "synth/learned/training/job_fields.h"

namespace chironomia {

using torch::Tensor;

namespace {

constexpr std::size_t kUsualSpread = 50;      // segments of a speaker: 22 speakers are a map of 1,100 points
constexpr std::int64_t kEncodedAtATime = 32;  // segments

// At most `most` segments of each speaker, evenly spread over theirs.
std::vector<StyleWindow> spread_windows(const StyleRecords& records, std::int64_t frames, std::size_t most) {
    std::map<std::string, std::vector<StyleWindow>> of_speaker;
    for (const StyleWindow& window : style_windows(records, frames, frames))
        of_speaker[records.entries()[window.entry].speaker].push_back(window);
    std::vector<StyleWindow> chosen;
    for (const auto& [speaker, windows] : of_speaker) {
        const std::size_t count = std::min(most, windows.size());
        for (std::size_t k = 0; k < count; ++k) chosen.push_back(windows[k * windows.size() / count]);
    }
    return chosen;
}

void write_matrix(Hdf5Writer& file, const char* path, const Tensor& rows) {
    const Tensor whole = rows.to(torch::kFloat32).contiguous();
    file.write_floats(path,
                      {static_cast<std::size_t>(whole.size(0)), static_cast<std::size_t>(whole.size(1))},
                      std::span(whole.data_ptr<float>(), static_cast<std::size_t>(whole.numel())));
}

}  // namespace

Json encode_styles(const StyleModel& model, const JsonValue& job) {
    begin_job(job);
    job_options(job).allow_only({"segments"});
    const auto asked = job_options(job).find("segments");
    const std::size_t most = asked ? static_cast<std::size_t>(asked->integer(1, 10'000)) : kUsualSpread;
    const CorpusIndex index = job_corpus(job, CorpusKind::intervals);
    StyleRecords records(index, index.of(job_split(job)), model.form);
    const std::vector<StyleWindow> windows = spread_windows(records, model.frames, most);
    if (windows.empty()) {
        throw Error(
            format("{}: no intervals of the split \"{}\"", index.folder.string(), name_of(job_split(job))));
    }
    const torch::NoGradGuard no_gradients;
    model.module->eval();
    std::vector<std::string> speakers, intervals;
    std::map<std::string, std::vector<Tensor>> encoded;  // by the array's name
    for (std::size_t first = 0; first < windows.size(); first += kEncodedAtATime) {
        const std::size_t count = std::min<std::size_t>(kEncodedAtATime, windows.size() - first);
        const StyleSegments segments =
            gather(records, std::span(windows).subspan(first, count), model.frames);
        encoded["style"].push_back(model.style_of(segments));
        encoded["content"].push_back(model.content_of(segments));
        for (StyleModality& modality : model.modalities_of(segments))
            encoded[modality.name].push_back(std::move(modality.encoded));
        if (model.guess_of) encoded["guess"].push_back(model.guess_of(segments));
        for (std::size_t i = first; i < first + count; ++i) {
            speakers.push_back(records.entries()[windows[i].entry].speaker);
            intervals.push_back(records.entries()[windows[i].entry].id);
        }
    }
    const std::string out = job.at("out").text();
    Hdf5Writer file(out, out);
    file.write_texts("speakers", speakers);
    file.write_texts("intervals", intervals);
    for (const auto& [name, rows] : encoded) write_matrix(file, name.c_str(), torch::cat(rows));
    file.close();
    return {{"segments", windows.size()}};
}

}  // namespace chironomia
