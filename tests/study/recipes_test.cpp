// The recipes of docs/howto/many-machines.md and docs/images.md: what is no command of this program is checked for its
// syntax, and the commands of this program in it are understood.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cstdlib>
#include <regex>

#include "core/files/files.h"
#include "core/files/json.h"
#include "core/text.h"
#include "study/cli/command_line.h"
#include "tests/support/support.h"

namespace chironomia::study {
namespace {

namespace fs = std::filesystem;
using ::testing::HasSubstr;
using testing::source_dir;
using testing::TemporaryFolder;

// The blocks of code of a page in one language.
std::vector<std::string> blocks_of(const std::string& page, const std::string& language) {
    const std::regex block("```" + language + "\n([^`]*)```");
    const std::string text = read_text(source_dir() / page);
    std::vector<std::string> blocks;
    for (std::sregex_iterator match(text.begin(), text.end(), block), end; match != end; ++match)
        blocks.push_back((*match)[1].str());
    return blocks;
}

int run(const std::string& command) {
    return std::system((command + " >/dev/null 2>&1").c_str());
}

// Every text in a YAML file.
std::vector<std::string> texts_of_yaml(const std::string& yaml) {
    const TemporaryFolder folder;
    write_text(folder / "recipe.yaml", yaml);
    write_text(folder / "texts.py", R"(import json, sys, yaml
texts = []
def collect(node):
    if isinstance(node, str): texts.append(node)
    for part in node.values() if isinstance(node, dict) else node if isinstance(node, list) else []: collect(part)
collect(yaml.safe_load(open(sys.argv[1])))
json.dump(texts, open(sys.argv[2], "w"))
)");
    const std::string json = (folder / "texts.json").string();
    EXPECT_EQ(run(format("python3 '{}' '{}' '{}'", (folder / "texts.py").string(),
                         (folder / "recipe.yaml").string(), json)),
              0)
        << yaml;
    return read_json(json).get<std::vector<std::string>>();
}

// Parses every "study build ..." and "study check ..." of a script, with numbers in place of what a scheduler fills in;
// returns how many there are.
std::size_t parse_commands(std::string script) {
    script = std::regex_replace(script, std::regex(R"(\\\n)"), " ");
    script = std::regex_replace(
        script, std::regex(R"(\$\{\{ (?:matrix.part|secrets.SEED) \}\}|\$\(\([A-Z_]+ \+ 1\)\)|\{\})"), "1");
    static const std::regex kCommand(R"(\bstudy (?:build|check) [^\n]*)");
    std::size_t count = 0;
    for (std::sregex_iterator match(script.begin(), script.end(), kCommand), end; match != end; ++match) {
        std::vector<std::string> words = {"chironomia"};
        const std::string line = match->str();
        for (const std::string_view word : split_words(line)) words.emplace_back(word);
        std::vector<const char*> argv;
        for (const std::string& word : words) argv.push_back(word.c_str());
        const CommandLine parsed = parse_command_line(static_cast<int>(argv.size()), argv.data());
        EXPECT_TRUE(parsed.command) << line << "\n" << parsed.text;
        ++count;
    }
    return count;
}

TEST(Recipes, AreScriptsOfTheShell) {
    std::size_t commands = 0;
    for (const char* page : {"docs/howto/many-machines.md", "docs/images.md"}) {
        for (const std::string& script : blocks_of(page, "sh")) {
            const TemporaryFolder folder;
            write_text(folder / "recipe.sh", script);
            EXPECT_EQ(run(format("bash -n '{}'", (folder / "recipe.sh").string())), 0) << script;
            commands += parse_commands(script);
        }
    }
    EXPECT_EQ(commands, 5u);
}

TEST(Recipes, AreYamlWithCommandsThatAreUnderstood) {
    const std::vector<std::string> recipes = blocks_of("docs/howto/many-machines.md", "yaml");
    ASSERT_EQ(recipes.size(), 2u);
    std::vector<std::size_t> commands;
    for (const std::string& recipe : recipes) {
        std::size_t& count = commands.emplace_back(0);
        for (const std::string& text : texts_of_yaml(recipe)) count += parse_commands(text);
    }
    EXPECT_THAT(commands, ::testing::ElementsAre(3, 1));
}

// Both images do what docs/install.md says, in its order.
TEST(Images, TakeTheStepsOfTheInstallPage) {
    static const std::regex kFirstBlock("```\n([^`]*)```");
    const std::string page = read_text(source_dir() / "docs/install.md");
    std::smatch match;
    ASSERT_TRUE(std::regex_search(page, match, kFirstBlock));
    const std::string steps = match[1].str();
    EXPECT_THAT(steps, HasSubstr("tools/install_packages"));
    for (const char* image : {"Dockerfile", "apptainer.def"}) {
        const std::string text = read_text(source_dir() / image);
        std::size_t at = 0;
        for (const std::string_view step : split(trim(steps), '\n')) {
            at = text.find(step, at);
            ASSERT_NE(at, std::string::npos) << image << " lacks, or has at another place: " << step;
        }
        EXPECT_THAT(text, HasSubstr("debian:12"));
    }
}

TEST(Images, HaveOnlyTheInstructionsOfTheirForms) {
    const std::string docker =
        std::regex_replace(read_text(source_dir() / "Dockerfile"), std::regex(R"(\\\n)"), " ");
    for (const std::string_view line : split(trim(docker), '\n'))
        EXPECT_TRUE(std::regex_match(std::string(line),
                                     std::regex("#.*|(FROM|COPY|WORKDIR|RUN|ENTRYPOINT|CMD) [^ ].*")))
            << line;
    const std::string apptainer = read_text(source_dir() / "apptainer.def");
    for (const std::string_view line : split(trim(apptainer), '\n'))
        EXPECT_TRUE(std::regex_match(
            std::string(line),
            std::regex("#.*||    .*|(Bootstrap|From): [^ ]+|%(files|post|environment|runscript)")))
            << line;
    const std::size_t begin = apptainer.find("%post\n") + 6;
    const TemporaryFolder folder;
    write_text(folder / "post.sh", apptainer.substr(begin, apptainer.find("\n%", begin) - begin));
    EXPECT_EQ(run(format("bash -n '{}'", (folder / "post.sh").string())), 0);
}

}  // namespace
}  // namespace chironomia::study
