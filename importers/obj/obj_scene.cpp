// SPDX-License-Identifier: Apache-2.0
#include "importers/obj/obj_scene.h"

#include <fmt/format.h>

#include <limits>
#include <map>
#include <set>

#include "importers/obj/mtl.h"
#include "importers/ply/text_cursor.h"
#include "scene/bounds.h"

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
  for (const Mention& statement : geometry.libraries) {
    // A name may hold blanks without backslashes.
    const bool is_one_name = std::filesystem::is_regular_file(folder / statement.name);
    for (const std::string& name : is_one_name ? std::vector{statement.name} : split_names(statement.name)) {
      if (!seen.insert(name).second) continue;
      if (std::filesystem::is_regular_file(folder / name)) {
        add_library(folder / name, library, diagnostics);
      } else {
        diagnostics.push_back({Fidelity::dropped,
                               fmt::format("material library '{}': there is no such file", printable(name)),
                               statement.location});
      }
    }
  }
  return library;
}

struct Surface {
  Id<Material> material;
  std::optional<Id<AreaLight>> light;
};

template <class T, class Value>
Id<T> append(std::vector<T>& to, Value value) {
  to.push_back(std::move(value));
  return {static_cast<std::uint32_t>(to.size() - 1)};
}

Surface add_surface(const Mention& use, const Library& library, ImportedScene& result) {
  const auto found = library.find(use.name);
  if (found == library.end()) {
    if (use.location.line > 0) {
      result.diagnostics.push_back(
          {Fidelity::approximated,
           fmt::format("material '{}' is not defined: diffuse, reflectance 0.5", printable(use.name)),
           use.location});
    }
    return {append(result.scene.materials, Material{DiffuseMaterial{}}), {}};
  }
  Surface surface{append(result.scene.materials, found->second.material), {}};
  if (found->second.light) surface.light = append(result.scene.area_lights, *found->second.light);
  return surface;
}

// ---- Meshes -------------------------------------------------------------------------------------

// Where a file's coordinates are much larger than its extent, floats would not hold its shape: what to
// subtract.
Vector3d offset_of(const std::vector<Point3d>& positions) {
  constexpr double far = 16;  // distance over half extent: four bits lost
  Bounds3d bounds;
  for (const Point3d& p : positions) extend(bounds, p);
  if (bounds.empty()) return {};
  const Vector3d away = center(bounds) - Point3d{}, half = extent(bounds) * 0.5;
  const bool is_far = length(away) > far * length(half) && length(half) > 0;
  return is_far ? cast<double>(cast<float>(away)) : Vector3d{};
}

class MeshBuilder {
 public:
  MeshBuilder(const Geometry& geometry, Vector3d offset)
      : geometry_(geometry), offset_(offset), first_(geometry.positions.size(), none) {}

  // Corners that agree in all indices become one vertex.
  TriangleMesh build(const Group& group) {
    mesh_ = {};
    vertices_.clear();
    const std::size_t step = group.indices_a_corner();
    mesh_.triangles.reserve(group.corners.size() / step / 3);
    std::array<std::uint32_t, 3> triangle{};
    for (std::size_t i = 0, corner = 0; i < group.corners.size(); i += step) {
      const std::uint32_t* index = &group.corners[i];
      const std::uint32_t position = *index++;
      const std::uint32_t uv = group.has_uvs ? *index++ : none;
      triangle[corner] = vertex({position, uv, group.has_normals ? *index : none, none});
      if (++corner == 3) {
        mesh_.triangles.push_back(triangle);
        corner = 0;
      }
    }
    for (const Vertex& v : vertices_) first_[v.position] = none;
    return std::move(mesh_);
  }

 private:
  static constexpr std::uint32_t none = std::numeric_limits<std::uint32_t>::max();

  struct Vertex {
    std::uint32_t position, uv, normal;
    std::uint32_t next;  // of the mesh's vertices at the same position
  };

  std::uint32_t vertex(Vertex wanted) {
    std::uint32_t* link = &first_[wanted.position];
    for (; *link != none; link = &vertices_[*link].next) {
      const Vertex& v = vertices_[*link];
      if (v.uv == wanted.uv && v.normal == wanted.normal) return *link;
    }
    const auto index = static_cast<std::uint32_t>(vertices_.size());
    *link = index;
    vertices_.push_back(wanted);
    mesh_.positions.push_back(cast<float>(geometry_.positions[wanted.position] - offset_));
    if (wanted.uv != none) mesh_.uvs.push_back(geometry_.uvs[wanted.uv]);
    if (wanted.normal != none) mesh_.normals.push_back(geometry_.normals[wanted.normal]);
    return index;
  }

  const Geometry& geometry_;
  Vector3d offset_;
  std::vector<std::uint32_t> first_;  // of the mesh's vertices at each position
  std::vector<Vertex> vertices_;
  TriangleMesh mesh_;
};

}  // namespace

ImportedScene to_scene(Geometry&& geometry, const std::filesystem::path& file) {
  ImportedScene result;
  result.diagnostics = std::move(geometry.diagnostics);
  const Library library = read_libraries(geometry, file.parent_path(), result.diagnostics);
  const Vector3d offset = offset_of(geometry.positions);
  MeshBuilder builder(geometry, offset);
  std::vector<std::optional<Surface>> surfaces(geometry.materials.size());
  for (Group& group : geometry.groups) {
    std::optional<Surface>& surface = surfaces[group.material];
    if (!surface) surface = add_surface(geometry.materials[group.material], library, result);
    Shape shape;
    shape.mesh = append(result.scene.meshes, builder.build(group));
    shape.material = surface->material;
    shape.area_light = surface->light;
    shape.object_to_world = translate(offset);
    result.scene.shapes.push_back(shape);
    group.corners = {};
  }
  return result;
}

}  // namespace vitrail::obj
