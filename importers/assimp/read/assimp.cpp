// SPDX-License-Identifier: Apache-2.0
#include "importers/assimp/read/assimp.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <numbers>
#include <optional>
#include <string_view>
#include <utility>

#include "importers/assimp/asset.h"
#include "importers/assimp/read/asset_file.h"
#include "importers/assimp/read/asset_lights.h"
#include "importers/assimp/read/asset_materials.h"
#include "importers/assimp/read/collada_cameras.h"
#include "importers/assimp/read/fbx_facts.h"
#include "importers/bytes/input_bytes.h"
#include "importers/reading/default_view.h"
#include "importers/reading/named_file.h"
#include "scene/models/turned_normal_maps.h"
#include "scene/shapes/mesh_parts.h"
#include "scene/spectra/rgb_to_spectrum.h"

namespace vitrail {

namespace assimp {

namespace {

// Normals and (u,v) that are not finite count as 0, as in the other readers.
TriangleMesh mesh_of(AssetMesh&& in, const std::string& file) {
  for (std::size_t i = 0; i < in.positions.size(); ++i)
    if (const Point3f p = in.positions[i]; !std::isfinite(p.x) || !std::isfinite(p.y) || !std::isfinite(p.z))
      throw Error(fmt::format("mesh '{}': vertex {} is not finite", in.name, i), {file});
  TriangleMesh mesh;
  mesh.positions = std::move(in.positions);
  mesh.normals = std::move(in.normals);
  mesh.uvs = std::move(in.uvs);
  mesh.missing_uv = MissingUv::zero;
  mesh.triangles = std::move(in.triangles);
  for (Normal3f& n : mesh.normals)
    if (!std::isfinite(n.x) || !std::isfinite(n.y) || !std::isfinite(n.z)) n = {0, 0, 0};
  for (Point2f& uv : mesh.uvs)
    if (!std::isfinite(uv.x) || !std::isfinite(uv.y)) uv = {0, 0};
  return mesh;
}

// A mesh, or what of it shows its image on one side.
struct Part {
  Id<TriangleMesh> mesh;
  AgainstAxes against;
};

class SceneReader {
 public:
  SceneReader(const std::filesystem::path& file, MeshMemory& memory, const ImportOptions& options)
      : file_(file.string()), memory_(memory), options_(options), asset_(read_asset(file)) {
    imported_.scene.files.push_back(file_);
  }

  ImportedScene read() {
    surfaces_ = add_materials(asset_, file_, imported_);
    for (const AssetNode& node : asset_.nodes)
      to_world_.push_back(to_world_.empty() ? node.to_parent : to_world_[node.parent] * node.to_parent);
    std::vector<std::size_t> uses(asset_.meshes.size(), 0);
    for (const AssetNode& node : asset_.nodes)
      for (const std::size_t mesh : node.meshes) ++uses[mesh];
    for (std::size_t node = 0; node < asset_.nodes.size(); ++node)
      for (const std::size_t mesh : asset_.nodes[node].meshes) {
        if (asset_.meshes[mesh].triangles.empty() && !meshes_.contains(mesh)) continue;
        if (uses[mesh] > 1)
          add_instance(mesh, node);
        else if (is_visible(node))
          add_shapes(imported_.scene.shapes, mesh, node, to_world_[node]);
      }
    turn_mirrored_instances(imported_.scene, materials_);
    mend_by_file();
    for (const AssetLight& light : asset_.lights) add_light(light);
    take_camera();
    note_whole_file();
    return std::move(imported_);
  }

  bool has_camera() const { return !asset_.cameras.empty(); }

 private:
  void note(Fidelity fidelity, std::string what, RecordKind kind = RecordKind::any) {
    imported_.diagnostics.push_back({fidelity, std::move(what), {file_}, {}, kind});
  }

