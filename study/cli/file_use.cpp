#include "study/cli/file_use.h"

#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <cstring>
#include <set>

#include "core/error.h"
#include "core/input_file.h"
#include "core/text.h"
#include "core/utf8.h"
#include "raster/images/frame_stack.h"
#include "scenes/scene_file.h"
#include "skinning/motion/motion_file.h"
#include "study/analysis/answers.h"
#include "study/record/study_folder.h"

namespace chironomia::study {
namespace {

namespace fs = std::filesystem;

// The files that are read in folders.
const std::vector<std::string> kOpenPose = {"_keypoints.json"};
const std::vector<std::string> kMotions(kMotionEndings.begin(), kMotionEndings.end());
const std::vector<std::string> kSounds = {".wav", ".flac", ".ogg", ".mp3"};
const std::vector<std::string> kPictures = {".png", ".exr", ".mp4", ".webm"};
const std::vector<std::string> kBert = {"model.safetensors", "model.pt", "vocab.txt"};
const std::vector<std::string> kAll = {""};

// Collects what one command reads and writes; an empty path is an option that was not given.
class Uses {
  public:
    void reads(const std::string& option, const fs::path& path,
               const std::vector<std::string>& endings = {}) {
        if (!path.empty()) use_.inputs.push_back({option, path, endings});
    }
    void reads(const std::string& option, const std::optional<fs::path>& path,
               const std::vector<std::string>& endings = {}) {
        if (path) reads(option, *path, endings);
    }
    // A bundled name means the bundled file: the user may give the same name to a folder of results. Of avatars a file
    // of that name comes first.
    void reads_avatar(const fs::path& avatar) {
        if (is_stick(avatar)) return;
        std::error_code none;
        const bool is_file = fs::exists(avatar, none) && !fs::is_directory(avatar, none);
        const std::vector<std::string> bundled = bundled_avatars();
        const bool is_name = std::find(bundled.begin(), bundled.end(), avatar) != bundled.end();
        reads("--avatar", is_name && !is_file ? find_avatar(avatar) : avatar);
    }
    void reads_scene(const std::string& scene) {
        const std::vector<std::string> bundled = scene_names();
        const bool is_name = std::find(bundled.begin(), bundled.end(), scene) != bundled.end();
        reads("--scene", is_name ? scene_file(scene) : fs::path(scene));
    }
    void reads_motion(const std::string& option, const fs::path& motion, const MotionHints& hints) {
        reads(option, motion, kOpenPose);
        reads("--names", hints.name_map);
    }
    void reads_corpus(const std::string& option, const fs::path& folder) {
        if (folder.empty()) return;
        for (const char* file : {"corpus.json", "statistics.json", "data/cmu_intervals_df.csv"})
            reads(option, folder / file);
    }
    void reads_study(const fs::path& folder) {
        const StudyFolder study{folder};
        reads("DIR", study.open(), kAll);
        for (const fs::path& file :
             {study.key(), study.plan(), study.recordings(), study.report(), study.manifest()})
            reads("DIR", file);
    }
    void writes(const std::string& option, const fs::path& path, const std::string& ending = "") {
        if (!path.empty()) use_.outputs.push_back({option, path, ending});
    }
    void writes(const std::string& option, const std::optional<fs::path>& path,
                const std::string& ending = "") {
        if (path) writes(option, *path, ending);
    }
    void writes_in(const std::string& option, const fs::path& folder, const std::vector<std::string>& names) {
        for (const std::string& name : names) writes(option, folder / name);
    }
    FileUse take() { return std::move(use_); }

