#include "core/manner.h"

namespace chironomia {
namespace {

constexpr std::array<std::string_view, kExpressivities> kSymbols = {"oac", "spc", "tmp", "flt", "pwr", "rep"};
constexpr std::array<std::string_view, kExpressivities> kNames = {
    "overall activation", "spatial extent", "temporal extent", "fluidity", "power", "repetition"};

}  // namespace

std::string_view symbol_of(Expressivity dimension) {
    return kSymbols[static_cast<std::size_t>(dimension)];
}

std::string_view name_of(Expressivity dimension) {
    return kNames[static_cast<std::size_t>(dimension)];
}

std::optional<Expressivity> expressivity_named(std::string_view symbol) {
    for (std::size_t i = 0; i < kExpressivities; ++i)
        if (kSymbols[i] == symbol) return static_cast<Expressivity>(i);
    return std::nullopt;
}

double least_of(Expressivity dimension) {
    return dimension == Expressivity::overall_activation ? 0 : -1;
}

Manner overridden(const Manner& agent, const LocalManner& act) {
    Manner manner = agent;
    for (std::size_t i = 0; i < kExpressivities; ++i)
        if (act.values[i]) manner.values[i] = *act.values[i];
    return manner;
}

}  // namespace chironomia
