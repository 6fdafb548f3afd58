// SPDX-License-Identifier: Apache-2.0
#include "tracer/lights/baked_light_image.h"

#include "tracer/textures/baked_image.h"

namespace vitrail {

namespace {

class BakedLightImage final : public LightImage {
 public:
  BakedLightImage(const std::filesystem::path& file, std::shared_ptr<TileCache> tiles)
      : image_(file, std::move(tiles)) {}

  int width(int level) const override { return image_.width(level); }
  int height(int level) const override { return image_.height(level); }
  int levels() const override { return image_.levels(); }
  SampledSpectrum texel(int x, int y, const SampledWavelengths& wavelengths) const override {
    return image_.texel(x, y, 0, wavelengths);
  }
  SampledSpectrum bilinear(double s, double t, const SampledWavelengths& wavelengths) const override {
    return image_.bilinear(s, t, Wrap::repeat, 0, wavelengths);
  }
  double luminance(int x, int y, int level) const override { return image_.luminance(x, y, level); }
  const BakedImage* baked() const override { return &image_; }

 private:
  BakedImage image_;
};

}  // namespace

std::shared_ptr<const LightImage> open_light_image(const std::filesystem::path& file,
                                                   std::shared_ptr<TileCache> tiles) {
  return std::make_shared<BakedLightImage>(file, std::move(tiles));
}

}  // namespace vitrail
