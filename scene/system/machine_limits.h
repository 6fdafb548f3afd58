// SPDX-License-Identifier: Apache-2.0
// These functions find which part of the machine this process may have: a job of Slurm, a container or a
// control group has less than all.
#pragma once

#include <cstdint>
#include <filesystem>
#include <limits>
#include <string>

namespace vitrail {

// It is the memory of this machine that a job may have.
struct MemoryLimit {
  std::uint64_t bytes = 0;  // of all processes of this job on this machine together
  const char* giver = "";   // "Slurm", "the control group" or "the machine"
  bool is_machine = false;
  // Returns what one of so many processes takes where the user gives no other: nine tenths, for MPI and the
  // system take some; of the machine, which others use too, three quarters.
  std::uint64_t share(std::uint64_t processes = 1) const;
  // Returns what each process of this job may take at most, beyond which the system ends it; 0 where the job
  // has all of the machine.
  std::uint64_t of_a_job() const;
};

// Returns the least of what Slurm gave the job (slurm_memory), the control groups around this process allow
// (versions 1 and 2) and the machine has. The second is for ranks that were told what Slurm gave; 0: nothing.
MemoryLimit memory_limit();
MemoryLimit memory_limit(std::uint64_t slurm_bytes);

// Returns the bytes that Slurm gave this step, or this job, on one of its nodes; 0 where it says nothing. It
// asks scontrol, for srun leaves its --mem in no variable: on one rank alone. It is the least of the answer,
// SLURM_MEM_PER_NODE, and SLURM_MEM_PER_CPU times SLURM_CPUS_ON_NODE, which are in MiB.
std::uint64_t slurm_memory();
// Returns the bytes a node, read from scontrol's words of a job or step in one line:
// TRES=cpu=2,mem=200M,node=1.
std::uint64_t memory_a_node(const std::string& said);

// Returns how many processes of this job are on this machine, as mpirun and srun say; 1 where they do not.
std::uint64_t processes_of_node();

// Returns the least of affinity, the control groups' quota, of which a part of a processor counts as one, and
// what Slurm gave this task (SLURM_CPUS_PER_TASK, or its part of SLURM_CPUS_ON_NODE); at least 1.
int processors_allowed();

// Returns the threads that are asked for, at most 64 or four a processor: more would only take memory. For 0
// it returns one for each processor that is allowed.
int threads_for(int asked);

// Lets this process open as many files and sockets as it may. The usual limit, 1024, is for programs of
// select(); films to merge are that many, and so are the ranks that one speaks with over TCP.
void allow_many_files();

// These are the limits that the control groups of a process set, infinite where they say nothing. `own` is
// the text of its /proc/self/cgroup; `mounts` is where they are mounted, /sys/fs/cgroup.
struct ControlGroupLimits {
  std::uint64_t bytes = std::numeric_limits<std::uint64_t>::max();
  double processors = std::numeric_limits<double>::infinity();
};
ControlGroupLimits control_group_limits(const std::string& own, const std::filesystem::path& mounts);

}  // namespace vitrail
