// SPDX-License-Identifier: Apache-2.0
// This model is a fibre of hair. It follows Chiang, Bitterli, Tappan & Burley, "A Practical and Controllable
// Hair and Fur Model for Production Path Tracing", 2016 (after Marschner et al. 2003 and d'Eon et al. 2011).
#pragma once

#include <optional>

#include "tracer/bsdf/bsdf.h"

namespace vitrail {

// It is a rough dielectric cylinder of radius 1 that absorbs, with scales. In the local frame x is along the
// fibre, towards its tip, and z is the cylinder's normal. The two give the place across the fibre's width
// where `out` meets it. One event stands for all that happens within: light leaves to all sides, from where
// it came in.
//   f·|cos θ_in| = Σ_p M_p(θ_out, θ_in)·A_p(out)·N_p(φ_in − φ_out),
// p = 0 is reflected, 1 goes through, 2 is reflected once within, 3 is all that is reflected more often. θ
// are angles from the plane across the fibre, φ those within it. It is not reciprocal: A_p depends on `out`.
struct HairBsdf {
  SampledSpectrum sigma_a;     // absorption over the radius
  SampledSpectrum throughput;  // of the path: what lobes are chosen by
  double eta = 1.55;
  double variance = 0;                  // v of M_0
  double spread = 0;                    // s of N_p: the scale of a logistic distribution, rad
  double sin_alpha = 0, cos_alpha = 1;  // of the scales' tilt
};

// Makes a fibre. Roughnesses along and around it are held within [0.01, 1].
HairBsdf make_hair(const SampledSpectrum& sigma_a, const SampledSpectrum& throughput, double eta,
                   double beta_m, double beta_n, double alpha_deg);

// Returns the absorption that gives the colour to a fibre of this azimuthal roughness among others of its
// kind (scene/models/hair_color.h).
SampledSpectrum hair_absorption(const SampledSpectrum& color, double beta_n);

BsdfValue eval(const HairBsdf& bsdf, Vector3d out, Vector3d in);
double pdf(const HairBsdf& bsdf, Vector3d out, Vector3d in);
std::optional<BsdfSample> sample(const HairBsdf& bsdf, Vector3d out, float u_lobe, Point2f u);

// Returns e⁻ˣ·I₀(x), x ≥ 0, with the modified Bessel function I₀, to 3e-7 of its value.
double scaled_bessel_i0(double x);

}  // namespace vitrail
