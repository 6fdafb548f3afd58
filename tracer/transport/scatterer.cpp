// SPDX-License-Identifier: Apache-2.0
#include "tracer/transport/scatterer.h"

#include <algorithm>
#include <cmath>

#include "tracer/bsdf/local.h"
#include "tracer/transport/photon_history.h"

namespace vitrail {

namespace {

// A ray that total reflection holds in a glass would go on for ever: beyond this depth mirrors and interfaces
// let go of one in 64.
constexpr std::uint32_t long_chain = 254;
constexpr float chain_survival = 63.0f / 64;

// In which cones' widths are counted.
double cone_unit(const Manifest& manifest) {
  const Bounds3f core = core_of(manifest);
  double greatest = 1e-30;
  for (int axis = 0; axis < 3 && !core.empty(); ++axis)
    greatest =
        std::max({greatest, -static_cast<double>(core.lower[axis]), static_cast<double>(core.upper[axis])});
  return greatest;
}

// By `lives`, the chance of it unless it is `specular`.
bool lives_on(Scatterer& s, float lives, float u, bool specular, bool no_more) {
  ++s.depth;
  s.passed = false;
  if (specular) {
    if (s.depth > long_chain) {
      if (u >= chain_survival) return false;
      s.throughput = s.throughput * (1 / chain_survival);
    }
    return true;
  }
  if (no_more) {
    s.only_straight = true;
  } else if (lives < 1) {
    if (u >= lives) return false;
    s.throughput = s.throughput * (1 / lives);
  }
  return true;
}

// Takes it out of a pane, if it is in one. Whether it owed a scattering for entering, which is counted now.
bool owed_for_pane(Scatterer& s) {
  if (!s.pane.within) return false;
  s.pane.within = false;
  if (s.pane.parts) s.disperse();
  if (!s.pane.owes) return false;
  s.pane.owes = false;
  ++s.depth;
  return true;
}

MetMaterial scattering(const Tracing& tracing, Scatterer& s, const Event& event, const Material& material) {
  const Materials& materials = tracing.scene.materials;
  if (materials.disperses(material, event.at)) s.disperse();
  return {materials.scatters(material, event.at) ? &material : nullptr, false};
}

}  // namespace

std::array<float, 4> numbers_for_scattering(const Scatterer& s, Wanted wanted) {
  if (s.passed || (s.pane.within && s.pane.owes)) return hashed_4d(stream_of(s, RayRandom::scattering));
  return sample_4d(s.key, sample_set::scatter(s.numbered_depth()), wanted);
}

bool leave_pane(CameraPath& path) { return !owed_for_pane(path); }
bool leave_pane(PhotonPath& photon) {
  if (owed_for_pane(photon)) photon.counted = true;
  return true;
}

RayCone cone_of(const Tracing& tracing, const Scatterer& s, std::uint32_t sample) {
  if (!tracing.requirements().filtering) return {};
  double angle = angle_between_rays(tracing, sample);
  if (s.pdf > 0) angle = std::max(angle, 0.05 / std::sqrt(static_cast<double>(s.pdf)));
  return {cone_value(s.cone) * cone_unit(tracing.manifest()), std::min(angle, 1.0)};
}

void widen_cone(const Tracing& tracing, Scatterer& s, std::uint32_t sample, double distance) {
  if (!tracing.requirements().filtering) return;
  s.cone = cone_code(cone_of(tracing, s, sample).at(distance) / cone_unit(tracing.manifest()));
}

void pass_straight(const Tracing& tracing, CameraPath& path, const Interaction& at, const Surface* surface) {
  const double travelled = path.travelled + path.hit.t * length(cast<double>(path.ray.direction));
  path.travelled = 0;
  if (path.pdf > 0) {
    RandomStream random(stream_of(path, RayRandom::distance));
    path.travelled = static_cast<double>(
        rounded_distance(static_cast<float>(travelled), static_cast<std::uint32_t>(random.bits())));
  }
  continue_straight(tracing, path, at, surface);
}
void pass_straight(const Tracing& tracing, PhotonPath& photon, const Interaction& at,
                   const Surface* surface) {
  continue_straight(tracing, photon, at, surface);
}

void count_straight(const Tracing& tracing, CameraPath& path) {
  if (tracing.settings().straight_counts) ++path.depth;
}
void count_straight(const Tracing& tracing, PhotonPath& photon) {
  if (!tracing.settings().straight_counts) return;
  ++photon.depth;
  photon.counted = true;
}

double polarization_at(const Scatterer& s, Vector3d normal) {
  if (s.pane.polarization.code == 0) return 0;
  return seen_by_face(s.pane.polarization, decode_face(s.pane.face), cast<double>(s.ray.direction), normal);
}

namespace {

float survival(const Tracing& tracing, const Scatterer& s) {
  constexpr std::uint32_t longest = 254;
  const Roulette roulette = tracing.scene.sampling.roulette;
  if (roulette == Roulette::never && s.depth < longest) return 1;
  const float brightest = max_value(s.throughput) * (s.dispersed ? 1.0f / hero_count : 1.0f);
  return static_cast<float>(attainable(static_cast<double>(brightest / worth_going_on(roulette))));
}

}  // namespace

float survival(const Tracing& tracing, const CameraPath& path) {
  return path.connected ? survival(tracing, static_cast<const Scatterer&>(path)) : 1;
}

bool go_on(const Tracing& tracing, CameraPath& path, float u, bool specular, bool no_more) {
  path.travelled = 0;
  const float lives = survival(tracing, path);
  if (!specular) path.connected = true;
  return lives_on(path, lives, u, specular, no_more || tracing.settings().direct_only);
}
bool go_on(const Tracing& tracing, PhotonPath& photon, float u, bool specular) {
  return lives_on(photon, survival(tracing, photon), u, specular, false);
}

bool is_spent(const Tracing& tracing, const CameraPath& path) {
  return path.only_straight || path.depth >= static_cast<std::uint32_t>(tracing.settings().max_depth);
}
bool is_spent(const Tracing& tracing, const PhotonPath& photon) {
  return photon.depth + 2 > static_cast<std::uint32_t>(tracing.settings().max_depth);
}

void pass_nothing(const Tracing& tracing, CameraPath& path, const Surface& surface, const Interaction& at) {
  count_straight(tracing, path);
  pass_straight(tracing, path, at, &surface);
}

const Material* chosen_at(const Tracing& tracing, const Scatterer& s, const Surface& surface,
                          const Interaction& at) {
  // A ray from the camera excludes no triangle. One that has gone straight on does, and needs another number.
  const bool is_first = s.depth == 0 && s.ray.exclude == no_triangle;
  const std::uint64_t stream = stream_of(s, RayRandom::choice);
  MaterialNumbers numbers = is_first ? MaterialNumbers(stream, s.key) : MaterialNumbers(stream);
  return tracing.scene.materials.choose(surface.material, at, numbers);
}

MetMaterial material_at(const Tracing& tracing, CameraPath& path, const Event& event) {
  if (const Material* material = chosen_at(tracing, path, event.surface, event.at))
    return scattering(tracing, path, event, *material);
  pass_nothing(tracing, path, event.surface, event.at);
  return {nullptr, true};
}
MetMaterial material_at(const Tracing& tracing, PhotonPath& photon, const Event& event) {
  if (const Material* material = chosen_at(tracing, photon, event.surface, event.at))
    return scattering(tracing, photon, event, *material);
  count_straight(tracing, photon);
  if (event.kind.sheet) pass_sheet(photon);
  pass_straight(tracing, photon, event.at, &event.surface);
  return {nullptr, true};
}

Scattering scattering_at(const Tracing& tracing, const Scatterer& s, const Interaction& at,
                         const Material& material) {
  return tracing.scene.materials.scattering_at(material, at, s.wavelengths, s.throughput,
                                               stream_of(s, RayRandom::layers));
}

}  // namespace vitrail
