// SPDX-License-Identifier: Apache-2.0
// Year jobs are the traced part of a year: films of coefficients, for each state of the glass.
#pragma once

#include "cli/year/year_arguments.h"
#include "farm/transport/transport.h"
#include "tracer/lights/environment.h"

namespace vitrail {

enum class CoefficientKind : std::uint8_t { sky, reflected, beams, sunlight };

// Returns NAME.sky.film, .reflected.film, .beam.film or .sunlight-DAY-ABOVE.film in the output's folder.
std::filesystem::path film_of(const YearArguments& arguments, const std::string& state, CoefficientKind kind);

// A SkyFrame says how the sky stands over the bundle.
struct SkyFrame {
  DirectionFrame frame;
  std::string words;  // where it comes from
};
// Goes by --up and --north, else by the bundle's sky. Throws UsageError where they are along one axis.
SkyFrame sky_frame(const YearArguments& arguments, const Manifest& manifest);

// Returns whether some of those films are there, or were begun.
bool has_films(const YearArguments& arguments);

// TracedSuns are the suns that are traced, in the sky's frame: those of the hours, in all states, and
// those of a day's minutes, in one.
struct TracedSuns {
  std::vector<Vector3d> hours, minutes;
  std::size_t state_of_minutes = 0;
};

// Traces on all ranks the films that are not there yet, with a share, in (0, 1], of the paths. Throws
// Interrupted where a signal ended it, with a checkpoint.
void trace_coefficients(Transport& transport, const YearArguments& arguments, const SkyFrame& sky,
                        const TracedSuns& suns, double share);

}  // namespace vitrail
