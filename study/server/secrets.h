// Secrets of the server: sessions, and the operator's token.
#pragma once

#include <string>
#include <string_view>

namespace chironomia::study::server {

// 32 hexadecimal digits (128 bits) that nobody can guess. Throws Error if the system gives no randomness.
std::string draw_secret();

// Takes as long for any two texts of these lengths, so that a guess learns nothing from the time of its
// refusal.
bool equal_in_constant_time(std::string_view a, std::string_view b);

}  // namespace chironomia::study::server
