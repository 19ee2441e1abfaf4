// What Slurm's own programs answer: submitting a script, and which jobs of a name there are.
#pragma once

#include <cstddef>
#include <set>
#include <string>
#include <vector>

namespace chironomia {

// How many tasks of some jobs are in which state.
struct SlurmTasks {
    std::size_t waiting = 0;
    std::size_t running = 0;         // or being started or ended
    std::size_t failed = 0;          // ended otherwise than well, as far as Slurm still remembers
    std::set<std::string> active{};  // the numbers of the jobs with tasks that wait or run

    bool is_over() const { return waiting + running == 0; }
};

// Throws Error if this machine has no Slurm.
void require_slurm();

// Runs a script that submits jobs, and returns their numbers. Throws Error if sbatch refuses a job: its own message stands
// on stderr.
std::vector<std::string> submit_to_slurm(const std::string& script);

// The jobs of a name. Throws Error if squeue does not answer.
//   counted   the jobs whose failures are counted; empty: none
SlurmTasks ask_slurm(const std::string& job_name, const std::set<std::string>& counted);

// The same from the text that squeue prints, a task a line: "JOB STATE".
SlurmTasks read_squeue(const std::string& text, const std::set<std::string>& counted);

}  // namespace chironomia
