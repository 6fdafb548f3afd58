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
      out_(static_cast<std::size_t>((machine.ranks - 1) / machine.ranks_of_a_link + 1)),
      in_(out_.size()) {}

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
  files_until_s_ = std::max(files_until_s_, now_s_) + slow * files / costs_.files_s;
  double& until_s = disks_[static_cast<std::size_t>(rank / costs_.ranks_of_a_disk)];
  until_s = std::max(until_s, files_until_s_ + slow * files * costs_.disk_latency_s) +
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

double SimulatedMachine::arrival_s(int from, int to, std::uint64_t rays) {
  const double latency = latency_s();
  Way& out = out_[static_cast<std::size_t>(from / costs_.ranks_of_a_link)];
  Way& in = in_[static_cast<std::size_t>(to / costs_.ranks_of_a_link)];
  if (&out - out_.data() == &in - in_.data()) return now_s_ + latency;
  const double takes_s = static_cast<double>(rays * costs_.bytes_a_ray) / costs_.network_bytes_s;
  out.until_s = std::max(out.until_s, now_s_) + takes_s;
  // Its first byte comes while its last one waits to be sent.
  in.until_s = std::max(in.until_s + takes_s, out.until_s + latency);
  out.busy_s += takes_s;
  in.busy_s += takes_s;
  return in.until_s;
}

double SimulatedMachine::busiest_link_s() const {
  double most = 0;
  for (const auto* ways : {&out_, &in_})
    for (const Way& way : *ways) most = std::max(most, way.busy_s);
  return most;
}

double SimulatedMachine::reduction_s() const {
  const double steps = std::bit_width(static_cast<unsigned>(costs_.ranks) - 1);
  const double bytes_s = std::min(costs_.network_bytes_s, costs_.reduction_bytes_s);
  return steps * (costs_.latency_s + costs_.film_bytes / bytes_s);
}

double SimulatedMachine::write_and_read_s(std::uint64_t rays) const {
  return 2 * static_cast<double>(rays * costs_.bytes_a_ray) / costs_.scratch_bytes_s;
}

}  // namespace vitrail
