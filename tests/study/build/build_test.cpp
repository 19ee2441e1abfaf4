#include "study/build/build.h"
#include "study/build/draft.h"

#include <fcntl.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <signal.h>
#include <sys/file.h>
#include <sys/wait.h>
#include <unistd.h>

#include <set>

#include "core/files/wav_file.h"
#include "core/text.h"
#include "study/build/study_files.h"
#include "study/build/workers.h"
#include "tests/study/fake_maker.h"
#include "tests/study/limits.h"
#include "tests/study/sample_plan.h"
#include "tests/study/sounds.h"
#include "tests/support/support.h"

namespace chironomia::study {
namespace {

namespace fs = std::filesystem;
using ::testing::Contains;
using ::testing::ElementsAre;
using testing::FakeMaker;
using ::testing::HasSubstr;
using ::testing::IsEmpty;
using testing::LowLimit;
using testing::refusal_of;
using testing::sample_plan;
using ::testing::SizeIs;
using testing::TemporaryFolder;
using testing::write_sample_inputs;

// A folder with the sample plan and its inputs, and studies built from it with a fake renderer.
class BuildStudy : public ::testing::Test {
  protected:
    BuildStudy() { write_sample_inputs(folder_.path()); }

    Plan plan() {
        write_json(folder_ / "plan.json", json_);
        return read_plan(folder_ / "plan.json");
    }

    BuildSummary build(const std::string& name = "study", std::uint64_t seed = 7, int jobs = 1) {
        return build_study(plan(), {.out = folder_ / name, .seed = seed, .jobs = jobs, .quiet = true},
                           fake_.maker());
    }

    // Every file of a study by its path, with its bytes.
    std::map<std::string, std::string> files_of(const std::string& name) {
        std::map<std::string, std::string> files;
        for (const std::string& file : list_files(folder_ / name)) {
            files[file] = read_text(folder_ / name / file);
        }
        return files;
    }

    Json json_of(const std::string& file) { return read_json(folder_ / "study" / file); }

