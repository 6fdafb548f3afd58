// SPDX-License-Identifier: Apache-2.0
#include "scene/models/pattern.h"

#include <algorithm>
#include <cmath>

#include "scene/geometry/portable_math.h"
#include "scene/models/pattern_formula.h"
#include "scene/models/pattern_noise.h"
#include "scene/models/pattern_shapes.h"

namespace vitrail {

namespace {

using Kind = PatternTexture::Kind;
using Wave = PatternTexture::Wave;

double in_tile(double x, double size) { return size > 0 ? x - size * std::floor(x / size) : x; }

// In the first tile, moved by turbulence. Of wood across its rings alone, by the sine of where it would be
// times the amount, as povray's pictures show it.
Point3d moved(const PatternTexture& t, Point3d p) {
  p = {in_tile(p.x, t.repeat.x), in_tile(p.y, t.repeat.y), in_tile(p.z, t.repeat.z)};
  const PatternTurbulence& turbulence = t.turbulence;
  if (t.kind == Kind::marble || turbulence.amount == Vector3d{}) return p;
  const Vector3d way = vector_turbulence(
      p, {turbulence.octaves, static_cast<double>(turbulence.lambda), static_cast<double>(turbulence.omega)});
  const Vector3d& amount = turbulence.amount;
  if (t.kind == Kind::wood)
    return {p.x + sin_pi(2 * amount.x * (p.x + way.x)), p.y + sin_pi(2 * amount.y * (p.y + way.y)), p.z};
  return {p.x + amount.x * way.x, p.y + amount.y * way.y, p.z + amount.z * way.z};
}

double shaped(const PatternTexture& t, double x) {
  const double rest = x - std::floor(x);
  switch (t.wave) {
    case Wave::ramp:
      return x;
    case Wave::triangle:
      return rest < 0.5 ? 2 * rest : 2 - 2 * rest;
    case Wave::sine:
      return 0.5 * (1 + sin_pi(2 * rest));
    case Wave::scallop:
      return std::abs(sin_pi(rest));
    case Wave::cubic:
      return rest * rest * (3 - 2 * rest);
    case Wave::poly:
      return portable_pow(x, static_cast<double>(t.exponent));
  }
  return x;
}

// As povray: what is between 0 and 1 does not repeat, and each tile is longer by so much.
double repeated(double x) {
  constexpr double tile = 1.00001;
  x = std::fmod(x, tile);
  return x < 0 ? x + 1 : x;
}

double number(const PatternTexture& t, Point3d p, Vector3d n) {
  double x = t.kind == Kind::formula ? formula_value(t, p, n) : number_of_pattern(t, p);
  // As povray: before the frequency, and not below 0.
  if (t.kind == Kind::formula && x > 1) x -= std::floor(x);
  // Of ripples and waves once more, as povray.
  return shaped(t, repeated(x * static_cast<double>(t.frequency) + static_cast<double>(t.phase)));
}

}  // namespace

Point3d moved_in_pattern(const PatternTexture& t, Point3d p) { return moved(t, p); }

const char* fault_of(const PatternTexture& t) {
  constexpr int most_octaves = 10, most_iterations = 10000;
  if (t.turbulence.octaves < 1 || t.turbulence.octaves > most_octaves)
    return "has an impossible number of octaves";
  if (!(t.brick.size.x > 0) || !(t.brick.size.y > 0) || !(t.brick.size.z > 0))
    return "has bricks without size";
  if (!(t.crackle.metric > 0)) return "has a metric that is not positive";
  if (t.iterations < 1 || t.iterations > most_iterations) return "has an impossible number of iterations";
  if (t.kind == Kind::gradient && !(length(t.direction) > 0)) return "has a gradient without direction";
  if (!std::ranges::is_sorted(t.map, {}, &PatternStop::at)) return "has a map out of order";
  return t.kind == Kind::formula ? fault_of_formula(t) : nullptr;
}

double pattern_value(const PatternTexture& t, Point3d p, Vector3d n) {
  const Point3d q = moved(t, p);
  if (!is_of_places(t.kind)) return number(t, q, n);
  return static_cast<double>(place_of_pattern(t, q)) / static_cast<double>(places_of(t.kind) - 1);
}

PatternMix pattern_mix(const PatternTexture& t, Point3d p, Vector3d n) {
  const Point3d q = moved(t, p);
  const std::size_t last = t.map.size() - 1;
  if (is_of_places(t.kind)) {
    const std::size_t place = std::min(place_of_pattern(t, q), last);
    return {place, place, 0};
  }
  const double x = number(t, q, n);
  const auto above =
      std::ranges::find_if(t.map, [&](const PatternStop& stop) { return x < static_cast<double>(stop.at); });
  if (above == t.map.begin()) return {0, 0, 0};
  if (above == t.map.end()) return {last, last, 0};
  const auto second = static_cast<std::size_t>(above - t.map.begin());
  const auto low = static_cast<double>(t.map[second - 1].at), high = static_cast<double>(above->at);
  return {second - 1, second, (x - low) / (high - low)};
}

}  // namespace vitrail
