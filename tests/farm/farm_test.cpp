// SPDX-License-Identifier: Apache-2.0
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <numeric>
#include <random>
#include <set>

#include "farm/conclude/gather_profile.h"
#include "farm/files/reserved_space.h"
#include "farm/plan/ending_time.h"
#include "farm/plan/rounds.h"
#include "farm/plan/work.h"
#include "farm/rays/parcel.h"
#include "farm/rays/queues.h"
#include "farm/run/profiling.h"
#include "farm/scheduler/scheduler.h"
#include "scene/system/diagnostics.h"
#include "tests/support/temporary_directory.h"

namespace vitrail {
namespace {

TEST(Work, EverySampleBelongsToOneItem) {
  const WorkPlan plan = make_work_plan({3, 50, 7, 41}, 300);
  std::set<std::tuple<int, int, std::uint32_t>> seen;
  for (std::uint64_t i = 0; i < plan.items(); ++i) {
    const WorkItem item = plan.item(i);
    for (int y = item.pixels.y0; y < item.pixels.y1; ++y)
      for (int x = item.pixels.x0; x < item.pixels.x1; ++x)
        for (std::uint32_t s = item.sample0; s < item.sample1; ++s) EXPECT_TRUE(seen.emplace(x, y, s).second);
  }
  EXPECT_EQ(seen.size(), 47u * 34 * 300);
}

TEST(Work, MoreSamplesComeBehindThoseOfEarlierRenders) {
  const PixelRect crop{3, 50, 7, 41};
  const std::vector<std::uint32_t> earlier{5, 300};
  const WorkPlan plan = make_work_plan(crop, 700, earlier),
                 before = make_work_plan(crop, 300, std::vector{5u});
  std::vector<int> times(700);
  for (std::uint64_t i = 0; i < plan.items(); ++i) {
    const WorkItem item = plan.item(i);
    if (i < before.items()) {
      EXPECT_EQ(item.pixels, before.item(i).pixels);
      EXPECT_EQ(item.sample0, before.item(i).sample0);
      EXPECT_EQ(item.sample1, before.item(i).sample1);
    }
    const int pixels = (item.pixels.x1 - item.pixels.x0) * (item.pixels.y1 - item.pixels.y0);
    for (std::uint32_t s = item.sample0; s < item.sample1; ++s) times.at(s) += pixels;
  }
  EXPECT_EQ(times, std::vector<int>(700, 47 * 34));
  EXPECT_EQ(plan.samples(), 700u);
}

TEST(Work, AnAdaptiveRoundGivesEachPixelWhatItIsToHave) {
  const PixelRect crop{3, 50, 7, 41};
  std::vector<std::uint32_t> held(47 * 34), more(47 * 34);
  for (std::uint32_t p = 0; p < more.size(); ++p) held[p] = p % 7, more[p] = p * p % 53;
  const WorkPlan plan = make_adaptive_round(crop, held, more);
  std::set<std::pair<std::size_t, std::uint32_t>> seen;
  std::uint64_t all = 0;
  for (std::uint64_t i = 0; i < plan.items(); ++i) {
    const WorkItem item = plan.item(i);
    all += plan.samples(item);
    for (int y = item.pixels.y0; y < item.pixels.y1; ++y)
      for (int x = item.pixels.x0; x < item.pixels.x1; ++x) {
        const auto pixel = static_cast<std::size_t>((y - 7) * 47 + x - 3);
        const WorkPlan::Range range = plan.samples(item, x, y);
        for (std::uint32_t s = range.first; s < range.end; ++s) {
          EXPECT_TRUE(seen.emplace(pixel, s).second);
          EXPECT_GE(s, held[pixel]);
          EXPECT_LT(s, held[pixel] + more[pixel]);
        }
      }
  }
  EXPECT_EQ(all, seen.size());
  EXPECT_EQ(all, std::accumulate(more.begin(), more.end(), std::uint64_t{0}));
  EXPECT_EQ(plan.all_samples(), all + std::accumulate(held.begin(), held.end(), std::uint64_t{0}));
  EXPECT_EQ(make_adaptive_round(crop, held, std::vector<std::uint32_t>(47 * 34)).items(), 0u);
}

TEST(Work, SharesAreDisjointCompleteAndEven) {
  const WorkPlan plan = make_work_plan({0, 100, 0, 100}, 5);
  std::vector<std::uint64_t> done((plan.items() + 63) / 64);
  for (const std::uint64_t item : {0, 5, 64, 200})
    done[static_cast<std::size_t>(item / 64)] |= 1ull << (item % 64);
  std::set<std::uint64_t> all;
  for (int rank = 0; rank < 3; ++rank) {
    const auto share = share_of(plan, done, rank, 3);
    EXPECT_NEAR(static_cast<double>(share.size()), static_cast<double>(plan.items() - 4) / 3, 30);
    for (const std::uint64_t item : share) EXPECT_TRUE(all.insert(item).second);
  }
  EXPECT_EQ(all.size(), plan.items() - 4);
  EXPECT_FALSE(all.contains(5));
}

// 63 tiles a row, one less than there are ranks: each has its share, and tiles from all over the picture.
TEST(Work, SharesDoNotLineUpWithThePicture) {
  for (const int width : {1000, 1008, 1024, 1040}) {
    const WorkPlan plan = make_work_plan({0, width, 0, 500}, 1);
    for (int rank = 0; rank < 64; ++rank) {
      const auto share = share_of(plan, {}, rank, 64);
      EXPECT_NEAR(static_cast<double>(share.size()), static_cast<double>(plan.items()) / 64, 1);
      std::set<int> columns;
      for (const std::uint64_t item : share) columns.insert(plan.item(item).pixels.x0);
      EXPECT_GT(columns.size(), share.size() / 2) << width << ' ' << rank;
    }
  }
}

// Cut anywhere, the parts of an item are the item, where pixels have samples of their own number as well.
TEST(Work, PartsOfAnItemTileIt) {
  const PixelRect crop{3, 20, 40, 45};
  const WorkPlan uniform = make_work_plan(crop, 7);
  std::vector<std::uint32_t> held(17 * 5, 4), more(17 * 5);
  for (std::uint32_t p = 0; p < more.size(); ++p) more[p] = p % 6;
  const WorkPlan adaptive = make_adaptive_round(crop, held, more);
  for (const WorkPlan* plan : {&uniform, &adaptive})
    for (std::uint64_t i = 0; i < plan->items(); ++i) {
      const WorkItem item = plan->item(i);
      using Sample = std::tuple<int, int, std::uint32_t>;
      std::vector<Sample> whole, parts;
      for (int y = item.pixels.y0; y < item.pixels.y1; ++y)
        for (int x = item.pixels.x0; x < item.pixels.x1; ++x)
          for (std::uint32_t s = plan->samples(item, x, y).first; s < plan->samples(item, x, y).end; ++s)
            whole.emplace_back(x, y, s);
      ASSERT_EQ(whole.size(), plan->samples(item));
      for (std::uint64_t at = 0; at < whole.size(); at += 7)
        for_each_sample(*plan, item, at, std::min<std::uint64_t>(at + 7, whole.size()),
                        [&](int x, int y, std::uint32_t s) { parts.emplace_back(x, y, s); });
      EXPECT_EQ(parts, whole);
    }
}

// What is left of the samples may be less than the step of any pixel that comes first: then there is no other
// round. (A round without samples was begun for ever.)
TEST(Rounds, NoneIsWithoutSamples) {
  constexpr std::uint32_t side = 8;
  Goal goal;
  goal.in_rounds = goal.adaptive = true;
  int over = 0;
  for (std::uint32_t seed = 0; seed < 40; ++seed) {
    FilmSettings settings;
    settings.width = settings.height = side;
    settings.crop = {0, side, 0, side};
    Film film(settings, {});
    // Uneven as after a round, a few pixels noisy, and 2 samples a pixel left.
    for (std::uint32_t p = 0; p < side * side; ++p)
      for (std::uint32_t s = 0; s < ((p * 7 + seed) % 10 == 0 ? 768u : 192u); ++s) {
        film.count_sample(p, s);
        film.deposit(p, s, {1, 1, 1});
      }
    goal.samples = static_cast<std::uint32_t>(film.samples() / film.pixels()) + 3;
    const auto next = next_round(film, goal);
    if (!next) ++over;
    if (next) {
      EXPECT_TRUE(std::ranges::any_of(next->more, [](std::uint32_t n) { return n > 0; })) << seed;
    }
  }
  EXPECT_GT(over, 0) << "no film had too few samples left";
}

TEST(Rounds, TimeIsLeftForFilmAndPicture) {
  RenderOptions options;
  options.resources.time_limit_s = 60;
  constexpr std::uint64_t bytes = 100'000'000;
  const auto left = [&](int ranks, double gather_s) {
    return ending_time_s(options, bytes, ranks, /*write_s=*/0.5, gather_s);
  };
  EXPECT_GT(left(1, 0), 0.5);
  EXPECT_GT(left(2, 0), left(1, 0));
  EXPECT_NEAR(left(2, 3), left(1, 0) + 3, 1e-9);  // what was measured counts
  const double film_alone = left(1, 0);
  options.resources.after_film = {0.25, 1e-8};
  EXPECT_NEAR(left(1, 0), film_alone + 0.25 + 1, 1e-9);
  options.resources.time_limit_s = 2;
  EXPECT_EQ(left(1, 0), 1) << "half of the time is for samples";
}

TEST(ReservedSpace, TimesItsDisk) {
  const test::TemporaryDirectory folder;
  const ReservedSpace a_gibibyte(folder.path() / "a", 1 << 30);
  EXPECT_GT(a_gibibyte.time_to_write_s(), 0.02) << "no memory is so fast";
  EXPECT_LT(a_gibibyte.time_to_write_s(), 1000);
}

TEST(Work, ManySamplesHaveFewItems) {
  const PixelRect hd{0, 1920, 0, 1080};
  const WorkPlan iterations = make_work_plan(hd, 65536, {}, /*one_by_one=*/true);
  EXPECT_LE(list_bytes(iterations, 1), iterations.items() / 4 + (1u << 20)) << "one iteration is dealt out";
  for (const std::uint32_t samples : {1u, 1000u, 10'000u, 500'000u}) {
    const WorkPlan plan = make_work_plan(hd, samples);
    EXPECT_LE(list_bytes(plan, 1), 20u << 20) << samples;
    EXPECT_LE(8 * share_of(plan, {}, 0, 1).size(), list_bytes(plan, 1));
  }
}

// Of a round whose samples are all in one tile.
TEST(Work, ItemsWithoutSamplesAreDone) {
  const PixelRect crop{0, 40, 0, 30};
  std::vector<std::uint32_t> held(40 * 30, 4), more(40 * 30);
  more[17 + 2 * 40] = 5000;
  const WorkPlan plan = make_adaptive_round(crop, held, more);
  EXPECT_LE(plan.items(), 6u * 130);
  std::vector<std::uint64_t> done((plan.items() + 63) / 64);
  mark_empty_items(plan, done);
  std::uint64_t samples = 0;
  for (const std::uint64_t i : share_of(plan, done, 0, 1)) {
    EXPECT_GT(plan.samples(plan.item(i)), 0u);
    samples += plan.samples(plan.item(i));
  }
  EXPECT_EQ(samples, 5000u);
  std::vector<std::uint64_t> none;
  const WorkPlan over = make_adaptive_round(crop, held, std::vector<std::uint32_t>(40 * 30));
  EXPECT_EQ(over.items(), 0u);
  mark_empty_items(over, none);
}

TEST(Queues, KeepEveryRayOfBothKinds) {
  constexpr std::uint64_t plenty = 1 << 30;
  using Case = std::pair<std::uint64_t, std::optional<std::uint64_t>>;
  for (const auto& [most_bytes, seed] :
       {Case(plenty, {}), Case(plenty, 9), Case(200'000, {}), Case(200'000, 9), Case(0, 9)}) {
    RayQueues queues(3, most_bytes, seed);
    for (std::uint32_t i = 0; i < 5000; ++i) {
      RayRecord path{};
      path.path.sample.pixel = i;
      queues.push(1, path);
      ShadowRecord shadow{};
      shadow.pixel = i;
      queues.push(1, shadow);
      EXPECT_LE(queues.held_bytes(), most_bytes);
    }
    EXPECT_EQ(queues.written_bytes() > 0, most_bytes < plenty);
    std::multiset<std::uint32_t> paths, shadows;
    while (!queues.empty(1)) {
      RayBatch batch = queues.pop(1);
      EXPECT_LE(batch.bytes().size(), RayBatch::full_bytes);
      EXPECT_EQ(batch.domain(), 1u);
      if (batch.kind() == RayKind::path)
        for (const RayRecord& r : batch.records<RayRecord>()) paths.insert(r.path.sample.pixel);
      else
        for (const ShadowRecord& r : batch.records<ShadowRecord>()) shadows.insert(r.pixel);
    }
    EXPECT_EQ(paths.size(), 5000u);
    EXPECT_EQ(std::set(paths.begin(), paths.end()).size(), 5000u);
    EXPECT_EQ(shadows, paths);
  }
}

// Records of 64 and 48 bytes at most, and 8 bytes for a batch of 64 KiB.
TEST(WireSizes, FramingIncluded) {
  RayBatch paths(0, RayKind::path), shadows(0, RayKind::shadow);
  while (!paths.full()) paths.append(RayRecord{});
  while (!shadows.full()) shadows.append(ShadowRecord{});
  EXPECT_LE(static_cast<double>(paths.bytes().size()) / static_cast<double>(paths.count()), 64.01);
  EXPECT_LE(static_cast<double>(shadows.bytes().size()) / static_cast<double>(shadows.count()), 48);
}

TEST(Wire, WhatIsNoBatchIsSeen) {
  RayBatch batch(2, RayKind::path);
  EXPECT_FALSE(batch.is_whole(3)) << "without rays";
  batch.append(RayRecord{});
  EXPECT_TRUE(batch.is_whole(3));
  EXPECT_FALSE(batch.is_whole(2)) << "a domain that is none";
  std::vector<std::byte> bytes = batch.bytes();
  bytes.pop_back();
  EXPECT_FALSE(RayBatch(bytes).is_whole(3)) << "a part of a ray";
  bytes = batch.bytes();
  bytes[4] = std::byte{7};
  EXPECT_FALSE(RayBatch(bytes).is_whole(3)) << "a kind that is none";
  EXPECT_FALSE(RayBatch(std::vector<std::byte>(3)).is_whole(3));
}

RayRecord ray_of(std::uint32_t pixel) {
  RayRecord record{};
  record.path.sample.pixel = pixel;
  return record;
}

TEST(Wire, AParcelHoldsItsBatches) {
  Parcel parcel;
  EXPECT_TRUE(parcel.empty());
  for (std::uint32_t domain = 0; domain < 3; ++domain) {
    RayBatch batch(domain, domain == 1 ? RayKind::shadow : RayKind::path);
    for (std::uint32_t i = 0; i <= domain; ++i)
      domain == 1 ? batch.append(ShadowRecord{.pixel = i}) : batch.append(ray_of(i));
    parcel.add(batch);
  }
  const std::vector<std::byte> message = parcel.take();
  EXPECT_TRUE(parcel.empty());
  const std::vector<RayBatch> batches = unpack(message, 3);
  ASSERT_EQ(batches.size(), 3u);
  for (std::uint32_t domain = 0; domain < 3; ++domain) {
    EXPECT_EQ(batches[domain].domain(), domain);
    EXPECT_EQ(batches[domain].count(), domain + 1);
  }
  EXPECT_THROW(unpack(message, 2), MachineError) << "a domain that is none";
  for (std::size_t bytes = 1; bytes < message.size(); ++bytes) {
    const std::vector<std::byte> part(message.begin(), message.begin() + static_cast<std::ptrdiff_t>(bytes));
    try {
      EXPECT_LT(unpack(part, 3).size(), 3u) << bytes;  // it ends between two batches
    } catch (const MachineError&) {
    }
  }
}

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

// Recording takes ten times as long: it counts in neither sum.
TEST(Profiling, TellsWhatTracingCostsWithoutIt) {
  using Manner = Profiling::Manner;
  using Work = Scheduler::Work;
  Profiling profiling(1);
  const auto take = [&](Work work, std::uint64_t rays, double recorded_s, double walking_s, double plain_s) {
    const Manner manner = profiling.next(work);
    const double seconds[] = {recorded_s, walking_s, plain_s};
    profiling.took(work, manner, rays, seconds[static_cast<std::size_t>(manner)]);
  };
  take(Work::generate, 100, 10, 2, 1);
  EXPECT_EQ(Profiling::seconds_of_all(profiling.sums, Manner::plain), 10) << "nothing else is known yet";
  for (int i = 0; i < 5; ++i) take(Work::generate, 100, 10, 2, 1);
  EXPECT_EQ(Profiling::seconds_of_all(profiling.sums, Manner::plain), 6);
  EXPECT_EQ(Profiling::seconds_of_all(profiling.sums, Manner::walking), 12);
  EXPECT_EQ(Profiling::samples_a_recorded_one(profiling.sums), 3);
  for (int i = 0; i < 6; ++i) take(Work::trace, 1000, 100, 30, 20);
  EXPECT_EQ(Profiling::seconds_of_all(profiling.sums, Manner::plain), 6 + 120);
  EXPECT_EQ(Profiling::seconds_of_all(profiling.sums, Manner::walking), 12 + 180);
  EXPECT_EQ(Profiling::samples_a_recorded_one(profiling.sums), 3) << "rays are not samples";
}

// Rays that a task sent where nobody recorded it were traced all the same where they arrived: none goes on
// from where none was.
TEST(Profiling, KnowsRaysWhoseSendersWereNotRecorded) {
  using Work = Scheduler::Work;
  Profiling profiling(2);
  for (int turn = 0; turn < 3; ++turn) profiling.took(Work::generate, profiling.next(Work::generate), 5, 1);
  profiling.traffic.begin({1, true});
  profiling.traffic.visit(1);
  profiling.traffic.leave_for(0);
  profiling.traffic.end();
  Manifest manifest;
  manifest.domains.resize(2);
  const RayProfile profile = gather_profile(*make_transport(nullptr, nullptr), manifest, profiling, {});
  EXPECT_EQ(profile.domains[1].rays, 3u);
  EXPECT_EQ(profile.domains[0].rays, 3u);
  const std::vector<RayProfile::Way> ways = {{1, 0, 3}, {RayProfile::Way::camera, 1, 3}};
  EXPECT_EQ(profile.ways, ways);
}

}  // namespace
}  // namespace vitrail
