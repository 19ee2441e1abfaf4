#include "synth/learning.h"

#include "core/error.h"
#include "core/files/helper_program.h"
#include "core/text.h"

namespace chironomia {
namespace {

// OpenBLAS and libtorch choose instructions by the processor, and with them the last digits of every product. Those
// of Haswell (2013) are known to every processor that has AVX2.
std::span<const char* const> chosen_instructions() {
#ifdef __x86_64__
    static constexpr const char* kHaswell[] = {"OPENBLAS_CORETYPE=Haswell", "ATEN_CPU_CAPABILITY=avx2"};
    if (__builtin_cpu_supports("avx2") && __builtin_cpu_supports("fma")) return kHaswell;
#endif
    return {};
}

const HelperProgram kLearn{.name = "chironomia_learn",
                           .variable = "CHIRONOMIA_LEARN",
                           .needed_by = "a learned model",
                           .built_folder = CHIRONOMIA_LEARN_FOLDER,
                           .remedy = "build chironomia with CHIRONOMIA_LEARNING=ON",
                           .environment = chosen_instructions()};

}  // namespace

Json ask_to_learn(const Json& job) {
    const std::filesystem::path helper = find_helper(kLearn);
    const HelperAnswer answer = ask_program(helper, kLearn, job.dump());
    const Json reply = Json::parse(answer.bytes, nullptr, false);
    if (reply.is_object() && reply.contains("error")) throw Error(reply["error"].get<std::string>());
    if (reply.is_object() && reply.contains("interrupted")) throw Interrupted();
    if (answer.exit_code != 0 || !reply.is_object()) {
        throw Error(
            format("{}: broke down (exit code {}); give it more memory, or report it with the command "
                   "that you gave",
                   helper.string(), answer.exit_code));
    }
    return reply;
}

}  // namespace chironomia
