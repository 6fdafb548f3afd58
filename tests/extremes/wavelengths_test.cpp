// SPDX-License-Identifier: Apache-2.0
// Light of one nanometre at the ends of the range, and in its middle.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <cmath>

#include "tests/extremes/measure.h"
#include "tracer/sampling/wavelengths.h"

namespace vitrail::test::wavelengths_test {
namespace {

constexpr SpectralBins bins{.count = 470};  // a nanometre each

TabulatedSpectrum line(int nm) {
  TabulatedSpectrum s;
  s.values.resize(table_size);
  s.values[static_cast<std::size_t>(nm - 360)] = 1;
  return s;
}

// ∫ S·c dλ / ∫ȳ dλ, both linear between nanometres: of every pair of neighbours ∫ (p + (q−p)t)(r + (s−r)t)
// dt.
long double integral(const TabulatedSpectrum& spectrum, std::size_t channel) {
  long double sum = 0;
  for (std::size_t i = 0; i + 1 < spectrum.values.size(); ++i) {
    const long double p = spectrum.values[i], q = spectrum.values[i + 1];
    const long double r = cie_1931()[i][channel], s = cie_1931()[i + 1][channel];
    sum += (2 * p * r + p * s + q * r + 2 * q * s) / 6;
  }
  return sum / static_cast<long double>(cie_y_integral_nm);
}

// The estimator over all numbers that a sample may begin with.
TEST(Wavelengths, LinesByAllNumbersThereAre) {
  for (const int nm : {360, 361, 555, 829, 830}) {
    const Spectrum spectrum = line(nm);
    XYZ sum;
    double in_first = 0, in_last = 0;
    for (std::uint32_t i = 0; i < 1u << 22; ++i) {
      // A quarter of the numbers: the four wavelengths of one are those of three others.
      const SampledWavelengths w = sample_wavelengths(static_cast<float>(i) * 0x1p-24f);
      const SensorWeights sensor = sensor_weights(w, 1, bins);
      const SampledSpectrum radiance = evaluate(spectrum, w);
      const XYZ xyz = sense(sensor, radiance);
      sum.x += xyz.x, sum.y += xyz.y, sum.z += xyz.z;
      for (std::size_t k = 0; k < hero_count; ++k) {
        const double value = static_cast<double>(radiance.v[k]) * static_cast<double>(sensor.spectral[k]);
        if (sensor.bin[k] == 0) in_first += value;
        if (sensor.bin[k] == 469) in_last += value;
      }
    }
    constexpr double weight = 0x1p-22;
    const TabulatedSpectrum table = line(nm);
    expect_relative(fmt::format("line at {} nm: X", nm), static_cast<double>(integral(table, 0)),
                    sum.x * weight, 2e-3);
    expect_relative(fmt::format("line at {} nm: Y", nm), static_cast<double>(integral(table, 1)),
                    sum.y * weight, 2e-3);
    if (nm == 360) expect_relative("its radiance in the bin 360 … 361 nm", 0.5, in_first * weight, 2e-3);
    if (nm == 830) expect_relative("its radiance in the bin 829 … 830 nm", 0.5, in_last * weight, 2e-3);
  }
}

TEST(Wavelengths, StayInTheirRange) {
  float least = 1e9f, most = 0;
  for (const float u : {0.0f, 0x1p-24f, 0.25f - 0x1p-24f, 0.25f, 0.5f, 0.75f, 1 - 0x1p-24f}) {
    const SampledWavelengths w = sample_wavelengths(u);
    for (const float lambda : w.lambda_nm) least = std::min(least, lambda), most = std::max(most, lambda);
  }
  expect_absolute("shortest wavelength, nm", 360, static_cast<double>(least), 0);
  expect_absolute("longest wavelength, nm", 830, static_cast<double>(most), 0.01);
}

// As rendered: a lamp of the line, into bins. Of 2·10⁶ samples some 350 fall into a nanometre at an end.
TEST(Wavelengths, LinesAsRendered) {
  for (const int nm : {360, 555, 830}) {
    Scene scene;
    AreaLight light = lamp(1);
    light.radiance = Spectrum{line(nm)};
    add_shape(scene, add_quads(scene, {square_at(0, 10)}), matte(0), light);
    set_orthographic(scene, {0, 0, 3}, {0, 0, 0}, {0, 1, 0}, 1, 32);
    scene.film.spectrum = bins;
    const Film film = render(scene, 2048).film;
    const int bin = std::min(nm - 360, 469);
    double in_bin = 0, elsewhere = 0;
    for (std::uint32_t p = 0; p < pixels_of(film); ++p)
      for (int b = 0; b < bins.count; ++b)
        (b == bin || b + 1 == nm - 360 ? in_bin : elsewhere) +=
            film.mean_of_bin(p, static_cast<std::size_t>(b)) / 1024;
    const double expected = nm == 360 || nm == 830 ? 0.5 : 1;
    expect_relative(fmt::format("lamp of a line at {} nm: its bins", nm), expected, in_bin, 0,
                    expected * 0.05);
    expect_exactly("all other bins", 0, elsewhere);
  }
}

}  // namespace
}  // namespace vitrail::test::wavelengths_test
