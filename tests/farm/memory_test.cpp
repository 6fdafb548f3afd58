// SPDX-License-Identifier: Apache-2.0
#include "farm/plan/memory.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <limits>

#include "farm/conclude/job_report.h"
#include "farm/rays/queues.h"
#include "farm/rays/waiting_batches.h"
#include "scene/system/diagnostics.h"

namespace vitrail::memory_test {
namespace {

constexpr std::uint64_t mib = 1 << 20, most = std::numeric_limits<std::uint64_t>::max();

TEST(Memory, BudgetIsSharedOutOrRefused) {
  const MemoryPlan plan = plan_memory(200 * mib, 50 * mib, 60 * mib, 2, {20 * mib}, 500 * mib);
  EXPECT_LE(plan.domains_bytes + plan.queue_bytes + 50 * mib, 200 * mib);
  EXPECT_GE(plan.domains_bytes, 20 * mib);
  EXPECT_THROW(plan_memory(70 * mib, 50 * mib, 60 * mib, 2, {20 * mib}, 500 * mib), MachineError);
  EXPECT_THROW(plan_memory(200 * mib, 50 * mib, 201 * mib, 2, {20 * mib}, 500 * mib), MachineError);
  EXPECT_EQ(plan_memory(0, 50 * mib, 60 * mib, 2, {20 * mib}, 500 * mib).domains_bytes, 500 * mib);
}

std::string refusal_of(std::uint64_t budget, std::uint64_t peak, std::uint64_t largest,
                       std::uint64_t objects = 0) {
  try {
    plan_memory(budget, 20 * mib, peak, 2, {largest, objects}, 500 * mib);
  } catch (const MachineError& error) {
    return error.what();
  }
  return {};
}

// The advice helps: that budget, also where the program takes 2 MiB more the next time, or domains of that
// size.
TEST(Memory, ARefusalNamesWhatIsEnough) {
  const std::string said = refusal_of(100 * mib, 30 * mib, 299 * mib);
  std::uint64_t least = 0, room_kib = 0;
  const std::size_t at = said.find("at least "), domains = said.find("--domain-bytes ");
  ASSERT_TRUE(at != std::string::npos && domains != std::string::npos) << said;
  least = std::stoull(said.substr(at + 9)), room_kib = std::stoull(said.substr(domains + 15));
  EXPECT_EQ(refusal_of(least * mib, 30 * mib, 299 * mib), "");
  EXPECT_EQ(refusal_of((least - 2) * mib, 30 * mib, 299 * mib), "");
  EXPECT_NE(refusal_of((least - 3) * mib, 30 * mib, 299 * mib), "");
  EXPECT_EQ(refusal_of(100 * mib, 30 * mib, room_kib << 10), "");
  EXPECT_NE(refusal_of(100 * mib, 30 * mib, (room_kib + 1) << 10), "");
}

TEST(Memory, ARefusalDoesNotAdviseWhatDoesNotHelp) {
  EXPECT_EQ(refusal_of(100 * mib, 120 * mib, 10 * mib).find("--domain-bytes"), std::string::npos)
      << "reading the scene takes too much";
  EXPECT_EQ(refusal_of(20 * mib, 20 * mib, 10 * mib).find("--domain-bytes"), std::string::npos)
      << "the program takes too much";
  EXPECT_NE(refusal_of(100 * mib, 30 * mib, 299 * mib, 20 * mib).find("--domain-bytes"), std::string::npos);
  EXPECT_NE(refusal_of(100 * mib, 30 * mib, 299 * mib, 298 * mib).find("--domain-bytes"), std::string::npos)
      << "smaller domains part the objects";
}

// With more memory tiles take more: the number is that of the budget that it names, at once.
TEST(Memory, ARefusalReckonsWithTheTilesOfTheBudgetThatItNames) {
  for (const std::uint64_t all : {0 * mib, 3 * mib, 10 * mib, 400 * mib}) {
    const auto refusal = [&](std::uint64_t budget) -> std::string {
      const TileMemory tiles{std::min(all, budget / tile_share), all};
      try {
        plan_memory(budget, 20 * mib + tiles.within, 20 * mib, 2, {5 * mib}, 50 * mib, tiles);
      } catch (const MachineError& error) {
        return error.what();
      }
      return {};
    };
    const std::string said = refusal(mib);
    const std::uint64_t least = std::stoull(said.substr(said.find("at least ") + 9));
    EXPECT_EQ(refusal(least * mib), "") << all;
    EXPECT_NE(refusal((least - 4) * mib), "") << all;
  }
}

TEST(Memory, FilmIsInFilesWhereItHasNoRoomBesideTheDomains) {
  constexpr std::uint64_t base = 20 * mib, largest = 5 * mib, all = 60 * mib;
  const auto placed = [&](std::uint64_t film, std::uint64_t budget) {
    return place_film(film, budget, base, base, 2, largest, all);
  };
  EXPECT_EQ(placed(900 * mib, 0).window, 0u) << "there is no budget";
  EXPECT_EQ(placed(400 * mib, 600 * mib).window, 0u) << "everything has room";
  EXPECT_EQ(placed(45 * mib, 100 * mib).window, 0u) << "it takes less than half";
  EXPECT_GT(placed(55 * mib, 100 * mib).window, 0u) << "it takes more, and domains would have to come and go";
  EXPECT_GT(placed(900 * mib, 100 * mib).window, 0u);
  EXPECT_EQ(placed(32 * mib, 60 * mib).window, 0u) << "files would save little";
  for (const std::uint64_t budget : {60 * mib, 100 * mib, 500 * mib}) {
    FilmMemory film = placed(900 * mib, budget);
    const std::uint64_t least = film.window;
    MemoryPlan plan = plan_memory(budget, base + film.resident(), base, 2, {largest}, all);
    const std::uint64_t fixed_and_rays = budget - plan.domains_bytes - film.resident();
    widen_window(film, plan, largest, all);
    EXPECT_GT(film.window, least);
    EXPECT_GE(plan.domains_bytes, std::min(largest, all));
    EXPECT_LE(film.resident() + plan.domains_bytes + fixed_and_rays, budget + film.window / 64);
  }
}

TEST(QueueBounds, AreTogetherWhatThereIsForRays) {
  for (const std::uint64_t bytes : {std::uint64_t{0}, std::uint64_t{1}, std::uint64_t{3}, std::uint64_t{7},
                                    std::uint64_t{RayBatch::full_bytes - 1}, few_rays_bytes, 512 * mib, most})
    for (const int ranks : {2, 3, 100'000}) {
      const QueueBounds bounds = queue_bounds({0, bytes}, ranks);
      EXPECT_LE(bounds.waiting, bytes);
      EXPECT_LE(bounds.outgoing, bytes - bounds.waiting);
      EXPECT_LE(bounds.being_sent, bytes - bounds.waiting - bounds.outgoing);
      EXPECT_LT(bytes - bounds.waiting - bounds.outgoing - bounds.being_sent, 4u) << "but for rounding";
      EXPECT_GE(bounds.waiting, bounds.outgoing + bounds.being_sent) << "most rays wait";
    }
}

TEST(QueueBounds, OfARankAloneAreForRaysThatWait) {
  for (const std::uint64_t bytes : {std::uint64_t{0}, std::uint64_t{1}, few_rays_bytes, most}) {
    const QueueBounds bounds = queue_bounds({0, bytes}, 1);
    EXPECT_EQ(bounds.waiting, bytes);
    EXPECT_EQ(bounds.outgoing + bounds.being_sent, 0u) << "it sends none";
  }
}

TEST(QueueBounds, OfPhotonsHaveAPartForQuestions) {
  for (const std::uint64_t bytes : {std::uint64_t{0}, std::uint64_t{3}, few_rays_bytes, 512 * mib}) {
    const QueueBounds rays = queue_bounds({0, bytes}, 2), photons = queue_bounds_with_photons({0, bytes}, 2);
    EXPECT_EQ(photons.waiting + photons.questions, rays.waiting);
    EXPECT_LE(photons.waiting - photons.questions, 1u);
    EXPECT_EQ(queue_bounds_with_photons({0, bytes}, 1).questions, 0u) << "a rank alone asks none";
  }
}

TEST(WaitingBatches, HoldTheirBoundAndLoseNothing) {
  for (const std::uint64_t bound : {std::uint64_t{0}, std::uint64_t{3000}, std::uint64_t{mib}}) {
    WaitingBatches waiting(bound);
    constexpr std::uint32_t batches = 200, of_each = 20;
    std::uint64_t pushed_bytes = 0;
    for (std::uint32_t i = 0; i < batches; ++i) {
      RayBatch batch(i, RayKind::question);
      for (std::uint32_t k = 0; k < of_each; ++k) {
        Gather question{};
        question.pixel = i * of_each + k;
        batch.append(question);
      }
      pushed_bytes += batch.bytes().size();
      waiting.push(std::move(batch));
      ASSERT_LE(waiting.held_bytes(), bound);
    }
    EXPECT_EQ(waiting.written_bytes() > 0, bound < pushed_bytes);
    std::vector<std::uint32_t> asked(batches * of_each);
    while (!waiting.empty()) {
      RayBatch batch = waiting.pop();
      for (const Gather& question : batch.records<Gather>()) {
        EXPECT_EQ(question.pixel / of_each, batch.domain());
        ++asked.at(question.pixel);
      }
    }
    EXPECT_EQ(asked, std::vector(asked.size(), 1u));
    EXPECT_EQ(waiting.held_bytes(), 0u);
  }
}

TEST(KeptMemory, NamesTheRankThatTookMore) {
  RenderStats stats;
  stats.by_rank.resize(3);
  stats.by_rank[1].peak_rss_bytes = stats.peak_rss_bytes = 20 * mib;
  for (const std::uint64_t budget : {std::uint64_t{0}, 20 * mib, 21 * mib}) {
    stats.memory_budget_bytes = budget;
    EXPECT_NO_THROW(require_kept_memory(stats)) << budget;
  }
  stats.memory_budget_bytes = 19 * mib;
  try {
    require_kept_memory(stats);
    FAIL();
  } catch (const MachineError& e) {
    EXPECT_THAT(e.what(), ::testing::StartsWith("rank 1 took 20.0M of memory, and --memory allows 19.0M"));
  }
}

TEST(QueueBounds, DoNotDependOnDomains) {
  for (const int ranks : {1, 2})
    EXPECT_EQ(queue_bounds({most, few_rays_bytes}, ranks).waiting,
              queue_bounds({0, few_rays_bytes}, ranks).waiting);
}

// A batch, even a ray, may be more than there is room for: it goes to the disk.
TEST(QueueBounds, AreHeldWhereTheyAreSmallerThanABatch) {
  for (const std::uint64_t bytes :
       {std::uint64_t{0}, std::uint64_t{1}, 2 * sizeof(RayRecord), std::uint64_t{RayBatch::full_bytes}}) {
    const std::uint64_t waiting = queue_bounds({0, bytes}, 2).waiting;
    RayQueues queues(1, waiting, {});
    constexpr std::uint32_t rays = 2000;
    for (std::uint32_t i = 0; i < rays; ++i) {
      RayRecord path{};
      path.path.sample.pixel = i;
      queues.push(0, path);
      ASSERT_LE(queues.held_bytes(), waiting);
    }
    std::uint64_t sum = 0, number = 0;
    while (!queues.empty(0)) {
      RayBatch batch = queues.pop(0);
      for (const RayRecord& path : batch.records<RayRecord>()) sum += path.path.sample.pixel, ++number;
    }
    EXPECT_EQ(number, rays);
    EXPECT_EQ(sum, std::uint64_t{rays} * (rays - 1) / 2);
  }
}

TEST(RaysAllowed, FitThreeTimesIntoTheQueuesOrWhatTheDiskIsWorth) {
  const auto bytes = [](std::uint64_t queues) {
    return 3 * sizeof(RayRecord) * static_cast<std::uint64_t>(rays_allowed_a_rank({0, queues}));
  };
  for (const std::uint64_t queues : {128 * mib + 1000, 200 * mib, 512 * mib, most}) {
    EXPECT_LE(bytes(queues), queues);
    EXPECT_GT(bytes(queues), queues - 3 * sizeof(RayRecord));
  }
  for (const std::uint64_t queues : {std::uint64_t{0}, std::uint64_t{1}, few_rays_bytes, 128 * mib})
    EXPECT_EQ(bytes(queues), bytes(128 * mib)) << "the others wait on the disk";
}

TEST(RaysAllowed, AreSomeWhateverThereIs) {
  std::int64_t before = 1;
  for (std::uint64_t queues = 1; queues <= most / 2; queues *= 2) {
    const std::int64_t rays = rays_allowed_a_rank({0, queues});
    EXPECT_GE(rays, before) << "more room for no fewer";
    EXPECT_EQ(rays, rays_allowed_a_rank({most, queues})) << "that for domains does not count";
    before = rays;
  }
}

}  // namespace
}  // namespace vitrail::memory_test
