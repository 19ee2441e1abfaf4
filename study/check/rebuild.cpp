#include "study/check/rebuild.h"

#include <algorithm>

#include "core/files/files.h"
#include "core/files/scratch_folder.h"
#include "core/text.h"
#include "core/version.h"
#include "study/build/build.h"
#include "study/build/study_files.h"

namespace chironomia::study {
namespace fs = std::filesystem;
namespace {

// What a build decides: all that participants can reach, the key and the plan.
std::vector<std::string> files_of(const StudyFolder& study) {
    std::vector<std::string> names = {"private/key.json", "private/plan.json"};
    for (const std::string& name : list_files(study.open())) names.push_back("public/" + name);
    return names;
}

// Which condition a public file shows: " (clip "c1", ours)".
std::string described(const StudyRecord& study, const std::string& name) {
    for (const KeyVideo& video : study.key.videos) {
        if (name == "public/" + video.file)
            return format(" (clip \"{}\", {})", video.clip, names_of(study.key.conditions, video.conditions));
    }
    return "";
}

}  // namespace

Proof check_built_again(const StudyRecord& study, const std::optional<StudySource>& again) {
    Proof proof{.property = "built again from its plan it has the same bytes", .holds = false, .detail = ""};
    if (!again) {
        proof.open = true;
        proof.detail = "the pictures and sounds were not compared; --again PLAN.json builds them again";
        return proof;
    }
    const ScratchFolder folder("check");
    const StudyFolder built{folder.path() / "study"}, found{study.folder};
    build_study(again->plan,
                {.out = built.root, .seed = study.key.seed, .jobs = again->jobs, .quiet = again->quiet},
                again->maker);
    const std::string programs =
        study.program == format("chironomia {}", program_version())
            ? ""
            : format("; it was built by {}, this is chironomia {}", study.program, program_version());
    const std::vector<std::string> expected = files_of(built);
    for (const std::string& name : expected) {
        const std::string where = name + described(study, name);
        if (!fs::is_regular_file(found.root / name)) {
            proof.detail = format("{} is missing{}", where, programs);
            return proof;
        }
        if (read_text(found.root / name) != read_text(built.root / name)) {
            proof.detail = format("{} differs{}", where, programs);
            return proof;
        }
    }
    proof.holds = true;
    proof.detail = format("{} files", expected.size());
    return proof;
}

}  // namespace chironomia::study
