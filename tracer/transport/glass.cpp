// SPDX-License-Identifier: Apache-2.0
#include "tracer/transport/glass.h"

#include <algorithm>
#include <cmath>
#include <type_traits>

#include "scene/geometry/portable_math.h"
#include "tracer/bsdf/local.h"
#include "tracer/bsdf/local_lanes.h"
#include "tracer/transport/parting.h"
#include "tracer/transport/photon_history.h"

namespace vitrail {

namespace {

template <class T>
constexpr bool is_photon = std::is_same_v<T, PhotonPath>;

// A smooth face of glass where it has come to it.
struct GlassFace {
  const Material& record;
  const DielectricMaterial& material;
  Vector3d normal;                       // on its side
  SampledSpectrum eta;                   // as of `refract`
  double cosine = 1;                     // of its way to the normal
  double outside = 1;                    // and behind the face, of the hero
  double q = 0;                          // Q/I that comes to it,
  double q_reflected = 0, q_passed = 0;  // and of what it leaves
  SampledSpectrum reflectance;           // by wavelength
  double reflects = 0;                   // the chance that it is reflected

  double hero_eta() const { return static_cast<double>(eta[0]); }
  MetFace met(const Interaction& at, const SampledWavelengths& wavelengths) const {
    return {normal, near_index(material, at, wavelengths), hero_eta()};
  }
};

bool is_pane_of(const Scatterer& s, const Interaction& at) {
  return s.pane.within || (at.front && !at.exterior_eta);
}

bool passes_for_nothing(const Tracing& tracing, const CameraPath& path, const Interaction& at) {
  return is_spent(tracing, path) && sees_through(tracing, path, at);
}
bool passes_for_nothing(const Tracing& tracing, const PhotonPath& photon, const Interaction& at) {
  return sees_through(tracing, photon, at);
}

// The share that a face reflects of what is carried, by wavelength in `reflectance`. One choice for all
// wavelengths, by their mean: the sum of its throughput never grows. In a pane the wavelengths differ in
// their angle, but share the one outside; reflectance is the same from both sides.
double reflect_share(const Scatterer& s, GlassFace& face) {
  const bool share_outside = s.pane.within && s.pane.parts;
  double reflected = 0, polarized = 0, all = 0;
  for (std::size_t i = 0; i < s.active_wavelengths(); ++i) {
    const double e = static_cast<double>(face.eta.v[i]), carries = static_cast<double>(s.throughput.v[i]);
    const auto r = share_outside ? lanes::fresnel_polarized(face.outside, 1 / e)
                                 : lanes::fresnel_polarized(face.cosine, e);
    face.reflectance.v[i] = static_cast<float>(lanes::part_of(face.q, r));
    reflected += carries * static_cast<double>(face.reflectance.v[i]);
    polarized += carries * lanes::polarized_part_of(face.q, r);
    all += carries;
  }
  face.q_reflected = lanes::q_of(polarized, reflected);
  face.q_passed = lanes::q_of(face.q * all - polarized, all - reflected);
  return reflected / all;
}

// Where the wavelengths have parted too far in its pane.
void part_within(const Tracing& tracing, Scatterer& s, const Interaction& at, const GlassFace& face) {
  if (!s.pane.within || !s.pane.parts) return;
  const double thickness = s.hit.t * length(cast<double>(s.ray.direction)) * face.cosine;
  s.pane.parts = !parts_aside(tracing, s, at.p, face.eta, thickness, face.outside);
  if (!s.pane.parts) s.disperse();
}

template <class T>
void reflect_at(const Tracing& tracing, T& t, const Event& event, const GlassFace& face,
                Vector3d& direction) {
  const Interaction& at = event.at;
  direction = face.normal * (2 * face.cosine) - at.out;
  if constexpr (is_photon<T>) turn_at_face(tracing, t, event, face.met(at, t.wavelengths), direction);
  t.throughput =
      t.throughput * face.reflectance * static_cast<float>(1 / face.reflects) *
      tracing.scene.textures.spectrum(face.material.reflectance_factor, at.texture_point(), t.wavelengths);
}

// Dispersion ends the secondary wavelengths where their ways part. Through a pane of parallel faces they do
// not: all leave in the direction they came, less than a pixel beside each other. So they stay until a face
// is met that is not parallel to the one they entered by.
void pass_into(const Tracing& tracing, Scatterer& s, const Interaction& at, const GlassFace& face) {
  const bool in_pane = s.pane.within;
  s.pane.within = false;
  const bool parts = !in_pane && tracing.scene.materials.disperses(face.record, at) && !s.dispersed;
  if (!in_pane && at.front && !at.exterior_eta)
    s.pane = {true, parts, false, encode_face(face.normal), {}};
  else if (parts)
    s.disperse();
}

// Into `direction`, as the hero goes.
template <class T>
void refract_at(const Tracing& tracing, T& t, const Event& event, const GlassFace& face,
                Vector3d& direction) {
  const Interaction& at = event.at;
  if constexpr (is_photon<T>) pass_interface(tracing, t, event, face.met(at, t.wavelengths), direction);
  // Radiance is compressed into the smaller solid angle by 1/η² (Veach 1997, §5.2), power is not.
  for (std::size_t i = 0; i < t.active_wavelengths(); ++i) {
    const double e = static_cast<double>(face.eta.v[i]);
    t.throughput.v[i] *= static_cast<float>((1 - static_cast<double>(face.reflectance.v[i])) /
                                            (1 - face.reflects) / (is_photon<T> ? 1 : e * e));
  }
  t.throughput = t.throughput * tracing.scene.textures.spectrum(face.material.transmittance_factor,
                                                                at.texture_point(), t.wavelengths);
  pass_into(tracing, t, at, face);
}

// Counts the event, but one that is for nothing: that is owed where a pane is entered. False when it ends
// here.
template <class T>
bool count_event(const Tracing& tracing, T& t, float u, bool for_nothing) {
  t.pdf = 0;
  if (!for_nothing) {
    t.pane.owes = false;
    if constexpr (is_photon<T>) t.counted = true;
    return go_on(tracing, t, u, true);
  }
  if constexpr (!is_photon<T>) t.travelled = 0;
  t.pane.owes = t.pane.within;
  t.passed = !t.pane.owes;
  return true;
}

template <class T>
bool scatter(const Tracing& tracing, T& t, const Event& event) {
  const Interaction& at = event.at;
  const Materials& materials = tracing.scene.materials;
  const Material& record = tracing.manifest().materials[event.surface.material];
  const auto& material = std::get<DielectricMaterial>(record.model);
  const Vector3d normal = materials.shading_normal(record, at) * at.side();
  if (t.pane.within && !is_parallel(t.pane.face, normal) && !leave_pane(t)) return false;
  const bool spent = is_spent(tracing, t);
  if (spent && !sees_through(tracing, t, at)) return false;
  GlassFace face{record, material, normal, relative_index(material, at, t.wavelengths)};
  face.cosine = dot(at.out, normal);
  face.q = polarization_at(t, normal);
  face.outside = safe_sqrt(1 - (1 - face.cosine * face.cosine) / (face.hero_eta() * face.hero_eta()));
  part_within(tracing, t, at, face);

  const double share = reflect_share(t, face);
  face.reflects = spent ? 0 : attainable(share);
  Vector3d direction;
  const std::array<float, 4> u = numbers_for_scattering(t);
  bool for_nothing = false;
  if (static_cast<double>(u[2]) < face.reflects) {
    reflect_at(tracing, t, event, face, direction);
    t.pane.meet(normal, face.q_reflected, u[0]);
  } else {
    if (!refract(at.out, normal, face.hero_eta(), direction)) return false;
    for_nothing = passes_for_nothing(tracing, t, at);
    refract_at(tracing, t, event, face, direction);
    t.pane.meet(normal, face.q_passed, u[0]);
  }
  if constexpr (is_photon<T>) t.throughput = t.throughput * adjoint_of_shading(at, normal, direction);
  if (is_black(t.throughput) || !count_event(tracing, t, u[3], for_nothing)) return false;
  continue_from(tracing, t, at, event.surface, direction);
  return true;
}

}  // namespace

bool sees_through(const Tracing& tracing, const CameraPath& path, const Interaction& at) {
  return !path.only_straight && !tracing.settings().direct_only && is_pane_of(path, at);
}
bool sees_through(const Tracing& tracing, const PhotonPath& photon, const Interaction& at) {
  return !tracing.settings().direct_only && !photon.scattered && !photon.counted && is_pane_of(photon, at);
}

bool scatter_dielectric(const Tracing& tracing, CameraPath& path, const Event& event) {
  return scatter(tracing, path, event);
}
bool scatter_dielectric(const Tracing& tracing, PhotonPath& photon, const Event& event) {
  return scatter(tracing, photon, event);
}

}  // namespace vitrail
