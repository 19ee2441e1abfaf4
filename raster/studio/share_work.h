// Work cut into numbered pieces that several threads share.
#pragma once

#include <functional>

namespace chironomia {

// Calls work(0) to work(count - 1), each once, from up to `threads` threads (0: all cores), and waits for
// all. A call may write only what belongs to its number; then the result is the same for any number of
// threads.
void share_work(int count, int threads, const std::function<void(int)>& work);

}  // namespace chironomia