  // What the file itself says better than assimp.
  void mend_by_file() {
    const std::string suffix = std::filesystem::path(file_).extension().string();
    const auto is = [&](const char* wanted) {
      return std::ranges::equal(suffix, std::string_view(wanted),
                                [](char a, char b) { return lower_case(a) == b; });
    };
    if (is(".dae") && !asset_.cameras.empty()) {
      const std::vector<AssetCamera> cameras = collada_cameras(file_);
      if (cameras.size() != asset_.cameras.size())
        return note(Fidelity::approximated,
                    "its cameras are instances of instances: their angles may be others", RecordKind::camera);
      for (std::size_t i = 0; i < cameras.size(); ++i) {
        AssetCamera& camera = asset_.cameras[i];
        camera.horizontal_fov_deg = cameras[i].horizontal_fov_deg;
        camera.vertical_fov_deg = cameras[i].vertical_fov_deg;
        camera.half_width = cameras[i].half_width, camera.half_height = cameras[i].half_height;
        camera.aspect = cameras[i].aspect;
      }
    }
    if (is(".fbx") && !(asset_.cameras.empty() && asset_.lights.empty())) {
      const InputBytes bytes(file_);
      const FbxFacts facts = fbx_facts({bytes.begin(), bytes.size()});
      targets_ = facts.targets;
      if (facts.has_orthographic_camera && !asset_.cameras.empty())
        note(Fidelity::approximated, "an orthographic camera: it is a perspective one", RecordKind::camera);
      if (facts.has_vertical_angles)
        for (AssetCamera& camera : asset_.cameras)
          camera.vertical_fov_deg = std::exchange(camera.horizontal_fov_deg, 0);
    }
  }

  // The direction from a place to what the node's camera or light looks at, if it looks at a node.
  std::optional<Vector3d> to_target(std::size_t node, Point3d from) {
    const auto target = targets_.find(asset_.nodes[node].name);
    if (target == targets_.end()) return {};
    const auto found = std::ranges::find(asset_.nodes, target->second, &AssetNode::name);
    if (found != asset_.nodes.end()) {
      const Transform& there = to_world_[static_cast<std::size_t>(found - asset_.nodes.begin())];
      const Vector3d direction = transform_point(there, Point3d{}) - from;
      if (length(direction) > 0) return direction;
    }
    note(Fidelity::dropped,
         fmt::format("what '{}' looks at: it looks as its node stands", asset_.nodes[node].name));
    return {};
  }

  // The meshes of a mesh: two where its (u,v) are mirrored on a part of it, and a normal map shows.
  const std::vector<Part>& keep(std::size_t id) {
    const auto [at, is_new] = meshes_.try_emplace(id);
    std::vector<Part>& parts = at->second;
    if (!is_new) return parts;
    const auto layout = materials_.layout(surfaces_.at(asset_.meshes[id].material).material);
    TriangleMesh whole = mesh_of(std::move(asset_.meshes[id]), file_);
    const auto add = [&](TriangleMesh mesh, AgainstAxes against) {
      std::vector<TriangleMesh>& meshes = imported_.scene.meshes;
      parts.push_back({{static_cast<std::uint32_t>(meshes.size())}, against});
      meshes.push_back(memory_.keep(std::move(mesh), {}));
    };
    const std::vector<UvPart> sides = layout ? uv_parts(whole, *layout) : std::vector<UvPart>{};
    if (sides.size() < 2)
      add(std::move(whole), sides.empty() ? AgainstAxes{} : sides[0].against);
    else
      for (const UvPart& side : sides) add(only_triangles(whole, side.triangles), side.against);
    return parts;
  }

  void add_shapes(std::vector<Shape>& shapes, std::size_t mesh, std::size_t node, const Transform& to_world) {
    const MtlSurface& surface = surfaces_.at(asset_.meshes[mesh].material);
    const bool mirrors = swaps_handedness(to_world);
    for (const Part& part : keep(mesh)) {
      Shape shape;
      shape.mesh = part.mesh, shape.area_light = surface.light;
      shape.material =
          materials_.turned(surface.material, {part.against.first, part.against.second != mirrors});
      shape.object_to_world = to_world;
      shape.flip_orientation = mirrors;
      shape.name = asset_.nodes[node].name;
      shapes.push_back(std::move(shape));
    }
  }

