// SPDX-License-Identifier: Apache-2.0
// What happens at a hit: emission, connections to lights, scattering.
#include <limits>

#include "tracer/bsdf/local.h"
#include "tracer/path_state.h"
#include "tracer/path_tracer.h"
#include "tracer/portable_math.h"

namespace vitrail {

namespace {

constexpr std::uint32_t roulette_depth = 3;
constexpr std::uint32_t max_panes_crossed = 32;  // surfaces a connection goes through before it is given up
// A shadow ray ends this much before its light, relative to the distance.
constexpr double shadow_end = 1 - 1e-4;

Vector3d interpolated_normal(const ClusterNormals& normals, const Hit& hit) {
  const auto& code = normals.normal[hit.lane];
  if (code[0] == no_normal) return {};
  const auto at = [&](int i) { return cast<double>(to_vector(decode_normal(code[i]))); };
  return at(0) * (1 - hit.u - hit.v) + at(1) * hit.u + at(2) * hit.v;
}

}  // namespace

PathTracer::Interaction PathTracer::interaction_at(const Path& path) const {
  const DomainView& domain = *resident_[path.hit_domain];
  const Cluster& cluster = domain.clusters[path.hit.cluster];
  const auto vertex = [&](int i) {
    const auto& v = cluster.vertex[i];
    return cast<double>(Point3f{v[0][path.hit.lane], v[1][path.hit.lane], v[2][path.hit.lane]});
  };
  const Point3d p0 = vertex(0);
  const Vector3d e1 = vertex(1) - p0, e2 = vertex(2) - p0;

  Interaction at;
  at.p = p0 + e1 * path.hit.u + e2 * path.hit.v;
  at.out = normalize(-cast<double>(path.ray.direction));
  at.geometric = normalize(cross(e1, e2));
  at.front = dot(at.out, at.geometric) > 0;
  at.triangle = path.hit.triangle;
  at.shading = at.geometric;
  if (!domain.normals.empty()) {
    Vector3d n = normalize(interpolated_normal(domain.normals[path.hit.cluster], path.hit));
    if (dot(n, at.geometric) < 0) n = -n;
    // A shading normal that the ray sees from the other side than the surface cannot be used.
    if ((dot(at.out, n) > 0) == at.front && dot(n, n) > 0.5) at.shading = n;
  }
  return at;
}

// False when the path ends here.
bool PathTracer::shade(Path& path) {
  if (path.hit.triangle == no_triangle) {
    if (path.is(path_in_pane)) path.disperse();
    if (!path.is(path_connection))
      deposit(path.pixel, path.sample, path.sensor,
              path.throughput * sky_radiance(scene_.lights, manifest_, path.wavelengths));
    else if (points_at_distant_light(scene_.lights, manifest_, cast<double>(path.ray.direction)))
      deposit(path.pixel, path.sample, path.sensor, path.throughput);
    return false;
  }
  const Interaction at = interaction_at(path);
  if (path.is(path_connection)) return connect_onwards(path, at);

  const Surface& surface = surface_of(manifest_, path.hit.triangle);
  const bundle::Material& material = manifest_.materials[surface.material];
  // Only the far face of a pane lets the wavelengths out the way they came in.
  if (path.is(path_in_pane) && (at.front || !std::holds_alternative<bundle::DielectricMaterial>(material)))
    path.disperse();
  if (surface.area_light >= 0)
    add_emission(path, at, manifest_.area_lights[static_cast<std::size_t>(surface.area_light)],
                 surface.area_light);
  if (std::holds_alternative<bundle::InterfaceMaterial>(material)) {
    continue_from(path, at, -at.out);
    path.pdf = 0;  // shadow rays end at the interface, so this path alone finds the lights behind it
    return true;
  }
  if (path.depth >= static_cast<std::uint32_t>(manifest_.settings.max_depth)) return false;
  if (const auto* diffuse = std::get_if<bundle::DiffuseMaterial>(&material))
    return scatter_diffuse(path, at, *diffuse);
  return scatter_dielectric(path, at, std::get<bundle::DielectricMaterial>(material));
}

void PathTracer::add_emission(const Path& path, const Interaction& at, const bundle::AreaLight& light,
                              std::int32_t index) {
  if (!at.front && !light.two_sided) return;
  double weight = 1;
  if (path.pdf > 0) {
    const double cosine = std::abs(dot(at.out, at.geometric));
    const double area_pdf = static_cast<double>(scene_.lights.area_pdf[static_cast<std::size_t>(index)]);
    const double pdf = static_cast<double>(path.pdf);
    // Both sides of p_bsdf / (p_bsdf + p_area·t²/cos) times cos: no division by a grazing cosine.
    weight = pdf * cosine / (pdf * cosine + area_pdf * path.hit.t * path.hit.t);
  }
  deposit(path.pixel, path.sample, path.sensor,
          path.throughput * evaluate(light.radiance, path.wavelengths) * static_cast<float>(weight));
}

bool PathTracer::scatter_diffuse(Path& path, const Interaction& at, const bundle::DiffuseMaterial& material) {
  const SampledSpectrum reflectance = evaluate(material.reflectance, path.wavelengths);
  if (is_black(path.throughput * reflectance)) return false;
  if (scene_.lights.choices() > 0) connect_to_light(path, at, reflectance);

  const double side = at.front ? 1 : -1;
  const std::array<float, 4> u = sample_4d(key_of(path.pixel, path.sample), sample_set::scatter(path.depth));
  const Vector3d local = sample_cosine_hemisphere(u[0], u[1]);
  const Vector3d direction = Frame(at.shading * side).to_world(local);
  if (dot(direction, at.geometric) * side <= 0) return false;
  path.throughput = path.throughput * reflectance;
  path.pdf = pdf_value(pdf_code(static_cast<float>(local.z / pi)));
  if (!(path.pdf > 0)) return false;

  ++path.depth;
  if (manifest_.settings.direct_only) {
    path.depth = static_cast<std::uint32_t>(manifest_.settings.max_depth);
  } else if (path.depth > roulette_depth) {
    const float survival = max_value(path.throughput) * (path.is(path_dispersed) ? 1.0f / hero_count : 1.0f);
    if (survival < 1) {
      if (u[3] >= survival) return false;
      path.throughput = path.throughput * (1 / survival);
    }
  }
  continue_from(path, at, direction);
  return true;
}

void PathTracer::connect_to_light(const Path& path, const Interaction& at,
                                  const SampledSpectrum& reflectance) {
  const std::array<float, 4> u = sample_4d(key_of(path.pixel, path.sample), sample_set::light(path.depth));
  const auto light = sample_light(scene_.lights, manifest_, at.p, u, path.wavelengths);
  if (!light) return;
  const double side = at.front ? 1 : -1;
  const double cosine = dot(light->to_light, at.shading) * side;
  if (cosine <= 0 || dot(light->to_light, at.geometric) * side <= 0) return;

  double weight = 1 / light->pdf;
  if (!light->is_delta) {
    const auto bsdf_pdf = static_cast<double>(pdf_value(pdf_code(static_cast<float>(cosine / pi))));
    weight = 1 / (light->pdf + bsdf_pdf);
  }
  const SampledSpectrum radiance =
      path.throughput * reflectance * light->radiance * static_cast<float>(cosine / pi * weight);
  if (is_black(radiance)) return;

  const bool distant = std::isinf(light->distance);
  ++counters_.rays_shadow;
  if (distant && (manifest_.requirements.transmission || manifest_.requirements.interfaces)) {
    Path connection = path;
    connection.set(path_connection);
    connection.throughput = radiance;
    connection.depth = 0;
    continue_from(connection, at, light->to_light);
    const std::size_t waiting = outbox_.paths.size();
    const std::uint64_t died = counters_.died, indirect = counters_.rays_indirect;
    run(connection, std::nullopt);
    // A connection that ended here was never counted as alive; its segments behind panes are shadow rays.
    if (outbox_.paths.size() > waiting) ++counters_.born;
    counters_.died = died;
    counters_.rays_shadow += counters_.rays_indirect - indirect;
    counters_.rays_indirect = indirect;
    return;
  }
  ShadowRecord r;
  const Point3f origin = offset_origin(at, light->to_light);
  r.origin[0] = origin.x;
  r.origin[1] = origin.y;
  r.origin[2] = origin.z;
  r.direction = encode_direction(light->to_light);
  r.tmax = distant ? std::numeric_limits<float>::max() : static_cast<float>(light->distance * shadow_end);
  r.exclude = at.triangle;
  for (std::size_t i = 0; i < hero_count; ++i) pack_radiance(std::max(0.0f, radiance.v[i]), r.radiance[i]);
  r.pixel = path.pixel;
  r.sample = path.sample;
  trace_shadow(r, &path.sensor, std::nullopt);
}

namespace {

// Indices behind over before the interface at the four wavelengths.
SampledSpectrum relative_index(const bundle::DielectricMaterial& material,
                               const SampledWavelengths& wavelengths, bool front) {
  SampledSpectrum eta = evaluate(material.eta, wavelengths);
  if (!front)
    for (float& e : eta.v) e = 1 / e;
  return eta;
}

}  // namespace

// A connection goes straight through every pane: refracted in and out by the hero's index. All wavelengths
// leave a pane with parallel faces in the direction they came, so all four stay.
bool PathTracer::connect_onwards(Path& path, const Interaction& at) {
  const Surface& surface = surface_of(manifest_, path.hit.triangle);
  const bundle::Material& material = manifest_.materials[surface.material];
  Vector3d direction = -at.out;
  if (const auto* dielectric = std::get_if<bundle::DielectricMaterial>(&material)) {
    const SampledSpectrum eta = relative_index(*dielectric, path.wavelengths, at.front);
    const Vector3d normal = at.shading * (at.front ? 1.0 : -1.0);
    if (!refract(at.out, normal, static_cast<double>(eta[0]), direction)) return false;
    const double cosine = dot(at.out, normal);
    for (std::size_t i = 0; i < hero_count; ++i)
      path.throughput.v[i] *=
          static_cast<float>(1 - fresnel_dielectric(cosine, static_cast<double>(eta.v[i])));
  } else if (!std::holds_alternative<bundle::InterfaceMaterial>(material)) {
    return false;
  }
  if (++path.depth > max_panes_crossed) return false;
  continue_from(path, at, direction);
  return true;
}

// Dispersion ends the secondary wavelengths where their ways part. Through a pane of parallel faces they do
// not: all leave in the direction they came, micrometres apart. So they stay until the path meets a face that
// is not parallel to the one it entered by.
bool PathTracer::scatter_dielectric(Path& path, const Interaction& at,
                                    const bundle::DielectricMaterial& material) {
  const Vector3d normal = at.shading * (at.front ? 1.0 : -1.0);
  if (path.is(path_in_pane) && !is_parallel(path.entered_by, normal)) path.disperse();
  const bool in_pane = path.is(path_in_pane);
  const SampledSpectrum eta = relative_index(material, path.wavelengths, at.front);
  const double hero_eta = static_cast<double>(eta[0]), cosine = dot(at.out, normal);
  // Inside a pane the wavelengths differ in their angle, but share the one outside; reflectance is the same
  // from both sides.
  const double outside = safe_sqrt(1 - (1 - cosine * cosine) / (hero_eta * hero_eta));

  // One choice for all wavelengths, by their mean reflectance: no weight exceeds their number.
  SampledSpectrum reflectance;
  const std::size_t active = path.is(path_dispersed) ? 1 : hero_count;
  double mean = 0;
  for (std::size_t i = 0; i < active; ++i) {
    const double e = static_cast<double>(eta.v[i]);
    reflectance.v[i] =
        static_cast<float>(in_pane ? fresnel_dielectric(outside, 1 / e) : fresnel_dielectric(cosine, e));
    mean += static_cast<double>(reflectance.v[i]) / static_cast<double>(active);
  }
  const float u = sample_4d(key_of(path.pixel, path.sample), sample_set::scatter(path.depth))[2];
  const double side = at.front ? 1 : -1;
  Vector3d direction;
  if (static_cast<double>(u) < mean) {
    direction = normal * (2 * cosine) - at.out;
    if (dot(direction, at.geometric) * side <= 0) return false;
    path.throughput = path.throughput * reflectance * static_cast<float>(1 / mean);
  } else {
    if (!refract(at.out, normal, hero_eta, direction)) return false;
    if (dot(direction, at.geometric) * side >= 0) return false;
    // Radiance is compressed into the smaller solid angle by 1/η² (Veach 1997, §5.2).
    for (std::size_t i = 0; i < active; ++i) {
      const double e = static_cast<double>(eta.v[i]);
      path.throughput.v[i] *=
          static_cast<float>((1 - static_cast<double>(reflectance.v[i])) / (1 - mean) / (e * e));
    }
    if (in_pane) {
      path.clear(path_in_pane);
    } else if (!is_constant(material.eta) && !path.is(path_dispersed)) {
      if (at.front) {
        path.set(path_in_pane);
        path.entered_by = encode_face(normal);
      } else {
        path.disperse();
      }
    }
  }
  if (is_black(path.throughput)) return false;
  ++path.depth;
  path.pdf = 0;
  continue_from(path, at, direction);
  return true;
}

// Starts the next ray at the hit. The triangle it leaves is excluded by id; the offset keeps it from its
// neighbours.
void PathTracer::continue_from(Path& path, const Interaction& at, Vector3d direction) const {
  path.direction = encode_direction(direction);
  path.ray = {offset_origin(at, direction), decode_direction(path.direction), at.triangle};
  path.hit = {};
}

// Moves the hit along the normal, to the side of `direction`, by more than rounding to float can move it
// back.
Point3f PathTracer::offset_origin(const Interaction& at, Vector3d direction) const {
  const double rounding = 0x1p-24 * (std::abs(at.geometric.x * at.p.x) + std::abs(at.geometric.y * at.p.y) +
                                     std::abs(at.geometric.z * at.p.z));
  const double distance = 3 * rounding + 1e-9 * static_cast<double>(manifest_.scale);
  const double side = dot(direction, at.geometric) >= 0 ? 1 : -1;
  return cast<float>(at.p + at.geometric * (side * distance));
}

}  // namespace vitrail
