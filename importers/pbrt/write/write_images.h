// SPDX-License-Identifier: Apache-2.0
// Images are written as pbrt-v4 takes them: of the Scene's own file where that gives the same values, else of
// a new one.
#pragma once

#include "importers/pbrt/write/writer.h"

namespace vitrail::pbrt {

// Returns the image of an "imagemap": the texture itself, or one whose file has its values, in colours times
// `tint`.
ImageTexture image_for_pbrt(Parameters& p, const ImageTexture& image, ImageUse use, RGB tint = {1, 1, 1});

// Returns the file for a light or a normal map, which name a file alone and look it up by the uv.
// Returns nothing where the texture is no image. `besides` is done to it, its mapping before the
// texture's own.
std::optional<std::string> file_for_pbrt(Parameters& p, Id<Texture> texture, ImageUse use,
                                         const ImageChange& besides = {});

// Returns the image of the light's brightness in all directions.
std::string goniometric_for_pbrt(Parameters& p, const GoniometricLight& light);

// Returns the image of a light around the scene, in pbrt's projection, times `tint`.
std::string environment_for_pbrt(Parameters& p, const EnvironmentLight& light, RGB tint);

}  // namespace vitrail::pbrt
