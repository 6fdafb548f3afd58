// SPDX-License-Identifier: Apache-2.0
// The traced part of a year: films of coefficients, for each state of the glass.
#pragma once

#include "cli/year/year_arguments.h"
#include "farm/transport/transport.h"
#include "tracer/lights/environment.h"

namespace vitrail {

enum class CoefficientKind : std::uint8_t { sky, suns, beams };

// NAME.sky.film, NAME.sun.film and NAME.beam.film in the output's folder.
std::filesystem::path film_of(const YearArguments& arguments, const std::string& state, CoefficientKind kind);

// How the sky stands over the bundle.
struct SkyFrame {
  DirectionFrame frame;
  std::string words;  // where it comes from
};
// By --up and --north, else by the bundle's sky. Throws UsageError where they are along one axis.
SkyFrame sky_frame(const YearArguments& arguments, const Manifest& manifest);

// Traces on all ranks what is not there yet. `suns`: in the sky's frame. Throws Interrupted where a signal
// ended it, with a checkpoint.
void trace_coefficients(Transport& transport, const YearArguments& arguments, const SkyFrame& sky,
                        const std::vector<Vector3d>& suns);

}  // namespace vitrail
