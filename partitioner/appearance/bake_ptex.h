// SPDX-License-Identifier: Apache-2.0
// Ptex in a bundle: one image with a tile for every face, and where in it the corners of triangles lie.
#pragma once

#include <cstdint>
#include <memory>
#include <string>
#include <vector>

#include "partitioner/appearance/image_rows.h"
#include "scene/records/texture.h"

namespace vitrail {

struct PtexTiles {
  // In texels, from the upper left corner. Around it lies a margin of one texel that repeats its edge.
  struct Tile {
    std::uint32_t x = 0, y = 0, width = 1, height = 1;
  };
  std::uint32_t width = 0, height = 0;
  std::vector<Tile> tiles;  // by face; the last is black, for faces that the file does not have

  // The (s,t) of a face's (u,v), which are taken to [0,1].
  Point2f at(float face, Point2f uv) const;
};

struct PtexImage {
  ImageRows rows;  // colours, or numbers
  std::shared_ptr<const PtexTiles> tiles;
  std::string how;  // what of the texture it is
};

// The texels of the finest level as pbrt's filter shows them from near by: blended by the cubic B-spline as
// the file stores them, and then decoded; but that its edge is repeated, where pbrt goes on to the next face.
// Its files of triangles: the mean of each face. Throws Error, also in `rows`, for files that cannot be read.
PtexImage ptex_image(const PtexTexture& texture, bool numbers);

}  // namespace vitrail
