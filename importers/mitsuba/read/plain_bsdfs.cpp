// SPDX-License-Identifier: Apache-2.0
// BSDFs of one surface or one sheet, smooth and rough.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "importers/mitsuba/read/bsdf_models.h"
#include "importers/mitsuba/read/index_of_refraction.h"
#include "importers/spectra/greatest_value.h"

namespace vitrail::mitsuba {

namespace {

Spectrum index_spectrum(Builder& b, const Object& o, const char* name, const char* otherwise) {
  return ConstantSpectrum{index_of(b, o, name, otherwise)};
}

}  // namespace

MaterialModel diffuse(Builder& b, const Object& o) {
  return DiffuseMaterial{reflectance(b, o, "reflectance", 0.5)};
}

// 0.6's Oren-Nayar: its alpha is the slope's deviation; √2·σ there.
MaterialModel rough_diffuse(Builder& b, const Object& o) {
  DiffuseMaterial m{reflectance(b, o, "reflectance", 0.5)};
  const FloatParameter alpha = float_parameter(b, o, "alpha", 0.2);
  o.ignore({"use_fast_approx"});
  constexpr double degrees = 180 / 3.14159265358979323846;
  if (const auto* value = std::get_if<float>(&alpha))
    m.sigma_deg = static_cast<float>(std::atan(static_cast<double>(*value) / std::sqrt(2.0)) * degrees);
  else
    b.report.approximated("the texture of its roughness is left out", o.origin);
  return m;
}

MaterialModel dielectric(Builder& b, const Object& o) {
  DielectricMaterial m;
  m.eta = index_spectrum(b, o, "int_ior", "bk7");
  m.exterior_eta = index_spectrum(b, o, "ext_ior", "air");
  if (o.type == "roughdielectric") m.roughness = roughness_of(b, o);
  m.reflectance_factor = factor(b, o, "specular_reflectance");
  m.transmittance_factor = factor(b, o, "specular_transmittance");
  m.priority = o.integer("priority", 0, b.report);
  return m;
}

MaterialModel thin_dielectric(Builder& b, const Object& o) {
  if (o.has("glazing")) {
    o.ignore({"int_ior", "ext_ior", "specular_reflectance", "specular_transmittance"});
    return glazing_system(b, o, o.text("glazing", "", b.report));
  }
  ThinDielectricMaterial m;
  m.eta = index_spectrum(b, o, "int_ior", "bk7");
  m.exterior_eta = index_spectrum(b, o, "ext_ior", "air");
  m.reflectance_factor = factor(b, o, "specular_reflectance");
  m.transmittance_factor = factor(b, o, "specular_transmittance");
  return m;
}

MaterialModel plastic(Builder& b, const Object& o) {
  PlasticMaterial m;
  m.diffuse_reflectance = reflectance(b, o, "diffuse_reflectance", 0.5);
  m.specular_reflectance = factor(b, o, "specular_reflectance");
  m.eta = index_of(b, o, "int_ior", "polypropylene");
  m.exterior_eta = index_of(b, o, "ext_ior", "air");
  m.nonlinear = o.boolean("nonlinear", false, b.report);
  if (o.type != "plastic") m.roughness = roughness_of(b, o);
  if (o.type == "pplastic")
    b.report.approximated("a polarising plastic becomes the one that does not polarise", o.origin);
  return m;
}

// 0.6's sums of a Lambertian part and a gloss that is no Fresnel reflection: a blend of the two, each divided
// by its share, with the microfacets of a perfect mirror for the gloss. An exponent n of the cosine is about
// α = √(2/(n+2)); Ward's α is Beckmann's.
MaterialModel phong(Builder& b, const Object& o) {
  b.report.approximated(fmt::format("the gloss of \"{}\" becomes that of microfacets as wide", o.type),
                        o.origin);
  const SpectrumParameter kd = reflectance(b, o, "diffuse_reflectance", 0.5),
                          ks = reflectance(b, o, "specular_reflectance", 0.2);
  ConductorMaterial gloss{PerfectReflector{}, {}, {}};
  gloss.roughness.distribution = Roughness::Distribution::beckmann;
  if (o.type == "ward") {
    gloss.roughness.alpha_u = float_parameter(b, o, "alpha_u", 0.1);
    gloss.roughness.alpha_v = float_parameter(b, o, "alpha_v", 0.1);
    o.ignore({"variant"});
  } else {
    const FloatParameter exponent = float_parameter(b, o, "exponent", 30);
    const double n =
        std::holds_alternative<float>(exponent) ? static_cast<double>(std::get<float>(exponent)) : 30;
    gloss.roughness.alpha_u = gloss.roughness.alpha_v =
        static_cast<float>(std::sqrt(2 / (std::max(n, 0.0) + 2)));
  }
  constexpr double least = 0.05;
  const double share = std::clamp(greatest_value(ks), least, std::max(least, 1 - greatest_value(kd)));
  gloss.reflectance_factor = times(b, ks, 1 / share, o.origin);
  Material base{DiffuseMaterial{times(b, kd, 1 / (1 - share), o.origin)}}, coat{std::move(gloss)};
  base.two_sided = coat.two_sided = false;
  base.origin = coat.origin = o.origin;
  const Id<Material> first = append(b, std::move(base)), second = append(b, std::move(coat));
  return BlendMaterial{first, second, static_cast<float>(share)};
}

MaterialModel diffuse_transmitter(Builder& b, const Object& o) {
  return DiffuseTransmissionMaterial{ConstantSpectrum{0}, reflectance(b, o, "transmittance", 0.5), 1};
}

MaterialModel nothing(Builder&, const Object&) { return InterfaceMaterial{}; }

MaterialModel polarizing(Builder& b, const Object& o) {
  b.report.dropped(fmt::format("\"{}\": light has no polarisation here, and passes it unchanged", o.type),
                   o.origin);
  for (const Property& p : o.properties) o.find(p.name);
  return InterfaceMaterial{};
}

}  // namespace vitrail::mitsuba
