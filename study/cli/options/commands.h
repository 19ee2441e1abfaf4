// What the user asked for, before anything is done: a plain struct for each verb.
#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <variant>
#include <vector>

#include "raster/images/compare_sets.h"
#include "skinning/motion/picture/picture_camera.h"
#include "study/analysis/rehearsal.h"
#include "study/batch/slurm_build.h"
#include "study/cli/options/model_options.h"
#include "study/clip/clip.h"
#include "study/corpus/import.h"
#include "study/exports/export_study.h"
#include "study/exports/pack_study.h"
#include "study/fit/fit_clips.h"
#include "study/measure/bradley_terry.h"
#include "study/models/evaluation.h"
#include "study/models/synthesis.h"
#include "study/plan/from_folders.h"
#include "study/server/forget.h"
#include "study/server/serve.h"
#include "synth/corpus/make/make_corpus.h"

namespace chironomia::study {

enum ExitCode {
    kExitYes = 0,
    kExitNo = 1,  // to what a verb was asked: compare (the same?), fit (fit to show?), study check (sound?)
    kExitWrongCommandLine = 2,
    kExitWrongInput = 3,
    kExitOurBug = 4,
    kExitInterrupted = 130,
};

struct DemoCommand {
    std::filesystem::path out = "chironomia-demo";
    bool replace = false;
    bool quiet = false;
};

struct RenderCommand {
    ClipJob job;
    std::optional<std::filesystem::path> report;
};

struct ConvertCommand {
    std::filesystem::path motion;  // empty: a face alone
    MotionHints hints;
    std::optional<std::filesystem::path> face;
    FaceOptions face_options;
    std::optional<double> fps;                    // of the result; otherwise the motion's own
    std::optional<std::filesystem::path> avatar;  // "none": a GLB of the motion's own skeleton
    std::optional<std::filesystem::path> report;
    bool lift = false;                    // bring the points of a picture into space
    bool no_interpenetration = false;     // move arms out of the body
    bool mocapnet_names = false;          // of the joints in a BVH
    std::optional<PictureCamera> camera;  // of a folder of OpenPose, where the user set it
    std::filesystem::path out;
};

struct SynthCommand {
    SynthesisJob job;
    LearnedEngine learned{.model = "expressive"};  // as the options say; in the job unless it is that one
    std::filesystem::path dialog;                  // in place of what one person says; empty: none
    std::filesystem::path out;                     // of a dialog a folder
    std::optional<std::filesystem::path> speech_out;
    std::optional<std::filesystem::path> score_out;
};

struct TrainCommand {
    std::string model;
    std::filesystem::path corpus;
    std::string preset = "small";
    std::filesystem::path out;
    std::uint64_t seed = 1;
    int threads = 1;
    std::optional<std::size_t> epochs;
    std::optional<std::size_t> steps;
    std::optional<double> save_every;          // [s]
    std::optional<std::filesystem::path> ast;  // folder of weights
    ModelOptions options;
    bool quiet = false;
    bool json = false;
};

struct EvaluateCommand {
    std::vector<std::filesystem::path> checkpoints;
    std::vector<std::filesystem::path> predictions;  // made elsewhere
    std::filesystem::path corpus;                    // empty: for predictions alone
    std::string split = "test";
    std::vector<std::string> against;                 // names of baselines
    std::optional<std::filesystem::path> classifier;  // of styles
    std::filesystem::path out;
    EvaluationOptions evaluation;
    ModelOptions options;  // of predicting
    int threads = 1;
    bool quiet = false;
    bool json = false;
};

struct MeasureCommand {
    std::vector<std::filesystem::path> motions;
    MotionHints hints;
    std::optional<std::filesystem::path> against;  // what people did, or the style that was aimed at
    std::optional<std::filesystem::path> source;   // whose style was to become that of `against`
    std::optional<std::filesystem::path> partner;  // who talks with them
    std::optional<std::filesystem::path> audio;    // that goes with them
    bool json = false;
};

struct FitCommand {
    FitJob job;
    std::optional<std::filesystem::path> report;  // a page where it ends in .html, else JSON
    bool json = false;
};

struct CompareCommand {
    std::filesystem::path a;
    std::filesystem::path b;
    SetOptions options{.quiet = false};
    std::optional<std::filesystem::path> junit;
    std::optional<std::filesystem::path> html;
    bool update = false;  // `b` becomes the reference
    bool json = false;
};

struct CorpusMakeCommand {
    CorpusOrder order;
    std::optional<std::filesystem::path> bert;  // none: the built-in encoder
};

struct CorpusImportCommand {
    ImportJob job;
    std::optional<std::filesystem::path> bert;  // none: the built-in encoder
};

struct CorpusInfoCommand {
    std::filesystem::path folder;
    bool json = false;
};

struct InfoCommand {
    std::filesystem::path file;
    MotionHints hints;
    bool json = false;
};

struct BenchCommand {
    RendererKind renderer = kDefaultRenderer;
    bool json = false;
};

struct StudyBuildCommand {
    std::filesystem::path plan;
    std::filesystem::path out;
    std::uint64_t seed = 0;
    int jobs = 1;
    std::optional<Shard> shard;  // none: what is missing of all, and the study
    bool dry_run = false;
    bool slurm = false;
    std::optional<std::filesystem::path> slurm_script;  // to be written
    SlurmOptions cluster;                               // but for the plan
    bool replace = false;
    bool quiet = false;
};

struct StudyCheckCommand {
    std::filesystem::path study;
    std::optional<std::filesystem::path> again;  // the plan
    int jobs = 1;
    bool json = false;
};

struct StudyServeCommand {
    server::ServeOptions options;
};

struct StudyPresetsCommand {
    bool json = false;
};

struct StudyExportCommand {
    ExportOptions options;
};

struct StudyAnswersCommand {
    std::filesystem::path study;
    std::filesystem::path database;  // empty: the study's own
    std::filesystem::path out;
};

struct StudyForgetCommand {
    server::ForgetJob job;
};

struct StudyPackCommand {
    PackJob job;
};

struct StudyPlanCommand {
    std::filesystem::path plan;                // empty: it is made of folders
    FoldersJob folders;                        // but for `plan_folder`
    std::optional<std::filesystem::path> out;  // of the plan that is made; none: stdout
    std::filesystem::path preregister;         // a page to write; empty: none
    std::uint64_t seed = 1;
    bool json = false;  // the plan with everything filled in
    bool power = false;
    std::optional<double> effect;  // Elo, or standard deviations of an answer
};

struct StudyAnalyseCommand {
    std::optional<std::filesystem::path> study;
    std::vector<std::filesystem::path> answers;
    std::optional<std::filesystem::path> out;  // otherwise private/analysis of the study
    Resampling resampling;
    bool json = false;
};

struct StudyRehearseCommand {
    analysis::RehearsalJob job;
    std::filesystem::path out;
};

using Command = std::variant<DemoCommand, SynthCommand, RenderCommand, ConvertCommand, FitCommand,
                             CompareCommand, InfoCommand, BenchCommand, StudyBuildCommand, StudyCheckCommand,
                             StudyServeCommand, StudyAnswersCommand, StudyForgetCommand, StudyPackCommand,
                             StudyExportCommand, StudyPlanCommand, StudyPresetsCommand, StudyAnalyseCommand,
                             StudyRehearseCommand, CorpusMakeCommand, CorpusImportCommand, CorpusInfoCommand,
                             TrainCommand, EvaluateCommand, MeasureCommand>;

}  // namespace chironomia::study
