// SPDX-License-Identifier: Apache-2.0
#include "glazing/pane.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "glazing/thin_film.h"
#include "scene/geometry/portable_math.h"
#include "scene/system/diagnostics.h"

namespace vitrail {

namespace {

double square(double x) { return x * x; }

// Reflectance ρ of one face from T and R of a sheet of two equal faces: R = ρ + ρ(1−ρ)²a²/(1−ρ²a²) and
// T = (1−ρ)²a/(1−ρ²a²) without a.
double face_reflectance(double t, double r) {
  const double beta = t * t - r * r + 2 * r + 1;
  return (beta - std::sqrt(std::max(0.0, beta * beta - 4 * (2 - r) * r))) / (2 * (2 - r));
}

double index_of_face(double rho) {
  const double root = std::sqrt(std::min(rho, 0.98));
  return (1 + root) / (1 - root);
}

// What remains of light that crosses the sheet once, at normal incidence.
double passage(double t, double r, double rho) {
  if (!(t > 0)) return 0;
  if (!(rho > 1e-9)) return t;  // without reflection
  return std::clamp((r - rho) / (t * rho), 0.0, 1.0);
}

struct Sheet {
  double t = 0, r = 0;
};

Sheet sheet(double rho, double a) {
  const double t = a * square(1 - rho) / (1 - square(a * rho));
  return {t, rho * (1 + a * t)};
}

// Of a sheet with both faces of the index that R says.
std::array<Sheet, 2> sheet_at(double t, double r, double cosine) {
  const double rho = face_reflectance(t, r), n = index_of_face(rho);
  const double inner = std::sqrt(1 - (1 - cosine * cosine) / (n * n));
  const double a = portable_pow(passage(t, r, rho), 1 / inner);
  return {sheet(square((cosine - n * inner) / (cosine + n * inner)), a),
          sheet(square((n * cosine - inner) / (n * cosine + inner)), a)};
}

double polynomial(const std::array<double, 5>& c, double x) {
  return c[0] + x * (c[1] + x * (c[2] + x * (c[3] + x * c[4])));
}

// Relative to normal incidence: τ(cos) and ρ(cos) + τ(cos).
struct AngularShape {
  std::array<double, 5> t, sum;
};
constexpr AngularShape clear_shape{{-0.0015, 3.355, -3.84, 1.46, 0.0288},
                                   {0.999, -0.563, 2.043, -2.532, 1.054}};
constexpr AngularShape bronze_shape{{-0.002, 2.813, -2.341, -0.05725, 0.599},
                                    {0.997, -1.868, 6.513, -7.862, 3.225}};

PolarisedValues measured_at(const MeasuredPane& pane, double nm, double cosine) {
  const PaneValues normal = value_at(pane.rows, nm);
  if (cosine >= 1) return {normal, normal};
  if (pane.kind == PaneKind::clear) return clear_glass(normal, cosine);
  const PaneValues v = coated_glass(normal, cosine);
  return {v, v};
}

}  // namespace

PaneValues mean(const PolarisedValues& v) {
  return {(v.s.t + v.p.t) / 2, (v.s.rf + v.p.rf) / 2, (v.s.rb + v.p.rb) / 2};
}

PolarisedValues clear_glass(PaneValues normal, double cosine) {
  const auto front = sheet_at(normal.t, normal.rf, cosine), back = sheet_at(normal.t, normal.rb, cosine);
  return {{front[0].t, front[0].r, back[0].r}, {front[1].t, front[1].r, back[1].r}};
}

IndexRow clear_glass_index(double nm, double t, double r, double thickness_mm) {
  const double rho = face_reflectance(t, r), a = std::max(passage(t, r, rho), 1e-300);
  return {nm, index_of_face(rho), -portable_log(a) * nm * 1e-6 / (4 * pi * thickness_mm)};
}

PaneValues coated_glass(PaneValues normal, double cosine) {
  if (cosine >= 1) return normal;
  const AngularShape& shape = normal.t > 0.645 ? clear_shape : bronze_shape;
  const double tau = polynomial(shape.t, cosine), rho = polynomial(shape.sum, cosine) - tau;
  const auto reflected = [&](double r) { return std::clamp(r * (1 - rho) + rho, 0.0, 1.0); };
  return {std::clamp(tau * normal.t, 0.0, 1.0), reflected(normal.rf), reflected(normal.rb)};
}

PolarisedValues values_at(const Pane& pane, double nm, double cosine) {
  // At grazing incidence nothing passes; the models' own limits are 0/0, or not exact.
  if (!(cosine > 1e-6)) return {{0, 1, 1}, {0, 1, 1}};
  if (const auto* measured = std::get_if<MeasuredPane>(&pane)) return measured_at(*measured, nm, cosine);
  const StackPane& stack = std::get<StackPane>(pane);
  return {stack_values(stack, nm, cosine, false), stack_values(stack, nm, cosine, true)};
}

std::vector<double> wavelengths_of(const Pane& pane) {
  std::vector<double> nm;
  if (const auto* measured = std::get_if<MeasuredPane>(&pane)) {
    for (const OpticalRow& row : measured->rows) nm.push_back(row.nm);
    return nm;
  }
  // Interference and tables of few wavelengths ask for steps of their own.
  for (double x = 300; x <= 2500; x += x < 1000 ? 5 : 10) nm.push_back(x);
  return nm;
}

WavelengthRange range_of(const Pane& pane) {
  if (const auto* measured = std::get_if<MeasuredPane>(&pane)) return range_of(measured->rows);
  WavelengthRange all;
  const auto add = [&](const IndexRows& index) {
    if (index.size() > 1) all = common(all, {index.front().nm, index.back().nm});
  };
  const StackPane& stack = std::get<StackPane>(pane);
  for (const Slab& slab : stack.slabs) add(slab.index);
  for (const auto& films : stack.films)
    for (const FilmLayer& film : films) add(film.index);
  return all;
}

Pane pane_of(const Product& product, double thickness_mm) {
  if (!product.rows.empty()) return MeasuredPane{product.rows, product.kind, product.scattered};
  if (!(thickness_mm > 0)) thickness_mm = product.thickness_mm;
  if (!(thickness_mm > 0))
    throw Error(
        fmt::format("\"{}\" has an index of refraction; its pane needs a thickness_mm", product.name));
  return StackPane{{{product.index, thickness_mm}}, {{}, {}}};
}

}  // namespace vitrail
