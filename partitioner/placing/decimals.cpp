// SPDX-License-Identifier: Apache-2.0
#include "partitioner/placing/decimals.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "partitioner/appearance/requirements.h"
#include "scene/records/light_traits.h"
#include "scene/shapes/deferred_mesh.h"

namespace vitrail {

namespace {

constexpr double float_rounding = 0x1p-24;  // of a number to the nearest, relative
constexpr double coarsest = 1.0 / 64;       // step, relative to the mesh's extent
constexpr int digits_of_g = 6;

bool is_on(double step, double x) {
  return std::abs(x - step * std::round(x / step)) <= float_rounding * std::abs(x) + 1e-12 * step;
}

int exponent_of(double x) { return static_cast<int>(std::floor(std::log10(std::abs(x)))); }

// The step of numbers of six digits, of which `x` is one.
double step_of_digits(double x) { return std::pow(10.0, exponent_of(x) - digits_of_g + 1); }

bool all_of(std::span<const Point3f> positions, const auto& holds) {
  return std::ranges::all_of(positions, [&](const Point3f& p) {
    return std::ranges::all_of(std::array{p.x, p.y, p.z},
                               [&](float x) { return x == 0 || holds(static_cast<double>(x)); });
  });
}

double frobenius(const Affine& a) {
  double sum = 0;
  for (const auto& row : a.m)
    for (int j = 0; j < 3; ++j) sum += row[j] * row[j];
  return std::sqrt(sum);
}

}  // namespace

double decimal_step(std::span<const Point3f> positions) {
  Bounds3f box;
  double greatest = 0;
  for (const Point3f& p : positions) {
    extend(box, p);
    for (const float x : {p.x, p.y, p.z}) greatest = std::max(greatest, std::abs(static_cast<double>(x)));
  }
  if (greatest == 0 || !std::isfinite(greatest)) return 0;
  const Vector3f size = extent(box);
  const auto longest = static_cast<double>(std::max({size.x, size.y, size.z}));
  const double finest = 4 * float_rounding * greatest;

  double step = 0;
  for (int k = exponent_of(greatest) + 1; step == 0 && std::pow(10.0, k) > finest; --k)
    if (all_of(positions, [&](double x) { return is_on(std::pow(10.0, k), x); })) step = std::pow(10.0, k);
  const double of_digits = step_of_digits(greatest);
  if (of_digits > std::max(step, finest) &&
      all_of(positions, [](double x) { return is_on(step_of_digits(x), x); }))
    step = of_digits;
  return step <= coarsest * longest ? step : 0;
}

VertexDoubts::VertexDoubts(const Appearance& appearance)
    : appearance_(appearance), wanted_(std::ranges::any_of(appearance.lights, [](const Light& l) {
        return traits_of(l.model).parallel;
      })) {}

// A coordinate is off by half a step at most. Where the transform M takes it, the vertex is off by no more
// than the Frobenius norm of M times that.
float VertexDoubts::of(const Placement& p) {
  if (!wanted_ || p.mesh->quadric || !is_affine(p.to_world)) return 0;
  const std::int32_t material = appearance_.material_ids.at(p.shape->material.value);
  if (!is_smooth_glass(appearance_.materials.at(static_cast<std::size_t>(material)))) return 0;
  const auto [step, is_new] = steps_.try_emplace(p.mesh, 0);
  if (is_new) {
    TriangleMesh storage;
    step->second = decimal_step(loaded(*p.mesh, storage).positions);
  }
  const Affine placed = affine(p.to_world);
  return static_cast<float>(step->second / 2 *
                            frobenius(p.standing ? compose(p.standing->to_bundle, placed) : placed));
}

}  // namespace vitrail
