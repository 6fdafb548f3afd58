// SPDX-License-Identifier: Apache-2.0
#include "farm/plan/work.h"

#include <algorithm>
#include <bit>
#include <numeric>
#include <tuple>

#include "scene/records/pixel_place.h"

namespace vitrail {

namespace {

std::uint64_t tiles(int extent) {
  return static_cast<std::uint64_t>((extent + WorkPlan::tile - 1) / WorkPlan::tile);
}

std::uint64_t passes(const WorkPlan::Part& part) {
  return (part.end - part.first + part.samples_per_item - 1) / part.samples_per_item;
}

// A power of two.
constexpr std::uint64_t passes_together = 8;

// Knuth's multiplicative hash, its upper half.
std::uint64_t mixed(std::uint64_t n) { return (n * 0x9E3779B97F4A7C15u) >> 32; }

}  // namespace

std::uint64_t WorkPlan::tiles_x() const { return tiles(crop.x1 - crop.x0); }
std::uint64_t WorkPlan::tiles_y() const { return tiles(crop.y1 - crop.y0); }

std::uint64_t WorkPlan::items() const {
  std::uint64_t all = 0;
  for (const Part& part : parts) all += passes(part);
  return tiles_x() * tiles_y() * all;
}

std::uint64_t WorkPlan::all_samples() const {
  if (more.empty())
    return std::uint64_t{samples()} * static_cast<std::uint64_t>(crop.x1 - crop.x0) *
           static_cast<std::uint64_t>(crop.y1 - crop.y0);
  return std::accumulate(more.begin(), more.end(),
                         std::accumulate(held.begin(), held.end(), std::uint64_t{0}));
}

WorkPlan::Range WorkPlan::samples(const WorkItem& item, int x, int y) const {
  if (more.empty()) return {item.sample0, item.sample1};
  const std::size_t pixel = pixel_place(x - crop.x0, y - crop.y0, crop.x1 - crop.x0);
  return {held[pixel] + std::min(item.sample0, more[pixel]),
          held[pixel] + std::min(item.sample1, more[pixel])};
}

std::uint64_t WorkPlan::samples(const WorkItem& item) const {
  std::uint64_t all = 0;
  for (int y = item.pixels.y0; y < item.pixels.y1; ++y)
    for (int x = item.pixels.x0; x < item.pixels.x1; ++x) {
      const Range range = samples(item, x, y);
      all += range.end - range.first;
    }
  return all;
}

WorkItem WorkPlan::item(std::uint64_t index) const {
  const std::uint64_t a_pass = tiles_x() * tiles_y(), in_pass = index % a_pass;
  const int x = crop.x0 + static_cast<int>(in_pass % tiles_x()) * tile;
  const int y = crop.y0 + static_cast<int>(in_pass / tiles_x()) * tile;
  std::uint64_t pass = index / a_pass;
  auto part = parts.begin();
  for (; pass >= passes(*part); ++part) pass -= passes(*part);
  const std::uint32_t sample = part->first + static_cast<std::uint32_t>(pass) * part->samples_per_item;
  return {{x, std::min(x + tile, crop.x1), y, std::min(y + tile, crop.y1)},
          sample,
          std::min(sample + part->samples_per_item, part->end)};
}

WorkPlan make_work_plan(const PixelRect& crop, std::uint32_t samples,
                        std::span<const std::uint32_t> earlier_ends, bool one_by_one) {
  WorkPlan plan{crop, {}, {}, {}, one_by_one};
  std::uint32_t first = 0;
  const auto add = [&](std::uint32_t end) {
    // Few enough items that their list stays small, many enough to share and to stop between.
    constexpr std::uint32_t longest = 4096;
    plan.parts.push_back({first, end, one_by_one ? 1 : std::clamp(end / 128, 1u, longest)});
    first = end;
  };
  for (const std::uint32_t end : earlier_ends) add(end);
  add(samples);
  return plan;
}

WorkPlan make_adaptive_round(const PixelRect& crop, std::vector<std::uint32_t> held,
                             std::vector<std::uint32_t> more) {
  const std::uint32_t most = more.empty() ? 0 : std::ranges::max(more);
  return {crop, {{0, most, std::max(16u, most / 128)}}, std::move(held), std::move(more)};
}

void mark_empty_items(const WorkPlan& plan, std::vector<std::uint64_t>& done) {
  if (!plan.adaptive() || plan.items() == 0) return;
  const std::uint64_t a_pass = plan.tiles_x() * plan.tiles_y();
  const int width = plan.crop.x1 - plan.crop.x0;
  for (std::uint64_t tile = 0; tile < a_pass; ++tile) {
    const PixelRect p = plan.item(tile).pixels;
    std::uint32_t most = 0;
    for (int y = p.y0; y < p.y1; ++y)
      for (int x = p.x0; x < p.x1; ++x)
        most = std::max(most, plan.more[pixel_place(x - plan.crop.x0, y - plan.crop.y0, width)]);
    for (std::uint64_t i = tile; i < plan.items(); i += a_pass)
      if (plan.item(i).sample0 >= most) done[i / 64] |= std::uint64_t{1} << (i % 64);
  }
}

std::vector<std::uint64_t> all_done(std::uint64_t items) {
  std::vector<std::uint64_t> done((items + 63) / 64, ~std::uint64_t{0});
  if (items % 64 != 0) done.back() = (std::uint64_t{1} << items % 64) - 1;
  return done;
}

void put_passes_together(const WorkPlan& plan, std::vector<std::uint64_t>& items) {
  if (plan.adaptive() || plan.one_by_one) return;
  const std::uint64_t a_pass = plan.tiles_x() * plan.tiles_y();
  const auto order = [&](std::uint64_t item) {
    const std::uint64_t pass = item / a_pass;
    const std::uint64_t together = pass < passes_together ? static_cast<std::uint64_t>(std::bit_width(pass))
                                                          : 3 + pass / passes_together;
    return std::tuple(together, item % a_pass, pass);
  };
  std::ranges::sort(items, {}, order);
}

bool goes_on_with(const WorkPlan& plan, const WorkItem& item, const WorkItem& next) {
  const auto corners = [](const PixelRect& r) { return std::tuple(r.x0, r.x1, r.y0, r.y1); };
  return !plan.adaptive() && !plan.one_by_one && next.sample0 == item.sample1 &&
         corners(next.pixels) == corners(item.pixels);
}

std::uint64_t list_bytes(const WorkPlan& plan, int ranks) {
  const std::uint64_t listed = plan.one_by_one ? plan.tiles_x() * plan.tiles_y() : plan.items();
  return listed * sizeof(std::uint64_t) / static_cast<std::uint64_t>(ranks) + plan.items() / 4;
}

std::vector<std::uint64_t> share_of(const WorkPlan& plan, const std::vector<std::uint64_t>& done, int rank,
                                    int ranks) {
  return share_of(done, 0, plan.items(), rank, ranks);
}

std::vector<std::uint64_t> share_of(const std::vector<std::uint64_t>& done, std::uint64_t first,
                                    std::uint64_t end, int rank, int ranks) {
  std::vector<std::uint64_t> share;
  std::uint64_t open = 0;
  for (std::uint64_t i = first; i < end; ++i) {
    if (!done.empty() && (done[i / 64] >> (i % 64) & 1)) continue;
    // Every block of as many items as there are ranks gives each of them one, in an order of its own, so that
    // the tiles of a rank do not line up in columns.
    const auto all = static_cast<std::uint64_t>(ranks);
    if ((open + mixed(open / all)) % all == static_cast<std::uint64_t>(rank)) share.push_back(i);
    ++open;
  }
  return share;
}

}  // namespace vitrail
