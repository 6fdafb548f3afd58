// SPDX-License-Identifier: Apache-2.0
#include "importers/writing/exposed_lights.h"

namespace vitrail {

namespace {

struct Exposure {
  double ratio;

  void operator()(PointLight& light) const { light.intensity = scaled(light.intensity, ratio); }
  void operator()(SpotLight& light) const { light.intensity = scaled(light.intensity, ratio); }
  void operator()(ProjectionLight& light) const { light.scale = scaled(light.scale, ratio); }
  void operator()(GoniometricLight& light) const { light.intensity = scaled(light.intensity, ratio); }
  void operator()(DistantLight& light) const { light.irradiance = scaled(light.irradiance, ratio); }
  void operator()(InfiniteLight& light) const { light.radiance = scaled(light.radiance, ratio); }
  void operator()(EnvironmentLight& light) const { light.scale = scaled(light.scale, ratio); }
  void operator()(SkyLight& light) const {
    light.sky_scale = times(light.sky_scale);
    light.sun_scale = times(light.sun_scale);
  }
  float times(float value) const { return static_cast<float>(ratio * static_cast<double>(value)); }
};

}  // namespace

ExposedLights::ExposedLights(const Scene& scene) : lights(scene.lights), area_lights(scene.area_lights) {
  const Exposure exposure{scene.film.imaging_ratio};
  for (Light& light : lights) std::visit(exposure, light.model);
  for (AreaLight& light : area_lights) light.scale = exposure.times(light.scale);
}

}  // namespace vitrail
