// SPDX-License-Identifier: Apache-2.0
#include "scene/geometry/unit_circle.h"

namespace vitrail {

namespace {

// Taylor series, for |x| ≤ π/4: the first term left out is below 1e-17.
double sine(double x) {
  const double x2 = x * x;
  double sum = 0;
  for (int k = 17; k >= 3; k -= 2) sum = (1 + sum) * -x2 / (k * (k - 1));
  return x * (1 + sum);
}

double cosine(double x) {
  const double x2 = x * x;
  double sum = 0;
  for (int k = 16; k >= 2; k -= 2) sum = (1 + sum) * -x2 / (k * (k - 1));
  return 1 + sum;
}

}  // namespace

Point2d unit_circle(double angle_rad) {
  const int quarter = static_cast<int>(angle_rad / (pi / 2) + 0.5);
  const double rest = angle_rad - quarter * (pi / 2);
  const double c = cosine(rest), s = sine(rest);
  switch (quarter % 4) {
    case 0:
      return {c, s};
    case 1:
      return {-s, c};
    case 2:
      return {-c, -s};
    default:
      return {s, -c};
  }
}

}  // namespace vitrail
