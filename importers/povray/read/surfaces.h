// SPDX-License-Identifier: Apache-2.0
// Surfaces makes materials, glows and opacities of textures.
#pragma once

#include <array>
#include <map>
#include <optional>
#include <string>

#include "importers/povray/read/surface.h"
#include "importers/povray/read/surface_uvs.h"
#include "scene/records/scene.h"

namespace vitrail::pov {

// It is a texture with its place: `to_world` takes its space to that of the scene, or of a prototype.
struct Look {
  Shared<Texture> texture;
  Transform to_world;
  Shared<Interior> interior;
  bool by_uv = false;           // the texture lies by (u,v), and `to_world` is not looked at
  bool uvs_are_places = false;  // (u,v) are the world's x and y
  SurfaceUvs uvs;               // of a part of a set
  bool no_shadow = false;
  bool no_image = false;
  bool hollow = false;
  bool double_illuminate = false;    // lamps light each side from both
  bool of_lamp = false;              // it stands around a light, as what that looks like
  std::optional<Id<Medium>> medium;  // in its interior
  Shared<Texture> interior_texture;  // of the inside; null: as outside
  Transform interior_to_world;
  bool covers = false;  // it lies upon another layer, which shows through
  // These are of layers above: what they let through of each colour, as numbers of the file and as textures,
  // and the `crand` that they take of all light whatever they let through, times their own colour.
  std::array<double, 3> filter_above{1, 1, 1};
  std::optional<SpectrumParameter> tint;
  double crand_above = 0;
};

// A Surface holds what a Shape takes of a Look.
struct Surface {
  Id<Material> material;
  std::optional<Id<AreaLight>> glow;
  FloatParameter opacity = 1.0f;
};

// Sets the highlights of a material that is shown in such a share: all of them.
void set_highlights(FinishMaterial& material, const Finish& finish, double share);

class Surfaces {
 public:
  // `ambient` multiplies the light of a finish's ambient; it is 0 with radiosity. If `glazes`, a material
  // that mirrors by angle or lets light through is a GlazedMaterial, which other formats do not have, and
  // photons do not know.
  Surfaces(Reader& reader, Scene& scene, Numbers ambient, bool glazes)
      : reader_(reader), scene_(scene), ambient_(ambient), glazes_(glazes) {}

  Surface of(const Look& look);
  // Returns it with its interior_texture, if it has one, at the back. Where that glows, or light goes through
  // either, the texture outside is that of both, with a note.
  Surface of_sides(const Look& look, const Place& place);
  // Returns radiance by a pigment, as of a sky: a colour or a texture.
  SpectrumParameter radiance_of(const Pigment& pigment, const Transform& to_world);
  // Puts the last above: where one is not all there, those before it show through. There is one at least.
  SpectrumParameter radiance_of(const std::vector<Shared<Pigment>>& pigments, const Transform& to_world);

 private:
  struct Layer {  // a material with its share of what is behind
    Id<Material> material;
    FloatParameter opacity = 1.0f;
    SpectrumParameter glow = Spectrum{ConstantSpectrum{0}};
    float glow_scale = 0;
  };

  Surface made(const Look& look);
  // Returns what takes the space of a texture, which lies in that of `around`, to the world or to (u, v, 0).
  Transform placed_in(const Transform& around, const Texture& texture) const {
    return texture.by_uv ? uv_space_ * texture.to_object : around * texture.to_object;
  }
  // Nothing shows through it but what is behind the surface if `alone`.
  Layer layer_of(const Texture& texture, const Transform& to_world, const Look& given, bool alone = false);
  // They make layers or a pattern of textures, else call layer_of (make_layers.cpp).
  Layer layered(const Texture& texture, const Transform& to_world, const Look& look);
  Layer blended(const Texture& texture, const Transform& to_world, const Look& look);
  void add_glow_alone(std::vector<std::pair<double, Layer>>& layers, const Place& place);
  // Returns (1 − amount)·first + amount·second; with the material, glow and opacity of both.
  Layer mixed(const Layer& first, const Layer& second, const FloatParameter& amount, const Place& place);
  Id<Material> material_of(const Pigment& pigment, const Finish& finish, const Transform& to_world,
                           const Look& look);
  // It has what is solid of it, and what light goes through, in their shares; with bumps (make_bumps.cpp).
  struct Body {
    const Pigment& pigment;
    const Finish& finish;
    Transform to_world;  // of the pigment
    const Look& look;
    std::optional<float> solid;  // how much of it; none: all, as nothing goes through
    Place place;
    bool glazed = false;
  };
  // Returns whether it mirrors by angle, or shows all of its highlights though clear (make_glazed.cpp).
  bool is_glazed(const Finish& finish, const Interior* interior, float opacity) const;
  Id<Material> glazed(const Body& body);
  Id<Material> material_of(const Body& body);
  Id<Material> bumpy(const Body& body, const Bump* bump, const Transform& to_world);
  std::optional<FloatParameter> bump_texture(const Bump& bump, const Transform& to_world);
  SpectrumParameter highlight_color(const Pigment& pigment, const Finish& finish, const Transform& to_world,
                                    const Look& look);
  // Returns that times what the layers above let through of each colour.
  SpectrumParameter tinted(const SpectrumParameter& value, const Look& look, const Place& place);
  // Puts into `look`, that of a layer below, what a layer above it does to the light that it lets through.
  void put_above(const Texture& texture, const Transform& to_world, Look& look);
  Id<Material> clear_material(const Pigment& pigment, const Finish& finish, const Interior* interior);

