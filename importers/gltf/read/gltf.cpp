// SPDX-License-Identifier: Apache-2.0
#include "importers/gltf/read/gltf.h"

#include <fmt/format.h>

#include <algorithm>
#include <map>

#include "importers/gltf/read/accessors.h"
#include "importers/gltf/read/extension_values.h"
#include "importers/gltf/read/lights.h"
#include "importers/gltf/read/meshes.h"
#include "importers/gltf/read/node_tree.h"
#include "importers/gltf/units.h"
#include "importers/reading/default_view.h"

namespace vitrail {

namespace gltf {

namespace {

class SceneReader {
 public:
  SceneReader(const std::filesystem::path& file, MeshMemory& memory, const ImportOptions& options)
      : options_(options),
        document_(file),
        model_(document_.model()),
        tree_(document_),
        meshes_(document_, imported_.scene, imported_.diagnostics, memory) {
    imported_.scene.files.push_back(file.string());
  }

  ImportedScene read() {
    count_uses();
    for (const int node : tree_.shown) add_node(node);
    turn_mirrored_instances(imported_.scene, meshes_.turned_materials());
    camera();
    note_whole_file();
    Scene& scene = imported_.scene;
    if (!scene.lights.empty() || !scene.area_lights.empty()) scene.film.imaging_ratio = shown_per_radiance;
    return std::move(imported_);
  }

  bool has_camera() const { return !cameras_.empty(); }

 private:
  const tinygltf::Node& node(int index) const { return model_.nodes[static_cast<std::size_t>(index)]; }

  bool is_posed(int index) const { return node(index).skin >= 0 || !node(index).weights.empty(); }

  void count_uses() {
    for (const int i : tree_.shown) {
      const int mesh = node(i).mesh;
      if (mesh < 0) continue;
      document_.element(model_.meshes, mesh, "meshes", "nodes", i);
      if (!is_posed(i)) uses_[mesh] += extension(node(i).extensions, "EXT_mesh_gpu_instancing") ? 2 : 1;
    }
  }

  void add_node(int index) {
    const Transform& to_world = tree_.to_world[static_cast<std::size_t>(index)];
    if (node(index).camera >= 0) cameras_.push_back(index);
    add_light(document_, index, to_world, imported_);
    const int mesh = node(index).mesh;
    if (mesh < 0) return;
    if (is_posed(index)) {
      const bool skinned = node(index).skin >= 0;
      const Pose pose{node(index).weights, skinned ? joints(index) : std::vector<Transform>{}};
      add_shapes(imported_.scene.shapes, meshes_.posed_parts(mesh, pose), skinned ? Transform{} : to_world,
                 index);
    } else if (uses_[mesh] == 1) {
      add_shapes(imported_.scene.shapes, meshes_.parts(mesh), to_world, index);
    } else {
      for (const Transform& t : places(index)) add_instance(mesh, to_world * t, index);
    }
  }

  // A mirrored node's front is where its triangles run clockwise.
  void add_shapes(std::vector<Shape>& shapes, const std::vector<Part>& parts, const Transform& to_world,
                  int index) {
    if (!is_visible(to_world, index)) return;
    for (const Part& part : parts) {
      Shape shape;
      shape.mesh = part.mesh, shape.material = material_of(part, to_world);
      shape.area_light = part.surface.light;
      shape.opacity = part.surface.opacity, shape.interior = part.surface.interior;
      shape.object_to_world = to_world;
      shape.flip_orientation = swaps_handedness(to_world);
      shape.name = node(index).name;
      shape.origin = document_.origin("nodes", index);
      shapes.push_back(std::move(shape));
    }
  }

  // Mirroring a node mirrors its (u,v) too.
  Id<Material> material_of(const Part& part, const Transform& to_world) {
    return meshes_.turned_materials().turned(
        part.surface.material, {part.against.first, part.against.second != swaps_handedness(to_world)});
  }

  void add_instance(int mesh, const Transform& to_world, int index) {
    if (!is_visible(to_world, index)) return;
    Scene& scene = imported_.scene;
    const auto [at, is_new] = prototypes_.try_emplace(mesh);
    if (is_new) {
      Prototype prototype;
      prototype.name = model_.meshes[static_cast<std::size_t>(mesh)].name;
      prototype.origin = document_.origin("meshes", mesh);
      add_shapes(prototype.shapes, meshes_.parts(mesh), Transform{}, index);
      scene.prototypes.push_back(std::move(prototype));
      at->second = {static_cast<std::uint32_t>(scene.prototypes.size() - 1)};
    }
    scene.instances.push_back({at->second, to_world, document_.origin("nodes", index)});
  }

  // A scale of 0 hides things.
  bool is_visible(const Transform& t, int index) {
    if (is_invertible(t)) return true;
    note(Fidelity::dropped, "a node that is flat: its scale is 0", index, RecordKind::shape);
    return false;
  }

