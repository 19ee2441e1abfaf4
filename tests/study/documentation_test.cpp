// What README, the documents and the help of the verbs promise: files that they name exist, and commands that
// they show are understood and run.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <map>
#include <regex>
#include <set>
#include <string>
#include <vector>

#include "core/files/files.h"
#include "core/files/json.h"
#include "core/text.h"
#include "core/version.h"
#include "study/cli/command_line.h"
#include "study/cli/file_use.h"
#include "tests/study/process.h"
#include "tests/support/support.h"

namespace chironomia::study {
namespace {

namespace fs = std::filesystem;
using ::testing::IsEmpty;
using testing::Outcome;
using testing::run_chironomia;
using testing::source_dir;
using testing::TemporaryFolder;

const std::vector<std::string> kVerbs = {"",
                                         "demo",
                                         "synth",
                                         "corpus",
                                         "corpus make",
                                         "corpus import",
                                         "corpus info",
                                         "render",
                                         "convert",
                                         "measure",
                                         "fit",
                                         "compare",
                                         "info",
                                         "bench",
                                         "study",
                                         "study build",
                                         "study check",
                                         "study serve",
                                         "study answers",
                                         "study forget",
                                         "study pack",
                                         "study presets",
                                         "study export",
                                         "study plan",
                                         "study analyse",
                                         "study rehearse",
                                         "train",
                                         "evaluate"};

// What the examples need that is not in the repository, and why.
const std::map<std::string, std::string> kForeign = {
    {"me.vrm", "an avatar of the reader"},
    {"expected", "references that the reader accepted earlier"},
    {"wave.bvh", "a motion of the reader"},
    {"take.bvh", "a motion of the reader"},
    {"take.wav", "a recording of the reader"},
    {"ours.bvh", "a motion of the reader"},
    {"styled.bvh", "a motion of the reader"},
    {"target.bvh", "a motion of the reader"},
    {"talk.bvh", "a motion of the reader"},
    {"baseline.bvh", "a motion of the reader"},
    {"recorded.csv", "a face of the reader"},
    {"listener.csv", "a face of the reader"},
    {"predicted.h5", "what a model of the reader did"},
    {"openface.csv", "a face of the reader"},
    {"openpose", "a folder of the reader"},
    {"camera.mov", "a film of the reader"},
    {"cmu0000025735.h5", "an interval of PATS, which may not be passed on"},
    {"answers", "answers of participants"},
    {"responses", "answers of participants"},
    {"battles.csv", "votes of GENEA's leaderboard"},
    {"plan.json", "a plan of the reader"},
    {"m.h5", "is made by an example that is not run"},
    {"s.wav", "is made by an example that is not run"},
    {"study", "is built in another document"},
    {"out", "is built in another document"},
    {"rehearsal.json", "is made by an example that is not run"},
    {"talks", "takes minutes to make"},
    {"talks-full", "takes hours to make"},
    {"dyads", "takes minutes to make"},
    {"model2.safetensors", "takes hours to train"},
    {"zs.safetensors", "takes an hour to train"},
    {"mix.safetensors", "takes minutes to train"},
    {"people", "takes minutes to make"},
    {"pats", "PATS, which may not be passed on"},
};

// Verbs that take too long or never end by themselves, and two whose database only a server makes.
const std::set<std::string> kNotRun = {"train",       "evaluate",      "bench",       "corpus make",
                                       "study serve", "study answers", "study forget"};

std::vector<fs::path> documents() {
    std::vector<fs::path> files;
    for (const char* page : {"README.md", "CHANGELOG.md", "CONTRIBUTING.md", "SECURITY.md"})
        files.push_back(source_dir() / page);
    for (const char* folder :
         {"docs", "assets", "core", "raster", "scenes", "skinning", "study", "synth", "tests"}) {
        for (const auto& entry : fs::recursive_directory_iterator(source_dir() / folder))
            if (entry.path().extension() == ".md") files.push_back(entry.path());
    }
    std::sort(files.begin(), files.end());
    return files;
}

std::vector<std::string> matches_of(const std::regex& pattern, const std::string& text) {
    std::vector<std::string> found;
    for (std::sregex_iterator match(text.begin(), text.end(), pattern), end; match != end; ++match)
        found.push_back((*match)[1].str());
    return found;
}

// The words of a line as the shell takes them apart: quotes hold words together, # begins a comment.
std::vector<std::string> words_of(const std::string& line) {
    std::vector<std::string> words;
    char quote = 0;
    bool in_word = false;
    for (const char c : line) {
        if (quote == 0 && c == '#' && !in_word) break;
        if (c == quote) {
            quote = 0;
        } else if (quote == 0 && (c == '\'' || c == '"')) {
            quote = c;
            if (!in_word) words.emplace_back();
            in_word = true;
        } else if (quote == 0 && c == ' ') {
            in_word = false;
        } else {
            if (!in_word) words.emplace_back();
            in_word = true;
            words.back() += c;
        }
    }
    return words;
}

// The commands of a document's blocks of code, each as its words.
std::vector<std::vector<std::string>> commands_of(const fs::path& document) {
    std::vector<std::vector<std::string>> commands;
    bool in_block = false;
    std::string begun;  // of a line that goes on
    const std::string text = read_text(document);
    for (const std::string_view raw : split(text, '\n')) {
        if (trim(raw).starts_with("```")) in_block = !in_block;
        std::string line = begun + std::string(trim(raw));
        begun.clear();
        if (line.starts_with("$ ")) line.erase(0, 2);
        if (!in_block || !line.starts_with("chironomia ")) continue;
        if (line.ends_with('\\')) {
            begun = line.substr(0, line.size() - 1);
        } else {
            commands.push_back(words_of(line));
        }
    }
    return commands;
}

CommandLine parsed(const std::vector<std::string>& words) {
    std::vector<const char*> argv;
    for (const std::string& word : words) argv.push_back(word.c_str());
    return parse_command_line(static_cast<int>(argv.size()), argv.data());
}

TEST(Documentation, NamesFilesThatExist) {
    static const std::regex link(R"(\]\(([^)#\s]+)[^)]*\))");
    static const std::regex path(
        R"(`((?:core|synth|skinning|scenes|raster|study|assets|tests|docs|tools|cmake)/[\w./-]+\.\w+)`)");
    std::vector<std::string> missing;
    for (const fs::path& document : documents()) {
        const std::string text = read_text(document);
        for (const std::string& target : matches_of(link, text)) {
            const bool is_address = target.find(':') != std::string::npos;
            if (!is_address && !fs::exists(document.parent_path() / target))
                missing.push_back(format("{}: {}", document.string(), target));
        }
        for (const std::string& file : matches_of(path, text))
            if (!fs::exists(source_dir() / file))
                missing.push_back(format("{}: {}", document.string(), file));
    }
    EXPECT_THAT(missing, IsEmpty());
}

// The README.md of all rooms and of the rooms in them.
std::vector<fs::path> room_pages() {
    std::vector<fs::path> pages;
    for (const fs::path& page : documents()) {
        const std::string room = fs::relative(page, source_dir()).begin()->string();
        const bool is_room = room != "docs" && room != "assets" && room != "tests";
        if (is_room && page.filename() == "README.md" && page.parent_path() != source_dir())
            pages.push_back(page);
    }
    return pages;
}

TEST(Documentation, IsAllReachedFromItsIndex) {
    std::vector<std::string> lost;
    const std::string front = read_text(source_dir() / "README.md");
    for (const fs::path& page : room_pages()) {
        const std::string path = fs::relative(page, source_dir()).string();
        if (front.find("(" + path + ")") == std::string::npos) lost.push_back(path);
    }
    for (const fs::path& folder : {source_dir() / "docs", source_dir() / "docs/howto"}) {
        const std::string index = read_text(folder / "README.md");
        for (const auto& entry : fs::directory_iterator(folder)) {
            const std::string name = entry.path().filename().string();
            if (name.ends_with(".md") && name != "README.md" && index.find("(" + name) == std::string::npos)
                lost.push_back(entry.path().string());
        }
    }
    EXPECT_THAT(lost, IsEmpty()) << "link them from the README.md of their folder, those of rooms from ours";
}

TEST(Documentation, LinksTheSourcesThatRoomsName) {
    static const std::regex name(R"((?:^|[^[])`([\w./-]+\.(?:h|cpp))`)");
    std::vector<std::string> unlinked;
    for (const fs::path& page : room_pages()) {
        for (const std::string& file : matches_of(name, read_text(page)))
            if (fs::exists(page.parent_path() / file)) unlinked.push_back(page.string() + ": " + file);
    }
    EXPECT_THAT(unlinked, IsEmpty());
}

TEST(Documentation, ShowsCodeAsItIs) {
    static const std::regex link(R"(\]\((\.\./[\w./-]+\.(?:h|cpp))\))");
    static const std::regex code(R"(```cpp\n([^`]*)```)");
    const fs::path tour = source_dir() / "docs/tour.md";
    std::string sources;
    for (const std::string& file : matches_of(link, read_text(tour)))
        sources += read_text(tour.parent_path() / file);
    const std::vector<std::string> shown = matches_of(code, read_text(tour));
    EXPECT_GE(shown.size(), 20u);
    for (const std::string& part : shown) EXPECT_NE(sources.find(part), std::string::npos) << part;
}

TEST(Help, NamesFilesThatExist) {
    static const std::regex path(R"(\b([\w-]+(?:/[\w-]+)+\.(?:md|h|json))\b)");
    std::vector<std::string> missing;
    std::size_t named = 0;
    for (const std::string& verb : kVerbs) {
        std::vector<std::string> words = {"chironomia"};
        for (const std::string_view word : split_words(verb)) words.emplace_back(word);
        words.emplace_back("--help");
        const CommandLine help = parsed(words);
        ASSERT_EQ(help.exit_code, 0) << verb << ": " << help.text;
        for (const std::string& file : matches_of(path, help.text)) {
            ++named;
            if (!fs::exists(source_dir() / file)) missing.push_back(format("{} --help: {}", verb, file));
        }
    }
    EXPECT_GT(named, 4u);
    EXPECT_THAT(missing, IsEmpty());
}

TEST(Documentation, ShowsCommandsThatAreUnderstood) {
    std::size_t count = 0;
    for (const fs::path& document : documents()) {
        for (const std::vector<std::string>& words : commands_of(document)) {
            ++count;
            const CommandLine line = parsed(words);
            EXPECT_TRUE(line.command || line.exit_code == 0)
                << document.string() << ": " << join(words, " ") << "\n"
                << line.text;
        }
    }
    EXPECT_GT(count, 40u);
}

// The folder in which the commands of one document run one after the other, with a copy of the assets beside
// them.
class Workplace {
  public:
    Workplace() : before_(fs::current_path()) {
        fs::copy(source_dir() / "assets", folder_ / "assets", fs::copy_options::recursive);
        fs::current_path(folder_.path());
    }
    ~Workplace() { fs::current_path(before_); }
    Workplace(const Workplace&) = delete;
    Workplace& operator=(const Workplace&) = delete;

