// SPDX-License-Identifier: Apache-2.0
#include "importers/obj/read/obj_scene.h"

#include <fmt/format.h>

#include <algorithm>
#include <map>
#include <set>

#include "importers/bytes/text_cursor.h"
#include "importers/obj/read/mtl.h"
#include "importers/obj/read/mtl_map.h"
#include "importers/obj/read/obj_meshes.h"
#include "importers/obj/read/open_glass.h"
#include "scene/models/turned_normal_maps.h"

namespace vitrail::obj {

namespace {

// ---- Materials ----------------------------------------------------------------------------------

// The names in a mtllib statement: blanks divide them, unless a backslash stands before.
std::vector<std::string> split_names(const std::string& text) {
  std::vector<std::string> names(1);
  for (std::size_t i = 0; i < text.size(); ++i) {
    if (text[i] == '\\' && i + 1 < text.size() && text[i + 1] == ' ') {
      names.back() += text[++i];
    } else if (text[i] != ' ' && text[i] != '\t') {
      names.back() += text[i];
    } else if (!names.back().empty()) {
      names.emplace_back();
    }
  }
  if (names.back().empty()) names.pop_back();
  return names;
}

using Library = std::map<std::string, MtlMaterial>;

// In the OBJ file, which is the first of the Scene's.
Origin origin_of(const SourceLocation& where) {
  return {0, static_cast<std::uint32_t>(where.line), static_cast<std::uint32_t>(where.column)};
}

void add_library(const std::filesystem::path& file, Library& library, Diagnostics& diagnostics) {
  for (MtlMaterial& material : read_mtl(file, diagnostics)) {
    const SourceLocation where = material.location;
    const std::string name = material.name;
    if (!library.try_emplace(name, std::move(material)).second) {
      diagnostics.push_back(
          {Fidelity::dropped, fmt::format("second definition of material {}", printable(name)), where});
    }
  }
}

Library read_libraries(const Geometry& geometry, const std::filesystem::path& folder,
                       Diagnostics& diagnostics) {
  Library library;
  std::set<std::string> seen;
  // Names too long for the file system are no files either.
  const auto is_file = [](const std::filesystem::path& path) {
    std::error_code ignored;
    return std::filesystem::is_regular_file(path, ignored);
  };
  for (const Mention& statement : geometry.libraries) {
    // A name may hold blanks without backslashes.
    const bool is_one_name = is_file(folder / statement.name);
    for (const std::string& name : is_one_name ? std::vector{statement.name} : split_names(statement.name)) {
      if (!seen.insert(name).second) continue;
      if (const std::string file = find_named_file(name, folder); !file.empty()) {
        add_library(file, library, diagnostics);
      } else {
        diagnostics.push_back({Fidelity::dropped,
                               fmt::format("material library '{}': there is no such file", printable(name)),
                               statement.location});
      }
    }
  }
  return library;
}

template <class T, class Value>
Id<T> append(std::vector<T>& to, Value value) {
  to.push_back(std::move(value));
  return {static_cast<std::uint32_t>(to.size() - 1)};
}

// Where no library says how to shade, the `colors` of vertices do.
MtlSurface add_surface(const Mention& use, const Library& library, bool has_colors,
                       std::optional<Id<Texture>> colors, MtlTextures& textures, ImportedScene& result) {
  const auto found = library.find(use.name);
  if (found != library.end()) {
    if (has_colors)
      result.diagnostics.push_back(
          {Fidelity::dropped,
           fmt::format("colours of vertices: material '{}' of a library counts", printable(use.name)),
           use.location, use.location});
    return add_mtl_material(found->second, textures, result.scene, result.diagnostics);
  }
  if (use.location.line > 0) {
    result.diagnostics.push_back(
        {Fidelity::approximated,
         fmt::format("material '{}' is not defined: diffuse, {}", printable(use.name),
                     colors ? "of the colours of its vertices" : "reflectance 0.5"),
         use.location, use.location});
  }
  Material material{colors ? DiffuseMaterial{*colors} : DiffuseMaterial{}};
  material.name = printable(use.name, longest_mtl_name);
  material.origin = origin_of(use.location);
  return {append(result.scene.materials, std::move(material)), {}};
}

// The lamps of objects: each object that shines is one of its own, though others have its material.
class Lamps {
 public:
  explicit Lamps(Scene& scene) : scene_(scene) {}

