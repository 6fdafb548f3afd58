// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>

#include <algorithm>
#include <iterator>
#include <map>

#include "cli/common/mesh_options.h"
#include "importers/shapes/shapes.h"
#include "partitioner/meshes/edit_meshes.h"
#include "scene/records/curve_uses.h"
#include "scene/records/kinds.h"
#include "scene/shapes/deferred_mesh.h"
#include "scene/shapes/quadric_places.h"
#include "scene/shapes/tessellate.h"
#include "scene/system/say.h"

namespace vitrail {

namespace {

// A quadric that stands in many places becomes as many shapes; curves stay together.
void part_places(Scene& scene) {
  std::vector<Shape> shapes;
  for (Shape& shape : scene.shapes) {
    const auto places = scene.meshes[shape.mesh.value].places;
    if (!places || is_curve(*scene.meshes[shape.mesh.value].quadric)) {
      shapes.push_back(std::move(shape));
      continue;
    }
    for (std::size_t i = 0; i < places->size(); ++i) {
      Transform place;
      places->read(i, {&place, 1});
      shapes.push_back(shape);
      shapes.back().object_to_world = shape.object_to_world * place;
    }
  }
  scene.shapes = std::move(shapes);
  for (TriangleMesh& mesh : scene.meshes)
    if (mesh.quadric && !is_curve(*mesh.quadric)) mesh.places.reset();
}

// What curves with gaps are of as tubes, where a ray meets both walls: nothing within, if it is to be
// rendered, since other formats have no such material; else of as much as lets through what the curve does.
class TubeMaterials {
 public:
  TubeMaterials(Scene& scene, bool to_render) : scene_(scene), to_render_(to_render) {}

  Diagnostics prepare() {
    traits_ = traits_of(scene_.materials);
    for (Shape& shape : scene_.shapes) prepare(shape);
    for (Prototype& prototype : scene_.prototypes)
      for (Shape& shape : prototype.shapes) prepare(shape);
    return std::move(notes_);
  }

 private:
  void prepare(Shape& shape) {
    if (!is_of_curves(scene_, shape) || shape.area_light || shape.opacity == FloatParameter{1.0f}) return;
    const InnerWall inner = to_render_ ? inner_wall(traits_[shape.material.value]) : InnerWall::as_the_outer;
    if (inner == InnerWall::nothing) {
      shape.material = hollow(shape.material);
    } else if (auto* opacity = std::get_if<float>(&shape.opacity);
               opacity && inner == InnerWall::as_the_outer) {
      *opacity = opacity_of_wall(*opacity);
    } else if (inner == InnerWall::as_the_outer) {
      const SourceLocation where = location(scene_, shape.origin);
      notes_.push_back({Fidelity::approximated, "both walls of a curve's tube have the opacity of its image",
                        where, where, RecordKind::shape});
    }
  }

  Id<Material> hollow(Id<Material> outer) {
    const auto [at, is_new] = hollow_.try_emplace(outer.value);
    if (!is_new) return at->second;
    const auto append = [&](Material material) {
      scene_.materials.push_back(std::move(material));
      return Id<Material>{static_cast<std::uint32_t>(scene_.materials.size() - 1)};
    };
    Material material = scene_.materials[outer.value];
    material.model = TwoSidedMaterial{outer, append({InterfaceMaterial{}})};
    return at->second = append(std::move(material));
  }

  Scene& scene_;
  const bool to_render_;
  std::vector<MaterialTraits> traits_;  // of the materials of the scene as it was
  std::map<std::uint32_t, Id<Material>> hollow_;
  Diagnostics notes_;
};

// Makes meshes of quadrics, which are made anew whenever they are loaded if they are too large to keep.
void tessellate_quadrics(Scene& scene, int segments, std::uint64_t kept_bytes) {
  std::uint64_t in_memory = 0, quadrics = 0, triangles = 0;
  for (const TriangleMesh& mesh : scene.meshes) in_memory += bytes_of(mesh);
  MeshMemory memory(kept_bytes - std::min(kept_bytes, in_memory));
  for (TriangleMesh& mesh : scene.meshes) {
    if (!mesh.quadric) continue;
    const auto make = [quadric = *mesh.quadric, places = mesh.places, segments] {
      return places ? tessellate(quadric, *places, segments) : tessellate(quadric, segments);
    };
    mesh = memory.keep(make(), make);
    triangles += triangles_of(mesh);
    ++quadrics;
  }
  say("quadrics: {} became {} triangles\n", quadrics, triangles);
}

// One for each quadric, at the first shape that has it.
Diagnostics notes_on_quadrics(const Scene& scene, int segments) {
  Diagnostics notes;
  std::vector<bool> noted(scene.meshes.size());
  const auto note = [&](const std::vector<Shape>& shapes) {
    for (const Shape& shape : shapes) {
      const std::optional<Quadric>& quadric = scene.meshes[shape.mesh.value].quadric;
      if (!quadric || noted[shape.mesh.value]) continue;
      noted[shape.mesh.value] = true;
      const SourceLocation where = location(scene, shape.origin);
      notes.push_back(
          {Fidelity::approximated,
           fmt::format("{} tessellated: {} segments for a full turn", kind_of(quadric->kind), segments),
           where, where, RecordKind::shape});
    }
  };
  note(scene.shapes);
  for (const Prototype& prototype : scene.prototypes) note(prototype.shapes);
  return notes;
}

}  // namespace

Diagnostics apply_mesh_options(const MeshOptions& o, Scene& scene, const MeshResources& resources,
                               bool to_render) {
  Diagnostics notes;
  if (o.tessellate > 0) {
    notes = notes_on_quadrics(scene, o.tessellate);
    part_places(scene);
    std::ranges::move(TubeMaterials(scene, to_render).prepare(), std::back_inserter(notes));
    tessellate_quadrics(scene, o.tessellate, resources.kept_bytes);
  }
  if (!o.edits_meshes()) return notes;
  const auto loop = [](const TriangleMesh& cage, int levels, std::vector<std::array<Point2d, 3>>& corners) {
    return loop_subdivide(cage, levels, &corners);
  };
  EditedMeshes edited = edit_meshes(scene, {o.repair, o.orient, o.subdivide, o.decimate, loop}, resources);
  say("meshes: {} triangles became {}\n", edited.triangles_before, edited.triangles_after);
  if (std::ranges::any_of(scene.meshes, [](const TriangleMesh& mesh) { return mesh.quadric.has_value(); }))
    say("meshes: quadrics stay as they are; --tessellate makes meshes of them first\n");
  std::ranges::move(edited.notes, std::back_inserter(notes));
  return notes;
}

}  // namespace vitrail
