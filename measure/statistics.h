// SPDX-License-Identifier: Apache-2.0
// These functions find noise and bias of a setting, from independent pictures and two halves of a reference.
#pragma once

#include <span>
#include <vector>

#include "scene/records/image.h"

namespace vitrail {

// An Estimate is a value with a confidence interval of 95 %, ± half of its width.
struct Estimate {
  double value = 0, half_width = 0;
};
// Returns the mean of independent values; half_width is infinite for one.
Estimate mean_of(std::span<const double> values);

// Returns the expectation of a bias, which is not below 0, after an estimate of it: the mean of the normal
// distribution about the estimate, above 0. A bias that was not seen counts by how well it would have been
// seen. So the setting whose bias came out least by chance is not the best of many.
double expected_bias(const Estimate& estimate);

// A Reference holds two pictures of independent seeds, and their mean.
struct Reference {
  Image first, second, mean;
  double white = 1;  // luminance that 1 % of its pixels exceed
  double mean_luminance = 1;
  // It is the relMSE of `mean`, estimated by how far the halves are apart: E[(a − b)²]/4.
  double relmse = 0;
};
Reference make_reference(Image first, Image second);

// ErrorStatistics set one picture of a setting against the truth. The reference's own error is taken
// out, because its halves' noises are independent: E[(x − r₁)(x − r₂)] = (E x − truth)² + Var x.
// relMSE is that of compare/metrics.h.
struct ErrorStatistics {
  Estimate relmse;  // of one picture: noise + bias
  Estimate noise;   // the part that more samples remove
  Estimate bias;    // the part that stays: of the pixels' means. May come out below 0 where it is none
  // It is the picture's mean over the reference's, − 1; where there are `unbiased` pictures, less theirs.
  // Then neither the reference's noise is in it, nor what paths that begin alike have in common.
  Estimate luminance;
  Estimate flip;            // HDR-FLIP, mean of the pixels
  Estimate delta_e;         // ΔE₀₀, mean of the pixels
  double flip_of_mean = 0;  // of the mean of the pictures: little noise, all bias
  bool is_biased() const { return bias.value > bias.half_width && bias.value > 0; }
};

// `pictures` are of the same setting and samples, of independent seeds; at least two. `unbiased` are pictures
// of the reference's own setting, of the same seeds and samples, or none. The noise that they share with
// `pictures`, whose paths begin alike, is then not in the bias: E[(xᵢ − uᵢ)(xⱼ − uⱼ)] = (E x − truth)². Where
// the `unbiased` are noisier than the reference, as where `pictures` cut their specks, the bias is against
// the reference: the narrower interval counts.
ErrorStatistics error_statistics(std::span<const Image> pictures, const Reference& reference,
                                 std::span<const Image> unbiased = {});

Image mean_picture(std::span<const Image> pictures);

}  // namespace vitrail
