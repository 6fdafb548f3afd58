// SPDX-License-Identifier: Apache-2.0
#include "farm/plan/memory.h"

#include <fmt/format.h>

#include <algorithm>

#include "bundle/loaded_domain.h"
#include "bundle/manifest.h"
#include "farm/scheduler/residency.h"
#include "film/film_scratch.h"
#include "scene/system/diagnostics.h"
#include "tracer/rays/ray_records.h"

namespace vitrail {

namespace {

constexpr std::uint64_t mib = 1 << 20;
// Stacks, waves of paths (half a MiB), outboxes, buffers in flight, what the allocator keeps.
constexpr std::uint64_t slack_bytes = 4 * mib, slack_a_thread = mib + mib / 2, slack_a_loader = mib / 16;
constexpr std::uint64_t least_queue_bytes = 2 * mib, most_queue_bytes = 512 * mib;

std::uint64_t fixed_bytes(std::uint64_t base, int threads) {
  return base + slack_bytes + slack_a_thread * static_cast<std::uint64_t>(threads) +
         slack_a_loader * loaders_of_a_rank;
}

// More domains help where all but the largest has room: they part their objects, too.
std::string about_smaller_domains(std::uint64_t budget, std::uint64_t fixed, std::uint64_t peak) {
  constexpr std::uint64_t least_domain_bytes = 256 << 10;
  if (budget < peak || budget < fixed + least_queue_bytes + least_domain_bytes) return {};
  return fmt::format(
      ", or partition the scene with --domain-bytes {}K: so much is left for a domain and the objects "
      "that it places",
      (budget - fixed - least_queue_bytes) >> 10);
}

}  // namespace

LargestDomain largest_domain(const Manifest& manifest) {
  LargestDomain largest;
  for (std::uint32_t d = 0; d < manifest.domains.size(); ++d)
    if (const std::uint64_t bytes = bytes_needed(manifest, d); bytes > largest.bytes)
      largest = {bytes, bytes - bytes_loaded(manifest, d)};
  return largest;
}

std::uint64_t least_memory(std::uint64_t base, std::uint64_t peak, int threads,
                           std::uint64_t largest_domain) {
  return std::max(peak, fixed_bytes(base, threads) + least_queue_bytes + largest_domain);
}

std::uint64_t FilmMemory::resident() const {
  return window == 0 ? bytes : window + FilmScratch::table_bytes(window, bytes);
}

FilmMemory place_film(std::uint64_t film_bytes, std::uint64_t budget, std::uint64_t base, std::uint64_t peak,
                      int threads, std::uint64_t largest_domain, std::uint64_t all_domains) {
  constexpr std::uint64_t least_window = FilmScratch::least_window_bytes;
  const auto fits = [&](std::uint64_t domains) {
    return budget >= least_memory(base + film_bytes, peak, threads, domains);
  };
  if (budget == 0 || film_bytes <= 2 * least_window || fits(all_domains) ||
      (film_bytes <= budget / 2 && fits(largest_domain)))
    return {film_bytes, 0};
  return {film_bytes, least_window};
}

void widen_window(FilmMemory& film, MemoryPlan& plan, std::uint64_t largest_domain,
                  std::uint64_t all_domains) {
  if (film.window == 0) return;
  const std::uint64_t have = plan.domains_bytes, unused = have > all_domains ? have - all_domains : 0;
  const std::uint64_t spare = std::max(unused, (have - largest_domain) / 2);
  // Beside the window its tables take a hundredth of it.
  const std::uint64_t more = std::min(spare / 64 * 63, film.bytes);
  film.window += more;
  plan.domains_bytes -= more + more / 64;
}

MemoryPlan plan_memory(std::uint64_t budget, std::uint64_t base, std::uint64_t peak, int threads,
                       LargestDomain largest, std::uint64_t all_domains, TileMemory tiles) {
  if (budget == 0) return {all_domains, most_queue_bytes};
  const std::uint64_t fixed = fixed_bytes(base, threads);
  std::uint64_t least = least_memory(base, peak, threads, largest.bytes);
  if (budget < least) {
    const std::uint64_t without = least_memory(base - tiles.within, 0, threads, largest.bytes);
    const std::uint64_t share_of_all = without / (tile_share - 1);
    least = std::max(peak, without + std::min(tiles.all, share_of_all));
  }
  // The program itself takes a little more or less each time.
  constexpr std::uint64_t next_time = 2 * mib;
  if (budget < least)
    throw MachineError(fmt::format(
        "--memory {:.0f}M is too little. Give at least {:.0f}M{}. The program and the film take {:.0f}M, the "
        "largest domain {:.0f}M and its objects {:.0f}M; reading the scene and making the picture take "
        "{:.0f}M{}",
        static_cast<double>(budget) / mib, static_cast<double>((least + next_time + mib - 1) / mib),
        about_smaller_domains(budget, fixed, peak), static_cast<double>(fixed) / mib,
        static_cast<double>(largest.bytes - largest.objects) / mib,
        static_cast<double>(largest.objects) / mib, static_cast<double>(peak) / mib,
        peak < least ? "" : "; -o NAME.film needs less, and vitrail develop makes the picture elsewhere"));
  const std::uint64_t free = budget - fixed;
  const std::uint64_t queues =
      std::clamp(free / 5, least_queue_bytes, std::min(most_queue_bytes, free - largest.bytes));
  // Where there is room: messages that come while a busy machine gives a rank no processor.
  const std::uint64_t early_messages = std::min(budget / 64, free - queues - largest.bytes);
  return {free - queues - early_messages, queues};
}

QueueBounds queue_bounds(const MemoryPlan& plan, int ranks) {
  if (ranks == 1) return {plan.queue_bytes, 0, 0, 0};
  return {plan.queue_bytes / 2, plan.queue_bytes / 4, plan.queue_bytes / 4, 0};
}

QueueBounds queue_bounds_with_photons(const MemoryPlan& plan, int ranks) {
  QueueBounds bounds = queue_bounds(plan, ranks);
  if (ranks > 1) bounds.questions = bounds.waiting / 2;
  bounds.waiting -= bounds.questions;
  return bounds;
}

std::uint64_t table_bytes(std::uint64_t domains, int threads) {
  constexpr std::uint64_t a_domain = 400, of_a_resident_table = 24;
  return domains * (a_domain + of_a_resident_table * static_cast<std::uint64_t>(threads + 2));
}

std::uint64_t profile_bytes(std::uint64_t domains, int threads) {
  // A way is from a domain to a neighbour. Where all are gathered it stands in a list that grows, in a map in
  // order, and in the profile.
  constexpr std::uint64_t ways = 40, a_way = 40, a_way_gathered = 128;
  constexpr std::uint64_t a_domain = 16, a_domain_gathered = 128;
  const auto tables = static_cast<std::uint64_t>(threads) + 1;
  return domains * (a_domain * tables + a_domain_gathered +
                    std::min(domains + 1, ways) * (a_way * tables + a_way_gathered));
}

std::uint64_t connection_bytes(int ranks) {
  constexpr std::uint64_t a_rank = 64 << 10;
  return a_rank * static_cast<std::uint64_t>(ranks - 1);
}

std::int64_t rays_allowed_in_flow(int threads) {
  constexpr std::int64_t a_thread = 4096;  // some milliseconds of its work
  return a_thread * threads;
}

std::int64_t rays_allowed_a_rank(const MemoryPlan& plan) {
  // The more rays wait, the more of them a domain that is loaded serves; a pause waits for all of them. A
  // growing batch holds up to twice its rays, and while it is sent or received once more.
  constexpr std::uint64_t worth_the_disk_bytes = 128 * mib;
  return static_cast<std::int64_t>(std::max(plan.queue_bytes, worth_the_disk_bytes) /
                                   (3 * sizeof(RayRecord)));
}

}  // namespace vitrail
