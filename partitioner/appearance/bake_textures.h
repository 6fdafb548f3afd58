// SPDX-License-Identifier: Apache-2.0
// These are the textures of a scene as a bundle has them: images baked, everything else as it is used.
#pragma once

#include <tbb/task_group.h>

#include <array>
#include <deque>
#include <exception>
#include <filesystem>
#include <map>
#include <memory>
#include <string>
#include <tuple>
#include <utility>
#include <vector>

#include "bundle/manifest.h"
#include "partitioner/appearance/bake_codes.h"
#include "partitioner/appearance/bake_image.h"
#include "partitioner/appearance/bake_ptex.h"
#include "partitioner/appearance/texture_mean.h"
#include "partitioner/caching/file_cache.h"
#include "scene/records/scene.h"

namespace vitrail {

// A Tint has linear sRGB factors of an image's or attribute's numbers, taken before these become spectra. A
// normal map's are of the components of (rgb·2 − 1).
using Tint = std::array<float, 3>;
inline constexpr Tint no_tint{1, 1, 1};

struct ImageBaking {
  std::filesystem::path cache;  // of baked images, kept by their content; empty: none
  // It leaves images of integers unread where nothing is written; damage shows when they are read.
  bool trust_integers = false;
};

// A texture serves each use (a reflectance, a number …) by a clone of its own. In the clones constants are
// `resolved`; images keep mapping, wrap and filter, and name a file of the bundle: "textures/000003.tex".
class TextureBaker {
 public:
  // Nothing is written where `bundle` is empty. Makes `bundle`/textures where there is something to put in
  // it. Adds to the diagnostics what cannot be said exactly. The scene and the diagnostics outlive it.
  TextureBaker(const Scene& scene, std::filesystem::path bundle, Diagnostics& diagnostics,
               ImageBaking images = {});
  ~TextureBaker();

  // These throw Error, with the texture's place in the scene file, for images that
  // cannot be read, and MachineError.
  SpectrumParameter bake(const SpectrumParameter& parameter, TextureUse use);
  FloatParameter bake(const FloatParameter& parameter);
  // Returns whether the scene's colours are bands (scene/spectra/rgb_bands.h).
  bool in_bands() const { return scene_.settings.rgb == RgbMethod::bands; }
  // Returns the spectrum `resolved`, colours by the scene's method.
  Spectrum as_rendered(const Spectrum& spectrum) const;
  Id<Texture> bake_vector(Id<Texture> texture);
  // Throws as `bake` does.
  std::optional<TextureMean> mean(const SpectrumParameter& parameter);
  // Returns whether an attribute of meshes counts in what was baked.
  bool reads_attribute(const FloatParameter& baked) const;
  // Bakes a light's image, with all MIP levels, and returns its name in the bundle.
  std::string bake_image(const ImageTexture& image, TextureUse use, const SourceLocation& where);

  // They are attributes of meshes that the clones refer to, by slot: the bundle's MeshAttributeTexture of the
  // first is named "0". A name that serves two uses has two slots.
  struct Attribute {
    std::string name;
    TextureUse use;
    std::shared_ptr<const PtexTiles> tiles = nullptr;  // of face_indices: the corners' places among them
    Tint tint = no_tint;
    bool operator==(const Attribute&) const = default;
  };
  const std::vector<Attribute>& attributes() const { return attributes_; }
  // Waits for those that are still being written. Throws what `bake` would have thrown for them.
  const std::vector<TextureFileEntry>& files();
  std::vector<Texture> take_textures() { return std::move(textures_); }

 private:
  struct Clone;
  struct ImageFacts {
    bool other_primaries = false;  // the file states some, which do not count
    std::uint64_t broken = 0;      // values that are not finite
  };
  SpectrumParameter bake_input(const SpectrumParameter& parameter, TextureUse use);
  SpectrumParameter bake_texture(Id<Texture> texture, TextureUse use);
  std::optional<SpectrumParameter> bake_tinted(const ProductTexture& product, TextureUse use);
  SpectrumParameter bake_ptex(Id<Texture> texture, const PtexTexture& ptex, TextureUse use);
  std::string bake_file(const ImageTexture& image, TextureUse use, const Tint& tint, bool all_levels,
                        const SourceLocation& where);
  std::string write_file(const ImageTexture& image, TextureUse use, const Tint& tint, bool all_levels,
                         const SourceLocation& where);
  std::string write_image(const ImageRows& rows, TextureUse use, bool all_levels);
  std::string write_codes(const ImageTexture& image, const ByteRows& rows, const CodedImage& coded,
                          bool all_levels, const SourceLocation& where, const std::string& key);
  std::string next_file();
  void report(const ImageTexture& image, const ImageFacts& facts, const SourceLocation& where);
  Id<Texture> add(TextureModel model, TextureUse use);
  std::string slot_of(const Attribute& wanted);
  bool is_number(const SpectrumParameter& parameter) const;

  const Scene& scene_;
  std::filesystem::path bundle_;
  Diagnostics& diagnostics_;
  bool trust_integers_;
  FileCache cache_;
  ReflectanceFitter fitter_;
  std::vector<Texture> textures_;
  std::vector<Attribute> attributes_;
  // Images of codes are written beside each other, while the scene goes on.
  struct Writing {
    std::size_t file;
    TextureFileEntry written;
    std::exception_ptr failure = nullptr;
  };
  std::deque<Writing> writing_;
  std::vector<TextureFileEntry> files_;
  std::map<std::pair<std::uint32_t, TextureUse>, SpectrumParameter> baked_;
  using ImageKey =
      std::tuple<std::string, Encoding, float, float, bool, ImageNumber, Primaries, TextureUse, Tint, bool>;
  std::map<ImageKey, std::string> images_;
  KnownMeans means_;
  tbb::task_group writers_;  // ends before all that it refers to
};

// Returns what a vertex has in a slot of that use. A number is the mean of the colour. A spectrum is x at
// 360, 595 and 830 nm of the sigmoid, within ±200, as Mitsuba holds them, so that it may be interpolated;
// a colour outside [0,1] is clamped.
std::array<float, 3> attribute_value(RGB color, TextureUse use, const ReflectanceFitter& fitter);

// Moves what the textures' transforms end in: by −offset from the world to the bundle's coordinates.
void move(std::vector<Texture>& textures, Vector3d by);

}  // namespace vitrail
