// SPDX-License-Identifier: Apache-2.0
// A bundle has Ptex as one image with a tile for every face, and where the corners of triangles lie in it.
#pragma once

#include <cstdint>
#include <memory>
#include <string>
#include <vector>

#include "partitioner/appearance/image_rows.h"
#include "scene/records/texture.h"

namespace vitrail {

struct PtexTiles {
  // A tile is in texels, from the upper left corner. A margin of one texel around it repeats its edge.
  struct Tile {
    std::uint32_t x = 0, y = 0, width = 1, height = 1;
  };
  std::uint32_t width = 0, height = 0;
  std::vector<Tile> tiles;  // by face; the last is black, for faces that the file does not have

  // Returns the (s,t) of a face's (u,v), which are clamped to [0,1].
  Point2f at(float face, Point2f uv) const;
};

struct PtexImage {
  ImageRows rows;  // colours, or numbers
  std::shared_ptr<const PtexTiles> tiles;
  std::string how;  // what of the texture it is
};

// Returns the finest level's texels as pbrt's filter shows them from near by: blended as stored by the cubic
// B-spline, then decoded. But a face's edge is repeated, where pbrt goes on to the next face. Files of
// triangles give the mean of each face. Throws Error, also in `rows`, for files that cannot be read.
PtexImage ptex_image(const PtexTexture& texture, bool numbers);

}  // namespace vitrail
