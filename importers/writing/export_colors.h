// SPDX-License-Identifier: Apache-2.0
// These functions turn spectra into linear sRGB, for formats of three numbers a colour. Most want no negative
// components.
#pragma once

#include <optional>
#include <string>

#include "scene/records/scene.h"
#include "scene/spectra/color.h"

namespace vitrail {

// Returns the colour of a radiance, intensity or irradiance, without negative components.
RGB emission_rgb(const Spectrum& emission);
// Returns the same with negative components, where it lies outside of sRGB. Example: a line of 650 nm is 1.5,
// −.28, −.01 of its luminance by blue and green that it takes away.
RGB signed_emission_rgb(const Spectrum& emission);
// Returns the colour of a reflectance or factor under D65.
RGB factor_rgb(const Spectrum& factor);
// Returns whether rgb gives the spectrum back: it was made of one, or is constant.
bool is_rgb(const Spectrum& spectrum);

// Returns the table by the samples that were read, if a program that looks at them at whole nanometres alone,
// as pbrt does for lights, finds the light that they have (within a part in a thousand); else by its values.
TabulatedSpectrum as_seen_at_whole_nm(const TabulatedSpectrum& table);

// Returns the digits that a sample needs: a table's own values are floats.
std::string digits_of(const TabulatedSpectrum& table, double sample);

// Returns the index of refraction at the d line of helium, 587.6 nm.
double index_of_refraction(const Spectrum& eta);
// Returns n(400 nm) / n(700 nm); 1 without dispersion.
double dispersion_ratio(const Spectrum& eta);

// Returns the reflectance of a metal at normal incidence, of light from vacuum. A textured index or
// reflectance counts as 0.5.
RGB normal_reflectance_rgb(const Metal& metal);

// They are the colours that a measured sheet reflects and lets through at normal incidence.
struct SheetColors {
  RGB reflected, transmitted;
};
SheetColors colors_at_normal(const MeasuredSheet& sheet);

// Returns the mean of noise over space, by sampling: marble's at its defaults.
RGB mean_of_noise(const NoiseTexture& noise);

// Returns the mean of a pattern over a cube of 16 units around its origin, or over (u,v) from 0 to 1, by
// sampling. Textures in its map count as 0.5.
RGB mean_of_pattern(const PatternTexture& pattern);
// Returns a pattern that is nothing but a checkerboard, of cubes or of squares in (u,v), as one.
std::optional<CheckerboardTexture> as_checkerboard(const PatternTexture& pattern);

// Returns the mean of the values that meshes have by that name, where there are any, times its scale. It
// reads meshes that are left in their files.
std::optional<RGB> mean_of_attribute(const Scene& scene, const MeshAttributeTexture& texture);

// They return the mean reflectance of a smooth interface of relative index eta for diffuse light from
// outside, and from inside (integrals of Fresnel's equations over the hemisphere).
double diffuse_fresnel_outside(double eta);
double diffuse_fresnel_inside(double eta);

}  // namespace vitrail
