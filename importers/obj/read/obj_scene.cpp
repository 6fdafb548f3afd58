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
Origin origin_of(const Mention& mention) {
  return {0, static_cast<std::uint32_t>(mention.location.line),
          static_cast<std::uint32_t>(mention.location.column)};
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
  material.origin = origin_of(use);
  return {append(result.scene.materials, std::move(material)), {}};
}

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
  MtlTextures textures;
  std::vector<std::optional<MtlSurface>> surfaces(geometry.materials.size());
  for (const Group& group : geometry.groups) {
    std::optional<MtlSurface>& surface = surfaces[group.material];
    if (!surface)
      surface =
          add_surface(geometry.materials[group.material], library, has_colors, colors, textures, result);
    Shape shape;
    shape.mesh = {static_cast<std::uint32_t>(result.scene.shapes.size())};
    shape.material = surface->material;
    shape.area_light = surface->light;
    shape.object_to_world = translate(offset);
    shape.origin = origin_of(geometry.materials[group.material]);
    result.scene.shapes.push_back(shape);
  }
  result.scene.meshes = to_meshes(std::move(geometry));
  for (const Shape& shape : result.scene.shapes)
    if (!is_of(colors, result.scene.materials[shape.material.value]))
      result.scene.meshes[shape.mesh.value].attributes.clear();
  for (TriangleMesh& mesh : result.scene.meshes) mesh.missing_uv = MissingUv::zero;
  make_open_glass_thin(result);
  return result;
}

}  // namespace vitrail::obj
