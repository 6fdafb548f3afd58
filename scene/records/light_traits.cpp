// SPDX-License-Identifier: Apache-2.0
#include "scene/records/light_traits.h"

namespace vitrail {

namespace {

struct Traits {
  LightTraits operator()(const PointLight&) const { return {}; }
  LightTraits operator()(const SpotLight&) const { return {}; }
  LightTraits operator()(const ProjectionLight&) const { return {}; }
  LightTraits operator()(const GoniometricLight&) const { return {}; }
  LightTraits operator()(const DistantLight&) const { return {.parallel = true}; }
  LightTraits operator()(const InfiniteLight&) const { return {.surrounds = true}; }
  LightTraits operator()(const EnvironmentLight&) const { return {.surrounds = true}; }
  LightTraits operator()(const SkyLight&) const { return {.surrounds = true, .parallel = true}; }
};

}  // namespace

LightTraits traits_of(const LightModel& model) { return std::visit(Traits{}, model); }

}  // namespace vitrail
