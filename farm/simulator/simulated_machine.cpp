// SPDX-License-Identifier: Apache-2.0
#include "farm/simulator/simulated_machine.h"

#include <algorithm>
#include <bit>
#include <cmath>

#include "farm/scheduler/nap.h"

namespace vitrail {

SimulatedMachine::SimulatedMachine(const Machine& machine, std::uint64_t seed)
    : costs_(machine),
      random_(seed),
      disks_(static_cast<std::size_t>((machine.ranks - 1) / machine.ranks_of_a_disk + 1)),
      links_(static_cast<std::size_t>(machine.ranks)) {}

double SimulatedMachine::uniform() { return static_cast<double>(random_() >> 11) * 0x1p-53; }

int SimulatedMachine::pick_rank() {
  return static_cast<int>(random_() % static_cast<std::uint64_t>(costs_.ranks));
}

double SimulatedMachine::late() { return 1 + costs_.jitter * uniform(); }

std::uint64_t SimulatedMachine::rounded(double number) {
  const double whole = std::floor(number);
  return static_cast<std::uint64_t>(whole) + (uniform() < number - whole);
}

double SimulatedMachine::read(int rank, double files, std::uint64_t bytes) {
  const double slow = late();
  double& until_s = disks_[static_cast<std::size_t>(rank / costs_.ranks_of_a_disk)];
  until_s = std::max(until_s, now_s_ + slow * files * costs_.disk_latency_s) +
            slow * static_cast<double>(bytes) / costs_.disk_bytes_s;
  return until_s;
}

double SimulatedMachine::next_look_s(double moved_s) const {
  Nap nap;
  double at_s = moved_s;
  do at_s += std::chrono::duration<double>(nap.take()).count() + costs_.wake_s;
  while (at_s < now_s_);
  return at_s;
}

// Up a tree of ranks and down; each looks a nap later.
double SimulatedMachine::round_s() {
  const double steps = std::bit_width(static_cast<unsigned>(costs_.ranks) - 1);
  return (latency_s() + std::chrono::duration<double>(Nap::shortest).count() + costs_.wake_s) * steps;
}

double SimulatedMachine::sending_s(std::uint64_t rays) const {
  return static_cast<double>(rays * costs_.bytes_a_ray) / costs_.network_bytes_s;
}

double SimulatedMachine::send(int rank, std::uint64_t rays) {
  double& until_s = links_[static_cast<std::size_t>(rank)];
  return until_s = std::max(until_s, now_s_) + sending_s(rays);
}

double SimulatedMachine::write_and_read_s(std::uint64_t rays) const {
  return 2 * static_cast<double>(rays * costs_.bytes_a_ray) / costs_.scratch_bytes_s;
}

}  // namespace vitrail
