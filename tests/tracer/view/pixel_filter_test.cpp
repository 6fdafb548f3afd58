// SPDX-License-Identifier: Apache-2.0
// Weighted samples of a filter against integrals of the filter itself, as its authors write it.
#include "tracer/view/pixel_filter.h"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <functional>
#include <numbers>

#include "tests/support/render.h"

namespace vitrail::pixel_filter_test {
namespace {

using Function = std::function<double(double)>;

double simpson(const Function& f, double a, double b) {
  constexpr int n = 2000;
  const double h = (b - a) / n;
  double sum = f(a) + f(b);
  for (int i = 1; i < n; ++i) sum += (i % 2 == 1 ? 4 : 2) * f(a + i * h);
  return sum * h / 3;
}

double sinc(double x) { return x == 0 ? 1 : std::sin(std::numbers::pi * x) / (std::numbers::pi * x); }

double mitchell(double x, double b, double c) {
  x = std::abs(x);
  if (x < 1) return ((12 - 9 * b - 6 * c) * x * x * x + (-18 + 12 * b + 6 * c) * x * x + 6 - 2 * b) / 6;
  if (x < 2)
    return ((-b - 6 * c) * x * x * x + (6 * b + 30 * c) * x * x + (-12 * b - 48 * c) * x + 8 * b + 24 * c) /
           6;
  return 0;
}

constexpr std::array parts{-0.8, -0.55, -0.3, 0.0, 0.1, 0.45, 0.7, 1.0};  // of the radius

// Impulses at many places: what the samples gather of one left of x is ∫f up to there.
// Of samples all over a pixel, what one `steps` to the right of it gets is ∫f over a pixel there.
void expect_footprints(const Filter& filter, double radius_x, double radius_y, const Function& f,
                       const Function& g) {
  const FilterSampler sampler(filter, true);
  constexpr int n = 256, reach = 5;
  std::array<double, 2 * reach + 1> right{}, down{};
  for (int j = 0; j < n; ++j)
    for (int i = 0; i < n; ++i) {
      const float u = (static_cast<float>(i) + 0.5f) / n, v = (static_cast<float>(j) + 0.5f) / n;
      EXPECT_EQ(sampler.sample(u, v).offset.x, static_cast<double>(u) - 0.5);
      EXPECT_EQ(sampler.weight(u, v), 1);
      const Footprint print = sampler.footprint(u, v);
      for (int y = 0; y < print.high; ++y)
        for (int x = 0; x < print.wide; ++x) {
          const double w =
              std::ldexp(print.weights[static_cast<std::size_t>(y * print.wide + x)], -weight_bits);
          right[static_cast<std::size_t>(print.x + x + reach)] += w / (n * n);
          down[static_cast<std::size_t>(print.y + y + reach)] += w / (n * n);
        }
    }
  const auto share = [](const Function& of, double radius, int steps) {
    const double a = std::max(steps - 0.5, -radius), b = std::min(steps + 0.5, radius);
    return a < b ? simpson(of, a, b) / simpson(of, -radius, radius) : 0;
  };
  for (int steps = -reach; steps <= reach; ++steps) {
    EXPECT_NEAR(right[static_cast<std::size_t>(steps + reach)], share(f, radius_x, steps), 3e-3) << steps;
    EXPECT_NEAR(down[static_cast<std::size_t>(steps + reach)], share(g, radius_y, steps), 3e-3) << steps;
  }
}

void expect_filter(const Filter& filter, double radius_x, double radius_y, const Function& f,
                   const Function& g) {
  expect_footprints(filter, radius_x, radius_y, f, g);
  const FilterSampler sampler(filter);
  constexpr int n = 2048;
  std::array<double, parts.size()> left{}, below{};
  for (int j = 0; j < n; ++j)
    for (int i = 0; i < n; ++i) {
      const float u = (static_cast<float>(i) + 0.5f) / n, v = (static_cast<float>(j) + 0.5f) / n;
      const FilterSample s = sampler.sample(u, v);
      for (std::size_t k = 0; k < parts.size(); ++k) {
        if (s.offset.x < parts[k] * radius_x) left[k] += s.weight / (n * n);
        if (s.offset.y < parts[k] * radius_y) below[k] += s.weight / (n * n);
      }
    }
  for (std::size_t k = 0; k < parts.size(); ++k) {
    const double x = parts[k] * radius_x, y = parts[k] * radius_y;
    EXPECT_NEAR(left[k], simpson(f, -radius_x, x) / simpson(f, -radius_x, radius_x), 3e-3) << x;
    EXPECT_NEAR(below[k], simpson(g, -radius_y, y) / simpson(g, -radius_y, radius_y), 3e-3) << y;
  }
}

TEST(PixelFilter, Box) {
  const auto one = [](double) { return 1.0; };
  expect_filter(BoxFilter{0.5, 1}, 0.5, 1, one, one);
}

TEST(PixelFilter, Gaussian) {
  const auto f = [](double x) { return std::exp(-2 * x * x) - std::exp(-2 * 1.5 * 1.5); };
  expect_filter(GaussianFilter{1.5, 1.5, 0.5}, 1.5, 1.5, f, f);
}

TEST(PixelFilter, Mitchell) {
  const auto f = [](double x) { return mitchell(x, 1.0 / 3, 1.0 / 3); };
  expect_filter(MitchellFilter{2, 4, 1.0 / 3, 1.0 / 3}, 2, 4, f, [&](double x) { return f(x / 2); });
  const auto sharp = [](double x) { return mitchell(x, 0, 0.75); };
  expect_filter(MitchellFilter{2, 2, 0, 0.75}, 2, 2, sharp, sharp);
}

TEST(PixelFilter, Lanczos) {
  const auto f = [](double x) { return std::abs(x) < 3 ? sinc(x) * sinc(x / 3) : 0; };
  expect_filter(SincFilter{3, 3, 3}, 3, 3, f, f);
  expect_filter(SincFilter{4, 2, 3}, 4, 2, f, f);
}

TEST(PixelFilter, LobesAreNegativeAndTheMeanIsOne) {
  const FilterSampler sampler(MitchellFilter{});
  double least = 1;
  for (int i = 0; i < 256; ++i)
    least = std::min(least, sampler.weight((static_cast<float>(i) + 0.5f) / 256, 0.5f));
  EXPECT_LT(least, -1);
  EXPECT_EQ(sampler.weight(0.3f, 0.2f), sampler.sample(0.3f, 0.2f).weight);
  EXPECT_EQ(FilterSampler(GaussianFilter{}).weight(0.1f, 0.9f), 1);
}

// Through the whole renderer: a bright half plane under a sharp filter rings, and what is even stays even.
void expect_rings_beside_an_edge(bool splat) {
  Scene scene;
  test::set_camera(scene, {0, 0, 1}, {0, 0, 0}, {0, 1, 0}, 1.5, 24, 24);
  const Id<TriangleMesh> mesh = test::add_quads(scene, {{{{0, -2, 0}, {2, -2, 0}, {2, 2, 0}, {0, 2, 0}}}});
  AreaLight light;
  light.radiance = Spectrum{ConstantSpectrum{1}};
  light.two_sided = true;
  test::add_shape(scene, mesh, Material{DiffuseMaterial{Spectrum{ConstantSpectrum{0}}}}, light);
  scene.film.filter = MitchellFilter{2, 2, 0, 0.75};
  scene.settings.max_depth = 0;
  RenderOptions options;
  options.picture.samples_per_pixel = 1024;
  options.picture.samples.sampling.splat = splat;
  const Film film = test::render(scene, options).film;
  const auto column = [&](std::uint32_t x) {
    double sum = 0;
    for (std::uint32_t y = 4; y < 20; ++y) sum += film.mean(24 * y + x).y / 16;
    return sum;
  };
  const bool left_is_lit = column(2) > 0.5;
  const auto lit = [&](std::uint32_t steps) { return column(left_is_lit ? 11 - steps : 12 + steps); };
  const auto dark = [&](std::uint32_t steps) { return column(left_is_lit ? 12 + steps : 11 - steps); };
  EXPECT_NEAR(lit(5), 1, 0.01);
  EXPECT_NEAR(dark(5), 0, 1e-9);
  const auto f = [](double x) { return mitchell(x, 0, 0.75); };
  for (std::uint32_t steps : {0u, 1u}) {
    const double over = simpson(f, -(steps + 0.5), 2) / simpson(f, -2, 2);
    EXPECT_NEAR(lit(steps), over, 0.01) << steps;
    EXPECT_NEAR(dark(steps), 1 - over, 0.01) << steps;
  }
  EXPECT_GT(lit(1), 1.01);
}

TEST(PixelFilter, RingsBesideAnEdge) { expect_rings_beside_an_edge(false); }
TEST(PixelFilter, RingsBesideAnEdgeWhereSamplesSplat) { expect_rings_beside_an_edge(true); }

}  // namespace
}  // namespace vitrail::pixel_filter_test
