// SPDX-License-Identifier: Apache-2.0
#include "cli/render/job_limits.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <chrono>
#include <cstdio>
#include <cstdlib>
#include <string>

#include "farm/transport/agreement.h"
#include "scene/system/machine_limits.h"
#include "scene/system/say.h"

namespace vitrail {

namespace {

std::uint64_t number(const char* variable) {
  const char* text = std::getenv(variable);
  return text ? std::strtoull(text, nullptr, 10) : 0;
}

// Rank 0 alone asks Slurm. `is_told`: by rank 0.
void take_memory(Transport& transport, RenderOptions& o, bool is_told) {
  std::uint64_t by_slurm[] = {0};
  agree_on_root(transport, [&] { by_slurm[0] = o.resources.memory_bytes > 0 ? 0 : slurm_memory(); });
  transport.broadcast_from_root(by_slurm);
  if (o.resources.memory_bytes > 0) return;
  const MemoryLimit limit = memory_limit(by_slurm[0]);
  o.resources.job_bytes = limit.of_a_job();
  o.resources.memory_bytes = limit.share(processes_of_node());
  if (is_told && !limit.is_machine)
    say("vitrail: {:.0f} MiB a rank, as {} gives this job\n",
        static_cast<double>(o.resources.memory_bytes) / (1 << 20), limit.giver);
}

// What squeue calls the time left: [[days-]hours:]minutes:seconds. 0 for words such as UNLIMITED.
double parse_duration_s(const std::string& text) {
  double s = 0, part = 0;
  for (const char c : text) {
    if (c >= '0' && c <= '9')
      part = part * 10 + (c - '0');
    else if (c == '-')
      s = part * 24, part = 0;  // days, in hours
    else if (c == ':')
      s = (s + part) * 60, part = 0;
    else if (c != '\n')
      return 0;
  }
  return s + part;
}

// Newer Slurms say when the job ends, older ones have to be asked.
double time_left_s() {
  if (const std::uint64_t end = number("SLURM_JOB_END_TIME")) {
    const auto now = std::chrono::system_clock::now().time_since_epoch();
    return std::max(1.0, static_cast<double>(end) - std::chrono::duration<double>(now).count());
  }
  const std::string ask = fmt::format("timeout 5 squeue -h -o %L -j {} 2>/dev/null", number("SLURM_JOB_ID"));
  std::FILE* answer = ::popen(ask.c_str(), "r");
  if (!answer) return 0;
  std::array<char, 64> text{};
  const bool answered = std::fgets(text.data(), text.size(), answer) != nullptr;
  ::pclose(answer);
  return answered ? parse_duration_s(text.data()) : 0;
}

// A checkpoint is to be on the disk before the job is killed: a tenth of the time for it, a minute at most.
double time_to_work_s(double left_s) { return std::max(1.0, left_s - std::min(60.0, left_s / 10)); }

}  // namespace

void take_limits_of_job(Transport& transport, RenderOptions& o) {
  const bool rank_0 = transport.rank() == 0, say_so = rank_0 && !o.outputs.quiet;
  take_memory(transport, o, say_so);
  if (number("SLURM_JOB_ID") == 0) return;
  if (!rank_0 || o.resources.time_limit_s > 0) return;
  if (const double left_s = time_left_s(); left_s > 0) {
    o.resources.stop_after_s = time_to_work_s(left_s);
    if (say_so)
      say("vitrail: stops with a checkpoint after {:.0f} s, as Slurm ends this job then\n",
          o.resources.stop_after_s);
  }
}

}  // namespace vitrail
