// SPDX-License-Identifier: Apache-2.0
// Part of lane_stages.inl: light from environments, where a path connects to them and where it leaves.
#include "tracer/transport/waves/lane_group.inl"

inline constexpr std::uint32_t no_light = ~0u;

struct EnvironmentSample {
  Mask<D> chosen, arrives;
  Vector<D> to_light;
  Seen<D> seen;
};

// Those of which[j]. Not inlined into the stage of each kind.
[[gnu::noinline]] void sample_environments(const LaneWork& work, const Group& g, const Four<F>& u,
                                           const std::uint32_t (&which)[W], EnvironmentSample& s) {
  const LightSampler& lights = work.tracing.scene.lights;
  s.chosen = gather_mask<D>(VITRAIL_EACH(which[j] != no_light));
  s.to_light = fill<D>(Vector3d{0, 0, 1});
  for (std::uint32_t i = 0; i < lights.environments.size(); ++i) {
    const Mask<D> those = gather_mask<D>(VITRAIL_EACH(which[j] == i));
    if (!any(those)) continue;
    const Vector<D> direction =
        sample_direction<D>(lights.environments.data()[i], to_doubles(u[0]), to_doubles(u[1]));
    s.to_light = select<D>(those, direction, s.to_light);
  }
  s.seen = background(
      lights, s.to_light, s.chosen, [&](int j) __attribute__((always_inline))->const SampledWavelengths& {
        return g.path[j]->wavelengths;
      });
  s.arrives = s.chosen & (s.seen.pdf > 0);
}

// As add_environment (shading.cpp) has it, of paths that see no disc of a sun.
void leave_scene(LaneWork& work, const LaneList& list) {
  for (std::size_t first = 0; first < list.count; first += W) {
    const int valid = list.count - first < W ? static_cast<int>(list.count - first) : W;
    CameraPath* path[W];
    for (int j = 0; j < W; ++j)
      path[j] = work.paths + list.places[first + static_cast<std::size_t>(j < valid ? j : valid - 1)];
    const Vector<F> ray = gather_vector<F>([&](int j) __attribute__((always_inline))->const Vector3f& {
      return path[j]->ray.direction;
    });
    const Seen<D> seen = background(
        work.tracing.scene.lights, lanes::normalize(to_doubles(ray)), gather_mask<D>(VITRAIL_EACH(j < valid)),
        [&](int j) __attribute__((always_inline))->const SampledWavelengths& {
          return path[j]->wavelengths;
        });
    // Beside a light sample: the weight of a path that has found the light by itself.
    const D pdf = to_doubles(gather<F>(VITRAIL_EACH(path[j]->pdf)));
    const F weight = to_floats(select<D>(pdf > 0, lanes::power_heuristic(pdf, seen.pdf), fill<D>(1)));
    const Mask<F> shines = greatest(seen.radiance) > 0;
    Four<F> brought;
    for (int i = 0; i < 4; ++i)
      brought[i] = gather<F>(VITRAIL_EACH(path[j]->throughput.v[i])) * seen.radiance[i] * weight;
    for (int j = 0; j < valid; ++j)
      if (is_set(shines, j))
        lane_by_lane::deposit_surroundings(
            work, *path[j],
            {lane(brought[0], j), lane(brought[1], j), lane(brought[2], j), lane(brought[3], j)});
  }
}
