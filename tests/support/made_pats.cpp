#include "tests/support/made_pats.h"

#include <cstring>
#include <vector>

#include "core/files/files.h"
#include "core/hdf5/writer.h"
#include "tests/support/support.h"

namespace chironomia::testing {

void write_made_pats(const std::filesystem::path& file) {
    constexpr std::size_t kPoints = 52;
    const std::string bytes = read_text(source_dir() / "tests/fixtures/gestures/pats_15fps.npy");
    const std::size_t head = bytes.find('\n') + 1;
    std::vector<float> numbers((bytes.size() - head) / sizeof(float));
    std::memcpy(numbers.data(), bytes.data() + head, numbers.size() * sizeof(float));
    const std::size_t frames = numbers.size() / (2 * kPoints);
    // A point that is not seen lies on the neck, the first one.
    std::vector<double> confidence(numbers.size(), 0.8);
    for (std::size_t t = 0; t < frames; ++t) {
        for (std::size_t k = 1; k < kPoints; ++k) {
            const std::size_t x = t * 2 * kPoints + k, y = x + kPoints;
            if (numbers[x] == 0 && numbers[y] == 0) confidence[x] = confidence[y] = 0;
        }
    }
    Hdf5Writer writer(file, file.string());
    writer.make_group("pose");
    writer.write_doubles("pose/data", {frames, 2 * kPoints},
                         std::vector<double>(numbers.begin(), numbers.end()));
    writer.write_doubles("pose/confidence", {frames, 2 * kPoints}, confidence);
    writer.make_group("audio");
    writer.write_doubles("audio/silence", {frames}, std::vector<double>(frames));
    writer.close();
}

}  // namespace chironomia::testing
