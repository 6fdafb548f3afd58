// SPDX-License-Identifier: Apache-2.0
// What of the machine this process may have: a job of Slurm, a container or a control group has less than
// all.
#pragma once

#include <cstdint>
#include <filesystem>
#include <limits>
#include <string>

namespace vitrail {

// The least of what Slurm gave the job (SLURM_MEM_PER_NODE, or SLURM_MEM_PER_CPU times SLURM_CPUS_ON_NODE,
// MiB), the control groups around this process allow (versions 1 and 2) and the machine has.
struct MemoryLimit {
  std::uint64_t bytes = 0;  // of all processes of this job on this machine together
  const char* giver = "";   // "Slurm", "the control group" or "the machine"
  bool is_machine = false;
};
MemoryLimit memory_limit();

// By affinity and by the control groups' quota, of which a part of a processor counts as one; at least 1.
int processors_allowed();

// Returns the threads that are asked for, at most 64 or four a processor: more would only take memory. For 0
// it returns one for each processor that is allowed.
int threads_for(int asked);

// What the control groups of a process allow. `own`: the text of its /proc/self/cgroup; `mounts`: where they
// are mounted, /sys/fs/cgroup. Infinite where they say nothing.
struct ControlGroupLimits {
  std::uint64_t bytes = std::numeric_limits<std::uint64_t>::max();
  double processors = std::numeric_limits<double>::infinity();
};
ControlGroupLimits control_group_limits(const std::string& own, const std::filesystem::path& mounts);

}  // namespace vitrail
