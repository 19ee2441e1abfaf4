// The files of a study: plan, scene, key, pages, answers of our own page and of other front ends; and the tables of
// segments and shots.
#include "core/files/files.h"
#include "core/text.h"
#include "scenes/scene_file.h"
#include "skinning/gltf/gltf.h"
#include "study/analysis/answers.h"
#include "study/analysis/foreign.h"
#include "study/analysis/hemvip_answers.h"
#include "study/corpus/manifest.h"
#include "study/corpus/recording.h"
#include "study/plan/from_folders.h"
#include "study/plan/plan.h"
#include "study/record/key.h"
#include "study/record/pages.h"
#include "study/record/study_record.h"
#include "tests/fuzz/fuzz_reader.h"
#include "tests/support/support.h"

namespace chironomia::testing {

using namespace study;
namespace {

namespace fs = std::filesystem;

// What plans and manifests among the seeds name lies beside them.
void make_companions() {
    static const bool made = [] {
        for (const char* name : {"a.bvh", "b.bvh", "a.wav", "a.csv", "a.words.csv"})
            write_text(fuzz_folder() / name, "");
        return true;
    }();
    (void)made;
}

void read_plan_file(const FuzzInput& input) {
    make_companions();
    read_plan(input.file());
}

void read_manifest(const FuzzInput& input) {
    make_companions();
    read_import_manifest(input.file());
}

void read_scene(const FuzzInput& input) {
    static const Avatar figure = read_avatar(source_dir() / "tests/fuzz/seeds/glb/person.glb");
    make_scene(input.file().string(), figure, {.width = 64, .height = 36});
}

const StudyKey& key_of_seeds() {
    static const StudyKey key = read_study_key(source_dir() / "tests/fuzz/seeds/key/key.json");
    return key;
}

void read_answer_file(const FuzzInput& input) {
    analysis::read_answers({input.file()}, key_of_seeds());
}

const StudyPages& pages_of_seeds() {
    static const StudyPages pages = read_study_pages(source_dir() / "tests/fuzz/seeds/pages/pages.json");
    return pages;
}

void read_battles_of_study(const FuzzInput& input) {
    analysis::read_battles({input.file()}, key_of_seeds(), pages_of_seeds());
}

void read_hemvip_of_study(const FuzzInput& input) {
    if (analysis::is_of_hemvip(input.file()))
        analysis::read_hemvip_answers({input.file()}, key_of_seeds(), pages_of_seeds());
}

void read_foreign(const FuzzInput& input) {
    analysis::read_foreign_answers({input.file()});
}

// Of one system, which has the motion "a".
void read_segments(const FuzzInput& input) {
    static const fs::path system = [] {
        const fs::path folder = fuzz_folder() / "system";
        fs::create_directories(folder);
        fs::copy_file(source_dir() / "tests/fuzz/seeds/bvh/two.bvh", folder / "a.bvh");
        return folder;
    }();
    plan_from_folders({.conditions = {{"ours", system}},
                       .audio = {},
                       .segments = input.file(),
                       .preset = "mismatch-2025",
                       .plan_folder = fuzz_folder()});
}

void read_shot_table(const FuzzInput& input) {
    static const TrackedValues face{.fps = 25, .success = std::vector<std::uint8_t>(100, 1)};
    read_shots(input.file(), face);
}

const AddFuzzReader kPlan({"plan", "x.json", read_plan_file});
const AddFuzzReader kScene({"scene", "x.json", read_scene});
const AddFuzzReader kKey({"key", "x.json", [](const FuzzInput& input) { read_study_key(input.file()); }});
const AddFuzzReader kStudyManifest({"study_manifest", "x.json",
                                    [](const FuzzInput& input) { study::read_manifest(input.file()); }});
const AddFuzzReader kPages({"pages", "x.json",
                            [](const FuzzInput& input) { read_study_pages(input.file()); }});
const AddFuzzReader kAnswers({"answers", "x.json", read_answer_file});
const AddFuzzReader kBattles({"battles", "x.csv", read_foreign});
const AddFuzzReader kBattlesOfStudy({"battles_of_study", "x.csv", read_battles_of_study});
const AddFuzzReader kHemvipOfStudy({"hemvip_of_study", "x.json", read_hemvip_of_study});
const AddFuzzReader kHemvip({"hemvip", "x.json", read_foreign});
const AddFuzzReader kManifest({"manifest", "x.json", read_manifest});
const AddFuzzReader kSegments({"segments", "x.csv", read_segments});
const AddFuzzReader kShots({"shots", "x.csv", read_shot_table});

}  // namespace
}  // namespace chironomia::testing
