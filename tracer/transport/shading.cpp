// SPDX-License-Identifier: Apache-2.0
#include "tracer/transport/shading.h"

#include "tracer/media/fade.h"
#include "tracer/media/phase.h"
#include "tracer/sampling/power_heuristic.h"
#include "tracer/surfaces/scattered_direction.h"
#include "tracer/transport/connect.h"
#include "tracer/transport/connection.h"
#include "tracer/transport/first_surface.h"
#include "tracer/transport/gathering.h"
#include "tracer/transport/glass.h"
#include "tracer/transport/group_lights.h"

namespace vitrail {

namespace {

// Beside a light sample of density light_pdf: the weight of a path that has found the light by itself.
double weight_of_finding(const CameraPath& path, double light_pdf) {
  return power_heuristic(static_cast<double>(path.pdf), light_pdf);
}

// The discs of suns that are connected to as distant lights are seen as well, but where connections were made
// before: those find them.
void add_environment(Tracing& tracing, const CameraPath& path) {
  if (is_hidden(tracing, path) || is_past_last_level(tracing, path)) return;
  const LightSampler& lights = tracing.scene.lights;
  const Vector3d direction = normalize(cast<double>(path.ray.direction));
  auto [radiance, light_pdf] = background(lights, direction, path.wavelengths);
  const bool with_discs = lights.has_discs() && !path.connected;
  if (with_discs) radiance = radiance + discs(lights, direction, path.wavelengths);
  if (is_black(radiance)) return;
  const double weight = path.pdf > 0 ? weight_of_finding(path, light_pdf) : 1;
  std::uint8_t group = tracing.scene.groups.surroundings;
  if (with_discs && group == GroupedLights::by_direction) group = by_direction_with_discs;
  deposit(tracing, path.film, path.throughput * radiance * static_cast<float>(weight),
          {group, path.ray.direction});
}

std::uint8_t group_of(const RenderScene& scene, const PreparedMedium& medium) {
  return scene.groups.kept_apart ? scene.groups.media[static_cast<std::size_t>(&medium - scene.media.data())]
                                 : std::uint8_t{0};
}

bool scatter_in_medium(Tracing& tracing, CameraPath& path, double g, Point3d p, ShadowRays& shadows) {
  if (path.unrecorded) [[unlikely]]
    record_first_medium(tracing, path);
  if (is_spent(tracing, path)) return false;
  if (!leave_pane(path)) return false;
  path.pane.polarization = {};
  const Vector3d out = normalize(-cast<double>(path.ray.direction));
  const Departure from{p, cast<float>(p), no_triangle, path.inside};
  const std::uint32_t candidates = light_candidates(tracing, path, p, true);
  if (tracing.scene.lights.can_sample()) connect_medium(tracing, path, from, g, out, candidates, shadows);
  if (ends_lit(tracing)) return false;
  const std::array<float, 4> u = numbers_for_scattering(path);
  const Vector3d in = sample_phase(g, out, u[0], u[1]);
  path.pdf = density_beside(phase(g, out, in), candidates);
  if (!(path.pdf > 0) || !go_on(tracing, path, u[3], false)) return false;
  depart(path, from, in);
  return true;
}

// What goes straight on. For direct light a smooth dielectric is a sheet of it, in the direction that light
// has outside: both faces let 1 − F of it through.
bool passes_at_the_end(const Tracing& tracing, CameraPath& path, const Event& event) {
  const bool local = path.only_straight, counts = tracing.settings().straight_counts;
  const Requirements& r = tracing.requirements();
  if (!r.see_through && !(local && r.refraction)) return false;
  if (counts && (!local || path.depth >= static_cast<std::uint32_t>(tracing.settings().max_depth)))
    return false;
  path.throughput = path.throughput * straight_through(tracing, path, event.at, event.surface);
  path.depth += counts;
  return !is_black(path.throughput);
}

// A path that scatters no more: whether it goes on behind the surface, to see a lamp there as connections to
// it do. Else the two would not be weighted rightly.
bool end_at_surface(Tracing& tracing, CameraPath& path, const Event& event) {
  if (event.kind.smooth_dielectric && sees_through(tracing, path, event.at))
    return scatter_dielectric(tracing, path, event);
  if (!passes_at_the_end(tracing, path, event)) return false;
  pass_straight(tracing, path, event.at, &event.surface);
  return true;
}

// The direction that light leaves to, in the frame of the scattering. Where a pattern turns the normal away
// from the ray, and what is there is as bright from all directions, that is on its side of the surface all
// the same.
Vector3d local_out(const Scattering& scattering, const Interaction& at, const Material& material) {
  Vector3d out = scattering.frame.to_local(at.out);
  if (material.displacement && takes_any_normal(scattering.bsdf))
    out.z = std::copysign(out.z, scattering.transmits ? at.side() : 1.0);
  return out;
}

// Connects to lights, gathers what photons bring, and goes on by a sample of the BSDF.
bool scatter_path(Tracing& tracing, CameraPath& path, const Event& event, ShadowRays& shadows) {
  const auto [material, passes] = material_at(tracing, path, event);
  if (!material) return passes;
  const Interaction& at = event.at;
  const Scattering scattering = scattering_at(tracing, path, at, *material);
  const Vector3d out = local_out(scattering, at, *material);
  const std::uint32_t candidates =
      is_specular(scattering.bsdf) ? 0 : light_candidates(tracing, path, at.p, is_diffuse(scattering.bsdf));
  if (candidates > 0 && tracing.scene.lights.can_sample())
    connect_surface(tracing, path, event, scattering, out, candidates, shadows);
  const bool gathered = tracing.photons && gathers(scattering);
  if (gathered) gather(tracing, path, at, scattering, out);
  const bool one_lobe = has_one_lobe(scattering.bsdf);
  if (one_lobe && ends_lit(tracing)) return false;
  std::array<float, 4> u = numbers_for_scattering(path, one_lobe ? Wanted::two : Wanted::four);
  const std::optional<BsdfSample> chosen = sample(scattering.bsdf, out, u[2], {u[0], u[1]});
  if (!chosen) return false;
  path.throughput = path.throughput * chosen->weight;
  if (is_black(path.throughput)) return false;
  if (chosen->specular && chosen->in == -out) {
    scatter_straight(tracing, path, event);
    return true;
  }
  const Vector3d sampled = scattering.frame.to_world(chosen->in);
  path.throughput = path.throughput * static_cast<float>(scattering.bump_shadowing(dot(sampled, at.shading)));
  const auto kept = kept_on_its_side(scattering, at, out, *chosen, sampled);
  if (!kept) return false;
  path.pdf = chosen->specular ? 0 : density_beside(chosen->pdf, candidates);
  if (!chosen->specular && ends_lit(tracing)) return false;
  if (!chosen->specular && !(path.pdf > 0)) return false;
  if (one_lobe && survival(tracing, path) < 1) u = numbers_for_scattering(path);
  if (!go_on(tracing, path, u[3], chosen->specular, gathered)) return false;
  continue_from(tracing, path, at, event.surface, kept->world);
  return true;
}

// Whether it ends at a surface of which nothing is to be looked up.
bool ends_unseen(const Tracing& tracing, const CameraPath& path) {
  const Requirements& r = tracing.requirements();
  if (!is_spent(tracing, path) || path.unrecorded) return false;
  if (r.see_through || (path.only_straight && r.refraction)) return false;
  const Surface& surface = surface_at(tracing, path);
  return surface.area_light < 0 && !tracing.scene.materials.kind(surface.material).smooth_dielectric;
}

bool shade_surface(Tracing& tracing, CameraPath& path, ShadowRays& shadows) {
  if (ends_unseen(tracing, path)) return false;
  const Event event = event_of(tracing, path);
  const Interaction& at = event.at;
  if (!event.is_there) {
    pass_straight(tracing, path, at, &event.surface);
    return true;
  }
  if (misses(path, opacity_at(tracing, event.surface, at))) {
    pass_straight(tracing, path, at, nullptr);
    return true;
  }
  if (event.surface.area_light >= 0 && is_hidden(tracing, path)) {
    pass_straight(tracing, path, at, &event.surface);
    return true;
  }
  if (!come_to(path, event)) return false;
  if (event.surface.area_light >= 0)
    add_emission(tracing, path, at, static_cast<std::uint32_t>(event.surface.area_light));
  if (event.kind.is_nothing(at)) {
    pass_straight(tracing, path, at, &event.surface);
    return true;
  }
  if (path.unrecorded) [[unlikely]]
    record_first_surface(tracing, path, event);
  if (is_spent(tracing, path)) return end_at_surface(tracing, path, event);
  if (event.kind.smooth_dielectric) return scatter_dielectric(tracing, path, event);
  return scatter_path(tracing, path, event, shadows);
}

}  // namespace

bool is_hidden(const Tracing& tracing, const CameraPath& path) {
  return tracing.settings().hides_emitters && !path.has_scattered();
}

bool is_past_last_level(const Tracing& tracing, const CameraPath& path) {
  return tracing.settings().direct_only && !path.only_straight && path.depth > 0 && is_spent(tracing, path);
}

// Of mirrors and glass before what is lit by lamps alone (FilmKey::threshold).
bool is_too_dark(const Tracing& tracing, const CameraPath& path) {
  if (!tracing.settings().direct_only || path.only_straight) return false;
  const float brightest = max_value(path.throughput) * (path.dispersed ? 1.0f / hero_count : 1.0f);
  return brightest < tracing.film.key().threshold;
}

bool ends_lit(const Tracing& tracing) {
  return tracing.settings().direct_only && tracing.scene.lights.has_only_glows;
}

void add_emission(Tracing& tracing, const CameraPath& path, const Interaction& at, std::uint32_t light) {
  const LightSampler& lights = tracing.scene.lights;
  if (!lights.scene.area_lights[light].sampled && path.connected && tracing.settings().direct_only) return;
  if (is_past_last_level(tracing, path)) return;
  const double cosine = dot(at.out, at.geometric);
  const SampledSpectrum radiance =
      emitted(lights, light, at.texture_point(), cosine, path.wavelengths, path.lamp);
  if (is_black(radiance)) return;
  double weight = 1;
  if (path.pdf > 0) {
    const double distance = path.travelled + path.hit.t * length(cast<double>(path.ray.direction));
    weight = weight_of_finding(
        path, triangle_pdf(lights, path.scattered_from(), at.triangle, at.p, distance, cosine));
  }
  deposit(tracing, path.film, path.throughput * radiance * static_cast<float>(weight),
          {tracing.scene.groups.of_area_light(light)});
}

std::optional<Arrived> fly(Tracing& tracing, CameraPath& path) {
  const PreparedMedium* const medium = medium_of(tracing, path);
  if (!medium) return Arrived{};
  find_wavelengths(tracing, path, path.film);
  if (is_too_dark(tracing, path)) return std::nullopt;
  if (!path.meets_surface()) path.hit.t = Hit{}.t;  // a medium goes on behind the camera's far plane
  const Flight flight = flight_of(tracing, path, tracing.scene.lights.has_background());
  if (const auto& fade = medium->medium->fade) {
    if (ends_medium(tracing, path))
      path.throughput = path.throughput * left_by(*fade, flight.t_max, path.wavelengths);
    return is_black(path.throughput) ? std::nullopt : std::optional(Arrived{.has_flown = true});
  }
  RandomStream random(stream_of(path, RayRandom::flight));
  const FlightSample flown =
      sample_flight(*medium, flight, path.wavelengths, path.active_wavelengths(), path.throughput, random);
  // As unsampled lamps (add_emission): with direct light alone what glows is seen and lights nothing.
  if (!is_black(flown.emitted) && !(path.connected && tracing.settings().direct_only) &&
      !is_past_last_level(tracing, path))
    deposit(tracing, path.film, path.throughput * flown.emitted, {group_of(tracing.scene, *medium)});
  path.throughput = path.throughput * flown.weight;
  if (is_black(path.throughput)) return std::nullopt;
  if (!flown.scattered_at) return Arrived{.has_flown = true};
  widen_cone(tracing, path, sample_of(path), *flown.scattered_at);
  return Arrived{medium, flight.p + flight.d * *flown.scattered_at, true};
}

bool shade(Tracing& tracing, CameraPath& path, const Arrived& arrived, ShadowRays& shadows) {
  if (arrived.scatters_in)
    return scatter_in_medium(tracing, path, arrived.scatters_in->g, arrived.p, shadows);
  if (!path.meets_surface()) record_leaving(tracing, path);
  if (!path.meets_surface() && !tracing.scene.lights.has_background()) return false;
  find_wavelengths(tracing, path, path.film);
  if (!arrived.has_flown && is_too_dark(tracing, path)) return false;
  if (path.meets_surface()) return shade_surface(tracing, path, shadows);
  if (leave_pane(path)) add_environment(tracing, path);
  return false;
}

}  // namespace vitrail
