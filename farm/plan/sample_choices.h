// SPDX-License-Identifier: Apache-2.0
// How a job samples the picture in place of what the scene says and what is usual. Films that were sampled in
// different ways do not merge, though most of them agree in the mean.
#pragma once

#include <optional>
#include <string>

#include "bundle/manifest.h"
#include "tracer/prepared/sampling_choices.h"

namespace vitrail {

// Of images, in place of each one's own.
enum class TextureChoice : std::uint8_t {
  unfiltered,  // no coarser than they are, however far away: between texels as each image says
  nearest      // the texel there
};

// Empty optionals: as the scene says.
struct SampleChoices {
  std::optional<Filter> filter;
  std::optional<TextureChoice> textures;
  SamplingChoices sampling;
};

// What differs from the usual, as options of `vitrail render`: "--filter box:0.5 --roulette early"; a filter
// with whatever shapes it. "" where nothing does.
std::string words_of(const SampleChoices& choices);

// Puts those of the picture and its images into the manifest. Where a picture may be another than without the
// choices, so is its scene_hash.
void apply(const SampleChoices& choices, Manifest& manifest);

}  // namespace vitrail
