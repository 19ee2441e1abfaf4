// Readers of bytes, each behind one function that libFuzzer and an ordinary test call alike.
#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <functional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace chironomia::testing {

class FuzzInput {
  public:
    FuzzInput(std::span<const std::uint8_t> bytes, std::string file_name)
        : bytes_(bytes), file_name_(std::move(file_name)) {}

    std::span<const std::byte> bytes() const { return std::as_bytes(bytes_); }
    std::string_view text() const { return {reinterpret_cast<const char*>(bytes_.data()), bytes_.size()}; }
    // A file of these bytes, which lasts until the next input is written.
    std::filesystem::path file() const;

  private:
    std::span<const std::uint8_t> bytes_;
    std::string file_name_;
};

struct FuzzReader {
    std::string name;       // of the reader in seeds.txt, seeds/ and findings/, and of its fuzzer
    std::string file_name;  // of an input that is read from a file; its folder and its ending may matter
    std::function<void(const FuzzInput&)> read;  // throws Error for what it refuses
};

// Adds a reader to those of the program.
struct AddFuzzReader {
    explicit AddFuzzReader(FuzzReader reader);
};

// The names of all readers of this program, sorted.
std::vector<std::string> fuzz_reader_names();

// Whether the reader accepts these bytes; false if it throws Error. Any other exception passes through.
bool is_accepted(const std::string& reader, std::span<const std::uint8_t> bytes);

// Where readers write what lasts as long as the process.
const std::filesystem::path& fuzz_folder();

// The reader that LLVMFuzzerTestOneInput calls from now on.
void choose_fuzz_reader(const std::string& name);

}  // namespace chironomia::testing

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* bytes, std::size_t size);
