// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "importers/povray/read/surface.h"

namespace vitrail::pov {

// Whether the word begins a pattern.
bool names_pattern(Word word);

// Reads the number behind `noise_generator`.
NoiseGenerator read_noise_generator(Reader& reader);

// The pattern that the word begins, which was just read, with what belongs directly to it. Entries of a list
// (checker, brick, hexagon) go to `map`.
void read_pattern(Reader& reader, Word word, Pattern& pattern, Shared<BlendMap>& map);

// A modifier (turbulence, frequency, a wave, a warp, a map, a transformation), if that is what comes.
bool read_pattern_modifier(Reader& reader, Pattern& pattern, Shared<BlendMap>& map, Transform& to_object);

// Behind image_map, bump_map, image_pattern.
ImageMap read_image_map(Reader& reader, double* bump_size = nullptr);

// `color_map` …: the kind of map that a word begins; none: none.
Word map_kind(Word word);

}  // namespace vitrail::pov
