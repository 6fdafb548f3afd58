// SPDX-License-Identifier: Apache-2.0
#include "scene/system/machine_limits.h"

#include <unistd.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <fstream>
#include <iterator>
#include <sstream>
#include <thread>

namespace vitrail {

namespace {

namespace fs = std::filesystem;

std::string text_of(const fs::path& file) {
  std::ifstream in(file);
  return {std::istreambuf_iterator<char>(in), {}};
}

// The first numbers of a file; "max" and what is not there is `otherwise`.
double number_in(std::istream& in, double otherwise) {
  double value = 0;
  return in >> value && value >= 0 ? value : otherwise;
}
double number_in(const fs::path& file, double otherwise) {
  std::ifstream in(file);
  return number_in(in, otherwise);
}

void limit_bytes(ControlGroupLimits& limits, const fs::path& file) {
  constexpr double nothing = 0x1p60;  // version 1 says a number about 2⁶³ where there is no limit
  const double bytes = number_in(file, nothing);
  if (bytes < nothing) limits.bytes = std::min(limits.bytes, static_cast<std::uint64_t>(bytes));
}

void limit_processors(ControlGroupLimits& limits, double quota, double period) {
  if (quota > 0 && period > 0) limits.processors = std::min(limits.processors, quota / period);
}

// A group's own limits; the file system of a controller that it has not knows no such file.
void take(ControlGroupLimits& limits, const fs::path& group) {
  limit_bytes(limits, group / "memory.max");             // version 2
  limit_bytes(limits, group / "memory.limit_in_bytes");  // version 1
  std::istringstream max(text_of(group / "cpu.max"));
  const double quota = number_in(max, -1);
  limit_processors(limits, quota, number_in(max, -1));
  limit_processors(limits, number_in(group / "cpu.cfs_quota_us", -1),
                   number_in(group / "cpu.cfs_period_us", -1));
}

std::uint64_t number_of(const char* variable) {
  const char* text = std::getenv(variable);
  return text ? std::strtoull(text, nullptr, 10) : 0;
}

std::uint64_t bytes_by_slurm() {
  constexpr std::uint64_t mib = 1 << 20;
  if (number_of("SLURM_JOB_ID") == 0) return 0;
  if (const std::uint64_t node = number_of("SLURM_MEM_PER_NODE")) return node * mib;
  return number_of("SLURM_MEM_PER_CPU") * number_of("SLURM_CPUS_ON_NODE") * mib;
}

const ControlGroupLimits& own_limits() {
  static const ControlGroupLimits limits =
      control_group_limits(text_of("/proc/self/cgroup"), "/sys/fs/cgroup");
  return limits;
}

}  // namespace

// A line is "number:controllers:path", of version 2 "0::path". In a container the path may be the host's:
// then only the top is seen, which is the container's.
ControlGroupLimits control_group_limits(const std::string& own, const fs::path& mounts) {
  ControlGroupLimits limits;
  std::istringstream lines(own);
  for (std::string line; std::getline(lines, line);) {
    const std::size_t first = line.find(':'), second = line.find(':', first + 1);
    if (first == line.npos || second == line.npos) continue;
    const std::string controllers = line.substr(first + 1, second - first - 1);
    const fs::path path = fs::path(line.substr(second + 1)).relative_path();
    for (const fs::path& mount : {mounts / controllers, mounts / "unified"})
      for (fs::path group = path;; group = group.parent_path()) {
        take(limits, mount / group);
        if (group.empty()) break;
      }
  }
  return limits;
}

MemoryLimit memory_limit() {
  MemoryLimit limit{static_cast<std::uint64_t>(::sysconf(_SC_PHYS_PAGES)) *
                        static_cast<std::uint64_t>(::sysconf(_SC_PAGESIZE)),
                    "the machine", true};
  if (own_limits().bytes < limit.bytes) limit = {own_limits().bytes, "the control group", false};
  if (const std::uint64_t slurm = bytes_by_slurm(); slurm > 0 && slurm < limit.bytes)
    limit = {slurm, "Slurm", false};
  return limit;
}

int processors_allowed() {
  const double by_affinity = std::max(1.0, static_cast<double>(std::thread::hardware_concurrency()));
  return static_cast<int>(std::max(1.0, std::ceil(std::min(by_affinity, own_limits().processors))));
}

int threads_for(int asked) {
  return asked > 0 ? std::min(asked, std::max(64, 4 * processors_allowed())) : processors_allowed();
}

}  // namespace vitrail
