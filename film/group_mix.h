// SPDX-License-Identifier: Apache-2.0
// A group mix is the picture under other weights of its lights, of a film that keeps groups of them apart.
#pragma once

#include <span>
#include <string>
#include <vector>

#include "film/develop.h"

namespace vitrail {

// A GroupWeight is what the light of a group is multiplied by, in linear sRGB.
struct GroupWeight {
  std::string group;  // "*": all of them
  RGB factor{1, 1, 1};
};

// Reads "day=1,lamps=.2,spot=1:.8:.5": a number or red:green:blue each. Throws UsageError.
std::vector<GroupWeight> parse_group_weights(const std::string& text);

// Returns the sum of the groups' means in linear sRGB, each times its factor: the last one given counts, else
// 1. Throws Error where the film keeps no such group, with those that it keeps.
Image mixed_groups(const Film& film, std::span<const GroupWeight> weights);

// Returns the channels "Light.NAME.R", "….G" and "….B" of each group, whose sums are the picture's
// colours but for rounding to floats.
std::vector<PictureChannel> group_channels(const Film& film);

}  // namespace vitrail
