// SPDX-License-Identifier: Apache-2.0
// A writer puts these images beside its scene, where its format would take other values from the images of
// the Scene.
#pragma once

#include <filesystem>
#include <functional>
#include <map>
#include <tuple>

#include "images/texture_values.h"
#include "scene/records/scene.h"

namespace vitrail {

// An ImageChange says what else is done to the values of a texture.
struct ImageChange {
  RGB tint{1, 1, 1};  // multiplies them
  UvMapping mapping;  // at (s,t) is what the texture has at mapping(s,t): turned, mirrored, repeated
  bool three_channels = false;  // also for greys
  // It multiplies by cosⁿθ of the angle from the axis at which a point of the axis sees each texel. The image
  // is ±half.x, ±half.y wide and high at distance 1, with at least 512 texels along its longer side. n = 0:
  // nothing.
  int cosine_power = 0;
  Point2d half;
  // It multiplies by this light's falloff, over the square frame of its cutoff, of at least 512 × 512 texels.
  const SpotLight* spot = nullptr;
};

// Returns the half width and height, at distance 1, of the image that a light throws: `aspect` is its width ÷
// height.
Point2d half_size(const ProjectionLight& light, double aspect);
// Returns (s,t) → outer(inner(s,t)).
UvMapping composed(const UvMapping& outer, const UvMapping& inner);

// It is an image times a colour. The product of the two becomes one, and so does a product of such products.
struct TintedImage {
  ImageTexture image;
  bool is_number = false;  // which the colour multiplies
  RGB tint{1, 1, 1};
};
std::optional<TintedImage> tinted_image(const Scene& scene, const ProductTexture& product);
std::optional<TintedImage> tinted_image(const Scene& scene, Id<Texture> texture);

// It holds two images that a product multiplies where they lie on each other: of one mapping, wrap and
// filter.
struct ImagePair {
  TintedImage first, second;
};
std::optional<ImagePair> image_pair(const Scene& scene, const ProductTexture& product);

// It writes the linear values of textures as EXR files. Equal ones are written once.
class ConvertedImages {
 public:
  // `new_file` gives the path of the next file.
  explicit ConvertedImages(std::function<std::filesystem::path()> new_file)
      : new_file_(std::move(new_file)) {}

  // Throws Error where the texture's image cannot be read, and MachineError.
  std::filesystem::path write(const ImageTexture& texture, ImageUse use, const ImageChange& change = {});
  // Writes their product, texel by texel of the finer one, along each side.
  std::filesystem::path write(const ImagePair& pair);

  // Returns the path of a new image of the writer's own.
  std::filesystem::path new_file() const { return new_file_(); }

 private:
  using Numbers = std::array<float, 17>;
  using Key = std::tuple<std::string, Encoding, ImageNumber, Primaries, Wrap, TextureFilter, ImageUse, bool,
                         bool, Numbers>;
  static Key key_of(const ImageTexture& texture, ImageUse use, const ImageChange& change);

  std::function<std::filesystem::path()> new_file_;
  std::map<Key, std::filesystem::path> written_;
};

// Multiplies an image of three channels, or of one.
void multiply(Image& image, RGB tint);
// Multiplies by cosⁿθ of each texel's middle, as ImageChange has it.
void multiply_by_cosine(Image& image, int power, Point2d half);
// Returns ∫ Y dω of a thrown image of colours, cos³θ times the intensity, over ±half at distance 1: dω =
// cos³θ dA.
double thrown_flux(const Image& image, Point2d half);
// Returns a grey image as one of colours; others as they are.
Image with_three_channels(Image image);

}  // namespace vitrail
