// BERT's vectors of words in corpora and in synthesis: the real binary with weights that a test can carry.
// One is TorchScript whose state of a piece is the piece's number; the other has the shapes of
// BERT-base-uncased, and is 0 but for the last norm's bias.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <fstream>

#include "core/files/files.h"
#include "core/hash.h"
#include "core/text.h"
#include "synth/corpus/corpus.h"
#include "tests/study/corpus_info_of.h"
#include "tests/study/process.h"
#include "tests/study/recordings.h"
#include "tests/support/support.h"

namespace chironomia::study {
namespace {

namespace fs = std::filesystem;
using ::testing::HasSubstr;
using testing::Outcome;
using testing::run_chironomia;

constexpr const char* kVocabulary = "[PAD]\n[UNK]\n[CLS]\n[SEP]\nwell\n,\ndone\nthe\n";

// The shapes of the tensors of BERT-base by name.
std::vector<std::pair<std::string, std::vector<std::size_t>>> bert_base() {
    std::vector<std::pair<std::string, std::vector<std::size_t>>> shapes = {
        {"embeddings.word_embeddings.weight", {30522, 768}},
        {"embeddings.position_embeddings.weight", {512, 768}},
        {"embeddings.token_type_embeddings.weight", {2, 768}},
        {"embeddings.LayerNorm.weight", {768}},
        {"embeddings.LayerNorm.bias", {768}}};
    for (int i = 0; i < 12; ++i) {
        const auto add = [&](const std::string& name, std::size_t outputs, std::size_t inputs) {
            const std::string at = format("encoder.layer.{}.{}", i, name);
            shapes.push_back({at + ".weight", inputs == 0 ? std::vector<std::size_t>{outputs}
                                                          : std::vector<std::size_t>{outputs, inputs}});
            shapes.push_back({at + ".bias", {outputs}});
        };
        for (const char* part : {"query", "key", "value"}) add(format("attention.self.{}", part), 768, 768);
        add("attention.output.dense", 768, 768);
        add("attention.output.LayerNorm", 768, 0);
        add("intermediate.dense", 3072, 768);
        add("output.dense", 768, 3072);
        add("output.LayerNorm", 768, 0);
    }
    return shapes;
}

// Half floats, all 0 but the last norm's bias: 1.5 in every place. The zeros take no room on the disk. One
// tensor may be left out.
void write_bert_base(const fs::path& file, const std::string& without = "") {
    constexpr char kOneAndAHalf[] = {0x00, 0x3e};
    Json header;
    std::size_t place = 0, bias = 0;
    for (const auto& [name, shape] : bert_base()) {
        if (name == without) continue;
        std::size_t size = 2;
        for (const std::size_t extent : shape) size *= extent;
        header[name] = {{"dtype", "F16"}, {"shape", shape}, {"data_offsets", {place, place + size}}};
        if (name == "encoder.layer.11.output.LayerNorm.bias") bias = place;
        place += size;
    }
    const std::string text = header.dump();
    std::ofstream stream(file, std::ios::binary);
    for (std::size_t i = 0; i < 8; ++i) stream.put(static_cast<char>(text.size() >> (8 * i) & 255));
    stream << text;
    stream.seekp(static_cast<std::streamoff>(8 + text.size() + bias));
    for (int i = 0; i < 768; ++i) stream.write(kOneAndAHalf, sizeof kOneAndAHalf);
    stream.close();
    fs::resize_file(file, 8 + text.size() + place);
}

class Bert : public ::testing::Test {
  protected:
    Bert() {
        fs::create_directory(file("bert"));
        fs::copy_file(testing::source_dir() / "tests/fixtures/learned/script.pt", file("bert/model.pt"));
        write_text(file("bert/vocab.txt"), kVocabulary);
        testing::write_openface(file("face.csv"), {});
        testing::write_voice(file("voice.wav"));
        testing::write_timed_words(file("words.csv"));
        write_json(file("m.json"), {{"kind", "talks"},
                                    {"recordings",
                                     {{{"id", "t1"},
                                       {"speaker", "anna"},
                                       {"face", "face.csv"},
                                       {"audio", "voice.wav"},
                                       {"words", "words.csv"}}}}});
    }

    fs::path file(const std::string& name) { return folder_ / name; }
    Outcome import_with(const std::string& bert) {
        return run_chironomia({"corpus", "import", file("m.json").string(), "--bert", file(bert).string(),
                               "--out", file("out").string(), "--quiet"});
    }
    std::string refusal_of_import(const std::string& bert) {
        const Outcome outcome = import_with(bert);
        EXPECT_EQ(outcome.exit_code, 3) << outcome.out;
        EXPECT_FALSE(fs::exists(file("out")));
        return outcome.err;
    }

