// SPDX-License-Identifier: Apache-2.0
// The parts of the Mitsuba writer share the state of one document, and elements with exact numbers.
#pragma once

#include <fmt/format.h>

#include <algorithm>
#include <limits>
#include <map>
#include <optional>
#include <pugixml.hpp>
#include <string>
#include <unordered_map>
#include <vector>

#include "importers/images/baked_textures.h"
#include "importers/images/converted_images.h"
#include "importers/mitsuba/material_parts.h"
#include "importers/writing/conversion_notes.h"
#include "importers/writing/exposed_lights.h"
#include "importers/writing/mesh_files.h"
#include "importers/writing/opacity_key.h"
#include "importers/writing/unique_names.h"
#include "scene/records/material_traits.h"
#include "scene/records/scene.h"
#include "scene/records/uv_uses.h"
#include "scene/spectra/color.h"

namespace vitrail::mitsuba_writer {

template <class... F>
struct Overloaded : F... {
  using F::operator()...;
};
template <class... F>
Overloaded(F...) -> Overloaded<F...>;

// It is a texture as Mitsuba can say it: an element of its own, by id, or one value for all of the surface.
using WrittenTexture = std::variant<std::string, Spectrum>;

// It says, by texture, which ones materials take for heights or normals. These are written otherwise than
// colours and numbers.
struct TextureRoles {
  explicit TextureRoles(const Scene& scene);
  std::vector<bool> height, normal_map;
};

struct Context : ConversionNotes {
  Context(const Scene& scene_to_write, const std::filesystem::path& out)
      : ConversionNotes(scene_to_write),
        file(out),
        exposed(scene_to_write),
        meshes(scene_to_write, out),
        side_files(out),
        roles(scene_to_write),
        sided(with_sides(scene_to_write.materials)),
        traits(traits_of(scene_to_write.materials)),
        parts(mitsuba::parts_of(scene_to_write.materials)),
        uvs_show(meshes_whose_uvs_show(scene_to_write)),
        uv_uses(scene_to_write),
        uv_uses_of_curves(scene_to_write, true),
        hair_along_u(with_hair(scene_to_write.materials, false)) {}

  std::filesystem::path file;  // of the scene
  ExposedLights exposed;
  MeshFiles meshes;
  SideFiles side_files;
  TextureRoles roles;
  std::vector<bool> sided;               // with_sides
  std::vector<bool> turned_both_ways{};  // of materials: shapes of it face both ways
  std::vector<MaterialTraits> traits;
  std::vector<mitsuba::MaterialParts> parts;
  std::vector<bool> uvs_show;  // of each mesh
  ShapeUvUses uv_uses, uv_uses_of_curves;
  std::vector<bool> hair_along_u;  // with_hair

  UniqueNames ids;  // Mitsuba has one name space for everything
  std::vector<std::string> material_ids, medium_ids, prototype_ids;
  // It holds, for the meshes with each bsdf, whether the first is turned, and the bsdf for those that differ.
  struct Facing {
    bool turned = false;
    std::string other{};
  };
  std::map<std::string, Facing> facings{};
  // They are masks around materials, by the material and the opacity of a shape.
  std::map<std::pair<std::uint32_t, OpacityKey>, std::string> masks;
  std::vector<WrittenTexture> textures;
  mutable std::unordered_map<std::uint32_t, RGB> means;  // of the textures whose mean was asked for
  std::unordered_map<std::size_t, std::string>
      interiors;  // media inside of subsurface materials, by material
  // They are files of the images that lamps have, by texture and scale: many shapes may shine by one.
  std::map<std::pair<std::uint32_t, float>, std::string> lamp_images, lamp_grids;
  bool colored_extinction = false;  // of a medium that was written
  std::size_t unseen_lamps = 0;     // of the written scene (is_unseen_lamp), with those of instances
  std::size_t curve_files = 0, derived_meshes = 0, derived_images = 0, derived_volumes = 0;
  ConvertedImages images{[this] { return file.parent_path() / new_file("images", "exr", derived_images); }};
  BakedTextures baked{scene, [this] { return images.new_file(); }};

  // Returns an id for a record called `name`; a record without a name gets one that starts with "_unnamed_".
  std::string new_id(const std::string& name, const char* kind, std::size_t index);
  // Returns a file as the scene refers to it.
  std::string relative(const std::string& other);
  // Returns the path of a new file in OUT-`kind`/, which it creates; relative to the scene's.
  std::string new_file(const char* kind, const char* extension, std::size_t& counter) const;
};

using Element = pugi::xml_node;

Element add(Element parent, const char* tag, const std::string& type, const std::string& name = "",
            const std::string& id = "");
void add_value(Element parent, const char* tag, const std::string& name, const std::string& value);
void add_string(Element parent, const std::string& name, const std::string& value);
void add_integer(Element parent, const std::string& name, int value);
void add_boolean(Element parent, const std::string& name, bool value);
// Writes the fewest digits that give the same bits back. A value that is not finite becomes the nearest
// number, NaN zero.
template <class T>
void add_float(Element parent, const std::string& name, T value) {
  constexpr T largest = static_cast<T>(std::numeric_limits<float>::max());
  add_value(parent, "float", name,
            fmt::format("{}", value == value ? std::clamp(value, -largest, largest) : T(0)));
}
void add_reference(Element parent, const std::string& id, const std::string& name = "");
void add_transform(Element parent, const Transform& transform, const std::string& name = "to_world");
// Adds the vector's or point's three coordinates as attributes.
template <class T>
void add_coordinates(Element parent, const char* tag, const std::string& name, const T& v) {
  Element element = parent.append_child(tag);
  element.append_attribute("name") = name.c_str();
  element.append_attribute("x") = fmt::format("{}", v.x).c_str();
  element.append_attribute("y") = fmt::format("{}", v.y).c_str();
  element.append_attribute("z") = fmt::format("{}", v.z).c_str();
}

}  // namespace vitrail::mitsuba_writer
