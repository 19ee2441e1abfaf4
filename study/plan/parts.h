// The functions that read the parts of a plan. For study/plan/*.cpp alone.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "core/files/json_value.h"
#include "study/plan/plan.h"
#include "synth/speakers/speakers.h"

namespace chironomia::study {

inline constexpr double kLatestCut = 36000;  // of a clip, where it begins or ends [s]

const std::vector<std::string>& keys_of(std::string_view object);

// The path below `folder`, whatever the form of its accents; it need not be there.
std::filesystem::path find_path(const std::filesystem::path& folder, const std::filesystem::path& written);

// A file named by the plan, which must be there.
std::filesystem::path read_path(const JsonValue& value, const std::filesystem::path& folder);

// A value with a file ending is a path; anything else is one of `names`.
std::filesystem::path read_path_or_name(const JsonValue& value, const std::filesystem::path& folder,
                                        const std::vector<std::string>& names);

// One of the bundled speakers, or a file of one, which is read. `names` are all that may stand there in its place.
std::string read_speaker_name(const JsonValue& value, const Plan& plan,
                              const std::vector<std::string>& names = speaker_names());

PlanRender read_render(const JsonValue& value, const std::filesystem::path& folder,
                       Presentation presentation);
MotionHints read_hints_of_condition(const JsonValue& value, const std::filesystem::path& folder);

// In the order of Presentation.
const std::vector<std::string>& presentation_names();

// "mismatched speech", "delayed", ...: what "by" says of a condition that is made.
std::string kind_of_making(const PlanCondition& condition);

// These fill in what they are named after; they rely on what stands above them here.
void read_conditions(const JsonValue& whole, Plan& plan);  // and what is shown together
void read_hints(const JsonValue& whole, const std::filesystem::path& folder, Plan& plan);
void read_modes_of_conditions(const JsonValue& whole, Plan& plan);
void read_clips(const JsonValue& whole, const std::filesystem::path& folder, Plan& plan);
void read_participants(const JsonValue& whole, const Json& written, Plan& plan);  // without its preset
void read_questions(const JsonValue& whole, Plan& plan);                          // and passes and checks
void read_scales_of_plan(const JsonValue& whole, Plan& plan);
void read_right_answers(const JsonValue& whole, Plan& plan);
void read_texts(const JsonValue& whole, Plan& plan);
void read_preregistration(const JsonValue& whole, Plan& plan);

}  // namespace chironomia::study
