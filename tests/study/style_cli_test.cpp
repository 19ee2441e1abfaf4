// Models of style from a corpus to a picture: the real binary, few steps of the smallest preset.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <chrono>
#include <map>
#include <set>
#include <thread>

#include "core/files/files.h"
#include "core/files/json.h"
#include "core/text.h"
#include "skinning/motion/motion_hdf5.h"
#include "study/record/study_folder.h"
#include "synth/corpus/corpus.h"
#include "tests/study/process.h"
#include "tests/support/motion_hdf5.h"
#include "tests/support/support.h"

namespace chironomia::study {
namespace {

namespace fs = std::filesystem;
using ::testing::AllOf;
using ::testing::ElementsAre;
using ::testing::HasSubstr;
using testing::Outcome;
using testing::run_chironomia;
using testing::RunningChironomia;
using testing::TemporaryFolder;

void must(const std::vector<std::string>& words) {
    const Outcome outcome = run_chironomia(words);
    ASSERT_EQ(outcome.exit_code, 0) << outcome.err;
}

// Two speakers to learn from and one more, and a model that has hardly learned.
class Style : public ::testing::Test {
  protected:
    static void SetUpTestSuite() {
        if (fs::exists(model())) return;  // made for another suite
        must({"corpus", "make", "--kind", "intervals", "--size", "ci", "--speakers", "2+1", "--out", corpus(),
              "--quiet"});
        must({"train", "zs-mstm-1", "--corpus", corpus(), "--preset", "small", "--steps", "2", "--quiet",
              "--out", model()});
    }
    static std::string file(const std::string& name) {
        static const TemporaryFolder folder;
        return (folder / name).string();
    }
    static std::string corpus() { return file("pats"); }
    static std::string model() { return file("zs.safetensors"); }
    static std::string unseen_speaker() {
        return read_corpus_index(corpus()).of(Split::unseen).at(0).speaker;
    }
    // Of a short text, with these words added.
    static Outcome synth(const std::vector<std::string>& more) {
        std::vector<std::string> words{"synth", "--text", "There are two ways.", "--out", file("m.h5")};
        words.insert(words.end(), more.begin(), more.end());
        return run_chironomia(words);
    }
};

// Of a program that is killed nobody saves anything; what it saved before must do.
TEST_F(Style, LearnsOnToTheSameBytesAfterItWasKilled) {
    const auto command = [](const std::string& out) -> std::vector<std::string> {
        return {"train", "zs-mstm-1",    "--corpus", corpus(),  "--preset", "small",  "--steps",
                "5",     "--save-every", "0",        "--quiet", "--out",    file(out)};
    };
    RunningChironomia running(command("killed"));
    const fs::path json = file("killed.json");
    for (int i = 0; i < 6000 && !(fs::exists(json) && read_json(json)["step"] >= 2); ++i)
        std::this_thread::sleep_for(std::chrono::milliseconds(10));
    EXPECT_EQ(running.end(SIGKILL).exit_code, 128 + SIGKILL);
    const Json left = read_json(json);
    EXPECT_LT(left["step"], 5);
    EXPECT_EQ(left["training"]["state"]["batch"], left["step"]);  // within the first epoch
    must(command("killed"));
    must(command("whole"));
    for (const char* ending : {".json", ".safetensors", ".resume.safetensors", ".svg"})
        EXPECT_EQ(read_text(file(std::string("killed") + ending)),
                  read_text(file(std::string("whole") + ending)))
            << ending;
}

TEST_F(Style, MovesAsSomebodyWhomTheModelHasNotLearned) {
    const std::string who = corpus() + ":" + unseen_speaker();
    const Outcome made = synth(
        {"--engine", "zs-mstm", "--checkpoint", model(), "--style-of", who, "--speech-out", file("s.wav")});
    ASSERT_EQ(made.exit_code, 0) << made.err;
    EXPECT_THAT(made.err, HasSubstr("gestures by zs-mstm (zs.safetensors) in the style of " + who));
    const Motion motion = testing::read_motion_hdf5(file("m.h5"));
    EXPECT_EQ(motion.fps, 15);
    ASSERT_TRUE(motion.picture.has_value());
    EXPECT_GT(motion.frames, 45u);
    must({"render", "--motion", file("m.h5"), "--avatar", "stick", "--size", "160x120", "--cut", "1:1.2",
          "--out", file("frames/%05d.png")});
}

// What PATS has no sound of.
TEST_F(Style, ShowsWhatAnIntervalSays) {
    const CorpusIndex index = read_corpus_index(corpus());
    const auto interval_of = [&](Split split) {
        const CorpusEntry entry = index.of(split).at(0);
        return corpus() + "/data/processed/" + entry.speaker + "/" + entry.id + ".h5";
    };
    const Outcome outcome = run_chironomia({"synth", "--engine", "zs-mstm", "--checkpoint", model(),
                                            "--content-of", interval_of(Split::test), "--style-of",
                                            interval_of(Split::unseen), "--out", file("shown.h5")});
    ASSERT_EQ(outcome.exit_code, 0) << outcome.err;
    const Motion motion = testing::read_motion_hdf5(file("shown.h5"));
    EXPECT_NEAR(static_cast<double>(motion.frames) / 15, index.of(Split::test).at(0).seconds, 0.07);
}

// A study that makes a condition itself, and one of the motions that `synth` made of it, have the same videos.
TEST_F(Style, IsAConditionOfAStudy) {
    const auto interval_of = [](Split split) {
        const CorpusEntry entry = read_corpus_index(corpus()).of(split).at(0);
        return corpus() + "/data/processed/" + entry.speaker + "/" + entry.id + ".h5";
    };
    const std::string source = interval_of(Split::test), target = interval_of(Split::unseen);
    must({"synth", "--engine", "zs-mstm", "--checkpoint", model(), "--content-of", source, "--style-of",
          target, "--out", file("model.h5")});
    Json plan = {
        {"title", "Styles"},
        {"layout", "triplet"},
        {"sound_check", false},
        {"reference", "target"},
        {"conditions", {"source", "model", "target"}},
        {"render",
         {{"avatar", "stick"}, {"size", {96, 54}}, {"fps", 15}, {"face_mode", "mask"}, {"hands", "hidden"}}},
        {"clips",
         {{{"id", "c1"},
           {"cut", {0, 0.4}},
           {"motion", {{"source", source}, {"model", file("model.h5")}, {"target", target}}}}}}};
    const auto videos_of = [&](const std::string& name) {
        write_json(file(name + ".json"), plan);
        must({"study", "build", file(name + ".json"), "--out", file(name), "--seed", "1", "--quiet"});
        must({"study", "check", file(name)});
        std::multiset<std::string> videos;
        for (const std::string& path : list_files(file(name) + "/public"))
            if (path.ends_with(".mp4")) videos.insert(read_text(file(name) + "/public/" + path));
        return videos;
    };
    const auto given = videos_of("given");
    EXPECT_EQ(given.size(), 3u);
    plan["conditions"][1] = {
        {"name", "model"}, {"from", "source"}, {"style_of", "target"}, {"checkpoint", model()}};
    plan["clips"][0]["motion"].erase("model");
    EXPECT_EQ(videos_of("performed"), given);
    const Json key = read_json(file("performed/private/key.json"));
    EXPECT_EQ(key["conditions"][1],
              Json({{"name", "model"}, {"made", "zs-mstm: source in the style of target"}}));
    const Json manifest = read_json(file("performed/private/manifest.json"));
    EXPECT_THAT(manifest["inputs"].dump(), AllOf(HasSubstr("zs.safetensors"), HasSubstr("zs.json")));
}

// Mix-StAGE knows speakers by their names, which are those of the folders of the target's intervals.
class StagedStudy : public Style {
  protected:
    static void SetUpTestSuite() {
        Style::SetUpTestSuite();
        must({"train", "mix-stage", "--corpus", corpus(), "--preset", "small", "--steps", "2", "--quiet",
              "--out", file("mix.safetensors")});
    }
    static std::vector<std::string> intervals_of(const std::string& speaker) {
        std::vector<std::string> files;
        for (const CorpusEntry& entry : read_corpus_index(corpus()).entries)
            if (entry.speaker == speaker)
                files.push_back(corpus() + "/data/processed/" + speaker + "/" + entry.id + ".h5");
        return files;
    }
    // Two clips of adrian; the second one's target is given.
    static Json plan_with(const std::string& second_target) {
        const std::string source = intervals_of("adrian").at(0);
        return {{"title", "Styles"},
                {"layout", "triplet"},
                {"sound_check", false},
                {"reference", "target"},
                {"conditions",
                 {"source",
                  {{"name", "stage"},
                   {"from", "source"},
                   {"style_of", "target"},
                   {"engine", "mix-stage"},
                   {"checkpoint", file("mix.safetensors")}},
                  "target"}},
                {"render", {{"avatar", "stick"}, {"size", {96, 54}}, {"fps", 15}, {"face_mode", "mask"}}},
                {"clips",
                 {{{"id", "as-beth"},
                   {"cut", {0, 0.4}},
                   {"motion", {{"source", source}, {"target", intervals_of("beth").at(0)}}}},
                  {{"id", "as-other"},
                   {"cut", {0, 0.4}},
                   {"motion", {{"source", source}, {"target", second_target}}}}}}};
    }
    // The videos of "stage" of the study, by the ids of their clips.
    static std::map<std::string, std::string> build(const Json& plan, const std::string& name) {
        write_json(file(name + ".json"), plan);
        must({"study", "build", file(name + ".json"), "--out", file(name), "--seed", "1", "--quiet"});
        must({"study", "check", file(name)});
        std::map<std::string, std::string> videos;
        const Json key = read_json(file(name) + "/private/key.json");
        for (const Json& page : key["pages"])
            for (const Json& place : page["places"])
                if (place["condition"] == "stage")
                    videos[page["clip"]] =
                        read_text(file(name) + "/public/clips/" + place["video"].get<std::string>() + ".mp4");
        return videos;
    }
};

TEST_F(StagedStudy, HasAnotherTargetInEachClip) {
    Json plan = plan_with(intervals_of("adrian").at(1));
    const auto shown = build(plan, "each");
    ASSERT_EQ(shown.size(), 2u);
    plan["conditions"][1]["style_of"] = "adrian";
    const auto by_name = build(plan, "by-name");
    EXPECT_EQ(by_name.at("as-other"), shown.at("as-other")) << "its target is an interval of adrian";
    EXPECT_NE(by_name.at("as-beth"), shown.at("as-beth"));
}

TEST_F(StagedStudy, RefusesSpeakersOfWhomNothingWasLearnedBeforeItDraws) {
    const auto refusal_of = [](const Json& plan) {
        write_json(file("new.json"), plan);
        const Outcome outcome = run_chironomia(
            {"study", "build", file("new.json"), "--out", file("new"), "--seed", "1", "--quiet"});
        EXPECT_EQ(outcome.exit_code, 3);
        EXPECT_FALSE(fs::exists(file("new")));
        return outcome.err;
    };
    Json plan = plan_with(intervals_of(unseen_speaker()).at(0));
    const std::string refused =
        "\"quentin\", but \"stage\" is performed by mix-stage, and mix.safetensors has learned the styles of "
        "adrian, beth alone; choose one of them, or let zs-mstm perform it, which shows any style\n";
    EXPECT_THAT(refusal_of(plan),
                HasSubstr(file("new.json") + ": clips[1].motion.target: is in the folder of " + refused));
    plan["conditions"][1]["style_of"] = "quentin";
    EXPECT_THAT(refusal_of(plan), HasSubstr(file("new.json") + ": conditions[1].style_of: is " + refused));
    plan["conditions"][1]["checkpoint"] = model();
    EXPECT_THAT(refusal_of(plan), HasSubstr("it holds zs-mstm-1, but --engine is mix-stage"));
}

// The corpus has the built-in encoder, and so has its model.
TEST_F(Style, RefusesWordsOfAnotherEncoder) {
    const fs::path pats = testing::source_dir() / "tests/fixtures/corpus/pats";
    const fs::path interval = pats / "data/processed/oliver/115309.h5";
    const std::string own = corpus() + ":" + unseen_speaker();
    const auto refusal = [](const std::vector<std::string>& more) {
        std::vector<std::string> words{"synth", "--engine", "zs-mstm",    "--checkpoint",
                                       model(), "--out",    file("no.h5")};
        words.insert(words.end(), more.begin(), more.end());
        const Outcome outcome = run_chironomia(words);
        EXPECT_EQ(outcome.exit_code, 3);
        return outcome.err;
    };
    const std::string why =
        ": words as vectors of \"bert-base-uncased\", the model has learned those of \"hashbert\"; take one";
    EXPECT_THAT(refusal({"--content-of", interval.string(), "--style-of", own}),
                HasSubstr("115309.h5" + why));
    EXPECT_THAT(refusal({"--text", "Well.", "--style-of", interval.string()}), HasSubstr("115309.h5" + why));
    EXPECT_THAT(refusal({"--text", "Well.", "--style-of", pats.string() + ":oliver"}),
                HasSubstr("pats" + why));
}

TEST_F(Style, IsComparedWithSourceAndTarget) {
    const Outcome outcome = run_chironomia({"evaluate", "--checkpoint", model(), "--corpus", corpus(),
                                            "--split", "test", "--option", "pairs=2", "--samples", "100",
                                            "--quiet", "--out", file("results"), "--json"});
    ASSERT_EQ(outcome.exit_code, 0) << outcome.err;
    const Json tables = Json::parse(outcome.out)["tables"];
    ASSERT_EQ(tables["styles"].size(), 7u);
    const Outcome smoothed = run_chironomia(
        {"evaluate", "--checkpoint", model(), "--corpus", corpus(), "--split", "test", "--option", "pairs=2",
         "--samples", "100", "--quiet", "--style-points", "smoothed", "--json", "--out", file("smoothed")});
    ASSERT_EQ(smoothed.exit_code, 0) << smoothed.err;
    EXPECT_NE(Json::parse(smoothed.out)["tables"]["styles"][5]["ours"], tables["styles"][5]["ours"]);
    for (const Json& row : tables["styles"])
        EXPECT_NEAR(row["source"].get<double>() + row["ours"].get<double>(), 100, 1e-9) << row;
    ASSERT_EQ(tables["poses"].size(), 1u);
    EXPECT_LE(tables["poses"][0]["pck_01"].get<double>(), tables["poses"][0]["pck_02"].get<double>());
    EXPECT_GT(tables["poses"][0]["frechet"].get<double>(), 0);
    ASSERT_EQ(tables["transfers"].size(), 1u);
    EXPECT_EQ(tables["transfers"][0]["n"], 4);  // two of each speaker as the other
    EXPECT_THAT(read_text(file("results/styles.csv")), HasSubstr("wrist_velocity"));
}

TEST_F(Style, IsMappedAndJudged) {
    must({"train", "style-classifier", "--corpus", corpus(), "--preset", "small", "--steps", "2", "--quiet",
          "--out", file("c.safetensors")});
    const Outcome outcome =
        run_chironomia({"evaluate", "--checkpoint", model(), "--classifier", file("c.safetensors"),
                        "--corpus", corpus(), "--split", "test", "--option", "pairs=2", "--samples", "100",
                        "--quiet", "--out", file("judged"), "--json"});
    ASSERT_EQ(outcome.exit_code, 0) << outcome.err;
    const Json tables = Json::parse(outcome.out)["tables"];
    ASSERT_EQ(tables["strength"].size(), 1u);
    EXPECT_EQ(tables["strength"][0]["n"], 4);
    std::vector<std::string> encodings;
    for (const Json& row : tables["encodings"]) {
        encodings.push_back(row["encoding"]);
        EXPECT_TRUE(row["neighbours"].is_number());
        EXPECT_TRUE(row["probe"].is_null()) << "no speaker has three intervals, one of which would judge";
        // A model that has hardly learned guesses the style no better than its mean.
        EXPECT_EQ(row["adversary_r2"].is_null(), encodings.back() != "content");
        if (encodings.back() == "content") {
            EXPECT_LT(row["adversary_r2"].get<double>(), 0.05);
        }
    }
    EXPECT_THAT(encodings, ElementsAre("style", "content", "pose", "speech", "text"));
    for (const char* name : {"pose", "speech", "text"}) {
        EXPECT_THAT(read_text(file(format("judged/zs-{}.svg", name))), HasSubstr("by speaker"));
        EXPECT_THAT(read_text(file(format("judged/zs-{}.csv", name))), HasSubstr("speaker,x,y\n"));
    }
    EXPECT_THAT(read_text(file("judged/zs-style.svg")), HasSubstr("style by speaker"));
    EXPECT_THAT(read_text(file("judged/zs-content.csv")), HasSubstr("speaker,x,y\n"));

    fs::copy(corpus(), file("again"), fs::copy_options::recursive);
    CorpusIndex again = read_corpus_index(file("again"));
    std::swap(again.entries.at(0).split, again.entries.at(1).split);  // as another seed would
    write_corpus_index(again);
    EXPECT_THAT(run_chironomia({"evaluate", "--checkpoint", model(), "--classifier", file("c.safetensors"),
                                "--corpus", file("again"), "--split", "test", "--option", "pairs=2",
                                "--samples", "100", "--quiet", "--out", file("judged-again")})
                    .err,
                AllOf(HasSubstr("zs.safetensors: it has learned from other records than those in \"train\""),
                      HasSubstr("c.safetensors: it has learned from other records"),
                      HasSubstr("it judges on what it has learned")));
}

TEST_F(Style, IsDescribedWithItsParameters) {
    const Outcome outcome = run_chironomia({"info", model(), "--json"});
    ASSERT_EQ(outcome.exit_code, 0) << outcome.err;
    EXPECT_EQ(Json::parse(outcome.out)["parameters"], 849'558);
    EXPECT_THAT(run_chironomia({"info", model()}).out,
                HasSubstr("849558 numbers (408342 without AST), discriminator 57792\n"));
}

TEST_F(Style, RefusesWhatItCannotDo) {
    const std::vector<std::string> engine{"--engine", "zs-mstm", "--checkpoint", model()};
    const auto with = [&](std::vector<std::string> more) {
        more.insert(more.begin(), engine.begin(), engine.end());
        return more;
    };
    const std::pair<std::vector<std::string>, const char*> cases[] = {
        {with({}), "--engine zs-mstm: it moves in somebody's style; say whose with --style-of"},
        {with({"--style-of", corpus() + ":nobody"}), "nobody is called \"nobody\" there; give one of"},
        {with({"--style-of", "missing.h5"}), "missing.h5"},
        {with({"--style-of", "quentin"}),
         "--style-of quentin: says in no file and no corpus whose style it is"},
        {{"--engine", "mix-stage", "--checkpoint", model(), "--style-of", "a:b"},
         "--style-of a:b: mix-stage knows the speakers that it has learned from by their names alone"},
        {{"--engine", "model2", "--style-of", "x.h5"}, "it has no style of others; leave out --style-of and"},
        {{"--engine", "model2", "--checkpoint", model()}, "it holds zs-mstm-1, but --engine is model2"},
    };
    for (const auto& [words, message] : cases) {
        const Outcome outcome = synth(words);
        EXPECT_EQ(outcome.exit_code, 3) << message;
        EXPECT_THAT(outcome.err, HasSubstr(message));
    }
    const Outcome filled = synth(with({"--style-of", "x.h5", "--fill"}));
    EXPECT_EQ(filled.exit_code, 2);
    EXPECT_THAT(filled.err, HasSubstr("gestures in a picture are lifted"));
}

}  // namespace
}  // namespace chironomia::study
