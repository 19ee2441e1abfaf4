// A real Slurm of two nodes on this machine, for as long as it lives.
#pragma once

#include <sys/types.h>

#include <string>
#include <vector>

#include "tests/support/support.h"

namespace chironomia::testing {

// What keeps a Slurm from running on this machine; "" if nothing does.
std::string why_no_slurm();

class SlurmCluster {
  public:
    // Starts it and lets this process's sbatch and squeue find it. Throws if its nodes do not come up.
    SlurmCluster();
    ~SlurmCluster();
    SlurmCluster(const SlurmCluster&) = delete;
    SlurmCluster& operator=(const SlurmCluster&) = delete;

    // The processes of jobs on a node ("n1"), but for Slurm's own.
    std::vector<pid_t> jobs_on(const std::string& node) const;

    // The node dies: its daemon first, then what watches over its jobs, then these.
    void kill_node(const std::string& node) const;

  private:
    void stop() const;

    TemporaryFolder folder_;
    pid_t nodes_ = -1;
    int their_stdin_ = -1;
};

}  // namespace chironomia::testing
