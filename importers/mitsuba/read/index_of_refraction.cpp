// SPDX-License-Identifier: Apache-2.0
#include "importers/mitsuba/read/index_of_refraction.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "importers/reading/suggestion.h"

namespace vitrail::mitsuba {

namespace {

// Indices of refraction by the names that Mitsuba documents.
struct NamedIndex {
  std::string_view name;
  double value;
};
constexpr std::array<NamedIndex, 25> indices{
    {{"vacuum", 1.0},      {"helium", 1.00004},         {"hydrogen", 1.00013},
     {"air", 1.000277},    {"carbon dioxide", 1.00045}, {"water", 1.3330},
     {"acetone", 1.36},    {"ethanol", 1.361},          {"carbon tetrachloride", 1.461},
     {"glycerol", 1.4729}, {"benzene", 1.501},          {"silicone oil", 1.52045},
     {"bromine", 1.661},   {"water ice", 1.31},         {"fused quartz", 1.458},
     {"pyrex", 1.470},     {"acrylic glass", 1.49},     {"polypropylene", 1.49},
     {"bk7", 1.5046},      {"sodium chloride", 1.544},  {"amber", 1.55},
     {"pet", 1.5750},      {"diamond", 2.419},          {"silicon", 3.42},
     {"glass", 1.5046}}};

}  // namespace

float index_of(Builder& b, const Object& o, const char* name, const char* otherwise) {
  const Property* property = o.find(name);
  const auto* text = property ? std::get_if<std::string>(&property->value) : nullptr;
  if (property && !text) return static_cast<float>(o.number(name, 1, b.report));
  const std::string wanted = text ? *text : otherwise;
  std::vector<std::string> names;
  for (const NamedIndex& known : indices) {
    if (known.name == wanted) return static_cast<float>(known.value);
    names.emplace_back(known.name);
  }
  b.report.fail(
      fmt::format("no index of refraction is known for \"{}\"{}", wanted, suggestion(wanted, names)),
      property ? property->origin : o.origin);
}

double internal_reflectance(double eta) {
  constexpr int steps = 10'000;
  double sum = 0;
  for (int i = 0; i < steps; ++i) {
    const double mu = (i + 0.5) / steps, sin2 = (1 - mu * mu) * eta * eta;
    const double other = std::sqrt(std::max(0.0, 1 - sin2));
    const double s = (eta * mu - other) / (eta * mu + other), p = (mu - eta * other) / (mu + eta * other);
    sum += 2 * mu * (sin2 >= 1 ? 1 : (s * s + p * p) / 2) / steps;
  }
  return sum;
}

}  // namespace vitrail::mitsuba
