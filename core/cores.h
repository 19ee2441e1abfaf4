// How many cores this program may use.
#pragma once

namespace chironomia {

// The cores that the system lets this process run on (a job of Slurm and a container may have fewer than the machine),
// or fewer where the CPU quota of its cgroup allows less. At least 1.
int available_cores();

}  // namespace chironomia
