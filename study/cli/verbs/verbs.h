// The verbs of the command line. Each adds its options to the parser, which leave a command in `result`, and runs such
// a command: it prints on stdout and returns the exit code.
#pragma once

#include <cstdio>
#include <optional>
#include <string>
#include <vector>

#include "study/cli/options/commands.h"

namespace CLI {
class App;
}

namespace chironomia::study {

inline void print(const std::string& text) {
    std::fputs(text.c_str(), stdout);
}

// On stderr, one a line.
inline void warn(const std::vector<std::string>& warnings) {
    for (const std::string& warning : warnings) std::fputs((warning + "\n").c_str(), stderr);
}

// Says on stderr that EGL draws, where this machine has no OSMesa.
void announce_egl_fallback();

void add_demo(CLI::App& app, std::optional<Command>& result);
void add_synth(CLI::App& app, std::optional<Command>& result);
void add_render(CLI::App& app, std::optional<Command>& result);
void add_convert(CLI::App& app, std::optional<Command>& result);
void add_fit(CLI::App& app, std::optional<Command>& result);
void add_compare(CLI::App& app, std::optional<Command>& result);
void add_info(CLI::App& app, std::optional<Command>& result);
void add_bench(CLI::App& app, std::optional<Command>& result);
void add_corpus_make(CLI::App& app, std::optional<Command>& result);
void add_corpus_import(CLI::App& app, std::optional<Command>& result);
void add_corpus_info(CLI::App& app, std::optional<Command>& result);
void add_train(CLI::App& app, std::optional<Command>& result);
void add_evaluate(CLI::App& app, std::optional<Command>& result);
void add_measure(CLI::App& app, std::optional<Command>& result);
void add_study_build(CLI::App& app, std::optional<Command>& result);
void add_study_check(CLI::App& app, std::optional<Command>& result);
void add_study_serve(CLI::App& app, std::optional<Command>& result);
void add_study_answers(CLI::App& app, std::optional<Command>& result);
void add_study_forget(CLI::App& app, std::optional<Command>& result);
void add_study_pack(CLI::App& app, std::optional<Command>& result);
void add_study_export(CLI::App& app, std::optional<Command>& result);
void add_study_plan(CLI::App& app, std::optional<Command>& result);
void add_study_presets(CLI::App& app, std::optional<Command>& result);
void add_study_analyse(CLI::App& app, std::optional<Command>& result);
void add_study_rehearse(CLI::App& app, std::optional<Command>& result);

int run(const DemoCommand& command);
int run(const SynthCommand& command);
int run(const RenderCommand& command);
int run(const ConvertCommand& command);
int run(const FitCommand& command);
int run(const CompareCommand& command);
int run(const InfoCommand& command);
int run(const BenchCommand& command);
int run(const CorpusMakeCommand& command);
int run(const CorpusImportCommand& command);
int run(const CorpusInfoCommand& command);
int run(const TrainCommand& command);
int run(const EvaluateCommand& command);
int run(const MeasureCommand& command);
int run(const StudyBuildCommand& command);
int run(const StudyCheckCommand& command);
int run(const StudyServeCommand& command);
int run(const StudyAnswersCommand& command);
int run(const StudyForgetCommand& command);
int run(const StudyPackCommand& command);
int run(const StudyExportCommand& command);
int run(const StudyPlanCommand& command);
int run(const StudyPresetsCommand& command);
int run(const StudyAnalyseCommand& command);
int run(const StudyRehearseCommand& command);

}  // namespace chironomia::study
