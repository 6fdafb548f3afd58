// SPDX-License-Identifier: Apache-2.0
#include "scene/models/subsurface_media.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>

#include "scene/models/measured_media.h"

namespace vitrail {

namespace {

constexpr std::size_t half = 8,
                      ordinates = 2 * half;  // directions of a hemisphere, those of each range of it
constexpr std::size_t terms = 2 * half;      // of the phase function: what `half` nodes integrate exactly

using Vector = std::array<double, ordinates>;
using Matrix = std::array<Vector, ordinates>;

Matrix operator*(const Matrix& a, const Matrix& b) {
  Matrix c{};
  for (std::size_t i = 0; i < ordinates; ++i)
    for (std::size_t k = 0; k < ordinates; ++k)
      for (std::size_t j = 0; j < ordinates; ++j) c[i][j] += a[i][k] * b[k][j];
  return c;
}

Vector operator*(const Matrix& a, const Vector& v) {
  Vector c{};
  for (std::size_t i = 0; i < ordinates; ++i)
    for (std::size_t k = 0; k < ordinates; ++k) c[i] += a[i][k] * v[k];
  return c;
}

// x of (1 − a)·x = b, by elimination: 1 − a is diagonally dominant where a loses light. Columns of b beside
// each other.
template <class Row>
std::array<Row, ordinates> solve_one_minus(const Matrix& a, std::array<Row, ordinates> b) {
  Matrix m{};
  for (std::size_t i = 0; i < ordinates; ++i)
    for (std::size_t j = 0; j < ordinates; ++j) m[i][j] = (i == j) - a[i][j];
  for (std::size_t k = 0; k < ordinates; ++k)
    for (std::size_t i = 0; i < ordinates; ++i) {
      if (i == k) continue;
      const double f = m[i][k] / m[k][k];
      for (std::size_t j = k; j < ordinates; ++j) m[i][j] -= f * m[k][j];
      for (std::size_t j = 0; j < b[i].size(); ++j) b[i][j] -= f * b[k][j];
    }
  for (std::size_t i = 0; i < ordinates; ++i)
    for (double& x : b[i]) x /= m[i][i];
  return b;
}

// P_0(x) … P_terms(x).
std::array<double, terms + 1> legendre(double x) {
  std::array<double, terms + 1> p{1, x};
  for (std::size_t l = 1; l < terms; ++l) {
    const auto d = static_cast<double>(l);
    p[l + 1] = ((2 * d + 1) * x * p[l] - d * p[l - 1]) / (d + 1);
  }
  return p;
}

// Fresnel's reflectance for light from inside, μ the cosine there.
double reflectance_inside(double mu, double eta) {
  const double sin2 = (1 - mu * mu) * eta * eta;
  if (sin2 >= 1) return 1;
  const double outside = std::sqrt(1 - sin2), s = (eta * mu - outside) / (eta * mu + outside),
               p = (mu - eta * outside) / (mu + eta * outside);
  return (s * s + p * p) / 2;
}

// Cosines and weights of Gauss in two ranges, that parts at the critical angle: nothing leaves beyond it.
struct Directions {
  Vector mu{}, weight{};
};
Directions directions(double eta) {
  const double critical = eta > 1 ? std::sqrt(1 - 1 / (eta * eta)) : 0.5;
  Directions d;
  for (std::size_t i = 0; i < half; ++i) {
    double x = std::cos(3.14159265358979323846 * (static_cast<double>(i) + 0.75) / (half + 0.5)), slope = 1;
    for (int step = 0; step < 8; ++step) {  // Newton
      const auto p = legendre(x);
      slope = half * (x * p[half] - p[half - 1]) / (x * x - 1);
      x -= p[half] / slope;
    }
    const double weight = 2 / ((1 - x * x) * slope * slope);
    d.mu[i] = critical * (1 + x) / 2, d.weight[i] = critical * weight / 2;
    d.mu[half + i] = critical + (1 - critical) * (1 + x) / 2,
                d.weight[half + i] = (1 - critical) * weight / 2;
  }
  return d;
}

// What a half space without boundary sends back: radiance to direction i is Σ_j R_ij times that from j.
Matrix half_space(double albedo, double g, const Directions& d) {
  const double peak = std::pow(g, terms);  // taken as not scattered at all
  const double scaled_albedo = albedo * (1 - peak) / (1 - albedo * peak);
  constexpr double thickness = 1.0 / (1 << 26);
  Matrix r{}, t{};
  for (std::size_t i = 0; i < ordinates; ++i) {
    const auto pi = legendre(d.mu[i]);
    for (std::size_t j = 0; j < ordinates; ++j) {
      const auto pj = legendre(d.mu[j]);
      double forward = 0, back = 0, moment = 1;
      for (std::size_t l = 0; l < terms; ++l, moment *= g) {
        const double term = (2 * static_cast<double>(l) + 1) * (moment - peak) / (1 - peak) * pi[l] * pj[l];
        forward += term, back += l % 2 == 0 ? term : -term;
      }
      const double scattered = thickness / d.mu[i] * scaled_albedo / 2 * d.weight[j];
      r[i][j] = scattered * back;
      t[i][j] = scattered * forward + (i == j ? 1 - thickness / d.mu[i] : 0);
    }
  }
  const auto passes = [&] {
    double most = 0;
    for (const Vector& row : t)
      for (const double x : row) most = std::max(most, std::abs(x));
    return most > 1e-9;
  };
  // Twice the layer: light goes back and forth between the two.
  for (int doublings = 0; doublings < 64 && passes(); ++doublings) {
    const Matrix between = solve_one_minus(r * r, t), more = t * (r * between);
    for (std::size_t i = 0; i < ordinates; ++i)
      for (std::size_t j = 0; j < ordinates; ++j) r[i][j] += more[i][j];
    t = t * between;
  }
  return r;
}

// Of s = √((1 − α)/(1 − αg)), of which reflectances are about linear functions.
double albedo_of_similarity(double s, double g) { return (1 - s * s) / (1 - g * s * s); }

// The inverse of diffuse_reflectance in α, by its values at squares of equal steps: near s = 0 it is steep.
class AlbedoOfReflectance {
 public:
  AlbedoOfReflectance(double g, double eta) : g_(g) {
    for (std::size_t i = 0; i <= steps; ++i)
      values_[i] = diffuse_reflectance(albedo_of_similarity(node(i), g), g, eta);
  }
  double operator()(double reflectance) const {
    const double r = std::clamp(reflectance, 0.0, 1.0);
    const auto* below = std::ranges::lower_bound(values_, r, std::greater{});  // the first that is not above
    if (below == values_.begin()) return 1;
    const double above = *(below - 1), part = (above - r) / (above - *below);
    const auto i = static_cast<std::size_t>(below - values_.begin());
    return albedo_of_similarity(node(i - 1) + part * (node(i) - node(i - 1)), g_);
  }

