// SPDX-License-Identifier: Apache-2.0
// These functions draw a connection to a light of each kind for sample_light, and give its density. Each kind
// has a file.
#pragma once

#include "tracer/lights/light_sampler.h"

namespace vitrail {

// It is a request for a connection. Its members are the arguments of LightChooser.
struct LightQuery {
  const LightSampler& lights;
  Point3d p;
  const std::array<float, 4>& u;
  const std::array<float, 2>& far;
  const SampledWavelengths& wavelengths;
  LastLamp& last;
};

// Each of these fills in a sample that holds its default values, in place, since copies cost as much as the
// rest. It returns false where nothing arrives. The pdf is that of the point given the light, but for
// environments.
// `slot` is in the tree's order. `choice`, in [0,1), chooses one of the triangle's parts.
bool draw_slot(const LightQuery& query, std::uint32_t slot, double choice, LightSample& sample);
bool draw_triangle(const LightQuery& query, const LightSampler::Slot& slot, double choice,
                   LightSample& sample);
bool draw_quadric(const LightQuery& query, const LightSampler::Slot& slot, LightSample& sample);
bool draw_emitter(const LightQuery& query, std::uint32_t emitter, LightSample& sample);
bool draw_distant(const LightQuery& query, std::uint32_t distant, LightSample& sample);
// The pdf is that of all environments together, their choice included: all that shine from there are seen.
bool draw_environment(const LightQuery& query, std::uint32_t environment, LightSample& sample);

// They are triangle_pdf of one of LightScene::triangles or LightSampler::quadrics.
double density_of_triangle(const LightSampler& sampler, std::uint32_t triangle, Point3d from, Point3d at,
                           double distance, double cosine);
double density_of_quadric(const LightSampler& sampler, std::uint32_t quadric, Point3d from, Point3d at,
                          double cosine);

// Returns the probability with which sample_light chooses a light of the tree.
inline double probability_in_tree(const LightSampler& s, Point3d from, LightRef light) {
  return s.share[LightNumbers::choice_of_tree] *
         s.tree.probability(from, static_cast<std::uint32_t>(s.numbers.number(light)));
}

}  // namespace vitrail
