// SPDX-License-Identifier: Apache-2.0
// Smooth glass: what a path or a photon does at its faces, and what panes, whose faces are parallel, let
// through as it came.
#include <algorithm>
#include <cmath>

#include "scene/geometry/portable_math.h"
#include "tracer/bsdf/local.h"
#include "tracer/paths/path_state.h"
#include "tracer/paths/path_tracer.h"
#include "tracer/paths/photon_tracing.h"

namespace vitrail {

// Whether it scatters no more. A photon is scattered once more, where it is gathered.
bool PathTracer::is_spent(const Path& path) const {
  return path.depth + (flies() ? 2 : 1) > static_cast<std::uint32_t>(manifest_.settings.max_depth);
}

// Depth counts scatterings, each face of glass among them. What passes panes on its way between the last
// scattering and its light is not counted, as connections to the sun are not: a path that is spent goes on
// through them, by what they transmit, and so does a photon that has met nothing else yet.
bool PathTracer::sees_through(const Path& path, const Interaction& at) const {
  if ((path.depth & scattered_once) || manifest_.settings.direct_only) return false;
  if (flies() && (path.sample & (photon_scattered | photon_counted))) return false;
  return path.is(path_in_pane) || (at.front && !at.exterior_eta);
}

bool PathTracer::passes_for_nothing(const Path& path, const Interaction& at) const {
  return (flies() || is_spent(path)) && sees_through(path, at);
}

// Of a sheet, or of what is not there of it.
void PathTracer::count_straight(Path& path) const {
  if (!manifest_.settings.straight_counts) return;
  ++path.depth;
  if (flies()) path.sample |= photon_counted;
}

// At anything in glass but a face parallel to the one it entered by: the wavelengths part, and entering
// counts. False where that was one scattering too many.
bool PathTracer::leave_pane(Path& path) const {
  if (!path.is(path_in_pane)) return true;
  path.clear(path_in_pane);
  if (path.parts) path.disperse();
  if (!path.owes) return true;
  path.owes = false;
  ++path.depth;
  if (!flies()) return false;
  path.sample |= photon_counted;
  return true;
}

// How wide what a pixel sees about p is.
double PathTracer::pixel_width(const Path& path, Point3d p) const {
  const Point3d seen = transform_point(bundle_to_camera(path), p);
  return scene_.pixel.width + scene_.pixel.angle_rad * length(seen - Point3d{});
}

// Wavelengths leave a slab beside each other: thickness · (tan θ_a − tan θ_b) along its face. Whether that is
// more than an eighth of a pixel across their way. `eta` as of `refract` where they leave; `outside`: the
// cosine there. The same for all wavelengths of a path, whichever is its hero.
bool PathTracer::parts_aside(const Path& path, Point3d p, const SampledSpectrum& eta, double thickness,
                             double outside) const {
  constexpr double visible = 1.0 / 8;
  const auto [least, most] = std::minmax_element(eta.v.begin(), eta.v.end());
  const double sine2 = 1 - outside * outside;
  const auto tangent = [&](float relative) {
    const double n = 1 / static_cast<double>(relative);
    return std::sqrt(sine2 / std::max(n * n - sine2, 1e-12));
  };
  const double aside = thickness * (tangent(*most) - tangent(*least)) * outside;
  const double width = pixel_width(path, p);
  return width > 0 && aside > visible * width;
}

// The share that a face reflects of what the path carries, by wavelength in `reflectance`. One choice for all
// wavelengths, by their mean: the sum of its throughput never grows. In a pane the wavelengths differ in
// their angle, but share the one outside; reflectance is the same from both sides.
double PathTracer::reflect_share(const Path& path, const SampledSpectrum& eta, double cosine, double outside,
                                 SampledSpectrum& reflectance) const {
  const bool share_outside = path.is(path_in_pane) && path.parts;
  double reflected = 0, all = 0;
  for (std::size_t i = 0; i < path.active_wavelengths(); ++i) {
    const double e = static_cast<double>(eta.v[i]);
    reflectance.v[i] = static_cast<float>(share_outside ? fresnel_dielectric(outside, 1 / e)
                                                        : fresnel_dielectric(cosine, e));
    reflected += static_cast<double>(path.throughput.v[i]) * static_cast<double>(reflectance.v[i]);
    all += static_cast<double>(path.throughput.v[i]);
  }
  return reflected / all;
}

// False when the path ends here.
bool PathTracer::count_refraction(Path& path, float u, bool for_nothing) const {
  path.pdf = 0;
  if (!for_nothing) {
    path.owes = false;
    if (flies()) path.sample |= photon_counted;
    return go_on(path, u, true);
  }
  path.travelled = 0;
  path.clear(path_passed);
  path.owes = path.is(path_in_pane);
  if (!path.owes) path.set(path_passed);
  return true;
}

// A smooth face of glass where a path has come to it.
struct PathTracer::GlassFace {
  const Material& record;
  const DielectricMaterial& material;
  Vector3d normal;              // on the path's side
  SampledSpectrum eta;          // as of `refract`
  double cosine = 1;            // of the path to the normal
  double outside = 1;           // and behind the face, of the hero
  SampledSpectrum reflectance;  // by wavelength
  double reflects = 0;          // the chance that the path is reflected

