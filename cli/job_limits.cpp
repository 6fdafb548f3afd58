// SPDX-License-Identifier: Apache-2.0
#include "cli/job_limits.h"

#include <algorithm>
#include <chrono>
#include <cstdlib>

#include "scene/say.h"

namespace vitrail {

namespace {

// Of "4", and of "4(x2),3" the first: this node's number is not told, and the first has the most.
std::uint64_t number(const char* variable) {
  const char* text = std::getenv(variable);
  return text ? std::strtoull(text, nullptr, 10) : 0;
}

std::uint64_t ranks_of_node() {
  for (const char* variable : {"OMPI_COMM_WORLD_LOCAL_SIZE", "SLURM_STEP_TASKS_PER_NODE"})
    if (const std::uint64_t ranks = number(variable)) return ranks;
  return 1;
}

std::uint64_t memory_of_node() {
  constexpr std::uint64_t mib = 1 << 20;
  if (const std::uint64_t node = number("SLURM_MEM_PER_NODE")) return node * mib;
  return number("SLURM_MEM_PER_CPU") * number("SLURM_CPUS_ON_NODE") * mib;
}

// A checkpoint is to be on the disk before the job is killed: a tenth of the time, a minute at most.
double time_left_s() {
  const std::uint64_t end = number("SLURM_JOB_END_TIME");
  if (end == 0) return 0;
  const double now =
      std::chrono::duration<double>(std::chrono::system_clock::now().time_since_epoch()).count();
  const double left = static_cast<double>(end) - now;
  return std::max(1.0, left - std::min(60.0, left / 10));
}

}  // namespace

void take_limits_of_job(RenderOptions& o, bool say_so) {
  if (number("SLURM_JOB_ID") == 0) return;
  constexpr double mib = 1 << 20;
  const std::uint64_t memory = memory_of_node() / ranks_of_node() / 10 * 9;
  if (memory > 0 && o.memory_bytes == 0) {
    o.memory_bytes = memory;
    if (say_so)
      say("vitrail: {:.0f} MiB a rank, as Slurm gives this job\n", static_cast<double>(memory) / mib);
  }
  if (const double time_s = time_left_s(); time_s > 0 && o.time_limit_s <= 0) {
    o.stop_after_s = time_s;
    if (say_so) say("vitrail: stops with a checkpoint after {:.0f} s, as Slurm ends this job then\n", time_s);
  }
}

}  // namespace vitrail
