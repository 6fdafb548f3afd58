// SPDX-License-Identifier: Apache-2.0
// A texture gives values that vary over surfaces. Textures form a graph without cycles: a texture refers only
// to ones with a smaller id.
#pragma once

#include <array>
#include <cstdint>
#include <string>
#include <variant>

#include "scene/geometry/transform.h"
#include "scene/records/origin.h"
#include "scene/records/parameter.h"
#include "scene/records/pattern_texture.h"

namespace vitrail {

// ---- From a point of a surface to the (s,t) of a texture

// It maps s = a·u + b·v + c, t = d·u + e·v + f.
struct UvMapping {
  float a = 1, b = 0, c = 0, d = 0, e = 1, f = 0;
  bool operator==(const UvMapping&) const = default;
};
// It maps s = acos(z)/π, t = atan2(y,x)/2π (+1 below 0) of the direction of the point in texture space, as in
// pbrt.
struct SphericalMapping {
  Transform texture_to_world;
  bool operator==(const SphericalMapping&) const = default;
};
// It maps s = ½ + atan2(y,x)/2π, t = z in texture space, as in pbrt-v4. If `of_direction`, t is z of the
// direction of the point, as in pbrt-v3.
struct CylindricalMapping {
  Transform texture_to_world;
  bool of_direction = false;
  bool operator==(const CylindricalMapping&) const = default;
};
// It maps s = p·v1 + offset_s, t = p·v2 + offset_t in texture space.
struct PlanarMapping {
  Transform texture_to_world;
  Vector3d v1{1, 0, 0}, v2{0, 1, 0};
  double offset_s = 0, offset_t = 0;
  bool operator==(const PlanarMapping&) const = default;
};
// It takes the first two numbers of the mesh's attribute of that slot. It is in bundles alone.
struct AttributeMapping {
  std::string slot;
  bool operator==(const AttributeMapping&) const = default;
};
// It maps s = atan2(y,x)/2π (+1 below 0), t = 1 − acos(z)/π of the direction of the point in texture space,
// as on globes: SphericalMapping's two, exchanged, t from below.
struct GlobeMapping {
  Transform texture_to_world;
  bool operator==(const GlobeMapping&) const = default;
};
using TextureMapping = std::variant<UvMapping, SphericalMapping, CylindricalMapping, PlanarMapping,
                                    AttributeMapping, GlobeMapping>;

// ---- Kinds of texture

enum class Wrap : std::uint8_t { repeat, mirror, clamp, black };
enum class TextureFilter : std::uint8_t { nearest, bilinear, trilinear, anisotropic };
// It says how the numbers of the file become values: `automatic` is sRGB for 8-bit colour files and linear
// for others.
enum class Encoding : std::uint8_t { automatic, srgb, linear, gamma };

// It says which number a texture of numbers takes from a pixel of several channels; a grey image has but one
// beside alpha. Every channel is decoded as the encoding says before it is looked at, alpha too (as in
// pbrt-v4).
enum class ImageNumber : std::uint8_t {
  mean,       // of R, G and B
  luminance,  // of linear sRGB
  red,
  green,
  blue,
  alpha,               // 1 where the image has none
  alpha_or_mean,       // alpha where the image has one that is not 1 everywhere (pbrt-v4)
  alpha_or_luminance,  // likewise
  stored_luminance,    // of R, G and B as stored: the luminance is what is decoded (pbrt-v3)
};

// It says how the renderer reads the chromaticities that an EXR file may state. Without them colours are of
// sRGB.
enum class Primaries : std::uint8_t {
  file,   // what they say, by colorimetry (Mitsuba)
  named,  // looked at where they are those of a space that pbrt-v4 knows; white reflects as white
  srgb,   // nothing (pbrt-v3)
};

// Its (s,t) = (0,0) is the lower left corner of the image, (1,1) the upper right one. Colours are as the file
// stores them beside alpha: never multiplied by it, and never divided.
struct ImageTexture {
  std::string filename;  // absolute
  TextureMapping mapping;
  Wrap wrap = Wrap::repeat;
  TextureFilter filter = TextureFilter::bilinear;
  Encoding encoding = Encoding::automatic;
  float gamma = 1;      // of Encoding::gamma: value = file^gamma
  float scale = 1;      // multiplies the values
  bool invert = false;  // 1 − value, after the scale
  ImageNumber number = ImageNumber::mean;
  Primaries primaries = Primaries::file;
  bool operator==(const ImageTexture&) const = default;
};

// It has cells of size 1 in (s,t), or in three dimensions of texture space where `solid`: `even` holds (0,0).
struct CheckerboardTexture {
  SpectrumParameter even, odd;
  TextureMapping mapping;
  bool solid = false;
  Transform texture_to_world;  // of a solid one
  bool operator==(const CheckerboardTexture&) const = default;
};

// It is first · second.
struct ProductTexture {
  SpectrumParameter first, second;
  bool operator==(const ProductTexture&) const = default;
};

// It is (1 − amount)·first + amount·second.
struct MixTexture {
  SpectrumParameter first, second;
  FloatParameter amount = 0.5f;
  bool operator==(const MixTexture&) const = default;
};

// It is a mix by amount = |n·direction| of the shading normal n: `first` where they are parallel.
struct DirectionMixTexture {
  SpectrumParameter first, second;
  Vector3d direction{0, 1, 0};  // world
  bool operator==(const DirectionMixTexture&) const = default;
};

// It is bilinear between the values at (s,t) = (0,0), (0,1), (1,0), (1,1).
struct BilinearTexture {
  SpectrumParameter v00, v01, v10, v11;
  TextureMapping mapping;
  bool operator==(const BilinearTexture&) const = default;
};

// It has discs at random places in those unit cells of (s,t) where pbrt's noise is above 0: 39 % of them.
struct DotsTexture {
  SpectrumParameter inside, outside;
  TextureMapping mapping;
  bool operator==(const DotsTexture&) const = default;
};

// It sums Perlin noise in texture space (pbrt's fbm, wrinkled, windy, marble).
struct NoiseTexture {
  enum class Kind : std::uint8_t { fbm, wrinkled, windy, marble };
  Kind kind = Kind::fbm;
  Transform texture_to_world;
  int octaves = 8;
  float roughness = 0.5f;
  float scale = 1, variation = 0.2f;  // of marble
  bool operator==(const NoiseTexture&) const = default;
};

// It is a texture by face of a subdivision surface, in Ptex's own files.
struct PtexTexture {
  std::string filename;
  Encoding encoding = Encoding::automatic;
  float gamma = 1;
  float scale = 1;
  bool operator==(const PtexTexture&) const = default;
};

// It reads the mesh's attribute of that name.
struct MeshAttributeTexture {
  std::string name;
  float scale = 1;
  bool operator==(const MeshAttributeTexture&) const = default;
};

// It is the colour (frac s, frac t, 0) (pbrt-v3's uv).
struct UvTexture {
  TextureMapping mapping;
  bool operator==(const UvTexture&) const = default;
};

using TextureVariant = std::variant<ImageTexture, CheckerboardTexture, ProductTexture, MixTexture,
                                    DirectionMixTexture, BilinearTexture, DotsTexture, NoiseTexture,
                                    PtexTexture, MeshAttributeTexture, UvTexture, PatternTexture>;
// It is copied, moved, destroyed and compared in scene/records/special_members.cpp alone: in every file that
// handles a scene, that took up to two thirds of its compiling.
struct TextureModel : TextureVariant {
  using TextureVariant::TextureVariant;
  TextureModel();
  TextureModel(const TextureModel&);
  TextureModel(TextureModel&&) noexcept;
  TextureModel& operator=(const TextureModel&);
  TextureModel& operator=(TextureModel&&) noexcept;
  ~TextureModel();
  bool operator==(const TextureModel&) const;
};

// A texture is either a colour or one number (`is_float`); inputs of a number are numbers, as constant
// spectra or other such textures. A colour's meaning (a reflectance in [0,1], a factor without bound, an
// emission) follows from where it is used.
struct Texture {
  TextureModel model;
  bool is_float = false;
  std::string name;  // "" where the file gives none
  Origin origin;
  bool operator==(const Texture&) const = default;
};

}  // namespace vitrail
