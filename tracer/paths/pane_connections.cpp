// SPDX-License-Identifier: Apache-2.0
// Connections to distant lights through panes: what they do where they meet a face.
#include <algorithm>

#include "scene/geometry/portable_math.h"
#include "tracer/bsdf/local.h"
#include "tracer/panes/pane_walk.h"
#include "tracer/panes/parallel_faces.h"
#include "tracer/paths/path_state.h"
#include "tracer/paths/path_tracer.h"
#include "tracer/rays/connection_code.h"

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

// What is absorbed on its way.
void PathTracer::fade(Path& path, const SampledSpectrum& transmitted) {
  if (path.is(path_in_pane) && PaneWalk::of(path.walk).faces > 0) {
    PaneWalk walk = PaneWalk::of(path.walk);
    walk.fade(mean_of(path.throughput, transmitted));
    path.walk = walk.bits();
  }
  path.throughput = path.throughput * transmitted;
}

// However many faces there are, and however often light goes to and fro: its mean is the same.
bool PathTracer::walks_on(Path& path) const {
  if (path.depth <= long_walk) return true;
  if (RandomStream(stream_of(path, RayRandom::light)).next() >= static_cast<double>(walk_survival))
    return false;
  path.throughput = path.throughput * (1 / walk_survival);
  return true;
}

// Chooses whether the face turns a walk, and weighs it; where the face is not parallel to those that it has
// passed, what would be reflected goes elsewhere.
PathTracer::AtFace PathTracer::walk_at(Path& path, const FaceLight<SampledSpectrum>& face,
                                       bool parallel) const {
  PaneWalk walk = PaneWalk::of(path.walk);
  const FaceLight<double> mean = mean_of(path.throughput, face);
  if (!parallel && walk.back && walk.faces <= 1) return AtFace::ends;
  const double chance = parallel ? attainable(walk.chance_to_turn(mean)) : 0;
  const bool turns = chance > 0 && RandomStream(stream_of(path, RayRandom::choice)).next() < chance;
  if (turns) {
    path.throughput = path.throughput * face.reflected * static_cast<float>(1 / chance);
    walk.turn();
  } else {
    path.throughput = path.throughput * face.transmitted * static_cast<float>(1 / (1 - chance));
    walk.pass(mean);
  }
  path.walk = walk.bits();
  ++path.depth;
  if (is_black(path.throughput)) return AtFace::ends;
  return turns ? AtFace::turns : AtFace::passes;
}

// Of a smooth face whose normal, as it is shaded, is `normal`.
double PathTracer::face_doubt(const Path& path, const Interaction& at, const Surface& surface,
                              Vector3d normal) const {
  const bool shading = !(normal == at.geometric * at.side());
  return std::max(float_glass_rad, normal_doubt(*resident_[path.hit_domain], path.hit, shading,
                                                static_cast<double>(surface.vertex_doubt), path.time_s));
}

// What a smooth face reflects and lets through; `outside`: the cosine in the medium that `eta` is seen from.
FaceLight<SampledSpectrum> PathTracer::light_at(const Path& path, const Interaction& at,
                                                const DielectricMaterial& material, double outside,
                                                const SampledSpectrum& eta) const {
  FaceLight<SampledSpectrum> face;
  for (std::size_t i = 0; i < hero_count; ++i)
    face.reflected.v[i] = static_cast<float>(fresnel_dielectric(outside, static_cast<double>(eta.v[i])));
  const auto factor = [&](const SpectrumParameter& p) {
    return scene_.textures.spectrum(p, at.texture_point(), path.wavelengths);
  };
  face.transmitted = (filled(1) + face.reflected * -1.0f) * factor(material.transmittance_factor);
  face.reflected = face.reflected * factor(material.reflectance_factor);
  face.reflected_far = face.reflected, face.transmitted_far = face.transmitted;
  return face;
}

