// SPDX-License-Identifier: Apache-2.0
#include "importers/writing/coat_albedo.h"

#include <algorithm>

#include "importers/writing/export_colors.h"
#include "scene/spectra/rgb_to_spectrum.h"

namespace vitrail {

double base_below_coat(double albedo, double eta, DiffuseAlbedo of) {
  if (!(eta > 1)) return std::clamp(albedo, 0.0, 1.0);
  const double inside = diffuse_fresnel_inside(eta);
  const double share = of == DiffuseAlbedo::of_all ? albedo / (1 - diffuse_fresnel_outside(eta)) : albedo;
  const double x = std::clamp(share, 0.0, 1.0);
  return x / (1 - inside + x * inside);
}

Spectrum base_below_coat(const Spectrum& albedo, double eta, DiffuseAlbedo of) {
  return changed_albedo(albedo, [&](double value) { return base_below_coat(value, eta, of); });
}

bool has_base(const PrincipledMaterial& m) {
  return m.metallic != FloatParameter{1.0f} && m.spec_trans != FloatParameter{1.0f};
}

Spectrum changed_albedo(const Spectrum& albedo, const std::function<double(double)>& change) {
  if (const auto* constant = std::get_if<ConstantSpectrum>(&albedo))
    return ConstantSpectrum{static_cast<float>(change(static_cast<double>(constant->value)))};
  if (is_rgb(albedo)) {
    const RGB color = factor_rgb(albedo);
    return reflectance_from_rgb({change(color.r), change(color.g), change(color.b)});
  }
  const Spectrum values = resolved(albedo);
  TabulatedSpectrum table;
  for (int i = 0; i < table_size; ++i)
    table.values.push_back(static_cast<float>(change(evaluate(values, lambda_min_nm + i))));
  return table;
}

}  // namespace vitrail
