// SPDX-License-Identifier: Apache-2.0
#include "farm/simulator/simulated_job.h"

namespace vitrail {

SimulationResult simulate(const Workload& workload, const Machine& machine, const Mishaps& mishaps,
                          std::uint64_t seed) {
  return SimulatedJob<Scheduler>(workload, machine, mishaps, seed).run();
}

}  // namespace vitrail
