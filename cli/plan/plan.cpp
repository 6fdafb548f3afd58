// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>

#include <fstream>
#include <nlohmann/json.hpp>

#include "cli/common/distribution.h"
#include "cli/common/main_guard.h"
#include "cli/common/number_checks.h"
#include "cli/common/own_output.h"
#include "cli/common/sizes.h"
#include "cli/plan/plan_svg.h"
#include "farm/plan/memory.h"
#include "farm/scheduler/residency.h"
#include "farm/scheduler/round.h"
#include "farm/simulator/simulation.h"
#include "film/film.h"
#include "scene/system/atomic_file.h"
#include "scene/system/resource_usage.h"
#include "scene/system/say.h"

namespace vitrail {
namespace {

using Json = nlohmann::ordered_json;

struct Arguments {
  std::filesystem::path bundle, profile, svg;
  std::vector<int> ranks{1, 2, 4, 8, 16, 32, 64, 128, 256, 512, 1024};
  std::string memory, network = "12G", disk = "1G", scratch = "1G";
  double pictures = 1, latency_us = 5, disk_latency_ms = 1, slow_rank = 1;
  double files_a_second = std::numeric_limits<double>::infinity();
  int threads = 16, ranks_of_a_disk = 1, ranks_of_a_link = 1;
  Distribution distribution = Distribution::automatic;
  std::filesystem::path homes;
  bool json = false, force = false, homes_stay = false;
  std::uint64_t domain_memory = 0;  // for tests, as render's: at most so much of it for domains; 0: no limit
};

const char* limit_of(const SimulationResult& r) {
  if (r.efficiency >= .8) return "work";
  if (r.around_s >= .5 * r.seconds) return "beginning and end";
  if (r.busiest_loader >= .5 && r.busiest_loader >= r.busiest_link) return "loading";
  if (r.busiest_link >= .5) return "network";
  return r.busiest_workers >= .8 ? "one rank's work" : "rays in flight";
}

// As the farm shares out the memory of a rank.
MemoryPlan share_memory(const Arguments& a, const Manifest& m) {
  const LargestDomain largest = largest_domain(m);
  const std::uint64_t budget = a.memory.empty() ? 0 : parse_bytes(a.memory), program = resident_bytes(),
                      all = bytes_of_all(m);
  FilmMemory film = place_film(film_bytes(m.film), budget, program, program, a.threads, largest.bytes, all);
  const std::uint64_t base = program + film.resident();
  MemoryPlan plan = plan_memory(budget, base, base, a.threads, largest, all);
  widen_window(film, plan, largest.bytes, all);
  if (a.domain_memory > 0)
    plan = {std::max(largest.bytes, std::min(plan.domains_bytes, a.domain_memory)), few_rays_bytes};
  return plan;
}

Json to_json(const PlanPoint& p, std::uint64_t scene_bytes) {
  const SimulationResult& r = p.result;
  return {{"ranks", p.ranks},
          {"seconds", r.seconds},
          {"around_s", r.around_s},
          {"efficiency", r.efficiency},
          {"limit", limit_of(r)},
          {"copies", static_cast<double>(r.most_bytes) / static_cast<double>(scene_bytes)},
          {"loaded_bytes", r.loaded_bytes},
          {"domain_loads", r.loads},
          {"forwarded_rays", r.forwarded_rays},
          {"trace_s", r.busy_s},
          {"busiest_workers", r.busiest_workers},
          {"busiest_loader", r.busiest_loader},
          {"busiest_link", r.busiest_link},
          {"items_given", r.given_items},
          {"spilled_rays", r.spilled_rays},
          {"most_rays_alive", r.most_alive},
          {"most_rays_on_a_rank", r.most_on_a_rank}};
}

void print_row(const PlanPoint& p, std::uint64_t scene_bytes) {
  const SimulationResult& r = p.result;
  show("{:>6} {:>10.2f} {:>6.0f} % {:>7.2f} {:>10} {:>7} {:>10.3g}  {}\n", p.ranks, r.seconds,
       100 * r.efficiency, static_cast<double>(r.most_bytes) / static_cast<double>(scene_bytes),
       format_bytes(r.loaded_bytes), r.loads, static_cast<double>(r.forwarded_rays), limit_of(r));
  std::fflush(stdout);
}

// Of the rank that has most to do, with all else in its favour.
double longest_work_s(const Arguments& a, const RayProfile& profile, const Homes& homes, double pictures) {
  std::vector<double> work_s(static_cast<std::size_t>(homes.ranks()));
  for (std::uint32_t d = 0; d < homes.domains(); ++d) {
    const bool at_home = a.distribution == Distribution::decompose;
    const int first = at_home ? homes.first(d) : 0, last = at_home ? homes.last(d) : homes.ranks() - 1;
    for (int rank = first; rank <= last; ++rank)
      work_s[static_cast<std::size_t>(rank)] += profile.domains[d].seconds / (last - first + 1);
  }
  return std::ranges::max(work_s) * pictures / a.threads;
}

// Until a rank has read the manifest and can begin. docs/why/scheduler.md has the measure.
double setup_s(const Manifest& m) { return 7.5e-3 + 1.3e-6 * static_cast<double>(m.domains.size()); }

// A profile is of few samples, and a job of so few is soon done on any cluster.
void warn_of_few_samples(const Arguments& a, const Manifest& m, const RayProfile& profile) {
  const PixelRect& c = m.film.crop;
  const double pixels = static_cast<double>(c.x1 - c.x0) * (c.y1 - c.y0);
  const double samples = static_cast<double>(profile.cost.camera_rays) * a.pictures / pixels;
  if (samples < 1.5)
    say("vitrail: this plans as many samples as the profile has, {:.2g} a pixel; --times 256 plans 256 times "
        "as "
        "many\n",
        samples);
}

int plan(const Arguments& a) {
  require_own_texts({a.svg}, a.force);
  const Manifest manifest = read_manifest(a.bundle);
  const RayProfile profile = read_ray_profile(a.profile);
  warn_of_few_samples(a, manifest, profile);
  Machine machine;
  machine.workers = a.threads;
  machine.latency_s = a.latency_us * 1e-6;
  machine.network_bytes_s = static_cast<double>(parse_bytes(a.network));
  machine.disk_latency_s = a.disk_latency_ms * 1e-3;
  machine.disk_bytes_s = static_cast<double>(parse_bytes(a.disk));
  machine.scratch_bytes_s = static_cast<double>(parse_bytes(a.scratch));
  machine.ranks_of_a_disk = a.ranks_of_a_disk;
  machine.ranks_of_a_link = a.ranks_of_a_link;
  machine.files_s = a.files_a_second;
  machine.setup_s = setup_s(manifest);
  machine.film_bytes = static_cast<double>(film_bytes(manifest.film));
  Mishaps mishaps;
  mishaps.slow_rank = a.slow_rank;
  const MemoryPlan memory = share_memory(a, manifest);
  machine.domain_bytes = memory.domains_bytes;
  const std::uint64_t scene_bytes = std::max<std::uint64_t>(1, bytes_of_all(manifest));
  machine.distribution = a.distribution;
  std::optional<RayProfile> homes;
  if (!a.homes.empty()) homes = read_ray_profile(a.homes);
  std::vector<PlanPoint> points;
  if (!a.json) show(" ranks    seconds  effic.  copies     loaded   loads  forwarded  limited by\n");
  for (const int ranks : a.ranks) {
    machine.ranks = ranks;
    machine.homes = homes ? homes_by_work(manifest, *homes, ranks) : homes_by_bytes(manifest, ranks);
    const bool in_flow = is_in_flow(manifest, *machine.homes, a.distribution, machine.domain_bytes);
    machine.rays_allowed = (in_flow ? rays_allowed_in_flow(a.threads) : rays_allowed_a_rank(memory)) * ranks;
    machine.queue_bytes = queue_bounds(memory, ranks).waiting;
    // All takes the simulator time. Of a long job as much is simulated as has a steady middle, when rays
    // alive have reached their bound and their items still come; in items so small that their size does not
    // show, with fewer rounds where one rank has much to do.
    constexpr double most_rays = 1 << 24;
    const auto rays = static_cast<double>(profile.cost.camera_rays);
    const double pictures =
        std::min(a.pictures, (most_rays + 4 * static_cast<double>(machine.rays_allowed)) / rays);
    Workload workload = workload_of(manifest, profile, pictures, 1e4 + 50.0 * ranks * a.threads);
    workload.middle_again = 3 * (a.pictures / pictures - 1);
    machine.round_interval_s = std::clamp(longest_work_s(a, profile, *machine.homes, pictures) / 5'000,
                                          round_interval_s(ranks), .05);
    machine.rays_of_a_batch = std::max<std::uint64_t>(1024, workload.rays_an_item / 4);
    points.push_back({ranks, simulate(workload, machine, mishaps, 1)});
    if (!a.json) print_row(points.back(), scene_bytes);
  }
  if (a.json) {
    Json list = Json::array();
    for (const PlanPoint& p : points) list.push_back(to_json(p, scene_bytes));
    show("{}\n", Json{{"bundle", a.bundle.string()}, {"plan", list}}.dump(1, ' ', false,
                                                                          Json::error_handler_t::replace));
  }
  if (!a.svg.empty()) {
    AtomicFile out(a.svg);
    const std::string svg = plan_svg(points);
    out.write(std::as_bytes(std::span(svg)));
    out.commit();
  }
  return exit_done;
}

}  // namespace
}  // namespace vitrail

