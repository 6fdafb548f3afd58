// SPDX-License-Identifier: Apache-2.0
#include "importers/mitsuba/read/bsdf_models.h"
#include "importers/mitsuba/read/index_of_refraction.h"

namespace vitrail::mitsuba {

// "specular" s is another way to say eta: s·0.08 is the reflectance at normal incidence.
MaterialModel hair(Builder& b, const Object& o) {
  HairMaterial m;
  m.eta = index_of(b, o, "int_ior", "amber");
  m.exterior_eta = index_of(b, o, "ext_ior", "air");
  m.beta_m = float_parameter(b, o, "longitudinal_roughness", 0.3);
  m.beta_n = float_parameter(b, o, "azimuthal_roughness", 0.3);
  m.alpha_deg = float_parameter(b, o, "scale_tilt", 2);
  m.along_v = true;
  if (o.has("sigma_a")) {
    m.sigma_a = spectrum_parameter(b, o, "sigma_a", Quantity::unbounded, ConstantSpectrum{0});
    if (const double scale = o.number("scale", 1, b.report); scale != 1)
      m.sigma_a = times(b, *m.sigma_a, scale, o.origin);
    return m;
  }
  o.ignore({"scale"});
  m.eumelanin = float_parameter(b, o, "eumelanin", 1.3);
  m.pheomelanin = float_parameter(b, o, "pheomelanin", 0.2);
  for (auto* melanin : {&m.eumelanin, &m.pheomelanin})
    if (*melanin == FloatParameter{0.0f}) melanin->reset();
  if (!m.eumelanin && !m.pheomelanin) m.eumelanin = 0.0f;
  return m;
}

}  // namespace vitrail::mitsuba
