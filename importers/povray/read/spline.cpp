// SPDX-License-Identifier: Apache-2.0
#include "importers/povray/read/spline.h"

#include <algorithm>

namespace vitrail::pov {

namespace {

using Knots = std::vector<Spline::Knot>;

// Lagrange's polynomial through three knots.
double quadratic(const Knots& k, std::size_t i, std::size_t term, double t) {
  const double a = k[i].at, b = k[i + 1].at, c = k[i + 2].at;
  return k[i].value.v[term] * (t - b) * (t - c) / ((a - b) * (a - c)) +
         k[i + 1].value.v[term] * (t - a) * (t - c) / ((b - a) * (b - c)) +
         k[i + 2].value.v[term] * (t - a) * (t - b) / ((c - a) * (c - b));
}

// Hermite's polynomial. Slopes are the means of those of both chords, however long these are.
double catmull_rom(const Knots& k, std::size_t i, std::size_t term, double t) {
  const double h = k[i + 1].at - k[i].at, s = (t - k[i].at) / h;
  const auto slope = [&](std::size_t j) {
    const auto chord = [&](std::size_t c) {
      return (k[c + 1].value.v[term] - k[c].value.v[term]) / (k[c + 1].at - k[c].at);
    };
    return 0.5 * (chord(j - 1) + chord(j)) * h;
  };
  const double p0 = k[i].value.v[term], p1 = k[i + 1].value.v[term], m0 = slope(i), m1 = slope(i + 1);
  return p0 * (1 + 2 * s) * (1 - s) * (1 - s) + m0 * s * (1 - s) * (1 - s) + p1 * s * s * (3 - 2 * s) +
         m1 * s * s * (s - 1);
}

// Second derivatives that are 0 at the ends, by Thomas' algorithm.
std::vector<double> natural_curvatures(const Knots& k, std::size_t term) {
  const std::size_t n = k.size();
  std::vector<double> m(n, 0), upper(n, 0);
  for (std::size_t i = 1; i + 1 < n; ++i) {
    const double h0 = k[i].at - k[i - 1].at, h1 = k[i + 1].at - k[i].at;
    const double right = 6 * ((k[i + 1].value.v[term] - k[i].value.v[term]) / h1 -
                              (k[i].value.v[term] - k[i - 1].value.v[term]) / h0);
    const double pivot = 2 * (h0 + h1) - h0 * upper[i - 1];
    upper[i] = h1 / pivot;
    m[i] = (right - h0 * m[i - 1]) / pivot;
  }
  for (std::size_t i = n - 1; i-- > 1;) m[i] -= upper[i] * m[i + 1];
  return m;
}

double natural(const Knots& k, std::size_t i, std::size_t term, double t) {
  const std::vector<double> m = natural_curvatures(k, term);
  const double h = k[i + 1].at - k[i].at, a = (k[i + 1].at - t) / h, b = (t - k[i].at) / h;
  return a * k[i].value.v[term] + b * k[i + 1].value.v[term] +
         ((a * a * a - a) * m[i] + (b * b * b - b) * m[i + 1]) * h * h / 6;
}

}  // namespace

void Spline::add(Knot knot) {
  const auto at =
      std::lower_bound(knots.begin(), knots.end(), knot.at, [](const Knot& k, double t) { return k.at < t; });
  if (at != knots.end() && at->at == knot.at)
    at->value = knot.value;
  else
    knots.insert(at, knot);
}

Numbers Spline::at(double t, std::optional<Kind> as) const {
  if (knots.empty()) return {};
  Kind how = as.value_or(kind);
  if (how == Kind::quadratic && knots.size() < 3) how = Kind::linear;
  if (how == Kind::cubic && knots.size() < 4) how = Kind::linear;
  const std::size_t low = how == Kind::cubic ? 1 : 0, high = knots.size() - 1 - low;
  if (how == Kind::quadratic && t < knots.front().at) return knots.front().value;
  if (t <= knots[low].at) return knots[low].value;
  if (t >= knots[high].at) return knots[high].value;
  const auto above =
      std::upper_bound(knots.begin(), knots.end(), t, [](double v, const Knot& k) { return v < k.at; });
  const auto i = static_cast<std::size_t>(above - knots.begin()) - 1;
  Numbers result = knots[i].value;
  for (std::size_t term = 0; term < static_cast<std::size_t>(result.terms); ++term) {
    const double a = knots[i].value.v[term], b = knots[i + 1].value.v[term];
    switch (how) {
      case Kind::linear:
        result.v[term] = a + (b - a) * (t - knots[i].at) / (knots[i + 1].at - knots[i].at);
        break;
      case Kind::quadratic:
        result.v[term] = quadratic(knots, std::min(i == 0 ? 0 : i - 1, knots.size() - 3), term, t);
        break;
      case Kind::cubic:
        result.v[term] = catmull_rom(knots, i, term, t);
        break;
      case Kind::natural:
        result.v[term] = natural(knots, i, term, t);
        break;
    }
  }
  return result;
}

std::optional<Spline::Kind> spline_kind(Word word) {
  switch (word) {
    case Word::linear_spline_:
      return Spline::Kind::linear;
    case Word::quadratic_spline_:
      return Spline::Kind::quadratic;
    case Word::cubic_spline_:
      return Spline::Kind::cubic;
    case Word::natural_spline_:
      return Spline::Kind::natural;
    default:
      return std::nullopt;
  }
}

}  // namespace vitrail::pov
