// The rules of the house, checked by walking the includes: streets run one way, a library has one home and
// one public face that does not show it.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cstdlib>
#include <filesystem>
#include <functional>
#include <map>
#include <regex>
#include <set>
#include <string>
#include <vector>

#include "core/files/files.h"
#include "core/text.h"
#include "tests/support/support.h"

namespace chironomia {
namespace {

namespace fs = std::filesystem;
using ::testing::IsEmpty;

struct Include {
    std::string file;  // "raster/gl/shader.cpp"
    size_t line = 0;
    std::string target;  // "core/math.h", "torch/torch.h"
};

const std::vector<std::string> kRooms = {"core", "synth", "skinning", "scenes", "raster", "study"};

std::vector<Include> includes_in(const std::string& file, const std::string& text) {
    static const std::regex pattern(R"(^\s*#\s*include\s*[<"]([^>"]+)[>"])");
    std::vector<Include> found;
    size_t number = 0;
    for (const std::string_view line : split(text, '\n')) {
        ++number;
        std::match_results<std::string_view::const_iterator> match;
        if (std::regex_search(line.begin(), line.end(), match, pattern)) {
            found.push_back({file, number, match[1].str()});
        }
    }
    return found;
}

std::vector<std::string> source_files() {
    std::vector<std::string> files;
    for (const std::string& room : kRooms) {
        if (!fs::exists(testing::source_dir() / room)) continue;
        for (const auto& entry : fs::recursive_directory_iterator(testing::source_dir() / room)) {
            const fs::path extension = entry.path().extension();
            if (extension == ".h" || extension == ".cpp") {
                files.push_back(fs::relative(entry.path(), testing::source_dir()).string());
            }
        }
    }
    std::sort(files.begin(), files.end());
    return files;
}

std::vector<Include> includes_of_house() {
    std::vector<Include> all;
    for (const std::string& file : source_files()) {
        for (Include& include : includes_in(file, read_text(testing::source_dir() / file)))
            all.push_back(include);
    }
    return all;
}

bool is_room(const std::string& name) {
    return std::find(kRooms.begin(), kRooms.end(), name) != kRooms.end();
}

std::string first_folder(const std::string& path) {
    return path.substr(0, path.find('/'));
}

// The rule that an include of one of our own headers breaks, or "".
std::string street_fault(const Include& include) {
    const std::string from = first_folder(include.file);
    const std::string to = first_folder(include.target);
    if (!is_room(to) || to == from || to == "core") return "";
    if (from == "core") return "core includes no other room";
    if (to == "study") return "nothing includes study";
    if (from != "study") return "a stage includes only core, never another stage";
    return "";
}

std::string folder_of(const std::string& path) {
    return fs::path(path).parent_path().string();
}

// The first circle of folders that include each other, as "a -> b -> a", or "".
std::string circle_in(const std::map<std::string, std::set<std::string>>& includes) {
    std::set<std::string> finished;
    std::vector<std::string> path;
    const std::function<std::string(const std::string&)> walk =
        [&](const std::string& folder) -> std::string {
        const auto known = std::find(path.begin(), path.end(), folder);
        if (known != path.end())
            return join(std::vector<std::string>(known, path.end()), " -> ") + " -> " + folder;
        path.push_back(folder);
        if (!finished.contains(folder) && includes.contains(folder)) {
            for (const std::string& next : includes.at(folder)) {
                if (const std::string circle = walk(next); !circle.empty()) return circle;
            }
        }
        finished.insert(folder);
        path.pop_back();
        return "";
    };
    for (const auto& [folder, others] : includes) {
        if (const std::string circle = walk(folder); !circle.empty()) return circle;
    }
    return "";
}

// How many sources whose name ends so each folder holds.
std::map<std::string, size_t> files_of_folders(std::string_view ending) {
    std::map<std::string, size_t> count;
    for (const std::string& file : source_files()) {
        if (file.ends_with(ending)) ++count[folder_of(file)];
    }
    return count;
}

struct Home {
    std::string library;  // beginning of the include
    std::string home;     // beginning of the only files that may include it
    bool in_headers;      // whether a header of its home may show it
};

const std::vector<Home> kHomes = {
    {"glm/", "core/math.h", true},
    {"nlohmann/", "core/files/json.h", true},
    {"fmt/", "core/text.h", true},
    {"openssl/", "core/hash.cpp", false},
    {"torch/", "synth/learned/", true},
    {"espeak-ng/", "synth/speech/", false},
    {"md4c.h", "synth/markup/markdown.cpp", false},
    {"pugixml.hpp", "synth/markup/xml.cpp", false},
    {"Eigen/", "study/measure/vectors/", false},
    {"unsupported/Eigen/", "synth/features/fourier.cpp", false},
    {"utf8proc.h", "synth/markup/letters.cpp", false},
    {"hdf5.h", "core/hdf5/writer.cpp", false},
    {"tiny_gltf.h", "skinning/gltf/", false},
    {"draco/", "skinning/gltf/gltf_draco.cpp", false},
    {"meshoptimizer.h", "skinning/gltf/gltf_meshopt.cpp", false},
    {"webp/", "skinning/gltf/gltf_material.cpp", false},
    {"zip.h", "core/files/zip_archive.cpp", false},
    {"zlib.h", "core/hdf5/chunks", false},
    {"GL/glcorearb.h", "raster/gl/gl_functions.h", true},
    {"EGL/", "raster/gl/", false},
    {"rtcore.h", "raster/embree/embree.h", true},
    {"hwy/", "raster/", false},
    {"libav", "raster/ffmpeg/", false},
    {"libsw", "raster/ffmpeg/", false},
    {"ebur128.h", "study/clip/loudness", false},
    {"ft2build.h", "raster/images/", false},
    {"OpenImageIO/", "raster/images/", false},
    {"sqlite3.h", "study/server/", false},
    {"httplib.h", "study/server/", false},
    {"CLI/", "study/cli/", true},
    {"boost/math/", "study/measure/", false},
};

std::string home_fault(const Include& include) {
    for (const Home& home : kHomes) {
        if (!include.target.starts_with(home.library)) continue;
        if (!include.file.starts_with(home.home)) return format("{} lives in {}", home.library, home.home);
        if (!home.in_headers && include.file.ends_with(".h"))
            return format("a header shows {}", home.library);
    }
    return "";
}

template <typename Rule>
std::vector<std::string> faults(Rule rule) {
    std::vector<std::string> found;
    for (const Include& include : includes_of_house()) {
        const std::string fault = rule(include);
        if (!fault.empty()) {
            found.push_back(
                format("{}:{}: includes \"{}\": {}", include.file, include.line, include.target, fault));
        }
    }
    return found;
}

TEST(House, RoomsIncludeOneWay) {
    EXPECT_THAT(faults(street_fault), IsEmpty());
}

TEST(House, RoomsInsideRoomsIncludeEachOtherOneWay) {
    std::map<std::string, std::set<std::string>> includes;
    for (const Include& include : includes_of_house()) {
        if (!is_room(first_folder(include.target))) continue;
        const std::string from = folder_of(include.file), to = folder_of(include.target);
        if (from != to) includes[from].insert(to);
    }
    EXPECT_GT(includes.size(), 40u);
    EXPECT_EQ(circle_in(includes), "");
}

TEST(House, NoRoomHoldsMoreThanOneCanLookThrough) {
    std::vector<std::string> crowded;
    for (const auto& [folder, files] : files_of_folders(".cpp")) {
        if (files > 25) crowded.push_back(format("{}: {} files", folder, files));
    }
    EXPECT_THAT(crowded, IsEmpty()) << "find the room that is missing";
}

TEST(House, RoomsOfMoreThanFiveFilesHaveAReadme) {
    std::vector<std::string> lacking;
    for (const auto& [folder, files] : files_of_folders("")) {
        if (files > 5 && !fs::exists(testing::source_dir() / folder / "README.md")) lacking.push_back(folder);
    }
    EXPECT_THAT(lacking, IsEmpty()) << "say in ten lines what comes in, what goes out and where to start";
}

// The rooms that a README names in its sentence "Uses `a` and `b`.": folders, or headers.
std::vector<std::string> rooms_named(const std::string& page) {
    static const std::regex sentence(R"((^|\s)Uses (`[^.]*?(\.h`[^.]*?)*)\.(\s|$))"), name("`([^`]+)`");
    std::smatch match;
    std::vector<std::string> named;
    if (!std::regex_search(page, match, sentence)) return named;
    const std::string list = match[2];
    for (std::sregex_iterator each(list.begin(), list.end(), name), end; each != end; ++each)
        named.push_back((*each)[1]);
    return named;
}

bool lies_in(const std::string& path, const std::string& folder) {
    return path == folder || path.starts_with(folder + "/");
}

// What a README that says what its room uses leaves out, and what it names in vain. The rooms inside need no name.
TEST(House, ReadmesNameTheRoomsThatAreUsed) {
    std::map<std::string, std::set<std::string>> used;
    for (const Include& include : includes_of_house()) {
        const std::string from = folder_of(include.file);
        if (is_room(first_folder(include.target)) && !lies_in(include.target, from))
            used[from].insert(include.target);
    }
    std::vector<std::string> found;
    int pages = 0;
    for (const auto& [room, headers] : used) {
        const fs::path page = testing::source_dir() / room / "README.md";
        if (!fs::exists(page)) continue;
        const std::vector<std::string> named = rooms_named(read_text(page));
        if (named.empty()) continue;
        ++pages;
        for (const std::string& header : headers) {
            if (std::ranges::none_of(named, [&](const std::string& name) { return lies_in(header, name); }))
                found.push_back(format("{}/README.md does not name {}", room, header));
        }
        for (const std::string& name : named) {
            if (std::ranges::none_of(headers,
                                     [&](const std::string& header) { return lies_in(header, name); }))
                found.push_back(format("{}/README.md names {} in vain", room, name));
        }
    }
    EXPECT_GT(pages, 45);
    EXPECT_THAT(found, IsEmpty());
}

TEST(House, EachLibraryHasOneHomeAndAFaceThatDoesNotShowIt) {
    EXPECT_THAT(faults(home_fault), IsEmpty());
}

TEST(House, HeadersBeginWithAPragmaOnceAfterTheirPurpose) {
    std::vector<std::string> found;
    for (const std::string& file : source_files()) {
        if (!file.ends_with(".h")) continue;
        const std::string text = read_text(testing::source_dir() / file);
        if (!text.starts_with("// ") || text.find("\n#pragma once\n") == std::string::npos)
            found.push_back(file);
    }
    EXPECT_THAT(found, IsEmpty()) << "a header says its purpose in its first line and has #pragma once";
}

// To the linker two structs of one name are one: each would take the other's constructors and destructors.
TEST(House, HeadersGiveEachTypeOfANamespaceANameOfItsOwn) {
    const std::regex definition(R"((^|\n)(struct|class|enum class) (\w+)( final)?( :[^;{]*)? \{)");
    const std::regex opening(R"(\nnamespace (chironomia[\w:]*) \{)");
    std::map<std::string, std::string> header_of;
    std::vector<std::string> found;
    for (const std::string& file : source_files()) {
        if (!file.ends_with(".h")) continue;
        const std::string text = read_text(testing::source_dir() / file);
        std::smatch space;
        std::regex_search(text, space, opening);
        for (std::sregex_iterator match(text.begin(), text.end(), definition), end; match != end; ++match) {
            const auto [other, is_new] =
                header_of.try_emplace(space[1].str() + "::" + (*match)[3].str(), file);
            if (!is_new) found.push_back(format("{} of {} and {}", other->first, other->second, file));
        }
    }
    EXPECT_GT(header_of.size(), 100u);
    EXPECT_THAT(found, IsEmpty()) << "rename one of each";
}

// What stands between the parenthesis before `begin` and the one that closes it, divided at its own commas; `end` is
// behind the latter.
struct InParentheses {
    std::vector<std::string> parts;
    std::size_t end = 0;
};
InParentheses in_parentheses(std::string_view text, std::size_t begin) {
    InParentheses found;
    int depth = 0, angles = 0;
    std::size_t part = begin, at = begin;
    for (; at < text.size() && depth >= 0; ++at) {
        const char c = text[at];
        if (c == '(' || c == '[' || c == '{') ++depth;
        if (c == ')' || c == ']' || c == '}') --depth;
        if (c == '<') ++angles;
        if (c == '>' && angles > 0) --angles;
        if ((c == ',' && depth == 0 && angles == 0) || depth < 0) {
            found.parts.emplace_back(trim(text.substr(part, at - part)));
            part = at + 1;
        }
    }
    found.end = at;
    return found;
}

// The functions of a source that are declared with more than four arguments.
std::vector<std::string> functions_of_many_arguments(const std::string& source) {
    static const std::regex aside(R"(//[^\n]*|"(?:[^"\\\n]|\\.)*")"), name(R"(([A-Za-z_]\w*)\s*\()");
    static const std::regex declared(
        R"((const )?[A-Za-z_][\w:]*(\s*<.*>)?( const)?\s*[&*]*[\s&*][A-Za-z_]\w*(\s*=[^]*)?)");
    const std::string code = std::regex_replace(source, aside, "");
    std::vector<std::string> found;
    for (std::sregex_iterator match(code.begin(), code.end(), name), end; match != end; ++match) {
        const std::size_t begin = std::size_t(match->position() + match->length());
        const InParentheses list = in_parentheses(code, begin);
        const auto is_declared = [&](const std::string& part) { return std::regex_match(part, declared); };
        if (list.parts.size() > 4 && std::ranges::all_of(list.parts, is_declared))
            found.push_back((*match)[1]);
    }
    return found;
}

TEST(House, FunctionsTakeFourArgumentsAtMost) {
    std::vector<std::string> found;
    for (const std::string& file : source_files()) {
        for (const std::string& function :
             functions_of_many_arguments(read_text(testing::source_dir() / file)))
            found.push_back(file + ": " + function);
    }
    EXPECT_THAT(found, IsEmpty()) << "find the idea that some of them make together, and give it a struct";
}

TEST(House, NobodyUsesRandomnessOrTimeThatVaries) {
    const std::regex forbidden(
        R"(\b(std::\w+_distribution|std::random_device|std::mt19937|srand\(|std::rand\())");
    std::vector<std::string> found;
    for (const std::string& file : source_files()) {
        if (std::regex_search(read_text(testing::source_dir() / file), forbidden)) found.push_back(file);
    }
    EXPECT_THAT(found, IsEmpty()) << "randomness is a seed through core/random.h";
}

TEST(House, SourcesLookAsClangFormatWritesThem) {
    if (std::system("clang-format --version 2>&1 | grep -q 'version 14\\.'") != 0)
        GTEST_SKIP() << "needs clang-format 14, Debian 12's: others break lines elsewhere";
    std::string command = "cd '" + testing::source_dir().string() + "' && clang-format --dry-run -Werror";
    for (const std::string& file : source_files()) command += " " + file;
    EXPECT_EQ(std::system(command.c_str()), 0) << "run clang-format -i on the files named above";
}

// The bullets of a page, each on one line.
std::vector<std::string> bullets_of(const std::string& page) {
    std::vector<std::string> bullets;
    bool in_bullet = false;
    for (const std::string_view line : split(page, '\n')) {
        const bool begins = line.starts_with("- ");
        if (begins) bullets.emplace_back();
        in_bullet = begins || (in_bullet && line.starts_with("  "));
        if (in_bullet) bullets.back() += std::string(trim(line)) + " ";
    }
    return bullets;
}

// "Suite" and "Suite.Name" of all tests.
std::set<std::string> names_of_tests() {
    const std::regex test(R"(\bTEST(?:_F|_P)?\(\s*(\w+),\s*(\w+)\s*\))");
    std::set<std::string> names;
    for (const auto& entry : fs::recursive_directory_iterator(testing::source_dir() / "tests")) {
        if (entry.path().extension() != ".cpp") continue;
        const std::string text = read_text(entry.path());
        for (std::sregex_iterator match(text.begin(), text.end(), test), end; match != end; ++match) {
            names.insert((*match)[1].str());
            names.insert((*match)[1].str() + "." + (*match)[2].str());
        }
    }
    return names;
}

// What is wrong with the promises of a page: one without a test, or with a test that there is not.
std::vector<std::string> faults_of_promises(const std::string& page, const std::set<std::string>& tests) {
    const std::regex test(R"(`([A-Z]\w+(?:\.[A-Z]\w+)?)`)");
    std::vector<std::string> found;
    for (const std::string& promise : bullets_of(page)) {
        std::size_t named = 0;
        for (std::sregex_iterator match(promise.begin(), promise.end(), test), end; match != end; ++match) {
            ++named;
            if (!tests.contains((*match)[1].str())) found.push_back("there is no test " + (*match)[1].str());
        }
        if (named == 0) found.push_back("no test is named: " + promise);
    }
    return found;
}

// The rows of docs/code_index.md: a word, and the source and functions that decide it.
struct IndexEntry {
    std::string word;
    std::string file;
    std::vector<std::string> names;
};
std::vector<IndexEntry> entries_of_index(const std::string& page) {
    static const std::regex row(R"(\| ([^|]+) \| \[`[^`]+`\]\(\.\./([^)]+)\)(.*) \|)"), name("`([^`]+)`");
    std::vector<IndexEntry> entries;
    for (const std::string_view line : split(page, '\n')) {
        std::match_results<std::string_view::const_iterator> match;
        if (!std::regex_match(line.begin(), line.end(), match, row)) continue;
        IndexEntry& entry = entries.emplace_back(IndexEntry{match[1], match[2], {}});
        const std::string names = match[3];
        for (std::sregex_iterator each(names.begin(), names.end(), name), end; each != end; ++each)
            entry.names.push_back((*each)[1]);
    }
    return entries;
}

// `text_of` gives the text of a source, or "" where there is none.
std::vector<std::string> faults_of_index(const std::string& page,
                                         const std::function<std::string(const std::string&)>& text_of) {
    const std::vector<IndexEntry> entries = entries_of_index(page);
    std::vector<std::string> found;
    for (std::size_t i = 0; i < entries.size(); ++i) {
        const IndexEntry& entry = entries[i];
        const std::string text = text_of(entry.file);
        if (text.empty()) found.push_back("there is no " + entry.file);
        for (const std::string& name : entry.names) {
            if (!std::regex_search(text, std::regex("\\b" + name + "\\b")))
                found.push_back(format("{} has no {}", entry.file, name));
        }
        if (i > 0 && to_lower(entry.word) < to_lower(entries[i - 1].word))
            found.push_back(format("\"{}\" stands after \"{}\"", entry.word, entries[i - 1].word));
    }
    return found;
}

TEST(House, IndexNamesFunctionsThatAreThere) {
    const std::string page = read_text(testing::source_dir() / "docs/code_index.md");
    EXPECT_GT(entries_of_index(page).size(), 200u);
    const auto text_of = [](const std::string& file) {
        const fs::path path = testing::source_dir() / file;
        return fs::exists(path) ? read_text(path) : "";
    };
    EXPECT_THAT(faults_of_index(page, text_of), IsEmpty());
}

TEST(House, EachPromiseOfSecurityNamesTestsThatAreThere) {
    const std::string page = read_text(testing::source_dir() / "SECURITY.md");
    EXPECT_GT(bullets_of(page).size(), 30u);
    EXPECT_THAT(faults_of_promises(page, names_of_tests()), IsEmpty());
}

// Runs a copy of tools/install_packages in `folder`, on a machine where nothing is installed and whose
// release has all packages but libgone, as root. Returns what apt-get was asked for.
std::string asked_of_apt(const fs::path& folder, const std::string& packages, const std::string& kind = "") {
    fs::create_directories(folder / "tools");
    fs::copy_file(testing::source_dir() / "tools/install_packages", folder / "tools/install_packages");
    write_text(folder / "cmake/packages.txt", packages);
    const std::map<std::string, std::string> programs = {
        {"dpkg-query", "exit 1"},
        {"apt-cache", "[ $2 != libgone ]"},
        {"apt-get", format("echo \"$*\" >>'{}'", (folder / "asked").string())},
        {"id", "echo 0"}};
    for (const auto& [name, script] : programs) {
        write_text(folder / "bin" / name, "#!/bin/sh\n" + script + "\n");
        fs::permissions(folder / "bin" / name, fs::perms::owner_all);
    }
    const std::string command = format(
        "PATH='{0}/bin':$PATH '{0}/tools/install_packages' {1} >'{0}/said' 2>&1", folder.string(), kind);
    EXPECT_EQ(std::system(command.c_str()), 0) << read_text(folder / "said");
    return fs::exists(folder / "asked") ? read_text(folder / "asked") : "";
}

TEST(InstallPackages, DoesWithoutAnOptionalPackageThatTheReleaseLacks) {
    const testing::TemporaryFolder folder;
    EXPECT_EQ(asked_of_apt(folder.path(), "# all\nliba\nlibgone optional\nlibb optional\n"),
              "update\ninstall -y --no-install-recommends liba libb\n");
    EXPECT_EQ(read_text(folder / "said"),
              "This release has no package libgone; it is done without\n"
              "Installing 2 Debian packages (once; log: build/install.log)\n");
}

TEST(InstallPackages, IsSilentWhereNothingButAnOptionalPackageIsMissing) {
    const testing::TemporaryFolder folder;
    EXPECT_EQ(asked_of_apt(folder.path(), "libgone optional\n"), "");
    EXPECT_EQ(read_text(folder / "said"), "");
}

TEST(InstallPackages, LeavesOutWhatLearningNeedsWhereItIsOff) {
    const std::string packages = "liba\nlibtorch learning\n";
    const testing::TemporaryFolder with, without;
    EXPECT_EQ(asked_of_apt(with.path(), packages),
              "update\ninstall -y --no-install-recommends liba libtorch\n");
    setenv("CHIRONOMIA_LEARNING", "OFF", 1);
    EXPECT_EQ(asked_of_apt(without.path(), packages), "update\ninstall -y --no-install-recommends liba\n");
    unsetenv("CHIRONOMIA_LEARNING");
}

TEST(InstallPackages, LeavesWhatTheTestsAloneNeedToThem) {
    const std::string packages = "liba\nbrowser tests\nlibgone tests optional\nslurm tests optional\n";
    const testing::TemporaryFolder program, tests;
    EXPECT_EQ(asked_of_apt(program.path(), packages), "update\ninstall -y --no-install-recommends liba\n");
    EXPECT_EQ(asked_of_apt(tests.path(), packages, "tests"),
              "update\ninstall -y --no-install-recommends liba browser slurm\n");
    EXPECT_THAT(read_text(testing::source_dir() / "check"),
                ::testing::HasSubstr("tools/install_packages tests\n"));
}

// The rules themselves must be able to fail.
TEST(House, RulesSeeWhatTheyForbid) {
    const auto include = [](const char* file, const char* target) { return Include{file, 1, target}; };
    EXPECT_EQ(street_fault(include("core/math.h", "raster/gl/shader.h")), "core includes no other room");
    EXPECT_EQ(street_fault(include("raster/a.cpp", "skinning/b.h")),
              "a stage includes only core, never another stage");
    EXPECT_EQ(street_fault(include("scenes/a.cpp", "study/b.h")), "nothing includes study");
    EXPECT_EQ(street_fault(include("study/a.cpp", "raster/b.h")), "");
    EXPECT_EQ(home_fault(include("study/a.cpp", "CLI/CLI.hpp")), "CLI/ lives in study/cli/");
    EXPECT_EQ(home_fault(include("raster/gl/a.h", "EGL/egl.h")), "a header shows EGL/");
    EXPECT_EQ(home_fault(include("raster/gl/a.cpp", "EGL/egl.h")), "");
    EXPECT_EQ(circle_in({{"a", {"b"}}, {"b", {"c"}}}), "");
    EXPECT_THAT(
        faults_of_promises("- one: `Aa.Bb`,\n  `Cc`\n\n- two\n- three: `Aa.Cc`\n", {"Aa", "Aa.Bb", "Cc"}),
        ::testing::ElementsAre("no test is named: - two ", "there is no test Aa.Cc"));
    EXPECT_EQ(circle_in({{"a", {"b"}}, {"b", {"c"}}, {"c", {"b"}}}), "b -> c -> b");
    EXPECT_THAT(functions_of_many_arguments("void four(int a, int b, int c, Map<int, int> d);\n"
                                            "void five(int a, const Far::Point& b, int c, int* d,\n"
                                            "          std::vector<Pair<int, int>> e = {1, 2});  // (int f)\n"
                                            "void g() { h(a, b, c, d, e); }\n"),
                ::testing::ElementsAre("five"));
    EXPECT_THAT(
        faults_of_index("| bones | [`a.cpp`](../a.cpp): `one`, `two` |\n| Arms | [`b.cpp`](../b.cpp) |\n",
                        [](const std::string& file) { return file == "a.cpp" ? "int one;" : ""; }),
        ::testing::ElementsAre("a.cpp has no two", "there is no b.cpp", "\"Arms\" stands after \"bones\""));
    EXPECT_EQ(includes_in("a.cpp", "int x;\n  #include <glm/glm.hpp>\n")[0].line, 2u);
}

}  // namespace
}  // namespace chironomia
