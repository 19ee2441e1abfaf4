#include "core/cores.h"

#include <gtest/gtest.h>
#include <sched.h>

#include <thread>

namespace chironomia {
namespace {

TEST(AvailableCores, AreThoseThatTheProcessMayRunOn) {
    const int before = available_cores();
    EXPECT_GE(before, 1);
    // A thread has an affinity of its own.
    std::thread([] {
        cpu_set_t allowed, one;
        ASSERT_EQ(sched_getaffinity(0, sizeof allowed, &allowed), 0);
        CPU_ZERO(&one);
        for (int core = 0; core < CPU_SETSIZE && CPU_COUNT(&one) == 0; ++core)
            if (CPU_ISSET(core, &allowed)) CPU_SET(core, &one);
        ASSERT_EQ(sched_setaffinity(0, sizeof one, &one), 0);
        EXPECT_EQ(available_cores(), 1);
    }).join();
    EXPECT_EQ(available_cores(), before);
}

}  // namespace
}  // namespace chironomia
