// chironomia demo
#include <cstdio>

#include "core/files.h"
#include "core/text.h"
#include "study/cli/commands.h"

namespace chironomia {
namespace {

constexpr std::uint64_t kDemoSeed = 1;  // everybody gets the same demo

}  // namespace

int run(const DemoCommand& command) {
    const int code = run(StudyBuildCommand{.plan = find_asset("assets/samples/plan.json"),
                                           .out = command.out,
                                           .seed = kDemoSeed,
                                           .jobs = 1,
                                           .quiet = command.quiet});
    const std::string folder = command.out.string();
    std::fputs(format("\nOpen {0}/public/index.html in a browser to take part in the study.\n"
                      "{0}/private/key.json tells which video is which.\n",
                      folder)
                   .c_str(),
               stdout);
    return code;
}

}  // namespace chironomia