  // Of EXT_mesh_gpu_instancing, in the node; itself where it has none.
  std::vector<Transform> places(int index) const {
    const tinygltf::Value* instancing = extension(node(index).extensions, "EXT_mesh_gpu_instancing");
    if (!instancing) return {Transform{}};
    if (!instancing->Has("attributes") || !instancing->Get("attributes").IsObject())
      document_.fail("nodes", index, "EXT_mesh_gpu_instancing has no attributes");
    const tinygltf::Value& attributes = instancing->Get("attributes");
    std::size_t count = 0;
    const auto values = [&](const char* name, int components) {
      const int accessor = gltf::index(attributes, name);
      std::vector<float> v;
      if (!attributes.Has(name)) return v;
      v = read_floats(document_, accessor, components);
      const std::size_t n = v.size() / static_cast<std::size_t>(components);
      if (count > 0 && n != count)
        document_.fail("nodes", index, "its instances' attributes have not the same length");
      count = n;
      if (!std::ranges::all_of(v, [](float x) { return std::isfinite(x); }))
        document_.fail("nodes", index, fmt::format("{} of its instances is not finite", name));
      return v;
    };
    const auto t = values("TRANSLATION", 3), r = values("ROTATION", 4), s = values("SCALE", 3);
    std::vector<Transform> all;
    for (std::size_t i = 0; i < count; ++i) {
      std::array<double, 3> move{0, 0, 0}, size{1, 1, 1};
      std::array<double, 4> turn{0, 0, 0, 1};
      for (std::size_t k = 0; k < 3 && !t.empty(); ++k) move[k] = static_cast<double>(t[3 * i + k]);
      for (std::size_t k = 0; k < 4 && !r.empty(); ++k) turn[k] = static_cast<double>(r[4 * i + k]);
      for (std::size_t k = 0; k < 3 && !s.empty(); ++k) size[k] = static_cast<double>(s[3 * i + k]);
      all.push_back(trs(move.data(), turn.data(), size.data()));
    }
    return all;
  }

  // A skinned mesh stands where its joints are, wherever its node is.
  std::vector<Transform> joints(int index) const {
    const auto& skin = document_.element(model_.skins, node(index).skin, "skins", "nodes", index);
    std::vector<float> inverse_bind;
    if (skin.inverseBindMatrices >= 0) inverse_bind = read_floats(document_, skin.inverseBindMatrices, 16);
    std::vector<Transform> all;
    for (std::size_t j = 0; j < skin.joints.size(); ++j) {
      document_.element(model_.nodes, skin.joints[j], "nodes", "skins", node(index).skin);
      Transform bind;
      if (!inverse_bind.empty()) {
        if (inverse_bind.size() < 16 * (j + 1))
          document_.fail("skins", node(index).skin, "has more joints than inverseBindMatrices");
        for (std::size_t r = 0; r < 4; ++r)
          for (std::size_t c = 0; c < 4; ++c)
            bind.m[r][c] = static_cast<double>(inverse_bind[16 * j + 4 * c + r]);
      }
      all.push_back(tree_.to_world[static_cast<std::size_t>(skin.joints[j])] * bind);
    }
    return all;
  }

  void camera() {
    const int chosen = options_.camera;
    if (chosen != 0 && chosen >= static_cast<int>(cameras_.size()))
      throw UsageError(fmt::format("{}: it has {} cameras, and --camera {} is asked for",
                                   document_.file().string(), cameras_.size(), chosen));
    if (cameras_.empty()) return;
    const int node = cameras_[static_cast<std::size_t>(chosen)];
    take_camera(document_, node, tree_.to_world[static_cast<std::size_t>(node)], imported_);
    if (cameras_.size() > 1 && chosen == 0)
      note(Fidelity::approximated,
           fmt::format("the first of {} cameras: --camera 1 takes the next", cameras_.size()), node,
           RecordKind::camera);
  }

  void note(Fidelity fidelity, const std::string& what, int node, RecordKind kind) {
    const SourceLocation place = document_.place("nodes", node);
    imported_.diagnostics.push_back({fidelity, what, place, place, kind});
  }

  void note_whole_file() {
    const SourceLocation place{imported_.scene.files.front()};
    const auto say = [&](Fidelity fidelity, const std::string& what) {
      imported_.diagnostics.push_back({fidelity, what, place, {}, RecordKind::any});
    };
    for (const std::string& name : document_.unknown_extensions())
      say(Fidelity::dropped, fmt::format("the extension {}", name));
    if (const tinygltf::Value* variants = extension(model_.extensions, "KHR_materials_variants"))
      say(Fidelity::dropped,
          fmt::format(
              "KHR_materials_variants: {} variants; the materials that the meshes name themselves are shown",
              variants->Has("variants") ? variants->Get("variants").ArrayLen() : 0));
    if (!model_.animations.empty())
      say(Fidelity::approximated,
          fmt::format("{} animations: the scene is as it stands without them", model_.animations.size()));
    if (const int n = meshes_.materials().single_sided(); n > 0)
      say(Fidelity::approximated, fmt::format("{} materials are not doubleSided: their backs, which other "
                                              "programs may leave out, are as their fronts",
                                              n));
  }

  const ImportOptions& options_;
  Document document_;
  const tinygltf::Model& model_;
  ImportedScene imported_;
  NodeTree tree_;
  Meshes meshes_;
  std::map<int, int> uses_;  // of meshes
  std::map<int, Id<Prototype>> prototypes_;
  std::vector<int> cameras_;  // nodes
};

}  // namespace

}  // namespace gltf

bool is_gltf(std::string_view first_bytes) { return gltf::is_gltf(first_bytes); }

ImportedScene read_gltf(const std::filesystem::path& file, MeshMemory memory, const ImportOptions& options) {
  gltf::SceneReader reader(file, memory, options);
  ImportedScene imported = reader.read();
  reader.has_camera() ? add_default_light(imported, file) : add_default_view(imported, file);
  return imported;
}

}  // namespace vitrail
