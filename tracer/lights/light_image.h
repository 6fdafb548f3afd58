// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <memory>

#include "scene/spectra/sampled_spectrum.h"

namespace vitrail {

class BakedImage;
class TileCache;

// Lights read an image by this interface. Texel (0,0) is the lower left one. Level 0 is the finest; each next
// one has half the width and height, rounded down.
class LightImage {
 public:
  virtual ~LightImage() = default;
  virtual int width(int level) const = 0;
  virtual int height(int level) const = 0;
  virtual int levels() const = 0;
  virtual SampledSpectrum texel(int x, int y, const SampledWavelengths& wavelengths) const = 0;
  // Interpolates between the centres of four texels of level 0: it repeats in s, and keeps t within the
  // outermost centres.
  virtual SampledSpectrum bilinear(double s, double t, const SampledWavelengths& wavelengths) const = 0;
  // Returns about the Y of a texel.
  virtual double luminance(int x, int y, int level) const = 0;
  // Returns the image itself where lanes may read it, else null.
  virtual const BakedImage* baked() const { return nullptr; }
};

}  // namespace vitrail
