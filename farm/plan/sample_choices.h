// SPDX-License-Identifier: Apache-2.0
// A job may sample the picture in other ways than the scene says and than is usual. Films that were sampled
// in different ways do not merge, though most of them agree in the mean.
#pragma once

#include <optional>
#include <string>

#include "bundle/manifest.h"
#include "tracer/prepared/sampling_choices.h"

namespace vitrail {

// It is a filter of images, in place of each one's own.
enum class TextureChoice : std::uint8_t {
  unfiltered,  // no coarser than they are, however far away: between texels as each image says
  nearest      // the texel there
};

// An empty optional is as the scene says.
struct SampleChoices {
  std::optional<Filter> filter;
  std::optional<TextureChoice> textures;
  SamplingChoices sampling;
};

// Returns the choices that differ from the usual, as options of `vitrail render`: "--filter box:0.5
// --roulette early"; a filter with all that shapes it. It returns "" where nothing differs.
std::string words_of(const SampleChoices& choices);

// Puts the choices for the picture and its images into the manifest. Where a picture may be another than
// without the choices, so is its scene_hash.
void apply(const SampleChoices& choices, Manifest& manifest);

}  // namespace vitrail
