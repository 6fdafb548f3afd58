// SPDX-License-Identifier: Apache-2.0
#include "tracer/lights/light_sampler.h"

#include <algorithm>

#include "tracer/lights/draw_light.h"

namespace vitrail {

bool draw_slot(const LightQuery& query, std::uint32_t number, double choice, LightSample& sample) {
  if (query.lights.slots.empty()) return draw_emitter(query, query.lights.light_of(number).index, sample);
  const LightSampler::Slot& slot = query.lights.slots[number];
  switch (slot.light.kind) {
    case LightKind::triangle:
      return draw_triangle(query, slot, choice, sample);
    case LightKind::quadric:
      return draw_quadric(query, slot, sample);
    case LightKind::emitter:
      return draw_emitter(query, slot.light.index, sample);
    case LightKind::distant:
    case LightKind::environment:
    case LightKind::infinite:
      break;  // not in the tree
  }
  return false;
}

bool LightChooser::draw_from_tree(const LightQuery& query, double choice, LightSample& sample) {
  const LightSampler& s = sampler_;
  const auto chosen = tree_.choose(choice);
  if (!chosen) return false;
  const bool drawn = draw_slot(query, chosen->slot, chosen->rest, sample);
  sample.pdf *= chosen->probability * s.share[LightNumbers::choice_of_tree];
  return drawn;
}

bool LightChooser::draw(const LightQuery& query, LightSample& sample) {
  const LightSampler& s = sampler_;
  if (s.three_numbers) return draw_from_tree(query, static_cast<double>(query.u[2]), sample);
  if (s.share.empty()) return false;
  const auto u = static_cast<double>(query.u[3]);
  const std::size_t choice = s.choice_of(u);
  const double share = s.share[choice];
  if (!(share > 0)) return false;

  if (choice == LightNumbers::choice_of_tree) {
    // What is left of u[3] refines u[2]: 24 bits cannot reach every one of many lights.
    const double fine = std::clamp(u / share, 0.0, 0x1.fffffp-1);
    const double in_tree = std::min(static_cast<double>(query.u[2]) + fine * 0x1p-24, 0x1.fffffffffffffp-1);
    return draw_from_tree(query, in_tree, sample);
  }
  const LightRef light = s.numbers.single_light(choice);
  if (light.kind == LightKind::environment) return draw_environment(query, light.index, sample);
  const bool drawn = draw_distant(query, light.index, sample);
  sample.pdf *= share;
  return drawn;
}

std::optional<LightSample> LightChooser::sample(const std::array<float, 4>& u) {
  std::optional<LightSample> sample(std::in_place);
  if (!draw({sampler_, p_, u, far_, wavelengths_, last_}, *sample)) sample.reset();
  return sample;
}

std::optional<LightSample> sample_light(const LightSampler& s, Point3d p, const std::array<float, 4>& u,
                                        const SampledWavelengths& wavelengths) {
  LastLamp last;
  return sample_light(s, p, u, {u[0], u[1]}, wavelengths, last);
}

std::optional<LightSample> sample_light(const LightSampler& s, Point3d p, const std::array<float, 4>& u,
                                        const std::array<float, 2>& far,
                                        const SampledWavelengths& wavelengths, LastLamp& last) {
  return LightChooser(s, p, far, wavelengths, last).sample(u);
}

Variety variety(const LightSampler& s, Point3d p) {
  if (s.one_is_enough) return Variety::none;
  if (s.tree_chooses) return Variety::little;
  const Vector3d way = p - s.lamp_center;
  return s.lamp_radius2 > 0 && dot(way, way) > 16 * s.lamp_radius2 ? Variety::little : Variety::much;
}

double triangle_pdf(const LightSampler& s, Point3d from, std::uint32_t triangle, Point3d at, double distance,
                    double cosine) {
  const auto above =
      std::upper_bound(s.runs.begin(), s.runs.end(), triangle,
                       [](std::uint32_t id, const LightSampler::Run& r) { return id < r.first; });
  if (above == s.runs.begin() || s.share.empty()) return 0;
  const LightSampler::Run& run = *(above - 1);
  if (triangle - run.first >= run.count) return 0;
  const LightRef light = s.numbers.light(run.number + (triangle - run.first));
  return light.kind == LightKind::quadric ? density_of_quadric(s, light.index, from, at, cosine)
                                          : density_of_triangle(s, light.index, from, at, distance, cosine);
}

}  // namespace vitrail
