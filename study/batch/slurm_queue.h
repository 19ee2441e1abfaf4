// What Slurm's own programs answer: submitting a script, and which jobs of a name there are.
#pragma once

#include <cstddef>
#include <set>
#include <string>
#include <utility>
#include <vector>

namespace chironomia::study {

// How many tasks of some jobs are in which state.
struct SlurmTasks {
    std::size_t waiting = 0;
    std::size_t running = 0;         // or being started or ended
    std::set<std::string> active{};  // the numbers of the jobs with tasks that wait or run
    std::set<std::string> going{};   // the tasks that wait or run
    // those that ended otherwise than well, which Slurm forgets after some minutes
    std::set<std::string> failed{};

    bool is_over() const { return waiting + running == 0; }
};

// Throws Error if this machine has no Slurm.
void require_slurm();

// Runs a script that submits jobs, and returns their numbers. Throws Error if sbatch refuses a job: its own message
// stands on stderr.
std::vector<std::string> submit_to_slurm(const std::string& script);

// The jobs of a name. Throws Error if squeue does not answer.
SlurmTasks ask_slurm(const std::string& job_name);

// The same from the text that squeue prints, a task a line: "JOB TASK STATE", as "7 7_2 RUNNING".
SlurmTasks read_squeue(const std::string& text);

// The tasks of `jobs` that have failed, over all that squeue has said so far. One that Slurm starts again has not.
class FailedTasks {
  public:
    explicit FailedTasks(std::set<std::string> jobs) : jobs_(std::move(jobs)) {}

    void add(const SlurmTasks& tasks);
    std::size_t count() const { return failed_.size(); }

  private:
    std::set<std::string> jobs_, failed_;
};

}  // namespace chironomia::study
