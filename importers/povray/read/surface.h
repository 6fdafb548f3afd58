// SPDX-License-Identifier: Apache-2.0
// These records hold textures as scenes say them: pigments, normals, finishes; and interiors. They are turned
// into the Scene's once they are on an object.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "importers/povray/read/symbols.h"
#include "importers/povray/read/token.h"
#include "importers/povray/read/transforms.h"
#include "scene/records/pattern_texture.h"

namespace vitrail::pov {

class Reader;

// It is an entry of a map: of its kinds one is there.
struct BlendEntry {
  double at = 0;
  Numbers color;  // of a slope_map: the height and the slope
  Shared<Pigment> pigment;
  Shared<Texture> texture;
  Shared<Bump> bump;
};
struct BlendMap {
  int levels = 1;
  Word kind =
      Word::color_map_;  // color_map_, pigment_map_, texture_map_, normal_map_, slope_map_, density_map_
  std::vector<BlendEntry> entries;
};

struct ImageMap {
  std::string filename;
  int map_type = 0;  // 0 planar, 1 spherical, 2 cylindrical, 5 torus
  bool once = false;
  int interpolate = 0;
  double filter_all = 0, transmit_all = 0;
  std::optional<double> gamma;  // of the file
  bool gamma_srgb = false;      // `gamma srgb` stands with it
};

// It moves the point before the pattern is looked up, in the order of the file.
struct Warp {
  enum class Kind {
    turbulence,
    transform,
    repeat,
    black_hole,
    planar,
    cylindrical,
    spherical,
    toroidal,
  };
  Kind kind = Kind::transform;
  Vector3d amount;  // of turbulence; of a repetition, its step
  int octaves = 6;
  double lambda = 2, omega = 0.5;
  Transform transform;
  Vector3d offset, flip;  // of a repetition
  Point3d center;         // of a black hole
  double radius = 1, strength = 1, falloff = 2;
  bool inverse = false;
  Vector3d orientation{0, 0, 1};  // of planar … toroidal
  double distance = 0, dist_exp = 0, major_radius = 1;
};

// It is a pattern with its modifiers; `kind` none: there is none.
struct Pattern {
  Word kind = Word::none;
  Vector3d direction{1, 0, 0};  // of a gradient
  std::optional<ImageMap> image;
  Vector3d turbulence;
  int octaves = 6;
  double lambda = 2, omega = 0.5;
  double frequency = 1, phase = 0;
  Word wave = Word::none;  // none: what the kind has
  double wave_exponent = 1;
  Vector3d brick_size{8, 3, 4.5};
  double mortar = 0.5;
  Vector3d crackle_form{-1, 1, 0};
  double crackle_metric = 2, crackle_offset = 0;
  bool crackle_solid = false;
  int arms = 1, iterations = 10;
  Shared<NoiseGenerator> noise;  // null: the corrected one
  double agate_turb = 1, control0 = 1, control1 = 1;
  PatternFractal fractal;  // of mandel, julia, magnet, but for the iterations
  struct Slope {
    Vector3d direction, altitude;  // the latter 0: there is none
    double low = 0, high = 1, low_altitude = 0, high_altitude = 1;
  };
  Slope slope;
  Shared<Function> function;
  Shared<Object> object;
  Shared<Pigment> pigment;   // of pigment_pattern
  std::string density_file;  // that was found
  int interpolate = 0;       // between its values: 0, 1 linear, 2 cubic
  std::vector<Warp> warps;
  bool uv_mapping = false;
};

struct Pigment {
  int levels = 1;
  Place place;
  std::optional<Numbers> color;  // of one colour
  Pattern pattern;
  Shared<BlendMap> map;
  std::optional<Numbers> quick_color;
  Transform to_object;  // of the pattern's space
};

struct Bump {
  int levels = 1;
  Place place;
  Pattern pattern;
  double size = 0.5;
  Shared<BlendMap> map;  // a slope_map, a normal_map, or a list of normals
  bool scaled = true;    // false: no_bump_scale
  Transform to_object;
};

struct Finish {
  Numbers ambient = grey(0.1), emission = grey(0);
  double diffuse = 0.6, diffuse_back = 0, brilliance = 1;
  double phong = 0, phong_size = 40, specular = 0, roughness = 0.05;
  double metallic = 0;
  Numbers reflection_min = grey(0), reflection_max = grey(0);
  bool has_reflection = false, fresnel = false, conserve_energy = false;
  double reflection_metallic = 0, reflection_falloff = 1, reflection_exponent = 1;
  double crand = 0, irid = 0;
  bool subsurface = false;
  Place place;

