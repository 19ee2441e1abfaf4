#include "raster/studio/share_work.h"

#include <algorithm>
#include <atomic>
#include <thread>
#include <vector>

#include "core/cores.h"

namespace chironomia {

int threads_of(int threads) {
    return threads == 0 ? available_cores() : threads;
}

void share_work(int count, int threads, const std::function<void(int)>& work) {
    std::atomic<int> next{0};
    const auto take = [&] {
        for (int i = next++; i < count; i = next++) work(i);
    };
    std::vector<std::jthread> helpers;
    for (int i = 1; i < std::min(threads_of(threads), count); ++i) helpers.emplace_back(take);
    take();
}

void share_stretches(std::size_t count, std::size_t at_once, int threads,
                     const std::function<void(std::size_t, std::size_t)>& work) {
    share_work(static_cast<int>((count + at_once - 1) / at_once), threads, [&](int n) {
        const std::size_t first = static_cast<std::size_t>(n) * at_once;
        work(first, std::min(count, first + at_once));
    });
}

}  // namespace chironomia
