// SPDX-License-Identifier: Apache-2.0
// What happens where a path arrives: in a medium, at a surface, outside of the scene.
#include <limits>

#include "tracer/bsdf/local.h"
#include "tracer/media/phase.h"
#include "tracer/path_state.h"
#include "tracer/path_tracer.h"
#include "tracer/portable_math.h"

namespace vitrail {

namespace {

constexpr std::uint32_t roulette_depth = 3;

}  // namespace

// False when the path ends here.
bool PathTracer::shade(Path& path) {
  if (path.is(path_connection)) return connect_onwards(path);
  if (path.medium) {
    const Flight flight = flight_of(path);
    RandomStream random(stream_of(path));
    const FlightSample flown = sample_flight(scene_.media[path.medium - 1u], flight, path.wavelengths,
                                             path.active_wavelengths(), path.throughput, random);
    if (!is_black(flown.emitted))
      deposit(path.pixel, path.sample, path.sensor, path.throughput * flown.emitted);
    path.throughput = path.throughput * flown.weight;
    if (is_black(path.throughput)) return false;
    if (flown.scattered_at) return scatter_in_medium(path, flight.p + flight.d * *flown.scattered_at);
  }
  if (path.hit.triangle == no_triangle) {
    if (path.is(path_in_pane)) path.disperse();
    add_environment(path);
    return false;
  }
  return shade_surface(path);
}

Flight PathTracer::flight_of(const Path& path) const {
  const Vector3d d = cast<double>(path.ray.direction);
  const double scale = length(d);
  return {cast<double>(path.ray.origin), d * (1 / scale), path.hit.t * scale};
}

// A function of the ray, wherever it is traced.
std::uint64_t PathTracer::stream_of(const Path& path) const {
  const auto bits = [](float x) { return std::uint64_t{std::bit_cast<std::uint32_t>(x)}; };
  const Point3f o = path.ray.origin;
  return stream_seed(key_of(path.pixel, path.sample), bits(o.x) << 32 | bits(o.y),
                     bits(o.z) << 32 | path.direction.first() << 8 | path.direction.second());
}

void PathTracer::add_environment(const Path& path) {
  const Vector3d direction = normalize(cast<double>(path.ray.direction));
  const SampledSpectrum radiance = environment_radiance(scene_.lights, direction, path.wavelengths);
  if (is_black(radiance)) return;
  double weight = 1;
  if (path.pdf > 0) {
    const double pdf = static_cast<double>(path.pdf);
    weight = pdf / (pdf + environment_pdf(scene_.lights, path.scattered_from(), direction));
  }
  deposit(path.pixel, path.sample, path.sensor,
          path.throughput * radiance * static_cast<float>(weight));
}

bool PathTracer::shade_surface(Path& path) {
  const Surface& surface = surface_of(manifest_, path.hit.triangle);
  Interaction at = interaction_at(path);
  const MaterialKind& kind = scene_.materials.kind(surface.material);
  // Only the far face of a pane lets the wavelengths out the way they came in.
  if (path.is(path_in_pane) && (at.front || !kind.smooth_dielectric)) path.disperse();
  if (surface.area_light >= 0) add_emission(path, at, static_cast<std::uint32_t>(surface.area_light));
  const bool is_last = path.depth >= static_cast<std::uint32_t>(manifest_.settings.max_depth);
  if (kind.is_interface) {
    pass_straight(path, at, surface);
    return true;
  }
  if (is_last) return false;
  if (kind.smooth_dielectric) return scatter_dielectric(path, at, surface);

  const SampleKey key = key_of(path.pixel, path.sample);
  const Material* material = scene_.materials.choose(surface.material, at, key, path.depth);
  if (!material) {
    ++path.depth;
    pass_straight(path, at, surface);
    return true;
  }
  if (scene_.materials.disperses(*material)) path.disperse();
  const auto scattering = scene_.materials.scattering_at(*material, at, path.wavelengths);
  if (!scattering) return false;
  const std::array<float, 4> u = sample_4d(key, sample_set::scatter(path.depth));
  const Vector3d out = scattering->frame.to_local(at.out);
  if (scene_.lights.any()) connect_surface(path, at, surface, *scattering, out);
  const std::optional<BsdfSample> chosen = sample(scattering->bsdf, out, u[2], {u[0], u[1]});
  if (!chosen) return false;
  path.throughput = path.throughput * chosen->weight;
  if (is_black(path.throughput)) return false;
  if (chosen->specular && chosen->in == -out) {
    ++path.depth;
    pass_straight(path, at, surface);
    return true;
  }
  const Vector3d direction = scattering->frame.to_world(chosen->in);
  // The shading normal must not let light through the surface, nor reflect it into it.
  if ((dot(direction, at.geometric) > 0) != (dot(at.out, at.geometric) * out.z * chosen->in.z > 0))
    return false;
  path.pdf = chosen->specular ? 0 : pdf_value(pdf_code(static_cast<float>(chosen->pdf)));
  if (!chosen->specular && !(path.pdf > 0)) return false;
  if (!go_on(path, u[3], chosen->specular)) return false;
  continue_from(path, at, surface, direction);
  return true;
}

// Counts a scattering event, and decides by roulette whether the path lives on.
bool PathTracer::go_on(Path& path, float u, bool specular) const {
  ++path.depth;
  path.travelled = 0;
  if (specular) return true;
  if (manifest_.settings.direct_only) {
    path.depth = static_cast<std::uint32_t>(manifest_.settings.max_depth);
  } else if (path.depth > roulette_depth) {
    const float survival = max_value(path.throughput) * (path.is(path_dispersed) ? 1.0f / hero_count : 1.0f);
    if (survival < 1) {
      if (u >= survival) return false;
      path.throughput = path.throughput * (1 / survival);
    }
  }
  return true;
}

void PathTracer::add_emission(const Path& path, const Interaction& at, std::uint32_t light) {
  const SampledSpectrum radiance =
      emitted(scene_.lights, light, at.texture_point(), at.front, path.wavelengths);
  if (is_black(radiance)) return;
  double weight = 1;
  if (path.pdf > 0) {
    const double distance = path.travelled + path.hit.t * length(cast<double>(path.ray.direction));
    const double pdf = static_cast<double>(path.pdf);
    weight = pdf / (pdf + triangle_pdf(scene_.lights, path.scattered_from(), at.triangle, distance,
                                       std::abs(dot(at.out, at.geometric))));
  }
  deposit(path.pixel, path.sample, path.sensor, path.throughput * radiance * static_cast<float>(weight));
}

bool PathTracer::scatter_in_medium(Path& path, Point3d p) {
  if (path.depth >= static_cast<std::uint32_t>(manifest_.settings.max_depth)) return false;
  if (path.is(path_in_pane)) path.disperse();
  const double g = scene_.media[path.medium - 1u].g;
  const Vector3d out = normalize(-cast<double>(path.ray.direction));
  const Departure from{p, cast<float>(p), no_triangle, path.medium};
  if (scene_.lights.any())
    connect(path, p, [&](Vector3d in) -> std::optional<Connection> {
      const double value = phase(g, out, in);
      return Connection{{filled(static_cast<float>(value)), value}, from};
    });
  const std::array<float, 4> u = sample_4d(key_of(path.pixel, path.sample), sample_set::scatter(path.depth));
  const Vector3d in = sample_phase(g, out, u[0], u[1]);
  path.pdf = pdf_value(pdf_code(static_cast<float>(phase(g, out, in))));
  if (!(path.pdf > 0) || !go_on(path, u[3], false)) return false;
  depart(path, from, in);
  return true;
}

namespace {

// Indices behind over before the interface at the four wavelengths.
SampledSpectrum relative_index(const DielectricMaterial& material, const SampledWavelengths& wavelengths,
                               bool front) {
  const SampledSpectrum behind = evaluate(material.eta, wavelengths),
                        before = evaluate(material.exterior_eta, wavelengths);
  SampledSpectrum eta;
  for (std::size_t i = 0; i < hero_count; ++i)
    eta.v[i] = front ? behind.v[i] / before.v[i] : before.v[i] / behind.v[i];
  return eta;
}

}  // namespace

// Dispersion ends the secondary wavelengths where their ways part. Through a pane of parallel faces they do
// not: all leave in the direction they came, micrometres apart. So they stay until the path meets a face that
// is not parallel to the one it entered by.
bool PathTracer::scatter_dielectric(Path& path, const Interaction& at, const Surface& surface) {
  const Material& record = manifest_.materials[surface.material];
  const auto& material = std::get<DielectricMaterial>(record.model);
  const Vector3d normal = scene_.materials.shading_normal(record, at) * at.side();
  if (path.is(path_in_pane) && !is_parallel(path.entered_by, normal)) path.disperse();
  const bool in_pane = path.is(path_in_pane);
  const SampledSpectrum eta = relative_index(material, path.wavelengths, at.front);
  const double hero_eta = static_cast<double>(eta[0]), cosine = dot(at.out, normal);
  // Inside a pane the wavelengths differ in their angle, but share the one outside; reflectance is the same
  // from both sides.
  const double outside = safe_sqrt(1 - (1 - cosine * cosine) / (hero_eta * hero_eta));

  // One choice for all wavelengths, by their mean reflectance: no weight exceeds their number.
  SampledSpectrum reflectance;
  const std::size_t active = path.active_wavelengths();
  double mean = 0;
  for (std::size_t i = 0; i < active; ++i) {
    const double e = static_cast<double>(eta.v[i]);
    reflectance.v[i] =
        static_cast<float>(in_pane ? fresnel_dielectric(outside, 1 / e) : fresnel_dielectric(cosine, e));
    mean += static_cast<double>(reflectance.v[i]) / static_cast<double>(active);
  }
  const float u = sample_4d(key_of(path.pixel, path.sample), sample_set::scatter(path.depth))[2];
  const double side = at.side();
  Vector3d direction;
  if (static_cast<double>(u) < mean) {
    direction = normal * (2 * cosine) - at.out;
    if (dot(direction, at.geometric) * side <= 0) return false;
    path.throughput = path.throughput * reflectance * static_cast<float>(1 / mean) *
                      scene_.textures.spectrum(material.reflectance_factor, at.texture_point(), path.wavelengths);
  } else {
    if (!refract(at.out, normal, hero_eta, direction)) return false;
    if (dot(direction, at.geometric) * side >= 0) return false;
    // Radiance is compressed into the smaller solid angle by 1/η² (Veach 1997, §5.2).
    for (std::size_t i = 0; i < active; ++i) {
      const double e = static_cast<double>(eta.v[i]);
      path.throughput.v[i] *=
          static_cast<float>((1 - static_cast<double>(reflectance.v[i])) / (1 - mean) / (e * e));
    }
    path.throughput = path.throughput * scene_.textures.spectrum(material.transmittance_factor,
                                                                 at.texture_point(), path.wavelengths);
    if (in_pane) {
      path.clear(path_in_pane);
    } else if (scene_.materials.kind(surface.material).dispersive && !path.is(path_dispersed)) {
      if (at.front) {
        path.set(path_in_pane);
        path.entered_by = encode_face(normal);
      } else {
        path.disperse();
      }
    }
  }
  if (is_black(path.throughput)) return false;
  path.pdf = 0;
  go_on(path, 0, true);
  continue_from(path, at, surface, direction);
  return true;
}

// On the other side of a surface, as if it was not there. Connections go through it too, so the path keeps
// the density of the scattering that it comes from.
void PathTracer::pass_straight(Path& path, const Interaction& at, const Surface& surface) const {
  path.travelled = path.pdf > 0 ? static_cast<double>(rounded_radiance(static_cast<float>(
                                      path.travelled + path.hit.t * length(cast<double>(path.ray.direction)))))
                                : 0;
  continue_from(path, at, surface, cast<double>(path.ray.direction), true);
}

void PathTracer::continue_from(Path& path, const Interaction& at, const Surface& surface, Vector3d direction,
                               bool straight) const {
  Departure from = departure(path, at, surface, direction);
  const DirectionCode kept = path.direction;
  depart(path, from, direction);
  if (!straight) return;
  path.direction = kept;  // encoding once more might turn it
  path.ray.direction = decode_direction(kept);
}

Departure PathTracer::departure(const Path& path, const Interaction& at, const Surface& surface,
                                Vector3d direction) const {
  Departure from{at.p, offset_origin(at, direction), at.triangle, path.medium};
  if (surface.interior != surface.exterior)
    from.medium = static_cast<std::uint8_t>(
        (dot(direction, at.geometric) > 0 ? surface.exterior : surface.interior) + 1);
  return from;
}

// Starts the next ray. The triangle it leaves is excluded by id.
void PathTracer::depart(Path& path, const Departure& from, Vector3d direction) const {
  if (manifest_.requirements.filtering) path.cone = cone_code(cone_width(path) / cone_unit());
  path.direction = encode_direction(direction);
  path.ray = {from.origin, decode_direction(path.direction), from.exclude};
  path.hit = {};
  path.medium = from.medium;
  for (float& x : path.throughput.v) x = rounded_radiance(x);
}

// Moves the hit along the normal, to the side of `direction`, by more than rounding to float can move it
// back: so it keeps from the neighbours of the triangle that it leaves.
Point3f PathTracer::offset_origin(const Interaction& at, Vector3d direction) const {
  const double rounding = 0x1p-24 * (std::abs(at.geometric.x * at.p.x) + std::abs(at.geometric.y * at.p.y) +
                                     std::abs(at.geometric.z * at.p.z));
  const double distance = 3 * rounding + 1e-9 * static_cast<double>(manifest_.scale);
  const double side = dot(direction, at.geometric) >= 0 ? 1 : -1;
  return cast<float>(at.p + at.geometric * (side * distance));
}

Interaction PathTracer::interaction_at(const Path& path) const {
  const double width = manifest_.requirements.filtering ? cone_width(path) : 0;
  return make_interaction(*resident_[path.hit_domain], path.hit, path.ray.direction, width,
                          manifest_.attributes);
}

double PathTracer::cone_unit() const { return std::max(1e-30, static_cast<double>(manifest_.scale)); }

// Where the path arrives (Akenine-Möller et al., "Texture Level of Detail Strategies for Real-Time Ray
// Tracing", 2019): it widens by the angle of a pixel, and after a scattering by a tenth of the width of a
// lobe of that density.
double PathTracer::cone_width(const Path& path) const {
  const double angle = path.pdf > 0 ? std::max(scene_.pixel_angle, 0.1 / std::sqrt(static_cast<double>(path.pdf)))
                                    : scene_.pixel_angle;
  return cone_value(path.cone) * cone_unit() + std::min(angle, 1.0) * path.hit.t;
}

}  // namespace vitrail
