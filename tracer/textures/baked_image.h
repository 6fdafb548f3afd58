// SPDX-License-Identifier: Apache-2.0
// A BakedImage looks up one baked image by (s,t): (0,0) is its lower left corner, (1,1) the upper right one.
#pragma once

#include <array>
#include <cstdint>
#include <filesystem>
#include <memory>

#include "bundle/texture_file.h"
#include "scene/records/texture.h"
#include "scene/spectra/sampled_spectrum.h"

namespace vitrail {

// It holds tiles in memory, shared by images and threads (tracer/textures/tile_cache.h).
class TileCache;

// Values are pure functions of the arguments, whatever is in memory. It is safe to use from many threads. A
// damaged tile throws Error when it is read.
class BakedImage {
 public:
  // Throws Error with the file's name where its header is damaged. All of a rank's images share one cache:
  // std::make_shared<TileCache>(budget_bytes), or Textures::tiles().
  BakedImage(const std::filesystem::path& file, std::shared_ptr<TileCache> cache);
  BakedImage(TextureFile file, std::shared_ptr<TileCache> cache);
  ~BakedImage();
  BakedImage(BakedImage&&) noexcept;

  int width() const { return static_cast<int>(file().info().width); }  // of level 0
  int height() const { return static_cast<int>(file().info().height); }
  int levels() const { return static_cast<int>(file().info().levels); }
  TexelFormat format() const { return read_format(file().info().format); }  // of what is looked up
  int width(int level) const;
  int height(int level) const;

  // Texel (x,y) covers [x, x+1)/width × [y, y+1)/height; level 0 is the finest. `bilinear` blends the spectra
  // of the four texels whose centres surround (s,t). An image of vectors is 0 as a spectrum.
  SampledSpectrum nearest(double s, double t, Wrap wrap, int level, const SampledWavelengths&) const;
  SampledSpectrum bilinear(double s, double t, Wrap wrap, int level, const SampledWavelengths&) const;
  // Returns the texel itself, 0 ≤ x < width(level), 0 ≤ y < height(level), y up from the bottom.
  SampledSpectrum texel(int x, int y, int level, const SampledWavelengths&) const;

  // They return the three numbers of a vector; for an image of numbers three times that number, for one of
  // spectra 0.
  std::array<double, 3> nearest_vector(double s, double t, Wrap wrap, int level) const;
  std::array<double, 3> bilinear_vector(double s, double t, Wrap wrap, int level) const;

  // Returns the luminance of a texel (Y of D65 = 1), within 1e-3 in an image of light. It is never negative.
  double luminance(int x, int y, int level) const;
  // Returns a texel of an image of numbers.
  double number(int x, int y, int level) const;

  // Look-ups of many paths at a time read these (image_lanes.h).
  struct Size {
    TexelFormat format;
    int width, height;
  };
  Size size(int level) const;
  // Reads the words of texels (x[i % 2][j], y[i / 2][j]), i in [0, 4), to words[i][word][j]. It does so for
  // each of `count` look-ups j that is set in `lanes`. x and y are [2][count]. Words that the format has not
  // stay as they are.
  void read_corners(int level, unsigned lanes, int count, const std::int32_t* x, const std::int32_t* y,
                    std::uint32_t* words) const;
  // Reads one texel for each look-up: (x[j], y[j]) to words[word][j].
  void read_texels(int level, unsigned lanes, int count, const std::int32_t* x, const std::int32_t* y,
                   std::uint32_t* words) const;

  const TextureFile& file() const;
  // It is the cost of a tile that is not in memory: its checksum and the place where it would be.
  static constexpr std::uint64_t table_bytes_per_tile = 16;

 private:
  struct Implementation;
  std::unique_ptr<Implementation> implementation_;
};

}  // namespace vitrail
