// SPDX-License-Identifier: Apache-2.0
#include "farm/render.h"

#include <fmt/format.h>
#include <malloc.h>

#include <algorithm>
#include <cstdio>
#include <thread>

#include "bundle/checksum.h"
#include "bundle/manifest_json.h"
#include "farm/about.h"
#include "farm/agreement.h"
#include "farm/film_size.h"
#include "farm/gather_profile.h"
#include "farm/gather_timeline.h"
#include "farm/memory.h"
#include "farm/rank.h"
#include "farm/same_job.h"
#include "farm/signals.h"
#include "scene/atomic_file.h"
#include "scene/output_place.h"
#include "scene/resource_usage.h"
#include "scene/say.h"
#include "scene/sensor_file.h"
#include "tracer/film_exponent.h"

namespace vitrail {

namespace {

void override_layers(Manifest& m, const RenderOptions& options) {
  const FilmLayers kept = m.film.layers;
  if (options.layers) m.film.layers.bits = *options.layers;
  if (options.layers_in_camera_space) m.film.layers.in_camera_space = *options.layers_in_camera_space;
  const auto require = [&](Layer layer, bool there, const char* what) {
    if (m.film.layers.has(layer) && !there)
      throw Error(fmt::format("the bundle keeps no {0}: partition the scene with --aov {1}", what,
                              kind_of(layer).name),
                  {options.bundle.string()});
  };
  require(Layer::uv, m.requirements.uv, "(u,v), as nothing in the scene needs them");
  require(Layer::shape, kept.has(Layer::shape), "account of which shape is which");
}

// They belong to what the film is of.
void put_sensors(Manifest& m, const RenderOptions& options) {
  if (options.width || options.height || options.scale != 1 || options.crop || options.bins ||
      options.layers || options.samples.filter)
    throw UsageError(
        "--sensors has no picture whose size, crop, filter, spectrum or channels could be given");
  SensorCamera camera{translate(-m.offset), read_sensors(options.sensors)};
  m.film = sensor_film(camera.sensors.size());
  m.camera = std::move(camera);
  m.camera_motion = {};
  ++m.settings.max_depth;  // the sensor's own event
  Hasher hasher;
  hasher.add(std::as_bytes(std::span(&m.scene_hash, 1)));
  const std::string text = camera_to_json(m.camera).dump();
  hasher.add(std::as_bytes(std::span(text)));
  m.scene_hash = hasher.digest();
}

void check_splat(const Manifest& m, const RenderOptions& options) {
  if (!options.samples.sampling.splat) return;
  if (options.adaptive || options.target_error)
    throw UsageError(
        "--splat makes the errors of neighbours alike, which --adaptive, --target-error and --quality take "
        "for "
        "independent: give --spp instead");
  if (std::holds_alternative<SensorCamera>(m.camera))
    throw UsageError("--splat is of pictures: sensors are no neighbours of each other");
  const auto [x, y] =
      std::visit([](const auto& f) { return std::pair(f.radius_x, f.radius_y); }, m.film.filter);
  if (std::max(x, y) > greatest_splat_radius)
    throw UsageError(fmt::format("--splat takes filters of up to {} pixels in radius, this one has {}",
                                 greatest_splat_radius, std::max(x, y)));
}

Manifest read_with_overrides(const RenderOptions& options) {
  Manifest m = read_manifest(options.bundle);
  if (m.domains.size() > max_domains) throw Error("more than 65535 domains", {options.bundle.string()});
  m.settings.samples_per_pixel = static_cast<int>(goal_of(options, m.settings.samples_per_pixel).samples);
  set_sheets(options.sheets, options.bundle, m);
  if (options.max_depth) m.settings.max_depth = *options.max_depth;
  if (options.direct_only) m.settings.direct_only = *options.direct_only;
  if (options.threshold > 0 && !m.settings.direct_only)
    throw UsageError("--threshold is of direct light alone: give --integrator direct too");
  if (m.settings.samples_per_pixel < 1 ||
      static_cast<std::uint32_t>(m.settings.samples_per_pixel) >= max_samples)
    throw UsageError(fmt::format("samples a pixel must be between 1 and {}", max_samples - 1));
  if (options.target_error && m.settings.samples_per_pixel < 4)
    throw UsageError("an error is estimated from 4 samples a pixel or more: give --spp more than that");
  if (m.settings.max_depth < 0) throw UsageError("the depth must not be negative");
  if (!options.sensors.empty()) put_sensors(m, options);
  m.settings.max_depth = std::min(
      m.settings.max_depth, m.settings.direct_only || options.photons ? max_direct_depth : max_path_depth);
  resize_film(m, options);
  if (options.crop) m.film.crop = *options.crop;
  if (options.bins) m.film.spectrum = *options.bins;
  override_layers(m, options);
  apply(options.samples, m);
  check_splat(m, options);
  const PixelRect& c = m.film.crop;
  if (c.x0 < 0 || c.y0 < 0 || c.x1 > m.film.width || c.y1 > m.film.height || c.x0 >= c.x1 || c.y0 >= c.y1)
    throw UsageError("the crop lies outside the film or is empty");
  return m;
}

FilmKey key_of(const Manifest& m, const RenderOptions& options) {
  FilmKey key;
  key.scene_hash = m.scene_hash;
  key.seed = options.seed;
  key.max_depth = m.settings.max_depth;
  key.direct_only = m.settings.direct_only;
  if (key.direct_only) key.threshold = rounded_threshold(options.threshold);
  key.straight_counts = m.settings.straight_counts;
  key.clamp = options.clamp;
  key.splats = options.samples.sampling.splat;
  key.photons = photons_of(options, m);
  return key;
}

struct Job {
  std::unique_ptr<RenderScene> scene;
  Film film;
  std::uint64_t texture_bytes = 0;
};

// For tiles of images: all of them if there is no limit, else a quarter of it at most.
std::uint64_t texture_budget(const Manifest& m, std::uint64_t memory_bytes) {
  std::uint64_t all = 0;
  for (const TextureFileEntry& t : m.texture_files) all += t.bytes;
  all *= 2;  // tiles at an edge are smaller in the file than in memory
  return memory_bytes == 0 ? all : std::min(all, memory_bytes / 4);
}

Job set_up(const RenderOptions& options) {
  Manifest manifest = read_with_overrides(options);
  const std::uint64_t textures = texture_budget(manifest, options.memory_bytes);
  auto scene = std::make_unique<RenderScene>(std::move(manifest), options.bundle, textures, options.seed,
                                             options.samples.sampling);
  return {std::move(scene), {}, textures};
}

MemoryPlan plan_for(const Manifest& manifest, const RenderOptions& options, int threads, std::uint64_t base,
                    std::uint64_t setup_peak) {
  std::uint64_t largest = 0;
  for (std::uint32_t d = 0; d < manifest.domains.size(); ++d)
    largest = std::max(largest, bytes_needed(manifest, d));
  MemoryPlan plan =
      plan_memory(options.memory_bytes, base, setup_peak, threads, largest, bytes_of_all(manifest));
  if (options.domain_memory_bytes > 0)
    plan = {std::max(largest, std::min(plan.domains_bytes, options.domain_memory_bytes)), few_rays_bytes};
  return plan;
}

Homes homes_of(const Manifest& manifest, const RenderOptions& options, int ranks) {
  if (options.homes.empty()) return homes_by_bytes(manifest, ranks);
  return homes_by_work(manifest, read_ray_profile(options.homes), ranks);
}

// Of a film's file: its sums, and what it says of itself.
std::uint64_t file_bytes(const FilmSettings& film, bool splats) {
  constexpr std::uint64_t header_and_words = 16 << 10;
  const std::uint64_t sums = film_bytes(film, splats);
  return sums + sums / 32 + header_and_words;
}

// Of an adaptive round's numbers, and what it takes to find them, or those of the round before beside its
// own.
std::uint64_t map_bytes(const PixelRect& crop) {
  constexpr std::uint64_t held_and_more = 8, finding_them = 8;
  return static_cast<std::uint64_t>(crop.x1 - crop.x0) * static_cast<std::uint64_t>(crop.y1 - crop.y0) *
         (held_and_more + finding_them);
}

std::uint64_t pixels_without_samples(const Film& film) {
  std::uint64_t none = 0;
  for (std::uint32_t p = 0; p < film.pixels(); ++p)
    if (film.samples(p) == 0) ++none;
  return none;
}

double minutes(double s) { return s / 60; }

// From what was done until the time limit. The first samples of a picture may be cheaper than its others.
void print_estimate(const RenderStats& s, const MemoryPlan& memory, std::uint64_t all_domains,
                    std::uint64_t samples_before, std::uint64_t samples_in_all) {
  constexpr double mib = 1 << 20;
  fmt::print("memory of a rank: {:.0f} MiB of program, film and textures, {:.0f} MiB of domains{}\n",
             static_cast<double>(s.base_rss_bytes) / mib,
             static_cast<double>(std::min(memory.domains_bytes, all_domains)) / mib,
             memory.domains_bytes < all_domains
                 ? fmt::format(" of {:.0f}: they come and go", static_cast<double>(all_domains) / mib)
                 : "");
  const double here = static_cast<double>(s.samples - samples_before),
               left = static_cast<double>(samples_in_all - s.samples) + here;
  if (left > 0 && here > 0)
    fmt::print(
        "time: about {:.1f} min on {} × {} threads for {:.3g} million samples, by {:.3g} million that took "
        "{:.1f} s\n",
        minutes(s.wall_s * left / here), s.ranks, s.threads, left * 1e-6, here * 1e-6, s.wall_s);
}

void write_stats(const std::filesystem::path& file, const RenderStats& stats) {
  AtomicFile out(file);
  const std::string json = to_json(stats) + "\n";
  out.write(std::as_bytes(std::span(json)));
  out.commit();
}

}  // namespace

RenderStats render(Transport& transport, const RenderOptions& options) {
  const auto start = std::chrono::steady_clock::now();
  ::mallopt(M_ARENA_MAX, 2);  // an arena a thread would keep memory that the budget does not know of
  catch_signals();
  const int threads = options.threads > 0
                          ? options.threads
                          : std::max(1, static_cast<int>(std::thread::hardware_concurrency()));
  RenderStats stats;
  std::optional<Job> job;
  Goal goal;
  MemoryPlan memory;
  std::optional<FilmKeeper> keeper;
  PhotonKey photons;
  std::optional<Homes> homes;
  std::size_t most_photons = 0;  // that land here in an iteration; 0: no limit
  agree(transport, [&] {
    job = set_up(options);
    // Refused before it takes the memory.
    const Manifest& m = job->scene->manifest;
    goal = goal_of(options, m.settings.samples_per_pixel);
    stats.base_rss_bytes =
        resident_bytes() + film_bytes(m.film, options.samples.sampling.splat) +
        (goal.adaptive ? map_bytes(m.film.crop) : 0) +
        list_bytes(make_work_plan(m.film.crop, goal.samples, {}, goal.one_by_one), transport.size()) +
        table_bytes(m.domains.size(), threads) + connection_bytes(transport.size()) +
        (options.trace.empty() ? 0 : Timeline::most_bytes(transport.size()));
    stats.setup_peak_rss_bytes = peak_resident_bytes();
    photons = photons_of(options, m);
    most_photons = least_room(photons, options.memory_bytes);
    memory = plan_for(m, options, threads,
                      stats.base_rss_bytes + job->texture_bytes + PhotonMap::photon_bytes * most_photons,
                      stats.setup_peak_rss_bytes);
    // What no domain needs is room for more landings.
    if (const std::uint64_t all = bytes_of_all(m); most_photons > 0 && memory.domains_bytes > all) {
      most_photons += (memory.domains_bytes - all) / PhotonMap::photon_bytes;
      memory.domains_bytes = all;
    }
    job->film = Film(m.film, key_of(m, options), film_exponent(*job->scene),
                     m.film.layers.any() ? length_exponent(*job->scene) : default_exponent);
    homes = homes_of(m, options, transport.size());
    if (transport.rank() == 0 && !options.dry_run)
      keeper.emplace(options.film, file_bytes(m.film, options.samples.sampling.splat));
  });
  const Manifest& manifest = job->scene->manifest;
  expect_same_job(transport, manifest, job->film.key(), goal, *homes, options);
  EarlierWork earlier = read_earlier_work(transport, options, job->film, goal);
  const std::uint64_t samples_before = job->film.samples();  // on rank 0

  const bool in_flow = is_in_flow(manifest, *homes, options.distribution, memory.domains_bytes);
  const std::int64_t rays_a_rank = in_flow ? rays_allowed_in_flow(threads) : rays_allowed_a_rank(memory);
  const Scheduler::Job of_this_rank{transport.size(), threads, rays_a_rank * transport.size(),
                                    transport.rank()};
  const QueueBounds bounds = queue_bounds(memory, transport.size());
  RankState state(*job->scene, job->film, std::move(earlier.plan),
                  RayQueues(manifest.domains.size(), bounds.waiting, options.shuffle_seed),
                  RayQueues(manifest.domains.size(), bounds.outgoing, std::nullopt),
                  Scheduler(of_this_rank, Residency(manifest, memory.domains_bytes, *homes, transport.rank(),
                                                    options.distribution)),
                  options.bundle);
  state.most_sent_bytes = bounds.being_sent;
  if (photons.photons > 0)
    state.photons.emplace(*job->scene, photons, most_photons, *homes, transport.rank(), transport.size());
  if (transport.rank() == 0 && !options.quiet && manifest.lights.empty() && manifest.area_lights.empty())
    say("vitrail: the scene has no light: its picture is black\n");
  if (!options.profile.empty()) state.traffic.emplace(manifest.domains.size());
  if (!options.trace.empty()) state.timeline.emplace(Timeline::most_events(transport.size()));
  stats.finished_before = earlier.finished;
  Rank rank(transport, state, options, goal, std::move(earlier), about(manifest, options),
            keeper ? &*keeper : nullptr);
  if (stats.finished_before) {
    stats.ending = Ending::finished;
  } else {
    if (transport.rank() == 0) print_start(options, manifest, goal, transport.size(), threads);
    std::optional<Workers> workers;
    agree(transport, [&] { workers.emplace(state, threads); });
    stats.ending = rank.run();
  }
  rank.add_to(stats);
  stats.ranks = transport.size();
  stats.threads = threads;
  stats.spectral_bins = manifest.film.spectrum.count;
  stats.spp = static_cast<std::uint64_t>(manifest.settings.samples_per_pixel);
  stats.seed = options.seed;
  stats.adaptive = goal.adaptive;
  stats.rounds = stats.finished_before ? 0 : rank.rounds();
  stats.domains_total = manifest.domains.size();
  stats.memory_budget_bytes = options.memory_bytes;
  stats.peak_rss_bytes = peak_resident_bytes();
  stats.cpu_s = cpu_seconds();
  stats.wall_s = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
  gather_stats(transport, stats, state.domains.touched());
  std::optional<RayProfile> profile;
  if (state.traffic) profile = gather_profile(transport, manifest, *state.traffic, stats);
  // What fails on rank 0 ends the job everywhere.
  const auto conclude = [&] {
    stats.samples = job->film.samples();
    if (options.dry_run) {
      print_estimate(stats, memory, bytes_of_all(manifest), samples_before,
                     std::uint64_t{goal.samples} * job->film.pixels());
      return;
    }
    if (goal.target) {
      stats.target = *goal.target;
      stats.reached = reached_error(job->film, *goal.target);
    }
    if (stats.ending == Ending::finished && stats.reached.upper > stats.target.value)
      say("vitrail: the error is not reached with {} samples a pixel; --spp allows for more\n", goal.samples);
    if (const std::uint64_t none = pixels_without_samples(job->film); none > 0 && writes_film(stats.ending))
      say("vitrail: {} of {} pixels have no sample yet and are black\n", none, job->film.pixels());
    stats.refused = job->film.refused();
    if (stats.refused.nonfinite > 0)
      say("vitrail: {} samples were not finite and count as black\n", stats.refused.nonfinite);
    stats.clamped_share = job->film.clamped_share();
    if (options.clamp > 0 && !options.quiet)
      say("vitrail: --clamp {} took {:.3g} % of the light: so much darker is the picture\n", options.clamp,
          100 * stats.clamped_share);
    print_wedges(options, stats.traced);
    stats.film_hash = job->film.hash();
    print_end(options, stats, job->film.pixels());
    // The film holds all that the checkpoint does.
    if (writes_film(stats.ending)) std::filesystem::remove(checkpoint_path(options.film));
    if (!options.stats.empty()) write_stats(options.stats, stats);
    if (!options.profile.empty()) {
      if (samples_before == 0 && stats.ending == Ending::finished)
        write_ray_profile(options.profile, *profile);
      else
        say("vitrail: {} is not written: a profile counts the rays of a whole picture, rendered without "
            "a stop\n",
            options.profile.string());
    }
  };
  agree(transport, [&] {
    if (transport.rank() == 0) conclude();
  });
  if (state.timeline) write_timelines(transport, *state.timeline, threads, start, options.trace);
  return stats;
}

}  // namespace vitrail
