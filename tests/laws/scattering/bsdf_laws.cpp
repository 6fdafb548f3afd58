// SPDX-License-Identifier: Apache-2.0
#include "tests/laws/scattering/bsdf_laws.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <random>

#include "scene/geometry/pi.h"
#include "tests/laws/scattering/sphere_cells.h"
#include "tests/support/long_tests.h"

namespace vitrail::laws {

namespace {

constexpr double significance = 1.005e-5;  // 1 − (1 − 1 %)^(1/1000)
constexpr double expected_in_bin = 50;
constexpr double negligible = 1e-6;  // weight of a sample
constexpr int reciprocal_pairs = 300;

// Uniform in [0, 1), stratified as a whole: a lattice of three dimensions (Roberts 2018's generalised golden
// ratios), shifted at random.
class Lattice {
 public:
  explicit Lattice(std::uint32_t seed) {
    std::mt19937 random(seed);
    for (double& s : shift_) s = static_cast<double>(random()) * 0x1p-32;
  }
  float at(int i, int dimension) const {
    constexpr double step[] = {0.8191725133961645, 0.6710436067037893, 0.5497004779019703};
    const double x = shift_[dimension] + i * step[dimension];
    return std::min(static_cast<float>(x - std::floor(x)), 0x1.fffffep-1f);
  }

