#include "tests/fuzz/fuzz_reader.h"

#include <cstdlib>
#include <fstream>
#include <iostream>
#include <map>

#include "core/error.h"
#include "core/files/scratch_folder.h"
#include "core/text.h"

namespace chironomia::testing {
namespace {

namespace fs = std::filesystem;

std::map<std::string, FuzzReader>& all_readers() {
    static std::map<std::string, FuzzReader> readers;
    return readers;
}

const FuzzReader*& chosen_reader() {
    static const FuzzReader* chosen = nullptr;
    return chosen;
}

}  // namespace

fs::path FuzzInput::file() const {
    const fs::path file = fuzz_folder() / file_name_;
    fs::create_directories(file.parent_path());
    // Not as outputs are written, whole or not at all: millions of inputs are.
    std::ofstream(file, std::ios::binary).write(text().data(), static_cast<std::streamsize>(bytes_.size()));
    return file;
}

AddFuzzReader::AddFuzzReader(FuzzReader reader) {
    const std::string name = reader.name;
    all_readers().emplace(name, std::move(reader));
}

std::vector<std::string> fuzz_reader_names() {
    std::vector<std::string> names;
    for (const auto& [name, reader] : all_readers()) names.push_back(name);
    return names;
}

const fs::path& fuzz_folder() {
    static const ScratchFolder folder("fuzz");
    return folder.path();
}

void choose_fuzz_reader(const std::string& name) {
    const auto found = all_readers().find(name);
    if (found == all_readers().end())
        throw Error(format("{}: there is no such reader; this program has {}", name,
                           join(fuzz_reader_names(), ", ")));
    chosen_reader() = &found->second;
}

bool is_accepted(const std::string& reader, std::span<const std::uint8_t> bytes) {
    choose_fuzz_reader(reader);
    try {
        chosen_reader()->read(FuzzInput(bytes, chosen_reader()->file_name));
        return true;
    } catch (const Error& refused) {
        if (std::string_view(refused.what()).empty()) throw std::logic_error("a refusal without a message");
        return false;
    }
}

}  // namespace chironomia::testing

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* bytes, std::size_t size) {
    using namespace chironomia::testing;
    if (chosen_reader()) is_accepted(chosen_reader()->name, {bytes, size});
    return 0;
}

// A fuzzer is called as its reader.
extern "C" int LLVMFuzzerInitialize(int*, char*** arguments) {
    try {
        chironomia::testing::choose_fuzz_reader(std::filesystem::path(**arguments).filename().string());
    } catch (const chironomia::Error& unknown) {
        std::cerr << unknown.what() << '\n';
        std::exit(3);
    }
    return 0;
}