  Id<AreaLight> of(std::size_t object, Id<AreaLight> light_of_material, Id<Material> material) {
    const auto [known, is_new] = lamps_.try_emplace({object, light_of_material.value});
    if (!is_new) return known->second.light;
    const bool first = taken_.insert(light_of_material.value).second;
    known->second = {first
                         ? light_of_material
                         : append(scene_.area_lights, AreaLight(scene_.area_lights[light_of_material.value])),
                     material};
    return known->second.light;
  }

  // By the object, or by the material where the object has no name or shines by several.
  void name_all(const std::vector<std::string>& objects) {
    std::vector<std::size_t> lamps_of(objects.size());
    for (const auto& [key, lamp] : lamps_) ++lamps_of[key.first];
    for (const auto& [key, lamp] : lamps_) {
      const bool by_object = lamps_of[key.first] == 1 && !objects[key.first].empty();
      scene_.area_lights[lamp.light.value].name =
          by_object ? objects[key.first] : scene_.materials[lamp.material.value].name;
    }
  }

 private:
  struct Lamp {
    Id<AreaLight> light;
    Id<Material> material;
  };
  Scene& scene_;
  std::map<std::pair<std::size_t, std::uint32_t>, Lamp> lamps_;  // by object and light of the material
  std::set<std::uint32_t> taken_;
};

bool is_of(std::optional<Id<Texture>> colors, const Material& material) {
  const auto* diffuse = std::get_if<DiffuseMaterial>(&material.model);
  return colors && diffuse && diffuse->reflectance == SpectrumParameter{*colors};
}

}  // namespace

ImportedScene to_scene(Geometry&& geometry, Vector3d offset, const std::filesystem::path& file) {
  ImportedScene result;
  result.scene.files = {file.string()};
  result.diagnostics = std::move(geometry.diagnostics);
  const Library library = read_libraries(geometry, file.parent_path(), result.diagnostics);
  std::optional<Id<Texture>> colors;
  const bool has_colors = !geometry.colors.empty();
  if (has_colors && std::ranges::any_of(geometry.groups, [&](const Group& group) {
        return !library.contains(geometry.materials[group.material].name);
      }))
    colors = append(result.scene.textures, Texture{MeshAttributeTexture{std::string(vertex_color)}});
  std::vector<std::string> objects;
  for (const Object& object : geometry.objects)
    objects.push_back(printable(name_of(object, geometry), longest_mtl_name));
  MtlTextures textures;
  Lamps lamps(result.scene);
  std::vector<std::optional<MtlSurface>> surfaces(geometry.materials.size());
  for (const Group& group : geometry.groups) {
    std::optional<MtlSurface>& surface = surfaces[group.material];
    if (!surface)
      surface =
          add_surface(geometry.materials[group.material], library, has_colors, colors, textures, result);
    Shape shape;
    shape.mesh = {static_cast<std::uint32_t>(result.scene.shapes.size())};
    shape.material = surface->material;
    if (surface->light) shape.area_light = lamps.of(group.object, *surface->light, surface->material);
    shape.object_to_world = translate(offset);
    shape.name = objects[group.object];
    shape.origin = origin_of(shape.name.empty() ? geometry.materials[group.material].location
                                                : geometry.objects[group.object].location);
    result.scene.shapes.push_back(shape);
  }
  lamps.name_all(objects);
  result.scene.meshes = to_meshes(std::move(geometry));
  for (const Shape& shape : result.scene.shapes)
    if (!is_of(colors, result.scene.materials[shape.material.value]))
      result.scene.meshes[shape.mesh.value].attributes.clear();
  for (TriangleMesh& mesh : result.scene.meshes) mesh.missing_uv = MissingUv::zero;
  make_open_glass_thin(result);
  turn_normal_maps(result.scene);
  return result;
}

}  // namespace vitrail::obj
