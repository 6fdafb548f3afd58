// SPDX-License-Identifier: Apache-2.0
// Deliberately wrong schedulers, watches and disks: the simulation finds out what they do.
#include <gtest/gtest.h>

#include <limits>

#include "tests/farm/random_job.h"

namespace vitrail::broken_schedulers_test {
namespace {

template <class SchedulerType, class WatchType = Watch, class SpillType = Spill,
          class ReceiveType = ReceivesBeside>
bool is_caught(int jobs) {
  for (int seed = 1; seed <= jobs; ++seed) {
    try {
      run<SchedulerType, WatchType, SpillType, ReceiveType>(RandomJob(static_cast<std::uint64_t>(seed)),
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
  bool arrived(std::uint32_t, std::uint64_t) { return true; }
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
    RandomJob c(seed);
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
  EXPECT_FALSE(is_caught<Scheduler>(50));
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
}  // namespace vitrail::broken_schedulers_test