    TemporaryFolder folder_;
    Json json_ = sample_plan();
    FakeMaker fake_;
};

TEST_F(BuildStudy, FollowsAllConditionsOfAClipWithOneCamera) {
    EXPECT_THAT(draft_study(plan(), 7, fake_.maker()).videos[0].job.performers[0].followed, IsEmpty());
    json_["render"]["travel"] = "follow";
    json_["clips"][1]["cut"] = {0.1, 0.9};
    const StudyDraft draft = draft_study(plan(), 7, fake_.maker());
    ASSERT_EQ(draft.videos.size(), 4u);
    for (const Video& video : draft.videos) {
        EXPECT_EQ(video.job.travel, Travel::follow);
        const auto& followed = video.job.performers[0].followed;
        const std::string clip = video.shows.clip == 0 ? "c1.bvh" : "c2.bvh";
        ASSERT_THAT(followed, SizeIs(2));
        EXPECT_EQ(followed[0].motion, folder_ / "ours" / clip);
        EXPECT_EQ(followed[1].motion, folder_ / "base" / clip);
        EXPECT_EQ(followed[1].cut.has_value(), video.shows.clip == 1);
    }
}

TEST_F(BuildStudy, WritesThePublicAndThePrivateFiles) {
    const BuildSummary summary = build();
    EXPECT_EQ(summary.pages, 2u);
    EXPECT_EQ(summary.videos, 4u);
    EXPECT_EQ(summary.recorded, 4u);
    EXPECT_EQ(summary.sheets, 4u);
    EXPECT_THAT(list_files(folder_ / "study/private"),
                ElementsAre("key.json", "manifest.json", "plan.json", "recordings.json", "report.html"));
    EXPECT_EQ(static_cast<int>(fs::status(folder_ / "study/private").permissions()), 0700);
    const auto open = list_files(folder_ / "study/public");
    EXPECT_THAT(open, SizeIs(14));
    for (const char* name : {"index.html", "pages.json", "player.js", "style.css"}) {
        EXPECT_THAT(open, Contains(name));
    }
}

TEST_F(BuildStudy, MakesTheSameBytesFromTheSameInputs) {
    build("first");
    build("second");
    EXPECT_EQ(files_of("first"), files_of("second"));
}

TEST_F(BuildStudy, MakesTheSameBytesWithAnyNumberOfJobs) {
    build("alone", 7, 1);
    build("several", 7, 3);
    EXPECT_EQ(files_of("alone"), files_of("several"));
}

TEST_F(BuildStudy, NamesVideosOtherwiseForAnotherSeedOrAnotherMotion) {
    build("first", 1);
    build("other_seed", 2);
    write_text(folder_ / "ours/c1.bvh", "changed");
    build("other_motion", 1);
    std::set<std::string> names;
    for (const char* study : {"first", "other_seed", "other_motion"}) {
        for (const std::string& name : list_files(folder_ / study / "public/clips")) names.insert(name);
    }
    EXPECT_THAT(names, SizeIs(12));
}

TEST_F(BuildStudy, KeysEveryVideoToWhatItWasMadeFrom) {
    build();
    const Json key = json_of("private/key.json");
    std::set<std::string> seen;
    for (const Json& video : key["videos"]) {
        const std::string clip = video["clip"];
        const std::string condition = video["conditions"][0];
        ClipJob job;
        job.performers = {{.motion = folder_ / (condition == "ours" ? "ours" : "base") / (clip + ".bvh")}};
        job.audio = folder_ / (clip + ".wav");
        job.size = {.width = 160, .height = 90};
        job.at_least = 2;
        const std::string bytes = read_text(folder_ / "study/public" / video["file"].get<std::string>());
        EXPECT_THAT(bytes, HasSubstr(sha256(FakeMaker::recipe(job).dump()))) << clip << " " << condition;
        EXPECT_EQ(sha256(bytes), video["sha256"]);
        seen.insert(clip + " " + condition);
    }
    EXPECT_THAT(seen, SizeIs(4));
}

// The key and the report distinguish conditions that share their motions; nothing in public/ does.
TEST_F(BuildStudy, RecordsConditionsThatDifferInTheirModesAlone) {
    for (const char* clip : {"c1", "c2"})
        json_["clips"][clip[1] - '1']["motion"]["baseline"] = format("ours/{}.bvh", clip);
    json_["modes"]["baseline"] = {{"face_mode", "mouth-blur"}, {"hands", "relaxed"}};
    EXPECT_EQ(build().recorded, 4u);
    const Json key = json_of("private/key.json");
    EXPECT_EQ(key["modes"]["ours"], Json({{"face_mode", "au"}, {"hands", "motion"}}));
    EXPECT_EQ(key["modes"]["baseline"], Json({{"face_mode", "mouth-blur"}, {"hands", "relaxed"}}));
    EXPECT_THAT(read_text(folder_ / "study/private/report.html"),
                HasSubstr("<td>ours: face au, hands motion; baseline: face mouth-blur, hands relaxed</td>"));
    for (const std::string& name : list_files(folder_ / "study/public")) {
        if (name.ends_with(".css")) continue;  // of the player, the same for every study
        const std::string text = name + read_text(folder_ / "study/public" / name);
        for (const char* word : {"mouth-blur", "relaxed", "face_mode"})
            EXPECT_EQ(text.find(word), std::string::npos) << name << ": " << word;
    }
}

TEST_F(BuildStudy, ShowsOnEachPageTheVideosThatTheKeySays) {
    build();
    const Json key = json_of("private/key.json");
    const Json pages = json_of("public/pages.json");
    ASSERT_EQ(pages["pages"].size(), 2u);
    for (std::size_t i = 0; i < 2; ++i) {
        EXPECT_EQ(pages["pages"][i]["id"], key["pages"][i]["page"]);
        for (std::size_t side = 0; side < 2; ++side) {
            const Json place = key["pages"][i]["places"][side];
            const std::string token = place["video"];
            EXPECT_EQ(pages["pages"][i]["videos"][side], "clips/" + token + ".mp4");
            const auto video = std::find_if(key["videos"].begin(), key["videos"].end(),
                                            [&](const Json& each) { return each["token"] == token; });
            ASSERT_NE(video, key["videos"].end());
            EXPECT_EQ((*video)["clip"], key["pages"][i]["clip"]);
            EXPECT_EQ((*video)["conditions"][0], place["condition"]);
        }
    }
}

TEST_F(BuildStudy, PutsTheSameDataIntoThePage) {
    json_["title"] = "A < B & </script> {{pages}}";
    build();
    const std::string page = read_text(folder_ / "study/public/index.html");
    EXPECT_THAT(page, HasSubstr("<title>A &lt; B &amp; &lt;/script&gt; {{pages}}</title>"));
    const std::string mark = "id=\"pages\">";
    const std::size_t begin = page.find(mark) + mark.size();
    const std::string data = page.substr(begin, page.find("</script>", begin) - begin);
    EXPECT_EQ(Json::parse(data), json_of("public/pages.json"));
}

TEST_F(BuildStudy, MakesTheVideosOfAClipEqualInLengthAndSize) {
    fake_.lengths = {{"ours/c1.bvh", 3.0}, {"base/c1.bvh", 2.5}};
    const BuildSummary summary = build();
    std::map<std::string, std::set<std::size_t>> frames, sizes;
    const Json key = json_of("private/key.json");
    for (const Json& video : key["videos"]) {
        frames[video["clip"]].insert(video["frames"].get<std::size_t>());
        sizes[video["clip"]].insert(
            fs::file_size(folder_ / "study/public" / video["file"].get<std::string>()));
    }
    EXPECT_THAT(frames["c1"], ElementsAre(90));
    EXPECT_THAT(frames["c2"], ElementsAre(60));
    EXPECT_THAT(sizes["c1"], SizeIs(1));
    EXPECT_THAT(sizes["c2"], SizeIs(1));
    EXPECT_THAT(summary.warnings, ElementsAre("clip \"c1\", baseline: the last pose is held for a while"));
}

TEST_F(BuildStudy, RecordsBothFiguresInOneVideoWithTheLeftOneFirst) {
    json_["presentation"] = "one video";
    const BuildSummary summary = build();
    EXPECT_EQ(summary.videos, 2u);
    const Json key = json_of("private/key.json");
    for (const Json& page : key["pages"]) {
        const Json& left = page["places"][0];
        const Json& right = page["places"][1];
        EXPECT_EQ(left["video"], right["video"]);
        const auto video = std::find_if(key["videos"].begin(), key["videos"].end(),
                                        [&](const Json& each) { return each["token"] == left["video"]; });
        EXPECT_EQ((*video)["conditions"], Json::array({left["condition"], right["condition"]}));
        ClipJob job;
        job.performers.clear();
        for (const Json& condition : (*video)["conditions"]) {
            const std::string clip = page["clip"];
            job.performers.push_back(
                {.motion = folder_ / (condition == "ours" ? "ours" : "base") / (clip + ".bvh")});
            job.audio = folder_ / (clip + ".wav");
        }
        job.size = {.width = 160, .height = 90};
        job.at_least = 2;
        EXPECT_THAT(read_text(folder_ / "study/public" / (*video)["file"].get<std::string>()),
                    HasSubstr(sha256(FakeMaker::recipe(job).dump())));
    }
}

// The partner is the same in every video, on the side that the plan says, and everybody has their own voice.
TEST_F(BuildStudy, PutsThePartnerBesideTheAgent) {
    for (const char* name : {"bob.bvh", "bob.wav"}) write_text(folder_ / name, name);
    for (const bool on_left : {false, true}) {
        Json plan = sample_plan();
        plan["render"]["scene"] = "dyad";
        plan["render"]["cue"] = "light";
        plan["render"]["partner_side"] = on_left ? "left" : "right";
        for (Json& clip : plan["clips"]) clip["partner"] = {{"motion", "bob.bvh"}, {"audio", "bob.wav"}};
        write_json(folder_ / "plan.json", plan);
        const Plan read = read_plan(folder_ / "plan.json");
        const FakeMaker maker;
        for (const Video& video : draft_study(read, 1, maker.maker()).videos) {
            ASSERT_EQ(video.job.performers.size(), 2u);
            EXPECT_FALSE(video.job.stereo);  // no speech is exchanged
            const Performer& partner = video.job.performers[on_left ? 0 : 1];
            const Performer& agent = video.job.performers[on_left ? 1 : 0];
            EXPECT_EQ(partner.motion, folder_ / "bob.bvh");
            EXPECT_EQ(partner.voice, folder_ / "bob.wav");
            EXPECT_EQ(partner.avatar, "mannequin");
            EXPECT_EQ(agent.motion, read.clips[video.shows.clip].motions[video.shows.conditions[0]]);
            EXPECT_EQ(agent.voice, read.clips[video.shows.clip].audio);
            EXPECT_EQ(video.job.audio, std::nullopt);
            EXPECT_EQ(video.job.cue, SpeakingCue::light);
            EXPECT_FALSE(video.job.beside);
        }
        std::set<std::string> inputs;
        for (const InputFile& input : list_inputs(read)) inputs.insert(input.path);
        EXPECT_EQ(inputs.count("bob.bvh") + inputs.count("bob.wav"), 2u);
    }
}

// The agent moves as in the other clip, and all else is of the clip itself.
TEST_F(BuildStudy, CutsAnAgentOfAnotherClipAsTheOtherClipIsCut) {
    write_text(folder_ / "bob.bvh", "bob.bvh");
    for (const char* name : {"c1.wav", "c2.wav", "bob.wav"})
        write_wav(folder_ / name, testing::sine({.seconds = 1}));
    json_["render"]["scene"] = "dyad";
    json_["mismatched"] = "motion";
    for (Json& clip : json_["clips"]) clip["partner"] = {{"motion", "bob.bvh"}, {"audio", "bob.wav"}};
    for (const bool both : {true, false}) {
        json_["clips"][0]["cut"] = {0.1, 0.9};
        json_["clips"][1]["cut"] = {0.5, 1.3};
        if (!both) json_["clips"][1].erase("cut");
        const Plan read = plan();
        std::size_t moved = 0;
        for (const Video& video : draft_study(read, 1, fake_.maker()).videos) {
            const auto &own = read.clips[video.shows.clip].cut, &other = read.clips[video.motion].cut;
            ASSERT_EQ(video.job.performers.size(), 2u);
            const auto& agent = cut_of(video.job.performers[0], video.job);
            const auto& partner = cut_of(video.job.performers[1], video.job);
            EXPECT_EQ(video.motion != video.shows.clip, video.shows.conditions[0] >= 2);
            EXPECT_EQ(video.speech, video.shows.clip);
            EXPECT_EQ(video.job.performers[0].motion,
                      read.clips[video.motion].motions[video.shows.conditions[0] % 2]);
            EXPECT_EQ(video.job.performers[0].voice, read.clips[video.shows.clip].audio);
            EXPECT_EQ(video.job.cut.has_value(), own.has_value());
            EXPECT_EQ(partner.has_value(), own.has_value());
            EXPECT_EQ(agent.has_value(), own.has_value() || other.has_value());
            if (own) {
                EXPECT_EQ(partner->begin, own->begin);
            }
            if (agent) {
                EXPECT_EQ(agent->begin, other ? other->begin : 0);
                EXPECT_EQ(agent->end, other ? other->end : std::nullopt);
            }
            moved += video.motion != video.shows.clip;
        }
        EXPECT_EQ(moved, 4u);
    }
}

// The picture, sound and instruction of each video in a study with checks, a mismatch and a film.
TEST_F(BuildStudy, MakesTheJobsThatTheConditionsSay) {
    json_["conditions"] = {"ours",
                           "baseline",
                           {{"name", "late"}, {"from", "ours"}, {"by", "delayed"}, {"ms", 300}},
                           {{"name", "other"}, {"from", "ours"}, {"by", "mismatched speech"}},
                           {{"name", "moved"}, {"from", "ours"}, {"by", "mismatched motion"}}};
    json_["layout"] = "single";
    json_["checks"] = {{"count", 2}, {"kinds", {"text", "audio"}}, {"instruction", "Press {answer}"}};
    write_text(folder_ / "base/c1.bvh", std::string("\0\0\0\x20", 4) + "ftypisom film");
    fake_.lengths = {{"ours/c2.bvh", 1.9}, {"base/c2.bvh", 1.9}};
    for (const char* name : {"c1.wav", "c2.wav"}) write_wav(folder_ / name, testing::sine({.seconds = 1.9}));
    const Plan read = plan();
    std::size_t texts = 0, voices = 0;
    for (const Video& video : draft_study(read, 1, fake_.maker()).videos) {
        const Performer& agent = video.job.performers.front();
        const std::size_t clip = video.shows.clip, condition = video.shows.conditions.front();
        const std::size_t other = 1 - clip;
        EXPECT_EQ(video.job.loudness, -23);
        EXPECT_TRUE(video.job.stereo);  // another clip's speech may have another number of channels
        EXPECT_EQ(video.speech, condition == 3 ? other : clip);
        EXPECT_EQ(video.job.audio, read.clips[video.speech].audio);
        EXPECT_EQ(video.job.sound_cut.has_value(), condition >= 3);
        const fs::path& motion = agent.film.empty() ? agent.motion : agent.film;
        EXPECT_EQ(motion, read.clips[condition == 4 ? other : clip].motions[condition == 1 ? 1 : 0]);
        EXPECT_EQ(!agent.film.empty(), condition == 1 && clip == 0);
        EXPECT_EQ(agent.anchor.has_value(), condition == 2);
        // The longer clip ends with the shorter one, in all conditions.
        EXPECT_EQ(video.job.frames.last, 57u);
        texts += video.job.notice.has_value();
        voices += video.job.spoken.has_value();
        EXPECT_EQ(video.job.notice || video.job.spoken, video.shows.notice.has_value());
    }
    EXPECT_EQ(texts, 1u);
    EXPECT_EQ(voices, 1u);
}

// Sounds that are longer than the motions are heard with them, and motions that are longer than others shown with
// theirs.
TEST_F(BuildStudy, EndsAllVideosOfAMismatchedClipTogether) {
    fake_.lengths = {{"ours/c1.bvh", 1.8}, {"base/c1.bvh", 1.9}, {"ours/c2.bvh", 2.1}, {"base/c2.bvh", 2.0}};
    write_wav(folder_ / "c1.wav", testing::sine({.seconds = 2.2}));
    write_wav(folder_ / "c2.wav", testing::sine({.seconds = 2.05}));
    for (const char* kind : {"speech", "motion"}) {
        json_["mismatched"] = kind;
        const StudyDraft draft = draft_study(plan(), 1, fake_.maker());
        EXPECT_THAT(draft.videos, SizeIs(8));
        for (const Video& video : draft.videos) {
            EXPECT_DOUBLE_EQ(*video.job.at_least, video.shows.clip == 0 ? 2.2 : 2.1);
            EXPECT_EQ(video.job.frames.last, 63u);
        }
    }
}

// Before anything is drawn.
TEST_F(BuildStudy, RefusesAnInstructionThatItsPictureHasNoRoomFor) {
    json_["checks"] = {{"count", 2}, {"kinds", {"text"}}};
    json_["render"]["size"] = {64, 36};
    const Plan read = plan();
    EXPECT_THAT(
        refusal_of([&] { draft_study(read, 1, fake_.maker()); }),
        HasSubstr("does not fit into a picture of 64 x 36 in letters of 8 pixels; write less, or make"));
}

TEST_F(BuildStudy, RefusesAnInstructionThatEndsAfterItsClip) {
    json_["checks"] = {{"count", 1}, {"kinds", {"audio"}}};
    fake_.lengths = {{"ours/c1.bvh", 1.9}, {"ours/c2.bvh", 1.9}, {"base/c1.bvh", 1.9}, {"base/c2.bvh", 1.9}};
    const Plan read = plan();
    EXPECT_THAT(refusal_of([&] { draft_study(read, 1, fake_.maker()); }),
                AllOf(HasSubstr("clip \"c"),
                      HasSubstr("s from 0.500 s on, but the clip lasts 1.900 s; begin earlier or say less"),
                      HasSubstr("\"kinds\" as [\"text\"]")));
}

TEST_F(BuildStudy, RefusesAFilmThatIsToBeMadeWorse) {
    json_["conditions"].push_back({{"name", "late"}, {"from", "ours"}, {"by", "delayed"}, {"ms", 300}});
    write_text(folder_ / "ours/c1.bvh", std::string("\0\0\0\x20", 4) + "ftypisom film");
    EXPECT_EQ(refusal_of([&] { build(); }),
              (folder_ / "ours/c1.bvh").string() +
                  ": is a film, which has no joints to make worse; name a motion for the condition \"late\"");
}

TEST_F(BuildStudy, ListsTheHashOfEveryInputAndOutput) {
    build();
    const Json manifest = json_of("private/manifest.json");
    std::map<std::string, std::string> inputs, outputs;
    for (const Json& file : manifest["inputs"]) inputs[file["path"]] = file["sha256"];
    for (const Json& file : manifest["outputs"]) outputs[file["path"]] = file["sha256"];
    EXPECT_EQ(inputs.size(), 7u);
    EXPECT_EQ(inputs["base/c2.bvh"], sha256("base/c2.bvh"));
    EXPECT_EQ(inputs["assets/avatars/mannequin.glb"],
              sha256_of_file(find_asset("assets/avatars/mannequin.glb")));
    for (const auto& [name, bytes] : files_of("study")) {
        if (name != "private/manifest.json") {
            EXPECT_EQ(outputs[name], sha256(bytes)) << name;
        }
    }
    EXPECT_EQ(outputs.size(), 18u);
}

TEST_F(BuildStudy, ReportsEveryVideoWithItsCondition) {
    json_["title"] = "A < B";
    fake_.lengths = {{"ours/c1.bvh", 3.0}};
    build();
    const std::string report = read_text(folder_ / "study/private/report.html");
    EXPECT_THAT(report, HasSubstr("<h1>A &lt; B</h1>"));
    EXPECT_THAT(report, HasSubstr("ours       baseline             4 : 4"));
    EXPECT_THAT(report, HasSubstr("<span class=\"note\">the last pose is held for a while</span>"));
    const Json key = json_of("private/key.json");
    for (const Json& video : key["videos"]) {
        const std::string condition = video["conditions"][0];
        EXPECT_THAT(report, HasSubstr("src=\"../public/" + video["file"].get<std::string>() +
                                      "\"></video>\n<figcaption><strong>" + condition + "</strong>"));
    }
    EXPECT_THAT(report, HasSubstr(sha256("base/c2.bvh")));
}

// ---- Going on

TEST_F(BuildStudy, DoesNothingWhenTheStudyIsFinished) {
    build();
    const auto before = files_of("study");
    const BuildSummary again = build();
    EXPECT_EQ(again.recorded, 0u);
    EXPECT_EQ(*fake_.recorded, 4);
    EXPECT_EQ(files_of("study"), before);
}

TEST_F(BuildStudy, RecordsAgainOnlyWhatAChangeConcerns) {
    build();
    write_text(folder_ / "ours/c1.bvh", "better");
    const BuildSummary again = build_study(
        plan(), {.out = folder_ / "study", .seed = 7, .replace = true, .quiet = true}, fake_.maker());
    EXPECT_EQ(again.recorded, 1u);
    build("fresh");
    EXPECT_EQ(files_of("study"), files_of("fresh"));
}

TEST_F(BuildStudy, ClosesThePrivateFilesToOthersAgain) {
    build();
    fs::permissions(folder_ / "study/private", static_cast<fs::perms>(0755));
    build();
    EXPECT_EQ(static_cast<int>(fs::status(folder_ / "study/private").permissions()), 0700);
}

TEST_F(BuildStudy, MendsADamagedStudy) {
    build();
    const auto before = files_of("study");
    const std::string clip = list_files(folder_ / "study/public/clips").front();
    write_text(folder_ / "study/public/clips" / clip, "broken");
    fs::remove(folder_ / "study/public/player.js");
    EXPECT_EQ(build().recorded, 1u);
    EXPECT_EQ(files_of("study"), before);
}

TEST_F(BuildStudy, GoesOnWhereItWasStopped) {
    build("whole");
    int left = 2;
    fake_.before = [&left](const ClipJob&) {
        if (left-- == 0) throw Interrupted();
    };
    EXPECT_THROW(build(), Interrupted);
    EXPECT_FALSE(fs::exists(folder_ / "study/public"));
    fake_.before = [](const ClipJob&) {};
    EXPECT_EQ(build().recorded, 2u);
    EXPECT_EQ(files_of("study"), files_of("whole"));
}

// The process is killed without a chance to clean up, once before each video.
TEST_F(BuildStudy, GoesOnAfterAKillAtAnyVideo) {
    build("whole");
    for (int killed_at = 0; killed_at < 4; ++killed_at) {
        const std::string name = "killed" + std::to_string(killed_at);
        const pid_t child = ::fork();
        if (child == 0) {
            int left = killed_at;
            fake_.before = [&left](const ClipJob& job) {
                if (left-- > 0) return;
                write_text(job.out, "half a file");
                ::raise(SIGKILL);
            };
            build(name);
            ::_exit(0);
        }
        int status = 0;
        ::waitpid(child, &status, 0);
        ASSERT_TRUE(WIFSIGNALED(status));
        EXPECT_FALSE(fs::exists(folder_ / name / "public"));
        EXPECT_EQ(build(name).recorded, static_cast<std::size_t>(4 - killed_at));
        EXPECT_EQ(files_of(name), files_of("whole"));
    }
}

TEST_F(BuildStudy, DoesNotTrustADamagedRecording) {
    fake_.before = [count = 0](const ClipJob&) mutable {
        if (++count == 4) throw Interrupted();
    };
    EXPECT_THROW(build(), Interrupted);
    const fs::path work = folder_ / "study/private/work";
    for (const std::string& name : list_files(work)) {
        if (name.ends_with(".mp4")) write_text(work / name, "damaged");
    }
    fake_.before = [](const ClipJob&) {};
    EXPECT_EQ(build().recorded, 4u);
}

TEST_F(BuildStudy, DoesNotTrustADamagedNoteOfARecording) {
    build("whole");
    for (const char* damaged : {"", "{}", "5", R"({"sha256": 5})", R"({"sha256": "00", "frames": "many"})"}) {
        SCOPED_TRACE(damaged);
        fs::remove_all(folder_ / "study");
        fake_.before = [count = 0](const ClipJob&) mutable {
            if (++count == 4) throw Interrupted();
        };
        EXPECT_THROW(build(), Interrupted);
        const fs::path work = folder_ / "study/private/work";
        for (const std::string& name : list_files(work)) {
            if (name.ends_with(".json")) write_text(work / name, damaged);
        }
        fake_.before = [](const ClipJob&) {};
        EXPECT_EQ(build().recorded, 4u);
        EXPECT_EQ(files_of("study"), files_of("whole"));
    }
}

TEST_F(BuildStudy, RecordsAgainWhatItsNotesNoLongerSay) {
    build();
    const auto before = files_of("study");
    const std::string notes = before.at("private/recordings.json");
    Json odd = Json::parse(notes);
    odd[0]["report"] = {{"motions", {{{"fit", {{"distance_to_scaled_source_mm", Json::array({5})}}}}, 7}}};
    for (const std::string& damaged : {std::string("[{}]"), std::string("7"), std::string(), odd.dump()}) {
        SCOPED_TRACE(damaged);
        write_text(folder_ / "study/private/recordings.json", damaged);
        EXPECT_EQ(build().recorded, 4u);
        EXPECT_EQ(files_of("study"), before);
    }
}

// ---- Refusals

TEST_F(BuildStudy, RefusesADamagedManifest) {
    build();
    const fs::path file = folder_ / "study/private/manifest.json";
    const Json whole = read_json(file);
    const auto refusal_with = [&](const std::string& pointer, const Json& value) {
        Json json = whole;
        json[Json::json_pointer(pointer)] = value;
        write_json(file, json);
        return refusal_of([&] { build(); });
    };
    const std::string name = file.string() + ": ";
    EXPECT_EQ(refusal_with("/outputs", Json::array()),
              name + "outputs: has 0 entries, at least 1 are needed");
    EXPECT_THAT(refusal_with("/outputs", 5), HasSubstr(name + "outputs: is 5"));
    EXPECT_THAT(refusal_with("/outputs/0", 5), HasSubstr(name + "outputs[0]: is 5"));
    EXPECT_THAT(refusal_with("/outputs/1/path", 5), HasSubstr(name + "outputs[1].path: is 5"));
    EXPECT_THAT(refusal_with("/recipe", 5), HasSubstr(name + "recipe: is 5"));
    Json none = whole;
    none.erase("outputs");
    write_json(file, none);
    EXPECT_EQ(refusal_of([&] { build(); }), name + "outputs: is missing; add it");
}

TEST_F(BuildStudy, PassesOnWhyAVideoCannotBeRecordedFromAnyProcess) {
    for (const int jobs : {1, 3}) {
        fake_.before = [](const ClipJob& job) {
            if (job.performers[0].motion.string().ends_with("base/c2.bvh"))
                throw Error("base/c2.bvh: no arms");
        };
        EXPECT_EQ(refusal_of([&] { build("study", 7, jobs); }), "base/c2.bvh: no arms");
        EXPECT_FALSE(fs::exists(folder_ / "study/public"));
    }
}

TEST_F(BuildStudy, SaysWhichVideoCrashedItsProcess) {
    fake_.before = [](const ClipJob& job) {
        if (job.performers[0].motion.string().ends_with("base/c2.bvh")) ::raise(SIGKILL);
    };
    EXPECT_EQ(
        refusal_of([&] { build("study", 7, 2); }),
        (folder_ / "base/c2.bvh").string() +
            ": its process ended by signal 9, as where memory runs out; take fewer --jobs; render it alone to see why");
    fake_.before = [](const ClipJob&) { ::_exit(9); };
    EXPECT_THAT(refusal_of([&] { build("study", 7, 2); }),
                HasSubstr(": its process ended with status 9; render it alone to see why"));
}

TEST_F(BuildStudy, IsInterruptedWhenAProcessIs) {
    fake_.before = [](const ClipJob&) { throw Interrupted(); };
    EXPECT_THROW(build("study", 7, 2), Interrupted);
}

TEST_F(BuildStudy, LeavesNothingWhenAMotionIsBroken) {
    ClipMaker maker = fake_.maker();
    maker.motions = [](const ClipJob& job) -> ClipMotions {
        throw Error(job.performers[0].motion.string() + ": broken");
    };
    EXPECT_EQ(refusal_of([&] { build_study(plan(), {.out = folder_ / "study", .quiet = true}, maker); }),
              (folder_ / "ours/c1.bvh").string() + ": broken");
    EXPECT_FALSE(fs::exists(folder_ / "study"));
}

TEST_F(BuildStudy, RefusesAFaceThatOneConditionAloneMoves) {
    fake_.faced = read_text(folder_ / "base/c2.bvh");
    EXPECT_EQ(
        refusal_of([&] { build(); }),
        "clip \"c2\": \"baseline\" moves the face and \"ours\" does not; give every condition a \"face\", or "
        "set the \"face_mode\" to \"neutral\"");
    EXPECT_FALSE(fs::exists(folder_ / "study"));
    // The same in one video of both.
    json_["presentation"] = "one video";
    EXPECT_THAT(refusal_of([&] { build(); }), HasSubstr("\"baseline\" moves the face and \"ours\" does not"));
    json_.erase("presentation");
    // A plan may make it a factor.
    json_["modes"]["ours"] = {{"face_mode", "neutral"}};
    EXPECT_EQ(build().recorded, 4u);
}

TEST_F(BuildStudy, RefusesVideosOfUnequalLength) {
    ClipMaker maker = fake_.maker();
    maker.record = [this](const ClipJob& job) {
        ClipResult result = fake_.record(job);
        if (job.performers[0].motion.string().ends_with("base/c2.bvh")) ++result.frames;
        return result;
    };
    EXPECT_EQ(
        refusal_of([&] { build_study(plan(), {.out = folder_ / "study", .quiet = true}, maker); }),
        "clip \"c2\": its videos have 60 and 61 frames, all must be equally long; this is a fault of the "
        "program, please report it");
}

TEST_F(BuildStudy, ReplacesAFinishedStudyOnlyWhenAskedTo) {
    build("study", 7);
    const auto first = files_of("study");
    EXPECT_EQ(
        refusal_of([&] { build("study", 8); }),
        (folder_ / "study").string() +
            ": holds a finished study of another seed, plan, input or program; name a new folder, or give "
            "--replace");
    EXPECT_EQ(files_of("study"), first);
    const auto replace = [&] {
        build_study(plan(), {.out = folder_ / "study", .seed = 8, .replace = true, .quiet = true},
                    fake_.maker());
    };
    // A server that shows it.
    const int shown = ::open((folder_ / "study/public").c_str(), O_RDONLY | O_DIRECTORY);
    ASSERT_EQ(::flock(shown, LOCK_SH | LOCK_NB), 0);
    EXPECT_EQ(refusal_of(replace), (folder_ / "study").string() +
                                       ": a server shows this study; stop it first, or name a new folder");
    ::close(shown);
    // People who answered it.
    write_text(folder_ / "study/private/answers.sqlite", "answers");
    EXPECT_THAT(refusal_of(replace), HasSubstr("people have answered this study"));
    EXPECT_EQ(build("study", 7).recorded, 0u);
    fs::remove(folder_ / "study/private/answers.sqlite");
    for (const char* sign : {"database.txt", "answers.json"}) {
        write_text(folder_ / "study/private" / sign, "elsewhere");
        EXPECT_THAT(refusal_of(replace), HasSubstr(sign));
        fs::remove(folder_ / "study/private" / sign);
    }
    EXPECT_EQ(files_of("study"), first);
    replace();
    EXPECT_NE(files_of("study"), first);
}

TEST_F(BuildStudy, RefusesAFolderThatHoldsSomethingElse) {
    const std::string out = (folder_ / "study").string();
    write_text(folder_ / "study/thesis.tex", "x");
    EXPECT_EQ(refusal_of([&] { build(); }),
              out + ": holds \"thesis.tex\", which is no part of a study; name a new folder");
    fs::remove_all(folder_ / "study");
    write_text(folder_ / "study/public/index.html", "x");
    EXPECT_EQ(refusal_of([&] { build(); }),
              out + ": holds a folder \"public\" that no study was built into; name a new folder");
    fs::remove_all(folder_ / "study");
    write_text(folder_ / "study", "x");
    EXPECT_EQ(refusal_of([&] { build(); }), out + ": this is a file, a folder is needed; name a new folder");
}

TEST_F(BuildStudy, RefusesAPlaceThatCannotBeWritten) {
    EXPECT_THAT(
        refusal_of([&] { build_study(plan(), {.out = "/proc/none/study", .quiet = true}, fake_.maker()); }),
        HasSubstr(
            "/proc/none/study/private: cannot be made (No such file or directory); check that the folder "
            "above exists and is writable"));
}

TEST_F(BuildStudy, RefusesWhenNoProcessCanBeStarted) {
    const Work work{.count = 2,
                    .perform = [](std::size_t) {},
                    .name = [](std::size_t i) { return "video " + std::to_string(i); }};
    Progress progress("study", "videos", 2, true);
    EXPECT_THAT(refusal_of([&] {
                    const LowLimit low(RLIMIT_NOFILE, 3);
                    perform_all(work, 2, progress);
                }),
                HasSubstr("video 0: no process can be started (Too many open files); use fewer jobs"));
}

TEST_F(BuildStudy, RefusesToMixWithAnotherBuild) {
    fs::create_directories(folder_ / "study/private");
    const int other = ::open((folder_ / "study/private").c_str(), O_RDONLY | O_DIRECTORY);
    ASSERT_EQ(::flock(other, LOCK_EX | LOCK_NB), 0);
    EXPECT_EQ(
        refusal_of([&] { build(); }),
        (folder_ / "study").string() + ": another build is at work here; wait for it or name a new folder");
    ::close(other);
}

// The page is the first file that is larger than the disk takes.
TEST_F(BuildStudy, LeavesNoPublicFolderWhenTheDiskIsFull) {
    {
        const LowLimit disk(RLIMIT_FSIZE, 1000);
        EXPECT_THAT(refusal_of([&] { build(); }), HasSubstr("check free space and permissions"));
    }
    EXPECT_FALSE(fs::exists(folder_ / "study/public"));
    EXPECT_EQ(build().recorded, 0u);
    EXPECT_TRUE(fs::exists(folder_ / "study/public/index.html"));
}

TEST_F(BuildStudy, RefusesARecordingThatChangesUnderIt) {
    ClipMaker maker = fake_.maker();
    maker.record = [this](const ClipJob& job) {
        const ClipResult result = fake_.record(job);
        for (const auto& entry : fs::directory_iterator(folder_ / "study/private/work")) {
            if (entry.path().extension() == ".mp4") write_text(entry.path(), "x");
        }
        return result;
    };
    EXPECT_THAT(refusal_of([&] { build_study(plan(), {.out = folder_ / "study", .quiet = true}, maker); }),
                HasSubstr(".mp4: changed while the study was being built; build again"));
}

}  // namespace
}  // namespace chironomia::study
