// The manner of an agent's movement: six dimensions of expressivity.
#pragma once

#include <array>
#include <cstddef>
#include <optional>
#include <string_view>

namespace chironomia {

// Hartmann, Mancini, Pelachaud, "Towards Affective Agent Action: Modelling Expressive ECA Gestures", 2005,
// section "Set of Expressivity Attributes".
enum class Expressivity {
    overall_activation,  // oac: how much moves during a turn
    spatial_extent,      // spc: how much space is taken up
    temporal_extent,     // tmp: quick or sustained
    fluidity,            // flt: smooth or jerky, one movement running into the next
    power,               // pwr: weak or strong
    repetition,          // rep: rhythmic repeats of a stroke
};

inline constexpr std::size_t kExpressivities = 6;

// "oac", "spc", "tmp", "flt", "pwr", "rep", as in the paper; "overall activation" and so on.
std::string_view symbol_of(Expressivity dimension);
std::string_view name_of(Expressivity dimension);
std::optional<Expressivity> expressivity_named(std::string_view symbol);

// Lowest value of a dimension: 0 for the overall activation, -1 for the others. The highest is 1.
double least_of(Expressivity dimension);

// A value of each dimension, within its range; all others at 0 are the generic agent.
struct Manner {
    std::array<double, kExpressivities> values{0.5, 0, 0, 0, 0, 0};

    double& operator[](Expressivity dimension) { return values[static_cast<std::size_t>(dimension)]; }
    double operator[](Expressivity dimension) const { return values[static_cast<std::size_t>(dimension)]; }

    bool operator==(const Manner&) const = default;
};

// Values that one communicative act sets for itself, in place of the agent's.
struct LocalManner {
    std::array<std::optional<double>, kExpressivities> values{};

    std::optional<double>& operator[](Expressivity dimension) {
        return values[static_cast<std::size_t>(dimension)];
    }
    const std::optional<double>& operator[](Expressivity dimension) const {
        return values[static_cast<std::size_t>(dimension)];
    }

    bool operator==(const LocalManner&) const = default;
};

Manner overridden(const Manner& agent, const LocalManner& act);

}  // namespace chironomia
