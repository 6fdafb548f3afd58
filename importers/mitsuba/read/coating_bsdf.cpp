// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "importers/mitsuba/read/bsdf_leaves.h"
#include "importers/mitsuba/read/bsdf_models.h"
#include "importers/mitsuba/read/index_of_refraction.h"

namespace vitrail::mitsuba {

namespace {

// What light that falls from everywhere, cosine μ, leaves of itself on its way down through a layer of
// optical depth τ and index η and up again: the square of 2∫exp(−τ/μ′)μ dμ, μ′² = 1 − (1 − μ²)/η².
Spectrum absorbed_twice(const Spectrum& sigma_a, double thickness, double eta) {
  const Spectrum depth = resolved(sigma_a);
  const auto share = [&](double tau) {
    constexpr int steps = 64;
    double sum = 0;
    for (int i = 0; i < steps; ++i) {
      const double mu = (i + 0.5) / steps, below = std::sqrt(std::max(1 - (1 - mu * mu) / (eta * eta), 1e-4));
      sum += 2 * mu / steps * std::exp(-tau / below);
    }
    return sum * sum;
  };
  if (is_constant(depth))
    return ConstantSpectrum{static_cast<float>(share(thickness * evaluate(depth, lambda_min_nm)))};
  TabulatedSpectrum table;
  for (double nm = lambda_min_nm; nm <= lambda_max_nm; ++nm)
    table.values.push_back(static_cast<float>(share(thickness * evaluate(depth, nm))));
  return table;
}

// 0.6's coat knows no light that goes back and forth below it: over a Lambertian base of reflectance ρ it is
// a plastic of ρ·(1 − r), as that one divides by 1 − r for such light.
}  // namespace

Material coated(Builder& b, const Object& o) {
  Material material = inner_material(b, o);
  PlasticMaterial coat;
  coat.eta = index_of(b, o, "int_ior", "bk7");
  coat.exterior_eta = index_of(b, o, "ext_ior", "air");
  coat.specular_reflectance = factor(b, o, "specular_reflectance");
  if (o.type == "roughcoating") coat.roughness = roughness_of(b, o);
  const double eta = static_cast<double>(coat.eta) / static_cast<double>(coat.exterior_eta);
  const double left = 1 - internal_reflectance(eta);
  const Spectrum sigma_a = spectrum_value(b, o, "sigma_a", Quantity::unbounded, ConstantSpectrum{0});
  const Spectrum kept = absorbed_twice(sigma_a, o.number("thickness", 1, b.report), eta);
  bool is_exact = true;
  change_leaves(b, material, [&](Material& leaf) {
    const auto* base = std::get_if<DiffuseMaterial>(&leaf.model);
    is_exact = is_exact && base && base->sigma_deg == FloatParameter{0.0f};
    if (auto* metal = std::get_if<ConductorMaterial>(&leaf.model))
      metal->reflectance_factor = times(b, metal->reflectance_factor, kept, o.origin);
    if (!base) return;
    PlasticMaterial plastic = coat;
    plastic.diffuse_reflectance =
        times(b, base->reflectance, product(kept, ConstantSpectrum{static_cast<float>(left)}), o.origin);
    leaf.model = plastic;
  });
  if (!is_exact)
    b.report.approximated("a coating of what is not Lambertian: the surface under it shows", o.origin);
  if (kept != Spectrum{ConstantSpectrum{1}})
    b.report.approximated(
        fmt::format("what a coating absorbs is that of diffuse light at every angle: {:.3g} of it "
                    "are left",
                    luminance(product(kept, NamedSpectrum{"stdillum-D65"})) /
                        luminance(NamedSpectrum{"stdillum-D65"})),
        o.origin);
  return material;
}

}  // namespace vitrail::mitsuba
