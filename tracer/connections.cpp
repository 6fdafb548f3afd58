// SPDX-License-Identifier: Apache-2.0
// Connections to lights: rays that deposit what they carry where nothing is in their way. Where the scene has
// something that light passes straight through, they are paths of their own that go on behind it.
#include <limits>

#include "tracer/bsdf/local.h"
#include "tracer/media/phase.h"
#include "tracer/path_state.h"
#include "tracer/path_tracer.h"

namespace vitrail {

namespace {

constexpr std::uint32_t max_surfaces_crossed = 64;  // before a connection is given up
// A shadow ray ends this much before its light, relative to the distance.
constexpr double shadow_end = 1 - 1e-4;
constexpr double far_away = 1e30;  // ends of rays to environments

}  // namespace

// `scatter(direction)` gives the value and the density of scattering to there.
template <class Scatter>
void PathTracer::connect(const Path& path, Point3d p, const Scatter& scatter) {
  const std::array<float, 4> u = numbers_for_light(path);
  const auto light = sample_light(scene_.lights, p, u, path.wavelengths);
  if (!light) return;
  const std::optional<Connection> connection = scatter(light->to_light);
  if (!connection) return;
  double weight = 1 / light->pdf;
  if (!light->is_delta)
    weight = 1 / (light->pdf +
                  static_cast<double>(pdf_value(pdf_code(static_cast<float>(connection->scattered.pdf)))));
  const SampledSpectrum radiance =
      path.throughput * connection->scattered.value * light->radiance * static_cast<float>(weight);
  if (is_black(radiance)) return;
  ++counters_.rays_shadow;
  const bool distant = std::isinf(light->distance);
  const Requirements& r = manifest_.requirements;
  const bool refracts = distant && light->is_delta && r.refraction;
  if (r.see_through || r.media || refracts)
    send_connection(path, *connection, *light, radiance, refracts);
  else
    send_shadow_ray(path, *connection, *light, radiance);
}

void PathTracer::connect_surface(const Path& path, const Interaction& at, const Surface& surface,
                                 const Scattering& scattering, Vector3d out) {
  connect(path, at.p, [&](Vector3d direction) -> std::optional<Connection> {
    const Vector3d in = scattering.frame.to_local(direction);
    // As for the samples of the BSDF: shading normals let no light leak.
    if (!scattering.transmits &&
        (dot(direction, at.geometric) > 0) != (dot(at.out, at.geometric) * out.z * in.z > 0))
      return std::nullopt;
    BsdfValue scattered = eval(scattering.bsdf, out, in);
    scattered.value =
        scattered.value * static_cast<float>(scattering.bump_shadowing(dot(direction, at.shading)));
    return Connection{scattered, departure(path, at, surface, direction)};
  });
}

void PathTracer::connect_medium(const Path& path, const Departure& from, double g, Vector3d out) {
  connect(path, from.p, [&](Vector3d in) -> std::optional<Connection> {
    const double value = phase(g, out, in);
    return Connection{{filled(static_cast<float>(value)), value}, from};
  });
}

void PathTracer::send_connection(const Path& path, const Connection& connection, const LightSample& light,
                                 const SampledSpectrum& radiance, bool refracts) {
  Path sent = path;
  sent.clear(path_in_pane);
  sent.cone = 0;
  sent.set(path_connection);
  sent.throughput = radiance;
  depart(sent, connection.from, light.to_light);
  set_end(sent, refracts ? 0 : std::min(light.distance * shadow_end, far_away));
  sent.depth = refracts ? 0 : path.depth + 1;
  sent.pdf = 0;
  const std::size_t waiting = outbox_.paths.size();
  const std::uint64_t died = counters_.died, indirect = counters_.rays_indirect;
  run(sent, std::nullopt);
  // A connection that ended here was never counted as alive; its segments behind surfaces are shadow rays.
  if (outbox_.paths.size() > waiting) ++counters_.born;
  counters_.died = died;
  counters_.rays_shadow += counters_.rays_indirect - indirect;
  counters_.rays_indirect = indirect;
}

// The distance that a connection still has to go, kept as what it has `travelled`; 0: any, towards a distant
// light, and surfaces may refract it on its way.
void PathTracer::set_end(Path& connection, double distance) {
  connection.travelled = static_cast<double>(rounded_radiance(static_cast<float>(distance)));
  connection.hit.t = distance > 0 ? connection.travelled / length(cast<double>(connection.ray.direction))
                                  : std::numeric_limits<double>::infinity();
}

void PathTracer::send_shadow_ray(const Path& path, const Connection& connection, const LightSample& light,
                                 const SampledSpectrum& radiance) {
  ShadowRecord r;
  r.origin[0] = connection.from.origin.x;
  r.origin[1] = connection.from.origin.y;
  r.origin[2] = connection.from.origin.z;
  r.direction = encode_direction(light.to_light);
  r.tmax = std::isinf(light.distance) ? std::numeric_limits<float>::max()
                                      : static_cast<float>(light.distance * shadow_end);
  r.exclude = connection.from.exclude;
  for (std::size_t i = 0; i < hero_count; ++i) pack_radiance(std::max(0.0f, radiance.v[i]), r.radiance[i]);
  r.pixel = path.pixel;
  r.sample = path.sample;
  trace_shadow(r, &path.sensor, std::nullopt);
}

// A connection goes straight on through whatever lets it; one to a distant light through every smooth
// interface, refracted by the hero's index. All wavelengths leave a pane with parallel faces in the direction
// they came, so all four stay.
bool PathTracer::connect_onwards(Path& path) {
  if (const PreparedMedium* medium = medium_of(path)) {
    RandomStream random(stream_of(path, RayRandom::flight));
    path.throughput = path.throughput * transmittance(*medium, flight_of(path), path.wavelengths, random);
    if (is_black(path.throughput)) return false;
  }
  const bool refracts = path.travelled == 0;
  if (path.hit.triangle == no_triangle) {
    if (!refracts || points_at_distant_light(scene_.lights, cast<double>(path.ray.direction)))
      deposit(path.pixel, path.sample, path.sensor, path.throughput);
    return false;
  }
  Interaction at = interaction_at(path);
  const Surface& surface = surface_at(path);
  const MaterialKind& kind = scene_.materials.kind(surface.material);
  const bool passes = kind.is_interface || !is_there(path, surface, at);
  const double left = refracts ? 0 : path.travelled - path.hit.t * length(cast<double>(path.ray.direction));
  if (!refracts && left <= 0) {
    deposit(path.pixel, path.sample, path.sensor, path.throughput);
    return false;
  }
  if (refracts && kind.smooth_dielectric && !passes) {
    if (!refract_connection(path, at, surface)) return false;
  } else {
    if (!passes) {
      path.throughput =
          path.throughput * scene_.materials.passes_straight(surface.material, at, path.wavelengths);
      path.depth += manifest_.settings.straight_counts || refracts;
    }
    if (is_black(path.throughput)) return false;
    continue_straight(path, at, surface);
    set_end(path, left);
  }
  if (passes) return true;
  return path.depth <=
         (refracts ? max_surfaces_crossed : static_cast<std::uint32_t>(manifest_.settings.max_depth));
}

bool PathTracer::refract_connection(Path& path, const Interaction& at, const Surface& surface) const {
  const Material& record = manifest_.materials[surface.material];
  const auto& material = std::get<DielectricMaterial>(record.model);
  const SampledSpectrum eta = relative_index(material, at, path.wavelengths);
  const Vector3d normal = scene_.materials.shading_normal(record, at) * at.side();
  Vector3d direction;
  if (!refract(at.out, normal, static_cast<double>(eta[0]), direction)) return false;
  const double cosine = dot(at.out, normal);
  for (std::size_t i = 0; i < hero_count; ++i)
    path.throughput.v[i] *= static_cast<float>(1 - fresnel_dielectric(cosine, static_cast<double>(eta.v[i])));
  path.throughput = path.throughput * scene_.textures.spectrum(material.transmittance_factor,
                                                               at.texture_point(), path.wavelengths);
  if (is_black(path.throughput)) return false;
  ++path.depth;
  continue_from(path, at, surface, direction);
  set_end(path, 0);
  return true;
}

}  // namespace vitrail