 private:
  static constexpr std::size_t steps = 128;
  static double node(std::size_t i) {
    const double x = static_cast<double>(i) / steps;
    return x * x;
  }
  double g_;
  std::array<double, steps + 1> values_{};
};

Spectrum mapped(const Spectrum& spectrum, const std::function<double(double)>& f) {
  const Spectrum s = resolved(spectrum);
  if (is_constant(s)) return ConstantSpectrum{static_cast<float>(f(evaluate(s, 550)))};
  TabulatedSpectrum table;
  for (int i = 0; i < table_size; ++i)
    table.values.push_back(static_cast<float>(f(evaluate(s, lambda_min_nm + i))));
  return table;
}

}  // namespace

double diffuse_reflectance(double albedo, double g, double eta) {
  if (albedo >= 1) return 1;
  const Directions d = directions(eta);
  const Matrix r = half_space(albedo, g, d);
  // Just inside, downwards: what enters and what the boundary sends back, (1 − F R)⁻¹ (1 − F).
  Matrix held{};
  std::array<std::array<double, 1>, ordinates> enters{};
  for (std::size_t i = 0; i < ordinates; ++i) {
    const double f = reflectance_inside(d.mu[i], eta);
    enters[i][0] = 1 - f;
    for (std::size_t j = 0; j < ordinates; ++j) held[i][j] = f * r[i][j];
  }
  const auto downwards = solve_one_minus(held, enters);
  Vector down{};
  for (std::size_t i = 0; i < ordinates; ++i) down[i] = downwards[i][0];
  const Vector up = r * down;
  double left = 0, entered = 0;
  for (std::size_t i = 0; i < ordinates; ++i) {
    left += enters[i][0] * up[i] * d.mu[i] * d.weight[i];
    entered += enters[i][0] * d.mu[i] * d.weight[i];
  }
  return left / entered;
}

ExtinctionAlbedo effective_coefficients(const Spectrum& reflectance, const Spectrum& mean_free_path, double g,
                                        double eta) {
  constexpr double shortest = 1e-6;
  return {mapped(mean_free_path, [](double path) { return 1 / (path > shortest ? path : shortest); }),
          mapped(reflectance, AlbedoOfReflectance(g, eta))};
}

std::optional<Medium> interior_of(const SubsurfaceMaterial& m) {
  Medium medium;
  medium.scale = m.scale;
  medium.g = m.g;
  if (const auto* named = std::get_if<SubsurfaceMaterial::Named>(&m.interior)) {
    const auto measured = measured_medium(named->name);
    if (!measured) return std::nullopt;
    medium.coefficients = *measured;
    medium.g = 0;  // the measured scattering is the reduced one
  } else if (const auto* given = std::get_if<SubsurfaceMaterial::Coefficients>(&m.interior)) {
    const auto *a = std::get_if<Spectrum>(&given->sigma_a), *s = std::get_if<Spectrum>(&given->sigma_s);
    if (!a || !s) return std::nullopt;
    medium.coefficients = AbsorptionScattering{*a, *s};
  } else {
    const auto& effective = std::get<SubsurfaceMaterial::Effective>(m.interior);
    const auto *r = std::get_if<Spectrum>(&effective.reflectance),
               *path = std::get_if<Spectrum>(&effective.mean_free_path);
    if (!r || !path) return std::nullopt;
    medium.coefficients =
        effective_coefficients(*r, *path, static_cast<double>(m.g), evaluate(resolved(m.eta), 550));
    medium.scale = 1 / m.scale;  // it is the mean free path's
  }
  return medium;
}

}  // namespace vitrail
