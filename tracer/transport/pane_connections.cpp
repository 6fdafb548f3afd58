// SPDX-License-Identifier: Apache-2.0
// Connections to distant lights through panes: what they do where they meet a face.
#include <algorithm>
#include <cmath>

#include "tracer/bsdf/local.h"
#include "tracer/bsdf/local_lanes.h"
#include "tracer/panes/parallel_faces.h"
#include "tracer/transport/connection.h"
#include "tracer/transport/parting.h"

namespace vitrail {

namespace {

// Beyond this many events, which no glazing takes, a walk ends one time in 64.
constexpr std::uint32_t long_walk = 1 << 15;
constexpr float walk_survival = 63.0f / 64;

// Of four wavelengths, as what is carried counts them.
double mean_of(const SampledSpectrum& throughput, const SampledSpectrum& s) {
  const double all = carried(throughput, filled(1));
  return all > 0 ? carried(throughput, s) / all : 0;
}

SampledSpectrum inverse_of(const SampledSpectrum& eta) {
  SampledSpectrum inverse;
  for (std::size_t i = 0; i < hero_count; ++i) inverse.v[i] = 1 / eta.v[i];
  return inverse;
}

FaceLight<double> mean_of(const SampledSpectrum& throughput, const FaceLight<SampledSpectrum>& f) {
  return {mean_of(throughput, f.reflected), mean_of(throughput, f.transmitted),
          mean_of(throughput, f.reflected_far), mean_of(throughput, f.transmitted_far)};
}

}  // namespace

void fade(Connection& connection, const SampledSpectrum& transmitted) {
  if (connection.walks && PaneWalk::of(connection.walk).faces > 0) {
    PaneWalk walk = PaneWalk::of(connection.walk);
    walk.fade(mean_of(connection.throughput, transmitted));
    connection.walk = walk.bits();
  }
  connection.throughput = connection.throughput * transmitted;
}

bool walks_on(Connection& connection) {
  if (connection.depth <= long_walk) return true;
  if (RandomStream(stream_of(connection, RayRandom::light)).next() >= static_cast<double>(walk_survival))
    return false;
  connection.throughput = connection.throughput * (1 / walk_survival);
  return true;
}

namespace {

// Q/I of a connection (polarization.h): it is s or p, half of the samples of a pixel each. So R is what
// guides its walk without noise. Faces that are not parallel to others are met by both.
double polarization_of(const Connection& connection, bool parallel) {
  if (!parallel) return 0;
  return sample_4d(connection.key, sample_set::polarization, Wanted::two)[0] < 0.5f ? 1 : -1;
}

enum class AtFace : std::uint8_t { ends, passes, turns };

// Chooses whether the face turns a walk, and weighs it; where the face is not parallel to those that it has
// passed, what would be reflected goes elsewhere.
AtFace walk_at(Connection& connection, const FaceLight<SampledSpectrum>& face, bool parallel) {
  PaneWalk walk = PaneWalk::of(connection.walk);
  const FaceLight<double> mean = mean_of(connection.throughput, face);
  if (!parallel && walk.back && walk.faces <= 1) return AtFace::ends;
  const double chance = parallel ? attainable(walk.chance_to_turn(mean)) : 0;
  const bool turns = chance > 0 && RandomStream(stream_of(connection, RayRandom::choice)).next() < chance;
  if (turns) {
    connection.throughput = connection.throughput * face.reflected * static_cast<float>(1 / chance);
    walk.turn();
  } else {
    connection.throughput = connection.throughput * face.transmitted * static_cast<float>(1 / (1 - chance));
    walk.pass(mean);
  }
  connection.walk = walk.bits();
  ++connection.depth;
  if (is_black(connection.throughput)) return AtFace::ends;
  return turns ? AtFace::turns : AtFace::passes;
}

// What a smooth face reflects and lets through of light of that Q/I; `outside`: the cosine in the medium that
// `eta` is seen from.
FaceLight<SampledSpectrum> light_at(const Tracing& tracing, const Connection& connection,
                                    const Interaction& at, const DielectricMaterial& material, double outside,
                                    const SampledSpectrum& eta, double q) {
  FaceLight<SampledSpectrum> face;
  for (std::size_t i = 0; i < hero_count; ++i)
    face.reflected.v[i] = static_cast<float>(
        lanes::part_of(q, lanes::fresnel_polarized(outside, static_cast<double>(eta.v[i]))));
  const auto factor = [&](const SpectrumParameter& p) {
    return tracing.scene.textures.spectrum(p, at.texture_point(), connection.wavelengths);
  };
  face.transmitted = (filled(1) + face.reflected * -1.0f) * factor(material.transmittance_factor);
  face.reflected = face.reflected * factor(material.reflectance_factor);
  face.reflected_far = face.reflected, face.transmitted_far = face.transmitted;
  return face;
}

}  // namespace

// Behind parallel faces light goes on as it came. Faces are parallel where their normals agree as far as what
// is stored tells, or as those of real panes, and then the light's own direction is given back: so no
// rounding turns it.
bool walk_interface(Tracing& tracing, Connection& connection, const Interaction& at, const Surface& surface) {
  const Material& record = tracing.manifest().materials[surface.material];
  const auto& material = std::get<DielectricMaterial>(record.model);
  const SampledSpectrum eta = relative_index(material, at, connection.wavelengths);
  const Vector3d normal = tracing.scene.materials.shading_normal(record, at) * at.side();
  const MetFace met{normal, near_index(material, at, connection.wavelengths), static_cast<double>(eta[0])};
  const double face_rad = face_doubt(tracing, connection, at, surface, normal);
  RefractedAim aim = connection.refracted;
  FaceDoubt alone;
  alone.cross(face_rad), aim.doubt.cross(face_rad);
  const bool back = PaneWalk::of(connection.walk).back, leaves = !back && !at.front;
  ParallelWay way;
  double wedge = 2;
  any_distant_light(tracing.scene.lights, aim.light, RefractedAim::light_mask,
                    numbers_for_far_lights(tracing, connection.key), [&](Vector3d to_light) {
                      way = parallel_way(-at.out, back, to_light, met, aim.doubt.allowed_rad());
                      if (leaves) wedge = std::min(wedge, wedge_of(-at.out, to_light, met.eta, normal));
                      return way.holds();
                    });
  if (leaves && !at.exterior_eta) tracing.counters.count_leaving(way.is_out, wedge);
  // All wavelengths share the angle outside, not the one in the glass.
  const bool anew = way.is_in || way.is_out;
  const double outside = std::abs(dot(anew ? way.to_light : at.out, normal));
  const SampledSpectrum seen = way.is_out ? inverse_of(eta) : eta;
  const double q = polarization_of(connection, way.holds());
  const AtFace event =
      walk_at(connection, light_at(tracing, connection, at, material, outside, seen, q), way.holds());
  if (event == AtFace::ends || (event == AtFace::passes && !way.passes)) return false;
  const bool is_beyond = way.is_out && leaves && event == AtFace::passes;
  if (is_beyond && !connection.dispersed && tracing.scene.materials.disperses(record, at)) {
    const double thickness =
        connection.hit.t * length(cast<double>(connection.ray.direction)) * dot(at.out, normal);
    if (parts_aside(tracing, connection, at.p, eta, thickness, outside)) connection.disperse();
  }
  if (anew) aim.doubt = is_beyond ? FaceDoubt{} : alone;
  continue_from(tracing, connection, at, surface, event == AtFace::turns ? way.turned : way.passed);
  connection.refracted = aim;
  return true;
}

// What a sheet lets through goes straight on.
bool walk_sheet(const Tracing& tracing, Connection& connection, const Interaction& at,
                const Surface& surface) {
  Interaction other = at;
  other.front = !at.front, other.out = -at.out;
  const Vector3d normal = at.shading * at.side();
  const double face_rad = face_doubt(tracing, connection, at, surface, normal);
  RefractedAim aim = connection.refracted;
  FaceDoubt alone, doubt = aim.doubt;
  alone.cross(face_rad), doubt.cross(face_rad);
  const bool back = PaneWalk::of(connection.walk).back;
  ParallelWay way;
  any_distant_light(tracing.scene.lights, aim.light, RefractedAim::light_mask,
                    numbers_for_far_lights(tracing, connection.key), [&](Vector3d to_light) {
                      way = parallel_way(-at.out, back, to_light, {normal}, doubt.allowed_rad());
                      return way.holds();
                    });
  const double q = polarization_of(connection, way.holds());
  const auto straight = [&](const Interaction& side) {
    return tracing.scene.materials.passes_straight(surface.material, side, connection.wavelengths, q);
  };
  const auto mirrored = [&](const Interaction& side) {
    return tracing.scene.materials.mirrors(surface.material, side, connection.wavelengths, q);
  };
  const AtFace event =
      walk_at(connection, {mirrored(at), straight(at), mirrored(other), straight(other)}, way.holds());
  if (event == AtFace::ends) return false;
  if (event == AtFace::passes) {
    continue_straight(tracing, connection, at, &surface);
    return true;
  }
  continue_from(tracing, connection, at, surface, way.turned);
  aim.doubt = alone;
  connection.refracted = aim;
  return true;
}

}  // namespace vitrail
