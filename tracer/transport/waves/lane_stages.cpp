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
  const bool drawn = draw_slot({lights, p, numbers, far, path.wavelengths, path.lamp},
                               lights.slots[chosen.slot], chosen.rest, light);
  light.pdf *= chosen.probability * lights.share[LightNumbers::choice_of_tree];
  return drawn;
}

std::uint8_t group_of(const LaneWork& work, LightRef light) {
  return work.tracing.scene.groups.of(work.tracing.scene.lights, light);
}

double filter_weight(const Tracing& tracing, float u, float v) { return tracing.scene.filter.weight(u, v); }

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

void send(LaneWork& work, const CameraPath& path, const SurfaceSide& side, Point3d p, Point3f origin,
          const LightSample& light, const float (&radiance)[4]) {
  const Departure from{p, origin, path.hit.triangle, inside(work, path, side)};
  vitrail::send(work.tracing, path, from, light, {{radiance[0], radiance[1], radiance[2], radiance[3]}},
                work.shadows);
}

void send_from_medium(LaneWork& work, const CameraPath& path, Point3d p, const LightSample& light,
                      const float (&radiance)[4]) {
  vitrail::send(work.tracing, path, {p, cast<float>(p), no_triangle, path.inside}, light,
                {{radiance[0], radiance[1], radiance[2], radiance[3]}}, work.shadows);
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

void cross_face(CameraPath& path, Vector3d normal, bool front, bool reflected) {
  PaneState& pane = path.pane;
  // Only the far face of a pane is one of it.
  if (front || !is_parallel(pane.entered_by, normal)) pane.within = false;
  if (reflected) return;
  pane = {};
  if (front) pane = {true, false, false, encode_face(normal)};
}

}  // namespace lane_by_lane

}  // namespace vitrail
