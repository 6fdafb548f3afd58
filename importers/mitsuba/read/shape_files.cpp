// SPDX-License-Identifier: Apache-2.0
// Meshes in files of their own.
#include <cmath>

#include "importers/mitsuba/read/serialized.h"
#include "importers/mitsuba/read/shape_geometry.h"
#include "importers/obj/read/obj.h"
#include "importers/ply/read/ply.h"
#include "importers/shapes/vertex_normals.h"

namespace vitrail::mitsuba {

namespace {

// How a file is read. Every combination is a mesh of its own.
struct Reading {
  bool face_normals, flip_uvs;
  int variant() const { return 2 * face_normals + flip_uvs; }
};

// Mitsuba shades smoothly wherever it is not told otherwise: whether normals have to be made.
bool apply(const Reading& reading, TriangleMesh& mesh) {
  if (reading.flip_uvs)
    for (Point2f& uv : mesh.uvs) uv.y = 1 - uv.y;
  if (reading.face_normals) mesh.normals.clear();
  return !reading.face_normals && mesh.normals.empty();
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
};

TriangleMesh read_geometry(const MeshFile& file, Diagnostics& diagnostics) {
  const auto& [kind, path, index, reading, attributes] = file;
  if (kind == "serialized") return read_serialized(path, index);
  if (kind == "ply") return read_ply(path, &diagnostics, attributes);
  ObjGeometry geometry = read_obj_geometry(path);
  diagnostics = std::move(geometry.diagnostics);
  return merge(std::move(geometry.meshes));
}

TriangleMesh read_mesh(const MeshFile& file, Diagnostics& diagnostics, bool& smoothed) {
  TriangleMesh mesh = read_geometry(file, diagnostics);
  mesh.missing_uv = MissingUv::barycentric;
  smoothed = apply(file.reading, mesh);
  if (smoothed) mesh.normals = smooth_normals(mesh);
  return mesh;
}

}  // namespace

std::optional<ShapeGeometry> shape_of_file(Builder& builder, const Object& shape) {
  const std::string kind = kind_of(shape);
  const bool obj = kind == "obj", ply = kind == "ply";
  if (!obj && !ply && kind != "serialized") return std::nullopt;
  const std::filesystem::path path = shape_file(builder, shape);
  const Reading reading{shape.boolean("face_normals", false, builder.report),
                        shape.boolean("flip_tex_coords", obj, builder.report)};
  const int index = obj || ply ? 0 : shape.integer("shape_index", 0, builder.report);
  bool smoothed = false;
  const MeshKey key{path.string(), index, reading.variant()};
  // 0.6 decodes them as sRGB, 3 takes the numbers as they are.
  const bool decoded =
      shape.boolean("colors_in_srgb", false, builder.report) && shape.boolean("srgb", true, builder.report);
  const MeshFile file{kind, path, index, reading, decoded ? PlyAttributes::colors : PlyAttributes::read};
  const auto read = [&] {
    Diagnostics diagnostics;
    TriangleMesh made = read_mesh(file, diagnostics, smoothed);
    builder.report.add(std::move(diagnostics));
    return made;
  };
  const auto read_again = [file] {
    Diagnostics known;
    bool smooth = false;
    return read_mesh(file, known, smooth);
  };
  const Id<TriangleMesh> mesh = shared_mesh(builder, shape, key, read, read_again);
  if (smoothed) builder.smoothed_meshes.insert(mesh.value);
  const bool was_smoothed = builder.smoothed_meshes.contains(mesh.value);
  if (was_smoothed) report_smoothing(builder, shape);
  return ShapeGeometry{mesh, {}, !reading.face_normals && !was_smoothed};
}

}  // namespace vitrail::mitsuba
