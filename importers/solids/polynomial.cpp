// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>

#include <cmath>

#include "importers/solids/implicit.h"
#include "scene/system/diagnostics.h"

namespace vitrail::solids {

namespace {

struct Term {
  std::size_t i, j, k;
  double factor;
};

}  // namespace

Field polynomial(int order, std::vector<double> coefficients) {
  const auto n = static_cast<std::size_t>(order);
  if (order < 1 || order > 35 || coefficients.size() != (n + 1) * (n + 2) * (n + 3) / 6)
    throw Error(fmt::format("a polynomial of order {} has not {} coefficients", order, coefficients.size()));
  std::vector<Term> terms;
  std::size_t next = 0;
  for (std::size_t i = n + 1; i-- > 0;)
    for (std::size_t j = n - i + 1; j-- > 0;)
      for (std::size_t k = n - i - j + 1; k-- > 0;)
        if (const double factor = coefficients[next++]; factor != 0) terms.push_back({i, j, k, factor});
  return [terms = std::move(terms), n](const Point3d& p) {
    std::array<std::array<double, 36>, 3> powers;
    for (std::size_t axis = 0; axis < 3; ++axis) {
      powers[axis][0] = 1;
      for (std::size_t i = 1; i <= n; ++i) powers[axis][i] = powers[axis][i - 1] * p[static_cast<int>(axis)];
    }
    double sum = 0;
    for (const Term& t : terms) sum += t.factor * powers[0][t.i] * powers[1][t.j] * powers[2][t.k];
    return sum;
  };
}

std::vector<double> quadric_coefficients(std::span<const double, 10> abc) {
  // x², xy, xz, x, y², yz, y, z², z, 1
  return {abc[0], abc[3], abc[4], abc[6], abc[1], abc[5], abc[7], abc[2], abc[8], abc[9]};
}

}  // namespace vitrail::solids
