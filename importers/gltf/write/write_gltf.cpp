// SPDX-License-Identifier: Apache-2.0
#include "importers/gltf/write/write_gltf.h"

#include <sstream>
#include <unordered_map>

#include "importers/gltf/write/write_meshes.h"
#include "importers/gltf/write/write_view.h"
#include "importers/writing/exposed_lights.h"
#include "importers/writing/own_scene.h"
#include "scene/system/atomic_file.h"

namespace vitrail {

namespace gltf {

namespace {

class Writer {
 public:
  explicit Writer(const Scene& scene)
      : scene_(scene),
        notes_(scene),
        exposed_(scene),
        binary_(model_),
        materials_(model_, binary_, notes_, exposed_.area_lights),
        meshes_(model_, binary_, notes_, materials_) {
    model_.asset.version = "2.0", model_.asset.generator = scene_signature;
    model_.scenes.emplace_back(), model_.defaultScene = 0;
    if (is_mirrored(scene.camera)) mirror_ = scale({-1, 1, 1});
  }

  void write() {
    note_settings();
    if (const int camera = write_camera(model_, notes_, mirror_); camera >= 0) add_root(camera);
    for (const Light& light : exposed_.lights)
      if (const int node = write_light(model_, notes_, scene_, light, mirror_); node >= 0) add_root(node);
    for (const auto& group : groups(scene_.shapes)) add_shapes(group, mirror_);
    for (const Instance& instance : scene_.instances) add_instance(instance);
    if (model_.buffers.front().data.empty()) model_.buffers.clear();
  }

  Diagnostics save(const std::filesystem::path& out, bool binary) {
    std::ostringstream text;
    tinygltf::TinyGLTF writer;
    if (!writer.WriteGltfSceneToStream(&model_, text, !binary, binary))
      throw MachineError("cannot write " + out.string());
    AtomicFile file(out);
    file.write(std::as_bytes(std::span(text.view())));
    file.commit();
    return notes_.take();
  }

 private:
  using Group = std::vector<const Shape*>;

  // Shapes of one name and one place are one thing of several materials.
  static std::vector<Group> groups(const std::vector<Shape>& shapes) {
    std::vector<Group> all;
    std::unordered_map<std::string, std::size_t> last;  // group of a name
    for (const Shape& shape : shapes) {
      const auto known = shape.name.empty() ? last.end() : last.find(shape.name);
      if (known != last.end() && all[known->second].front()->object_to_world == shape.object_to_world) {
        all[known->second].push_back(&shape);
        continue;
      }
      if (!shape.name.empty()) last[shape.name] = all.size();
      all.push_back({&shape});
    }
    return all;
  }

  int add(tinygltf::Node node) {
    model_.nodes.push_back(std::move(node));
    return static_cast<int>(model_.nodes.size()) - 1;
  }
  void add_root(int node) { model_.scenes.front().nodes.push_back(node); }

  void add_shapes(const Group& group, const Transform& to_world) {
    tinygltf::Node node = node_at(to_world * group.front()->object_to_world);
    node.mesh = meshes_.write(group), node.name = group.front()->name;
    if (node.mesh >= 0) add_root(add(std::move(node)));
  }

  // Shapes of one place are the mesh of one node; others are children of it.
  void add_instance(const Instance& instance) {
    const Prototype& prototype = scene_.prototypes.at(instance.prototype.value);
    const Transform to_world = mirror_ * instance.prototype_to_world;
    Group together;
    for (const Shape& shape : prototype.shapes)
      if (together.empty() || shape.object_to_world == together.front()->object_to_world)
        together.push_back(&shape);
    if (together.size() == prototype.shapes.size() && !together.empty())
      return add_shapes(together, to_world);
    tinygltf::Node node = node_at(to_world);
    node.name = prototype.name;
    for (const auto& group : groups(prototype.shapes)) {
      tinygltf::Node child = node_at(group.front()->object_to_world);
      child.mesh = meshes_.write(group);
      if (child.mesh >= 0) node.children.push_back(add(std::move(child)));
    }
    if (!node.children.empty()) add_root(add(std::move(node)));
  }

  void note_settings() {
    if (scene_.film_origin.line > 0)
      notes_.approximated("film: glTF keeps its proportions", scene_.film_origin, RecordKind::film);
    for (const auto& [origin, kind, what] :
         {std::tuple{&scene_.sampler_origin, RecordKind::sampler, "sampler: glTF has none"},
          {&scene_.integrator_origin, RecordKind::integrator, "integrator: glTF has none"}})
      if (origin->line > 0) notes_.dropped(what, *origin, kind);
    std::vector<bool> inside(scene_.media.size());
    const auto look_at = [&](const std::vector<Shape>& shapes) {
      for (const Shape& shape : shapes) {
        if (shape.interior) inside[shape.interior->value] = true;
        if (shape.exterior) notes_.dropped("a medium in front of a surface", shape.origin, RecordKind::shape);
      }
    };
    look_at(scene_.shapes);
    for (const Prototype& prototype : scene_.prototypes) look_at(prototype.shapes);
    for (std::size_t i = 0; i < inside.size(); ++i)
      if (!inside[i])
        notes_.dropped("a medium that is in no surface", scene_.media[i].origin, RecordKind::medium);
  }

  const Scene& scene_;
  ConversionNotes notes_;
  ExposedLights exposed_;
  tinygltf::Model model_;
  Binary binary_;
  MaterialWriter materials_;
  MeshWriter meshes_;
  Transform mirror_;
};

}  // namespace

}  // namespace gltf

Diagnostics write_gltf(const Scene& scene, const std::filesystem::path& out) {
  gltf::Writer writer(scene);
  writer.write();
  std::string suffix = out.extension().string();
  for (char& c : suffix) c = static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
  return writer.save(out, suffix == ".glb");
}

}  // namespace vitrail
