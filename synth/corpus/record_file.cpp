#include "synth/corpus/record_file.h"

#include <cmath>

#include "core/files/files.h"
#include "core/text.h"

namespace chironomia {
namespace {

constexpr std::size_t kAny = Hdf5File::kAny;

std::vector<std::size_t> shape_of_rows(std::size_t rows, std::size_t width) {
    return width == 1 ? std::vector<std::size_t>{rows} : std::vector<std::size_t>{rows, width};
}

}  // namespace

RecordFile::RecordFile(const std::filesystem::path& file)
    : bytes_(read_bytes(file)), hdf5_(bytes_, file.string()) {}

std::string RecordFile::text(const std::string& group, const char* attribute) const {
    auto value = hdf5_.text_attribute(group, attribute);
    if (!value) hdf5_.refuse(format("/{} has no attribute \"{}\" of one text", group, attribute));
    return std::move(*value);
}

double RecordFile::number(const std::string& group, const char* attribute) const {
    const auto value = hdf5_.attribute(group, attribute);
    if (!value) hdf5_.refuse(format("/{} has no attribute \"{}\" of one number", group, attribute));
    return *value;
}

std::size_t RecordFile::rows_of(const std::string& path, std::size_t width) const {
    const std::vector<std::size_t> shape = hdf5_.shape_of(path);
    const bool fits = shape.size() == (width == 1 ? 1u : 2u) && (width == 1 || shape[1] == width);
    if (!fits) {
        hdf5_.refuse(format("/{} has the shape ({}); (any{}) is expected", path, fmt::join(shape, ", "),
                            width == 1 ? std::string() : format(", {}", width)));
    }
    if (shape[0] == 0) hdf5_.refuse(format("/{} is empty", path));
    return shape[0];
}

std::vector<double> RecordFile::numbers(const std::string& path, std::size_t rows, std::size_t width,
                                        const std::string& like) const {
    if (const std::size_t found = rows_of(path, width); rows != kAny && found != rows) {
        hdf5_.refuse(
            format("/{} has {} rows, /{} has {}; they must be equally long", path, found, like, rows));
    }
    return hdf5_.read_numbers(path, shape_of_rows(rows, width));
}

std::vector<float> RecordFile::floats(const std::string& path, std::size_t rows, std::size_t width,
                                      const std::string& like) const {
    const std::vector<double> found = numbers(path, rows, width, like);
    return {found.begin(), found.end()};
}

std::vector<std::uint8_t> RecordFile::flags(const std::string& path, std::size_t rows, std::size_t width,
                                            const std::string& like) const {
    std::vector<std::uint8_t> flags;
    for (const double found : numbers(path, rows, width, like)) {
        if (found != 0 && found != 1)
            hdf5_.refuse(format("/{}: element {} is {}; 0 or 1 is expected", path, flags.size(), found));
        flags.push_back(found != 0);
    }
    return flags;
}

std::vector<int> RecordFile::ints(const std::string& path, std::size_t rows, const std::string& like) const {
    std::vector<int> ints;
    for (const double found : numbers(path, rows, 1, like)) {
        if (found != std::floor(found))
            hdf5_.refuse(
                format("/{}: element {} is {}; a whole number is expected", path, ints.size(), found));
        ints.push_back(static_cast<int>(found));
    }
    return ints;
}

std::vector<CorpusWord> RecordFile::words(const std::string& texts, const std::string& times) const {
    std::vector<CorpusWord> words;
    if (!has(texts)) return words;
    const std::vector<std::string> found = hdf5_.read_texts(texts);
    const std::vector<double> spans = numbers(times, found.size(), 2, texts);
    for (std::size_t i = 0; i < found.size(); ++i)
        words.push_back({.text = found[i], .start = spans[2 * i], .end = spans[2 * i + 1]});
    return words;
}

void write_words(Hdf5Writer& file, const std::string& texts, const std::string& times,
                 const std::vector<CorpusWord>& words) {
    if (words.empty()) return;
    std::vector<std::string> names;
    std::vector<double> spans;
    for (const CorpusWord& word : words) {
        names.push_back(word.text);
        spans.insert(spans.end(), {word.start, word.end});
    }
    file.write_texts(texts, names);
    file.write_doubles(times, {words.size(), 2}, spans);
}

}  // namespace chironomia
