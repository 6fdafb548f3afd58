// SPDX-License-Identifier: Apache-2.0
// These functions serve scattering at a surface. Directions point away from the surface, in the local frame
// whose +z is the shading normal.
#pragma once

#include "scene/geometry/frame.h"
#include "scene/spectra/sampled_spectrum.h"

namespace vitrail {

// Returns a cosine-weighted direction on the upper hemisphere, pdf cosθ/π: Shirley & Chiu's (1997) disk
// lifted up.
Vector3d sample_cosine_hemisphere(float u, float v);

// Returns the probability nearest to p that a number u of 24 bits in [0,1) lies below; it is above 0 and
// below 1 where p is. Weights by its inverse are exact, while those by p are wrong by up to 2⁻²⁴/p.
double attainable(double p);

// Returns the unpolarised reflectance of a smooth interface, 1 under total internal reflection. cosine ≥ 0 is
// on the side of incidence, eta = index behind / index in front (Born & Wolf, §1.5.2).
double fresnel_dielectric(double cosine, double eta);

// Refracts by Snell's law, for `out` (unit, away from the surface) on the side of the unit normal. Returns
// false under total internal reflection. eta is as above.
bool refract(Vector3d out, Vector3d normal, double eta, Vector3d& refracted);

}  // namespace vitrail
