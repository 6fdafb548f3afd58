// SPDX-License-Identifier: Apache-2.0
#include "tracer/transport/waves/lane_stages.h"

#include <algorithm>

#include "tracer/lights/draw_light.h"
#include "tracer/media/phase.h"
#include "tracer/sampling/wavelengths.h"
#include "tracer/transport/connect.h"
#include "tracer/transport/connection.h"

namespace vitrail {

const LaneStages& lane_stages(Kernel kernel) {
#if defined(__x86_64__)
  if (kernel == Kernel::avx2) return avx2_stages;
  if (kernel == Kernel::avx512) return avx512_stages;
#else
  static_cast<void>(kernel);
#endif
  return portable_stages;
}

const LaneStages& best_lane_stages() {
  static const LaneStages& chosen = lane_stages(best_kernel_kind());
  return chosen;
}

namespace lane_by_lane {

bool sample(const LaneWork& work, const CameraPath& path, Point3d p, const float (&u)[4],
            LightSample& light) {
  const std::array<float, 2> far = numbers_for_far_lights(work.tracing, path.key);
  const auto sampled =
      sample_light(work.tracing.scene.lights, p, {u[0], u[1], u[2], u[3]}, far, path.wavelengths, path.lamp);
  if (sampled) light = *sampled;
  return sampled.has_value();
}

bool draw(const LaneWork& work, const CameraPath& path, Point3d p, const float (&u)[4],
          const ChosenLight& chosen, LightSample& light) {
  const LightSampler& lights = work.tracing.scene.lights;
  const std::array<float, 4> numbers{u[0], u[1], u[2], u[3]};
  const std::array<float, 2> far{};
  const bool drawn =
      draw_slot({lights, p, numbers, far, path.wavelengths, path.lamp}, chosen.slot, chosen.rest, light);
  light.pdf *= chosen.probability * lights.share[LightNumbers::choice_of_tree];
  return drawn;
}

std::size_t choice_of(const LightSampler& lights, double u) { return lights.choice_of(u); }
LightRef light_of(const LightSampler& lights, std::uint32_t slot) { return lights.light_of(slot); }
LightSampler::Face face_of(const LightSampler::Slot& triangle) { return LightSampler::Face(triangle.p); }

std::uint8_t group_of(const LaneWork& work, LightRef light) {
  return work.tracing.scene.groups.of(work.tracing.scene.lights, light);
}

FilterSample filter_sample(const Tracing& tracing, float u, float v) {
  return tracing.scene.filter.sample(u, v);
}

void evaluate(const FlatSpectrum& spectrum, const CameraPath& path, float (&value)[4]) {
  const SampledSpectrum values = vitrail::evaluate(*spectrum.other, path.wavelengths) * spectrum.factor;
  std::ranges::copy(values.v, value);
}

void deposit_surroundings(const LaneWork& work, const CameraPath& path, const SampledSpectrum& radiance) {
  deposit(work.tracing, path.film, radiance, {work.tracing.scene.groups.surroundings, path.ray.direction});
}

std::uint8_t inside(const LaneWork& work, const CameraPath& path, const SurfaceSide& side) {
  const Surface& surface = work.tracing.manifest().surfaces[work.surface[side.place]];
  return work.tracing.scene.interiors.beside(path.inside, surface, side.front_side,
                                             side.front_side != side.from_front);
}

void send(LaneWork& work, const CameraPath& path, const Leaving& from, const LightSample& light,
          const SampledSpectrum& radiance) {
  vitrail::send(work.tracing, path, from, light, radiance, work.shadows);
}

void begin_connection(LaneWork& work, const CameraPath& path, const StraightConnection& way,
                      const SampledSpectrum& throughput) {
  Connection& c = add_connection(path, work.shadows.connections);
  c.light_group = group_of(work, way.light);
  c.inside = way.from.inside;
  c.ray = {way.from.origin, way.direction, way.from.exclude};
  c.direction = way.code;
  c.random = way.random;
  c.throughput = throughput;
  end_at(c, way.end, way.slope);
}

Vector3d sample_phase(double g, Vector3d out, float u, float v) {
  return vitrail::sample_phase(g, out, u, v);
}

void aim(const CameraPath& path, Point3d p, Point3f origin, const LightSample& light, ShadowRay& shadow) {
  const Aimed aimed = vitrail::aim({p, origin, path.hit.triangle, path.inside}, light);
  shadow.ray.direction = aimed.rounded;
  shadow.direction = aimed.direction;
  shadow.tmax = float_below(aimed.end);
}

void hash_numbers(const CameraPath& path, RayRandom use, float (&numbers)[4]) {
  std::ranges::copy(hashed_4d(stream_of(path, use)), numbers);
}

void pass_sheet(LaneWork& work, CameraPath& path, const SheetHit& hit, const SampledSpectrum& throughput) {
  path.throughput = throughput;
  Interaction at;
  at.p = hit.p, at.geometric = hit.geometric, at.rounding = hit.rounding, at.front = hit.front;
  at.triangle = path.hit.triangle;
  const Surface& surface = work.tracing.manifest().surfaces[work.surface[hit.place]];
  scatter_straight(work.tracing, path,
                   {surface, work.tracing.scene.materials.kind(surface.material), at, true});
}

double polarization_at(const CameraPath& path, Vector3d normal) {
  return vitrail::polarization_at(path, normal);
}

void cross_face(CameraPath& path, const CrossedFace& face) {
  PaneState& pane = path.pane;
  // Only the far face of a pane is one of it.
  if (face.front || !is_parallel(pane.face, face.normal)) pane.within = false;
  if (!face.reflected) {
    pane = {};
    if (face.front) pane = {true, false, false, encode_face(face.normal), {}};
  }
  pane.meet(face.normal, face.q, face.u);
}

}  // namespace lane_by_lane

}  // namespace vitrail
