// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <cmath>

#include "importers/mitsuba/material_parts.h"
#include "importers/mitsuba/read/bsdf_models.h"
#include "importers/mitsuba/read/properties.h"
#include "importers/mitsuba/read/values.h"

namespace vitrail::mitsuba {

namespace {

float principled_eta(Builder& b, const Object& o) {
  if (!o.has("specular")) return static_cast<float>(o.number("eta", 1.5, b.report));
  const double specular = std::clamp(o.number("specular", 0.5, b.report), 1e-3, 12.0);
  return static_cast<float>(2 / (1 - std::sqrt(0.08 * specular)) - 1);
}

}  // namespace

MaterialModel principled(Builder& b, const Object& o) {
  PrincipledMaterial m;
  m.thin = o.type == "principledthin";
  m.base_color = spectrum_parameter(b, o, "base_color", Quantity::reflectance, ConstantSpectrum{0.5f});
  m.roughness = float_parameter(b, o, "roughness", 0.5);
  m.anisotropic = float_parameter(b, o, "anisotropic", 0);
  m.spec_trans = float_parameter(b, o, "spec_trans", 0);
  m.spec_tint = float_parameter(b, o, "spec_tint", 0);
  m.sheen = float_parameter(b, o, "sheen", 0);
  m.sheen_tint = float_parameter(b, o, "sheen_tint", 0);
  m.flatness = float_parameter(b, o, "flatness", 0);
  m.eta = principled_eta(b, o);
  if (m.thin) {
    m.diff_trans = float_parameter(b, o, "diff_trans", 0);
  } else {
    m.metallic = float_parameter(b, o, "metallic", 0);
    m.clearcoat = float_parameter(b, o, "clearcoat", 0);
    m.clearcoat_gloss = float_parameter(b, o, "clearcoat_gloss", 0);
  }
  if (is_tinted(m))
    b.report.approximated(
        "tints of the base colour are by its luminance; Mitsuba's spectral variants take that of each "
        "sample's few "
        "wavelengths",
        o.origin);
  o.ignore({"diffuse_reflectance_sampling_rate", "specular_reflectance_sampling_rate",
            "main_specular_sampling_rate", "clearcoat_sampling_rate", "specular_transmittance_sampling_rate",
            "diffuse_sampling_rate", "spec_refl_sampling_rate", "spec_trans_sampling_rate",
            "diff_trans_sampling_rate", "diff_refl_sampling_rate"});
  return m;
}

}  // namespace vitrail::mitsuba