  private:
    FileUse use_;
};

void add(Uses& uses, const DemoCommand& command) {
    uses.writes("--out", command.out);
}

void add(Uses& uses, const SynthCommand& command) {
    const SynthesisJob& job = command.job;
    std::error_code none;
    // A script may be the text itself.
    if (fs::exists(job.script, none)) uses.reads(job.option, fs::path(job.script));
    uses.reads("--dialog", command.dialog);
    uses.reads("--speech", job.recording);
    uses.reads("--words", job.words);
    uses.reads("--speaker", fs::path(job.speaker));
    for (const fs::path& lexicon : job.lexicons) uses.reads("--lexicon", lexicon);
    uses.reads("--checkpoint", command.learned.checkpoint);
    uses.reads("--user-face", command.learned.user_face, kOpenPose);
    uses.reads("--user-speech", command.learned.user_speech);
    uses.reads("--bert", command.learned.bert, kBert);
    uses.reads("--content-of", command.learned.content_of);
    // Of "DIR:SPEAKER" the folder; a speaker alone is no file.
    if (command.learned.style_of) {
        const std::string& style = *command.learned.style_of;
        const std::size_t colon = style.rfind(':');
        if (style.ends_with(".h5"))
            uses.reads("--style-of", fs::path(style));
        else if (colon != std::string::npos)
            uses.reads_corpus("--style-of", style.substr(0, colon));
    }
    if (command.dialog.empty()) {
        uses.writes("--out", command.out);
    } else {
        uses.writes_in(
            "--out", command.out,
            {"person-0.h5", "person-0.wav", "person-0.json", "person-1.h5", "person-1.wav", "person-1.json"});
    }
    uses.writes("--speech-out", command.speech_out, ".wav");
    uses.writes("--score-out", command.score_out, ".json");
}

void add(Uses& uses, const RenderCommand& command) {
    const ClipJob& job = command.job;
    for (const Performer& performer : job.performers) {
        uses.reads_motion("--motion", performer.motion, performer.hints);
        uses.reads("--face", performer.face);
        uses.reads_avatar(performer.avatar);
        uses.reads("--audio", performer.voice);
        uses.reads("--film", performer.film);
    }
    uses.reads("--audio", job.audio);
    uses.reads_scene(job.scene);
    const bool is_stack = is_stack_pattern(job.out);
    uses.writes("--out", is_stack ? parse_stack_pattern(job.out).folder : job.out);
    uses.writes("--report", command.report);
}

void add(Uses& uses, const ConvertCommand& command) {
    uses.reads_motion("--motion", command.motion, command.hints);
    uses.reads("--face", command.face);
    if (command.avatar) uses.reads_avatar(*command.avatar);
    uses.writes("--out", command.out);
    uses.writes("--report", command.report);
}

void add(Uses& uses, const FitCommand& command) {
    for (const fs::path& motion : command.job.motions) uses.reads("M", motion, kMotions);
    uses.reads("--names", command.job.hints.name_map);
    uses.reads_avatar(command.job.avatar);
    uses.writes("--report", command.report);
}

void add(Uses& uses, const CompareCommand& command) {
    uses.reads("A", command.a, kPictures);
    uses.reads("B", command.b, kPictures);
    uses.writes("--diff", command.options.difference_folder);
    uses.writes("--junit", command.junit);
    uses.writes("--html", command.html);
}

void add(Uses& uses, const InfoCommand& command) {
    uses.reads_motion("FILE", command.file, command.hints);
}

void add(Uses&, const BenchCommand&) {}
void add(Uses&, const StudyPresetsCommand&) {}

void add(Uses& uses, const StudyBuildCommand& command) {
    const StudyFolder study{command.out};
    uses.reads("PLAN.json", command.plan);
    for (const fs::path& file :
         {study.open(), study.key(), study.plan(), study.recordings(), study.report(), study.manifest()})
        uses.writes("--out", file);
    uses.writes("--slurm-script", command.slurm_script);
}

void add(Uses& uses, const StudyCheckCommand& command) {
    uses.reads("DIR", command.study);
}

void add(Uses& uses, const StudyServeCommand& command) {
    uses.reads_study(command.options.study);
    uses.writes("--database", command.options.database);
}

void add(Uses& uses, const StudyAnswersCommand& command) {
    uses.reads_study(command.study);
    uses.reads("--database",
               command.database.empty() ? StudyFolder{command.study}.answers() : command.database);
    uses.writes("--out", command.out, ".json");
}

// Changes what it reads, which is its purpose.
void add(Uses& uses, const StudyForgetCommand& command) {
    uses.reads_study(command.job.study);
    for (const fs::path& file : command.job.also) uses.reads("--also", file);
}

void add(Uses& uses, const StudyPackCommand& command) {
    const PackJob& job = command.job;
    uses.reads_study(job.study);
    if (job.with_answers)
        uses.reads("--database", job.database.empty() ? StudyFolder{job.study}.answers() : job.database);
    uses.writes("--out", job.out, ".zip");
}

void add(Uses& uses, const StudyExportCommand& command) {
    uses.reads_study(command.options.study);
    uses.writes("--out", command.options.out);
}

void add(Uses& uses, const StudyPlanCommand& command) {
    uses.reads("PLAN.json", command.plan);
    for (const ConditionFolder& condition : command.folders.conditions)
        uses.reads("--from-folders", condition.folder, kMotions);
    uses.reads("--audio", command.folders.audio, kSounds);
    uses.reads("--partner", command.folders.partner, kMotions);
    uses.reads("--partner-audio", command.folders.partner_audio, kSounds);
    uses.reads("--segments", command.folders.segments);
    uses.writes("--out", command.out, ".json");
    uses.writes("--preregister", command.preregister, ".html");
}

void add(Uses& uses, const StudyAnalyseCommand& command) {
    if (command.study) uses.reads_study(*command.study);
    for (const fs::path& answers : command.answers) {
        uses.reads("--answers", answers);
        std::error_code none;
        if (!fs::is_directory(answers, none)) continue;
        for (const fs::path& file : analysis::files_of_answers({answers}).files)
            uses.reads("--answers", file);
    }
    if (!command.out) return;
    uses.writes("--out", *command.out);
    uses.writes_in("--out", *command.out,
                   {"report.html", "tables.tex", "analysis.json", "answers.csv", "participants.csv",
                    "battles.csv", "elo_samples.csv"});
}

void add(Uses& uses, const StudyRehearseCommand& command) {
    uses.reads_study(command.job.study);
    uses.writes("--out", command.out, ".json");
}

void add(Uses& uses, const CorpusMakeCommand& command) {
    uses.reads("--bert", command.bert, kBert);
    uses.writes("--out", command.order.folder);
}

void add(Uses& uses, const CorpusImportCommand& command) {
    uses.reads("JSON", command.job.manifest);
    uses.reads("--bert", command.bert, kBert);
    uses.writes("--out", command.job.out);
}

void add(Uses& uses, const CorpusInfoCommand& command) {
    uses.reads_corpus("DIR", command.folder);
}

void add(Uses& uses, const TrainCommand& command) {
    uses.reads_corpus("--corpus", command.corpus);
    uses.reads("--ast", command.ast, {"model.safetensors"});
    if (command.out == "-") uses.writes("--out", command.out);
    fs::path stem = command.out;
    if (stem.extension() == ".safetensors" || stem.extension() == ".json") stem.replace_extension();
    for (const char* ending : {".safetensors", ".resume.safetensors", ".json", ".svg"})
        uses.writes("--out", fs::path(stem) += ending);
}

void add(Uses& uses, const EvaluateCommand& command) {
    uses.reads_corpus("--corpus", command.corpus);
    std::set<std::string> predictions(command.against.begin(), command.against.end());
    for (const fs::path& checkpoint : command.checkpoints) {
        uses.reads("--checkpoint", checkpoint);
        predictions.insert(checkpoint.stem().string());
    }
    for (const fs::path& file : command.predictions) uses.reads("--predictions", file);
    uses.reads("--classifier", command.classifier);
    for (const std::string& name : predictions)
        uses.writes("--out", command.out / "predictions" / (name + ".h5"));
}

void add(Uses& uses, const MeasureCommand& command) {
    for (const fs::path& motion : command.motions) uses.reads_motion("M", motion, command.hints);
    uses.reads("--against", command.against, kOpenPose);
    uses.reads("--source", command.source, kOpenPose);
    uses.reads("--partner", command.partner, kOpenPose);
    uses.reads("--audio", command.audio);
}

// As the system sees them, without a last slash.
fs::path real_path(const fs::path& path) {
    std::error_code none;
    const fs::path real = fs::weakly_canonical(fs::absolute(path, none), none);
    if (real.empty()) return path;
    return real.has_filename() ? real : real.parent_path();
}

bool is_same(const fs::path& a, const fs::path& b) {
    std::error_code none;
    return fs::equivalent(a, b, none) || real_path(a) == real_path(b);
}

bool is_read(const fs::path& name, const InputPath& input) {
    const std::string text = to_lower(name.filename().string());
    return std::any_of(input.endings.begin(), input.endings.end(),
                       [&](const std::string& ending) { return text.ends_with(ending); });
}

bool is_among_files_of(const InputPath& input, const fs::path& output) {
    std::error_code none;
    const fs::path folder = real_path(input.path), file = real_path(output);
    if (!fs::is_directory(input.path, none) || !is_read(file, input)) return false;
    return std::mismatch(folder.begin(), folder.end(), file.begin(), file.end()).first == folder.end();
}

void refuse_overwritten(const OutputPath& output, const InputPath& input) {
    const std::string file = output.path.string();
    if (is_same(output.path, input.path)) {
        throw Error(format("{}: {} would replace what {} reads ({}); write to another name", file,
                           output.option, input.option, input.path.string()));
    }
    if (is_among_files_of(input, output.path)) {
        throw Error(format("{}: {} would write into the folder whose files {} reads ({}); write elsewhere",
                           file, output.option, input.option, input.path.string()));
    }
}

void refuse_other_ending(const OutputPath& output) {
    if (output.ending.empty() || to_lower(output.path.extension().string()) == output.ending) return;
    throw Error(format("{}: {} writes a file whose name ends in {}; write to {}", output.path.string(),
                       output.option, output.ending,
                       fs::path(output.path).replace_extension(output.ending).string()));
}

// Other programs take "-" for standard output; a file of that name would surprise whoever pipes it.
void refuse_standard_output(const OutputPath& output) {
    if (output.path.empty() || *output.path.begin() != "-") return;
    throw Error(format(
        "{}: is \"-\", but this is written to a file, never to standard output; name a file or a folder "
        "(./- for one of that name)",
        output.option));
}

// Seen before hours of work whose result could not be kept.
void refuse_unwritable(const OutputPath& output) {
    std::error_code none;
    if (!output.ending.empty() && fs::is_directory(output.path, none))
        throw Error(format("{}: this is a folder; name a file to write", output.path.string()));
    fs::path folder = fs::absolute(output.path, none).parent_path();
    while (fs::status(folder, none).type() == fs::file_type::not_found && folder.has_relative_path())
        folder = folder.parent_path();
    if (!fs::is_directory(folder, none)) {
        throw Error(format("{}: {} cannot be written, as {} is no folder; name a place in a folder",
                           output.path.string(), output.option, folder.string()));
    }
    if (::access(folder.c_str(), W_OK) != 0) {
        throw Error(format("{}: {} cannot be written into {} ({}); change its permissions or write elsewhere",
                           output.path.string(), output.option, folder.string(), std::strerror(errno)));
    }
}

// The bytes that are none shown as numbers.
std::string printable(const std::string& text) {
    std::string shown;
    for (const char c : text) {
        const auto byte = static_cast<unsigned char>(c);
        shown += byte < 0x80 ? std::string(1, c) : format("\\x{:02x}", byte);
    }
    return shown;
}

void expect_readable_name(const fs::path& file) {
    if (const auto fault = fault_in_utf8(file.string())) {
        throw Error(format("{}: byte {} of this name is not UTF-8; rename the file", printable(file.string()),
                           *fault));
    }
}

// A missing file is no fault here: its reader knows what else the name may mean.
void expect_readable(const InputPath& input) {
    expect_readable_name(input.path);
    std::error_code problem;
    const fs::file_type type = fs::status(input.path, problem).type();
    if (type == fs::file_type::not_found) return;
    if (type != fs::file_type::directory) return expect_file(input.path);
    if (input.endings.empty()) return;
    fs::recursive_directory_iterator entry(input.path, problem);
    for (; !problem && entry != fs::recursive_directory_iterator(); entry.increment(problem)) {
        if (is_read(entry->path(), input)) expect_readable_name(entry->path());
    }
}

}  // namespace

FileUse files_of(const Command& command) {
    Uses uses;
    std::visit([&uses](const auto& one) { add(uses, one); }, command);
    return uses.take();
}

void refuse_lost_files(const FileUse& use) {
    for (const InputPath& input : use.inputs) expect_readable(input);
    for (std::size_t i = 0; i < use.outputs.size(); ++i) {
        const OutputPath& output = use.outputs[i];
        expect_readable_name(output.path);
        refuse_standard_output(output);
        for (const InputPath& input : use.inputs) refuse_overwritten(output, input);
        refuse_other_ending(output);
        refuse_unwritable(output);
        for (std::size_t j = 0; j < i; ++j) {
            const OutputPath& other = use.outputs[j];
            if (!is_same(output.path, other.path)) continue;
            throw Error(format("{}: {} and {} name the same file; give each a name of its own",
                               output.path.string(), other.option, output.option));
        }
    }
}

}  // namespace chironomia::study
