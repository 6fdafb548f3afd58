// SPDX-License-Identifier: Apache-2.0
// A TextureRanges gives the range of textures in a part of a surface, for lights. Lights are chosen by a
// guess of what they send, and left out only where they certainly send nothing.
#pragma once

#include <cstdint>
#include <memory>
#include <span>
#include <unordered_map>
#include <vector>

#include "scene/geometry/bounds.h"
#include "tracer/textures/image_sums.h"
#include "tracer/textures/textures.h"

namespace vitrail {

// It holds boxes around points of a surface.
struct TextureRegion {
  TexturePoint middle;  // its attributes: of all of the triangle
  Interval u{1, 0}, v{1, 0};
  Bounds3d p;

  void extend(Point2d uv, Point3d at);
};

// It bounds by the rules of intervals. Means are exact for images, those of a box for checkerboards, and the
// value in the middle for what is computed from a point. Inputs count as if they were independent. It is not
// for many threads.
class TextureRanges {
 public:
  // Both have to outlive it. Null: all textures are black.
  TextureRanges(const Textures* textures, std::span<const Texture> records)
      : textures_(textures), records_(records) {}

  // Returns the range of luminances; `most` is 0 where nothing has any light, at any wavelength.
  ValueRange luminances(const SpectrumParameter& parameter, const TextureRegion& region);
  ValueRange numbers(const FloatParameter& parameter, const TextureRegion& region);

 private:
  struct Rules;
  struct Known {
    std::uint64_t region = 0;
    ValueRange range;
  };
  ValueRange of_texture(std::uint32_t id, const TextureRegion& region);
  double luminance_of(const Spectrum& constant);
  const ImageSums& sums_of(std::uint32_t id);

  const Textures* textures_;
  std::span<const Texture> records_;
  std::vector<Known> known_;  // of the textures, for the region of that number
  std::uint64_t region_ = 0;
  std::unordered_map<const Spectrum*, double> luminance_;
  std::unordered_map<const BakedImage*, std::unique_ptr<ImageSums>> sums_;
};

}  // namespace vitrail
