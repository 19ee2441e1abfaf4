// The helper program chironomia_learn as the main program asks it.
#include "synth/learning.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cstdlib>

#include "core/files/files.h"
#include "tests/support/support.h"

namespace chironomia {
namespace {

using ::testing::AllOf;
using ::testing::HasSubstr;
using testing::refusal_of;

const Json kQuestion{{"verb", "describe"}, {"model", "amii"}, {"preset", "paper"}};

// Another program in the place of the helper.
class Instead {
  public:
    explicit Instead(const std::filesystem::path& program) { setenv("CHIRONOMIA_LEARN", program.c_str(), 1); }
    ~Instead() { unsetenv("CHIRONOMIA_LEARN"); }
    Instead(const Instead&) = delete;
    Instead& operator=(const Instead&) = delete;
};

TEST(AskToLearn, AnswersWhatAModelIs) {
    const Json answer = ask_to_learn(kQuestion);
    EXPECT_EQ(answer["parameters"], 13'908);
    EXPECT_EQ(answer["options"]["A25"], "joint");
}

TEST(AskToLearn, RefusesWithTheWordsOfTheHelper) {
    EXPECT_THAT(
        refusal_of([] {
            ask_to_learn({{"verb", "describe"}, {"checkpoint", "none"}});
        }),
        HasSubstr(
            "none.safetensors: there is no such checkpoint, and no none.json beside it; check the path"));
    EXPECT_THAT(refusal_of([] {
                    ask_to_learn({{"verb", "describe"}});
                }),
                HasSubstr("job: checkpoint: is missing"));
}

TEST(AskToLearn, SaysThatTheHelperIsMissingOrBreaksDown) {
    const testing::TemporaryFolder folder;
    {
        const Instead nothing(folder / "nothing");
        EXPECT_THAT(refusal_of([] { ask_to_learn(kQuestion); }),
                    AllOf(HasSubstr("chironomia_learn: a learned model needs this program"),
                          HasSubstr("set CHIRONOMIA_LEARN to its path")));
    }
    const auto script = folder / "breaks";
    write_text(script, "#!/bin/sh\nexit 7\n");
    std::filesystem::permissions(script, std::filesystem::perms::owner_all);
    const Instead other(script);
    EXPECT_THAT(refusal_of([] { ask_to_learn(kQuestion); }), HasSubstr("breaks: broke down (exit code 7)"));
}

}  // namespace
}  // namespace chironomia
