// SPDX-License-Identifier: Apache-2.0
#include "scene/models/pattern_noise.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <random>
#include <utility>

#include "scene/geometry/portable_math.h"
#include "scene/models/pattern_noise_table.h"

namespace vitrail {

namespace {

constexpr double greatest = 0x1p52;  // nothing lies between corners beyond it
constexpr std::int64_t hashes = 4096, begin = 10000;
constexpr int numbers_of_corner = 4;  // value, and the slopes along x, y, z

// The next number of a linear congruential generator; its bits 16 … 30 are used.
constexpr std::uint32_t next_number(std::uint32_t& state) {
  state = state * 1812433253u + 12345u;
  return state >> 16 & 0x7fffu;
}

// 0 … 4095 in a random order.
constexpr auto shuffled = [] {
  std::array<std::uint16_t, hashes> order{};
  for (std::size_t i = 0; i < hashes; ++i) order[i] = static_cast<std::uint16_t>(i);
  std::uint32_t state = 0;
  for (std::size_t i = hashes; i-- > 0;) std::swap(order[i], order[next_number(state) % hashes]);
  return order;
}();

std::size_t hash(std::int64_t i, std::int64_t j, std::int64_t k) {
  const auto next = [](std::size_t at, std::int64_t cell) {
    return static_cast<std::size_t>(shuffled[(at ^ static_cast<std::size_t>(cell)) & (hashes - 1)]);
  };
  return next(next(next(0, i), j), k);
}

bool is_within(Point3d p) {
  return std::abs(p.x) < greatest && std::abs(p.y) < greatest && std::abs(p.z) < greatest;
}

// The cell of a coordinate, and where it is within it. std::floor is a call without SSE4.1.
struct Coordinate {
  std::int64_t cell;
  double rest, faded;
};
Coordinate coordinate_of(double x) {
  const auto toward_zero = static_cast<std::int64_t>(x);
  const std::int64_t cell = toward_zero - (x < static_cast<double>(toward_zero));
  const double rest = x - static_cast<double>(cell);
  return {cell + begin, rest, rest * rest * (3 - 2 * rest)};
}

// Noises of the same corners, each by the numbers after those of the one before it.
template <std::size_t count>
std::array<double, count> noises(Point3d p) {
  std::array<double, count> sums{};
  if (!is_within(p)) return sums;
  const Coordinate x = coordinate_of(p.x), y = coordinate_of(p.y), z = coordinate_of(p.z);
  for (int corner = 0; corner < 8; ++corner) {
    const int i = corner & 1, j = corner >> 1 & 1, k = corner >> 2;
    const double weight =
        (i ? x.faded : 1 - x.faded) * (j ? y.faded : 1 - y.faded) * (k ? z.faded : 1 - z.faded);
    const double dx = x.rest - i, dy = y.rest - j, dz = z.rest - k;
    const double* numbers = pattern_noise_table.data() + (hash(x.cell + i, y.cell + j, z.cell + k) & 0xff);
    for (double& sum : sums) {
      sum += weight * (0.5 * numbers[0] + numbers[1] * dx + numbers[2] * dy + numbers[3] * dz);
      numbers += numbers_of_corner;
    }
  }
  return sums;
}

double by_generator(Point3d p, NoiseGenerator generator) {
  const double noise = noises<1>(p)[0];
  return generator == NoiseGenerator::original ? noise + 0.5 : 0.48985582 * (noise + 1.05242);
}
double cut_off(double x) { return std::clamp(x, 0.0, 1.0); }

// Calls f(weight, point) for every octave but the first.
template <class F>
void for_further_octaves(Point3d p, const Octaves& octaves, F&& f) {
  double weight = octaves.omega, frequency = octaves.lambda;
  for (int i = 1; i < octaves.count; ++i, weight *= octaves.omega, frequency *= octaves.lambda)
    f(weight, Point3d{p.x * frequency, p.y * frequency, p.z * frequency});
}

// The numbers of a hash are its own, and those of the next two.
std::array<double, hashes + 2> uniform_numbers() {
  std::array<double, hashes + 2> numbers{};
  std::mt19937 random;
  for (double& number : numbers) number = static_cast<double>(random()) * 0x1p-32;
  return numbers;
}

std::array<WaveSource, wave_source_count> wave_sources() {
  std::array<WaveSource, wave_source_count> sources;
  std::uint32_t state = 3734115329u;
  for (std::size_t i = 0; i < sources.size(); ++i)
    sources[i] = {normalize(vector_noise({static_cast<double>(i), 0, 0})),
                  next_number(state) * 0.000030518509476 + 0.01};
  return sources;
}

// What both sums of octaves are made of.
struct Multifractal {
  explicit Multifractal(const double* numbers)
      : p{numbers[0], numbers[1], numbers[2]},
        h(numbers[3]),
        lacunarity(numbers[4]),
        octaves(numbers[5] >= 1 ? static_cast<int>(std::min(numbers[5], 32.0)) : 1),
        generator(noise_generator(numbers[8])) {}
  double noise(double frequency) const {
    return 2 * pattern_noise({p.x * frequency, p.y * frequency, p.z * frequency}, generator) - 1;
  }
  double weight(double frequency) const { return portable_pow(frequency, -h); }

