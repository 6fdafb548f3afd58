// SPDX-License-Identifier: Apache-2.0
// Arguments for the functions in lanes: all combinations of corner values, as many as there is room for, then
// random ones.
#pragma once

#include <cstdint>
#include <functional>
#include <random>
#include <vector>

#include "scene/geometry/vec.h"

namespace vitrail::lane_tests {

using Random = std::mt19937_64;

// `size` numbers that belong together.
struct Argument {
  int size = 1;
  std::vector<std::vector<double>> corners;
  std::function<void(Random&, double*)> random;
};

// A number in [low, high), of 53 bits.
inline double uniform(Random& random, double low = 0, double high = 1) {
  return low + (high - low) * static_cast<double>(random() >> 11) * 0x1p-53;
}

// The arguments' numbers as what they stand for, and back. `put` returns where the next result goes.
inline Vector3d vector_of(const double* in) { return {in[0], in[1], in[2]}; }
inline Point3d point_of(const double* in) { return {in[0], in[1], in[2]}; }
template <class V>
double* put(const V& v, double* out) {
  out[0] = static_cast<double>(v.x), out[1] = static_cast<double>(v.y), out[2] = static_cast<double>(v.z);
  return out + 3;
}

// In [low, high].
Argument number(double low, double high, std::vector<double> corners);
Argument float_number(double low, double high, std::vector<double> corners);
// In [0, 1), of 24 bits.
Argument unit_number();
// > 0, of any magnitude between two powers of two.
Argument magnitude(int low_exponent, int high_exponent, std::vector<double> corners);
// The same, and as float.
Argument float_magnitude(int low_exponent, int high_exponent, std::vector<double> corners);
// Below `end`.
Argument word(std::uint64_t end = std::uint64_t{1} << 32, std::vector<double> corners = {});
// Two words.
Argument long_word();
// Unit vectors: poles, axes, beside axes, on the edges of octants.
Argument direction();
// The same as floats.
Argument float_direction();
// Of any length, even one whose square is no number; and of lengths that scenes have.
Argument vector();
Argument position();

// [case][number], at least `random` of them random, a multiple of 8 in all.
std::vector<double> cases_of(const std::vector<Argument>& arguments, int random, std::uint64_t seed);

}  // namespace vitrail::lane_tests
