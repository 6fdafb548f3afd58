// SPDX-License-Identifier: Apache-2.0
// Shapes whose vertices stand in the file: "trianglemesh", "bilinearmesh" and "loopsubdiv".
#include <fmt/format.h>

#include <cmath>
#include <string_view>

#include "importers/pbrt/read/mesh_fronts.h"
#include "importers/pbrt/read/ply_meshes.h"
#include "importers/pbrt/read/shapes.h"
#include "importers/reading/skimmed_scene.h"
#include "importers/shapes/shapes.h"
#include "scene/geometry/bounds.h"
#include "scene/shapes/mesh_uv.h"

namespace vitrail::pbrt {

namespace {

void require_groups(const Parameter& parameter, std::size_t size) {
  if (number_count(parameter) % size == 0) return;
  fail(fmt::format("parameter \"{}\" has {} numbers, which is not a multiple of {}", parameter.name,
                   number_count(parameter), size),
       parameter.place);
}

// Floats of a parameter in groups of `size`, less the offset; values too large for a float throw Error.
template <class T, std::size_t size>
std::vector<T> tuples(Parameter& parameter, Vector3d offset = {}) {
  require_groups(parameter, size);
  std::vector<T> result;
  result.reserve(number_count(parameter) / size);
  prefer_huge_pages(result.data(), result.capacity());
  consume_numbers(parameter, size, [&](auto values) {
    for (std::size_t i = 0; i < values.size(); i += size) {
      std::array<float, size> v;
      for (std::size_t k = 0; k < size; ++k) {
        v[k] = static_cast<float>(static_cast<double>(values[i + k]) - offset[static_cast<int>(k)]);
        if (!std::isfinite(v[k]))
          fail(fmt::format("value {} of parameter \"{}\" is too large", size * result.size() + k,
                           parameter.name),
               parameter.place);
      }
      if constexpr (size == 3)
        result.push_back({v[0], v[1], v[2]});
      else
        result.push_back({v[0], v[1]});
    }
  });
  return result;
}

template <std::size_t size>
std::vector<std::array<std::uint32_t, size>> index_groups(Parameter& parameter, std::size_t vertex_count) {
  require_groups(parameter, size);
  std::vector<std::array<std::uint32_t, size>> groups;
  groups.reserve(number_count(parameter) / size);
  prefer_huge_pages(groups.data(), groups.capacity());
  consume_numbers(parameter, size, [&](auto values) {
    for (std::size_t i = 0; i < values.size(); i += size) {
      std::array<std::uint32_t, size> group;
      for (std::size_t k = 0; k < size; ++k) {
        const auto index = static_cast<double>(values[i + k]);
        if (index < 0 || index >= static_cast<double>(vertex_count))
          fail(fmt::format("value {} of parameter \"{}\" is {}, but there are {} vertices (counted from 0)",
                           size * groups.size() + k, parameter.name, index, vertex_count),
               parameter.place);
        group[k] = static_cast<std::uint32_t>(index);
      }
      groups.push_back(group);
    }
  });
  return groups;
}

// Values a vertex; empty where the parameter is absent.
template <class T, std::size_t size>
std::vector<T> vertex_values(Parameter* parameter, std::size_t vertex_count) {
  if (!parameter) return {};
  std::vector<T> values = tuples<T, size>(*parameter);
  if (values.size() != vertex_count)
    fail(fmt::format("parameter \"{}\" has values for {} vertices, but there are {}", parameter->name,
                     values.size(), vertex_count),
         parameter->place);
  return values;
}

Parameter& required_list(ParameterSet& parameters, std::string_view name) {
  Parameter* parameter = parameters.find_list(name);
  if (!parameter || number_count(*parameter) == 0)
    fail(fmt::format("{} needs a parameter \"{}\"", parameters.owner(), name), parameters.place());
  return *parameter;
}

Parameter* texture_coordinates(ParameterSet& parameters) {
  Parameter* uv = parameters.find_list("uv");
  return uv ? uv : parameters.find_list("st");
}

// The corners of one triangle or patch where no indices are given.
template <std::size_t size>
std::vector<std::array<std::uint32_t, size>> groups_of(ParameterSet& parameters, std::size_t vertex_count) {
  if (Parameter* indices = parameters.find_list("indices")) return index_groups<size>(*indices, vertex_count);
  if (vertex_count != size)
    fail(fmt::format("{} needs a parameter \"indices\" unless it has exactly {} points", parameters.owner(),
                     size),
         parameters.place());
  std::array<std::uint32_t, size> all{};
  for (std::size_t i = 0; i < size; ++i) all[i] = static_cast<std::uint32_t>(i);
  return {all};
}

// Floats keep 24 bits: of a mesh that lies so far from the origin that more than ten are lost, positions are
// moved to it while they are still doubles. Nearer ones stay, so that meshes which touch still share their
// vertices exactly.
Vector3d offset_of(const Parameter& parameter) {
  constexpr double far = 1024;  // distance over half extent
  Bounds3d bounds;
  const auto extend_by = [&](const auto& p) {
    for (std::size_t i = 0; i + 2 < p.size(); i += 3)
      extend(bounds, Point3d{static_cast<double>(p[i]), static_cast<double>(p[i + 1]),
                             static_cast<double>(p[i + 2])});
  };
  if (parameter.long_list)
    std::visit(
        [&]<class List>(const List& list) {
          if constexpr (!std::is_same_v<List, SkippedNumbers>) extend_by(list);
        },
        *parameter.long_list);
  else
    extend_by(parameter.numbers);
  const double half = length(extent(bounds)) / 2;
  const Vector3d away = cast<double>(cast<float>(center(bounds) - Point3d{}));
  return !bounds.empty() && half > 0 && length(away) > far * half ? away : Vector3d{};
}

}  // namespace

// pbrt leaves out numbers that are not as many as the faces.
std::vector<float> ShapeMaker::face_numbers(ParameterSet& parameters, std::size_t faces, bool show) {
  Parameter* numbers = parameters.find_list("faceIndices");
  if (!numbers || !show) return {};
  if (number_count(*numbers) != faces) {
    context_.report.dropped(
        fmt::format("\"faceIndices\" are {}, but there are {} faces", number_count(*numbers), faces),
        numbers->place);
    return {};
  }
  std::vector<float> values;
  consume_numbers(*numbers, 1, [&](auto chunk) {
    for (const auto value : chunk) values.push_back(static_cast<float>(value));
  });
  return values;
}

// Numbers of a parameter that may be absent.
static std::uint64_t count_of(const Parameter* parameter) { return parameter ? number_count(*parameter) : 0; }

// What stands for a mesh of which some list is counted alone. Positions are held as doubles beside the floats
// that they become, and lists have some room.
std::optional<ShapeGeometry> ShapeMaker::skimmed_mesh(ParameterSet& parameters) {
  const Parameter *points = parameters.find_list("P"), *indices = parameters.find_list("indices"),
                  *normals = parameters.find_list("N"), *uvs = texture_coordinates(parameters);
  const auto is_skipped = [](const Parameter* p) {
    return p && p->long_list && std::holds_alternative<SkippedNumbers>(*p->long_list);
  };
  if (!context_.skim || (!is_skipped(points) && !is_skipped(indices))) return std::nullopt;
  const std::uint64_t values = count_of(points),
                      others = count_of(indices) + count_of(normals) + count_of(uvs);
  const auto bytes = [](double each, std::uint64_t count) {
    return static_cast<std::uint64_t>(each * static_cast<double>(count));
  };
  context_.skim->statement_bytes =
      std::max(context_.skim->statement_bytes, bytes(12.5, values) + bytes(4.25, others));
  return add_skimmed(count_of(indices) / 3, 4 * (values + others), normals != nullptr);
}

ShapeGeometry ShapeMaker::add_skimmed(std::uint64_t triangles, std::uint64_t bytes, bool has_normals) {
  meshes_.push_back(counted_mesh(triangles, bytes, has_normals));
  return {{static_cast<std::uint32_t>(meshes_.size() - 1)}, false, {}, triangles};
}

ShapeGeometry ShapeMaker::triangle_mesh(ParameterSet& parameters, bool uvs_show, bool faces_show) {
  if (const auto skimmed = skimmed_mesh(parameters)) return *skimmed;
  TriangleMesh mesh;
  Parameter& positions = required_list(parameters, "P");
  require_groups(positions, 3);
  const Vector3d offset = offset_of(positions);
  mesh.positions = tuples<Point3f, 3>(positions, offset);
  mesh.triangles = groups_of<3>(parameters, mesh.positions.size());
  mesh.normals = vertex_values<Normal3f, 3>(parameters.find_list("N"), mesh.positions.size());
  mesh.uvs = vertex_values<Point2f, 2>(texture_coordinates(parameters), mesh.positions.size());
  orient_by_normals(mesh, uvs_show);
  const std::size_t parts = mesh.triangles.size();
  add_face_indices(mesh, face_numbers(parameters, parts, faces_show));
  return {add(std::move(mesh)), false, translate(offset), parts};
}

ShapeGeometry ShapeMaker::bilinear_mesh(ParameterSet& parameters, bool uvs_show, bool faces_show) {
  const std::vector<Point3f> positions = tuples<Point3f, 3>(required_list(parameters, "P"));
  const auto patches = groups_of<4>(parameters, positions.size());
  const auto normals = vertex_values<Normal3f, 3>(parameters.find_list("N"), positions.size());
  const auto uvs = vertex_values<Point2f, 2>(texture_coordinates(parameters), positions.size());
  TriangleMesh mesh = tessellate_bilinear(positions, patches, normals, uvs, uvs_show);
  if (mesh.triangles.size() > 2 * patches.size()) report_patches(parameters.place());
  orient_by_normals(mesh, uvs_show);
  add_face_indices(mesh, face_numbers(parameters, patches.size(), faces_show));
  return {add(std::move(mesh)), false, {}, patches.size()};
}

// pbrt's normals of a subdivided mesh point against its winding (the ring of a vertex is walked clockwise),
// and its front follows them.
ShapeGeometry ShapeMaker::loop_subdivision(ParameterSet& parameters, bool uvs_show) {
  constexpr int most_levels = 10;
  TriangleMesh cage;
  cage.positions = tuples<Point3f, 3>(required_list(parameters, "P"));
  cage.triangles = index_groups<3>(required_list(parameters, "indices"), cage.positions.size());
  const int levels = parameters.integer("levels", parameters.integer("nlevels", 3));
  if (levels < 0 || levels > most_levels)
    fail(fmt::format("subdivision levels are {}, which is not between 0 and {}", levels, most_levels),
         parameters.place());
  parameters.ignore({"scheme"});
  TriangleMesh mesh;
  try {
    mesh = loop_subdivide(cage, levels);
  } catch (const Error& error) {
    fail(error.what(), parameters.place());
  }
  for (Normal3f& normal : mesh.normals) normal = -normal;
  turn_round(mesh, uvs_show);
  const std::size_t parts = mesh.triangles.size();
  return {add(std::move(mesh)), false, {}, parts};
}

}  // namespace vitrail::pbrt