  double hero_eta() const { return static_cast<double>(eta[0]); }
  MetFace met(const Interaction& at, const SampledWavelengths& wavelengths) const {
    return {normal, near_index(material, at, wavelengths), hero_eta()};
  }
};

// Where the wavelengths of a path have parted too far in its pane.
void PathTracer::part_within(Path& path, const Interaction& at, const SampledSpectrum& eta, double cosine,
                             double outside) const {
  if (!path.is(path_in_pane) || !path.parts) return;
  const double thickness = path.hit.t * length(cast<double>(path.ray.direction)) * cosine;
  path.parts = !parts_aside(path, at.p, eta, thickness, outside);
  if (!path.parts) path.disperse();
}

void PathTracer::reflect_at(Path& path, const Interaction& at, const Surface& surface, const GlassFace& face,
                            Vector3d& direction) const {
  direction = face.normal * (2 * face.cosine) - at.out;
  if (flies()) turn_at_face(path, at, surface, face.met(at, path.wavelengths), direction);
  path.throughput =
      path.throughput * face.reflectance * static_cast<float>(1 / face.reflects) *
      scene_.textures.spectrum(face.material.reflectance_factor, at.texture_point(), path.wavelengths);
}

// Into `direction`, as the hero goes.
void PathTracer::refract_at(Path& path, const Interaction& at, const Surface& surface, const GlassFace& face,
                            Vector3d& direction) const {
  if (flies()) pass_interface(path, at, surface, face.met(at, path.wavelengths), direction);
  // Radiance is compressed into the smaller solid angle by 1/η² (Veach 1997, §5.2), power is not.
  for (std::size_t i = 0; i < path.active_wavelengths(); ++i) {
    const double e = static_cast<double>(face.eta.v[i]);
    path.throughput.v[i] *= static_cast<float>((1 - static_cast<double>(face.reflectance.v[i])) /
                                               (1 - face.reflects) / (flies() ? 1 : e * e));
  }
  path.throughput = path.throughput * scene_.textures.spectrum(face.material.transmittance_factor,
                                                               at.texture_point(), path.wavelengths);
  pass_into(path, at, face);
}

// Dispersion ends the secondary wavelengths where their ways part. Through a pane of parallel faces they do
// not: all leave in the direction they came, less than a pixel beside each other. So they stay until the path
// meets a face that is not parallel to the one it entered by.
void PathTracer::pass_into(Path& path, const Interaction& at, const GlassFace& face) const {
  const bool in_pane = path.is(path_in_pane);
  path.clear(path_in_pane);
  const bool parts = !in_pane && scene_.materials.disperses(face.record, at) && !path.is(path_dispersed);
  if (!in_pane && at.front && !at.exterior_eta) {
    path.set(path_in_pane);
    path.entered_by = encode_face(face.normal);
    path.parts = parts;
    path.owes = false;
  } else if (parts) {
    path.disperse();
  }
}

// False when the path ends here.
bool PathTracer::scatter_dielectric(Path& path, const Interaction& at, const Surface& surface) {
  const Material& record = manifest_.materials[surface.material];
  const auto& material = std::get<DielectricMaterial>(record.model);
  const Vector3d normal = scene_.materials.shading_normal(record, at) * at.side();
  if (path.is(path_in_pane) && !is_parallel(path.entered_by, normal) && !leave_pane(path)) return false;
  const bool spent = is_spent(path);
  if (spent && !sees_through(path, at)) return false;
  GlassFace face{record, material, normal, relative_index(material, at, path.wavelengths)};
  face.cosine = dot(at.out, normal);
  face.outside = safe_sqrt(1 - (1 - face.cosine * face.cosine) / (face.hero_eta() * face.hero_eta()));
  part_within(path, at, face.eta, face.cosine, face.outside);

  const double share = reflect_share(path, face.eta, face.cosine, face.outside, face.reflectance);
  face.reflects = spent ? 0 : attainable(share);
  Vector3d direction;
  const std::array<float, 4> u = numbers_for_scattering(path);
  bool for_nothing = false;
  if (static_cast<double>(u[2]) < face.reflects) {
    reflect_at(path, at, surface, face, direction);
  } else {
    if (!refract(at.out, normal, face.hero_eta(), direction)) return false;
    for_nothing = passes_for_nothing(path, at);
    refract_at(path, at, surface, face, direction);
  }
  if (flies()) path.throughput = path.throughput * adjoint_of_shading(at, normal, direction);
  if (is_black(path.throughput) || !count_refraction(path, u[3], for_nothing)) return false;
  continue_from(path, at, surface, direction);
  return true;
}

}  // namespace vitrail
