// SPDX-License-Identifier: Apache-2.0
// Panes at an angle, against closed forms.
#include "glazing/pane.h"

#include <gtest/gtest.h>

#include <cmath>
#include <complex>
#include <random>

#include "glazing/evaluation.h"
#include "glazing/thin_film.h"
#include "scene/geometry/pi.h"
#include "scene/spectra/named_spectra.h"
#include "scene/system/diagnostics.h"

namespace vitrail::pane_test {
namespace {

StackPane sheet(double n, double k, double mm) { return {{{{{550, n, k}}, mm}}, {{}, {}}}; }

// n 1.52, R of two faces: 2ρ/(1+ρ).
TEST(Pane, OfTransparentGlassReflectsTwice) {
  const double rho = std::pow(0.52 / 2.52, 2);
  const PaneValues v = mean(values_at(sheet(1.52, 0, 6), 550, 1));
  EXPECT_NEAR(v.rf, 2 * rho / (1 + rho), 1e-12);
  EXPECT_NEAR(v.t + v.rf, 1, 1e-12);
  EXPECT_EQ(v.rf, v.rb);
}

TEST(Pane, OfAnIndexIsAsThickAsItsProductUnlessItIsGiven) {
  Product product;
  product.index = {{550, 1.52, 0}};
  EXPECT_THROW(pane_of(product, 0), Error);
  product.thickness_mm = 0.5;
  EXPECT_EQ(std::get<StackPane>(pane_of(product, 0)).slabs.at(0).thickness_mm, 0.5);
  EXPECT_EQ(std::get<StackPane>(pane_of(product, 0.25)).slabs.at(0).thickness_mm, 0.25);
}

// p light at Brewster's angle is let through whole.
TEST(Pane, LetsLightThroughAtBrewstersAngle) {
  const PolarisedValues v = values_at(sheet(1.5, 0, 6), 550, std::cos(std::atan(1.5)));
  EXPECT_NEAR(v.p.rf, 0, 1e-12);
  EXPECT_GT(v.s.rf, 0.2);
}

// What measuring a sheet of known n and k would say, turned into every angle, is that sheet at that angle.
TEST(Pane, ClearGlassRecoversItsIndexAtEveryAngle) {
  for (const double n : {1.4, 1.52, 1.8})
    for (const double k : {0.0, 1e-7, 2e-6}) {
      const StackPane truth = sheet(n, k, 6);
      const PaneValues normal = mean(values_at(truth, 550, 1));
      const IndexRow index = clear_glass_index(550, normal.t, normal.rf, 6);
      EXPECT_NEAR(index.n, n, 1e-9);
      EXPECT_NEAR(index.k, k, 1e-12);
      for (const double degrees : {15.0, 45.0, 60.0, 80.0, 89.0}) {
        const double cosine = std::cos(degrees * pi / 180);
        const PolarisedValues model = clear_glass(normal, cosine), exact = values_at(truth, 550, cosine);
        EXPECT_NEAR(model.s.t, exact.s.t, 1e-9);
        EXPECT_NEAR(model.p.t, exact.p.t, 1e-9);
        EXPECT_NEAR(model.s.rf, exact.s.rf, 1e-9);
        EXPECT_NEAR(model.p.rb, exact.p.rb, 1e-9);
      }
    }
}

// Where Fresnel's equations are 0/0: no reflection at all, and reflection of everything.
TEST(Pane, ReflectsAllAtGrazingIncidence) {
  const std::vector<Pane> panes{MeasuredPane{{{500, {0.9, 0, 0}}}, PaneKind::clear},
                                MeasuredPane{{{500, {0.92, 0.08, 0.08}}}, PaneKind::clear},
                                MeasuredPane{{{500, {0.6, 0.3, 0.1}}}, PaneKind::coated}, sheet(1.52, 0, 6)};
  for (const Pane& pane : panes)
    for (const double cosine : {0.0, 1e-9}) {
      const PolarisedValues v = values_at(pane, 500, cosine);
      EXPECT_EQ(v.s, (PaneValues{0, 1, 1}));
      EXPECT_EQ(v.p, (PaneValues{0, 1, 1}));
    }
}

// A quarter wave of n₁ on n₂: R = ((n₁² − n₂)/(n₁² + n₂))² (Macleod, ch. 3).
TEST(ThinFilm, QuarterWavesAreAntireflective) {
  for (const double n1 : {1.38, 1.2329, 2.35}) {
    const FilmAt film{n1, 550 / (4 * n1)};
    const InterfaceValues v = film_stack(1, {&film, 1}, 1.52, 0, 550, false);
    EXPECT_NEAR(v.r, std::pow((n1 * n1 - 1.52) / (n1 * n1 + 1.52), 2), 1e-12);
    EXPECT_NEAR(v.r + v.t, 1, 1e-12);
  }
}

// Two quarter waves: R = ((n₂² − n₁²·n_s)/(n₂² + n₁²·n_s))², n₁ outside.
TEST(ThinFilm, TwoQuarterWaves) {
  const double n1 = 1.38, n2 = 1.70;
  const FilmAt films[]{{n1, 550 / (4 * n1)}, {n2, 550 / (4 * n2)}};
  const InterfaceValues v = film_stack(1, films, 1.52, 0, 550, true);
  EXPECT_NEAR(v.r, std::pow((n2 * n2 - n1 * n1 * 1.52) / (n2 * n2 + n1 * n1 * 1.52), 2), 1e-12);
}

// A single film by Airy's sum of all reflections, at an angle and with absorption.
TEST(ThinFilm, OneFilmIsAirysSum) {
  using Complex = std::complex<double>;
  const Complex n{0.13, -3.3}, glass = 1.52;
  const double d = 14, nm = 550, sine = std::sin(pi / 3);
  for (const bool parallel : {false, true}) {
    const auto cosine = [&](Complex index) {
      const Complex c = std::sqrt(1.0 - std::pow(sine / index, 2));
      return (index * c).imag() > 0 ? -c : c;
    };
    const auto r = [&](Complex a, Complex b) {
      return parallel ? (b * cosine(a) - a * cosine(b)) / (b * cosine(a) + a * cosine(b))
                      : (a * cosine(a) - b * cosine(b)) / (a * cosine(a) + b * cosine(b));
    };
    const Complex turn = std::exp(Complex(0, -4) * pi * n * d * cosine(n) / nm);
    const Complex sum = (r(1, n) + r(n, glass) * turn) / (1.0 + r(1, n) * r(n, glass) * turn);
    const FilmAt film{n, d};
    const InterfaceValues v = film_stack(1, {&film, 1}, glass, sine, nm, parallel);
    EXPECT_NEAR(v.r, std::norm(sum), 1e-12);
    EXPECT_NEAR(v.t, v.t_back, 1e-12);  // reciprocity
    EXPECT_LT(v.r + v.t, 1);
  }
}

TEST(ThinFilm, ThickMetalIsOpaqueAndFinite) {
  const FilmAt film{{0.13, -3.3}, 1e6};
  const InterfaceValues v = film_stack(1, {&film, 1}, 1.52, 0.5, 550, true);
  EXPECT_LT(v.t, 1e-200);
  EXPECT_TRUE(v.r > 0.9 && v.r < 1);
}

// No more comes out than went in, from either side, at any angle.
TEST(Pane, KeepsEnergy) {
  std::mt19937 random(7);
  const auto uniform = [&](double a, double b) {
    return std::uniform_real_distribution<double>(a, b)(random);
  };
  for (int i = 0; i < 2000; ++i) {
    StackPane pane = sheet(uniform(1.3, 2.5), std::pow(10, uniform(-9, -4)), 4);
    const double absorbs = i % 2;
    for (auto& films : pane.films)
      for (int f = 0; f < i % 4; ++f)
        films.push_back({{{550, uniform(0.1, 3), absorbs * uniform(0, 4)}}, uniform(1, 300)});
    const double cosine = uniform(0, 1);
    for (const PaneValues& v : {values_at(pane, 550, cosine).s, values_at(pane, 550, cosine).p}) {
      EXPECT_GE(std::min({v.t, v.rf, v.rb}), 0);
      EXPECT_LE(v.t + v.rf, 1 + 1e-9);
      EXPECT_LE(v.t + v.rb, 1 + 1e-9);
    }
    const PaneValues normal{uniform(0, 1), 0, 0};
    const PaneValues coated = coated_glass({normal.t, uniform(0, 1 - normal.t), 0}, cosine);
    EXPECT_GE(std::min({coated.t, coated.rf, coated.rb}), 0);
    EXPECT_LE(coated.t + coated.rf, 1.02);  // polynomials: they are not exact
  }
}

IndexRows metal(const char* name) {
  const Spectrum n = *named_spectrum(std::string("metal-").append(name).append("-eta"));
  const Spectrum k = *named_spectrum(std::string("metal-").append(name).append("-k"));
  IndexRows rows;
  for (double nm = 360; nm <= 830; nm += 5) rows.push_back({nm, evaluate(n, nm), evaluate(k, nm)});
  return rows;
}

// What the curves of clear and bronze glass make of coatings whose layers are known. docs/why/glazing.md has
// the numbers.
TEST(Pane, CoatedModelIsNearThinFilmTheory) {
  const IndexRows glass{{550, 1.52, 2e-7}}, oxide{{550, 2.0, 0}}, titania{{550, 2.4, 0}};
  const auto coated = [&](std::vector<FilmLayer> films) {
    return StackPane{{{glass, 4}}, {{}, std::move(films)}};
  };
  const std::vector<std::pair<const char*, StackPane>> panes{
      {"one silver layer", coated({{oxide, 35}, {metal("Ag"), 11}, {oxide, 40}})},
      {"two silver layers",
       coated({{oxide, 35}, {metal("Ag"), 10}, {oxide, 75}, {metal("Ag"), 13}, {oxide, 35}})},
      {"titania", coated({{titania, 50}})},
      {"chromium", coated({{metal("Cr"), 6}})},
  };
  for (const auto& [name, pane] : panes)
    for (const double degrees : {15.0, 60.0}) {
      const double cosine = std::cos(degrees * pi / 180);
      SystemSpectrum exact, model;
      for (double nm = 380; nm <= 780; nm += 5) {
        exact.nm.push_back(nm);
        model.nm.push_back(nm);
        exact.values.push_back(mean(values_at(pane, nm, cosine)));
        model.values.push_back(coated_glass(mean(values_at(pane, nm, 1)), cosine));
      }
      const Method& eye = *find_method(nfrc_2003(), "PHOTOPIC");
      const PaneValues e = average(exact, eye), m = average(model, eye);
      std::printf("%-18s %2.0f°: T %.4f %+.4f, Rf %.4f %+.4f, Rb %.4f %+.4f\n", name, degrees, e.t, m.t - e.t,
                  e.rf, m.rf - e.rf, e.rb, m.rb - e.rb);
      const double bound = degrees < 45 ? 0.01 : 0.09;
      EXPECT_NEAR(m.t, e.t, bound) << name;
      EXPECT_NEAR(m.rf, e.rf, bound) << name;
      EXPECT_NEAR(m.rb, e.rb, bound) << name;
    }
}

}  // namespace
}  // namespace vitrail::pane_test
