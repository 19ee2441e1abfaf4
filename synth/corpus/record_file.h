// The arrays of a record's file, each against the length that it must have.
#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

#include "core/hdf5/file.h"
#include "core/hdf5/writer.h"
#include "synth/corpus/records.h"

namespace chironomia {

class RecordFile {
  public:
    // Throws Error if the file is missing or no HDF5 file.
    explicit RecordFile(const std::filesystem::path& file);

    const Hdf5File& hdf5() const { return hdf5_; }
    bool has(const std::string& path) const { return hdf5_.has(path); }

    // Throw Error if the attribute, or the array, is missing.
    std::string text(const std::string& group, const char* attribute) const;
    double number(const std::string& group, const char* attribute) const;
    // How many rows of `width` numbers there are; at least one.
    std::size_t rows_of(const std::string& path, std::size_t width) const;
    // `rows` of `width` numbers, of one number without a second side. `like` is the array that says how many
    // rows there must be.
    std::vector<float> floats(const std::string& path, std::size_t rows, std::size_t width,
                              const std::string& like) const;
    std::vector<std::uint8_t> flags(const std::string& path, std::size_t rows, std::size_t width,
                                    const std::string& like) const;
    std::vector<int> ints(const std::string& path, std::size_t rows, const std::string& like) const;
    // Of the texts at `texts` and their starts and ends [s] at `times`; none if there are no texts.
    std::vector<CorpusWord> words(const std::string& texts, const std::string& times) const;

  private:
    std::vector<double> numbers(const std::string& path, std::size_t rows, std::size_t width,
                                const std::string& like) const;

    std::vector<std::byte> bytes_;
    Hdf5File hdf5_;
};

void write_words(Hdf5Writer& file, const std::string& texts, const std::string& times,
                 const std::vector<CorpusWord>& words);

}  // namespace chironomia
