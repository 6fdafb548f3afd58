// SPDX-License-Identifier: Apache-2.0
// Colours as spectra of three bands, and the film that sees them.
#include "scene/spectra/rgb_bands.h"

#include <gtest/gtest.h>

#include "scene/spectra/rgb_to_spectrum.h"
#include "tracer/sampling/wavelengths.h"

namespace vitrail::rgb_bands_test {
namespace {

// Sums what samples see of the spectra, multiplied at each wavelength; as linear sRGB.
RGB seen(std::initializer_list<Spectrum> spectra, int samples = 1 << 16) {
  XYZ sum;
  for (int i = 0; i < samples; ++i) {
    const SampledWavelengths w =
        sample_wavelengths((static_cast<float>(i) + 0.5f) / static_cast<float>(samples));
    SampledSpectrum product = filled(1);
    for (const Spectrum& s : spectra) product = product * evaluate(s, w);
    const XYZ xyz = sense(sensor_weights(w, 1, {}, band_observer()), product);
    sum.x += xyz.x / samples, sum.y += xyz.y / samples, sum.z += xyz.z / samples;
  }
  return xyz_to_srgb(sum);
}

void expect_color(RGB is, RGB wanted, double tolerance) {
  EXPECT_NEAR(is.r, wanted.r, tolerance);
  EXPECT_NEAR(is.g, wanted.g, tolerance);
  EXPECT_NEAR(is.b, wanted.b, tolerance);
}

TEST(RgbBands, MultiplyAsNumbers) {
  const RGB lamp{1, 0.5, 0.2}, surface{0.8, 0.4, 0.2}, glass{0, 1, 0.3};
  expect_color(seen({band_spectrum({1, 1, 1})}), {1, 1, 1}, 1e-4);
  expect_color(seen({band_spectrum(lamp)}), lamp, 1e-4);
  expect_color(seen({band_spectrum(lamp), band_spectrum(surface)}), {0.8, 0.2, 0.04}, 1e-4);
  expect_color(
      seen({band_spectrum(lamp), band_spectrum(surface), band_spectrum(surface), band_spectrum(glass)}),
      {0, 0.08, 0.0024}, 1e-4);
  expect_color(seen({band_spectrum({0, 1, 0}), band_spectrum({1, 0, 0})}), {0, 0, 0}, 0);
}

// Of the four wavelengths of a path one is blue, two are green and one is red, but where one falls between
// two bands; so a single sample has the colour.
TEST(RgbBands, ShowEachSampleItsColour) {
  constexpr int samples = 4096;
  int whole = 0;
  for (int i = 0; i < samples; ++i) {
    const SampledWavelengths w = sample_wavelengths((static_cast<float>(i) + 0.5f) / samples);
    const RGB c = xyz_to_srgb(
        sense(sensor_weights(w, 1, {}, band_observer()), evaluate(band_spectrum({0.8, 0.4, 0.2}), w)));
    whole +=
        std::abs(c.r / 0.8 - 1) < 0.05 && std::abs(c.g / 0.4 - 1) < 0.05 && std::abs(c.b / 0.2 - 1) < 0.05;
  }
  EXPECT_GT(whole, 0.85 * samples);
}

TEST(RgbBands, AreOfWhatColoursAreGivenAs) {
  const RGB c{0.7, 0.1, 0.4}, bright{7, 1, 4};
  const Spectrum given[]{reflectance_from_rgb(c), unbounded_from_rgb(bright), emission_from_rgb(bright)};
  expect_color(seen({in_bands(given[0])}), c, 1e-4);
  expect_color(seen({in_bands(given[1])}), bright, 1e-3);
  expect_color(seen({in_bands(given[2])}), bright, 1e-3);
  EXPECT_TRUE(is_constant(in_bands(emission_from_rgb({3, 3, 3}))));
  EXPECT_EQ(evaluate(in_bands(ConstantSpectrum{1.5f}), 500), 1.5);
  // Of other spectra the colour: a blackbody's is that of its light.
  const BlackbodySpectrum warm{3000, 2};
  const RGB of_warm = xyz_to_srgb(to_xyz(warm));
  expect_color(seen({in_bands(warm)}), {of_warm.r, of_warm.g, std::max(of_warm.b, 0.0)}, 1e-3);
  const Spectrum tabulated = resolved(Spectrum{reflectance_from_rgb(c)}), gold = NamedSpectrum{"metal-Au-k"};
  EXPECT_FALSE(is_constant(in_bands(gold)));
  expect_color(seen({in_bands(weighted_sum(tabulated, 1, gold, 0))}), c, 1e-3);
}

}  // namespace
}  // namespace vitrail::rgb_bands_test