int main(int argc, char** argv) {
  using namespace vitrail;
  CLI::App app(
      "simulates the render of a bundle on a cluster, by the farm's own scheduler under a simulated clock",
      "vitrail plan");
  Arguments a;
  app.add_option("bundle", a.bundle, "bundle (NAME.vit)")->required();
  app.add_option("--profile", a.profile, "the file of `vitrail render --profile` for this bundle")
      ->required();
  app.add_option("--ranks", a.ranks, "numbers of ranks; default: 1, 2, 4 … 1024")
      ->delimiter(',')
      ->check(CLI::Range(1, 100000));
  app.add_option("--threads", a.threads, "threads of a rank; default: 16")->check(CLI::Range(1, 4096));
  declare_distribution(app, a.distribution, a.homes, a.homes_stay);
  app.add_option("--memory", a.memory, "memory of a rank, as for render; default: no limit");
  app.add_option("--times", a.pictures, "simulate this many times the samples of the profile")
      ->check(more_than_0);
  app.add_option("--latency", a.latency_us, "latency of a message, µs; default: 5")->check(not_below_0);
  app.add_option("--network", a.network, "bytes a second of a link, each way; default: 12G");
  app.add_option("--disk-latency", a.disk_latency_ms, "latency of a file, ms; default: 1")
      ->check(not_below_0);
  app.add_option("--disk", a.disk, "bytes a second that a disk reads; default: 1G");
  app.add_option("--scratch", a.scratch,
                 "bytes a second that the disk writes and reads for rays beyond the memory; default: 1G");
  app.add_option("--ranks-a-disk", a.ranks_of_a_disk,
                 "ranks that share a disk and read one file after the other; default: 1")
      ->check(CLI::Range(1, 100000));
  app.add_option("--ranks-a-link", a.ranks_of_a_link,
                 "ranks of a node, which share its link to the network; default: 1")
      ->check(CLI::Range(1, 100000));
  app.add_option("--files-a-second", a.files_a_second,
                 "files that one server opens a second for all ranks; default: no limit")
      ->check(more_than_0);
  app.add_option("--slow-rank", a.slow_rank, "one rank takes so many times as long; default: 1")
      ->check(CLI::Range(1.0, 1e6));
  app.add_option("--svg", a.svg, "write a plot of seconds and efficiency");
  app.add_option("--domain-memory", a.domain_memory)->group("");
  app.add_flag("--json", a.json, "print JSON");
  app.add_flag("--force", a.force, "replace a file that vitrail did not make");
  return run_guarded(app, argc, argv, [&] { return plan(a); });
}
