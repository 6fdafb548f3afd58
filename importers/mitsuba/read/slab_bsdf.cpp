// SPDX-License-Identifier: Apache-2.0
#include <algorithm>

#include "importers/mitsuba/read/bsdf_models.h"
#include "importers/mitsuba/read/properties.h"
#include "importers/mitsuba/read/subsurface.h"
#include "importers/mitsuba/read/values.h"

namespace vitrail::mitsuba {

MaterialModel slab(Builder& b, const Object& o) {
  SlabMaterial m;
  if (o.has("sigma_t") || o.has("albedo")) {
    if (!o.has("sigma_t") || !o.has("albedo"))
      b.report.fail("\"sigmaT\" and \"albedo\" go together", o.origin);
    const Spectrum sigma_t = spectrum_value(b, o, "sigma_t", Quantity::unbounded, ConstantSpectrum{1}),
                   albedo = spectrum_value(b, o, "albedo", Quantity::reflectance, ConstantSpectrum{1});
    m.sigma_s = product(sigma_t, albedo);
    m.sigma_a = weighted_sum(sigma_t, 1, product(sigma_t, albedo), -1);
  } else {
    const AbsorptionScattering c = measured_coefficients(b, o);
    m.sigma_a = spectrum_parameter(b, o, "sigma_a", Quantity::unbounded, std::get<Spectrum>(c.sigma_a));
    m.sigma_s = spectrum_parameter(b, o, "sigma_s", Quantity::unbounded, std::get<Spectrum>(c.sigma_s));
  }
  const double thickness = o.number("thickness", 1, b.report);
  if (!(thickness >= 0)) b.report.fail("a slab has a negative \"thickness\"", place_of(o, "thickness"));
  m.thickness = static_cast<float>(std::min(thickness, 1e10));
  m.g = read_phase(o, b.report);
  return m;
}

}  // namespace vitrail::mitsuba
