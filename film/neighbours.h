// SPDX-License-Identifier: Apache-2.0
// Samples that splat add to several pixels, so the noise of neighbours is alike. An estimate over many pixels
// is then known less well than one over as many independent ones.
#pragma once

#include <span>
#include <string>

namespace vitrail {

// ρ(Δ) is the correlation of pixels that are Δ apart; the sums are over all Δ in whole pixels.
struct Neighbours {
  double of_mean = 1;       // Σ ρ: the variance of a mean over pixels, over that of independent ones
  double of_variances = 1;  // Σ ρ²: the same of a mean of their estimated variances
  bool operator==(const Neighbours&) const = default;
};

// Returns both sums for samples that lie evenly, along an axis: `correlations` are ∫f(x) f(x + Δ)
// dx of their filter, for Δ = 0, 1, …
Neighbours along_axis(std::span<const double> correlations);

// Returns both sums for the two axes of a separable filter.
Neighbours product(const Neighbours& x, const Neighbours& y);

// Returns what a film says of itself (FilmProgress::about). Pixels are independent where it says nothing.
Neighbours neighbours_of(const std::string& about);

}  // namespace vitrail
