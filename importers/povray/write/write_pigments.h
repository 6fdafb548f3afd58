// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <vector>

#include "importers/povray/write/context.h"

namespace vitrail::povray {

// It has colours that vary: a pigment, times `factor` (which POV-Ray's finishes have to apply), times the
// `filters`: pigments that let light through, for layers above it.
struct Pigment {
  std::string text;
  double factor = 1;
  std::vector<std::string> filters;
  bool is_constant = false;
  RGB constant;  // where it is
};

enum class Colors { factors, emissions };

// Returns the colours of a parameter; diagnostics with the place `user` say what is not exact.
Pigment pigment_of(Context& context, const SpectrumParameter& parameter, const Origin& user,
                   Colors colors = Colors::factors);

// It is a pattern of values from 0 to 1 ("uv_mapping image_pattern { … }", with its transform after the
// maps). pattern_of returns nothing where POV-Ray has none for it.
struct Pattern {
  std::string text, transform;
};
std::optional<Pattern> pattern_of(Context& context, Id<Texture> texture, const Origin& user);

// Returns `image_map`'s own words for a file: `png "name" gamma srgb`. It is a new file where POV-Ray would
// see something else in the texture's own: through its alpha, grey as a colour's number, unread kinds. Scale
// and inversion are not in it. Returns nothing, with a note, where the image cannot be read.
std::optional<std::string> image_of(Context& context, const ImageTexture& texture, ImageUse use,
                                    const Origin& origin);

// Returns whether uvs are needed to show the texture, or any that it refers to.
bool uses_uvs(const Scene& scene, Id<Texture> texture);

// Returns the value, or the mean of a texture, which is noted.
double constant_of(Context& context, const FloatParameter& parameter, const char* what, const Origin& user);

}  // namespace vitrail::povray