  private:
    TemporaryFolder folder_;
    fs::path before_;
};

// The protocols of assets/samples/plans are large, and built by tests of their own.
bool is_run(const std::vector<std::string>& words) {
    const std::string verb = words.size() > 2 ? words[1] + " " + words[2] : words[1];
    if (verb == "study build" && words[3].starts_with("assets/samples/plans/")) return false;
    // The smallest corpus takes seconds.
    if (verb == "corpus make" && std::ranges::find(words, "ci") != words.end()) return true;
    return !kNotRun.contains(words[1]) && !kNotRun.contains(verb);
}

// "Save this as `plan.json`" and a block of JSON or CSV.
void save_files_of(const fs::path& document) {
    static const std::regex file(R"(Save this as `([\w.-]+)`[^`]*```(?:json|csv)\n([^`]*)```)");
    const std::string text = read_text(document);
    for (std::sregex_iterator match(text.begin(), text.end(), file), end; match != end; ++match)
        write_text((*match)[1].str(), (*match)[2].str());
}

bool is_missing(const fs::path& file) {
    return !fs::exists(file) &&
           (kForeign.contains(file.string()) || kForeign.contains(file.begin()->string()));
}

bool has_all_inputs(const std::vector<std::string>& words) {
    for (const auto& [file, reason] : kForeign) {
        const bool is_named = std::find(words.begin(), words.end(), file + "/") != words.end();
        if (is_named && !fs::exists(file)) return false;
    }
    const FileUse use = files_of(*parsed(words).command);
    return std::none_of(use.inputs.begin(), use.inputs.end(),
                        [](const InputPath& input) { return is_missing(input.path); });
}

// Learned engines need libtorch, which a build can do without.
bool asks_learned_models(const fs::path& document) {
    const auto commands = commands_of(document);
    return std::ranges::any_of(
        commands, [](const auto& words) { return std::ranges::find(words, "--engine") != words.end(); });
}

// The commands as shown, but for clips made small and, where nothing else is said, short: drawing them whole takes minutes
// and tests nothing more.
void make_clips_small(std::vector<std::string>& words) {
    constexpr int kWidth = 160;
    constexpr int kHeight = 90;
    if (words.front() == "render") {
        words.insert(words.end(), {"--size", format("{}x{}", kWidth, kHeight)});
        const auto is_given = [&](const char* option) {
            return std::find(words.begin(), words.end(), option) != words.end();
        };
        if (!is_given("--frames") && !is_given("--cut") && !is_given("--notice-at") && !is_given("--say-at"))
            words.insert(words.end(), {"--frames", "0:6"});
    } else if (words.size() > 2 && words[0] == "study" && words[1] == "build") {
        Json plan = read_json(words[2]);
        plan["render"]["size"] = {kWidth, kHeight};
        plan["render"]["fps"] = 10;
        for (Json& clip : plan["clips"]) clip["cut"] = {2, 3};
        words[2] = (fs::path(words[2]).parent_path() / "small.json").string();
        write_json(words[2], plan);
    }
}

TEST(Documentation, ShowsCommandsThatRun) {
    std::size_t run = 0;
    for (const fs::path& document : documents()) {
        if (torch_version().empty() && asks_learned_models(document)) continue;
        const Workplace workplace;
        save_files_of(document);
        for (std::vector<std::string> words : commands_of(document)) {
            if (!is_run(words) || !has_all_inputs(words)) continue;
            words.erase(words.begin());
            make_clips_small(words);
            const Outcome outcome = run_chironomia(words);
            EXPECT_EQ(outcome.exit_code, 0)
                << document.string() << ": chironomia " << join(words, " ") << "\n"
                << outcome.err;
            ++run;
        }
    }
    EXPECT_GT(run, 50u);
}

}  // namespace
}  // namespace chironomia::study
