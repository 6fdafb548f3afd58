// SPDX-License-Identifier: Apache-2.0
#include "tracer/bsdf/diffuse.h"

#include "scene/geometry/portable_math.h"
#include "tracer/bsdf/diffuse_lanes.h"
#include "tracer/bsdf/local.h"

namespace vitrail {

namespace {

lanes::Lambert<double> in_one_lane(const LambertBsdf& bsdf) { return {lanes::fill<float>(bsdf.reflectance)}; }

bool reflects(Vector3d out, Vector3d in) { return out.z > 0 && in.z > 0; }

// f/reflectance·π of Oren and Nayar, and the greatest albedo it leads to.
struct Grooves {
  double a, b;
  explicit Grooves(double sigma) {
    const double s2 = sigma * sigma;
    a = 1 - s2 / (2 * (s2 + 0.33));
    b = 0.45 * s2 / (s2 + 0.09);
  }
  double greatest_albedo() const { return a + b / 2; }
  double factor(Vector3d out, Vector3d in) const {
    // max(0, cosΔφ)·sinα·tanβ = max(0, out.xy·in.xy)/max(cosθ_o, cosθ_i)
    return a + b * std::max(0.0, out.x * in.x + out.y * in.y) / std::max(out.z, in.z);
  }
};

SampledSpectrum limited_reflectance(const OrenNayarBsdf& bsdf, const Grooves& grooves) {
  const float limit = static_cast<float>(1 / std::max(1.0, grooves.greatest_albedo()));
  SampledSpectrum reflectance = bsdf.reflectance;
  for (float& r : reflectance.v) r = std::min(r, limit);
  return reflectance;
}

// Of reflection, in proportion to the brighter of the two sides' colours; 0 where both are black.
double reflection_probability(const DiffuseTransmissionBsdf& bsdf) {
  const double r = static_cast<double>(max_value(bsdf.reflectance));
  const double t = static_cast<double>(max_value(bsdf.transmittance));
  return r + t > 0 ? r / (r + t) : 0;
}

}  // namespace

BsdfValue eval(const LambertBsdf& bsdf, Vector3d out, Vector3d in) {
  return lanes::lane(lanes::eval(in_one_lane(bsdf), lanes::fill<double>(out), lanes::fill<double>(in)), 0);
}

double pdf(const LambertBsdf&, Vector3d out, Vector3d in) { return reflects(out, in) ? in.z / pi : 0; }

std::optional<BsdfSample> sample(const LambertBsdf& bsdf, Vector3d out, float, Point2f u) {
  return lanes::lane(lanes::sample(in_one_lane(bsdf), lanes::fill<double>(out), u.x, u.y), 0);
}

BsdfValue eval(const OrenNayarBsdf& bsdf, Vector3d out, Vector3d in) {
  if (!reflects(out, in)) return {};
  const Grooves grooves(bsdf.sigma_rad);
  const double density = in.z / pi;
  return {limited_reflectance(bsdf, grooves) * static_cast<float>(grooves.factor(out, in) * density),
          density};
}

double pdf(const OrenNayarBsdf&, Vector3d out, Vector3d in) { return reflects(out, in) ? in.z / pi : 0; }

std::optional<BsdfSample> sample(const OrenNayarBsdf& bsdf, Vector3d out, float, Point2f u) {
  const Vector3d in = sample_cosine_hemisphere(u.x, u.y);
  if (!reflects(out, in)) return std::nullopt;
  const Grooves grooves(bsdf.sigma_rad);
  return BsdfSample{
      .in = in,
      .weight = limited_reflectance(bsdf, grooves) * static_cast<float>(grooves.factor(out, in)),
      .pdf = in.z / pi};
}

BsdfValue eval(const DiffuseTransmissionBsdf& bsdf, Vector3d out, Vector3d in) {
  if (out.z == 0 || in.z == 0) return {};
  const SampledSpectrum& side = out.z * in.z > 0 ? bsdf.reflectance : bsdf.transmittance;
  return {side * static_cast<float>(std::abs(in.z) / pi), pdf(bsdf, out, in)};
}

double pdf(const DiffuseTransmissionBsdf& bsdf, Vector3d out, Vector3d in) {
  if (out.z == 0 || in.z == 0 || is_black(bsdf.reflectance + bsdf.transmittance)) return 0;
  const double reflection = reflection_probability(bsdf);
  return (out.z * in.z > 0 ? reflection : 1 - reflection) * std::abs(in.z) / pi;
}

std::optional<BsdfSample> sample(const DiffuseTransmissionBsdf& bsdf, Vector3d out, float u_lobe, Point2f u) {
  const double reflection = reflection_probability(bsdf);
  const bool reflected = static_cast<double>(u_lobe) < reflection;
  const double probability = reflected ? reflection : 1 - reflection;
  Vector3d in = sample_cosine_hemisphere(u.x, u.y);
  if (out.z == 0 || in.z == 0 || is_black(bsdf.reflectance + bsdf.transmittance)) return std::nullopt;
  const double density = probability * in.z / pi;
  if (reflected != (out.z > 0)) in.z = -in.z;
  const SampledSpectrum& side = reflected ? bsdf.reflectance : bsdf.transmittance;
  return BsdfSample{.in = in, .weight = side * static_cast<float>(1 / probability), .pdf = density};
}

}  // namespace vitrail
