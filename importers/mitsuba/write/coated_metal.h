// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>

#include "importers/mitsuba/write/write_context.h"

namespace vitrail::mitsuba_writer {

// What a metal below a smooth clear coat of index `eta` reflects ÷ what it reflects alone, of diffuse light,
// by wavelength: at most 1, as Mitsuba's factor is. Nothing where the metal's index is not one for all of the
// surface.
std::optional<Spectrum> coated_share(Context& context, const Metal& metal, const Spectrum& eta);

}  // namespace vitrail::mitsuba_writer
