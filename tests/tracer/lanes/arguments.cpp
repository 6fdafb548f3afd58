// SPDX-License-Identifier: Apache-2.0
#include "tests/tracer/lanes/arguments.h"

#include <cmath>

namespace vitrail::lane_tests {

namespace {

std::vector<std::vector<double>> each_alone(const std::vector<double>& values) {
  std::vector<std::vector<double>> result;
  for (const double x : values) result.push_back({x});
  return result;
}

Vector3d random_direction(Random& random) {
  for (;;) {
    const Vector3d v{uniform(random, -1, 1), uniform(random, -1, 1), uniform(random, -1, 1)};
    if (const double l = dot(v, v); l > 1e-4 && l < 1) return normalize(v);
  }
}

std::vector<std::vector<double>> corner_directions() {
  std::vector<std::vector<double>> result;
  for (const double x : {-1.0, -0.7, -1e-9, -0.0, 0.0, 1e-9, 0.7, 1.0})
    for (const double y : {-1.0, -0.7, -0.0, 0.0, 1e-9, 0.7, 1.0})
      for (const double z : {-1.0, -0.7, -1e-9, -0.0, 0.0, 1e-9, 0.7, 1.0}) {
        const Vector3d v{x, y, z};
        if (dot(v, v) < 0.1) continue;
        const Vector3d u = unit(v);
        result.push_back({u.x, u.y, u.z});
      }
  return result;
}

}  // namespace

Argument number(double low, double high, std::vector<double> corners) {
  return {1, each_alone(corners), [=](Random& r, double* out) { *out = uniform(r, low, high); }};
}

Argument float_number(double low, double high, std::vector<double> corners) {
  for (double& x : corners) x = static_cast<double>(static_cast<float>(x));
  return {1, each_alone(corners), [=](Random& r, double* out) {
            *out = static_cast<double>(static_cast<float>(uniform(r, low, high)));
          }};
}

Argument unit_number() {
  return {1, each_alone({0, 0x1p-24, 0.25, 0.5, 0.5 + 0x1p-24, 0.75, 1 - 0x1p-24}),
          [](Random& r, double* out) { *out = static_cast<double>(r() >> 40) * 0x1p-24; }};
}

Argument magnitude(int low_exponent, int high_exponent, std::vector<double> corners) {
  return {1, each_alone(corners),
          [=](Random& r, double* out) { *out = std::exp2(uniform(r, low_exponent, high_exponent)); }};
}

Argument float_magnitude(int low_exponent, int high_exponent, std::vector<double> corners) {
  return {1, each_alone(corners), [=](Random& r, double* out) {
            *out =
                static_cast<double>(static_cast<float>(std::exp2(uniform(r, low_exponent, high_exponent))));
          }};
}

Argument word(std::uint64_t end, std::vector<double> corners) {
  corners.insert(corners.end(), {0, 1, static_cast<double>(end - 1)});
  return {1, each_alone(corners), [=](Random& r, double* out) { *out = static_cast<double>(r() % end); }};
}

Argument long_word() {
  return {2,
          {{0, 0}, {1, 0}, {0, 1}, {4294967295.0, 4294967295.0}, {0, 2147483648.0}},
          [](Random& r, double* out) {
            const std::uint64_t bits = r();
            out[0] = static_cast<double>(bits & 0xffffffff), out[1] = static_cast<double>(bits >> 32);
          }};
}

Argument direction() {
  return {3, corner_directions(), [](Random& r, double* out) { put(random_direction(r), out); }};
}

Argument float_direction() {
  Argument result = direction();
  const auto rounded = [](double* x) {
    for (int i = 0; i < 3; ++i) x[i] = static_cast<double>(static_cast<float>(x[i]));
  };
  for (std::vector<double>& corner : result.corners) rounded(corner.data());
  result.random = [exact = result.random, rounded](Random& r, double* out) {
    exact(r, out);
    rounded(out);
  };
  return result;
}

Argument vector() {
  std::vector<std::vector<double>> corners{
      {0, 0, 0}, {0, -0.0, 0}, {1e-200, 0, 0}, {1e200, 1e200, 0}, {3, 0, -0.0}};
  return {3, corners,
          [](Random& r, double* out) { put(random_direction(r) * std::exp2(uniform(r, -30, 30)), out); }};
}

Argument position() {
  return {3, {{0, 0, 0}, {0, -0.0, 1}, {1000, 0, 0}, {-1e6, 1e6, 0.1}}, [](Random& r, double* out) {
            put(random_direction(r) * std::exp2(uniform(r, -10, 20)), out);
          }};
}

std::vector<double> cases_of(const std::vector<Argument>& arguments, int random, std::uint64_t seed) {
  constexpr std::size_t most_corners = 100'000;
  Random bits(seed);
  std::vector<double> numbers;
  std::size_t combinations = 1, count = 0;
  for (const Argument& a : arguments)
    combinations = std::min(combinations * a.corners.size(), 100 * most_corners);
  const auto add = [&](const Argument& a, std::size_t corner) {
    numbers.resize(numbers.size() + static_cast<std::size_t>(a.size));
    double* const at = numbers.data() + numbers.size() - a.size;
    if (corner < a.corners.size())
      std::copy(a.corners[corner].begin(), a.corners[corner].end(), at);
    else
      a.random(bits, at);
  };
  // Where there are too many combinations, some of them.
  const std::size_t step = combinations / most_corners + 1;
  for (std::size_t k = 0; k < combinations; k += step, ++count) {
    std::size_t rest = k;
    for (const Argument& a : arguments) {
      add(a, rest % a.corners.size());
      rest /= a.corners.size();
    }
  }
  // And some corners among random numbers.
  for (int i = 0; i < random || count % 8 != 0; ++i, ++count)
    for (const Argument& a : arguments)
      add(a, bits() % 16 == 0 ? bits() % a.corners.size() : a.corners.size());
  return numbers;
}

}  // namespace vitrail::lane_tests
