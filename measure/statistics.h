// SPDX-License-Identifier: Apache-2.0
// Noise and bias of a setting, from a few independent pictures of it and two halves of a reference.
#pragma once

#include <span>
#include <vector>

#include "scene/records/image.h"

namespace vitrail {

// With a confidence interval of 95 %, ± half of its width.
struct Estimate {
  double value = 0, half_width = 0;
};
// Of independent values; half_width is infinite for one.
Estimate mean_of(std::span<const double> values);

// What a bias, which is not below 0, is expected to be after an estimate of it: the mean of the normal
// distribution about the estimate, above 0. One that was not seen counts by how well it would have been seen,
// so that of many settings the one whose bias came out least by chance is not the best.
double expected_bias(const Estimate& estimate);

// Two pictures of independent seeds.
struct Reference {
  Image first, second, mean;
  double white = 1;  // luminance that 1 % of its pixels exceed
  double mean_luminance = 1;
  // relMSE of `mean`, estimated by how far the halves are apart: E[(a − b)²]/4.
  double relmse = 0;
};
Reference make_reference(Image first, Image second);

// Of one picture of a setting, against the truth: what the reference itself is off is taken out, because its
// halves' noises are independent: E[(x − r₁)(x − r₂)] = (E x − truth)² + Var x. relMSE is that of
// compare/metrics.h.
struct ErrorStatistics {
  Estimate relmse;  // of one picture: noise + bias
  Estimate noise;   // the part that more samples remove
  Estimate bias;    // the part that stays: of the pixels' means. May come out below 0 where it is none
  // Mean of the picture over the reference's, − 1; where there are `unbiased` pictures, less theirs: neither
  // the reference's noise nor what paths that begin alike have in common is in it.
  Estimate luminance;
  Estimate flip;            // HDR-FLIP, mean of the pixels
  Estimate delta_e;         // ΔE₀₀, mean of the pixels
  double flip_of_mean = 0;  // of the mean of the pictures: little noise, all bias
  bool is_biased() const { return bias.value > bias.half_width && bias.value > 0; }
};

// `pictures`: of the same setting and samples, of independent seeds; at least two. `unbiased`: pictures of
// the reference's own setting, of the same seeds and samples, or none. The noise that they share with
// `pictures`, whose paths begin alike, is then not in the bias: E[(xᵢ − uᵢ)(xⱼ − uⱼ)] = (E x − truth)². Where
// these are noisier than the reference, as those are whose specks `pictures` cut, the bias is against the
// reference: the narrower interval counts.
ErrorStatistics error_statistics(std::span<const Image> pictures, const Reference& reference,
                                 std::span<const Image> unbiased = {});

Image mean_picture(std::span<const Image> pictures);

}  // namespace vitrail
