// SPDX-License-Identifier: Apache-2.0
#include "tracer/bsdf/adaptive.h"

#include <algorithm>
#include <cmath>

#include "scene/geometry/portable_math.h"
#include "tracer/bsdf/between.h"

namespace vitrail {

namespace {

// θ = u²·π/2, φ = (2v − 1)·π.
struct Spherical {
  double theta, phi;
  explicit Spherical(Vector3d d)
      : theta(portable_atan2(std::sqrt(d.x * d.x + d.y * d.y), d.z)), phi(portable_atan2(d.y, d.x)) {}
  Point2d on_square(double turned_by = 0) const {
    const double v = (phi - turned_by + pi) / (2 * pi);
    return {std::sqrt(theta * (2 / pi)), v - std::floor(v)};
  }
};

// Incidence, and the squares of the table that it lies between.
struct Incidence {
  Vector3d out;
  Spherical at{out};
  double turned_by = 0;  // of the microfacets' azimuths: those of isotropic tables are relative
  Slices slices{};
  Between phi{}, theta{};
};

// Anisotropic tables hold as much of the azimuths as the symmetries of the surface ask for, from −π on: all,
// the half or a quarter. The signs bring a direction there.
struct Symmetry {
  double x = 1, y = 1;
  Vector3d operator()(Vector3d d) const { return {d.x * x, d.y * y, d.z}; }
};
Symmetry symmetry_of(const AdaptiveTable& t, Vector3d out) {
  if (is_isotropic(t)) return {};
  const double part = static_cast<double>(t.phi_i.back()) - static_cast<double>(t.phi_i.front());
  const double times = std::nearbyint(2 * pi / part);
  if (times < 2) return {};
  const double sign_y = std::signbit(out.y) ? 1 : -1, sign_x = std::signbit(out.x) ? 1 : -1;
  return times == 4 ? Symmetry{sign_x, sign_y} : Symmetry{sign_y, sign_y};
}

Incidence incidence(const AdaptiveTable& t, Vector3d out) {
  Incidence i{out};
  if (is_isotropic(t)) i.turned_by = i.at.phi;
  i.phi = locate(t.phi_i, i.at.phi), i.theta = locate(t.theta_i, i.at.theta);
  const std::size_t row = t.theta_i.size(), first = i.phi.first * row + i.theta.first;
  const double p = i.phi.part, q = i.theta.part;
  i.slices.add(first, (1 - p) * (1 - q)), i.slices.add(first + 1, (1 - p) * q);
  i.slices.add(first + row, p * (1 - q)), i.slices.add(first + row + 1, p * q);
  return i;
}

// f·cos θ_in of a place `u` of the spectra whose microfacets have the normal `normal` (on the square).
SampledSpectrum reflected(const AdaptiveBsdf& b, const Incidence& i, Point2d u, Point2d normal) {
  const AdaptiveTable& t = *b.table;
  double scale = 1;
  if (t.normalised) {
    const double area = bilinear(t.projected_area, 0, i.at.on_square());
    scale = area > 0 ? bilinear(t.normals, 0, normal) / (4 * area) : 0;
  }
  SampledSpectrum value;
  const std::size_t wavelengths = t.wavelengths_nm.size();
  for (std::size_t k = 0; k < hero_count; ++k) {
    const Between at = locate(t.wavelengths_nm, static_cast<double>(b.wavelengths.lambda_nm[k]));
    double sum = 0;
    for (std::size_t s = 0; s < i.slices.count; ++s) {
      const std::size_t slice = i.slices.index[s] * wavelengths + at.first;
      const double low = bilinear(t.spectra, slice, u);
      const double here = at.part > 0 ? low + (bilinear(t.spectra, slice + 1, u) - low) * at.part : low;
      sum += i.slices.weight[s] * here;
    }
    value.v[k] = static_cast<float>(std::max(0.0, sum * scale));
  }
  return value;
}

// d in / d(square): the microfacet's normal is sin θ·|dθ/du·dφ/dv| of the square, and 4·(out·m) of `in`.
double spread(double u, double sin_theta, double out_m) {
  return std::max(2 * pi * pi * u * sin_theta, 1e-6) * 4 * out_m;
}

}  // namespace

AdaptiveWarps warps_of(const AdaptiveTable& table) {
  return {make_warp(table.luminance), make_warp(table.visible_normals)};
}

BsdfValue eval(const AdaptiveBsdf& b, Vector3d out, Vector3d in) {
  if (!(out.z > 0 && in.z > 0)) return {};
  const Symmetry symmetry = symmetry_of(*b.table, out);
  const Incidence i = incidence(*b.table, symmetry(out));
  const Vector3d m = normalize(i.out + symmetry(in));
  const Point2d normal = Spherical(m).on_square(i.turned_by);
  const WarpPoint place = inverse(b.warps->visible_normals, i.slices, normal);
  const double sine = std::sqrt(m.x * m.x + m.y * m.y);
  return {reflected(b, i, place.p, normal),
          place.pdf * density(b.warps->luminance, i.slices, place.p) / spread(normal.x, sine, dot(i.out, m))};
}

double pdf(const AdaptiveBsdf& b, Vector3d out, Vector3d in) { return eval(b, out, in).pdf; }

std::optional<BsdfSample> sample(const AdaptiveBsdf& b, Vector3d out, float, Point2f u) {
  if (!(out.z > 0)) return std::nullopt;
  const Symmetry symmetry = symmetry_of(*b.table, out);
  const Incidence i = incidence(*b.table, symmetry(out));
  const WarpPoint bright =
      sample(b.warps->luminance, i.slices, {static_cast<double>(u.y), static_cast<double>(u.x)});
  const WarpPoint facet = sample(b.warps->visible_normals, i.slices, bright.p);
  const double theta = facet.p.x * facet.p.x * (pi / 2), phi = (2 * facet.p.y - 1) * pi + i.turned_by;
  const double sine = portable_sin(theta);
  const Vector3d m{portable_cos(phi) * sine, portable_sin(phi) * sine, portable_cos(theta)};
  const double out_m = dot(i.out, m);
  const Vector3d in = m * (2 * out_m) - i.out;
  const double pdf = facet.pdf * bright.pdf / spread(facet.p.x, sine, out_m);
  if (!(out_m > 0) || !(in.z > 0) || !(pdf > 0)) return std::nullopt;
  return BsdfSample{.in = normalize(symmetry(in)),
                    .weight = reflected(b, i, bright.p, facet.p) * static_cast<float>(1 / pdf),
                    .pdf = pdf};
}

}  // namespace vitrail
