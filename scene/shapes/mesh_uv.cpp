// SPDX-License-Identifier: Apache-2.0
#include "scene/shapes/mesh_uv.h"

#include <utility>

namespace vitrail {

CornerUvs missing_uvs(MissingUv rule, std::size_t triangle) {
  constexpr Point2f p00{0, 0}, p10{1, 0}, p01{0, 1}, p11{1, 1};
  const bool second = triangle % 2 == 1;
  switch (rule) {
    case MissingUv::pbrt:
      return {p00, p10, p11};
    case MissingUv::pbrt_turned:
      return {p00, p11, p10};
    case MissingUv::patches:
      return second ? CornerUvs{p00, p11, p01} : CornerUvs{p00, p10, p11};
    case MissingUv::patches_turned:
      return second ? CornerUvs{p00, p01, p11} : CornerUvs{p00, p11, p10};
    case MissingUv::barycentric:
      return {p00, p10, p01};
    default:
      return {p00, p00, p00};
  }
}

CornerUvs uvs_of(const TriangleMesh& mesh, std::size_t triangle) {
  if (mesh.uvs.empty()) return missing_uvs(mesh.missing_uv, triangle);
  const auto& [a, b, c] = mesh.triangles[triangle];
  return {mesh.uvs[a], mesh.uvs[b], mesh.uvs[c]};
}

void turn_round(TriangleMesh& mesh, bool uvs_show) {
  if (mesh.uvs.empty() && uvs_show) {
    switch (mesh.missing_uv) {
      case MissingUv::pbrt:
        mesh.missing_uv = MissingUv::pbrt_turned;
        break;
      case MissingUv::pbrt_turned:
        mesh.missing_uv = MissingUv::pbrt;
        break;
      case MissingUv::patches:
        mesh.missing_uv = MissingUv::patches_turned;
        break;
      case MissingUv::patches_turned:
        mesh.missing_uv = MissingUv::patches;
        break;
      case MissingUv::barycentric:
        mesh = with_uvs(std::move(mesh));
        break;
      case MissingUv::zero:
        break;
    }
  }
  for (auto& triangle : mesh.triangles) std::swap(triangle[1], triangle[2]);
}

TriangleMesh with_uvs(TriangleMesh mesh) {
  if (!mesh.uvs.empty()) return mesh;
  TriangleMesh apart;
  const std::size_t vertices = 3 * mesh.triangles.size();
  const auto pick = [&](const auto& from, auto& to) {
    if (from.empty()) return;
    to.reserve(vertices);
    for (const auto& triangle : mesh.triangles)
      for (const std::uint32_t corner : triangle) to.push_back(from[corner]);
  };
  pick(mesh.positions, apart.positions);
  pick(mesh.normals, apart.normals);
  apart.uvs.reserve(vertices);
  apart.triangles.reserve(mesh.triangles.size());
  for (std::size_t i = 0; i < mesh.triangles.size(); ++i) {
    const CornerUvs uvs = missing_uvs(mesh.missing_uv, i);
    apart.uvs.insert(apart.uvs.end(), uvs.begin(), uvs.end());
    const auto first = static_cast<std::uint32_t>(3 * i);
    apart.triangles.push_back({first, first + 1, first + 2});
  }
  apart.missing_uv = mesh.missing_uv;
  apart.attributes = std::move(mesh.attributes);
  for (MeshAttribute& attribute : apart.attributes) {
    if (attribute.per_face) continue;
    const auto channels = static_cast<std::size_t>(attribute.channels);
    std::vector<float> values;
    values.reserve(vertices * channels);
    for (const auto& triangle : mesh.triangles)
      for (const std::uint32_t corner : triangle)
        for (std::size_t c = 0; c < channels; ++c) values.push_back(attribute.values[corner * channels + c]);
    attribute.values = std::move(values);
  }
  return apart;
}

}  // namespace vitrail
