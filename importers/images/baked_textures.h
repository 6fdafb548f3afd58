// SPDX-License-Identifier: Apache-2.0
// A format may have no kind for mixes, products, checkerboards and the like. Where they are functions of
// (u,v) alone, they become images.
#pragma once

#include <filesystem>
#include <functional>
#include <map>
#include <optional>
#include <string>

#include "scene/records/scene.h"

namespace vitrail {

// It is a texture as an image of linear values, or of 8 bits in a .png. It is without smoothing where the
// texture has edges alone.
struct BakedTexture {
  ImageTexture image;
  std::string note;  // what is not quite as it was: "texture "t" (mix): an image of 512 × 512 texels"
};

class BakedTextures {
 public:
  // `new_file` gives the path of the next image, which ends in .exr or .png.
  BakedTextures(const Scene& scene, std::function<std::filesystem::path()> new_file)
      : scene_(scene), new_file_(std::move(new_file)) {}

  // The image covers what repeats of the texture, up to 16 units of (u,v); what does not repeat, from 0 to 1.
  // Texels are as fine as the finest image of the texture, at least 512 and at most 4096 along each side.
  // Cells of checkerboards begin and end with a texel where they begin at 0. Returns nothing where the
  // texture depends on more than (u,v), or an image of it cannot be read. Throws MachineError.
  const BakedTexture* bake(Id<Texture> texture);

 private:
  const Scene& scene_;
  std::function<std::filesystem::path()> new_file_;
  std::map<std::uint32_t, std::optional<BakedTexture>> baked_;
};

}  // namespace vitrail