  void add_instance(std::size_t mesh, std::size_t node) {
    Scene& scene = imported_.scene;
    const auto [at, is_new] = prototypes_.try_emplace(mesh);
    if (is_new) {
      Prototype prototype;
      prototype.name = asset_.meshes[mesh].name;
      add_shapes(prototype.shapes, mesh, node, Transform{});
      at->second = {static_cast<std::uint32_t>(scene.prototypes.size())};
      scene.prototypes.push_back(std::move(prototype));
    }
    if (is_visible(node)) scene.instances.push_back({at->second, to_world_[node], {}});
  }

  // A scale of 0 hides things.
  bool is_visible(std::size_t node) {
    if (is_invertible(to_world_[node])) return true;
    note(Fidelity::dropped, fmt::format("'{}' is flat: its scale is 0", asset_.nodes[node].name),
         RecordKind::shape);
    return false;
  }

  void add_light(const AssetLight& in) {
    const double brightest = std::ranges::max(in.color);
    if (!(std::ranges::min(in.color) >= 0 && brightest > 0 && std::isfinite(brightest))) return;
    if (in.kind == AssetLight::Kind::other) {
      note(Fidelity::dropped, "an ambient light, or one of an area", RecordKind::light);
      return;
    }
    const Transform& to_world = to_world_[in.node];
    const Point3d position = transform_point(to_world, in.position);
    const Vector3d direction =
        to_target(in.node, position).value_or(transform_vector(to_world, in.direction));
    if (in.kind != AssetLight::Kind::point && !(length(direction) > 0)) return;
    const LightScale scale = scale_of_light(in, asset_.units_of_blender);
    const Spectrum spectrum = emission_from_rgb(
        {scale.factor * in.color[0], scale.factor * in.color[1], scale.factor * in.color[2]});
    Light out;
    if (in.kind == AssetLight::Kind::directional) {
      out.model = DistantLight{normalize(direction), spectrum};
    } else if (in.kind == AssetLight::Kind::point) {
      out.model = PointLight{position, spectrum, scale.fading};
    } else {
      SpotLight spot;
      spot.light_to_world = frame_along(position, direction);
      spot.intensity = spectrum;
      spot.cutoff_deg = static_cast<float>(std::clamp(in.outer_deg, 0.01, 90.0));
      spot.beam_deg = std::min(static_cast<float>(std::max(in.inner_deg, 0.0)), spot.cutoff_deg);
      spot.fading = scale.fading;
      out.model = spot;
    }
    imported_.scene.lights.push_back(std::move(out));
    if (!are_lights_noted_)
      note(Fidelity::approximated,
           asset_.units_of_blender ? "lights are watts and W/m², as Blender means them"
                                   : "lights have no units: a light of colour 1 shows white as 1",
           RecordKind::light);
    are_lights_noted_ = true;
  }

  static Transform frame_along(Point3d position, Vector3d direction) {
    const Vector3d up =
        std::abs(direction.y) < 0.9 * length(direction) ? Vector3d{0, 1, 0} : Vector3d{1, 0, 0};
    return look_at(position, position + direction, up);
  }

