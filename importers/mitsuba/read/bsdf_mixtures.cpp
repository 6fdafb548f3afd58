// SPDX-License-Identifier: Apache-2.0
// BSDFs that are made of others, which keep their records.
#include <fmt/format.h>

#include <algorithm>

#include "importers/mitsuba/read/bsdf_models.h"
#include "importers/mitsuba/read/values.h"

namespace vitrail::mitsuba {

MaterialModel mask(Builder& b, const Object& o) {
  const Id<Material> material = nested_materials(b, o, 1, 1).front();
  return MaskMaterial{float_parameter(b, o, "opacity", 0.5), material};
}

MaterialModel blend(Builder& b, const Object& o) {
  const std::vector<Id<Material>> both = nested_materials(b, o, 2, 2);
  BlendMaterial blend{both[0], both[1], float_parameter(b, o, "weight", 0.5)};
  if (is_darkened({blend}, b.traits, b.parts))
    b.report.approximated(
        "a blend of a mirror, a smooth interface or nothing with what spreads light to the same side is "
        "their "
        "sum: darker in Mitsuba 3.9",
        o.origin);
  return blend;
}

// 0.6's: the sum of weight·part. Weights of more than 1 in all are divided by their sum, what lacks to 1 is
// black.
MaterialModel mixture(Builder& b, const Object& o) {
  const std::vector<Id<Material>> parts = nested_materials(b, o, 1, 64);
  const Origin& place = o.has("weights") ? o.find("weights")->origin : o.origin;
  const std::vector<double> weights =
      parse_numbers(o.text("weights", "", b.report), [&](const std::string& m) { b.report.fail(m, place); });
  if (weights.size() != parts.size() ||
      std::any_of(weights.begin(), weights.end(), [](double w) { return w < 0; }))
    b.report.fail(fmt::format("{} parts need as many \"weights\", none below 0", parts.size()), place);
  const Id<Material> black = append(b, Material{DiffuseMaterial{ConstantSpectrum{0}}});
  double sum = 0;
  BlendMaterial mixed{black, black, 0.0f};
  for (std::size_t i = 0; i <= parts.size(); ++i) {
    const double weight = i < parts.size() ? weights[i] : std::max(0.0, 1 - sum);
    if (weight == 0) continue;
    if (sum > 0) mixed.first = append(b, Material{mixed});
    sum += weight;
    mixed = {mixed.first, i < parts.size() ? parts[i] : black, static_cast<float>(weight / sum)};
  }
  return mixed;
}

}  // namespace vitrail::mitsuba