  static Numbers grey(double value) {
    Numbers n = Numbers(value).promoted(3);
    n.terms = 5, n.is_color = true;
    return n;
  }
};

struct Texture {
  int levels = 1;
  Place place;
  Shared<Pigment> pigment;
  Shared<Bump> normal;
  Shared<Finish> finish;
  // It is a pattern with a map of textures; else `layers` holds the layers, the lowest first, if there is
  // more than one.
  std::optional<Pattern> pattern;
  Shared<BlendMap> map;
  std::vector<Shared<Texture>> layers;
  Transform to_object;  // of all of it; of (u, v, 0) where it is by that
  bool by_uv = false;
};

// It is media {}: coefficients per unit of length, times the product of the densities.
struct MediaBlock {
  Place place;
  Numbers absorption = Finish::grey(0), emission = Finish::grey(0), scattering = Finish::grey(0);
  int scattering_type = 1;  // 1 isotropic, 2 and 3 Mie, 4 Rayleigh, 5 Henyey and Greenstein
  double eccentricity = 0, extinction = 1;
  std::vector<Shared<Pigment>> densities;
  Transform to_object;
};

struct Interior {
  Place place;
  double ior = 1, fade_distance = 0, fade_power = 0;
  Numbers fade_color = Finish::grey(0);
  double dispersion = 1, caustics = 0;
  std::vector<Shared<MediaBlock>> media;
};

// Returns whether it weakens light on the way.
inline bool has_medium(const Interior& interior) {
  return !interior.media.empty() || (interior.fade_distance > 0 && interior.fade_power > 0);
}

// They are the parts of `material {}`.
struct MaterialParts {
  Shared<Texture> texture, interior_texture;
  Shared<Interior> interior;
};

// They read, behind the word, a block or, where that may be, the name of one.
Shared<Pigment> read_pigment_block(Reader& reader, const Shared<Pigment>& from = {});
Shared<Pigment> read_pattern_block(Reader& reader);
Shared<Bump> read_normal_block(Reader& reader);
Shared<Finish> read_finish_block(Reader& reader, const Shared<Finish>& from = {});
Shared<Texture> read_texture_block(Reader& reader);

// Reads what comes behind `normal` in or behind a texture that was transformed, as povray shows it: a pigment
// takes the place of the one that is there, with its transformations, and so does a normal, but the first
// one.
void change_normal(Reader& reader, Texture& top, const Transform& placed);
// Applies what comes behind a texture of layers to the last one: change(that, its transformation).
template <class Change>
void change_top(Texture& texture, const Change& change, const Transform& before = {}) {
  const Transform placed = before * texture.to_object;
  if (texture.layers.empty()) return change(texture, placed);
  auto top = std::make_shared<Texture>(*texture.layers.back());
  change_top(*top, change, placed);
  texture.layers.back() = std::move(top);
}
Shared<Interior> read_interior_block(Reader& reader);
Shared<MediaBlock> read_media_block(Reader& reader);
Shared<MaterialParts> read_material_block(Reader& reader);
Shared<BlendMap> read_map_block(Reader& reader, Word kind);

// They return the texture, and the media of the interior, under a transform of the object that has them.
Shared<Texture> moved(const Shared<Texture>& texture, const Transform& by);
Shared<Interior> moved(const Shared<Interior>& interior, const Transform& by);

// Returns the mean of the colours that it may have: of a map weighted by the length of its pieces.
Numbers mean_color(const Pigment& pigment);

// Skips a block in braces, with all in it.
void skip_block(Reader& reader);

}  // namespace vitrail::pov
