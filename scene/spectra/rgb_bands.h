// SPDX-License-Identifier: Apache-2.0
// These functions turn RGB into spectra that are constant in three bands, one for each number. The product of
// two such spectra has the product of their numbers. Light that goes from surface to surface so has the
// colours that programs without spectra give it (POV-Ray, Mitsuba's rgb variants, rasterisers).
#pragma once

#include "scene/spectra/color.h"
#include "scene/spectra/spectrum.h"

namespace vitrail {

// Blue is below 459 nm, green from 460 to 589 nm, red above 590 nm: about ¼, ½ and ¼ of the wavelengths that
// paths have (tracer/sampling/wavelengths.h), so that of four stratified ones one is blue, two are green and
// one is red. Between two bands tables go from one number to the other; films count nothing there.
inline constexpr int blue_ends_nm = 459, green_begins_nm = 460, green_ends_nm = 589, red_begins_nm = 590;

// Returns the component of a linear sRGB colour that a wavelength belongs to: 0 red, 1 green, 2 blue.
constexpr std::size_t band_of(float lambda_nm) {
  return lambda_nm < static_cast<float>(green_begins_nm) ? 2
         : lambda_nm < static_cast<float>(red_begins_nm) ? 1
                                                         : 0;
}

// Returns the linear sRGB colour c as a spectrum of bands; a grey is a constant. Negative components become
// 0.
Spectrum band_spectrum(RGB c);

// Returns a spectrum given as RGB in bands, by its numbers (light is without D65: white shines with 1 in each
// band). Constants stay as they are; light of a blackbody has its colour, and any other spectrum the colour
// that it has under D65.
Spectrum in_bands(const Spectrum& spectrum);

}  // namespace vitrail
