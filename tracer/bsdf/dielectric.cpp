// SPDX-License-Identifier: Apache-2.0
#include "tracer/bsdf/dielectric.h"

#include "tracer/bsdf/dielectric_lanes.h"
#include "tracer/bsdf/local.h"

namespace vitrail {

namespace {

lanes::RoughDielectric<double> in_one_lane(const DielectricBsdf& bsdf) {
  return {bsdf.eta, lanes::fill(bsdf.microfacets), lanes::fill<float>(bsdf.reflectance_factor),
          lanes::fill<float>(bsdf.transmittance_factor)};
}

// Seen from above, where the index on the other side over that on this one is `eta`.
std::optional<BsdfSample> sample_smooth(const DielectricBsdf& bsdf, Vector3d out, double eta, float u_lobe) {
  const lanes::detail::Reflecting<double> choice = lanes::detail::reflecting(in_one_lane(bsdf), out.z, eta);
  if (!choice.some) return std::nullopt;
  if (static_cast<double>(u_lobe) < choice.probability)
    return BsdfSample{
        .in = mirror(out, {0, 0, 1}),
        .weight = bsdf.reflectance_factor * static_cast<float>(choice.reflectance / choice.probability),
        .specular = true};
  BsdfSample through{.specular = true};
  if (!refract(out, {0, 0, 1}, eta, through.in) || !(through.in.z < 0)) return std::nullopt;
  const auto transmittance = static_cast<float>((1 - choice.reflectance) / (1 - choice.probability));
  through.weight = bsdf.transmittance_factor * (transmittance / static_cast<float>(eta * eta));
  return through;
}

}  // namespace

BsdfValue eval(const DielectricBsdf& bsdf, Vector3d out, Vector3d in) {
  if (bsdf.microfacets.smooth() || goes_straight(bsdf.eta)) return {};
  return lanes::lane(lanes::eval(in_one_lane(bsdf), lanes::fill<double>(out), lanes::fill<double>(in)), 0);
}

double pdf(const DielectricBsdf& bsdf, Vector3d out, Vector3d in) { return eval(bsdf, out, in).pdf; }

std::optional<BsdfSample> sample(const DielectricBsdf& bsdf, Vector3d out, float u_lobe, Point2f u) {
  if (bsdf.microfacets.smooth()) {
    if (out.z > 0) return sample_smooth(bsdf, out, bsdf.eta, u_lobe);
    if (!(out.z < 0)) return std::nullopt;
    auto from_behind = sample_smooth(bsdf, {out.x, out.y, -out.z}, 1 / bsdf.eta, u_lobe);
    if (from_behind) from_behind->in.z = -from_behind->in.z;
    return from_behind;
  }
  if (out.z == 0) return std::nullopt;
  if (goes_straight(bsdf.eta))
    return BsdfSample{.in = -out, .weight = bsdf.transmittance_factor, .specular = true};
  return lanes::lane(lanes::sample(in_one_lane(bsdf), lanes::fill<double>(out), u_lobe, u.x, u.y), 0);
}

namespace {

// Of the sheet, at each wavelength, without its factor.
SampledSpectrum sheet_reflectance(const ThinDielectricBsdf& bsdf, double cosine, double q) {
  SampledSpectrum result;
  for (int i = 0; i < hero_count; ++i)
    result[i] = lanes::sheet_reflectance(cosine, static_cast<double>(bsdf.eta[i]), q);
  return result;
}

SampledSpectrum complement(const SampledSpectrum& s) { return filled(1) + s * -1.0f; }

}  // namespace

BsdfValue eval(const ThinDielectricBsdf&, Vector3d, Vector3d) { return {}; }

double pdf(const ThinDielectricBsdf&, Vector3d, Vector3d) { return 0; }

SampledSpectrum straight_transmittance(const ThinDielectricBsdf& bsdf, double cosine, double q) {
  return bsdf.transmittance_factor * complement(sheet_reflectance(bsdf, cosine, q));
}

SampledSpectrum mirrored_share(const ThinDielectricBsdf& bsdf, double cosine, double q) {
  return bsdf.reflectance_factor * sheet_reflectance(bsdf, cosine, q);
}

std::optional<BsdfSample> sample(const ThinDielectricBsdf& bsdf, Vector3d out, float u_lobe, Point2f) {
  const SampledSpectrum r = sheet_reflectance(bsdf, std::abs(out.z), 0);
  const SampledSpectrum reflected = bsdf.reflectance_factor * r;
  const SampledSpectrum transmitted = bsdf.transmittance_factor * complement(r);
  const double bright_r = carried(bsdf.throughput, reflected),
               bright_t = carried(bsdf.throughput, transmitted);
  if (!(bright_r + bright_t > 0)) return std::nullopt;
  const auto probability = static_cast<float>(attainable(bright_r / (bright_r + bright_t)));
  if (u_lobe < probability)
    return BsdfSample{
        .in = {-out.x, -out.y, out.z}, .weight = reflected * (1 / probability), .specular = true};
  return BsdfSample{.in = -out, .weight = transmitted * (1 / (1 - probability)), .specular = true};
}

}  // namespace vitrail
