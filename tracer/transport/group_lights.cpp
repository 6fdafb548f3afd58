// SPDX-License-Identifier: Apache-2.0
#include "tracer/transport/group_lights.h"

namespace vitrail {

namespace {

// What comes from a direction, by group.
struct Surroundings {
  std::array<SampledSpectrum, most_light_groups> of{};
  SampledSpectrum all{};

  Surroundings(const RenderScene& scene, Vector3d direction, const SampledWavelengths& wavelengths,
               bool with_discs) {
    const std::size_t but_discs = scene.lights.infinite.size() + scene.lights.environments.size();
    std::size_t seen = 0;
    each_background_light(scene.lights, direction, wavelengths,
                          [&](std::uint32_t light, const SampledSpectrum& radiance) {
                            if (seen++ >= but_discs && !with_discs) return;  // discs come last
                            SampledSpectrum& group = of[scene.groups.lights[light]];
                            group = group + radiance;
                            all = all + radiance;
                          });
  }

  SampledSpectrum share(std::size_t group) const {
    SampledSpectrum share;
    for (std::size_t i = 0; i < hero_count; ++i) share.v[i] = all.v[i] > 0 ? of[group].v[i] / all.v[i] : 0;
    return share;
  }
};

// Of some light that is all around.
std::uint8_t some_surrounding_group(const RenderScene& scene) {
  const LightSampler& lights = scene.lights;
  const std::uint32_t light = !lights.infinite.empty()       ? lights.infinite[0]
                              : !lights.environments.empty() ? lights.environments[0].light
                                                             : lights.distant[0].light;
  return scene.groups.lights[light];
}

}  // namespace

bool deposit_in_groups(Tracing& tracing, const Deposited& d, const SampledSpectrum& radiance,
                       const XYZ& value, const LitBy& by) {
  const auto deposit = [&](std::span<const GroupLight> parts) {
    return tracing.film.deposit(d.pixel, d.sample, value, d.spread, parts);
  };
  const bool with_discs = by.group == by_direction_with_discs;
  if (by.group != GroupedLights::by_direction && !with_discs)
    return deposit(std::array{GroupLight{by.group, {}}});
  const std::array<float, 4> numbers = camera_numbers(tracing, key_of(tracing, d.pixel, d.sample));
  const Surroundings around(tracing.scene, normalize(cast<double>(by.direction)),
                            sample_wavelengths(numbers[2]), with_discs);
  std::array<GroupLight, most_light_groups> parts;
  std::size_t count = 0;
  for (std::size_t group = 0; group < tracing.film.key().groups.names.size(); ++group) {
    if (is_black(around.of[group])) continue;
    const XYZ light = sense(*d.sensor, radiance * around.share(group));
    parts[count++] = {group, {d.left * light.x, d.left * light.y, d.left * light.z}};
  }
  // A direction is rounded as it travels: it may miss the edge of a sun that it was drawn for.
  if (count == 0) parts[count++].group = some_surrounding_group(tracing.scene);
  return deposit(std::span(parts).first(count));
}

}  // namespace vitrail
