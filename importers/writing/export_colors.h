// SPDX-License-Identifier: Apache-2.0
// What formats of three numbers a colour can say of spectra: linear sRGB. Most want no negative components.
#pragma once

#include <optional>
#include <string>

#include "scene/records/scene.h"
#include "scene/spectra/color.h"

namespace vitrail {

// The colour of a radiance, intensity or irradiance, without negative components.
RGB emission_rgb(const Spectrum& emission);
// The same with those, where it lies outside of sRGB. Example: a line of 650 nm is 1.5, −.28, −.01 of its
// luminance by blue and green that it takes away.
RGB signed_emission_rgb(const Spectrum& emission);
// The colour of a reflectance or factor under D65.
RGB factor_rgb(const Spectrum& factor);
// Whether rgb gives the spectrum back: it was made of one, or is constant.
bool is_rgb(const Spectrum& spectrum);

// The table by the samples that were read, where whoever looks at them at whole nanometres alone, as pbrt
// does of lights, finds the light that they have (within a part in a thousand); else by its values.
TabulatedSpectrum as_seen_at_whole_nm(const TabulatedSpectrum& table);

// The digits that a sample needs: a table's own values are floats.
std::string digits_of(const TabulatedSpectrum& table, double sample);

// The index of refraction at the d line of helium, 587.6 nm.
double index_of_refraction(const Spectrum& eta);
// n(400 nm) / n(700 nm); 1 without dispersion.
double dispersion_ratio(const Spectrum& eta);

// The reflectance of a metal at normal incidence, of light from vacuum. A textured index or reflectance
// counts as 0.5.
RGB normal_reflectance_rgb(const Metal& metal);

// What a measured sheet reflects and lets through at normal incidence.
struct SheetColors {
  RGB reflected, transmitted;
};
SheetColors colors_at_normal(const MeasuredSheet& sheet);

// The mean of noise over space, by sampling: marble's at its defaults.
RGB mean_of_noise(const NoiseTexture& noise);

// The mean of a pattern over a cube of 16 units around its origin, or over (u,v) from 0 to 1, by sampling.
// Textures in its map count as 0.5.
RGB mean_of_pattern(const PatternTexture& pattern);
// A pattern that is nothing but a checkerboard, of cubes or of squares in (u,v).
std::optional<CheckerboardTexture> as_checkerboard(const PatternTexture& pattern);

// The mean of the values that meshes have by that name, where there are any, times its scale. Meshes that are
// left in their files are read for it.
std::optional<RGB> mean_of_attribute(const Scene& scene, const MeshAttributeTexture& texture);

// The mean reflectance of a smooth interface of relative index eta for diffuse light from outside, and from
// inside (integrals of Fresnel's equations over the hemisphere).
double diffuse_fresnel_outside(double eta);
double diffuse_fresnel_inside(double eta);

}  // namespace vitrail
