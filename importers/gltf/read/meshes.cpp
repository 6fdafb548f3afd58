// SPDX-License-Identifier: Apache-2.0
#include "importers/gltf/read/meshes.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "importers/gltf/read/primitive.h"
#include "importers/gltf/read/tangents.h"
#include "scene/shapes/mesh_parts.h"

namespace vitrail::gltf {

namespace {

template <class T>
std::vector<T> triples(const std::vector<float>& values) {
  std::vector<T> out(values.size() / 3);
  for (std::size_t i = 0; i < out.size(); ++i) out[i] = {values[3 * i], values[3 * i + 1], values[3 * i + 2]};
  return out;
}

bool are_finite(const std::vector<float>& values) {
  return std::ranges::all_of(values, [](float v) { return std::isfinite(v); });
}

}  // namespace

void Meshes::note(Fidelity fidelity, int mesh, const std::string& what) {
  const SourceLocation place = document_.place("meshes", mesh);
  diagnostics_.push_back({fidelity, what, place, place, RecordKind::shape});
}

const std::vector<Part>& Meshes::parts(int mesh) {
  const auto [at, is_new] = known_.try_emplace(mesh);
  if (is_new) at->second = posed_parts(mesh, {});
  return at->second;
}

std::vector<Part> Meshes::posed_parts(int index, const Pose& pose) {
  const tinygltf::Mesh& mesh = document_.model().meshes[static_cast<std::size_t>(index)];
  Pose own = pose;
  if (own.weights.empty()) own.weights = mesh.weights;
  std::vector<Part> parts;
  for (const tinygltf::Primitive& primitive : mesh.primitives) add_part(index, primitive, own, parts);
  return parts;
}

void Meshes::add_part(int index, const tinygltf::Primitive& primitive, const Pose& pose,
                      std::vector<Part>& parts) {
  const PrimitiveReader reader(document_, index, primitive);
  if (primitive.extensions.contains("KHR_draco_mesh_compression") && !reader.has_data("POSITION"))
    reader.fail("its triangles are packed by Draco alone: export without compression");
  if (!reader.has("POSITION")) return note(Fidelity::dropped, index, "a primitive without positions");
  TriangleMesh mesh;
  mesh.triangles = reader.triangles();
  if (mesh.triangles.empty()) {
    if (primitive.mode >= 0 && primitive.mode < TINYGLTF_MODE_TRIANGLES)
      note(Fidelity::dropped, index, primitive.mode == TINYGLTF_MODE_POINTS ? "points" : "lines");
    return;
  }
  std::vector<float> positions = reader.attribute("POSITION", 3), normals;
  if (reader.has("NORMAL")) normals = reader.attribute("NORMAL", 3);
  reader.morph("POSITION", pose.weights, positions);
  if (!normals.empty()) reader.morph("NORMAL", pose.weights, normals);
  mesh.positions = triples<Point3f>(positions), mesh.normals = triples<Normal3f>(normals);
  if (!pose.joints.empty() && reader.has("JOINTS_0")) {
    const std::vector<Transform> of_vertex = reader.skin(pose.joints);
    for (std::size_t i = 0; i < of_vertex.size(); ++i) {
      mesh.positions[i] = cast<float>(transform_point(of_vertex[i], cast<double>(mesh.positions[i])));
      if (!normals.empty())
        mesh.normals[i] = cast<float>(
            to_normal(normalize(to_vector(transform_normal(of_vertex[i], cast<double>(mesh.normals[i]))))));
    }
  }
  for (std::size_t i = 0; i < mesh.positions.size(); ++i)
    if (!is_finite(mesh.positions[i])) reader.fail(fmt::format("the position of vertex {} is not finite", i));
  if (!std::ranges::all_of(mesh.normals, [](Normal3f n) { return is_finite(Point3f{n.x, n.y, n.z}); })) {
    note(Fidelity::dropped, index, "normals that are not finite");
    mesh.normals.clear();
  }

  const int channels = reader.color_channels();
  const Surface& surface = materials_.surface(primitive.material, channels, index);
  add_uvs(index, reader, surface, mesh);
  if (channels > 0) add_colors(index, reader, surface, mesh);
  keep(index, reader, surface, std::move(mesh), parts);
}

void Meshes::add_uvs(int index, const PrimitiveReader& reader, const Surface& surface, TriangleMesh& mesh) {
  mesh.missing_uv = MissingUv::zero;
  const std::string set = fmt::format("TEXCOORD_{}", surface.uv_set);
  if (!reader.has(set)) return;
  const std::vector<float> uv = reader.attribute(set, 2);
  if (!are_finite(uv)) return note(Fidelity::dropped, index, set + ", which is not finite");
  for (std::size_t i = 0; i < uv.size(); i += 2) mesh.uvs.push_back({uv[i], uv[i + 1]});
}

void Meshes::add_colors(int index, const PrimitiveReader& reader, const Surface& surface,
                        TriangleMesh& mesh) {
  const auto channels = static_cast<std::size_t>(reader.color_channels());
  const std::vector<float> colors = reader.attribute("COLOR_0", static_cast<int>(channels));
  MeshAttribute color{vertex_color, false, 3, {}}, alpha{vertex_alpha, false, 1, {}};
  for (std::size_t i = 0; i < colors.size(); ++i) {
    const float value = std::isfinite(colors[i]) ? std::clamp(colors[i], 0.0f, 1.0f) : 0;
    (channels == 4 && i % 4 == 3 ? alpha : color).values.push_back(value);
  }
  bool is_grey = true;
  for (std::size_t i = 0; i < color.values.size(); i += 3)
    is_grey = is_grey && color.values[i] == color.values[i + 1] && color.values[i] == color.values[i + 2];
  if (surface.has_color_map && !is_grey)
    note(Fidelity::approximated, index,
         "the colours of its vertices and of its texture are multiplied as spectra, not as numbers");
  mesh.attributes.push_back(std::move(color));
  if (channels == 4) mesh.attributes.push_back(std::move(alpha));
}

// With a normal map, apart by the sides of (u,v) or of TANGENT.
void Meshes::keep(int index, const PrimitiveReader& reader, const Surface& surface, TriangleMesh mesh,
                  std::vector<Part>& parts) {
  const auto add = [&](TriangleMesh part, AgainstAxes against) {
    scene_.meshes.push_back(memory_.keep(std::move(part), {}));
    parts.push_back({{static_cast<std::uint32_t>(scene_.meshes.size() - 1)}, surface, against});
  };
  const std::optional<UvMapping> layout = turned_materials_.layout(surface.material);
  if (!layout || mesh.uvs.empty()) return add(std::move(mesh), {});
  std::vector<float> tangents;
  if (reader.has("TANGENT")) tangents = reader.attribute("TANGENT", 4);
  if (!are_finite(tangents)) {
    note(Fidelity::dropped, index, "tangents that are not finite");
    tangents.clear();
  }
  constexpr double most_turn_deg = 10;
  if (const double turn = tangents.empty() ? 0 : turn_of_tangents_deg(mesh, tangents); turn > most_turn_deg)
    note(Fidelity::approximated, index,
         fmt::format("its normal map goes along u: its tangents are {:.0f} degrees from there on average",
                     turn));
  const std::vector<UvPart> sides =
      tangents.empty() ? uv_parts(mesh, *layout) : parts_by_tangents(mesh, tangents);
  if (sides.size() < 2) return add(std::move(mesh), sides.empty() ? AgainstAxes{} : sides[0].against);
  for (const UvPart& side : sides) add(only_triangles(mesh, side.triangles), side.against);
}

}  // namespace vitrail::gltf
