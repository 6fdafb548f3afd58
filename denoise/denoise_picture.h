// SPDX-License-Identifier: Apache-2.0
// This file removes the noise of a picture by a network's estimate.
#pragma once

#include "denoise/denoiser.h"
#include "film/develop.h"

namespace vitrail {

// Returns the albedo and the normals (of shading, else of the surface) among the picture's layers.
DenoiserGuides guides_of(const Picture& picture);

// Denoises the colours, and each bin of the spectra as a grey picture, all by the picture's own guides. The
// origin names the denoiser. Variances and errors no longer hold, and are left out; layers stay. Do it before
// anything else: noise that was mapped to a screen is not what the network knows.
void denoise(Picture& picture, const Denoiser& denoiser);

}  // namespace vitrail
