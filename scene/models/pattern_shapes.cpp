// SPDX-License-Identifier: Apache-2.0
#include "scene/models/pattern_shapes.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "scene/geometry/portable_math.h"
#include "scene/models/pattern_noise.h"

namespace vitrail {

namespace {

using Kind = PatternTexture::Kind;

double rest(double x) { return x - std::floor(x); }
bool is_odd(double whole) { return whole - 2 * std::floor(whole / 2) != 0; }
// Of cells of size 1: a floor that lies where two of them meet is in the upper one, as povray shows, however
// the point was rounded on its way.
double cell_of(double x) { return std::floor(x + 1e-5); }
double radius(Point3d p) { return std::sqrt(p.x * p.x + p.y * p.y + p.z * p.z); }
double below_one(double distance) { return std::max(1 - distance, 0.0); }
// sin 2πt
double sine(double t) { return sin_pi(2 * rest(t)); }

// The hexagon of the lattice that (x,z) is in, by rounding in three coordinates whose sum is 0.
std::size_t hexagon(Point3d p) {
  const double q = 2.0 / 3 * p.x, r = p.z / std::sqrt(3.0) - p.x / 3, s = -q - r;
  double i = std::nearbyint(q), j = std::nearbyint(r);
  const double k = std::nearbyint(s), off_i = std::abs(i - q), off_j = std::abs(j - r),
               off_k = std::abs(k - s);
  if (off_i > off_j && off_i > off_k)
    i = -j - k;
  else if (off_j > off_k)
    j = -i - k;
  const double turn = 2 * i + j;
  return static_cast<std::size_t>(turn - 3 * std::floor(turn / 3));
}

// Mortar lies at the end of each brick. Layers of y are half a brick on along x and along z in turn.
std::size_t brick(const PatternBrick& b, Point3d p) {
  const auto mortar = static_cast<double>(b.mortar);
  const double y = (p.y + mortar) / b.size.y;
  const bool odd = is_odd(std::floor(y));
  const double x = (p.x + mortar) / b.size.x + (odd ? 0.5 : 0),
               z = (p.z + mortar) / b.size.z + (odd ? 0 : 0.5);
  const bool is_mortar =
      rest(x) * b.size.x < mortar || rest(y) * b.size.y < mortar || rest(z) * b.size.z < mortar;
  return is_mortar ? 0 : 1;
}

Octaves octaves_of(const PatternTurbulence& t) {
  return {t.octaves, static_cast<double>(t.lambda), static_cast<double>(t.omega)};
}

// What turbulence adds to the number of marble and of spirals.
double turbulence_along_x(const PatternTexture& t, Point3d p) {
  const double amount = t.turbulence.amount.x;
  return amount == 0 ? 0 : amount * scalar_turbulence(p, octaves_of(t.turbulence), t.noise);
}

double agate(const PatternTexture& t, Point3d p) {
  const double noise =
      static_cast<double>(t.agate_turb) * scalar_turbulence(p, octaves_of(t.turbulence), t.noise);
  return portable_pow(0.5 * (1 + sine(1.3 * noise + 1.1 * p.z)), 0.77);
}

double granite(NoiseGenerator generator, Point3d p) {
  double sum = 0, scale = 4, weight = 1;
  for (int i = 0; i < 6; ++i, scale *= 2, weight *= 0.5) {
    const double noise = pattern_noise({p.x * scale, p.y * scale, p.z * scale}, generator);
    sum += weight * (generator == NoiseGenerator::original ? std::abs(0.5 - noise)
                                                           : std::min(std::abs(1 - 2 * noise), 0.5));
  }
  return std::min(sum, 1.0);
}

double wrinkles(NoiseGenerator generator, Point3d p) {
  double sum = 0, scale = 1, weight = 0.5;
  for (int i = 0; i < 10; ++i, scale *= 2, weight *= 0.5)
    sum += weight * wide_noise({p.x * scale, p.y * scale, p.z * scale}, generator);
  return sum;
}

// The mean over sources of the sines of their distances, in 0 … 1.
double ripples(const PatternTexture& t, Point3d p) {
  double sum = 0;
  for (std::size_t i = 0; i < wave_source_count; ++i)
    sum += sine(radius(p - wave_source(i).place) * static_cast<double>(t.frequency) +
                static_cast<double>(t.phase));
  return 0.5 * (1 + sum / wave_source_count);
}

// Likewise, of waves that are as high as they are long.
double waves(const PatternTexture& t, Point3d p) {
  double sum = 0;
  for (std::size_t i = 0; i < wave_source_count; ++i) {
    const auto& [place, frequency] = wave_source(i);
    sum += sine(radius(p - place) * frequency * static_cast<double>(t.frequency) +
                static_cast<double>(t.phase)) /
           frequency;
  }
  return std::clamp(0.5 + 0.2 * sum / wave_source_count, 0.0, 1.0);
}

double mandel(int iterations, Point3d p) {
  double x = p.x, y = p.y;
  for (int i = 0; i < iterations; ++i) {
    const double next = x * x - y * y + p.x;
    y = 2 * x * y + p.y, x = next;
    if (x * x + y * y > 4) return static_cast<double>(i) / iterations;
  }
  return 1;
}

}  // namespace

std::size_t places_of(Kind kind) { return kind == Kind::hexagon ? 3 : 2; }

std::size_t place_of_pattern(const PatternTexture& t, Point3d p) {
  if (t.kind == Kind::hexagon) return hexagon(p);
  if (t.kind == Kind::brick) return brick(t.brick, p);
  return is_odd(cell_of(p.x) + cell_of(p.y) + cell_of(p.z)) ? 1 : 0;
}

double number_of_pattern(const PatternTexture& t, Point3d p) {
  switch (t.kind) {
    case Kind::checker:
    case Kind::hexagon:
    case Kind::brick:
      break;                // by places
    case Kind::gradient: {  // what is below 0 is repeated after the frequency, as povray shows
      const double along = dot(Vector3d{p.x, p.y, p.z}, normalize(t.direction));
      return along > 1 ? rest(along) : along;
    }
    case Kind::boxed:
      return below_one(std::max({std::abs(p.x), std::abs(p.y), std::abs(p.z)}));
    case Kind::cylindrical:
      return below_one(std::sqrt(p.x * p.x + p.z * p.z));
    case Kind::planar:
      return below_one(std::abs(p.y));
    case Kind::spherical:
      return below_one(radius(p));
    case Kind::cells: {
      constexpr double greatest = 0x1p52;
      if (!(radius(p) < greatest)) return 0;
      const auto cell = [](double x) { return static_cast<std::int64_t>(cell_of(x)); };
      return numbers_of_cell(cell(p.x), cell(p.y), cell(p.z))[0];
    }
    case Kind::leopard: {
      const double sum = (portable_sin(p.x) + portable_sin(p.y) + portable_sin(p.z)) / 3;
      return sum * sum;
    }
    case Kind::marble:
      return p.x + turbulence_along_x(t, p);
    case Kind::onion:
      return rest(radius(p));
    case Kind::radial:
      return 0.75 + portable_atan2(p.x, p.z) / (2 * pi);
    case Kind::spiral1: {
      const double turn = rest(portable_atan2(p.y, p.x) / (2 * pi) + 0.25);
      return std::sqrt(p.x * p.x + p.y * p.y) + p.z + t.arms * turn + turbulence_along_x(t, p);
    }
    case Kind::wood:
      return std::sqrt(p.x * p.x + p.y * p.y);
    case Kind::agate:
      return agate(t, p);
    case Kind::bozo:
    case Kind::bumps:
      return pattern_noise(p, t.noise);
    case Kind::crackle:
      return crackle(t, p);
    case Kind::dents: {
      const double noise = pattern_noise(p, t.noise);
      return noise * noise * noise;
    }
    case Kind::granite:
      return granite(t.noise, p);
    case Kind::ripples:
      return ripples(t, p);
    case Kind::waves:
      return waves(t, p);
    case Kind::wrinkles:
      return wrinkles(t.noise, p);
    case Kind::mandel:
      return mandel(t.iterations, p);
    case Kind::formula:
      break;  // pattern_formula.h
  }
  return 0;
}

}  // namespace vitrail
