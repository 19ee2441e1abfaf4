// Frames per second as an exact ratio: 30000/1001 is not 29.97.
#pragma once

#include <optional>
#include <string>
#include <string_view>

namespace chironomia {

struct Rate {
    int numerator = 30;   // frames
    int denominator = 1;  // in so many seconds

    double per_second() const { return static_cast<double>(numerator) / denominator; }
    double seconds(size_t frames) const { return static_cast<double>(frames) * denominator / numerator; }

    bool operator==(const Rate&) const = default;
};

// "30", "12.5" and "30000/1001" are taken exactly, in lowest terms; "29.97", "23.976", "119.88" and their
// like, the usual short forms of n x 1000/1001, are taken as that ratio. Nothing if the text is no such
// number, or is not above 0, or is above 1000.
std::optional<Rate> parse_rate(std::string_view text);

// "30", "12.5" or "30000/1001": a text that parse_rate reads back as the same rate.
std::string to_text(const Rate& rate);

}  // namespace chironomia
