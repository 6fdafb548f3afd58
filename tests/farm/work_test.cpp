// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include <algorithm>
#include <numeric>
#include <set>

#include "farm/files/reserved_space.h"
#include "farm/plan/ending_time.h"
#include "farm/plan/rounds.h"
#include "farm/plan/work.h"
#include "tests/support/temporary_directory.h"

namespace vitrail::work_test {
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

// Each item once, and eight successive samples of a tile behind each other where there are as many.
TEST(Work, PassesOfATileAreTakenTogether) {
  const WorkPlan plan = make_work_plan({3, 90, 0, 40}, 40);
  std::vector<std::uint64_t> items = share_of(plan, {}, 0, 1);
  const std::vector<std::uint64_t> ascending = items;
  put_passes_together(plan, items);
  const std::uint64_t tiles = plan.tiles_x() * plan.tiles_y();
  EXPECT_TRUE(
      std::equal(items.begin(), items.begin() + 2 * static_cast<std::ptrdiff_t>(tiles), ascending.begin()));
  std::uint64_t going_on = 0;
  for (std::size_t i = 1; i < items.size(); ++i)
    going_on += goes_on_with(plan, plan.item(items[i - 1]), plan.item(items[i]));
  // Runs of 1, 1, 2, 4, and four times 8 passes.
  EXPECT_EQ(going_on, tiles * (1 + 3 + 4 * 7));
  std::ranges::sort(items);
  EXPECT_EQ(items, ascending);
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

}  // namespace
}  // namespace vitrail::work_test
