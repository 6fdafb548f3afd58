// SPDX-License-Identifier: Apache-2.0
// Thousands of jobs under a simulated clock. VITRAIL_SIMULATIONS=N runs N of them; a seed that fails is
// printed, and VITRAIL_SIMULATION_SEED runs that one alone.
#include <gtest/gtest.h>

#include <cstdlib>
#include <set>
#include <string>

#include "farm/simulator/simulated_job.h"

namespace vitrail {
namespace {

std::uint64_t from_environment(const char* name, std::uint64_t otherwise) {
  const char* text = std::getenv(name);
  return text ? std::strtoull(text, nullptr, 10) : otherwise;
}

// A cluster, a picture and what goes wrong, all of one seed.
struct Case {
  Workload workload;
  Machine machine;
  Mishaps mishaps;

  // Mostly few ranks, one in a hundred up to 1000.
  explicit Case(std::uint64_t seed) {
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
SimulationResult run(Case c, std::uint64_t seed) {
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

TEST(Simulation, NothingIsLostAndEveryJobEnds) {
  const std::uint64_t only = from_environment("VITRAIL_SIMULATION_SEED", 0);
  const std::uint64_t first = only > 0 ? only : 1,
                      jobs = only > 0 ? 1 : from_environment("VITRAIL_SIMULATIONS", 2000);
  std::uint64_t events = 0;
  for (std::uint64_t seed = first; seed < first + jobs; ++seed) {
    const Case c(seed);
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

// Deliberately wrong ones: what they do is found out.
template <class SchedulerType, class WatchType = Watch, class SpillType = Spill,
          class ReceiveType = ReceivesBeside>
bool is_caught(int jobs) {
  for (int seed = 1; seed <= jobs; ++seed) {
    try {
      run<SchedulerType, WatchType, SpillType, ReceiveType>(Case(static_cast<std::uint64_t>(seed)),
                                                            static_cast<std::uint64_t>(seed));
    } catch (const InvariantBroken&) {
      return true;
    }
  }
  return false;
}

// One round without a ray is enough for it.
struct TooSoon : Scheduler {
  using Scheduler::Scheduler;
  Decision decide(const RoundSums& sums) {
    Scheduler::decide(sums);
    return sums.born == sums.died && sums.quiet == ranks ? Decision::all_quiet : Decision::go_on;
  }
  TooSoon(const Job& job, Residency residency) : Scheduler(job, std::move(residency)), ranks(job.ranks) {}
  int ranks;
};

struct NeverSends : Scheduler {
  using Scheduler::Scheduler;
  bool send_is_due(double) const { return false; }
};

struct ForgetsWhatArrived : Scheduler {
  using Scheduler::Scheduler;
  void arrived(std::uint32_t, std::uint64_t) {}
};

struct ForgetsDeaths : Scheduler {
  using Scheduler::Scheduler;
  void count(std::uint64_t born, std::uint64_t died) { Scheduler::count(born, died == 0 ? 0 : died - 1); }
};

struct LetsGoTwice : Scheduler {
  using Scheduler::Scheduler;
  void released(std::uint64_t bytes) { Scheduler::released(2 * bytes); }
};

struct NeverLoads : Scheduler {
  using Scheduler::Scheduler;
  LoadStep loader_is_free() { return {}; }
};

// As if what is loaded were there at once.
struct NeverWaitsForLoads : Scheduler {
  using Scheduler::Scheduler;
  LoadStep loader_is_free() {
    const LoadStep step = Scheduler::loader_is_free();
    if (step.load) Scheduler::loaded(step.load->domain);
    return step;
  }
  void loaded(std::uint32_t) {}
};

// As if another load would bring them.
struct ForgetsObjects : Scheduler {
  using Scheduler::Scheduler;
  LoadStep loader_is_free() {
    LoadStep step = Scheduler::loader_is_free();
    if (step.load && !step.load->missing.empty()) step.load->missing.pop_back();
    return step;
  }
};

struct SaysThatItIsQuiet : Scheduler {
  using Scheduler::Scheduler;
  RoundSums contribution() {
    RoundSums mine = Scheduler::contribution();
    mine.quiet = 1;
    return mine;
  }
};

// An item that was begun is left as it is when a checkpoint is asked for.
struct PausesInAnItem : Scheduler {
  using Scheduler::Scheduler;
  Decision decide(const RoundSums& sums) {
    pause = sums.pause > 0;
    return Scheduler::decide(sums);
  }
  void resume() {
    pause = false;
    Scheduler::resume();
  }
  Task next_task() const {
    const Task task = Scheduler::next_task();
    return pause && task.work == Work::generate ? Task{} : task;
  }
  RoundSums contribution() {
    RoundSums mine = Scheduler::contribution();
    if (pause && mine.reserved == 0) mine.quiet = 1;
    return mine;
  }
  bool pause = false;
};

struct GivesTwice : Scheduler {
  using Scheduler::Scheduler;
  void items_arrived(std::uint64_t items) { Scheduler::items_arrived(2 * items), count(items, 0); }
};

struct ForgetsWhatIsGiven : Scheduler {
  using Scheduler::Scheduler;
  void items_arrived(std::uint64_t items) { count(0, items); }
};

// Whether or not it may soon begin them.
struct GivesToAndFro : Scheduler {
  using Scheduler::Scheduler;
  template <class Act>
  auto as_if_busy(const Act& act) {
    const int waiting = workers_waiting();
    for (int i = 0; i < waiting; ++i) worker_wakes();
    auto result = act();
    for (int i = 0; i < waiting; ++i) worker_waits();
    return result;
  }
  std::vector<Gift> give_items() {
    return as_if_busy([&] { return Scheduler::give_items(); });
  }
  RankReport report() {
    const RankReport told = Scheduler::report();
    return told.items < 0 ? told : as_if_busy([&] { return Scheduler::report(); });
  }
};

struct WaitsForEver : Watch {
  using Watch::Watch;
  double due_s() const { return std::numeric_limits<double>::infinity(); }
};

struct AsksNobody : Watch {
  using Watch::Watch;
  Step step(double now_s) {
    const Step step = Watch::step(now_s);
    return step == Step::ask_all ? Step::nothing : step;
  }
};

struct ForgetsAnswers : Watch {
  using Watch::Watch;
  void answered(int rank) {
    if (rank != 3) Watch::answered(rank);
  }
};

struct NeverSpills : Spill {
  using Spill::Spill;
  std::optional<std::uint32_t> next() const { return std::nullopt; }
};

TEST(Simulation, CatchesBrokenSpills) { EXPECT_TRUE((is_caught<Scheduler, Watch, NeverSpills>(100))); }

TEST(Simulation, CatchesBrokenWatches) {
  EXPECT_TRUE((is_caught<Scheduler, WaitsForEver>(300)));
  EXPECT_TRUE((is_caught<Scheduler, AsksNobody>(2000)));
  EXPECT_TRUE((is_caught<Scheduler, ForgetsAnswers>(2000)));
}

// A rank that waits for the rest of a message does not answer, though it is well, while the sender does not.
struct WaitsForTheRest {
  static constexpr bool waits = true;
};

TEST(Simulation, CatchesReceivesThatWait) {
  EXPECT_TRUE((is_caught<Scheduler, Watch, Spill, WaitsForTheRest>(2000)));
}

TEST(Simulation, ALostMessageEndsTheJob) {
  int stalled = 0;
  for (std::uint64_t seed = 1; seed <= 300; ++seed) {
    Case c(seed);
    c.mishaps.silences.clear();
    c.mishaps.disk_error = {};
    c.mishaps.lost_message = 0;
    const SimulationResult result = SimulatedJob<Scheduler>(c.workload, c.machine, c.mishaps, seed).run();
    EXPECT_EQ(result.stalled, result.messages > 0) << "VITRAIL_SIMULATION_SEED=" << seed;
    EXPECT_EQ(result.silent, std::vector<int>{}) << "VITRAIL_SIMULATION_SEED=" << seed;
    stalled += result.stalled;
  }
  EXPECT_GT(stalled, 50);
}

TEST(Simulation, CatchesBrokenSchedulers) {
  EXPECT_FALSE(is_caught<Scheduler>(300));
  EXPECT_TRUE(is_caught<TooSoon>(2000));
  EXPECT_TRUE(is_caught<NeverSends>(300));
  EXPECT_TRUE(is_caught<ForgetsWhatArrived>(300));
  EXPECT_TRUE(is_caught<ForgetsDeaths>(300));
  EXPECT_TRUE(is_caught<LetsGoTwice>(300));
  EXPECT_TRUE(is_caught<NeverLoads>(300));
  EXPECT_TRUE(is_caught<NeverWaitsForLoads>(300));
  EXPECT_TRUE(is_caught<ForgetsObjects>(300));
  EXPECT_TRUE(is_caught<SaysThatItIsQuiet>(300));
  EXPECT_TRUE(is_caught<PausesInAnItem>(300));
  EXPECT_TRUE(is_caught<GivesTwice>(300));
  EXPECT_TRUE(is_caught<ForgetsWhatIsGiven>(300));
  EXPECT_TRUE(is_caught<GivesToAndFro>(2000));
}

}  // namespace
}  // namespace vitrail
