// SPDX-License-Identifier: Apache-2.0
// These are smooth functions of one number, one for each band of the sky, evaluated for all bands at once.
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <vector>

namespace vitrail {

inline constexpr int sky_bands = 10;

// BandValues hold one single-precision value for each band; the lanes beyond sky_bands are there to fill
// registers.
inline constexpr std::size_t band_lanes = 12;
using BandValues = std::array<float, band_lanes>;

// Each band's curve is a cubic through four evenly spaced points on each of equal segments of [0, 1]. It is
// continuous, and off by at most h⁴/1944 times the greatest fourth derivative, h = 1/segments.
class BandCurves {
 public:
  BandCurves() = default;
  // `function(x, band)` is called with x in [0, 1].
  template <class F>
  BandCurves(int segments, F&& function) : count_(segments) {
    const double third = 1.0 / (3 * segments);
    for (int s = 0; s < segments; ++s) {
      Segment segment;
      for (std::size_t b = 0; b < sky_bands; ++b) {
        std::array<double, 4> values;
        for (int i = 0; i < 4; ++i) values[static_cast<std::size_t>(i)] = function((3 * s + i) * third, b);
        segment.set(b, values);
      }
      segments_.push_back(segment);
    }
  }

  // Returns the value of each band at x in [0, 1]. NaN counts as 0.
  BandValues at(double x) const {
    const double place = x > 0 ? x * count_ : 0;
    const int s = std::min(static_cast<int>(place), count_ - 1);
    const auto t = static_cast<float>(place - s);
    const auto& c = segments_[static_cast<std::size_t>(s)].power;
    BandValues values;
    for (std::size_t b = 0; b < band_lanes; ++b)
      values[b] = c[0][b] + t * (c[1][b] + t * (c[2][b] + t * c[3][b]));
    return values;
  }

  // It is laid out as coefficient[segment][power][band_lanes].
  struct Table {
    const float* coefficient;
    int segments;
  };
  static constexpr std::size_t powers = 4;
  Table table() const { return {segments_.empty() ? nullptr : segments_[0].power[0].data(), count_}; }

 private:
  struct alignas(64) Segment {
    std::array<BandValues, powers> power{};  // coefficients of tⁿ, t in [0, 1] within the segment
    // Sets a band from its values at t = 0, ⅓, ⅔, 1, by Newton's differences.
    void set(std::size_t band, const std::array<double, 4>& v) {
      const double d1 = v[1] - v[0], d2 = v[2] - 2 * v[1] + v[0], d3 = v[3] - 3 * (v[2] - v[1]) - v[0];
      power[0][band] = static_cast<float>(v[0]);
      power[1][band] = static_cast<float>(3 * (d1 - d2 / 2 + d3 / 3));
      power[2][band] = static_cast<float>(9 * (d2 - d3) / 2);
      power[3][band] = static_cast<float>(27 * d3 / 6);
    }
  };
  static_assert(sizeof(Segment) == powers * band_lanes * sizeof(float));
  std::vector<Segment> segments_;
  int count_ = 0;
};

}  // namespace vitrail
