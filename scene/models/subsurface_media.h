// SPDX-License-Identifier: Apache-2.0
// What is inside of a surface that light goes under: from what files say of it to coefficients of a medium.
#pragma once

#include <optional>

#include "scene/records/material.h"
#include "scene/records/medium.h"

namespace vitrail {

// Of the light that enters a half space from all around through a smooth boundary, the share that leaves it
// again. `albedo` of one scattering by Henyey and Greenstein's phase function of asymmetry `g`, −1 < g < 1;
// `eta`: index inside / outside. Radiative transfer in discrete ordinates, δ-M scaled (Wiscombe 1977), by
// doubling (van de Hulst 1963), with Fresnel's boundary from both sides; within 2·10⁻⁴.
double diffuse_reflectance(double albedo, double g, double eta);

// The medium whose diffuse_reflectance is `reflectance`, as pbrt's subsurface material means its parameters:
// σ_t is one over the mean free path; the albedo is the inverse, within 5·10⁻⁵ in reflectance.
ExtinctionAlbedo effective_coefficients(const Spectrum& reflectance, const Spectrum& mean_free_path, double g,
                                        double eta);

// The interior of the material; empty where a texture says it, or a name that measured_medium does not know.
std::optional<Medium> interior_of(const SubsurfaceMaterial& material);

}  // namespace vitrail
