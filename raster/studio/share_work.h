// Work cut into numbered pieces that several threads share.
#pragma once

#include <cstddef>
#include <functional>

namespace chironomia {

// How many threads `threads` asks for, where 0 asks for all cores.
int threads_of(int threads);

// Calls work(0) to work(count - 1), each once, from up to `threads` threads (0: all cores), and waits for
// all. A call may write only what belongs to its number; then the result is the same for any number of
// threads.
void share_work(int count, int threads, const std::function<void(int)>& work);

// The same for `count` things in stretches of up to `at_once`: calls work(first, last), `last` not included.
void share_stretches(std::size_t count, std::size_t at_once, int threads,
                     const std::function<void(std::size_t, std::size_t)>& work);

}  // namespace chironomia
