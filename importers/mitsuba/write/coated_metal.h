// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>

#include "importers/mitsuba/write/write_context.h"

namespace vitrail::mitsuba_writer {

// Returns the ratio of diffuse light that a metal reflects below a smooth clear coat of index `eta`, and
// alone, by wavelength. It is at most 1, as Mitsuba's factor is. Returns nothing where the metal's index is
// not one for all of the surface.
std::optional<Spectrum> coated_share(Context& context, const Metal& metal, const Spectrum& eta);

}  // namespace vitrail::mitsuba_writer
