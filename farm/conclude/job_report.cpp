// SPDX-License-Identifier: Apache-2.0
#include "farm/conclude/job_report.h"

#include <fmt/format.h>

#include <algorithm>

#include "farm/run/checkpoint.h"
#include "farm/run/progress.h"
#include "scene/system/atomic_file.h"
#include "scene/system/progress_line.h"
#include "scene/system/resource_usage.h"
#include "scene/system/say.h"

namespace vitrail {

namespace {

constexpr double bytes_a_mib = 1 << 20;

std::uint64_t pixels_without_samples(const Film& film) {
  std::uint64_t none = 0;
  for (std::uint32_t p = 0; p < film.pixels(); ++p)
    if (film.samples(p) == 0) ++none;
  return none;
}

// From what was done until the time limit. The first samples of a picture may be cheaper than its others.
void print_estimate(RenderStats& s, const Job& job, std::uint64_t samples_before) {
  const std::uint64_t in_memory = job.plan.memory.domains_bytes, all_domains = job.plan.all_domains;
  const std::uint64_t samples_in_all = std::uint64_t{job.plan.goal.samples} * job.film.pixels();
  show("memory of a rank: {:.0f} MiB of program, {}film and textures, {:.0f} MiB of domains{}{}\n",
       static_cast<double>(s.base_rss_bytes) / bytes_a_mib, s.ranks > 1 ? "MPI, " : "",
       static_cast<double>(std::min(in_memory, all_domains)) / bytes_a_mib,
       in_memory < all_domains
           ? fmt::format(" of {:.0f}: they come and go", static_cast<double>(all_domains) / bytes_a_mib)
           : "",
       s.ranks > 1 ? "" : "; under mpirun MPI takes 10 to 20 MiB more");
  const double here = static_cast<double>(s.samples - samples_before),
               left = static_cast<double>(samples_in_all - s.samples) + here;
  if (!(left > 0 && here > 0)) return;
  s.expected_s = s.wall_s * left / here;
  show(
      "time: about {} on {} × {} threads for {:.3g} million samples, by {:.3g} million that took "
      "{:.1f} s\n",
      duration_in_words(s.expected_s), s.ranks, s.threads, left * 1e-6, here * 1e-6, s.wall_s);
}

// What the picture lacks, or has too little of.
void say_what_is_wrong(const Film& film, const Goal& goal, const RenderOptions& options,
                       const RenderStats& stats) {
  if (stats.ending == Ending::finished && stats.reached.upper > stats.target.value)
    say("vitrail: the error is not reached with {} samples a pixel; --spp allows for more\n", goal.samples);
  if (const std::uint64_t none = pixels_without_samples(film); none > 0 && writes_film(stats.ending))
    say("vitrail: {} of {} pixels have no sample yet and are black\n", none, film.pixels());
  if (stats.refused.nonfinite > 0)
    say("vitrail: {} samples were not finite and count as black\n", stats.refused.nonfinite);
  if (options.picture.clamp > 0 && !options.outputs.quiet)
    say("vitrail: --clamp {} removed {:.3g} % of the light: the picture is darker by as much\n",
        options.picture.clamp, 100 * stats.clamped_share);
}

void write_profile(const std::filesystem::path& file, const RayProfile& profile, bool whole) {
  if (whole) return write_ray_profile(file, profile);
  say("vitrail: {} is not written: a profile needs a whole picture, rendered without a stop\n",
      file.string());
}

}  // namespace

void add_plan(RenderStats& stats, const Job& job, const RenderOptions& options, int ranks) {
  const Manifest& manifest = job.scene->manifest;
  stats.ranks = ranks;
  stats.threads = job.plan.threads;
  stats.spectral_bins = manifest.film.spectrum.count;
  stats.spp = static_cast<std::uint64_t>(manifest.settings.samples_per_pixel);
  stats.seed = options.picture.seed;
  stats.command = options.outputs.command;
  stats.adaptive = job.plan.goal.adaptive;
  stats.domains_total = manifest.domains.size();
  stats.memory_budget_bytes = options.resources.memory_bytes;
  stats.base_rss_bytes = job.plan.base_bytes + job.plan.film.resident();
  stats.film_window_bytes = job.plan.film.window;
  stats.setup_peak_rss_bytes = job.plan.scene.peak;
}

void conclude(Job& job, const RenderOptions& options, std::uint64_t samples_before,
              const std::optional<RayProfile>& profile, RenderStats& stats) {
  const Film& film = job.film;
  const Goal& goal = job.plan.goal;
  stats.samples = film.samples();
  if (options.outputs.dry_run) return print_estimate(stats, job, samples_before);
  if (goal.target) {
    stats.target = *goal.target;
    stats.reached = reached_error(film, *goal.target);
  }
  stats.refused = film.refused();
  stats.clamped_share = film.clamped_share();
  say_what_is_wrong(film, goal, options, stats);
  if (job.plan.key.photons.photons == 0) print_wedges(options, stats.traced);
  stats.film_hash = film.hash();
  stats.pixels = film.pixels();
  // The film holds all that the checkpoint does.
  if (writes_film(stats.ending)) std::filesystem::remove(checkpoint_path(options.outputs.film));
  if (profile)
    write_profile(options.outputs.profile, *profile, samples_before == 0 && stats.ending == Ending::finished);
}

void write_stats(const RenderOptions& options, const RenderStats& stats) {
  if (options.outputs.stats.empty()) return;
  AtomicFile out(options.outputs.stats);
  const std::string json = to_json(stats) + "\n";
  out.write(std::as_bytes(std::span(json)));
  out.commit();
}

void add_peak_of_picture(const RenderOptions& options, RenderStats& stats) {
  const std::uint64_t peak = peak_resident_bytes();
  if (stats.by_rank.empty() || peak <= stats.by_rank[0].peak_rss_bytes) return;
  stats.by_rank[0].peak_rss_bytes = peak;
  stats.peak_rss_bytes = std::max(stats.peak_rss_bytes, peak);
  write_stats(options, stats);
}

void require_kept_memory(const RenderStats& stats) {
  if (stats.memory_budget_bytes == 0 || stats.peak_rss_bytes <= stats.memory_budget_bytes) return;
  const auto of = std::ranges::max_element(stats.by_rank, {}, &RankStats::peak_rss_bytes);
  throw MachineError(
      fmt::format("rank {} took {:.1f}M of memory, and --memory allows {:.1f}M; what it made is whole",
                  of - stats.by_rank.begin(), static_cast<double>(stats.peak_rss_bytes) / bytes_a_mib,
                  static_cast<double>(stats.memory_budget_bytes) / bytes_a_mib));
}

}  // namespace vitrail