  Point3d p;
  double h, lacunarity;
  int octaves;
  NoiseGenerator generator;
};

}  // namespace

double pattern_noise(Point3d p, NoiseGenerator generator) {
  return is_within(p) ? cut_off(by_generator(p, generator)) : 0;
}

double wide_noise(Point3d p, NoiseGenerator generator) {
  const double noise = pattern_noise(p, generator);
  return generator == NoiseGenerator::original ? noise : cut_off(2 * noise - 0.5);
}

Vector3d vector_noise(Point3d p) {
  const auto [x, y, z] = noises<3>(p);
  return {x, y, z};
}

double scalar_turbulence(Point3d p, const Octaves& octaves, NoiseGenerator generator) {
  double sum = wide_noise(p, generator);
  for_further_octaves(p, octaves, [&](double weight, Point3d q) {
    const double noise = pattern_noise(q, generator);
    sum += weight * (generator == NoiseGenerator::original ? noise : 2 * noise - 0.5);
  });
  return sum;
}

Vector3d vector_turbulence(Point3d p, const Octaves& octaves) {
  Vector3d sum = vector_noise(p);
  for_further_octaves(p, octaves, [&](double weight, Point3d q) { sum = sum + vector_noise(q) * weight; });
  return sum;
}

double ridged_multifractal(const double* numbers) {
  const Multifractal m(numbers);
  const double offset = numbers[6], gain = numbers[7];
  double sum = 0, weight = 1, frequency = 1;
  for (int i = 0; i < m.octaves; ++i, frequency *= m.lacunarity) {
    double signal = offset - std::abs(m.noise(frequency));
    signal *= signal * weight;
    sum += signal * m.weight(frequency);
    weight = cut_off(signal * gain);
  }
  return sum;
}

double hetero_multifractal(const double* numbers) {
  constexpr double most_powers = 32;
  const Multifractal m(numbers);
  const double offset = numbers[6];
  const int powers = numbers[7] >= 1 ? static_cast<int>(std::min(numbers[7], most_powers)) : 0;
  double sum = m.noise(1) + offset, frequency = m.lacunarity;
  for (int i = 1; i < m.octaves; ++i, frequency *= m.lacunarity) {
    double increment = m.weight(frequency) * (m.noise(frequency) + offset);
    for (int j = 0; j < powers; ++j) increment *= sum;
    sum += increment;
  }
  return sum;
}

std::span<const double, 3> numbers_of_cell(std::int64_t i, std::int64_t j, std::int64_t k) {
  static const auto numbers = uniform_numbers();
  return std::span<const double, 3>{numbers.data() + hash(i, j, k), 3};
}

const WaveSource& wave_source(std::size_t i) {
  static const auto sources = wave_sources();
  return sources[i];
}

}  // namespace vitrail
