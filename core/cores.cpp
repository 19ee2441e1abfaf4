#include "core/cores.h"

#include <sched.h>

#include <algorithm>
#include <cmath>
#include <fstream>
#include <thread>

namespace chironomia {
namespace {

// Of the control group that a container sees as the root of all, version 2; 0 where there is no limit.
int cores_of_quota() {
    std::ifstream file("/sys/fs/cgroup/cpu.max");
    double quota = 0, period = 0;
    if (!(file >> quota >> period) || quota <= 0 || period <= 0) return 0;
    return std::max(1, static_cast<int>(std::ceil(quota / period)));
}

}  // namespace

int available_cores() {
    // glibc counts the cores of the machine since 2.35.
    cpu_set_t allowed;
    int cores = static_cast<int>(std::thread::hardware_concurrency());
    if (sched_getaffinity(0, sizeof allowed, &allowed) == 0) cores = CPU_COUNT(&allowed);
    if (const int quota = cores_of_quota(); quota > 0) cores = std::min(cores, quota);
    return std::max(1, cores);
}

}  // namespace chironomia
