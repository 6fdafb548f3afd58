// SPDX-License-Identifier: Apache-2.0
#include "farm/plan/job.h"

#include <malloc.h>

#include <algorithm>
#include <bit>

#include "farm/plan/about.h"
#include "farm/plan/job_manifest.h"
#include "scene/system/resource_usage.h"
#include "tracer/prepared/film_exponent.h"

namespace vitrail {

namespace {

// With what the table of lights takes by which photons leave them (Emission): for a moment the bounds of all
// lamps, in lists that grow.
SceneMemory memory_of(const RenderScene& scene, const std::string& about, std::uint64_t textures) {
  const std::uint64_t written = about.size();  // once more, in what a checkpoint writes
  SceneMemory memory{resident_bytes() + written, peak_resident_bytes(), textures};
  if (!scene.manifest.settings.photons) return memory;
  constexpr std::uint64_t kept = 24, for_a_moment = sizeof(LightBounds) + sizeof(std::uint32_t);
  const std::uint64_t lamps = scene.lights.scene.triangles.size() + scene.lights.quadrics.size();
  memory.peak = std::max(memory.peak, memory.resident + std::bit_ceil(lamps) * for_a_moment / 2 * 3);
  memory.resident += kept * lamps;
  return memory;
}

}  // namespace

Job set_up(const RenderOptions& options, const Place& place) {
  JobManifest read = read_job_manifest(options);
  const std::uint64_t textures = texture_budget(read.manifest, options.resources.memory_bytes);
  Job job;
  job.scene = std::make_unique<RenderScene>(std::move(read.manifest), options.bundle, textures,
                                            options.picture.seed, options.picture.samples.sampling);
  job.scene->groups = group_lights(options.picture.light_groups, job.scene->manifest).table;
  job.scene->replaced_camera = read.replaced_camera;
  if (options.picture.daylight) set_daylight(*job.scene, *options.picture.daylight);
  const Manifest& m = job.scene->manifest;
  job.about = about(m, options);  // with the names of all masks, where a film keeps masks
  ::malloc_trim(0);               // what was freed since the manifest was read
  job.plan = plan_job(m, options, place, memory_of(*job.scene, job.about, textures));
  std::shared_ptr<FilmScratch> scratch;
  if (job.plan.film.window > 0) scratch = std::make_shared<FilmScratch>(job.plan.film.window);
  job.film = Film(m.film, job.plan.key, film_exponent(*job.scene),
                  m.film.layers.any() ? length_exponent(*job.scene) : default_exponent, std::move(scratch));
  if (place.rank == 0 && !options.outputs.dry_run)
    job.keeper = std::make_unique<FilmKeeper>(options.outputs.film, film_file_bytes(m.film, job.plan.key));
  return job;
}

}  // namespace vitrail
