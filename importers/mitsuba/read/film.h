// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "importers/mitsuba/read/builder.h"

namespace vitrail::mitsuba {

// Size, crop and reconstruction filter of a sensor's film; Mitsuba's defaults where it has none.
void read_film(Builder& builder, const Object& sensor);

// ---- film_bands.cpp
// The spectral bins that hold the light of a specfilm's bands: the bands themselves where those are equal
// intervals side by side, else intervals of at most 10 nm. What differs is reported.
void read_bands(Builder& builder, const Object& film);

}  // namespace vitrail::mitsuba
