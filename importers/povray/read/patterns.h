// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "importers/povray/read/surface.h"

namespace vitrail::pov {

// Returns whether the word begins a pattern.
bool names_pattern(Word word);

// Reads the number behind `noise_generator`.
NoiseGenerator read_noise_generator(Reader& reader);

// Reads the pattern that the word begins, which was just read, with what belongs directly to it. Entries of a
// list (checker, brick, hexagon) go to `map`.
void read_pattern(Reader& reader, Word word, Pattern& pattern, Shared<BlendMap>& map);

// Reads a modifier (turbulence, frequency, a wave, a warp, a map, a transformation), if one comes.
bool read_pattern_modifier(Reader& reader, Pattern& pattern, Shared<BlendMap>& map, Transform& to_object);

// Reads behind image_map, bump_map, image_pattern.
ImageMap read_image_map(Reader& reader, double* bump_size = nullptr);

// Returns the kind of map that a word such as `color_map` begins, or none.
Word map_kind(Word word);

}  // namespace vitrail::pov