 private:
  double shift_[3]{};
};

double index_at(const Subject& s, Vector3d v) { return v.z > 0 ? 1 : s.eta; }

// Weight of radiance into one of energy.
double energy_scale(const Subject& s, Vector3d out, Vector3d in) {
  const double ratio = index_at(s, in) / index_at(s, out);
  return ratio * ratio;
}

bool plausible(const SampledSpectrum& s) {
  return std::all_of(s.v.begin(), s.v.end(), [](float x) { return std::isfinite(x) && x >= 0; });
}

bool plausible(const BsdfSample& s) {
  return plausible(s.weight) && std::isfinite(s.pdf) && (s.specular ? s.pdf == 0 : s.pdf > 0) &&
         std::abs(length(s.in) - 1) < 1e-6;
}

// Of what is above `floor`.
double relative_difference(double a, double b, double floor = 1e-30) {
  return a == b ? 0 : std::abs(a - b) / std::max({std::abs(a), std::abs(b), floor});
}

struct Draw {
  std::vector<BsdfSample> scattered;  // neither lost nor deltas
  int lost = 0, specular = 0;
};

Draw draw(const Subject& subject, Vector3d out, int count, std::uint32_t seed) {
  std::mt19937 random(seed);
  const auto uniform = [&] { return static_cast<float>(random() >> 8) * 0x1p-24f; };
  Draw result;
  for (int i = 0; i < count; ++i) {
    const float u_lobe = uniform(), u = uniform(), v = uniform();
    const auto s = subject.sample(out, u_lobe, {u, v});
    if (!s) {
      ++result.lost;
    } else if (!plausible(*s)) {
      ADD_FAILURE() << "sample " << i << ": in " << s->in.x << ", " << s->in.y << ", " << s->in.z << ", pdf "
                    << s->pdf << ", weight " << s->weight[0];
    } else if (s->specular) {
      ++result.specular;
    } else {
      result.scattered.push_back(*s);
    }
  }
  return result;
}

std::vector<Vector3d> directions(const Draw& d) {
  std::vector<Vector3d> result;
  for (const BsdfSample& s : d.scattered) result.push_back(s.in);
  return result;
}

void expect_consistent(const Subject& subject, Vector3d out, const Draw& d, double tolerance) {
  double worst_pdf = 0, worst_value = 0, worst_eval = 0;
  for (const BsdfSample& s : d.scattered) {
    const BsdfValue value = subject.eval(out, s.in);
    EXPECT_TRUE(plausible(value.value));
    const double density = subject.pdf(out, s.in);
    worst_pdf = std::max(worst_pdf, relative_difference(density, s.pdf));
    worst_eval = std::max(worst_eval, relative_difference(density, value.pdf));
    for (int i = 0; i < hero_count; ++i)
      worst_value = std::max(
          worst_value, relative_difference(static_cast<double>(value.value[i]),
                                           static_cast<double>(s.weight[i]) * s.pdf, negligible * s.pdf));
  }
  EXPECT_LE(worst_pdf, tolerance) << "the pdf of a sample is not what pdf says";
  EXPECT_LE(worst_eval, 1e-6) << "the pdf that eval gives is not what pdf says";
  EXPECT_LE(worst_value, tolerance) << "a sample's weight times its pdf is not what eval says";
}

void expect_reciprocal(const Subject& subject, Vector3d out, const Draw& d, double tolerance) {
  double worst = 0;
  for (std::size_t i = 0; i < std::min<std::size_t>(d.scattered.size(), reciprocal_pairs); ++i) {
    const Vector3d in = d.scattered[i].in;
    if (std::abs(in.z) < 1e-6) continue;
    const auto f = [&](Vector3d a, Vector3d b) {
      const double index = index_at(subject, a);
      return static_cast<double>(subject.eval(a, b).value[0]) / (std::abs(b.z) * index * index);
    };
    worst = std::max(
        worst, relative_difference(f(out, in), f(in, out), negligible * d.scattered[i].pdf / std::abs(in.z)));
  }
  EXPECT_LE(worst, tolerance) << "not reciprocal";
}

// Of more than χ² with so many degrees of freedom (Wilson & Hilferty 1931).
double chi_square_tail(double chi_square, int degrees) {
  const double k = 2.0 / (9.0 * degrees);
  const double z = (std::cbrt(chi_square / degrees) - (1 - k)) / std::sqrt(k);
  return std::erfc(z / std::numbers::sqrt2) / 2;
}

void expect_distribution(const Subject& subject, Vector3d out, const Draw& d, const Tolerances& tolerances) {
  const Draw other = draw(subject, out, tolerances.samples, 77);
  const SphereCells cells(directions(other));
  const auto expected = cells.integrate([&](Vector3d in) { return subject.pdf(out, in); });
  std::vector<double> observed(cells.size());
  for (const BsdfSample& s : d.scattered) observed[cells.cell_of(s.in)] += 1;

  double total = 0, chi_square = 0, bin_expected = 0, bin_observed = 0;
  int bins = 0;
  for (std::size_t i = 0; i < cells.size(); ++i) {
    total += expected[i];
    bin_expected += expected[i] * tolerances.samples;
    bin_observed += observed[i];
    if (bin_expected < expected_in_bin && i + 1 < cells.size()) continue;
    if (bin_expected > 1) {
      chi_square += (bin_observed - bin_expected) * (bin_observed - bin_expected) / bin_expected;
      ++bins;
    } else {
      EXPECT_LT(bin_observed, 20) << "samples where the pdf is 0";
    }
    bin_expected = bin_observed = 0;
  }
  // Twice the samples tell what part of them is scattered.
  const double scattered =
      static_cast<double>(d.scattered.size() + other.scattered.size()) / (2.0 * tolerances.samples);
  const double deviation = std::sqrt(scattered * (1 - scattered) / (2.0 * tolerances.samples));
  EXPECT_NEAR(total, scattered, tolerances.density + 4.5 * deviation) << "integral of the pdf";
  const int degrees = scattered == 1 ? bins - 1 : bins;
  if (degrees > 0) {
    EXPECT_GT(chi_square_tail(chi_square, degrees), significance)
        << "χ² " << chi_square << " of " << degrees << " degrees of freedom";
  }
}

}  // namespace

std::vector<Vector3d> incidences() {
  std::vector<Vector3d> result = {{0, 0, 1}};
  double azimuth = 0.4;
  for (double theta_deg : {30.0, 60.0, 80.0, 89.0, 89.99}) {
    const double theta = theta_deg * pi / 180;
    result.push_back(
        {std::sin(theta) * std::cos(azimuth), std::sin(theta) * std::sin(azimuth), std::cos(theta)});
    azimuth += 1.3;
  }
  return result;
}

Albedo albedo(const Subject& subject, Vector3d out, int samples) {
  constexpr int shifts = 10;
  const int points = samples / shifts;
  std::array<std::vector<double>, hero_count> mean;
  Albedo result;
  for (std::uint32_t shift = 0; shift < shifts; ++shift) {
    const Lattice lattice(shift + 1);
    std::array<double, hero_count> sum{};
    for (int i = 0; i < points; ++i) {
      const auto s = subject.sample(out, lattice.at(i, 0), {lattice.at(i, 1), lattice.at(i, 2)});
      result.lost += s ? 0 : 1;
      if (!s) continue;
      result.specular += s->specular ? 1 : 0;
      const double scale = energy_scale(subject, out, s->in);
      for (std::size_t k = 0; k < hero_count; ++k) sum[k] += static_cast<double>(s->weight.v[k]) * scale;
    }
    for (std::size_t k = 0; k < hero_count; ++k) mean[k].push_back(sum[k] / points);
  }
  result.lost /= shifts * points;
  result.specular /= shifts * points;
  for (const auto& m : mean) {
    double average = 0, variance = 0;
    for (double x : m) average += x / shifts;
    for (double x : m) variance += (x - average) * (x - average) / (shifts * (shifts - 1.0));
    if (average < result.mean) continue;
    result.mean = average;
    result.standard_error = std::sqrt(variance);
  }
  return result;
}

double integrated_pdf(const Subject& subject, Vector3d out) {
  const SphereCells cells(directions(draw(subject, out, 20000, 77)));
  double sum = 0;
  for (double x : cells.integrate([&](Vector3d in) { return subject.pdf(out, in); })) sum += x;
  return sum;
}

void expect_laws(const Subject& subject, Vector3d out, const Tolerances& whole) {
  Tolerances tolerances = whole;
  tolerances.samples = test::of_all(whole.samples, whole.samples / 2);
  const Albedo energy = albedo(subject, out, whole.samples);
  EXPECT_LE(energy.mean, 1 + tolerances.energy + 4 * energy.standard_error) << "energy";
  EXPECT_LT(energy.standard_error, 0.05) << "the albedo is too uncertain to tell";
  const Draw d = draw(subject, out, tolerances.samples, 1234);
  expect_consistent(subject, out, d, tolerances.consistency);
  if (tolerances.reciprocal) expect_reciprocal(subject, out, d, tolerances.reciprocity);
  expect_distribution(subject, out, d, tolerances);
}

void expect_laws(const Subject& subject, const std::string& name, const Tolerances& tolerances) {
  for (Vector3d above : incidences())
    for (double side : {1.0, -1.0}) {
      if (side < 0 && !subject.two_sides) continue;
      const Vector3d out{above.x, above.y, above.z * side};
      SCOPED_TRACE(name + ", cos θ = " + std::to_string(out.z));
      expect_laws(subject, out, tolerances);
    }
}

void expect_finite_at_extremes(const Subject& subject, const std::string& name) {
  SCOPED_TRACE(name);
  const double s = std::sqrt(0.5);
  std::vector<Vector3d> all = {{0, 0, 1}, {1, 0, 0}, {0, 1, 0}, {s, 0, s}, {1, 0, 1e-8}, {1, 0, 1e-300}};
  for (std::size_t i = 0, n = all.size(); i < n; ++i) all.push_back(-all[i]);
  for (Vector3d out : all) {
    if (!subject.two_sides && !(out.z > 0)) continue;
    for (Vector3d in : all) {
      const BsdfValue value = subject.eval(out, in);
      const double density = subject.pdf(out, in);
      EXPECT_TRUE(plausible(value.value) && std::isfinite(value.pdf) && value.pdf >= 0 && density >= 0 &&
                  std::isfinite(density))
          << "out " << out.x << ", " << out.y << ", " << out.z << "; in " << in.x << ", " << in.y << ", "
          << in.z;
    }
    for (float u_lobe : {0.0f, 0.5f, 0x1.fffffep-1f})
      for (float u : {0.0f, 0.25f, 0.5f, 0x1.fffffep-1f})
        for (float v : {0.0f, 0.25f, 0.5f, 0x1.fffffep-1f})
          if (const auto drawn = subject.sample(out, u_lobe, {u, v})) {
            EXPECT_TRUE(plausible(*drawn))
                << "out " << out.x << ", " << out.z << "; u " << u_lobe << ", " << u << ", " << v << "; pdf "
                << drawn->pdf << ", weight " << drawn->weight[0];
          }
  }
}

}  // namespace vitrail::laws
