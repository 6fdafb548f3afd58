// SPDX-License-Identifier: Apache-2.0
// These functions check that nothing happens in a simulated job that never may. All of them throw
// InvariantBroken where it did, without saying when: the job knows.
#pragma once

#include <cstdint>
#include <map>
#include <string>

#include "farm/simulator/simulated_machine.h"
#include "farm/simulator/simulated_memory.h"

namespace vitrail::invariant {

[[noreturn]] void broken(const std::string& what);

// --- Of one rank.
// The rank counts the bytes that it holds, and these are within its budget; so are those of its rays.
void check_bytes(int rank, const SimulatedMemory& memory, std::uint64_t rays_bytes,
                 const Residency& residency, const Machine& machine);
// Each object that a load needs and does not bring is in memory, and not on its way. A domain that leaves for
// the load may have it.
void check_load(int rank, const SimulatedMemory& memory, const LoadStep::Load& load,
                const Manifest& manifest);
// The rank counts the bytes of its table.
void check_table(int rank, const SimulatedMemory& memory, const Residency& residency);
// The rank counts the rays that wait for a domain.
void check_queue(int rank, std::uint32_t domain, std::uint64_t rays, const Residency& residency);
// A rank that is given up did not answer for long enough, and was not waited for longer than promised.
void check_silent(int rank, const Silence& silence, const Mishaps& mishaps, const SimulatedMachine& machine);

// --- Of the job.
// Exactly these camera rays belong to the work from `before` to `now`.
void check_generated(std::uint64_t rays, const KeptWork& before, const KeptWork& now,
                     const Workload& workload);
// All ranks came to one conclusion in every round, or none did.
void check_agreement(const std::map<std::uint64_t, std::size_t>& ranks_by_round, std::size_t ranks,
                     const char* conclusion);

}  // namespace vitrail::invariant
