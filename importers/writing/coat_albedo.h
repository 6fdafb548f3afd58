// SPDX-License-Identifier: Apache-2.0
// These functions turn diffuse bases under a smooth coat into bases of the same albedo in another model.
#pragma once

#include <functional>

#include "scene/records/material.h"
#include "scene/spectra/spectrum.h"

namespace vitrail {

// It says what the diffuse albedo of a model without such a coat is. It is the share ρ that comes out again
// of the light that gets in (Mitsuba's linear plastic, glTF's dielectric), or ρ of all light (the principled
// model, whose gloss is added to it).
enum class DiffuseAlbedo { of_what_gets_in, of_all };

// Returns the reflectance of a base below which light goes back and forth, as below pbrt's coateddiffuse and
// Mitsuba's nonlinear plastic. With the mean reflectances F_out and F_in of the coat for diffuse light, (1 −
// F_out)(1 − F_in) ρ'/(1 − ρ' F_in) is the albedo that is wanted. It is at most 1.
double base_below_coat(double albedo, double eta, DiffuseAlbedo of);
// Returns the same at every wavelength, or of its colour.
Spectrum base_below_coat(const Spectrum& albedo, double eta, DiffuseAlbedo of);

// Returns whether some of it may be diffuse.
bool has_base(const PrincipledMaterial& m);

// Returns the albedo with each of its values changed so, at every wavelength, or of its colour.
Spectrum changed_albedo(const Spectrum& albedo, const std::function<double(double)>& change);

}  // namespace vitrail
