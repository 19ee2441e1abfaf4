// chironomia_learn: reads a job on stdin, does it, and writes the answer on stdout; synth/learning.h describes
// both. A refused job answers {"error": "message"} with the exit code 3, a job that a signal ended
// {"interrupted": true} with 130.
#include <malloc.h>
#include <sys/prctl.h>

#include <csignal>
#include <cstdio>
#include <exception>
#include <string>

#include "core/error.h"
#include "core/files/helper_program.h"
#include "core/progress.h"
#include "synth/learned/models.h"

namespace chironomia {
namespace {

int reply(const Json& answer, int exit_code) {
    const std::string bytes = answer.dump();
    std::fwrite(bytes.data(), 1, bytes.size(), stdout);
    return std::fclose(stdout) == 0 ? exit_code : 1;
}

// Tensors of some megabytes come and go with every step. Giving them back to the system each time, which
// then clears them anew, costs a third of a training.
void keep_freed_memory() {
    mallopt(M_MMAP_THRESHOLD, 32 << 20);
    mallopt(M_TRIM_THRESHOLD, 1 << 30);
}

int run() {
    prctl(PR_SET_PDEATHSIG, SIGKILL);  // a killed training must not go on writing beside the next one
    keep_freed_memory();
    watch_for_interrupts();
    try {
        const Json job = Json::parse(read_stream(stdin), nullptr, false);
        return reply(answer(job), 0);
    } catch (const Interrupted&) {
        return reply({{"interrupted", true}}, 130);
    } catch (const Error& error) {
        return reply({{"error", error.what()}}, 3);
    } catch (const std::exception& bug) {
        std::fputs((std::string("chironomia_learn: ") + bug.what() + "\n").c_str(), stderr);
        return 4;
    }
}

}  // namespace
}  // namespace chironomia

int main() {
    return chironomia::run();
}
