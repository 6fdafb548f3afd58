// SPDX-License-Identifier: Apache-2.0
// What every model of scattering has to obey, whatever it is a model of.
#pragma once

#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "tracer/bsdf/bsdf.h"

namespace vitrail::laws {

// A model with its parameters, its type forgotten.
struct Subject {
  std::function<BsdfValue(Vector3d out, Vector3d in)> eval;
  std::function<double(Vector3d out, Vector3d in)> pdf;
  std::function<std::optional<BsdfSample>(Vector3d out, float u_lobe, Point2f u)> sample;
  bool two_sides = false;  // whether it is asked for directions below the surface too
  double eta = 1;          // index of refraction behind the surface / in front of it
};

template <class Model>
Subject subject(const Model& model, bool two_sides = false, double eta = 1) {
  return {[model](Vector3d out, Vector3d in) { return eval(model, out, in); },
          [model](Vector3d out, Vector3d in) { return pdf(model, out, in); },
          [model](Vector3d out, float u_lobe, Point2f u) { return sample(model, out, u_lobe, u); }, two_sides,
          eta};
}

struct Tolerances {
  double energy = 1e-4;       // of the albedo above 1
  double reciprocity = 1e-4;  // relative
  double consistency = 1e-3;  // relative, of a sample's weight and pdf against eval and pdf
  double density = 4e-3;      // absolute, of the integral of the pdf
  bool reciprocal = true;     // false: not asked for
  int samples = 10000;        // a direction; without VITRAIL_LONG_TESTS half of them
};

// Unit directions at cosines 1 to cos 89.99° on azimuths off the axes, as seen from above.
std::vector<Vector3d> incidences();

// The mean of a sample's weight: what part of the light from a uniform white surrounding, or of what comes
// from `out`, is scattered on. Across the interface the weight is without the 1/η² of radiance: energy.
struct Albedo {
  double mean = 0;            // of the brightest wavelength
  double standard_error = 0;  // of the mean
  double lost = 0;            // part of the samples that `sample` gave up
  double specular = 0;        // part of them that were deltas
};
Albedo albedo(const Subject& subject, Vector3d out, int samples = 20000);

// ∫ pdf(out, in) d in over the sphere.
double integrated_pdf(const Subject& subject, Vector3d out);

// Expects of one direction: every sample and value finite and not negative; albedo ≤ 1; samples that agree
// with eval and pdf; f(out, in)/η_out² the same with the directions exchanged (Veach 1997, Eq. 5.30); a pdf
// that integrates to what `sample` does not give up or send into deltas; and the directions of samples
// distributed by it (χ² over cells that follow the samples, at a level of 1 % for 1000 directions together:
// Šidák 1967).
void expect_laws(const Subject& subject, Vector3d out, const Tolerances& tolerances = {});

// … at each of incidences(), and from below too where the model has two sides. `name` is for the messages.
void expect_laws(const Subject& subject, const std::string& name, const Tolerances& tolerances = {});

// Expects finite, non-negative answers where directions graze the surface, coincide or oppose each other, and
// where random numbers are at the ends of [0, 1).
void expect_finite_at_extremes(const Subject& subject, const std::string& name);

}  // namespace vitrail::laws
