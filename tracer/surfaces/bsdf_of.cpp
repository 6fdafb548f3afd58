// SPDX-License-Identifier: Apache-2.0
#include "tracer/surfaces/bsdf_of.h"

#include <algorithm>

#include "scene/geometry/portable_math.h"
#include "scene/models/hair_color.h"
#include "scene/spectra/srgb_basis.h"
#include "tracer/sampling/wavelengths.h"

namespace vitrail {

namespace {

SampledSpectrum ratio(const SampledSpectrum& a, const SampledSpectrum& b) {
  SampledSpectrum r;
  for (std::size_t i = 0; i < hero_count; ++i) r.v[i] = b.v[i] > 0 ? a.v[i] / b.v[i] : a.v[i];
  return r;
}

}  // namespace

LoadedTable loaded_table(const ScatteringTable& table) {
  if (const auto* fourier = std::get_if<FourierTable>(&table))
    return LoadedFourier{fourier, integrals_of(*fourier)};
  const auto& adaptive = std::get<AdaptiveTable>(table);
  return LoadedAdaptive{&adaptive, warps_of(adaptive)};
}

bool has_tint(const PrincipledMaterial& m) {
  return m.spec_tint != FloatParameter{0.0f} || m.sheen_tint != FloatParameter{0.0f};
}

SampledSpectrum BsdfMaker::spectrum(const SpectrumParameter& p) const {
  return textures.spectrum(p, at, wavelengths);
}
double BsdfMaker::number(const FloatParameter& p) const { return textures.number(p, at); }

Microfacets BsdfMaker::microfacets(const Roughness& r) const { return microfacets(r, r.masking); }

Microfacets BsdfMaker::microfacets(const Roughness& r, Masking masking) const {
  const auto alpha = [&](const FloatParameter& p) {
    const double value = std::max(0.0, number(p));
    // Remapped textures give roughness; constants are α already.
    return r.square_root && std::holds_alternative<Id<Texture>>(p) ? std::sqrt(value) : value;
  };
  return make_microfacets(alpha(r.alpha_u), alpha(r.alpha_v), r.distribution, masking);
}

Bsdf BsdfMaker::operator()(const DiffuseMaterial& m) const {
  const double sigma = m.sigma_deg == FloatParameter{0.0f} ? 0 : number(m.sigma_deg);
  if (sigma > 0) return OrenNayarBsdf{spectrum(m.reflectance), sigma * pi / 180};
  return LambertBsdf{spectrum(m.reflectance)};
}

Bsdf BsdfMaker::operator()(const DielectricMaterial& m) const {
  const SampledSpectrum eta = ratio(evaluate(m.eta, wavelengths),
                                    evaluate(exterior_eta ? *exterior_eta : m.exterior_eta, wavelengths));
  return DielectricBsdf{static_cast<double>(eta[0]), microfacets(m.roughness), spectrum(m.reflectance_factor),
                        spectrum(m.transmittance_factor)};
}

ThinDielectricBsdf BsdfMaker::thin(const ThinDielectricMaterial& m) const {
  return {ratio(evaluate(m.eta, wavelengths), evaluate(m.exterior_eta, wavelengths)),
          spectrum(m.reflectance_factor), spectrum(m.transmittance_factor), throughput};
}

// Of a metal's reflectance r at normal incidence: η = 1, k = 2√(r/(1 − r)), r < 1.
ConductorBsdf BsdfMaker::metal(const Metal& metal) const {
  ConductorBsdf b;
  if (const auto* index = std::get_if<ComplexIndex>(&metal)) {
    b.eta = spectrum(index->eta);
    b.k = spectrum(index->k);
  } else if (const auto* normal = std::get_if<NormalReflectance>(&metal)) {
    b.eta = filled(1);
    const SampledSpectrum r = spectrum(normal->reflectance);
    for (std::size_t i = 0; i < hero_count; ++i) {
      const float below_one = std::clamp(r.v[i], 0.0f, 0.9999f);
      b.k.v[i] = 2 * std::sqrt(below_one / (1 - below_one));
    }
  } else {
    b.perfect = true;
  }
  return b;
}

Bsdf BsdfMaker::operator()(const ConductorMaterial& m) const {
  ConductorBsdf b = metal(m.metal);
  b.microfacets = microfacets(m.roughness);
  b.factor = spectrum(m.reflectance_factor);
  return b;
}

Bsdf BsdfMaker::operator()(const PlasticMaterial& m) const {
  const double eta = static_cast<double>(m.eta) / static_cast<double>(m.exterior_eta);
  if (m.roughness.alpha_u == FloatParameter{0.0f})
    return PlasticBsdf{spectrum(m.diffuse_reflectance), spectrum(m.specular_reflectance), eta,
                       plastic_tables->internal_reflectance, m.nonlinear};
  return RoughPlasticBsdf{spectrum(m.diffuse_reflectance),
                          spectrum(m.specular_reflectance),
                          eta,
                          microfacets(m.roughness),
                          plastic_tables,
                          m.nonlinear};
}

LayerVolume BsdfMaker::coating(const CoatingVolume& v) const {
  return {number(v.thickness), number(v.g), spectrum(v.albedo), v.max_depth, v.samples};
}

Bsdf BsdfMaker::operator()(const CoatedDiffuseMaterial& m) const {
  return CoatedDiffuseBsdf{spectrum(m.reflectance),
                           evaluate(m.eta, static_cast<double>(wavelengths.lambda_nm[0])),
                           microfacets(m.roughness, Masking::correlated), coating(m.volume), event};
}

Bsdf BsdfMaker::operator()(const CoatedConductorMaterial& m) const {
  const ConductorBsdf base = metal(m.metal);
  return CoatedConductorBsdf{base.eta,
                             base.k,
                             microfacets(m.conductor_roughness, Masking::correlated),
                             evaluate(m.interface_eta, static_cast<double>(wavelengths.lambda_nm[0])),
                             microfacets(m.interface_roughness, Masking::correlated),
                             coating(m.volume),
                             event};
}

Bsdf BsdfMaker::operator()(const DiffuseTransmissionMaterial& m) const {
  return DiffuseTransmissionBsdf{spectrum(m.reflectance) * m.scale, spectrum(m.transmittance) * m.scale};
}

Bsdf BsdfMaker::operator()(const TabulatedMaterial& m) const {
  const LoadedTable& loaded = tables[m.table.value];
  if (const auto* adaptive = std::get_if<LoadedAdaptive>(&loaded))
    return AdaptiveBsdf{adaptive->table, &adaptive->warps, wavelengths};
  const auto& fourier = std::get<LoadedFourier>(loaded);
  FourierBsdf b{fourier.table, &fourier.integrals, {}};
  for (std::size_t i = 0; i < hero_count; ++i) {
    const std::array<double, 3> rgb = srgb_basis(static_cast<double>(wavelengths.lambda_nm[i]));
    for (std::size_t c = 0; c < 3; ++c) b.primaries[c].v[i] = static_cast<float>(rgb[c]);
  }
  return b;
}

SlabBsdf BsdfMaker::slab(const SlabMaterial& m) const {
  const SampledSpectrum absorbed = spectrum(m.sigma_a), scattered = spectrum(m.sigma_s);
  const SampledSpectrum extinction = absorbed + scattered;
  SlabBsdf b{extinction * m.thickness, {}, static_cast<double>(m.g), throughput};
  for (std::size_t i = 0; i < hero_count; ++i)
    b.albedo.v[i] = extinction.v[i] > 0 ? scattered.v[i] / extinction.v[i] : 0;
  return b;
}

FinishBsdf BsdfMaker::finish(const FinishMaterial& m) const {
  const auto number = [](float x) { return static_cast<double>(x); };
  return {spectrum(m.reflectance), spectrum(m.highlight), number(m.brilliance), number(m.phong),
          number(m.phong_size),    number(m.specular),    number(m.roughness)};
}

Bsdf BsdfMaker::operator()(const GlazedMaterial& m) const {
  const auto number = [](float x) { return static_cast<double>(x); };
  return GlazedBsdf{finish(m.finish), spectrum(m.mirror_min), spectrum(m.mirror_max),
                    spectrum(m.tint), number(m.falloff),      number(m.metallic),
                    m.fresnel,        m.conserves_energy,     spectrum(m.through),
                    number(m.eta)};
}

// Tints are of the colour: they do not depend on the wavelengths that a path has.
double BsdfMaker::luminance_of(const PrincipledMaterial& m) const {
  if (!has_tint(m) || std::holds_alternative<Spectrum>(m.base_color)) return luminance;
  double sum = 0;
  for (const SampledWavelengths& fixed : luminance_wavelengths())
    for (const float x : textures.spectrum(m.base_color, at, fixed).v) sum += static_cast<double>(x);
  return sum / static_cast<double>(luminance_wavelengths().size() * hero_count);
}

Bsdf BsdfMaker::operator()(const PrincipledMaterial& m) const {
  const SampledSpectrum color = spectrum(m.base_color);
  const auto n = [&](const FloatParameter& p) { return number(p); };
  if (m.thin)
    return PrincipledThinBsdf{color,          luminance_of(m),  static_cast<double>(m.eta),
                              n(m.roughness), n(m.anisotropic), n(m.spec_trans),
                              n(m.spec_tint), n(m.sheen),       n(m.sheen_tint),
                              n(m.flatness),  n(m.diff_trans),  m.below};
  return PrincipledBsdf{color,
                        luminance_of(m),
                        static_cast<double>(m.eta),
                        n(m.roughness),
                        n(m.anisotropic),
                        n(m.metallic),
                        n(m.spec_trans),
                        n(m.spec_tint),
                        n(m.sheen),
                        n(m.sheen_tint),
                        n(m.flatness),
                        n(m.clearcoat),
                        n(m.clearcoat_gloss),
                        m.below};
}

SampledSpectrum BsdfMaker::absorption(const HairMaterial& m) const {
  if (m.sigma_a) return spectrum(*m.sigma_a);
  if (m.color) return hair_absorption(spectrum(*m.color), number(m.beta_n));
  static const Spectrum eumelanin = melanin_absorption(1, 0), pheomelanin = melanin_absorption(0, 1);
  const auto of = [&](const std::optional<FloatParameter>& amount, const Spectrum& pigment) {
    return evaluate(pigment, wavelengths) * static_cast<float>(amount ? std::max(0.0, number(*amount)) : 0);
  };
  return of(m.eumelanin, eumelanin) + of(m.pheomelanin, pheomelanin);
}

Bsdf BsdfMaker::operator()(const HairMaterial& m) const {
  return make_hair(absorption(m), throughput,
                   static_cast<double>(m.eta) / static_cast<double>(m.exterior_eta), number(m.beta_m),
                   number(m.beta_n), number(m.alpha_deg));
}

}  // namespace vitrail
