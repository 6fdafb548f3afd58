// SPDX-License-Identifier: Apache-2.0
// Closed forms of unpolarised light through parallel faces: the mean of s and p, each by itself.
#pragma once

#include "tracer/bsdf/local_lanes.h"

namespace vitrail::test {

// Reflectance of a smooth face; as fresnel_dielectric.
using Fresnel = double (*)(double cosine, double eta);

// The mean over both of `value(fresnel)`, in which all faces have `fresnel`.
template <class F>
double over_polarisations(F&& value) {
  const Fresnel s = [](double cosine, double eta) { return lanes::fresnel_polarized(cosine, eta).s; };
  const Fresnel p = [](double cosine, double eta) { return lanes::fresnel_polarized(cosine, eta).p; };
  return (value(s) + value(p)) / 2;
}

}  // namespace vitrail::test
