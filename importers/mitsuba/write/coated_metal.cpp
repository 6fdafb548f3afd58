// SPDX-License-Identifier: Apache-2.0
#include "importers/mitsuba/write/coated_metal.h"

#include <algorithm>
#include <cmath>
#include <complex>

#include "importers/mitsuba/write/write_textures.h"

namespace vitrail::mitsuba_writer {

namespace {

// Unpolarised light on what is of index n to where it comes from.
double fresnel(double cosine, std::complex<double> n) {
  const std::complex<double> c = cosine, inside = std::sqrt(1.0 - (1 - cosine * cosine) / (n * n));
  return (std::norm((c - n * inside) / (c + n * inside)) + std::norm((n * c - inside) / (n * c + inside))) /
         2;
}

// The albedo of a metal below a smooth clear coat of index eta ÷ that of the metal alone: light goes to and
// fro below the coat.
double coated_share(std::complex<double> metal, double eta) {
  constexpr int steps = 64;
  double coated = 0, bare = 0;
  for (int i = 0; i < steps; ++i) {
    const double sin2 = (i + 0.5) / steps, cosine = std::sqrt(1 - sin2),
                 below = std::sqrt(1 - sin2 / (eta * eta));
    const double f = fresnel(cosine, eta), r = fresnel(below, metal / eta);
    coated += f + (1 - f) * (1 - f) * r / (1 - r * f);
    bare += fresnel(cosine, metal);
  }
  return coated / bare;
}

}  // namespace

std::optional<Spectrum> coated_share(Context& context, const Metal& metal, const Spectrum& eta) {
  const auto* index = std::get_if<ComplexIndex>(&metal);
  const auto n = index ? value_of(context, index->eta) : std::nullopt,
             k = index ? value_of(context, index->k) : std::nullopt;
  if (!n || !k) return std::nullopt;
  const Spectrum real = resolved(*n), imaginary = resolved(*k), coat = resolved(eta);
  return tabulated([&](double lambda) {
    const std::complex<double> at(evaluate(real, lambda), evaluate(imaginary, lambda));
    return std::abs(at) > 0 ? std::min(1.0, coated_share(at, std::max(1.0, evaluate(coat, lambda)))) : 1.0;
  });
}

}  // namespace vitrail::mitsuba_writer
