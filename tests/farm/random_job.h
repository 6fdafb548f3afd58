// SPDX-License-Identifier: Apache-2.0
// Jobs of the simulator that a seed decides.
#pragma once

#include <algorithm>
#include <random>
#include <vector>

#include "farm/simulator/simulated_job.h"

namespace vitrail {

// A cluster, a picture and what goes wrong, all of one seed.
struct RandomJob {
  Workload workload;
  Machine machine;
  Mishaps mishaps;

  // Mostly few ranks, one in a hundred up to 1000.
  explicit RandomJob(std::uint64_t seed) {
    std::mt19937_64 random(seed);
    const auto among = [&](std::uint64_t n) { return random() % n; };
    const std::uint64_t most_ranks = among(4) > 0 ? 4 : among(25) > 0 ? 40 : 1000;
    machine.ranks = 1 + static_cast<int>(among(most_ranks));
    machine.workers = 1 + static_cast<int>(among(4));
    const auto domains = static_cast<std::uint32_t>(1 + among(among(2) == 0 ? 4 : among(8) == 0 ? 300 : 48));
    workload = random_workload(random, domains, among(60), static_cast<std::uint32_t>(1 + among(2000)));
    const std::uint64_t all = bytes_of_all(workload.manifest);
    std::uint64_t largest = 0;
    for (std::uint32_t d = 0; d < domains; ++d)
      largest = std::max(largest, bytes_needed(workload.manifest, d));
    machine.domain_bytes = std::max(largest, all >> among(6));
    machine.rays_allowed = static_cast<std::int64_t>(1 + among(50'000));
    if (among(2) == 0) machine.queue_bytes = machine.bytes_a_ray * among(5000);
    machine.loaders = 1 + static_cast<int>(among(loaders_of_a_rank));
    machine.jitter = among(2) == 0 ? 0 : static_cast<double>(among(100));
    machine.latency_s = 1e-6 * static_cast<double>(1 + among(1000));
    machine.disk_latency_s = 1e-5 * static_cast<double>(1 + among(1000));
    machine.ranks_of_a_disk =
        1 + static_cast<int>(among(2) * among(static_cast<std::uint64_t>(machine.ranks)));
    machine.ranks_of_a_link =
        1 + static_cast<int>(among(2) * among(static_cast<std::uint64_t>(machine.ranks)));
    if (among(4) == 0) machine.network_bytes_s = 1e6;
    if (among(4) == 0) machine.files_s = static_cast<double>(1 + among(10'000));
    mishaps.checkpoints = among(3) == 0 ? static_cast<int>(among(4)) : 0;
    mishaps.checkpoint_mean_s = .01;
    mishaps.rounds_of_samples = 1 + static_cast<int>(among(3));
    mishaps.slow_rank = among(4) == 0 ? 20 : 1;
    machine.patience_s = 2;
    if (among(4) == 0)
      for (std::uint64_t silences = 1 + among(3); silences > 0; --silences) add_silence(random);
    machine.scratch_bytes_s = among(2) == 0 ? 1e9 : 1e6;
    if (among(10) == 0)
      mishaps.disk_error = {static_cast<int>(among(static_cast<std::uint64_t>(machine.ranks))),
                            1e-4 * static_cast<double>(among(1000))};
    constexpr Distribution distributions[] = {Distribution::automatic, Distribution::automatic,
                                              Distribution::decompose, Distribution::replicate};
    machine.distribution = distributions[among(4)];
    if (among(2) == 0) {
      std::vector<double> seconds(domains);
      for (double& s : seconds) s = static_cast<double>(among(1000));
      seconds[among(domains)] *= 100;
      machine.homes = homes_by_work(
          workload.manifest,
          RayProfile(workload.manifest, std::vector<std::uint64_t>(domains), seconds, {}, {}), machine.ranks);
    }
    mishaps.in_two_parts = among(2) == 0;
    if (among(10) == 0) mishaps.lost_message = among(30);
  }

  // Dead, or silent for a moment up to half again the patience.
  void add_silence(std::mt19937_64& random) {
    const auto seconds = [&](double most) { return most * static_cast<double>(random() >> 11) * 0x1p-53; };
    Silence s;
    s.rank = static_cast<int>(random() % static_cast<std::uint64_t>(machine.ranks));
    s.from_s = seconds(.05);
    if (random() % 2 == 0) s.to_s = s.from_s + seconds(1.5 * machine.patience_s);
    for (const Silence& other : mishaps.silences)
      if (other.rank == s.rank) return;
    // One is left that misses the others.
    if (mishaps.silences.size() + 1 < static_cast<std::size_t>(machine.ranks)) mishaps.silences.push_back(s);
  }
};

// A job that ended because of silent ranks, or a disk, goes on from its last checkpoint without them.
template <class SchedulerType, class WatchType = Watch, class SpillType = Spill,
          class ReceiveType = ReceivesBeside>
SimulationResult run(RandomJob c, std::uint64_t seed) {
  for (;;) {
    const auto result =
        SimulatedJob<SchedulerType, WatchType, SpillType, ReceiveType>(c.workload, c.machine, c.mishaps, seed)
            .run();
    if (result.silent.empty() && !result.failed && !result.stalled) return result;
    c.mishaps.kept = result.kept;
    c.mishaps.silences.clear();
    c.mishaps.lost_message.reset();
    if (result.failed) c.mishaps.disk_error = {};
  }
}

}  // namespace vitrail
