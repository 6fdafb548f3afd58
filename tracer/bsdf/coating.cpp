// SPDX-License-Identifier: Apache-2.0
#include "tracer/bsdf/coating.h"

#include <algorithm>
#include <cmath>

#include "tracer/bsdf/local.h"

namespace vitrail {

namespace {

double eta_from(const Coating& c, Vector3d out) { return out.z > 0 ? c.eta : 1 / c.eta; }

// A facet as seen from `out`: its normal on that side, and its reflectance.
struct Facet {
  Vector3d normal;
  double eta, fresnel;
};

Facet sample_facet(const Coating& c, Vector3d out, Point2f u) {
  const double side = out.z > 0 ? 1 : -1, eta = eta_from(c, out);
  const Vector3d m = c.smooth() ? Vector3d{0, 0, 1} : sample_visible_normal(c.facets, out * side, u);
  return {m * side, eta, fresnel_dielectric(std::clamp(dot(out, m) * side, 0.0, 1.0), eta)};
}

// G₂/G₁ = G₂/(|out.z|·|in.z|)·|in.z|·σ(out).
double shadowing(const Coating& c, Vector3d out, Vector3d in) {
  if (c.smooth()) return 1;
  return shadowing_over_cosines(c.facets, out, in) * std::abs(in.z) *
         visible_area(c.facets, out.z > 0 ? out : -out);
}

std::optional<CoatingSample> reflect(const Coating& c, Vector3d out, const Facet& f) {
  const Vector3d in = f.normal * (2 * dot(out, f.normal)) - out;
  if (!(in.z * out.z > 0)) return std::nullopt;
  return CoatingSample{in, shadowing(c, out, in), c.smooth() ? 1 : coating_reflected_pdf(c, out, in)};
}

std::optional<CoatingSample> transmit(const Coating& c, Vector3d out, const Facet& f) {
  CoatingSample s{};
  if (!refract(out, f.normal, f.eta, s.in) || !(s.in.z * out.z < 0)) return std::nullopt;
  s.weight = shadowing(c, out, s.in) / (f.eta * f.eta);
  s.pdf = c.smooth() ? 1 : coating_transmitted_pdf(c, out, s.in);
  return s;
}

std::optional<CoatingSample> scaled(std::optional<CoatingSample> s, double factor) {
  if (!s || !(factor > 0) || !(s->pdf > 0)) return std::nullopt;
  s->weight *= factor;
  return s;
}

}  // namespace

CoatingHalf coating_half(const Coating& c, Vector3d out, Vector3d in) {
  CoatingHalf r;
  r.eta = eta_from(c, out);
  const bool reflects = out.z * in.z > 0;
  r.h = normalize(reflects ? out + in : out + in * r.eta);
  if (r.h.z < 0) r.h = -r.h;
  const double out_h = dot(out, r.h), in_h = dot(in, r.h);
  r.valid = r.h.z > 0 && out_h * out.z > 0 && in_h * in.z > 0;
  r.fresnel = fresnel_dielectric(std::min(1.0, std::abs(out_h)), r.eta);
  return r;
}

double coating_reflection(const Coating& c, Vector3d out, Vector3d in) {
  if (c.smooth()) return 0;
  const CoatingHalf half = coating_half(c, out, in);
  return half.valid
             ? half.fresnel * normal_density(c.facets, half.h) * shadowing_over_cosines(c.facets, out, in) / 4
             : 0;
}

double coating_transmission(const Coating& c, Vector3d out, Vector3d in) {
  if (c.smooth()) return 0;
  const CoatingHalf half = coating_half(c, out, in);
  const double out_h = dot(out, half.h), in_h = dot(in, half.h), sum = out_h + half.eta * in_h;
  if (!half.valid || sum == 0) return 0;
  return (1 - half.fresnel) * normal_density(c.facets, half.h) * shadowing_over_cosines(c.facets, out, in) *
         std::abs(out_h * in_h) / (sum * sum);
}

double coating_reflected_pdf(const Coating& c, Vector3d out, Vector3d in) {
  if (c.smooth()) return 0;
  const CoatingHalf half = coating_half(c, out, in);
  if (!half.valid) return 0;
  const double out_h = std::abs(dot(out, half.h));  // > 0 as it is valid
  return visible_normal_pdf(c.facets, out.z > 0 ? out : -out, half.h) / (4 * out_h);
}

double coating_transmitted_pdf(const Coating& c, Vector3d out, Vector3d in) {
  if (c.smooth()) return 0;
  const CoatingHalf half = coating_half(c, out, in);
  const double in_h = dot(in, half.h), sum = dot(out, half.h) + half.eta * in_h;
  if (!half.valid || sum == 0 || half.fresnel >= 1) return 0;
  return visible_normal_pdf(c.facets, out.z > 0 ? out : -out, half.h) * half.eta * half.eta * std::abs(in_h) /
         (sum * sum);
}

std::optional<CoatingSample> sample_coating_reflection(const Coating& c, Vector3d out, Point2f u) {
  if (out.z == 0) return std::nullopt;
  const Facet f = sample_facet(c, out, u);
  return scaled(reflect(c, out, f), f.fresnel);
}

std::optional<CoatingSample> sample_coating_transmission(const Coating& c, Vector3d out, Point2f u) {
  if (out.z == 0) return std::nullopt;
  const Facet f = sample_facet(c, out, u);
  return scaled(transmit(c, out, f), 1 - f.fresnel);
}

std::optional<CoatingSample> sample_coating(const Coating& c, Vector3d out, double u_lobe, Point2f u) {
  if (out.z == 0) return std::nullopt;
  const Facet f = sample_facet(c, out, u);
  return u_lobe < f.fresnel ? scaled(reflect(c, out, f), 1) : scaled(transmit(c, out, f), 1);
}

}  // namespace vitrail
