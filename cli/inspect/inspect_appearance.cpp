// SPDX-License-Identifier: Apache-2.0
// What a scene says about its appearance, in its own terms, and what that asks of a renderer.
#include <fmt/format.h>

#include <array>
#include <map>

#include "cli/inspect/inspect.h"
#include "images/image_files.h"
#include "images/ptex_file.h"
#include "scene/records/kinds.h"
#include "scene/records/material_traits.h"

namespace vitrail {

namespace {

std::string file_of(const Texture& texture) {
  if (const auto* image = std::get_if<ImageTexture>(&texture.model)) return image->filename;
  if (const auto* ptex = std::get_if<PtexTexture>(&texture.model)) return ptex->filename;
  return "";
}

// Of an image, or the faces of a Ptex file; null where it is none of these, or cannot be read.
Report size_of(const Texture& texture) {
  Report size{{"width", nullptr}, {"height", nullptr}, {"channels", nullptr}, {"faces", nullptr}};
  const std::string file = file_of(texture);
  if (file.empty()) return size;
  try {
    if (std::holds_alternative<PtexTexture>(texture.model)) {
      size["faces"] = PtexFile(file).faces().size();
      return size;
    }
    const ImageLayout layout = read_image_layout(file);
    size["width"] = layout.width, size["height"] = layout.height, size["channels"] = layout.channels;
  } catch (const Error&) {
    // Said when the scene is rendered.
  }
  return size;
}

std::uint64_t bytes_of(const TriangleMesh& mesh) {
  std::uint64_t bytes = mesh.positions.size() * sizeof(Point3f) + mesh.triangles.size() * 12 +
                        mesh.normals.size() * sizeof(Normal3f) + mesh.uvs.size() * sizeof(Point2f);
  for (const MeshAttribute& attribute : mesh.attributes) bytes += attribute.values.size() * sizeof(float);
  return bytes;
}

// "3 conductor, 1 mask": how many of each kind, the kinds that the renderer has left out.
template <class Records, class KindOf>
std::string kinds_beyond(const Records& records, KindOf&& kind_of,
                         std::initializer_list<std::string_view> known) {
  std::map<std::string, int> counts;
  for (const auto& record : records) {
    const std::string kind = kind_of(record);
    if (std::find(known.begin(), known.end(), kind) == known.end()) ++counts[kind];
  }
  std::string text;
  for (const auto& [kind, count] : counts)
    text += fmt::format("{}{} {}", text.empty() ? "" : ", ", count, kind);
  return text;
}

Report or_null(const std::string& text) { return text.empty() ? Report(nullptr) : Report(text); }

}  // namespace

Report need(const std::string& why) { return {{"needed", !why.empty()}, {"why", why}}; }

Report describe_materials(const Scene& scene) {
  Report table = Report::array();
  const std::vector<MaterialTraits> traits = traits_of(scene.materials);
  for (std::size_t i = 0; i < traits.size(); ++i) {
    const Material& m = scene.materials[i];
    table.push_back({{"name", or_null(m.name)},
                     {"kind", kind_of(m.model)},
                     {"sides", m.two_sided || traits[i].transmits ? "both" : "front"},
                     {"bumps", m.displacement.has_value() || m.normal_map.has_value()},
                     {"where", to_string(location(scene, m.origin))}});
  }
  return table;
}

Report describe_textures(const Scene& scene) {
  Report table = Report::array();
  for (const Texture& t : scene.textures) {
    Report row{{"name", or_null(t.name)},
               {"kind", kind_of(t.model)},
               {"values", t.is_float ? "numbers" : "colours"}};
    row.update(size_of(t));
    row["file"] = or_null(file_of(t));
    table.push_back(std::move(row));
  }
  return table;
}

Report describe_media(const Scene& scene) {
  Report table = Report::array();
  for (const Medium& m : scene.media)
    table.push_back({{"name", m.name},
                     {"kind", m.density.index() == 0   ? "homogeneous"
                              : m.density.index() == 1 ? "grid"
                                                       : "cloud"},
                     {"g", m.g},
                     {"emits", m.emission.has_value() || m.temperature.has_value()}});
  return table;
}

Report describe_needs(const Scene& scene) {
  Report needs;
  needs["materials_beyond_diffuse_and_smooth_glass"] =
      need(kinds_beyond(scene.materials, [](const Material& m) { return kind_of(m.model); },
                        {"diffuse", "dielectric", "interface"}));
  needs["textures"] =
      need(kinds_beyond(scene.textures, [](const Texture& t) { return kind_of(t.model); }, {}));
  needs["lights_beyond_point_distant_and_constant"] = need(kinds_beyond(
      scene.lights, [](const Light& l) { return kind_of(l.model); }, {"point", "distant", "infinite"}));
  needs["media"] = need(scene.media.empty() ? "" : fmt::format("{} of them", scene.media.size()));
  needs["instances"] = need(scene.instances.empty() ? ""
                                                    : fmt::format("{} of {} objects", scene.instances.size(),
                                                                  scene.prototypes.size()));
  std::string moves = scene.camera_motion.moves() ? "of the camera" : "";
  if (!scene.motions.empty())
    moves += fmt::format("{}{} of objects", moves.empty() ? "" : " and ", scene.motions.size());
  needs["motion"] = need(moves);
  const auto* perspective = std::get_if<PerspectiveCamera>(&scene.camera);
  const auto* orthographic = std::get_if<OrthographicCamera>(&scene.camera);
  const double radius = perspective ? perspective->lens.radius : orthographic ? orthographic->lens.radius : 0;
  const auto* realistic = std::get_if<RealisticCamera>(&scene.camera);
  needs["lens"] = need(radius > 0  ? fmt::format("of radius {:.4g}", radius)
                       : realistic ? fmt::format("of {} surfaces", realistic->surfaces.size())
                                   : "");
  return needs;
}

std::uint64_t mesh_bytes(const Scene& scene) {
  std::uint64_t bytes = 0;
  for (const TriangleMesh& mesh : scene.meshes) bytes += bytes_of(mesh);
  return bytes;
}

}  // namespace vitrail
