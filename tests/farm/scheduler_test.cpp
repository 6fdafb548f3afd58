// SPDX-License-Identifier: Apache-2.0
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <random>

#include "farm/scheduler/scheduler.h"

namespace vitrail::scheduler_test {
namespace {

// Exact of a few, within a factor of two of many.
TEST(Fullest, FindsMostAndFewest) {
  std::mt19937 random(3);
  for (const std::uint32_t domains : {1u, 5u, 60u, 1000u}) {
    Fullest fullest(domains);
    std::vector<std::uint64_t> rays(domains);
    std::vector<bool> in(domains);
    EXPECT_FALSE(fullest.most());
    EXPECT_FALSE(fullest.fewest());
    for (int step = 0; step < 3000; ++step) {
      const auto d = static_cast<std::uint32_t>(random() % domains);
      if (!in[d]) {
        fullest.insert(d, rays[d] = random() % 100);
        in[d] = true;
      } else if (random() % 4 == 0) {
        fullest.erase(d);
        in[d] = false;
      } else {
        fullest.set(d, rays[d] = random() % 5000);
      }
      std::uint64_t most = 0, fewest = ~std::uint64_t{0};
      for (std::uint32_t e = 0; e < domains; ++e)
        if (in[e]) most = std::max(most, rays[e]), fewest = std::min(fewest, rays[e]);
      ASSERT_EQ(fullest.most().has_value(), most > 0);
      ASSERT_EQ(fullest.fewest().has_value(), fewest != ~std::uint64_t{0});
      const std::uint64_t factor = domains <= Fullest::looked_at ? 1 : 2;
      if (most > 0) {
        EXPECT_GE(factor * rays[*fullest.most()], most);
      }
      if (fullest.fewest()) {
        EXPECT_LE(rays[*fullest.fewest()], factor * fewest);
      }
    }
  }
}

Manifest of_domains(std::vector<std::uint64_t> bytes) {
  Manifest m;
  for (const std::uint64_t b : bytes) {
    DomainInfo info;
    info.bytes = b;
    m.domains.push_back(info);
  }
  return m;
}

TEST(Residency, HomesAreContiguousAndBalanced) {
  const Manifest m = of_domains(std::vector<std::uint64_t>(64, 100));
  const Homes homes = homes_by_bytes(m, 4);
  EXPECT_EQ(homes.places(), 64u);
  for (std::uint32_t d = 0; d < 64; ++d) EXPECT_EQ(homes.first(d), static_cast<int>(d / 16));
}

// A profile of as much time in each domain as given.
RayProfile of_seconds(const Manifest& m, const std::vector<double>& seconds) {
  return RayProfile(m, std::vector<std::uint64_t>(seconds.size()), seconds, {}, {});
}

TEST(Homes, RanksHaveEqualWorkAndCrowdedDomainsSeveral) {
  const Manifest m = of_domains(std::vector<std::uint64_t>(8, 100));
  const Homes homes = homes_by_work(m, of_seconds(m, {10, 10, 10, 10, 360, 0, 0, 0}), 10);
  EXPECT_EQ(homes.last(4) - homes.first(4) + 1, 10) << "nine tenths of the rays, and a little further";
  for (std::uint32_t d = 0; d < 8; ++d) {
    EXPECT_LE(homes.first(d), homes.last(d));
    EXPECT_EQ(homes.has(d, 0), d <= 4) << d;
    if (d > 0) {
      EXPECT_GE(homes.first(d), homes.first(d - 1)) << "in order";
    }
  }
  EXPECT_TRUE(is_in_flow(m, homes, Distribution::decompose, 800));
  EXPECT_FALSE(is_in_flow(m, homes, Distribution::automatic, 800)) << "all are traced in everywhere";
  EXPECT_TRUE(is_in_flow(m, homes, Distribution::automatic, 500)) << "five domains begin at the first rank";
  EXPECT_FALSE(is_in_flow(m, homes, Distribution::decompose, 499));
  EXPECT_FALSE(is_in_flow(m, homes, Distribution::replicate, 800));
  EXPECT_FALSE(is_in_flow(m, homes_by_bytes(m, 10), Distribution::decompose, 800));
  EXPECT_EQ(homes.last(7), 9);
  EXPECT_THROW(homes_by_work(of_domains({1, 2}), of_seconds(m, std::vector<double>(8)), 3), Error);
  // Nothing was seen: by bytes.
  const Homes unseen = homes_by_work(m, of_seconds(m, std::vector<double>(8)), 4);
  for (std::uint32_t d = 0; d < 8; ++d) EXPECT_TRUE(unseen.has(d, static_cast<int>(d / 2)));
}

// What is told of the ranks' queues decides between homes; what was sent since counts as well.
TEST(Homes, RaysGoWhereFewerWait) {
  const Manifest m = of_domains({100, 100});
  Scheduler scheduler({4, 1, 1000}, Residency(m, 100, Homes({0, 1}, {0, 3}, 4), 0, Distribution::decompose));
  EXPECT_EQ(scheduler.destination(0, 5), 0) << "it has one home";
  scheduler.ranks_told(
      std::make_shared<const std::vector<RankReport>>(std::vector<RankReport>{{0}, {900}, {0}, {900}}));
  std::vector<int> sent(4);
  for (int i = 0; i < 100; ++i) ++sent[static_cast<std::size_t>(scheduler.destination(1, 10))];
  EXPECT_GT(sent[2], sent[1] + sent[3]);
  EXPECT_EQ(sent[0], 0);
  for (int i = 0; i < 900; ++i) ++sent[static_cast<std::size_t>(scheduler.destination(1, 10))];
  EXPECT_LT(std::abs(sent[1] - sent[3]), 50) << "all are equally full by now";
}

// What waits here goes to the new homes, and so does what comes afterwards from a rank that knew those of
// before.
TEST(Homes, RaysThatWaitAreSentToTheNewOnes) {
  const Manifest m = of_domains({100, 100, 100});
  Scheduler scheduler({4, 1, 1000, 0},
                      Residency(m, 1 << 20, Homes({0, 0, 1}, 4), 0, Distribution::decompose));
  EXPECT_TRUE(scheduler.arrived(0, 90));
  EXPECT_TRUE(scheduler.arrived(1, 30));
  for (int loads = 0; loads < 2; ++loads) {
    const LoadStep step = scheduler.loader_is_free();
    ASSERT_TRUE(step.load);
    scheduler.loaded(step.load->domain);
  }
  const Homes homes({0, 1, 0}, {2, 1, 0}, 4);
  EXPECT_EQ(scheduler.leaving(0, homes), 60u) << "a third of them stays";
  EXPECT_EQ(scheduler.leaving(1, homes), 30u);
  EXPECT_EQ(scheduler.leaving(2, homes), 0u);
  for (std::uint32_t d = 0; d < 2; ++d) scheduler.leave(d, scheduler.leaving(d, homes));
  EXPECT_EQ(scheduler.rays_to_send(), 90u);
  EXPECT_EQ(scheduler.report().waiting, 30);
  EXPECT_EQ(scheduler.settle(homes, 1 << 20).evicted, std::vector<std::uint32_t>{1});
  EXPECT_FALSE(scheduler.arrived(1, 7)) << "sent by a rank that knew the homes of before";
  EXPECT_TRUE(scheduler.arrived(2, 5));
  EXPECT_EQ(scheduler.rays_to_send(), 97u);
  EXPECT_EQ(scheduler.report().waiting, 35);
  EXPECT_EQ(scheduler.next_task().domain, 0u);
  const LoadStep step = scheduler.loader_is_free();
  ASSERT_TRUE(step.load);
  EXPECT_EQ(step.load->domain, 2u) << "it is local now, and rays wait";
}

// Given by who is busy to who has nothing to do; on their way they are alive.
TEST(Work, IdleRanksAreGivenItems) {
  const Manifest m = of_domains({100});
  const auto scheduler_of = [&](int rank) {
    return Scheduler({3, 1, 30'000, rank}, Residency(m, 100, Homes({0}, 3), rank, Distribution::replicate));
  };
  Scheduler busy = scheduler_of(0), idle = scheduler_of(1);
  busy.begin_items(10);
  idle.worker_waits();
  const auto round = [&] {
    RoundSums sums;
    for (Scheduler* s : {&busy, &idle}) {
      const RoundSums mine = s->contribution();
      sums.born += mine.born, sums.died += mine.died, sums.idle += mine.idle, sums.wanting += mine.wanting;
    }
    const auto told = std::make_shared<const std::vector<RankReport>>(
        std::vector<RankReport>{busy.report(), idle.report(), {0, 0, 0}});
    for (Scheduler* s : {&busy, &idle}) s->ranks_told(told), s->decide(sums);
    return sums.born - sums.died;
  };
  EXPECT_EQ(round(), 0);
  EXPECT_TRUE(idle.give_items().empty());
  const std::vector<Scheduler::Gift> gifts = busy.give_items();
  ASSERT_EQ(gifts.size(), 1u);
  EXPECT_EQ(gifts[0].to, 1);
  EXPECT_EQ(gifts[0].items, 5u) << "it keeps as many";
  EXPECT_EQ(busy.items_given(), 5u);
  EXPECT_EQ(round(), 5) << "nothing can end before they have come";
  idle.items_arrived(5);
  EXPECT_EQ(round(), 0);
  EXPECT_TRUE(busy.give_items().empty()) << "nobody is idle";
  busy.worker_waits();
  EXPECT_EQ(busy.report().items, 0) << "its own worker waits for leave to generate";
}

TEST(Residency, TracesWhereItsDistributionSays) {
  const Manifest m = of_domains({100, 100});
  const auto local = [&](Distribution distribution, std::uint64_t budget) {
    Residency residency(m, budget, Homes({0, 1}, 2), 0, distribution);
    residency.rays_forwarded(1, 1'000'000);
    EXPECT_TRUE(residency.is_local(0));
    return residency.is_local(1);
  };
  EXPECT_TRUE(local(Distribution::automatic, 200)) << "all fit, or much asked for";
  EXPECT_FALSE(local(Distribution::automatic, 150));
  EXPECT_FALSE(local(Distribution::decompose, 200));
  EXPECT_TRUE(local(Distribution::replicate, 100));
}

TEST(Residency, TakesTheFullestAndKeepsWithinItsBudget) {
  const Manifest m = of_domains({100, 100, 100});
  Residency residency(m, 200, Homes({0, 0, 0}, 1), 0);
  residency.rays_wait(0, 5);
  residency.rays_wait(1, 9);
  residency.rays_wait(2, 7);
  EXPECT_EQ(residency.loader_is_free(21, true).load.value().domain, 1u);
  // Not loaded yet, but its room is taken: one more fits, the third does not.
  EXPECT_EQ(residency.loader_is_free(21, true).load.value().domain, 2u);
  EXPECT_FALSE(residency.loader_is_free(21, true).load);
  residency.loaded(1);
  EXPECT_EQ(residency.fullest(), 1u);
  residency.rays_taken(1, 9);
  const LoadStep step = residency.loader_is_free(12, true);
  EXPECT_EQ(step.evicted, std::vector<std::uint32_t>{1});
  EXPECT_FALSE(step.load) << "a worker still holds what left";
  residency.released(100);
  EXPECT_EQ(residency.loader_is_free(12, true).load.value().domain, 0u);
  EXPECT_EQ(residency.held_bytes(), 200u);
}

// Two domains are resident; a third has more rays than both.
TEST(Residency, EvictsNoMoreAndNoSoonerThanItNeeds) {
  const Manifest m = of_domains({200'000, 200'000, 200'000});  // more than its rays are worth
  const auto full = [&](std::uint64_t rays_of_the_third) {
    Residency residency(m, 400'000, Homes({0, 0, 0}, 1), 0);
    residency.rays_wait(0, 5);
    residency.rays_wait(1, 6);
    for (int i = 0; i < 2; ++i) residency.loaded(residency.loader_is_free(11, true).load.value().domain);
    residency.rays_wait(2, rays_of_the_third);
    return residency;
  };
  Residency residency = full(50);
  EXPECT_EQ(residency.loader_is_free(61, true).evicted, std::vector<std::uint32_t>{0}) << "the emptiest";
  EXPECT_TRUE(residency.loader_is_free(61, true).evicted.empty()) << "room enough comes free";
  residency.released(200'000);
  EXPECT_EQ(residency.loader_is_free(61, true).load.value().domain, 2u);
  EXPECT_EQ(residency.evictions(), 1u);

  EXPECT_TRUE(full(5).loader_is_free(5, true).evicted.empty()) << "it has no more rays than the emptiest";
  // A sixth of the rays alive: half of an even share of three domains.
  EXPECT_FALSE(full(50).loader_is_free(300, true).evicted.empty());
  EXPECT_TRUE(full(50).loader_is_free(301, true).evicted.empty()) << "it has too few of the rays alive";
}

// While the workers have other things to do, a domain is worth reading by its bytes and its rays.
TEST(Residency, SwapsWithoutNeedWhatItsRaysAreWorth) {
  const auto swaps = [](std::uint64_t bytes, std::uint64_t rays, std::uint64_t rays_of_the_other) {
    const Manifest m = of_domains({bytes, bytes});
    Residency residency(m, bytes, Homes({0, 0}, 1), 0);
    residency.rays_wait(0, rays_of_the_other);
    EXPECT_TRUE(residency.loader_is_free(rays, true).load);
    residency.loaded(0);
    residency.rays_wait(1, rays);
    return !residency.loader_is_free(rays, false).evicted.empty();
  };
  EXPECT_TRUE(swaps(1 << 20, 512, 128));
  EXPECT_FALSE(swaps(1 << 20, 512, 129)) << "the other has more than a quarter of its rays";
  EXPECT_FALSE(swaps(1 << 20, 511, 1)) << "reading takes longer than tracing";
  EXPECT_FALSE(swaps(100 << 20, 4096, 1));
}

// An object counts once, whatever the number of domains that need it.
TEST(Residency, CountsObjectsOnce) {
  Manifest m = of_domains({10, 10, 10});
  m.objects = {{.triangles = 1, .bytes = 100}, {.triangles = 1, .bytes = 50}};
  m.domains[0].objects = {0};
  m.domains[1].objects = {0, 1};
  const std::uint64_t one = 8 + 16, both = 2 * (8 + 16);  // tables of views, and who holds them
  EXPECT_EQ(bytes_needed(m, 1), 160u + both);
  EXPECT_EQ(bytes_of_all(m), 180u + one + both);
  Residency residency(m, 165 + one + both, Homes({0, 0, 1}, 2), 0);
  EXPECT_TRUE(residency.is_local(1));
  residency.rays_forwarded(2, 1000000);
  EXPECT_FALSE(residency.is_local(2)) << "its own two and their objects take 170 bytes";
  residency.rays_wait(0, 5);
  residency.rays_wait(1, 9);
  const auto load = residency.loader_is_free(14, true).load;
  ASSERT_TRUE(load);
  EXPECT_EQ(load->missing, (std::vector<std::uint32_t>{0, 1}));
  EXPECT_EQ(residency.held_bytes(), 160u + both);
  m.objects.resize(100'000, {.triangles = 1, .bytes = 1});
  m.domains[2].objects = {99'999};
  EXPECT_EQ(bytes_needed(m, 2), 10u + 8 * 100'000 + 16 + 1) << "by number";
}

TEST(Residency, KeepsAnothersDomainOnlyIfMuchAskedFor) {
  const Manifest m = of_domains({100, 100});
  Residency residency(m, 150, Homes({0, 1}, 2), 0);
  EXPECT_TRUE(residency.is_local(0));
  EXPECT_FALSE(residency.is_local(1));
  residency.rays_forwarded(1, 1000000);
  EXPECT_FALSE(residency.is_local(1)) << "it does not fit beside the rank's own";
  const Manifest three = of_domains({100, 100, 100});
  Residency roomy(three, 220, Homes({0, 1, 1}, 2), 0);
  roomy.rays_forwarded(1, 10);
  EXPECT_FALSE(roomy.is_local(1));
  roomy.rays_forwarded(1, 1000000);
  EXPECT_TRUE(roomy.is_local(1));
  roomy.rays_forwarded(2, 1000000);
  EXPECT_FALSE(roomy.is_local(2)) << "the room is taken";
}

}  // namespace
}  // namespace vitrail::scheduler_test
