// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "importers/mitsuba/read/builder.h"

namespace vitrail::mitsuba {

// Reads size, crop and reconstruction filter of a sensor's film; takes Mitsuba's defaults where it has none.
void read_film(Builder& builder, const Object& sensor);

// ---- film_bands.cpp
// Makes the spectral bins that hold the light of a specfilm's bands: the bands themselves where those are
// equal intervals side by side, else intervals of at most 10 nm. Differences are reported.
void read_bands(Builder& builder, const Object& film);

}  // namespace vitrail::mitsuba
