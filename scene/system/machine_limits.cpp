// SPDX-License-Identifier: Apache-2.0
#include "scene/system/machine_limits.h"

#include <sched.h>
#include <sys/resource.h>
#include <unistd.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <fstream>
#include <iterator>
#include <sstream>
#include <string_view>
#include <thread>
#include <vector>

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

// Of "4", and of "4(x2),3" the first: this node's number is not told, and the first has the most.
std::uint64_t number_of(const char* variable) {
  const char* text = std::getenv(variable);
  return text ? std::strtoull(text, nullptr, 10) : 0;
}

bool is_slurm() { return number_of("SLURM_JOB_ID") > 0; }

// The first line that scontrol says, "" where it does not answer.
std::string said_by_slurm() {
  const char* const step = std::getenv("SLURM_STEP_ID");
  const std::string ask =
      "timeout 5 scontrol -o show " +
      (step ? "step " + std::to_string(number_of("SLURM_JOB_ID")) + "." + std::to_string(std::atoi(step))
            : "job " + std::to_string(number_of("SLURM_JOB_ID"))) +
      " 2>/dev/null";
  std::FILE* answer = ::popen(ask.c_str(), "r");
  if (!answer) return {};
  std::string text(1 << 14, '\0');
  if (!std::fgets(text.data(), static_cast<int>(text.size()), answer)) text.clear();
  ::pclose(answer);
  return text.c_str();
}

// glibc 2.36's get_nprocs, and so std::thread::hardware_concurrency, does not look at it.
double processors_by_affinity() {
  std::vector<cpu_set_t> sets(16);  // of 1024 processors each
  const std::size_t bytes = sets.size() * sizeof(cpu_set_t);
  if (::sched_getaffinity(0, bytes, sets.data()) == 0) return CPU_COUNT_S(bytes, sets.data());
  return std::thread::hardware_concurrency();
}

// Whole ones, by Slurm; 0: it says nothing.
std::uint64_t processors_by_slurm() {
  if (!is_slurm()) return 0;
  if (const std::uint64_t of_task = number_of("SLURM_CPUS_PER_TASK")) return of_task;
  const std::uint64_t of_node = number_of("SLURM_CPUS_ON_NODE");
  return of_node > 0 ? std::max<std::uint64_t>(1, of_node / processes_of_node()) : 0;
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

std::uint64_t memory_a_node(const std::string& said) {
  const std::size_t tres = said.rfind("TRES=");
  if (tres == said.npos) return 0;
  const std::string list = said.substr(tres, said.find(' ', tres) - tres);
  const auto number_after = [&](const char* key, const char** end) {
    const std::size_t at = list.find(key);
    return at == list.npos ? 0.0 : std::strtod(list.c_str() + at + std::strlen(key), const_cast<char**>(end));
  };
  const char *unit = "", *ignored = "";
  const double memory = number_after("mem=", &unit), nodes = number_after("node=", &ignored);
  constexpr std::string_view units = "KMGTP";
  const std::size_t power = units.find(*unit);
  const double bytes =
      std::ldexp(memory, power == units.npos || *unit == '\0' ? 20 : 10 * static_cast<int>(power + 1));
  return static_cast<std::uint64_t>(bytes / std::max(nodes, 1.0));
}

std::uint64_t slurm_memory() {
  constexpr std::uint64_t mib = 1 << 20;
  if (!is_slurm()) return 0;
  std::uint64_t least = 0;
  for (const std::uint64_t bytes : {number_of("SLURM_MEM_PER_NODE") * mib,
                                    number_of("SLURM_MEM_PER_CPU") * number_of("SLURM_CPUS_ON_NODE") * mib,
                                    memory_a_node(said_by_slurm())})
    if (bytes > 0 && (least == 0 || bytes < least)) least = bytes;
  return least;
}

std::uint64_t processes_of_node() {
  for (const char* variable : {"OMPI_COMM_WORLD_LOCAL_SIZE", "MPI_LOCALNRANKS", "SLURM_STEP_TASKS_PER_NODE"})
    if (const std::uint64_t processes = number_of(variable)) return processes;
  return 1;
}

std::uint64_t MemoryLimit::of_a_job() const { return is_machine ? 0 : bytes / processes_of_node(); }

std::uint64_t MemoryLimit::share(std::uint64_t processes) const {
  return (is_machine ? bytes / 4 * 3 : bytes / 10 * 9) / processes;
}

MemoryLimit memory_limit(std::uint64_t slurm_bytes) {
  MemoryLimit limit{static_cast<std::uint64_t>(::sysconf(_SC_PHYS_PAGES)) *
                        static_cast<std::uint64_t>(::sysconf(_SC_PAGESIZE)),
                    "the machine", true};
  if (own_limits().bytes < limit.bytes) limit = {own_limits().bytes, "the control group", false};
  if (slurm_bytes > 0 && slurm_bytes < limit.bytes) limit = {slurm_bytes, "Slurm", false};
  return limit;
}

MemoryLimit memory_limit() { return memory_limit(slurm_memory()); }

int processors_allowed() {
  double allowed = std::min(processors_by_affinity(), own_limits().processors);
  if (const std::uint64_t slurm = processors_by_slurm())
    allowed = std::min(allowed, static_cast<double>(slurm));
  return static_cast<int>(std::max(1.0, std::ceil(allowed)));
}

void allow_many_files() {
  rlimit files{};
  if (::getrlimit(RLIMIT_NOFILE, &files) != 0) return;
  files.rlim_cur = files.rlim_max;
  ::setrlimit(RLIMIT_NOFILE, &files);
}

int threads_for(int asked) {
  return asked > 0 ? std::min(asked, std::max(64, 4 * processors_allowed())) : processors_allowed();
}

}  // namespace vitrail
