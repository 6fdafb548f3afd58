// SPDX-License-Identifier: Apache-2.0
// These are Mitsuba's plastics: a dielectric coat over a Lambertian base of reflectance ρ. T is the
// transmittance of the coat for each of the two directions, and r its mean reflectance for diffuse light from
// inside. The base adds f = ρ/(1 − r·(nonlinear ? ρ : 1))·T(out)·T(in)/(π·η²). Without `nonlinear`, light
// that is reflected back and forth keeps the base's colour.
#pragma once

#include <array>
#include <optional>

#include "tracer/bsdf/bsdf.h"
#include "tracer/bsdf/microfacet.h"

namespace vitrail {

// The coat is smooth: it reflects as a mirror, which eval and pdf leave out.
struct PlasticBsdf {
  SampledSpectrum diffuse_reflectance, specular_reflectance = filled(1);
  double eta = 1.49;                // index of the coat / of what is in front
  double internal_reflectance = 0;  // fresnel_diffuse(1/eta)
  bool nonlinear = false;
};

BsdfValue eval(const PlasticBsdf& bsdf, Vector3d out, Vector3d in);
double pdf(const PlasticBsdf& bsdf, Vector3d out, Vector3d in);
std::optional<BsdfSample> sample(const PlasticBsdf& bsdf, Vector3d out, float u_lobe, Point2f u);

// Returns π·f/T(in) of the base, seen at a cosine > 0.
SampledSpectrum base_of(const PlasticBsdf& bsdf, double cosine_out);

// The tables describe a material's rough coat. They are computed when the material is loaded.
struct RoughPlasticTables {
  static constexpr int count = 64;
  std::array<float, count> external_transmittance{};  // of light at cosine i/(count − 1)
  double internal_reflectance = 0;
};
// Makes the tables of facets that are not smooth. It takes about 4 ms.
RoughPlasticTables make_rough_plastic_tables(double eta, const Microfacets& microfacets);

// The coat reflects by microfacets, both widths the same.
struct RoughPlasticBsdf {
  SampledSpectrum diffuse_reflectance, specular_reflectance = filled(1);
  double eta = 1.49;
  Microfacets microfacets;
  const RoughPlasticTables* tables = nullptr;  // of the material; not null
  bool nonlinear = false;
};

BsdfValue eval(const RoughPlasticBsdf& bsdf, Vector3d out, Vector3d in);
double pdf(const RoughPlasticBsdf& bsdf, Vector3d out, Vector3d in);
std::optional<BsdfSample> sample(const RoughPlasticBsdf& bsdf, Vector3d out, float u_lobe, Point2f u);

}  // namespace vitrail