  void take_camera() {
    constexpr double usual_fov_deg = 45;
    const auto chosen = static_cast<std::size_t>(options_.camera);
    if (chosen != 0 && chosen >= asset_.cameras.size())
      throw UsageError(fmt::format("{}: it has {} cameras, and --camera {} is asked for", file_,
                                   asset_.cameras.size(), chosen));
    if (!has_camera()) return;
    const AssetCamera& in = asset_.cameras[chosen];
    const Transform& to_world = to_world_[in.node];
    Scene& scene = imported_.scene;
    const Point3d eye = transform_point(to_world, in.position);
    // look_at puts +x left of who looks along −z with +y up: turned, so that the picture is not mirrored.
    const std::optional<Vector3d> target = to_target(in.node, eye);
    const Vector3d direction = target.value_or(transform_vector(to_world, in.direction)),
                   up = target ? Vector3d{0, 1, 0} : transform_vector(to_world, in.up);
    const Transform frame = look_at(eye, eye + direction, up) * scale({-1, 1, 1});
    if (!is_invertible(frame)) throw Error("its camera has no direction", {file_});
    if (in.aspect > 1e-3 && in.aspect < 1e3) set_aspect(scene.film, in.aspect);
    const double aspect = static_cast<double>(scene.film.width) / scene.film.height;
    const auto half_of = [](double fov_deg) { return std::tan(fov_deg / 2 * std::numbers::pi / 180); };
    const auto is_angle = [](double fov_deg) { return fov_deg > 0 && fov_deg < 179; };
    double wide = half_of(usual_fov_deg);
    if (is_angle(in.vertical_fov_deg)) wide = aspect * half_of(in.vertical_fov_deg);
    if (is_angle(in.horizontal_fov_deg)) wide = half_of(in.horizontal_fov_deg);
    if (in.half_height > 0) wide = in.half_height * aspect;
    if (in.half_width > 0) wide = in.half_width;
    const ScreenWindow screen{-wide, wide, -wide / aspect, wide / aspect};
    if (in.half_width > 0 || in.half_height > 0)
      scene.camera = OrthographicCamera{frame, screen, {}};
    else
      scene.camera = PerspectiveCamera{frame, screen, {}};
    if (asset_.cameras.size() > 1 && chosen == 0)
      note(Fidelity::approximated,
           fmt::format("the first of {} cameras: --camera 1 takes the next", asset_.cameras.size()),
           RecordKind::camera);
  }

  static void set_aspect(FilmSettings& film, double aspect) {
    constexpr double longer_side = 1280;
    film.width = std::max(1, static_cast<int>(std::lround(aspect >= 1 ? longer_side : longer_side * aspect)));
    film.height =
        std::max(1, static_cast<int>(std::lround(aspect >= 1 ? longer_side / aspect : longer_side)));
    film.crop = {0, film.width, 0, film.height};
  }

  void note_whole_file() {
    if (asset_.animations > 0)
      note(Fidelity::approximated,
           fmt::format("{} animations: the scene is as it stands without them", asset_.animations));
    if (asset_.bones > 0) note(Fidelity::approximated, "bones: their meshes are as they stand without them");
    if (asset_.colored_meshes > 0)
      note(Fidelity::dropped, fmt::format("colours of vertices, of {} meshes", asset_.colored_meshes),
           RecordKind::shape);
    if (asset_.points_and_lines > 0) note(Fidelity::dropped, "points and lines", RecordKind::shape);
  }

  const std::string file_;
  MeshMemory& memory_;
  const ImportOptions& options_;
  Asset asset_;
  ImportedScene imported_;
  TurnedMaterials materials_{imported_.scene};
  std::vector<MtlSurface> surfaces_;  // by material
  std::vector<Transform> to_world_;   // by node
  std::map<std::size_t, std::vector<Part>> meshes_;
  std::map<std::size_t, Id<Prototype>> prototypes_;
  std::map<std::string, std::string> targets_;  // of nodes, by name
  bool are_lights_noted_ = false;
};

}  // namespace

}  // namespace assimp

ImportedScene read_assimp(const std::filesystem::path& file, MeshMemory memory,
                          const ImportOptions& options) {
  assimp::SceneReader reader(file, memory, options);
  ImportedScene imported = reader.read();
  reader.has_camera() ? add_default_light(imported, file) : add_default_view(imported, file);
  return imported;
}

}  // namespace vitrail
