// SPDX-License-Identifier: Apache-2.0
// A sample map says where a picture's further samples do most good.
#pragma once

#include <cstdint>
#include <vector>

#include "film/film.h"

namespace vitrail {

// Returns whether all pixels have the same number of samples.
bool is_even(const Film& film);

// Deals out `samples` more among the pixels so that the relative squared error of the picture becomes least.
// A pixel's share of all samples goes as the relative standard deviation of a sample there. That is taken
// from the pixels around it and never from its own. A pixel that stopped where it happens to be dark would be
// too dark. It is found once, of a film that is even. Later the neighbours of a pixel would have numbers of
// samples that its own had a part in. In another film all pixels' numbers grow in proportion.
//
// A pixel has an even number of samples then, 2ᵏ or 3·2ᵏ, one of the two about its share. The sum is
// `samples` at most, and less by a few. Every pixel comes to a quarter of the mean of all samples, none
// beyond 16 times that.
//
// The result is a pure function of the film, the same on every machine.
std::vector<std::uint32_t> more_samples(const Film& film, std::uint64_t samples);

}  // namespace vitrail
