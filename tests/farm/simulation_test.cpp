// SPDX-License-Identifier: Apache-2.0
// Hundreds of jobs under a simulated clock. VITRAIL_SIMULATIONS=N runs N of them; a seed that fails is
// printed, and VITRAIL_SIMULATION_SEED runs that one alone.
#include <gtest/gtest.h>

#include <cstdlib>
#include <set>
#include <string>

#include "tests/farm/random_job.h"
#include "tests/support/long_tests.h"

namespace vitrail::simulation_test {
namespace {

std::uint64_t from_environment(const char* name, std::uint64_t otherwise) {
  const char* text = std::getenv(name);
  return text ? std::strtoull(text, nullptr, 10) : otherwise;
}

TEST(Simulation, NothingIsLostAndEveryJobEnds) {
  const std::uint64_t only = from_environment("VITRAIL_SIMULATION_SEED", 0);
  const std::uint64_t first = only > 0 ? only : 1,
                      jobs = only > 0 ? 1 : from_environment("VITRAIL_SIMULATIONS", test::of_all(600u, 200u));
  std::uint64_t events = 0;
  for (std::uint64_t seed = first; seed < first + jobs; ++seed) {
    const RandomJob c(seed);
    try {
      const SimulationResult result = run<Scheduler>(c, seed);
      events += result.events;
      // Rays that hits bear come on top, and a round is a little behind.
      const auto allowed =
          static_cast<double>(std::max<std::int64_t>(c.machine.rays_allowed, c.machine.ranks));
      EXPECT_LE(static_cast<double>(result.most_alive), 1.25 * allowed + 32)
          << "VITRAIL_SIMULATION_SEED=" << seed;
    } catch (const InvariantBroken& e) {
      ADD_FAILURE() << "VITRAIL_SIMULATION_SEED=" << seed << ": " << e.what();
      break;
    }
  }
  std::printf("%.3g events\n", static_cast<double>(events));
}

// A job five times as long has more of the same middle.
TEST(Simulation, ReckonsTheMiddleOfALongJob) {
  std::mt19937_64 random(1);
  Machine machine;
  machine.ranks = 6;
  machine.workers = 2;
  machine.rays_allowed = 60'000;
  machine.distribution = Distribution::decompose;
  Workload workload = random_workload(random, 24, 1500, 2000);
  for (const std::uint64_t share : {1, 3}) {
    machine.domain_bytes = bytes_of_all(workload.manifest) / share;
    workload.items = 3000;
    workload.middle_again = 0;
    const SimulationResult all = simulate(workload, machine, {}, 1);
    workload.items = 600;
    workload.middle_again = 12;
    const SimulationResult reckoned = simulate(workload, machine, {}, 1);
    EXPECT_LT(reckoned.events, all.events / 3);
    const auto near = [](double x, double y) { EXPECT_NEAR(x / y, 1, .03); };
    near(reckoned.seconds, all.seconds);
    near(reckoned.efficiency, all.efficiency);
    near(reckoned.busiest_workers, all.busiest_workers);
    near(static_cast<double>(reckoned.rays), static_cast<double>(all.rays));
    near(static_cast<double>(reckoned.forwarded_rays), static_cast<double>(all.forwarded_rays));
    EXPECT_NEAR(static_cast<double>(reckoned.loads), static_cast<double>(all.loads),
                .1 * static_cast<double>(all.loads));
  }
}

// Files that several ranks want from one disk come one after the other; where each has its own, at once.
TEST(Simulation, RanksWaitForTheirDisk) {
  std::mt19937_64 random(1);
  Machine machine;
  machine.ranks = 4;
  machine.rays_allowed = 1'000'000;
  machine.distribution = Distribution::replicate;
  machine.disk_bytes_s = 1e6;
  const Workload workload = random_workload(random, 8, 40, 100);
  machine.domain_bytes = bytes_of_all(workload.manifest);
  const double own_s = simulate(workload, machine, {}, 1).seconds;
  machine.ranks_of_a_disk = 2;
  EXPECT_NEAR(simulate(workload, machine, {}, 1).seconds / own_s, 2, .1);
  machine.ranks_of_a_disk = 4;
  EXPECT_NEAR(simulate(workload, machine, {}, 1).seconds / own_s, 4, .2);
}

// 10⁵ rays of the camera that end where they come to, with nothing but the network to wait for.
SimulationResult sent(int ranks, std::uint32_t domains, int ranks_of_a_link) {
  Workload workload;
  workload.manifest.domains.resize(domains);
  for (DomainInfo& d : workload.manifest.domains) d.bytes = 1000;
  workload.domains.assign(domains, {1e-9, {}});
  for (std::uint32_t d = 0; d < domains; ++d) workload.camera.ways.push_back({d, 1.0 / domains});
  workload.items = 1000;
  workload.rays_an_item = 100;
  Machine machine;
  machine.ranks = ranks;
  machine.rays_allowed = 1'000'000;
  machine.distribution = Distribution::decompose;
  machine.domain_bytes = bytes_of_all(workload.manifest);
  machine.ray_handling_s = 0;
  machine.network_bytes_s = 1e6;
  machine.ranks_of_a_link = ranks_of_a_link;
  return simulate(workload, machine, {}, 1);
}

// All rays go to one rank, which receives those of three others one after the other.
TEST(Simulation, ManySendersWaitForOneReceiver) {
  const SimulationResult all = sent(4, 1, 1);
  const double expected_s = .75 * 1e5 * 48 / 1e6;
  EXPECT_NEAR(all.seconds, expected_s, .02 * expected_s);
  EXPECT_GT(all.busiest_link, .95);
}

// Of four ranks each sends three quarters of its rays. Two of a node send half of theirs over one link.
TEST(Simulation, RanksOfANodeShareALink) {
  const auto busy_s = [](const SimulationResult& r) { return r.busiest_link * r.seconds; };
  EXPECT_NEAR(busy_s(sent(4, 4, 1)), .75 / 4 * 1e5 * 48 / 1e6, .02);
  EXPECT_NEAR(busy_s(sent(4, 4, 2)), .5 / 2 * 1e5 * 48 / 1e6, .02);
  EXPECT_LT(sent(4, 4, 4).seconds, .1 * sent(4, 4, 1).seconds) << "nothing leaves the node";
}

// Four ranks open all files, at one server.
TEST(Simulation, RanksWaitForTheServerOfFiles) {
  std::mt19937_64 random(1);
  Machine machine;
  machine.ranks = 4;
  machine.rays_allowed = 1'000'000;
  machine.distribution = Distribution::replicate;
  const Workload workload = random_workload(random, 8, 40, 100);
  machine.domain_bytes = bytes_of_all(workload.manifest);
  machine.files_s = 10;
  const double files = 4. * static_cast<double>(8 + workload.manifest.objects.size());
  const double expected_s = files / machine.files_s;
  EXPECT_NEAR(simulate(workload, machine, {}, 1).seconds, expected_s, .1 * expected_s);
}

// A pack is opened once on each rank, however many of its domains are read.
TEST(Simulation, PacksAreOpenedOnce) {
  std::mt19937_64 random(1);
  Machine machine;
  machine.ranks = 4;
  machine.rays_allowed = 1'000'000;
  machine.distribution = Distribution::replicate;
  Workload workload = random_workload(random, 8, 40, 100);
  std::set<std::uint32_t> objects;  // that domains need
  for (std::uint32_t i = 0; i < 8; ++i) {
    DomainInfo& d = workload.manifest.domains[i];
    d.pack = PackPlace{i / 4, 0};
    objects.insert(d.objects.begin(), d.objects.end());
  }
  machine.domain_bytes = bytes_of_all(workload.manifest);
  machine.files_s = 1;
  const double expected_s = 4. * static_cast<double>(2 + objects.size()) / machine.files_s;
  EXPECT_NEAR(simulate(workload, machine, {}, 1).seconds, expected_s, .01 * expected_s);
}

// The same job, begun later, and ended when the films are one.
TEST(Simulation, CountsTheBeginningAndTheEnd) {
  std::mt19937_64 random(1);
  Machine machine;
  machine.ranks = 8;
  machine.rays_allowed = 100'000;
  const Workload workload = random_workload(random, 8, 400, 100);
  machine.domain_bytes = bytes_of_all(workload.manifest);
  const double between_s = simulate(workload, machine, {}, 1).seconds;
  machine.setup_s = 2;
  machine.film_bytes = machine.reduction_bytes_s;
  EXPECT_NEAR(simulate(workload, machine, {}, 1).seconds, between_s + 2 + 3, 1e-3) << "a tree of three steps";
  machine.reduction_bytes_s = 2 * machine.network_bytes_s;
  machine.film_bytes = machine.network_bytes_s;
  EXPECT_NEAR(simulate(workload, machine, {}, 1).seconds, between_s + 2 + 3, 1e-3) << "the link is slower";
}

// Rays leave some thousand at a time, or when a worker has nothing to do: not after each task. What came
// since a rank looked is taken together.
TEST(Simulation, SendsManyRaysAtATime) {
  std::mt19937_64 random(1);
  Machine machine;
  machine.ranks = 2;
  machine.rays_allowed = 400'000;
  machine.distribution = Distribution::decompose;
  Workload workload = random_workload(random, 2, 2000, 400);
  for (Workload::Domain& d : workload.domains) d = {1e-7, {{0, .45}, {1, .45}}};  // both ranks have work
  workload.camera.ways = {{0, .5}, {1, .5}};
  machine.domain_bytes = bytes_of_all(workload.manifest);
  const SimulationResult quick = simulate(workload, machine, {}, 1);
  EXPECT_GT(quick.forwarded_rays, 2000 * quick.messages);
  machine.wake_s = 5e-3;
  EXPECT_LT(simulate(workload, machine, {}, 1).messages, quick.messages);
}

// A ray that waits for a domain is packed and unpacked. Where all domains are at hand rays cost less, as they
// take all at once.
TEST(Simulation, TracingCostsLessWithAllDomainsAtHand) {
  std::mt19937_64 random(1);
  Machine machine;
  machine.rays_allowed = 100'000;
  machine.ray_handling_s = 0;
  Workload workload = random_workload(random, 16, 200, 1000);
  machine.domain_bytes = bytes_of_all(workload.manifest);
  const double tasks_s = 1e-6 * 2000;
  const auto busy_s = [&] { return simulate(workload, machine, {}, 1).busy_s; };
  const double walking_s = busy_s();
  workload.at_hand = .5;
  EXPECT_NEAR(busy_s() / walking_s, .5, .05);
  machine.ranks = 2;
  machine.distribution = Distribution::decompose;
  EXPECT_NEAR(busy_s() / walking_s, 1, .1);
  machine.ray_handling_s = 1e-6;
  const SimulationResult handled = simulate(workload, machine, {}, 1);
  EXPECT_NEAR((handled.busy_s - tasks_s) / (walking_s + 1e-6 * static_cast<double>(handled.forwarded_rays)),
              1, .1);
}

// Rays that memory has no room for cost what writing and reading them takes.
TEST(Simulation, RaysWaitForTheirDisk) {
  std::mt19937_64 random(1);
  Machine machine;
  machine.rays_allowed = 100'000;
  machine.queue_bytes = 0;
  machine.distribution = Distribution::replicate;
  const Workload workload = random_workload(random, 24, 300, 1000);
  machine.domain_bytes = bytes_of_all(workload.manifest) / 4;
  machine.scratch_bytes_s = 1e12;
  const SimulationResult quick = simulate(workload, machine, {}, 1);
  machine.scratch_bytes_s = 1e6;
  const SimulationResult slow = simulate(workload, machine, {}, 1);
  const double disk_s = 2e-6 * static_cast<double>(slow.spilled_rays * machine.bytes_a_ray);
  EXPECT_GT(slow.spilled_rays, 100'000u);
  EXPECT_NEAR((slow.busy_s - quick.busy_s) / disk_s, 1, .1);
}

struct KeepsItsItems : Scheduler {
  using Scheduler::Scheduler;
  std::vector<Gift> give_items() { return {}; }
};

// One node of eight is twenty times slower, and has everything in memory as the others have: they take what
// it would else hold up.
TEST(Simulation, IdleRanksTakeItems) {
  std::mt19937_64 random(1);
  Machine machine;
  machine.ranks = 8;
  machine.workers = 4;
  machine.rays_allowed = 100'000;
  machine.distribution = Distribution::replicate;
  const Workload workload = random_workload(random, 8, 4000, 1000);
  machine.domain_bytes = bytes_of_all(workload.manifest);
  Mishaps slow;
  slow.slow_rank = 20;
  const double even_s = simulate(workload, machine, {}, 1).seconds;
  const SimulationResult taken = simulate(workload, machine, slow, 1);
  const double kept_s = SimulatedJob<KeepsItsItems>(workload, machine, slow, 1).run().seconds;
  EXPECT_GT(kept_s / even_s, 15);
  EXPECT_LT(taken.seconds / even_s, 2) << "8/7, and an item of its own that ends late";
  EXPECT_GT(taken.given_items, 400u);
}

// Two ranks share a domain with seven tenths of the work, and one of them has the rest. Where both generate
// as many rays, the latter traces .65 of all.
TEST(Simulation, WhoWaitsForWorkGeneratesIt) {
  Workload workload;
  workload.manifest.domains.resize(2);
  for (DomainInfo& d : workload.manifest.domains) d.bytes = 1000;
  workload.domains.assign(2, {2e-6, {}});
  workload.camera.ways = {{0, .7}, {1, .3}};
  workload.items = 2000;
  workload.rays_an_item = 1000;
  Machine machine;
  machine.ranks = 2;
  machine.rays_allowed = 8192;
  machine.domain_bytes = bytes_of_all(workload.manifest);
  machine.distribution = Distribution::decompose;
  machine.homes = Homes({0, 1}, {1, 1}, 2);
  const SimulationResult shared = simulate(workload, machine, {}, 1);
  EXPECT_GT(shared.efficiency, .95);
  EXPECT_GT(shared.given_items, 0u);
}

}  // namespace
}  // namespace vitrail::simulation_test
