// Whether the program under test is built with sanitizers. Tests themselves are compiled alike in both presets.
#pragma once

extern "C" void __asan_init() __attribute__((weak));

namespace chironomia::testing {

// They make everything ten times slower: tests that try many random inputs try fewer, and others than in release.
inline bool has_sanitizers() {
    return __asan_init != nullptr;
}

}  // namespace chironomia::testing
