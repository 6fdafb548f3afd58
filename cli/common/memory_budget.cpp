// SPDX-License-Identifier: Apache-2.0
#include "cli/common/memory_budget.h"

#include "cli/common/sizes.h"
#include "scene/system/machine_limits.h"
#include "scene/system/say.h"

namespace vitrail {

void declare_memory(CLI::App& app, std::string& memory) {
  app.add_option("--memory", memory,
                 "most memory to use, e.g. 512M; default: what Slurm, a control group or the machine gives");
}

std::uint64_t memory_budget(const std::string& asked, bool quiet) {
  if (!asked.empty()) return parse_bytes(asked);
  const MemoryLimit limit = memory_limit();
  const std::uint64_t bytes = limit.share();
  if (!limit.is_machine && !quiet)
    say("vitrail: {:.0f} MiB of memory, as {} gives this job\n", static_cast<double>(bytes) / (1 << 20),
        limit.giver);
  return bytes;
}

}  // namespace vitrail
