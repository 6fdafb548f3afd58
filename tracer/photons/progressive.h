// SPDX-License-Identifier: Apache-2.0
// This is progressive photon mapping whose iterations know nothing of each other: Knaus and Zwicker,
// "Progressive Photon Mapping: A Probabilistic Approach" (2011). The radius is a function of the iteration's
// number alone.
#pragma once

#include <cstdint>

#include "bundle/manifest.h"
#include "film/film.h"

namespace vitrail {

// Returns the radius: r²ᵢ₊₁/r²ᵢ = (i + α)/(i + 1), i from 1 (ibid., eq. 15); `iteration` counts from 0.
double radius_of(const PhotonKey& photons, std::uint32_t iteration);

// Returns as many photons as the picture has pixels, at least 2¹⁶.
std::uint64_t default_photons(const FilmSettings& film);
// Returns a radius that holds about ten of so many photons, spread over a square of the scene's extent.
double default_radius(const Manifest& manifest, std::uint64_t photons);

}  // namespace vitrail
