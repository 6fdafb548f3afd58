// SPDX-License-Identifier: Apache-2.0
// This file looks textures up. A bundle keeps the scene's texture graph; its images are files of tiles
// (bundle/texture_file.h), read on demand within a budget of memory.
#pragma once

#include <array>
#include <cstdint>
#include <filesystem>
#include <memory>
#include <span>
#include <vector>

#include "scene/records/texture.h"
#include "scene/spectra/color.h"
#include "scene/spectra/rgb_method.h"
#include "scene/spectra/sampled_spectrum.h"

namespace vitrail {

class BakedImage;
class TileCache;

// It is a mesh attribute at the corners of a triangle, and how much each corner counts at a point. Spectra
// are blended as spectra, as Mitsuba does, not as the sigmoids that the corners hold.
struct AttributeValue {
  std::array<std::array<float, 3>, 3> corners;
  std::array<float, 3> weights;
};

// It is a point of a surface as textures see it.
struct TexturePoint {
  Point2d uv;
  Point3d p;            // in the bundle's coordinates, which the transforms of a bundle's textures end in
  Vector3d normal;      // shading, unit, in the bundle's coordinates
  double uv_width = 0;  // diameter of the ray's cone, in units of uv; 0: the finest level
  std::span<const AttributeValue> attributes{};  // mesh attributes, by slot
  double side = 1;                               // −1: the normal points away from the ray
};

// They are the textures of a bundle. Values are pure functions of the point, whatever is in memory. They are
// safe to use from many threads.
class Textures {
 public:
  // `textures` are the bundle's (partitioner/appearance/bake_textures.h) and have to outlive it.
  // `budget_bytes` is for tiles and the tables that find them. `rgb` says how the bundle's colours are
  // spectra. Throws Error for files that are damaged and textures that make no sense.
  Textures(const std::vector<Texture>& textures, const std::filesystem::path& bundle,
           std::uint64_t budget_bytes, RgbMethod rgb = RgbMethod::jakob_hanika);
  ~Textures();
  Textures(Textures&&) noexcept;

  // Values of textures are never below 0, as in pbrt: noise, and mixes by it, can be.
  SampledSpectrum spectrum(const SpectrumParameter& parameter, const TexturePoint& at,
                           const SampledWavelengths& wavelengths) const;
  double number(const FloatParameter& parameter, const TexturePoint& at) const;
  // Returns the file's three numbers of a normal map.
  std::array<double, 3> vector(Id<Texture> texture, const TexturePoint& at) const;

  // Returns the image of an ImageTexture.
  const BakedImage& image(Id<Texture> texture) const;

  // A rank's other images share this cache: BakedImage(file, tiles()). It counts tiles read, and bytes of
  // tiles in memory.
  const std::shared_ptr<TileCache>& tiles() const;
  std::uint64_t tile_loads() const;
  std::uint64_t resident_bytes() const;

 private:
  struct Implementation;
  std::unique_ptr<Implementation> implementation_;
};

}  // namespace vitrail
