// SPDX-License-Identifier: Apache-2.0
// Meshes in files of their own.
#include <algorithm>
#include <cmath>
#include <numbers>

#include "importers/mitsuba/read/old_versions.h"
#include "importers/mitsuba/read/serialized.h"
#include "importers/mitsuba/read/shape_geometry.h"
#include "importers/obj/read/obj.h"
#include "importers/ply/read/ply.h"
#include "importers/shapes/creases.h"
#include "importers/shapes/vertex_normals.h"

namespace vitrail::mitsuba {

namespace {

// How a file is read. Every combination is a mesh of its own.
struct Reading {
  bool face_normals, flip_uvs;
  std::optional<double> crease_angle_deg;  // of 0.6
  int variant() const {
    const int angle = crease_angle_deg ? 1 + static_cast<int>(std::lround(*crease_angle_deg * 1e4)) : 0;
    return 4 * angle + 2 * face_normals + flip_uvs;
  }
};

Reading reading_of(Builder& builder, const Object& shape, bool flips) {
  Reading reading{shape.boolean("face_normals", false, builder.report),
                  shape.boolean("flip_tex_coords", flips, builder.report),
                  {}};
  if (!shape.has("max_smooth_angle")) return reading;
  const double degrees = shape.number("max_smooth_angle", 0, builder.report);
  if (!(degrees >= 0 && degrees <= 180))
    builder.report.fail("\"maxSmoothAngle\" has to be an angle from 0 to 180 degrees",
                        shape.find("max_smooth_angle")->origin);
  if (!reading.face_normals) reading.crease_angle_deg = degrees;
  return reading;
}

// Mitsuba shades smoothly wherever it is not told otherwise. Whether normals were made.
bool apply(const Reading& reading, TriangleMesh& mesh) {
  if (reading.flip_uvs)
    for (Point2f& uv : mesh.uvs) uv.y = 1 - uv.y;
  if (reading.face_normals) mesh.normals.clear();
  if (reading.crease_angle_deg) {
    mesh = with_creases(mesh, *reading.crease_angle_deg * std::numbers::pi / 180);
    return true;
  }
  if (reading.face_normals || !mesh.normals.empty()) return false;
  mesh.normals = smooth_normals(mesh);
  return true;
}

// Mitsuba makes them of what the transform leaves of the triangles, and so on the side of their winding
// there.
void report_smoothing(Builder& builder, const Object& shape) {
  const Transform t = shape.transform("to_world", builder.report);
  const auto column = [&](std::size_t i) { return Vector3d{t.m[0][i], t.m[1][i], t.m[2][i]}; };
  const double size = dot(column(0), column(0));
  constexpr double tolerance = 1e-5;  // of similar transforms in files
  for (std::size_t i = 0; i < 3; ++i) {
    const double other = dot(column(i), column((i + 1) % 3));
    if (std::abs(dot(column(i), column(i)) - size) < tolerance * size && std::abs(other) < tolerance * size)
      continue;
    return builder.report.approximated(
        "smooth normals are those of the mesh before its transform, which is no similarity", shape.origin);
  }
}

// (0,0) stands for texture coordinates that some faces have not.
TriangleMesh merge(std::vector<TriangleMesh> parts) {
  if (parts.size() == 1) return std::move(parts.front());
  TriangleMesh whole;
  bool uvs = false, normals = false;
  for (const TriangleMesh& part : parts) {
    uvs |= !part.uvs.empty();
    normals |= !part.normals.empty();
  }
  for (TriangleMesh& part : parts) {
    const std::size_t first = whole.positions.size(), count = part.positions.size();
    if (normals && part.normals.empty()) part.normals = smooth_normals(part);
    if (uvs) part.uvs.resize(count);
    whole.positions.insert(whole.positions.end(), part.positions.begin(), part.positions.end());
    whole.normals.insert(whole.normals.end(), part.normals.begin(), part.normals.end());
    whole.uvs.insert(whole.uvs.end(), part.uvs.begin(), part.uvs.end());
    for (auto triangle : part.triangles) {
      for (std::uint32_t& corner : triangle) corner += static_cast<std::uint32_t>(first);
      whole.triangles.push_back(triangle);
    }
    part = {};
  }
  return whole;
}

struct MeshFile {
  std::string kind;
  std::filesystem::path path;
  int index = 0;
  Reading reading;
  PlyAttributes attributes = PlyAttributes::read;
  std::optional<std::string> material = {};  // of obj: only the faces of this usemtl
};

// The faces of one material, out of what was read by materials.
TriangleMesh part_of(ObjGeometry& whole, const std::string& material) {
  std::vector<TriangleMesh> parts;
  for (std::size_t i = 0; i < whole.meshes.size(); ++i)
    if (whole.materials[i] == material) parts.push_back(std::move(whole.meshes[i]));
  return merge(std::move(parts));
}

// `known`: the file by materials, where it has been read.
TriangleMesh read_geometry(const MeshFile& file, Diagnostics& diagnostics, ObjGeometry* known) {
  const auto& [kind, path, index, reading, attributes, material] = file;
  if (kind == "serialized") return read_serialized(path, index);
  if (kind == "ply") return read_ply(path, &diagnostics, attributes);
  ObjGeometry geometry = known ? ObjGeometry{} : read_obj_geometry(path, material.has_value());
  ObjGeometry& read = known ? *known : geometry;
  diagnostics = std::move(read.diagnostics);
  return material ? part_of(read, *material) : merge(std::move(read.meshes));
}

TriangleMesh read_mesh(const MeshFile& file, Diagnostics& diagnostics, bool& smoothed,
                       ObjGeometry* known = nullptr) {
  TriangleMesh mesh = read_geometry(file, diagnostics, known);
  mesh.missing_uv = MissingUv::barycentric;
  smoothed = apply(file.reading, mesh);
  return mesh;
}

// `part`: which of the file's meshes it is, for the key.
ShapeGeometry geometry_of(Builder& builder, const Object& shape, const MeshFile& file, int part,
                          ObjGeometry* known = nullptr) {
  bool smoothed = false;
  const MeshKey key{file.path.string(), part, file.reading.variant()};
  const auto read = [&] {
    Diagnostics diagnostics;
    TriangleMesh made = read_mesh(file, diagnostics, smoothed, known);
    builder.report.add(std::move(diagnostics));
    return made;
  };
  const auto read_again = [file] {
    Diagnostics said;
    bool smooth = false;
    return read_mesh(file, said, smooth);
  };
  const Id<TriangleMesh> mesh = shared_mesh(builder, shape, key, read, read_again);
  if (smoothed) builder.smoothed_meshes.insert(mesh.value);
  const bool was_smoothed = builder.smoothed_meshes.contains(mesh.value);
  if (was_smoothed) report_smoothing(builder, shape);
  return {.mesh = mesh, .front_by_normals = !file.reading.face_normals && !was_smoothed};
}

// The bsdf that is given for the faces of a usemtl. The names of bsdfs are those of today by now.
const Property* bsdf_named(const std::vector<const Property*>& bsdfs, const std::string& name) {
  const auto found = std::ranges::find_if(bsdfs, [&](const Property* bsdf) {
    return bsdf->name == name || (!bsdf->name.empty() && bsdf->name == name_of_today(name));
  });
  return found == bsdfs.end() ? nullptr : *found;
}

// Of an obj that is given a bsdf for each name in it, as in 0.6: those names, in the order of the file. Empty
// where none of the bsdfs has such a name.
std::vector<std::string> named_parts(const std::vector<const Property*>& bsdfs, const ObjGeometry& file) {
  std::vector<std::string> names;
  bool any = false;
  for (const std::string& name : file.materials) {
    if (std::ranges::count(names, name) == 0) names.push_back(name);
    any |= bsdf_named(bsdfs, name) != nullptr;
  }
  return any ? names : std::vector<std::string>{};
}

}  // namespace

std::vector<ShapeGeometry> shapes_of_file(Builder& builder, const Object& shape) {
  const std::string kind = kind_of(shape);
  const bool obj = kind == "obj", ply = kind == "ply";
  if (!obj && !ply && kind != "serialized") return {};
  MeshFile file{kind, shape_file(builder, shape), 0, reading_of(builder, shape, obj)};
  if (kind == "serialized") file.index = shape.integer("shape_index", 0, builder.report);
  // 0.6 decodes them as sRGB, 3 takes the numbers as they are.
  if (shape.boolean("colors_in_srgb", false, builder.report) && shape.boolean("srgb", true, builder.report))
    file.attributes = PlyAttributes::colors;
  const auto bsdfs = shape.children("bsdf");
  ObjGeometry by_material;
  if (obj && bsdfs.size() > 1) by_material = read_obj_geometry(file.path, true);
  const std::vector<std::string> parts = named_parts(bsdfs, by_material);
  if (parts.empty()) return {geometry_of(builder, shape, file, file.index)};
  std::vector<ShapeGeometry> geometries;
  for (std::size_t i = 0; i < parts.size(); ++i) {
    file.material = parts[i];
    geometries.push_back(geometry_of(builder, shape, file, static_cast<int>(i) + 1, &by_material));
    geometries.back().part = parts[i];
    geometries.back().bsdf = bsdf_named(bsdfs, parts[i]);
  }
  return geometries;
}

}  // namespace vitrail::mitsuba
