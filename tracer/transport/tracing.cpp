// SPDX-License-Identifier: Apache-2.0
#include "tracer/transport/tracing.h"

#include <cmath>

#include "tracer/transport/group_lights.h"

namespace vitrail {

TraceCounters& operator+=(TraceCounters& a, const TraceCounters& b) {
  a.rays_camera += b.rays_camera;
  a.rays_indirect += b.rays_indirect;
  a.rays_shadow += b.rays_shadow;
  a.crossings += b.crossings;
  a.born += b.born;
  a.died += b.died;
  a.photons_emitted += b.photons_emitted;
  a.gathers += b.gathers;
  a.photons_gathered += b.photons_gathered;
  a.connections_in_glass += b.connections_in_glass;
  a.connections_in_wedges += b.connections_in_wedges;
  a.widest_wedge_nrad = std::max(a.widest_wedge_nrad, b.widest_wedge_nrad);
  return a;
}

SampleKey key_of(const Tracing& tracing, std::uint32_t pixel, std::uint32_t sample) {
  const Film& film = tracing.film;
  const auto width = static_cast<std::uint32_t>(film.width());
  const auto x = static_cast<std::uint32_t>(film.crop().x0) + pixel % width;
  const auto y = static_cast<std::uint32_t>(film.crop().y0) + pixel / width;
  if (tracing.scene.daylight.patches) {
    // The samples of all rows are one sequence, in which those of a group stay in it.
    const auto rows = static_cast<std::uint32_t>(film.full_height());
    return {tracing.scene.seed, x, (sample / sample_groups * rows + y) * sample_groups + group_of(sample)};
  }
  return {tracing.scene.seed, y * static_cast<std::uint32_t>(film.full_width()) + x, sample};
}

namespace {

// Of an iteration of photons, the part that a sample of the film belongs to; null: none fly.
const PhotonPass::Part* part_of(const Tracing& tracing, const SampleKey& key) {
  if (!tracing.photons) return nullptr;
  const auto row = key.pixel / static_cast<std::uint32_t>(tracing.film.full_width());
  return &tracing.photons->parts[tracing.photons->part_of_row(static_cast<int>(row))];
}

}  // namespace

std::array<float, 4> camera_numbers(const Tracing& tracing, const SampleKey& key) {
  const std::array<float, 4> u = sample_4d(key, sample_set::camera);
  const float quarter = std::floor(4 * u[3]);
  const PhotonPass::Part* const shared = part_of(tracing, key);
  return {u[0], u[1], shared ? shared->wavelength_number : number_of_hero(u[2], quarter), 4 * u[3] - quarter};
}

double time_of(const Tracing& tracing, const SampleKey& key) {
  if (!tracing.requirements().motion) return 0;
  const PhotonPass::Part* const shared = part_of(tracing, key);
  return time_at(tracing, shared ? shared->time_number : sample_4d(key, sample_set::time, Wanted::two)[0]);
}

double time_at(const Tracing& tracing, float number) {
  const Shutter& shutter = tracing.manifest().shutter;
  return shutter.open_s + static_cast<double>(number) * (shutter.close_s - shutter.open_s);
}

SensorWeights sensor_of(const Tracing& tracing, const std::array<float, 4>& camera,
                        const SampledWavelengths& wavelengths) {
  return sensor_weights(wavelengths, tracing.scene.filter.weight(camera[0], camera[1]), tracing.film.bins(),
                        observer_of(tracing.scene));
}

const Footprint* footprint_of(Tracing& tracing, std::uint32_t pixel, std::uint32_t sample) {
  if (!tracing.scene.sampling.splat) return nullptr;
  if (const std::uint64_t of = std::uint64_t{pixel} << 32 | sample; of != tracing.landed.of) {
    const std::array<float, 4> u = camera_numbers(tracing, key_of(tracing, pixel, sample));
    tracing.landed = {of, tracing.scene.filter.footprint(u[0], u[1])};
  }
  return &tracing.landed.footprint;
}

void deposit(Tracing& tracing, std::uint32_t pixel, std::uint32_t sample, const SensorWeights& sensor,
             const SampledSpectrum& radiance, const LitBy& by) {
  Film& film = tracing.film;
  if (const DaylightRows& daylight = tracing.scene.daylight; daylight.patches) [[unlikely]]
    pixel =
        pixel % static_cast<std::uint32_t>(film.width()) +
        static_cast<std::uint32_t>(daylight.row_of(by.direction)) * static_cast<std::uint32_t>(film.width());
  const XYZ light = sense(sensor, radiance);
  const double left = film.clamp(pixel, sample, light);
  const Footprint* const spread = footprint_of(tracing, pixel, sample);
  const XYZ value{left * light.x, left * light.y, left * light.z};
  const bool is_accepted =
      tracing.sums ? tracing.sums->deposit(pixel, sample, value)
      : !tracing.scene.groups.kept_apart
          ? film.deposit(pixel, sample, value, spread)
          : deposit_in_groups(tracing, {pixel, sample, &sensor, left, spread}, radiance, value, by);
  if (!is_accepted || film.bins().count == 0) return;
  for (std::size_t i = 0; i < hero_count; ++i) {
    const double in_bin = left * static_cast<double>(radiance.v[i]) * static_cast<double>(sensor.spectral[i]);
    if (in_bin != 0) film.deposit_bin(pixel, sample, sensor.bin[i], in_bin, spread);
  }
}

}  // namespace vitrail
