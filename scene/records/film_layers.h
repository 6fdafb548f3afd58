// SPDX-License-Identifier: Apache-2.0
// A film keeps layers of the first surface that each sample sees, beside its colour: "arbitrary output
// variables", for denoisers and compositing.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <string>
#include <string_view>

namespace vitrail {

enum class Layer : std::uint8_t {
  albedo,
  position,
  geometric_normal,
  shading_normal,
  uv,
  depth,
  shape,
  material,
  primitive,
  alpha,   // how much of a pixel something covers; what is infinitely far covers nothing
  motion,  // the way of the surface over the picture while the shutter is open, in pixels
  // These are Cryptomatte's: masks of shapes and of materials, by their names.
  crypto_object,
  crypto_material
};
inline constexpr std::size_t layer_count = 13;

// It says all that is known of a layer.
struct LayerKind {
  const char* name;  // of options and of Mitsuba's integrator `aov`, where that has it
  // They are the names of the channels of a picture; those of pbrt's film `gbuffer`, where that has them. A
  // matte has the beginning of its channels' names.
  std::array<const char*, 3> channels;
  std::size_t sums;  // planes of a film that it adds to; 0: an id, which is not added up, or a matte
  // They say what the values are: for lengths the quantum of a film's sums follows from the scene.
  bool is_length, has_frame;
  bool is_matte = false;

  // Returns whether the layer is a number of the surface, which is not added up.
  constexpr bool is_id() const { return sums == 0 && !is_matte; }
};
inline constexpr std::array<LayerKind, layer_count> layer_kinds{
    {{"albedo", {"Albedo.R", "Albedo.G", "Albedo.B"}, 3, false, false},
     {"position", {"P.X", "P.Y", "P.Z"}, 3, true, true},
     {"geo_normal", {"N.X", "N.Y", "N.Z"}, 3, false, true},
     {"sh_normal", {"Ns.X", "Ns.Y", "Ns.Z"}, 3, false, true},
     {"uv", {"u", "v"}, 2, false, false},
     {"depth", {"Z"}, 1, true, false},
     {"shape_index", {"Id.shape"}, 0, false, false},
     {"material_index", {"Id.material"}, 0, false, false},
     {"prim_index", {"Id.primitive"}, 0, false, false},
     {"alpha", {"A"}, 1, false, false},
     {"motion", {"forward.u", "forward.v"}, 2, false, false},
     {"crypto_object", {"CryptoObject"}, 0, false, false, true},
     {"crypto_material", {"CryptoMaterial"}, 0, false, false, true}}};

// Returns the layer's row of layer_kinds.
constexpr const LayerKind& kind_of(Layer layer) { return layer_kinds[static_cast<std::size_t>(layer)]; }

// It is a set of layers.
struct FilmLayers {
  std::uint32_t bits = 0;        // 1 << Layer
  bool in_camera_space = false;  // what has a frame; else the world's

  // They return whether there is a layer, and whether `layer` is in the set; they add and remove one.
  constexpr bool any() const { return bits != 0; }
  constexpr bool has(Layer layer) const { return bits >> static_cast<unsigned>(layer) & 1; }
  constexpr void add(Layer layer) { bits |= 1u << static_cast<unsigned>(layer); }
  constexpr void remove(Layer layer) { bits &= ~(1u << static_cast<unsigned>(layer)); }
  bool operator==(const FilmLayers&) const = default;
};
inline constexpr std::uint32_t all_layers = (1u << layer_count) - 1;

// Returns whether shapes that differ in nothing but their names stay apart.
constexpr bool tells_shapes(const FilmLayers& layers) {
  return layers.has(Layer::shape) || layers.has(Layer::crypto_object);
}

// They return how many planes the layers below `end` have: for sums, for ids and for mattes.
constexpr std::size_t sum_planes(const FilmLayers& layers, std::size_t end = layer_count) {
  std::size_t planes = 0;
  for (std::size_t i = 0; i < end; ++i)
    if (layers.has(static_cast<Layer>(i))) planes += layer_kinds[i].sums;
  return planes;
}
constexpr std::size_t id_planes(const FilmLayers& layers, std::size_t end = layer_count) {
  std::size_t planes = 0;
  for (std::size_t i = 0; i < end; ++i)
    if (layers.has(static_cast<Layer>(i))) planes += layer_kinds[i].is_id();
  return planes;
}
constexpr std::size_t matte_planes(const FilmLayers& layers, std::size_t end = layer_count) {
  std::size_t planes = 0;
  for (std::size_t i = 0; i < end; ++i)
    if (layers.has(static_cast<Layer>(i))) planes += layer_kinds[i].is_matte;
  return planes;
}

// Adds a layer by its name, also as `NAME:KIND` of Mitsuba, whose NAME says nothing here. "normal" is the
// shading normal, "cryptomatte" both of its layers. Returns false for other names.
bool add_named(FilmLayers& layers, std::string_view name);
// Returns the names with commas between them.
std::string names_of(const FilmLayers& layers);

}  // namespace vitrail
