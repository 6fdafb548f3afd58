// SPDX-License-Identifier: Apache-2.0
// What happens where a path arrives: in a medium, at a surface, outside of the scene.
#include "scene/geometry/portable_math.h"
#include "tracer/bsdf/local.h"
#include "tracer/media/phase.h"
#include "tracer/paths/path_state.h"
#include "tracer/paths/path_tracer.h"
#include "tracer/paths/photon_tracing.h"
#include "tracer/surfaces/scattered_direction.h"

namespace vitrail {

namespace {

// A ray that total reflection holds in a glass would go on for ever: beyond this depth mirrors and interfaces
// let go of one in 64.
constexpr std::uint32_t long_chain = 254;
constexpr float chain_survival = 63.0f / 64;

}  // namespace

// False when the path ends here.
bool PathTracer::shade(Path& path) {
  if (path.is(path_seeks)) [[unlikely]]
    return seek_on(path);
  const PreparedMedium* medium = medium_of(path);
  const bool escapes = path.met() == Met::nothing && !medium && !path.is(path_connection);
  if (escapes && !scene_.lights.has_background()) return false;
  find_wavelengths(path);
  if (path.is(path_connection)) return connect_onwards(path);
  if (is_too_dark(path)) return false;
  if (medium) {
    const Flight flight = flight_of(path);
    RandomStream random(stream_of(path, RayRandom::flight));
    const FlightSample flown =
        sample_flight(*medium, flight, path.wavelengths, path.active_wavelengths(), path.throughput, random);
    if (!is_black(flown.emitted))
      deposit(path.pixel, path.sample, path.sensor, path.throughput * flown.emitted);
    path.throughput = path.throughput * flown.weight;
    if (is_black(path.throughput)) return false;
    if (flown.scattered_at) {
      widen_cone(path, *flown.scattered_at);
      return scatter_in_medium(path, flight.p + flight.d * *flown.scattered_at);
    }
  }
  if (path.met() == Met::nothing) {
    if (leave_pane(path)) add_environment(path);
    return false;
  }
  return shade_surface(path);
}

// The discs of suns that are connected to as distant lights are seen as well, but where connections were made
// before: those find them.
void PathTracer::add_environment(const Path& path) {
  const Vector3d direction = normalize(cast<double>(path.ray.direction));
  auto [radiance, light_pdf] = background(scene_.lights, direction, path.wavelengths);
  if (scene_.lights.has_discs && !path.is(path_connected))
    radiance = radiance + discs(scene_.lights, direction, path.wavelengths);
  if (is_black(radiance)) return;
  double weight = 1;
  if (path.pdf > 0) {
    const double pdf = static_cast<double>(path.pdf);
    weight = pdf / (pdf + light_pdf);
  }
  deposit(path.pixel, path.sample, path.sensor, path.throughput * radiance * static_cast<float>(weight));
}

bool PathTracer::shade_surface(Path& path) {
  const Surface& surface = surface_at(path);
  Interaction at = interaction_at(path);
  widen_cone(path, path.hit.t);
  if (!is_there(path, surface, at)) {
    pass_straight(path, at, &surface);
    return true;
  }
  if (misses(path, opacity_at(surface, at))) {
    pass_straight(path, at, nullptr);
    return true;
  }
  const MaterialKind& kind = scene_.materials.kind(surface.material);
  // Only the far face of a pane lets the wavelengths out the way they came in.
  if ((at.front || !kind.smooth_dielectric) && !leave_pane(path)) return false;
  if (surface.area_light >= 0) add_emission(path, at, static_cast<std::uint32_t>(surface.area_light));
  if (kind.is_nothing(at)) {
    pass_straight(path, at, &surface);
    return true;
  }
  if (path.is(path_unrecorded)) [[unlikely]]
    record_first_surface(path, at, surface);
  if (path.depth >= static_cast<std::uint32_t>(manifest_.settings.max_depth))
    return end_at_surface(path, at, surface, kind);
  if (kind.smooth_dielectric) return scatter_dielectric(path, at, surface);
  return scatter_path(path, at, surface, kind);
}

// Whether a path meets nothing of a surface of which so much is there.
bool PathTracer::misses(const Path& path, double opacity) const {
  return opacity < 1 && RandomStream(stream_of(path, RayRandom::coverage)).next() >= opacity;
}

// A path that scatters no more: whether it goes on behind the surface.
bool PathTracer::end_at_surface(Path& path, const Interaction& at, const Surface& surface,
                                const MaterialKind& kind) {
  if (kind.smooth_dielectric && sees_through(path, at)) return scatter_dielectric(path, at, surface);
  if (!passes_at_the_end(path, at, surface)) return false;
  pass_straight(path, at, &surface);
  return true;
}

// Of a path or photon that scatters at the surface: the material that it meets. Null where it does not:
// `goes_on` says whether it has passed, or ends.
const Material* PathTracer::material_at(Path& path, const Interaction& at, const Surface& surface,
                                        const MaterialKind& kind, bool& goes_on) const {
  RandomStream chance(stream_of(path, RayRandom::choice));
  const Material* material = scene_.materials.choose(surface.material, at, chance);
  goes_on = !material;
  if (!material) {
    count_straight(path);
    if (flies() && kind.sheet) pass_sheet(path);
    pass_straight(path, at, &surface);
    return nullptr;
  }
  if (scene_.materials.disperses(*material, at)) path.disperse();
  return scene_.materials.scatters(*material, at) ? material : nullptr;
}

Scattering PathTracer::scattering_at(const Path& path, const Interaction& at,
                                     const Material& material) const {
  return scene_.materials.scattering_at(material, at, path.wavelengths, path.throughput,
                                        stream_of(path, RayRandom::layers));
}

// Connects to lights, gathers what photons bring, and goes on by a sample of the BSDF.
bool PathTracer::scatter_path(Path& path, const Interaction& at, const Surface& surface,
                              const MaterialKind& kind) {
  bool goes_on = false;
  const Material* material = material_at(path, at, surface, kind, goes_on);
  if (!material) return goes_on;
  const Scattering scattering = scattering_at(path, at, *material);
  const Vector3d out = scattering.frame.to_local(at.out);
  const std::uint32_t candidates =
      is_specular(scattering.bsdf) ? 0 : light_candidates(path, at.p, is_diffuse(scattering.bsdf));
  if (candidates > 0 && scene_.lights.can_sample())
    connect_surface(path, at, surface, scattering, out, candidates);
  const bool gathered = photons_ && gathers(scattering);
  if (gathered) gather(path, at, scattering, out);
  const bool one_lobe = has_one_lobe(scattering.bsdf);
  std::array<float, 4> u = numbers_for_scattering(path, one_lobe ? Wanted::two : Wanted::four);
  const std::optional<BsdfSample> chosen = sample(scattering.bsdf, out, u[2], {u[0], u[1]});
  if (!chosen) return false;
  path.throughput = path.throughput * chosen->weight;
  if (is_black(path.throughput)) return false;
  if (chosen->specular && chosen->in == -out) {
    scatter_straight(path, at, surface);
    return true;
  }
  const Vector3d sampled = scattering.frame.to_world(chosen->in);
  path.throughput = path.throughput * static_cast<float>(scattering.bump_shadowing(dot(sampled, at.shading)));
  const auto kept = kept_on_its_side(scattering, at, out, *chosen, sampled);
  if (!kept) return false;
  path.pdf = chosen->specular ? 0 : density_beside(chosen->pdf, candidates);
  if (!chosen->specular) path.set(path_connected);
  if (!chosen->specular && !(path.pdf > 0)) return false;
  if (one_lobe && survival(path) < 1) u = numbers_for_scattering(path);
  if (!go_on(path, u[3], chosen->specular, gathered)) return false;
  continue_from(path, at, surface, kept->world);
  return true;
}

// An event after which the path goes on as it came.
void PathTracer::scatter_straight(Path& path, const Interaction& at, const Surface& surface) const {
  if (manifest_.settings.straight_counts)
    count_straight(path);
  else
    path.set(path_passed);
  pass_straight(path, at, &surface);
}

// Whether a path that scatters no more goes on to see a lamp behind a surface, as connections to it do: else
// the two would not be weighted rightly.
bool PathTracer::passes_at_the_end(Path& path, const Interaction& at, const Surface& surface) const {
  const bool local = (path.depth & scattered_once) != 0, counts = manifest_.settings.straight_counts;
  const Requirements& r = manifest_.requirements;
  if (!r.see_through && !(local && r.refraction)) return false;
  const std::uint32_t depth = path.depth & ~scattered_once;
  if (counts && (!local || depth >= static_cast<std::uint32_t>(manifest_.settings.max_depth))) return false;
  path.throughput = path.throughput * straight_through(path, at, surface);
  path.depth += counts;
  return !is_black(path.throughput);
}

// What goes straight on. For direct light a smooth dielectric is a sheet of it, in the direction that light
// has outside: both faces let 1 − F of it through.
SampledSpectrum PathTracer::straight_through(const Path& path, const Interaction& at,
                                             const Surface& surface) const {
  if (!manifest_.settings.direct_only || !scene_.materials.kind(surface.material).smooth_dielectric)
    return scene_.materials.passes_straight(surface.material, at, path.wavelengths);
  const Material& record = manifest_.materials[surface.material];
  const auto& material = std::get<DielectricMaterial>(record.model);
  const double cosine = std::abs(dot(at.out, scene_.materials.shading_normal(record, at)));
  const SampledSpectrum eta = relative_index(material, at, path.wavelengths);
  SampledSpectrum passes =
      scene_.textures.spectrum(material.transmittance_factor, at.texture_point(), path.wavelengths);
  for (std::size_t i = 0; i < hero_count; ++i) {
    const double inside = static_cast<double>(eta.v[i]);
    passes.v[i] *= static_cast<float>(1 - fresnel_dielectric(cosine, at.front ? inside : 1 / inside));
  }
  return passes;
}

// Of mirrors and glass before what is lit by lamps alone: no wavelength brings as much as is looked at
// (FilmKey::threshold).
bool PathTracer::is_too_dark(const Path& path) const {
  if (!manifest_.settings.direct_only || (path.depth & scattered_once) != 0) return false;
  const float brightest = max_value(path.throughput) * (path.is(path_dispersed) ? 1.0f / hero_count : 1.0f);
  return brightest < film_.key().threshold;
}

// False for the face of an interior that lies in one of higher priority.
bool PathTracer::is_there(const Path& path, const Surface& surface, Interaction& at) const {
  if (!scene_.interiors.has_priority(surface)) return true;
  const auto face = scene_.interiors.face(path.inside, surface, at.front);
  if (face) at.exterior_eta = face->exterior_eta;
  return face.has_value();
}

// How much of the surface there is at a point.
double PathTracer::opacity_at(const Surface& surface, const Interaction& at) const {
  if (!manifest_.requirements.see_through) return 1;
  if (const auto* constant = std::get_if<float>(&surface.opacity)) return static_cast<double>(*constant);
  return scene_.textures.number(surface.opacity, at.texture_point());
}

// The chance that a path lives on after the event at hand: what it carries over what is worth going on for,
// which is what it carries then.
float PathTracer::survival(const Path& path) const {
  constexpr std::uint32_t longest = 254;
  const Roulette roulette = scene_.sampling.roulette;
  if (roulette == Roulette::never && path.depth < longest) return 1;
  const float brightest = max_value(path.throughput) * (path.is(path_dispersed) ? 1.0f / hero_count : 1.0f);
  const float worth = roulette == Roulette::usual ? 0.25f : 1.0f;
  return static_cast<float>(attainable(static_cast<double>(brightest / worth)));
}

// Counts a scattering event, and decides by roulette whether the path lives on. Where it has gathered what
// photons bring, it lives on for the light that it may still see directly.
bool PathTracer::go_on(Path& path, float u, bool specular, bool gathered) const {
  const float lives = specular ? 1 : survival(path);
  ++path.depth;
  path.clear(path_passed);
  path.travelled = 0;
  if (specular) {
    if (path.depth > long_chain) {
      if (u >= chain_survival) return false;
      path.throughput = path.throughput * (1 / chain_survival);
    }
    return true;
  }
  if (gathered || manifest_.settings.direct_only) {
    path.depth |= scattered_once;
  } else if (lives < 1) {
    if (u >= lives) return false;
    path.throughput = path.throughput * (1 / lives);
  }
  return true;
}

void PathTracer::add_emission(const Path& path, const Interaction& at, std::uint32_t light) {
  const SampledSpectrum radiance = emitted(scene_.lights, light, at.texture_point(),
                                           dot(at.out, at.geometric), path.wavelengths, path.lamp);
  if (is_black(radiance)) return;
  double weight = 1;
  if (path.pdf > 0) {
    const double distance = path.travelled + path.hit.t * length(cast<double>(path.ray.direction));
    const double pdf = static_cast<double>(path.pdf);
    weight = pdf / (pdf + triangle_pdf(scene_.lights, path.scattered_from(), at.triangle, at.p, distance,
                                       dot(at.out, at.geometric)));
  }
  deposit(path.pixel, path.sample, path.sensor, path.throughput * radiance * static_cast<float>(weight));
}

bool PathTracer::scatter_in_medium(Path& path, Point3d p) {
  path.clear(path_unrecorded);
  if (path.depth >= static_cast<std::uint32_t>(manifest_.settings.max_depth)) return false;
  if (!leave_pane(path)) return false;
  const double g = medium_of(path)->g;
  const Vector3d out = normalize(-cast<double>(path.ray.direction));
  const Departure from{p, cast<float>(p), no_triangle, path.inside};
  const std::uint32_t candidates = light_candidates(path, p, true);
  if (scene_.lights.can_sample()) connect_medium(path, from, g, out, candidates);
  const std::array<float, 4> u = numbers_for_scattering(path);
  const Vector3d in = sample_phase(g, out, u[0], u[1]);
  path.pdf = density_beside(phase(g, out, in), candidates);
  path.set(path_connected);
  if (!(path.pdf > 0) || !go_on(path, u[3], false)) return false;
  depart(path, from, in);
  return true;
}

}  // namespace vitrail
