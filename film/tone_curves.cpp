// SPDX-License-Identifier: Apache-2.0
#include "film/tone_curves.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "scene/spectra/color.h"

namespace vitrail {

namespace {

constexpr double middle_grey = 0.18;

template <class Curve>
Image mapped(const Image& rgb, const Curve& curve) {
  Image out = rgb;
  for (std::size_t p = 0; p < out.pixels(); ++p) {
    std::array<double, 3> color{};
    for (std::size_t c = 0; c < 3; ++c) color[c] = std::max(0.0, static_cast<double>(rgb.values[3 * p + c]));
    curve(color);
    for (std::size_t c = 0; c < 3; ++c)
      out.values[3 * p + c] = static_cast<float>(std::clamp(color[c], 0.0, 1.0));
  }
  return out;
}

// Of the shares of AgX's grey, as its primaries give them.
double agx_grey(const std::array<double, 3>& c) { return 0.2120 * c[0] + 0.3922 * c[1] + 0.3958 * c[2]; }

// Through (pivot, 1/2) with slope 2, to `width` beside it, where it is 1/2 above: with t = 2·x / s
// that is s·t / (1 + t^p)^(1/p), and s follows from its end.
double half_sigmoid(double x, double width, double power) {
  const double steepness = 2 * width / 0.5;
  const double scale = 2 * width / std::pow(std::pow(steepness, power) - 1, 1 / power);
  return 2 * x / std::pow(1 + std::pow(2 * x / scale, power), 1 / power);
}

double agx_sigmoid(double x) {
  constexpr double pivot = 10 / 16.5;
  return x < pivot ? 0.5 - half_sigmoid(pivot - x, pivot, 3) : 0.5 + half_sigmoid(x - pivot, 1 - pivot, 3.25);
}

double hable(double x) {
  constexpr double a = 0.15, b = 0.5, c = 0.1, d = 0.2, e = 0.02, f = 0.3;
  return (x * (a * x + c * b) + d * e) / (x * (a * x + b) + d * f) - e / f;
}

// The luminance of each pixel that has any.
template <typename Visit>
void for_each_lit(const Image& rgb, const Visit& visit) {
  for (std::size_t p = 0; p < rgb.pixels(); ++p) {
    const float* c = &rgb.values[3 * p];
    const double y =
        srgb_to_xyz({static_cast<double>(c[0]), static_cast<double>(c[1]), static_cast<double>(c[2])}).y;
    if (y > 0 && std::isfinite(y)) visit(y);
  }
}

}  // namespace

Image agx_tone_mapped(const Image& rgb) {
  constexpr double inset = 0.2, stops_below = 10, stops = 16.5;
  return mapped(rgb, [](std::array<double, 3>& color) {
    const double grey = agx_grey(color);
    for (double& c : color) {
      const double stop = std::log2(((1 - inset) * c + inset * grey) / middle_grey);  // −∞: black
      c = agx_sigmoid(std::clamp((stop + stops_below) / stops, 0.0, 1.0));
    }
    const double shown_grey = agx_grey(color);
    for (double& c : color) c = std::pow(std::max(0.0, (c - inset * shown_grey) / (1 - inset)), 2.2);
  });
}

Image filmic_tone_mapped(const Image& rgb) {
  return mapped(rgb, [white = hable(11.2)](std::array<double, 3>& color) {
    for (double& c : color) c = hable(2 * c) / white;
  });
}

double automatic_exposure_ev(const Image& rgb) {
  double logarithms = 0;
  std::size_t lit = 0;
  for_each_lit(rgb, [&](double y) {
    logarithms += std::log2(y);
    ++lit;
  });
  return lit == 0 ? 0 : std::log2(middle_grey) - logarithms / static_cast<double>(lit);
}

double fitting_exposure_ev(const Image& rgb) {
  constexpr double far_above_white = 8;
  std::size_t lit = 0, above = 0;
  for_each_lit(rgb, [&](double y) {
    ++lit;
    above += y > far_above_white;
  });
  return 2 * above > lit ? automatic_exposure_ev(rgb) : 0;
}

}  // namespace vitrail
