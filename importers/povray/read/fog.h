// SPDX-License-Identifier: Apache-2.0
// These functions read and evaluate fog {}.
#pragma once

#include <array>

#include "importers/povray/read/surface.h"

namespace vitrail::pov {

// Fog changes what is seen over a distance d to T·seen + (1 − T)·color with T = e^(−d/distance). Ground fog
// is as dense up to the height `offset` along `up`, and 1/(1 + ((y − offset)/alt)²) of that at a height y
// above it, as povray shows it (its documentation has another law).
struct Fog {
  Place place;
  bool ground = false;
  double distance = 0;  // 0: there is none
  Numbers color = Finish::grey(0);
  double offset = 0, alt = 0;
  Vector3d up{0, 1, 0};
  bool turbulent = false;
  double turb_depth = 0.5;
  int octaves = 6;
  double omega = 0.5;
};

Shared<Fog> read_fog_block(Reader& reader);

// Returns the factor of its density that makes it on the whole as dense as it is with its turbulence. As
// povray shows it, an optical depth x becomes x·(1 − s·e⁻ˣ), with s = min(turb_depth·turbulence, 1) at a
// point of the ray: thinner near the eye. The sums of noise have a mean of ½·Σ omegaⁱ.
double turbulent_share(const Fog& fog);

// Returns the mean density between two heights, low < high; 1 where `low` is −∞.
double mean_density(const Fog& fog, double low, double high);

// Returns the filter of its color: what is behind is multiplied by it, however near it is.
std::array<double, 3> filter_of(const Fog& fog);

// Fog that transmits t of what is behind weakens it to t, and no more: as if fog ended where e^(−depth) is t.
// That is a surface of revolution about `up` through the eye, as the depth to a point at the height y in the
// distance s is share·s·(C(y) − C(eye))/((y − eye)·distance), with C = ∫ density.
struct FogEdge {
  double low = 0, high = 0;  // heights; ±∞ where the fog does not end there
  const Fog& fog;
  double eye = 0;  // its height

  // Returns the distance from the axis, at a height between `low` and `high`; ∞ without `transmit`.
  double radius(double height) const;
};
FogEdge edge_of(const Fog& fog, double eye_height);

}  // namespace vitrail::pov
