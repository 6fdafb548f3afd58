// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <memory>
#include <random>
#include <vector>

#include "tracer/lights/light_sampler.h"

namespace vitrail::test {

// Numbers in [0,1) that do not depend on the C++ library.
class Random {
 public:
  explicit Random(std::uint32_t seed) : engine_(seed) {}
  double operator()() { return static_cast<double>(engine_() >> 8) * 0x1p-24; }
  double between(double a, double b) { return a + (b - a) * (*this)(); }
  Point3d point(double a, double b) { return {between(a, b), between(a, b), between(a, b)}; }
  Vector3d direction() {
    for (;;) {
      const Vector3d v{between(-1, 1), between(-1, 1), between(-1, 1)};
      const double l = length(v);
      if (l > 0.1 && l < 1) return v * (1 / l);
    }
  }
  std::array<float, 4> four() {
    const auto one = [&] { return static_cast<float>((*this)()); };
    return {one(), one(), one(), one()};
  }

 private:
  std::mt19937 engine_;
};

inline SampledWavelengths some_wavelengths() {
  SampledWavelengths w;
  w.lambda_nm = {440, 520, 580, 650};
  w.pdf = {1, 1, 1, 1};
  return w;
}

// Grey, one number a texel, y up; levels are means of 2 × 2.
class GreyImage final : public LightImage {
 public:
  GreyImage(int width, int height, std::vector<double> values)
      : width_(width), height_(height), values_(std::move(values)) {}
  int width(int) const override { return width_; }
  int height(int) const override { return height_; }
  int levels() const override { return 1; }
  double value(int x, int y) const {
    return values_[static_cast<std::size_t>(((y % height_ + height_) % height_) * width_ +
                                            (x % width_ + width_) % width_)];
  }
  SampledSpectrum texel(int x, int y, const SampledWavelengths&) const override {
    return filled(static_cast<float>(value(x, y)));
  }
  SampledSpectrum bilinear(double s, double t, const SampledWavelengths&) const override {
    const double x = s * width_ - 0.5, y = t * height_ - 0.5;
    const int x0 = static_cast<int>(std::floor(x)), y0 = static_cast<int>(std::floor(y));
    const double fx = x - x0, fy = y - y0;
    return filled(static_cast<float>((value(x0, y0) * (1 - fx) + value(x0 + 1, y0) * fx) * (1 - fy) +
                                     (value(x0, y0 + 1) * (1 - fx) + value(x0 + 1, y0 + 1) * fx) * fy));
  }
  double luminance(int x, int y, int) const override { return value(x, y); }

 private:
  int width_, height_;
  std::vector<double> values_;
};

inline ImageSource only(std::shared_ptr<const LightImage> image) {
  return [image](const std::string&) { return image; };
}

}  // namespace vitrail::test