  // A Part says what of a colour becomes the value (make_textures.cpp). By (u,v), `to_world` takes the
  // texture's space to that of (u, v, 0), and it is the pigment's own where that has `uv_mapping`. A factor
  // may be above 1. `grey` is that of its numbers as they are; `filtered` is the tint of what shows through.
  enum class Part { reflectance, factor, radiance, opacity, grey, filtered };
  static bool is_number(Part part) { return part == Part::opacity || part == Part::grey; }
  SpectrumParameter color_texture(const Pigment& pigment, const Transform& to_world, Part part, double factor,
                                  bool by_uv);
  SpectrumParameter entry_texture(const BlendEntry& entry, const Transform& to_world, Part part,
                                  double factor, bool by_uv);
  SpectrumParameter average_texture(const Pigment& pigment, const Transform& to_world, Part part,
                                    double factor, bool by_uv);
  // Returns a number of each point, 1 − amount … 1 + amount: grains too small to be seen.
  SpectrumParameter grain(double amount, const Place& place);
  FloatParameter opacity_of(const Pigment& pigment, const Transform& to_world, bool by_uv);
  SpectrumParameter image_texture(const ImageMap& image, const Pattern& pattern, const Transform& to_world,
                                  Part part, bool by_uv, double factor, const Place& place);
  // Returns a displacement that is everywhere what another texture is there (make_bumps.cpp).
  PatternTexture carrier_of(const SpectrumParameter& height, const Transform& to_world) const;
  std::optional<FloatParameter> bump_of_image(const Bump& bump, const Transform& to_world);
  std::optional<FloatParameter> bump_of_pigment(const Bump& bump, const Transform& to_world, double height);
  std::optional<FloatParameter> bump_of_quilts(const Bump& bump, const Transform& to_world);
  std::optional<SpectrumParameter> distance_from_middles(const Pattern& quilted, Vector3d axis,
                                                         const Transform& to_world, const Place& place);
  double height_of(const Bump& bump, const Transform& to_world);
  void set_encoding(ImageTexture& texture, const ImageMap& image) const;
  std::optional<PatternTexture> pattern_texture(const Pattern& pattern, const Transform& to_world, bool by_uv,
                                                const Place& place);
  void note_modifiers(const Pattern& pattern, const Place& place);  // of a pigment_pattern
  FloatParameter amount_texture(const Pattern& pattern, const Transform& to_world, bool by_uv, double from,
                                double to, const Place& place, bool second_of_list, std::size_t index);

  Spectrum spectrum_of(const Numbers& color, Part part, double factor) const;
  // Returns by how much less a colour shows of itself for what it lets through: filter + transmit, and before
  // version 3.7 filter·max(r, g, b) + transmit, as povray's pixels say.
  double share_through(const Numbers& color) const;
  // Returns the tint of what shows through a colour: what filter and transmit let of it, over both.
  Spectrum filtered(const Numbers& color) const;
  float opacity_of(const Numbers& color) const;
  template <class T>
  auto append(std::vector<T>& records, T record) {
    records.push_back(std::move(record));
    return Id<T>{static_cast<std::uint32_t>(records.size() - 1)};
  }
  Id<Material> add(MaterialModel model, const Place& place);
  Id<vitrail::Texture> add(TextureModel model, bool is_float, const Place& place);
  Origin origin(const Place& place) const { return {place.file, place.line, place.column}; }
  void approximated(const std::string& message, const Place& place);
  void dropped(const std::string& message, const Place& place);

  Reader& reader_;
  Scene& scene_;
  Numbers ambient_;
  bool glazes_;
  std::optional<FloatParameter> displacement_;  // of materials that are added
  Transform uv_space_;  // of the look that is made: where (u,v) are places, what flattens the world along z
  bool uvs_are_places_ = false;
  std::map<std::string, Surface> made_;
  std::map<std::array<std::uint32_t, 3>, std::optional<Surface>> sides_;  // by outside, inside, glow
  std::vector<Shared<Texture>> kept_;
};

// Returns the pigment with its colours times what layers above let through of each.
Shared<Pigment> filtered_by(const Pigment& pigment, const std::array<double, 3>& through);

// They return whether it is the same wherever it is.
bool is_plain(const Texture& texture);
bool is_plain(const Pigment& pigment);

}  // namespace vitrail::pov
