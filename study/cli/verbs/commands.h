// The verbs of the command line. Each prints its result on stdout and returns the exit code.
#pragma once

#include <cstdio>
#include <string>

#include "study/cli/command_line.h"

namespace chironomia {

inline void print(const std::string& text) {
    std::fputs(text.c_str(), stdout);
}

// Says on stderr that EGL draws, where this machine has no OSMesa.
void announce_stand_in();

int run(const DemoCommand& command);
int run(const SynthCommand& command);
int run(const TrainCommand& command);
int run(const EvaluateCommand& command);
int run(const MeasureCommand& command);
int run(const RenderCommand& command);
int run(const ConvertCommand& command);
int run(const CompareCommand& command);
int run(const CorpusMakeCommand& command);
int run(const CorpusImportCommand& command);
int run(const CorpusInfoCommand& command);
int run(const FitCommand& command);
int run(const InfoCommand& command);
int run(const BenchCommand& command);
int run(const StudyBuildCommand& command);
int run(const StudyCheckCommand& command);
int run(const StudyPresetsCommand& command);
int run(const StudyServeCommand& command);
int run(const StudyAnswersCommand& command);
int run(const StudyExportCommand& command);
int run(const StudyPlanCommand& command);
int run(const StudyAnalyseCommand& command);
int run(const StudyRehearseCommand& command);

}  // namespace chironomia
