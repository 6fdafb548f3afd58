// SPDX-License-Identifier: Apache-2.0
#include "importers/obj/write/write_obj.h"

#include <algorithm>
#include <map>
#include <unordered_map>

#include "importers/obj/write/write_mtl.h"
#include "importers/writing/flat_shapes.h"
#include "importers/writing/mapped_uvs.h"
#include "importers/writing/own_scene.h"
#include "importers/writing/side_files.h"
#include "importers/writing/text_sink.h"
#include "scene/records/uv_uses.h"
#include "scene/shapes/deferred_mesh.h"
#include "scene/shapes/mesh_uv.h"
#include "scene/spectra/color.h"

namespace vitrail {

namespace {

struct Counts {
  std::uint64_t positions = 0, uvs = 0, normals = 0;
};

bool is_translation(const Transform& t) {
  Transform still = t;
  for (std::size_t axis = 0; axis < 3; ++axis) still.m[axis][3] = 0;
  return still == Transform{};
}

// Behind each position its colour, as readers take it: in sRGB's encoding, within 0 to 1.
void put_coloured_positions(const TriangleMesh& mesh, const MeshAttribute& colors, const Transform& to_world,
                            TextSink& out) {
  const auto encoded = [](float linear) {
    return static_cast<float>(srgb_encode(std::clamp(static_cast<double>(linear), 0.0, 1.0)));
  };
  for (std::size_t i = 0; i < mesh.positions.size(); ++i) {
    const auto put = [&, rgb = &colors.values[3 * i]](const auto& p) {
      out.put(FMT_COMPILE("v {} {} {} {} {} {}\n"), p.x, p.y, p.z, encoded(rgb[0]), encoded(rgb[1]),
              encoded(rgb[2]));
    };
    if (to_world == Transform{})
      put(mesh.positions[i]);
    else
      put(transform_point(to_world, cast<double>(mesh.positions[i])));
  }
}

void put_vertices(const TriangleMesh& mesh, const Transform& to_world, TextSink& out) {
  if (const MeshAttribute* colors = vertex_colors(mesh)) {
    put_coloured_positions(mesh, *colors, to_world, out);
  } else if (to_world == Transform{}) {
    for (const Point3f& p : mesh.positions) out.put(FMT_COMPILE("v {} {} {}\n"), p.x, p.y, p.z);
  } else {
    for (const Point3f& p : mesh.positions) {
      const Point3d q = transform_point(to_world, cast<double>(p));
      out.put(FMT_COMPILE("v {} {} {}\n"), q.x, q.y, q.z);
    }
  }
  const bool is_still = is_translation(to_world);
  for (const Normal3f& n : mesh.normals) {
    const Normal3f moved =
        is_still ? n
                 : cast<float>(to_normal(normalize(to_vector(transform_normal(to_world, cast<double>(n))))));
    out.put(FMT_COMPILE("vn {} {} {}\n"), moved.x, moved.y, moved.z);
  }
}

// Corners v/vt/vn whose three indices agree but for where the mesh's positions, (u,v) and normals start.
void put_faces(const TriangleMesh& mesh, bool flip, const Counts& before, TextSink& out) {
  const std::uint64_t v = before.positions + 1, t = before.uvs + 1, n = before.normals + 1;
  for (const auto& triangle : mesh.triangles) {
    const std::uint64_t a = triangle[0], b = triangle[flip ? 2 : 1], c = triangle[flip ? 1 : 2];
    if (mesh.uvs.empty() && mesh.normals.empty())
      out.put(FMT_COMPILE("f {} {} {}\n"), v + a, v + b, v + c);
    else if (mesh.normals.empty())
      out.put(FMT_COMPILE("f {}/{} {}/{} {}/{}\n"), v + a, t + a, v + b, t + b, v + c, t + c);
    else if (mesh.uvs.empty())
      out.put(FMT_COMPILE("f {}//{} {}//{} {}//{}\n"), v + a, n + a, v + b, n + b, v + c, n + c);
    else
      out.put(FMT_COMPILE("f {}/{}/{} {}/{}/{} {}/{}/{}\n"), v + a, t + a, n + a, v + b, t + b, n + b, v + c,
              t + c, n + c);
  }
}

// Shapes without names that are one lamp are one object: readers take each object for a lamp.
std::string object_name(const Scene& scene, const Shape& shape, std::size_t index) {
  const AreaLight* const light = shape.area_light ? &scene.area_lights.at(shape.area_light->value) : nullptr;
  std::string name = !shape.name.empty() || !light ? shape.name : light->name;
  if (name.empty())
    return light ? fmt::format("lamp_{}", shape.area_light->value + 1) : fmt::format("shape_{}", index);
  std::ranges::replace_if(
      name, [](char c) { return static_cast<unsigned char>(c) <= ' '; }, '_');
  return name;
}

// (u,v) that a reader would take for (0,0), where they show.
bool lacks_uvs(const TriangleMesh& mesh, bool uvs_show) {
  return uvs_show && mesh.uvs.empty() && mesh.missing_uv != MissingUv::zero;
}

void put_geometry(const Scene& scene, const std::vector<FlatShape>& shapes, const MtlNames& names,
                  TextSink& out) {
  const std::vector<bool> uvs_show = meshes_whose_uvs_show(scene);
  Counts counts;
  std::unordered_map<std::uint32_t, std::uint64_t> first_uvs;  // of meshes: instances share them
  std::string material;
  for (std::size_t i = 0; i < shapes.size(); ++i) {
    const Shape& shape = shapes[i].shape;
    TriangleMesh storage, apart;
    const TriangleMesh& shared = loaded(scene.meshes.at(shape.mesh.value), storage);
    const bool lacking = lacks_uvs(shared, uvs_show[shape.mesh.value]);
    if (lacking) apart = with_uvs(shared);
    const TriangleMesh& mesh = lacking ? apart : shared;
    out.put(FMT_COMPILE("o {}\n"), object_name(scene, shape, i));
    put_vertices(mesh, shapes[i].object_to_world, out);
    const auto [first_uv, is_new] = first_uvs.emplace(shape.mesh.value, counts.uvs);
    if (is_new)
      for (const Point2f& uv : mesh.uvs) out.put(FMT_COMPILE("vt {} {}\n"), uv.x, uv.y);
    const std::string& name = names.at(surface_key(shape));
    if (name != material) out.put(FMT_COMPILE("usemtl {}\n"), name);
    material = name;
    put_faces(mesh, shapes[i].flip, {counts.positions, first_uv->second, counts.normals}, out);
    counts.positions += mesh.positions.size();
    if (is_new) counts.uvs += mesh.uvs.size();
    counts.normals += mesh.normals.size();
  }
}

void note_attributes(const TriangleMesh& mesh, const FlatShape& flat, ConversionNotes& notes) {
  const MeshAttribute* colors = vertex_colors(mesh);
  if (mesh.attributes.size() > (colors ? 1 : 0))
    notes.dropped("attributes of a mesh: OBJ has colours of vertices alone", flat.shape.origin,
                  RecordKind::shape);
  const auto outside = [](float value) { return value < 0 || value > 1; };
  if (colors && std::ranges::any_of(colors->values, outside))
    notes.approximated("colours of vertices outside of 0 to 1: the nearest of these", flat.shape.origin,
                       RecordKind::shape);
}

}  // namespace

Diagnostics write_obj(const Scene& given, const std::filesystem::path& path) {
  const std::optional<MappedUvs> mapped = with_mapped_uvs(given, is_unturned);
  const Scene& scene = mapped ? mapped->scene : given;
  ConversionNotes notes(scene);
  note(notes, mapped);
  note_geometry_only(notes);
  const std::vector<FlatShape> shapes = flat_shapes(scene);
  for (const FlatShape& flat : shapes) note_attributes(scene.meshes.at(flat.shape.mesh.value), flat, notes);
  const std::filesystem::path library = path.parent_path() / SideFiles(path).name("mtl");
  note_quadrics(shapes, notes);
  const MtlNames names = write_mtl(shapes, library, notes);
  AtomicFile file(path);
  TextSink out(&file);
  out.put(FMT_COMPILE("# {}\nmtllib {}\n"), scene_signature, library.filename().string());
  put_geometry(scene, shapes, names, out);
  out.flush();
  file.commit();
  return notes.take();
}

}  // namespace vitrail
