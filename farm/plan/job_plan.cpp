// SPDX-License-Identifier: Apache-2.0
#include "farm/plan/job_plan.h"
#include "bundle/reflectances/color_words.h"

#include <algorithm>

#include "farm/files/timeline.h"
#include "farm/plan/job_manifest.h"
#include "film/picture_format.h"
#include "film/picture_memory.h"
#include "scene/system/machine_limits.h"
#include "tracer/intersect/embree_domain.h"
#include "tracer/photons/photon_map.h"
#include "tracer/photons/sensor_discs.h"

namespace vitrail {

namespace {

std::uint64_t pixels_of(const PixelRect& c) {
  return static_cast<std::uint64_t>(c.x1 - c.x0) * static_cast<std::uint64_t>(c.y1 - c.y0);
}

// Of an adaptive round's numbers, and what it takes to find them, or those of the round before beside its
// own.
std::uint64_t map_bytes(const PixelRect& crop) {
  constexpr std::uint64_t held_and_more = 8, finding_them = 8;
  return pixels_of(crop) * (held_and_more + finding_them);
}

// Of sensors that photons measure at.
std::uint64_t disc_bytes(const Manifest& m, const FilmKey& key) {
  const auto* camera = std::get_if<SensorCamera>(&m.camera);
  return camera && key.photons.photons > 0 ? camera->sensors.size() * SensorDiscs::bytes_a_sensor : 0;
}

std::uint64_t base_bytes(const Manifest& m, const RenderOptions& options, const JobPlan& plan, int ranks) {
  const WorkPlan work = make_work_plan(m.film.crop, plan.goal.samples, {}, plan.goal.one_by_one);
  return plan.scene.resident + (plan.goal.adaptive ? map_bytes(m.film.crop) : 0) + list_bytes(work, ranks) +
         table_bytes(m.domains.size(), plan.threads) + connection_bytes(ranks) + disc_bytes(m, plan.key) +
         (options.resources.traversal == Traversal::embree ? embree_bytes(bytes_of_all(m)) : 0) +
         (options.outputs.profile.empty() ? 0 : profile_bytes(m.domains.size(), plan.threads)) +
         (options.outputs.trace.empty() ? 0 : Timeline::most_bytes(ranks));
}

constexpr std::uint64_t develop_bytes = 10 << 20;  // of vitrail-develop beside the film and the picture
constexpr std::uint64_t image_library = 136 << 20;

// Of vitrail-develop, which reads the film by rows. A picture was measured to take five eighths of what the
// film would; denoising 800 bytes a pixel, or from some size on 500 MiB and the network's own pictures.
std::uint64_t developing_bytes(const std::filesystem::path& picture, const PixelRect& crop,
                               std::uint64_t film_bytes, bool denoises) {
  constexpr std::uint64_t denoiser = 70 << 20, denoising_a_pixel = 800, tiles = 550 << 20, beside_tiles = 64;
  const std::uint64_t pixels = pixels_of(crop);
  const std::uint64_t denoising =
      denoiser + std::min(denoising_a_pixel * pixels, tiles + beside_tiles * pixels);
  return develop_bytes + (needs_image_library(picture_format(picture)) ? image_library : 0) +
         film_bytes / 8 * 5 + (denoises ? denoising : 0);
}

// Of rank 0 while it makes the picture, for which it reads the film again, an .exr, a PNG, a JPEG or a TIFF
// row by row. The latter three it makes itself: the colours as numbers, and as bytes. For others and for what
// is denoised it runs vitrail-develop.
std::uint64_t picture_bytes(const Manifest& m, const RenderOptions& options, const JobPlan& plan) {
  const std::filesystem::path& picture = options.outputs.picture;
  if (picture.empty() || options.outputs.dry_run) return 0;
  constexpr std::uint64_t a_pixel = 24, encoder = 2 << 20;
  const PixelRect& c = m.film.crop;
  const std::uint64_t by_rows = exr_memory(m.film, plan.key);
  const PictureFormat format = picture_format(picture);
  if (!options.outputs.denoises) {
    if (written_by_render(format)) return plan.scene.resident + a_pixel * pixels_of(c) + encoder + by_rows;
    if (format == PictureFormat::exr) return plan.scene.resident + by_rows + develop_bytes;
  }
  return plan.scene.resident + by_rows +
         developing_bytes(picture, c, plan.film.bytes, options.outputs.denoises);
}

// Of rank 0 while it shows checkpoints and goes on rendering: of the preview's program, and of the colours
// and the packets for a viewer.
std::uint64_t showing_bytes(const Manifest& m, const RenderOptions& options, const JobPlan& plan) {
  if (options.outputs.dry_run) return 0;
  std::uint64_t bytes = 0;
  if (!options.outputs.preview.empty())
    bytes += exr_memory(m.film, plan.key) +
             developing_bytes(options.outputs.preview, m.film.crop, plan.film.bytes, false);
  if (options.outputs.displays) {
    constexpr std::uint64_t a_pixel = 12, most_of_packet = std::uint64_t{1} << 20, copies = 2;
    const std::uint64_t pixels = pixels_of(m.film.crop);
    bytes += exr_memory(m.film, plan.key) + a_pixel * (pixels + copies * std::min(pixels, most_of_packet));
  }
  return bytes;
}

// What `--memory` sets aside at least for the photons that land on a rank: others wait on the disk.
std::size_t least_room(const PhotonKey& key, std::uint64_t memory_bytes) {
  constexpr std::uint64_t least_bytes = 2 << 20, landings_of_each = 3;
  if (memory_bytes == 0 || key.photons == 0) return 0;
  return static_cast<std::size_t>(
      std::min(landings_of_each * key.photons, least_bytes / PhotonMap::photon_bytes));
}

// Gives photons what no domain needs, or half of what the largest leaves, as much as they need.
void widen_room(JobPlan& plan, std::uint64_t largest_domain) {
  if (plan.most_photons == 0) return;
  const std::uint64_t have = plan.memory.domains_bytes;
  const std::uint64_t unused = have > plan.all_domains ? have - plan.all_domains : 0;
  const std::uint64_t wanted = 3 * plan.key.photons.photons * PhotonMap::photon_bytes;
  const std::uint64_t more = std::max(unused, std::min(wanted, (have - std::min(have, largest_domain)) / 2));
  plan.most_photons += more / PhotonMap::photon_bytes;
  plan.memory.domains_bytes -= more;
}

// Where ranks do not trace in all domains, homes may settle. A profile takes an eighth of the room at most:
// with less for domains the job might wait for the disk.
void set_profile_aside(JobPlan& plan, const Manifest& m, const RenderOptions& options, int ranks,
                       std::uint64_t largest_domain) {
  const JobResources& r = options.resources;
  const std::uint64_t room = plan.memory.domains_bytes;
  const bool all_are_local = r.distribution == Distribution::replicate ||
                             (r.distribution == Distribution::automatic && plan.all_domains <= room);
  if (ranks == 1 || !r.homes.empty() || r.homes_stay || options.outputs.dry_run ||
      plan.key.photons.photons > 0 || all_are_local)
    return;
  const std::uint64_t bytes =
      options.outputs.profile.empty() ? profile_bytes(m.domains.size(), plan.threads) : 0;
  if (bytes > room / 8 || room - bytes < largest_domain) return;
  plan.may_settle = true;
  plan.profile_bytes = bytes;
  plan.memory.domains_bytes -= bytes;
}

// Memory for domains, rays, and photons that land. On rank 0 a picture is made in the end.
void share_out(JobPlan& plan, const Manifest& m, const RenderOptions& options, const Place& place) {
  const int rank = place.rank;
  const std::uint64_t budget = options.resources.memory_bytes;
  const LargestDomain largest = largest_domain(m);
  plan.most_photons = least_room(plan.key.photons, budget);
  plan.film = {film_bytes(m.film, plan.key), 0};
  const std::uint64_t base = plan.base_bytes + plan.scene.textures +
                             PhotonMap::photon_bytes * plan.most_photons +
                             (rank == 0 ? showing_bytes(m, options, plan) : 0);
  const auto peak = [&] {
    return std::max(plan.scene.peak, rank == 0 ? picture_bytes(m, options, plan) : 0);
  };
  plan.film =
      place_film(plan.film.bytes, budget, base, peak(), plan.threads, largest.bytes, plan.all_domains);
  const std::uint64_t beside_tiles = texture_budget(m, 1);
  const TileMemory tiles{plan.scene.textures - beside_tiles, texture_budget(m, 0) - beside_tiles};
  plan.memory = plan_memory(budget, base + plan.film.resident(), peak(), plan.threads, largest,
                            plan.all_domains, tiles);
  widen_window(plan.film, plan.memory, largest.bytes, plan.all_domains);
  if (options.resources.domain_memory_bytes > 0)
    plan.memory = {
        std::max(largest.bytes, std::min(plan.memory.domains_bytes, options.resources.domain_memory_bytes)),
        few_rays_bytes};
  set_profile_aside(plan, m, options, place.ranks, largest.bytes);
  widen_room(plan, largest.bytes);
}

Homes homes_of(const Manifest& manifest, const RenderOptions& options, int ranks) {
  if (options.resources.homes.empty()) return homes_by_bytes(manifest, ranks);
  return homes_by_work(manifest, read_ray_profile(options.resources.homes), ranks);
}

}  // namespace

std::uint64_t texture_budget(const Manifest& m, std::uint64_t memory_bytes) {
  std::uint64_t all = 0, codes = 0;
  for (const TextureFileEntry& t : m.texture_files) {
    all += std::max(t.bytes, t.read_bytes);
    codes += t.read_bytes;
  }
  all *= 2;  // tiles at an edge are smaller in the file than in memory
  return (codes > 0 ? conversion_bytes : 0) +
         (memory_bytes == 0 ? all : std::min(all, memory_bytes / tile_share));
}

std::uint64_t film_file_bytes(const FilmSettings& film, const FilmKey& key) {
  constexpr std::uint64_t header_and_words = 16 << 10;
  const std::uint64_t sums = film_bytes(film, key);
  return sums + sums / 32 + header_and_words;
}

JobPlan plan_job(const Manifest& m, const RenderOptions& options, const Place& place,
                 const SceneMemory& scene) {
  JobPlan plan;
  plan.threads = threads_for(options.resources.threads);
  plan.goal = goal_of(options, m.settings);
  plan.key = key_of(m, options.picture);
  plan.scene = scene;
  plan.base_bytes = base_bytes(m, options, plan, place.ranks);
  plan.all_domains = bytes_of_all(m);
  share_out(plan, m, options, place);
  plan.homes = homes_of(m, options, place.ranks);
  plan.queues = plan.key.photons.photons > 0 ? queue_bounds_with_photons(plan.memory, place.ranks)
                                             : queue_bounds(plan.memory, place.ranks);
  const bool in_flow = is_in_flow(m, plan.homes, options.resources.distribution, plan.memory.domains_bytes);
  const std::int64_t rays_a_rank =
      in_flow ? rays_allowed_in_flow(plan.threads) : rays_allowed_a_rank(plan.memory);
  plan.scheduler = {place.ranks, plan.threads, rays_a_rank * place.ranks, place.rank};
  return plan;
}

}  // namespace vitrail
