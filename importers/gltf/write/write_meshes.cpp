// SPDX-License-Identifier: Apache-2.0
#include "importers/gltf/write/write_meshes.h"

#include <algorithm>
#include <cmath>

#include "importers/writing/placed_quadric.h"
#include "scene/records/uv_uses.h"
#include "scene/shapes/deferred_mesh.h"
#include "scene/shapes/mesh_uv.h"

namespace vitrail::gltf {

namespace {

std::span<const float> numbers_of(const std::vector<Point3f>& points) {
  static_assert(sizeof(Point3f) == 3 * sizeof(float));
  return {points.empty() ? nullptr : &points.front().x, 3 * points.size()};
}

// glTF's have length 1.
std::vector<float> unit_normals(const std::vector<Normal3f>& normals) {
  std::vector<float> out;
  out.reserve(3 * normals.size());
  for (const Normal3f& n : normals) {
    const Vector3d d = to_vector(cast<double>(n));
    const double l = length(d);
    const Vector3d u =
        l > 0 && std::isfinite(l) ? (std::abs(l - 1) < 1e-6 ? d : d * (1 / l)) : Vector3d{0, 0, 1};
    for (const double v : {u.x, u.y, u.z}) out.push_back(static_cast<float>(v));
  }
  return out;
}

}  // namespace

MeshWriter::MeshWriter(tinygltf::Model& model, Binary& binary, ConversionNotes& notes,
                       MaterialWriter& materials)
    : model_(model),
      binary_(binary),
      notes_(notes),
      materials_(materials),
      uvs_show_(meshes_whose_uvs_show(notes.scene)) {}

const MeshWriter::Accessors& MeshWriter::accessors(Id<TriangleMesh> id, bool turned, const std::string& color,
                                                   const Shape& shape) {
  const auto [at, is_new] = known_.try_emplace({id.value, turned, color});
  Accessors& out = at->second;
  if (!is_new) return out;
  const TriangleMesh& stored = notes_.scene.meshes.at(id.value);
  TriangleMesh storage, apart;
  const TriangleMesh* mesh = &loaded(stored, storage);
  if (mesh->uvs.empty() && uvs_show_[id.value] && mesh->missing_uv != MissingUv::zero) {
    apart = with_uvs(*mesh);
    mesh = &apart;
  }
  if (mesh->triangles.empty()) return out;
  if (const auto other = known_.find({id.value, !turned, color}); other != known_.end()) {
    out.attributes = other->second.attributes;
  } else {
    out.attributes["POSITION"] = binary_.floats(numbers_of(mesh->positions), TINYGLTF_TYPE_VEC3, true);
    if (!mesh->normals.empty())
      out.attributes["NORMAL"] = binary_.floats(unit_normals(mesh->normals), TINYGLTF_TYPE_VEC3);
    if (!mesh->uvs.empty())
      out.attributes["TEXCOORD_0"] =
          binary_.floats({&mesh->uvs.front().x, 2 * mesh->uvs.size()}, TINYGLTF_TYPE_VEC2);
    for (const MeshAttribute& attribute : mesh->attributes) {
      const bool fits = attribute.name == color && !attribute.per_face && attribute.channels == 3;
      if (fits)
        out.attributes["COLOR_0"] = binary_.floats(attribute.values, TINYGLTF_TYPE_VEC3);
      else
        notes_.dropped("the attribute " + attribute.name + " of a mesh", shape.origin, RecordKind::shape);
    }
  }
  std::vector<std::uint32_t> corners;
  corners.reserve(3 * mesh->triangles.size());
  for (const auto& t : mesh->triangles)
    corners.insert(corners.end(), {t[0], t[turned ? 2 : 1], t[turned ? 1 : 2]});
  out.indices = binary_.indices(corners, mesh->positions.size());
  return out;
}

int MeshWriter::write(const std::vector<const Shape*>& shapes) {
  std::vector<std::tuple<std::uint32_t, bool, int>> key;
  for (const Shape* shape : shapes) {
    const bool turned = shape->flip_orientation != swaps_handedness(shape->object_to_world);
    key.emplace_back(shape->mesh.value, turned, materials_.write(*shape));
  }
  const auto [known, is_new] = meshes_.try_emplace(key, -1);
  if (!is_new) return known->second;
  tinygltf::Mesh mesh;
  for (std::size_t i = 0; i < shapes.size(); ++i) {
    const Shape& shape = *shapes[i];
    const auto& [id, turned, material] = key[i];
    if (const auto& quadric = notes_.scene.meshes.at(id).quadric)
      notes_.approximated(as_triangles(*quadric), shape.origin, RecordKind::shape);
    const Accessors& from = accessors(shape.mesh, turned, materials_.color_attribute(material), shape);
    if (from.indices < 0) continue;
    tinygltf::Primitive primitive;
    primitive.attributes = from.attributes;
    primitive.indices = from.indices, primitive.material = material, primitive.mode = TINYGLTF_MODE_TRIANGLES;
    mesh.primitives.push_back(std::move(primitive));
  }
  if (mesh.primitives.empty()) return -1;
  mesh.name = shapes.front()->name;
  model_.meshes.push_back(std::move(mesh));
  return known->second = static_cast<int>(model_.meshes.size()) - 1;
}

}  // namespace vitrail::gltf
