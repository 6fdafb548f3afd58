// SPDX-License-Identifier: Apache-2.0
// A Builder makes the records of the Scene from the objects of a file. Each kind of object has its file.
#pragma once

#include <array>
#include <map>
#include <optional>
#include <set>
#include <string>
#include <string_view>
#include <tuple>

#include "importers/mitsuba/material_parts.h"
#include "importers/mitsuba/read/object.h"
#include "importers/reading/integrator.h"
#include "scene/records/material_traits.h"
#include "scene/records/scene.h"
#include "scene/shapes/deferred_mesh.h"

namespace vitrail::mitsuba {

// It says what a colour is used as: a reflectance in [0,1], a factor without bound, or emission (rgb v is D65
// of luminance v).
enum class Quantity { reflectance, unbounded, emission };

// They are Mitsuba's own planes where the file gives its camera none.
struct Clipping {
  double near_clip = 1e-2, far_clip = 1e4;
};

struct Builder {
  Scene& scene;
  Report& report;
  std::map<const Object*, Id<Material>> materials;
  // These are given to shapes without a bsdf: 1 to those that shine, 2 to those that bound a medium in old
  // files.
  std::array<std::optional<Id<Material>>, 3> default_materials{};
  // These three have an entry for each of the scene's materials (scene/records/material_traits.h).
  std::vector<MaterialTraits> traits;
  std::vector<bool> sided;
  std::vector<MaterialParts> parts;
  std::vector<Origin> bumps_of_straight;  // adapters around what lets light straight through
  std::map<const Object*, Id<Medium>> media;
  std::map<std::pair<const Object*, bool>, Id<Texture>>
      textures;  // by object and whether it is read as a number
  std::map<const Object*, Id<Prototype>> prototypes;
  std::map<std::tuple<std::string, int, int>, Id<TriangleMesh>>
      mesh_files;  // path, index in it, variant of reading
  AskedIntegrator integrator{};
  std::optional<int> passes{};  // of its photons, each a sample of every pixel; empty: as the sampler says
  double shutter_open = 0, shutter_close = 0;  // of the sensor
  Clipping clipping{};
  MeshMemory mesh_memory{};
  bool replace_missing = false;               // leave out shapes whose file is not there
  std::set<std::uint32_t> smoothed_meshes{};  // whose normals were made here
};

// ---- spectra.cpp, textures.cpp
// Returns the property as a spectrum or texture; `otherwise` where it is absent. It takes numbers, <rgb>,
// <spectrum>, nested <texture> and <spectrum type="…"> plugins.
SpectrumParameter spectrum_parameter(Builder& builder, const Object& object, std::string_view name,
                                     Quantity quantity, const Spectrum& otherwise);
FloatParameter float_parameter(Builder& builder, const Object& object, std::string_view name,
                               double otherwise);
// Returns the same where a texture cannot be: its mean stands for it, with a diagnostic.
Spectrum spectrum_value(Builder& builder, const Object& object, std::string_view name, Quantity quantity,
                        const Spectrum& otherwise);
Id<Texture> add_texture(Builder& builder, const Object& texture, bool as_float);

// ---- clipping.cpp
// Throws Error for planes that Mitsuba refuses.
void read_clipping(Builder& builder, const Object& sensor);
// Gives the camera the planes that cut something away, when all shapes are read.
void keep_clipping(Builder& builder);

// ---- bsdfs.cpp
// Adds a record that is made here; those that it refers to have been added.
Id<Material> append(Builder& builder, Material material);
// Returns the material of a <bsdf>; the same object gives the same material.
Id<Material> add_material(Builder& builder, const Object& bsdf);

// ---- media.cpp
Id<Medium> add_medium(Builder& builder, const Object& medium);
// Returns g of the phase function inside of an object.
float read_phase(const Object& around, Report& report);

// ---- emitters.cpp
// Adds a light of the scene (not "area"). Unknown kinds are reported and dropped.
void add_emitter(Builder& builder, const Object& emitter);
// Adds an "area" or "directionalarea" emitter of a shape. Returns nothing where it is of another kind, which
// is reported.
std::optional<Id<AreaLight>> add_area_light(Builder& builder, const Object& emitter);

// ---- shapes.cpp (and serialized.cpp, curves.cpp …)
// Adds a shape of the scene, or an instance of a shapegroup; shapegroups themselves are made when an instance
// asks.
void add_shape(Builder& builder, const Object& shape);

// ---- sensor.cpp
// Returns the motion of keyframes in order. Returns nothing where there are none, or where they make no
// motion, which is reported.
std::optional<Motion> motion_of(Builder& builder, std::vector<Keyframe> keys, const Origin& place);
// Reads camera, film, filter and sampler.
void read_sensor(Builder& builder, const Object& sensor);
// Reads max_depth and what the integrator leaves out.
void read_integrator(Builder& builder, const Object& integrator);
// Settles the integrator once the scene is read.
void finish_integrator(Builder& builder, bool all_media);

}  // namespace vitrail::mitsuba
