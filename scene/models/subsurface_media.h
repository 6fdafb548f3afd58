// SPDX-License-Identifier: Apache-2.0
// These functions turn a file's description of the inside of a surface that light goes under into
// coefficients of a medium.
#pragma once

#include <optional>

#include "scene/records/material.h"
#include "scene/records/medium.h"

namespace vitrail {

// Returns the share of light that leaves a half space again, when light enters it from all around through a
// smooth boundary. `albedo` is that of one scattering by Henyey and Greenstein's phase function of asymmetry
// `g`, −1 < g < 1; `eta` is the index inside / outside. It solves radiative transfer in discrete ordinates,
// δ-M scaled (Wiscombe 1977), by doubling (van de Hulst 1963), with Fresnel's boundary from both sides;
// within 2·10⁻⁴.
double diffuse_reflectance(double albedo, double g, double eta);

// Returns the medium whose diffuse_reflectance is `reflectance`, as pbrt's subsurface material means its
// parameters: σ_t is one over the mean free path; the albedo is the inverse, within 5·10⁻⁵ in reflectance.
ExtinctionAlbedo effective_coefficients(const Spectrum& reflectance, const Spectrum& mean_free_path, double g,
                                        double eta);

// Returns the interior of the material. It returns nothing where a texture says it, or a name that
// measured_medium does not know.
std::optional<Medium> interior_of(const SubsurfaceMaterial& material);

}  // namespace vitrail
