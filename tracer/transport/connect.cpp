// SPDX-License-Identifier: Apache-2.0
#include "tracer/transport/connect.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "scene/geometry/portable_math.h"
#include "tracer/media/phase.h"
#include "tracer/rays/connection_code.h"
#include "tracer/sampling/candidate_numbers.h"
#include "tracer/sampling/power_heuristic.h"
#include "tracer/transport/connection.h"

namespace vitrail {

namespace {

double slope_of(double cosine) { return std::sqrt(std::max(0.0, 1 - cosine * cosine)) / std::abs(cosine); }

static_assert(most_light_candidates == most_candidates);

double sum_of(const SampledSpectrum& s) {
  double sum = 0;
  for (const float x : s.v) sum += static_cast<double>(x);
  return sum;
}

const PointEmitter* emitter_of(const Tracing& tracing, const LightSample& light) {
  return light.light.kind == LightKind::emitter ? &tracing.scene.lights.emitters[light.light.index] : nullptr;
}

// Whether nothing stands in its way.
bool is_shadowless(const Tracing& tracing, const LightSample& light) {
  const PointEmitter* const emitter = emitter_of(tracing, light);
  return emitter && !emitter->casts_shadows;
}

// One that `path` leaves for a light, with what it is to bring.
void send_connection(const Tracing& tracing, const CameraPath& path, const Departure& from,
                     const LightSample& light, const SampledSpectrum& radiance, bool walks,
                     Connections& waiting) {
  Connection& c = add_connection(path, waiting);
  const PointEmitter* const emitter = emitter_of(tracing, light);
  c.passes_veils = emitter && emitter->fading;
  c.light_group = tracing.scene.groups.of(tracing.scene.lights, light.light);
  c.throughput = radiance;
  c.walks = walks;
  const Aimed aimed = aim(from, light);
  c.depth = path.depth;
  depart(c, from, light.to_light);
  turn(c, aimed.direction);
  c.depth = walks ? 0 : path.depth + 1;
  if (walks)
    c.refracted = {tracing.scene.lights.distant[light.light.index].light & RefractedAim::light_mask};
  else
    end_at(c, aimed.end, slope_of(aimed.cosine));
}

void send_shadow_ray(const RenderScene& scene, const CameraPath& path, const Departure& from,
                     const LightSample& light, const SampledSpectrum& radiance, ShadowRays& shadows) {
  const Aimed aimed = aim(from, light);
  ShadowRay& shadow = shadows.rays[shadows.count++];
  shadow.ray = {from.origin, aimed.rounded, from.exclude};
  shadow.direction = aimed.direction;
  shadow.tmax = std::isinf(light.distance) ? std::numeric_limits<float>::max() : float_below(aimed.end);
  for (std::size_t i = 0; i < hero_count; ++i)
    shadow.radiance.v[i] = rounded_radiance(std::max(0.0f, radiance.v[i]));
  shadow.pixel = path.film.pixel;
  shadow.sample = path.film.sample;
  shadow.light_group = scene.groups.of(scene.lights, light.light);
  shadow.time_s = path.time_s;
  shadow.sensor = &path.film.sensor;
}

std::array<float, 4> numbers_for_light(const Tracing& tracing, const CameraPath& path) {
  if (path.passed) return hashed_4d(stream_of(path, RayRandom::light));
  return sample_4d(path.key, sample_set::light(path.numbered_depth()),
                   tracing.scene.lights.three_numbers ? Wanted::three : Wanted::four);
}

// `scatter(light)` gives the value and the density of scattering to there, `depart(direction)` where the ray
// starts.
template <class Scatter, class Depart>
void connect(Tracing& tracing, const CameraPath& path, Point3d p, std::uint32_t count, const Scatter& scatter,
             const Depart& depart, ShadowRays& shadows) {
  const std::array<float, 4> numbers = numbers_for_light(tracing, path);
  const std::array<float, 2> far = numbers_for_far_lights(tracing, path.key);
  LightChooser lights(tracing.scene.lights, p, far, path.wavelengths, path.lamp);
  double choice = static_cast<double>(path.film.camera[3]);
  std::optional<LightSample> light;
  SampledSpectrum radiance;
  double all = 0, chosen = 0;
  for (std::uint32_t k = 0; k < count; ++k) {
    const auto candidate = lights.sample(k > 0 ? numbers_of_candidate(numbers, k) : numbers);
    if (!candidate) continue;
    const BsdfValue scattered = scatter(*candidate);
    const double beside = candidate->is_delta ? 0 : static_cast<double>(density_beside(scattered.pdf, count));
    const double weight = power_heuristic(candidate->pdf, beside) / candidate->pdf;
    const SampledSpectrum brought =
        path.throughput * scattered.value * candidate->radiance * static_cast<float>(weight);
    const double target = sum_of(brought);
    if (target <= 0) continue;
    all += target;
    if (chosen > 0) {
      // One number for all choices: what is left of it after one is as random as it was.
      const double share = target / all;
      if (choice >= share) {
        choice = (choice - share) / (1 - share);
        continue;
      }
      choice /= share;
    }
    light = candidate;
    radiance = brought;
    chosen = target;
  }
  if (all == 0) return;
  if (count > 1) radiance = radiance * static_cast<float>(all / (count * chosen));
  ++tracing.counters.rays_shadow;
  send(tracing, path, depart(light->to_light), *light, radiance, shadows);
}

}  // namespace

void send(Tracing& tracing, const CameraPath& path, const Departure& from, const LightSample& light,
          const SampledSpectrum& radiance, ShadowRays& shadows) {
  if (is_shadowless(tracing, light))
    return deposit(tracing, path.film, radiance,
                   {tracing.scene.groups.of(tracing.scene.lights, light.light), cast<float>(light.to_light)});
  const bool distant = std::isinf(light.distance);
  const Requirements& r = tracing.requirements();
  const bool straight = tracing.settings().direct_only;
  const bool walks = distant && light.is_delta && tracing.scene.materials.have_panes() && !straight;
  if (r.see_through || r.media || walks || (r.refraction && straight))
    send_connection(tracing, path, from, light, radiance, walks, shadows.connections);
  else
    send_shadow_ray(tracing.scene, path, from, light, radiance, shadows);
}

std::uint32_t light_candidates(const Tracing& tracing, const CameraPath& path, Point3d p, bool diffuse) {
  if (path.pdf > 0) return 1;
  const std::uint32_t several = tracing.scene.sampling.light_candidates;
  switch (variety(tracing.scene.lights, p)) {
    case Variety::none:
      return 1;
    case Variety::little:
      return diffuse ? 1 : several;
    default:
      return several;
  }
}

void connect_surface(Tracing& tracing, const CameraPath& path, const Event& event,
                     const Scattering& scattering, Vector3d out, std::uint32_t candidates,
                     ShadowRays& shadows) {
  const Interaction& at = event.at;
  const auto scatter = [&](const LightSample& light) -> BsdfValue {
    const Vector3d direction = light.to_light;
    const Vector3d in = scattering.frame.to_local(direction);
    // As for the samples of the BSDF: shading normals let no light leak.
    if (!scattering.transmits &&
        (dot(direction, at.geometric) > 0) != (dot(at.out, at.geometric) * out.z * in.z > 0))
      return {};
    BsdfValue scattered =
        eval(is_shadowless(tracing, light) ? without_highlights(scattering.bsdf) : scattering.bsdf, out, in);
    scattered.value =
        scattered.value * static_cast<float>(scattering.bump_shadowing(dot(direction, at.shading)));
    return scattered;
  };
  const auto depart = [&](Vector3d direction) {
    return departure(tracing, path, at, event.surface, direction);
  };
  connect(tracing, path, at.p, candidates, scatter, depart, shadows);
}

void connect_medium(Tracing& tracing, const CameraPath& path, const Departure& from, double g, Vector3d out,
                    std::uint32_t candidates, ShadowRays& shadows) {
  const auto scatter = [&](const LightSample& light) -> BsdfValue {
    const double value = phase(g, out, light.to_light);
    return {filled(static_cast<float>(value)), value};
  };
  connect(
      tracing, path, from.p, candidates, scatter, [&](Vector3d) { return from; }, shadows);
}

void connect_sensor(Tracing& tracing, const CameraPath& path, const Departure& from, Vector3d normal,
                    std::uint32_t candidates, ShadowRays& shadows) {
  const auto scatter = [&](const LightSample& light) -> BsdfValue {
    const double value = std::max(0.0, dot(normal, light.to_light)) / pi;
    return {filled(static_cast<float>(value)), value};
  };
  connect(
      tracing, path, from.p, candidates, scatter, [&](Vector3d) { return from; }, shadows);
}

}  // namespace vitrail
