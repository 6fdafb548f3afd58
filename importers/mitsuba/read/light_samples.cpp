// SPDX-License-Identifier: Apache-2.0
#include "importers/mitsuba/read/light_samples.h"

#include <fmt/format.h>

#include "importers/mitsuba/read/properties.h"

namespace vitrail::mitsuba {

namespace {

// What multiplies a light without extent; nothing of the others.
Spectrum* strength_of(LightModel& model) {
  if (auto* light = std::get_if<PointLight>(&model)) return &light->intensity;
  if (auto* light = std::get_if<SpotLight>(&model)) return &light->intensity;
  if (auto* light = std::get_if<DistantLight>(&model)) return &light->irradiance;
  if (auto* light = std::get_if<ProjectionLight>(&model)) return &light->scale;
  return nullptr;
}

}  // namespace

void multiply_by_samples(Builder& builder, const Object& root) {
  const Object* integrator = root.child("integrator");
  while (integrator && integrator->child("integrator")) integrator = integrator->child("integrator");
  if (!integrator || integrator->type != "direct") return;
  Report& report = builder.report;
  const int samples =
      integrator->integer("emitter_samples", integrator->integer("shading_samples", 1, report), report);
  if (samples <= 1) return;
  for (Light& light : builder.scene.lights) {
    Spectrum* const strength = strength_of(light.model);
    if (!strength) continue;
    *strength = scaled(*strength, samples);
    report.begin_item({light.origin, RecordKind::light});
    report.approximated(fmt::format("{0} times as bright: Mitsuba's \"direct\" adds up its {0} samples of "
                                    "lights without extent",
                                    samples),
                        light.origin);
  }
}

}  // namespace vitrail::mitsuba