// Behind parallel faces light goes on as it came. Faces are parallel where their normals agree as far as what
// is stored tells, or as those of real panes, and then the light's own direction is given back: so no
// rounding turns it.
bool PathTracer::walk_interface(Path& path, const Interaction& at, const Surface& surface) const {
  const Material& record = manifest_.materials[surface.material];
  const auto& material = std::get<DielectricMaterial>(record.model);
  const SampledSpectrum eta = relative_index(material, at, path.wavelengths);
  const Vector3d normal = scene_.materials.shading_normal(record, at) * at.side();
  const MetFace met{normal, near_index(material, at, path.wavelengths), static_cast<double>(eta[0])};
  const double face_rad = face_doubt(path, at, surface, normal);
  RefractedAim aim = RefractedAim::of(path.aim);
  FaceDoubt alone;
  alone.cross(face_rad), aim.doubt.cross(face_rad);
  const bool back = PaneWalk::of(path.walk).back, leaves = !back && !at.front;
  ParallelWay way;
  double wedge = 2;
  any_distant_light(scene_.lights, aim.light, numbers_for_far_lights(path), [&](Vector3d to_light) {
    way = parallel_way(-at.out, back, to_light, met, aim.doubt.allowed_rad());
    if (leaves) wedge = std::min(wedge, wedge_of(-at.out, to_light, met.eta, normal));
    return way.holds();
  });
  if (leaves && !at.exterior_eta) counters_.count_leaving(way.is_out, wedge);
  // All wavelengths share the angle outside, not the one in the glass.
  const bool anew = way.is_in || way.is_out;
  const double outside = std::abs(dot(anew ? way.to_light : at.out, normal));
  const SampledSpectrum seen = way.is_out ? inverse_of(eta) : eta;
  const AtFace event = walk_at(path, light_at(path, at, material, outside, seen), way.holds());
  if (event == AtFace::ends || (event == AtFace::passes && !way.passes)) return false;
  const bool is_beyond = way.is_out && leaves && event == AtFace::passes;
  if (is_beyond && !path.is(path_dispersed) && scene_.materials.disperses(record, at)) {
    const double thickness = path.hit.t * length(cast<double>(path.ray.direction)) * dot(at.out, normal);
    if (parts_aside(path, at.p, eta, thickness, outside)) path.disperse();
  }
  if (anew) aim.doubt = is_beyond ? FaceDoubt{} : alone;
  continue_from(path, at, surface, event == AtFace::turns ? way.turned : way.passed);
  path.aim = aim.bits();
  return true;
}

// What a sheet lets through goes straight on.
bool PathTracer::walk_sheet(Path& path, const Interaction& at, const Surface& surface) const {
  Interaction other = at;
  other.front = !at.front, other.out = -at.out;
  const auto straight = [&](const Interaction& side) {
    return scene_.materials.passes_straight(surface.material, side, path.wavelengths);
  };
  const auto mirrored = [&](const Interaction& side) {
    return scene_.materials.mirrors(surface.material, side, path.wavelengths);
  };
  const FaceLight<SampledSpectrum> face{mirrored(at), straight(at), mirrored(other), straight(other)};
  const Vector3d normal = at.shading * at.side();
  const double face_rad = face_doubt(path, at, surface, normal);
  RefractedAim aim = RefractedAim::of(path.aim);
  FaceDoubt alone, doubt = aim.doubt;
  alone.cross(face_rad), doubt.cross(face_rad);
  const bool back = PaneWalk::of(path.walk).back;
  ParallelWay way;
  any_distant_light(scene_.lights, aim.light, numbers_for_far_lights(path), [&](Vector3d to_light) {
    way = parallel_way(-at.out, back, to_light, {normal}, doubt.allowed_rad());
    return way.holds();
  });
  const AtFace event = walk_at(path, face, way.holds());
  if (event == AtFace::ends) return false;
  if (event == AtFace::passes) {
    continue_straight(path, at, &surface);
    return true;
  }
  continue_from(path, at, surface, way.turned);
  aim.doubt = alone;
  path.aim = aim.bits();
  return true;
}

}  // namespace vitrail