    testing::TemporaryFolder folder_;
};

TEST_F(Bert, MakesTheVectorsOfAnImportedCorpus) {
    const Outcome made = import_with("bert");
    ASSERT_EQ(made.exit_code, 0) << made.err;
    const CorpusIndex corpus = read_corpus_index(file("out"));
    EXPECT_EQ(corpus.text_encoder, "bert-base-uncased");
    EXPECT_EQ(corpus.origin["text_encoder_sha256"], sha256_of_file(file("bert/model.pt")));
    const IpuRecord unit = read_ipu(corpus, corpus.entries.at(0));
    ASSERT_EQ(unit.words.size(), 3u);  // "well", ",", "done"
    EXPECT_EQ(unit.vectors[0], 4);
    EXPECT_EQ(unit.vectors[768 + 5], 5);
    EXPECT_EQ(unit.vectors[2 * 768 + 767], 6);
    EXPECT_EQ(read_ipu(corpus, corpus.entries.at(1)).vectors[0], 1) << "\"again\" is [UNK]";
}

TEST_F(Bert, TakesWeightsOfTheShapesOfBertBase) {
    fs::create_directory(file("base"));
    write_text(file("base/vocab.txt"), kVocabulary);
    write_bert_base(file("base/model.safetensors"));
    const Outcome made = import_with("base");
    ASSERT_EQ(made.exit_code, 0) << made.err;
    const CorpusIndex corpus = read_corpus_index(file("out"));
    for (const float value : read_ipu(corpus, corpus.entries.at(0)).vectors) ASSERT_EQ(value, 1.5f);

    fs::remove_all(file("out"));
    write_bert_base(file("base/model.safetensors"), "encoder.layer.7.output.dense.bias");
    EXPECT_THAT(refusal_of_import("base"),
                HasSubstr("model.safetensors: tensor \"encoder.layer.7.output.dense.bias\" is missing"));
    fs::resize_file(file("base/model.safetensors"), 1'000'000);
    EXPECT_THAT(refusal_of_import("base"), HasSubstr("model.safetensors: "));
}

TEST_F(Bert, SaysWhatIsMissingOrBroken) {
    EXPECT_THAT(refusal_of_import("none"),
                HasSubstr("none: there is neither model.safetensors nor model.pt; give the folder of "
                          "BERT-base-uncased"));
    fs::remove(file("bert/vocab.txt"));
    EXPECT_THAT(refusal_of_import("bert"), HasSubstr("vocab.txt: there is no such file"));
    write_text(file("bert/vocab.txt"), "[PAD]\n[UNK]\n[CLS]\nwell\n");
    EXPECT_THAT(refusal_of_import("bert"), HasSubstr("vocab.txt: [SEP] is missing among 4 pieces"));
    write_text(file("bert/vocab.txt"), kVocabulary);
    write_text(file("bert/model.pt"), "no archive");
    EXPECT_THAT(refusal_of_import("bert"),
                HasSubstr("model.pt: is neither a safetensors nor a TorchScript file"));
    const Outcome synth = run_chironomia({"synth", "--engine", "model2", "--text", "Well.", "--bert",
                                          file("none").string(), "--out", file("m.h5").string()});
    EXPECT_EQ(synth.exit_code, 3);
    EXPECT_THAT(synth.err, HasSubstr("none: there is neither model.safetensors nor model.pt"));
}

TEST_F(Bert, MakesTheVectorsAndTokensOfIntervals) {
    const Outcome made =
        run_chironomia({"corpus", "make", "--kind", "intervals", "--size", "ci", "--speakers", "1", "--bert",
                        file("bert").string(), "--out", file("out").string(), "--quiet"});
    ASSERT_EQ(made.exit_code, 0) << made.err;
    const CorpusIndex corpus = read_corpus_index(file("out"));
    EXPECT_EQ(corpus.text_encoder, "bert-base-uncased");
    const IntervalRecord interval = read_interval(corpus, corpus.entries.at(0));
    for (std::size_t t = 0; t < interval.frames(); ++t) {
        // A frame between words has no vector and the token 0; a word is as its only piece.
        EXPECT_EQ(interval.vectors[t * kWordVector], static_cast<float>(interval.tokens[t])) << t;
        EXPECT_TRUE(interval.tokens[t] <= 1 || interval.tokens[t] == 7) << interval.tokens[t];
    }
}

// A checkpoint and what it is asked with must have words of the same encoder.
TEST_F(Bert, SpeaksThroughACheckpointThatHasLearnedItsVectors) {
    const std::string corpus = file("talks").string(), checkpoint = file("learned.safetensors").string();
    ASSERT_EQ(run_chironomia({"corpus", "make", "--kind", "talks", "--size", "ci", "--speakers", "1",
                              "--bert", file("bert").string(), "--out", corpus, "--quiet"})
                  .exit_code,
              0);
    const Outcome trained = run_chironomia({"train", "model2", "--corpus", corpus, "--preset", "small",
                                            "--steps", "1", "--out", checkpoint, "--quiet"});
    ASSERT_EQ(trained.exit_code, 0) << trained.err;
    const auto synth = [&](const std::vector<std::string>& more) {
        std::vector<std::string> words = {
            "synth", "--engine",           "model2", "--text", "Well, the work is done.",
            "--out", file("m.h5").string()};
        words.insert(words.end(), more.begin(), more.end());
        return run_chironomia(words);
    };
    const Outcome made = synth({"--checkpoint", checkpoint, "--bert", file("bert").string()});
    EXPECT_EQ(made.exit_code, 0) << made.err;
    EXPECT_TRUE(fs::exists(file("m.h5")));
    fs::remove(file("m.h5"));
    const Outcome without = synth({"--checkpoint", checkpoint});
    EXPECT_EQ(without.exit_code, 3);
    EXPECT_THAT(
        without.err,
        HasSubstr("learned.safetensors: it has learned words as vectors of \"bert-base-uncased\", and these "
                  "would be of \"hashbert\"; give BERT's folder with --bert"));
    const Outcome bundled = synth({"--bert", file("bert").string()});
    EXPECT_EQ(bundled.exit_code, 3);
    EXPECT_THAT(bundled.err,
                HasSubstr("it has learned words as vectors of \"hashbert\", and these would be of "
                          "\"bert-base-uncased\"; leave out --bert"));
    EXPECT_FALSE(fs::exists(file("m.h5")));
}

}  // namespace
}  // namespace chironomia::study
