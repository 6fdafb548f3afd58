// SPDX-License-Identifier: Apache-2.0
// This file samples free flight through a medium. Homogeneous media are sampled in closed form, by a
// wavelength chosen at random and weighted by the mean density of all. They are not sampled where they only
// absorb. Grids are sampled by null collisions (Woodcock et al. 1965; for spectra Kutz et al., "Spectral and
// Decomposition Tracking", 2017), with bounds of the extinction near each point of the flight (majorants.h).
// Transmittance is estimated by residual ratio tracking (Novák et al., "Residual Ratio Tracking for
// Estimating Attenuation in Participating Media", 2014). The least extinction of each cell counts in closed
// form, and chance decides on the rest alone. Wavelengths are chosen, and densities averaged, in proportion
// to the path's throughput. So its sum never grows, however many collisions there are. Where the albedo is
// the same at all wavelengths, a path is weighed by the mean density of all of it. That is as if one
// wavelength had been chosen for all of its flights.
#pragma once

#include <optional>
#include <vector>

#include "scene/records/medium.h"
#include "scene/spectra/sampled_spectrum.h"
#include "tracer/media/majorants.h"
#include "tracer/sampling/sampler.h"

namespace vitrail {

// It is a medium of a bundle made ready. Coefficients are in units of the scene's length.
struct PreparedMedium {
  const Medium* medium = nullptr;  // outlives it
  bool homogeneous = true;
  Transform to_medium;
  ExtinctionGrid extinction;  // of one that is not homogeneous; outside of its bounds there is nothing
  double g = 0;
};
PreparedMedium prepare(const Medium& medium);
std::vector<PreparedMedium> prepare(const std::vector<Medium>& media);

// It is the points p + t·d, 0 ≤ t ≤ t_max; d is unit, t_max may be ∞.
struct Flight {
  Point3d p;
  Vector3d d;
  double t_max;
};

struct FlightSample {
  std::optional<double> scattered_at;  // t; else it arrives at t_max
  SampledSpectrum weight;              // transmittance (and σ_s where it scatters) over pdf
  SampledSpectrum emitted;             // what the medium itself sends along the flight, weighted
};

// `active` is the number of wavelengths still carried; `throughput` is not black.
FlightSample sample_flight(const PreparedMedium& medium, const Flight& flight,
                           const SampledWavelengths& wavelengths, std::size_t active,
                           const SampledSpectrum& throughput, RandomStream& random);

// Returns an unbiased estimate of the transmittance over the flight.
SampledSpectrum transmittance(const PreparedMedium& medium, const Flight& flight,
                              const SampledWavelengths& wavelengths, RandomStream& random);

}  // namespace vitrail
