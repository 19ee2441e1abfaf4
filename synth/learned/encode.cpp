#include "synth/learned/encode.h"

#include "core/files/files.h"
#include "core/hdf5/writer.h"
#include "synth/corpus/records.h"
#include "synth/learned/bert.h"
#include "synth/learned/training/job_fields.h"

namespace chironomia {

Json encode_words(const JsonValue& job) {
    begin_job(job);
    const std::filesystem::path out = job.at("out").text();
    const WordPieces pieces(std::filesystem::path(job.at("vocabulary").text()));
    const BertStates bert = read_bert(job.at("weights").text());
    std::vector<float> vectors;
    for (const JsonValue& utterance : job.at("utterances").items(1)) {
        std::vector<std::string> words;
        for (const JsonValue& word : utterance.items(1)) words.push_back(word.text());
        const std::vector<float> rows = word_vectors(bert, pieces, words);
        vectors.insert(vectors.end(), rows.begin(), rows.end());
    }
    const std::size_t words = vectors.size() / kWordVector;
    PendingOutput pending(out, PendingOutput::Kind::file);
    Hdf5Writer writer(pending.path(), out.string());
    writer.write_floats("vectors", {words, kWordVector}, vectors);
    writer.close();
    pending.commit();
    return {{"words", words}};
}

}  // namespace chironomia
