// SPDX-License-Identifier: Apache-2.0
// Glass of a scene: panes by their makers' measurements; and solid glass whose surface encloses nothing, so
// that light takes the space behind it for its inside.
#include <algorithm>
#include <set>
#include <utility>

#include "cli/common/switching_glazing.h"
#include "cli/inspect/inspect.h"
#include "glazing/system_file.h"
#include "importers/reading/glazing_material.h"
#include "scene/records/material_traits.h"
#include "scene/shapes/deferred_mesh.h"
#include "scene/shapes/mesh_parts.h"

namespace vitrail {

namespace {

bool is_solid_glass(const Material& material) {
  if (const auto* disney = std::get_if<PrincipledMaterial>(&material.model))
    return !disney->thin && disney->spec_trans != FloatParameter{0.0f};
  return std::holds_alternative<DielectricMaterial>(material.model) ||
         std::holds_alternative<SubsurfaceMaterial>(material.model);
}

// Materials that are solid glass, or hold some: they refer to smaller ids alone.
std::vector<bool> glasses_of(const Scene& scene) {
  std::vector<bool> glass;
  for (const Material& m : scene.materials) {
    const auto is_glass = [&](Id<Material> part) { return bool{glass[part.value]}; };
    glass.push_back(is_solid_glass(m) || std::ranges::any_of(parts_of(m.model), is_glass));
  }
  return glass;
}

const char* words_for(MeshPart::Kind kind) {
  if (kind == MeshPart::Kind::folded) return "folded: two faces in one place";
  return kind == MeshPart::Kind::rimless ? "one of two faces without a rim" : "open";
}

// Of shapes in one space. Meshes alone: quadrics may close one another.
void add_open_parts(const Scene& scene, const std::vector<Shape>& shapes, const std::vector<bool>& glass,
                    const std::string& space, Report& table) {
  std::vector<const Shape*> used;
  std::vector<TriangleMesh> storage(shapes.size());
  std::vector<PlacedMesh> placed;
  for (const Shape& shape : shapes) {
    const TriangleMesh& mesh = scene.meshes[shape.mesh.value];
    if (!glass[shape.material.value] || mesh.quadric || mesh.places) continue;
    placed.push_back({&loaded(mesh, storage[used.size()]), shape.object_to_world});
    used.push_back(&shape);
  }
  for (const MeshPart& part : parts_of(placed)) {
    if (part.kind == MeshPart::Kind::closed) continue;
    const Shape& shape = *used[part.triangles.front().mesh];
    const std::string& name = scene.materials[shape.material.value].name;
    table.push_back({{"material", name.empty() ? Report(nullptr) : Report(name)},
                     {"is", words_for(part.kind)},
                     {"area", part.area},
                     {"centre", {part.centre.x, part.centre.y, part.centre.z}},
                     {"in", space},
                     {"where", to_string(location(scene, shape.origin))}});
  }
}

}  // namespace

Report describe_panes(const Scene& scene) {
  Report table = Report::array();
  const std::vector<bool> sides = sides_of_glazing(scene);
  std::set<std::pair<std::string, std::string>> listed;  // a material may stand twice, once for each use
  for (std::size_t i = 0; i < scene.materials.size(); ++i) {
    const std::string& name = scene.materials[i].name;
    const std::string file = glazing_file_of(scene.materials, i);
    if (file.empty() || sides[i] || !listed.emplace(name, file).second) continue;
    const GlazingSystem system = read_system({file}).system;
    const bool is_set = switches(system);
    table.push_back({{"name", name.empty() ? Report(nullptr) : Report(name)},
                     {"system", system.name.empty() ? Report(nullptr) : Report(system.name)},
                     {"panes", system.layers.size()},
                     {"set", is_set ? describe_setting(system) : ""},
                     {"can_be_set", is_set ? names_of_quantities(system) : ""}});
  }
  return table;
}

Report describe_open_glass(const Scene& scene) {
  Report table = Report::array();
  const std::vector<bool> glass = glasses_of(scene);
  if (std::ranges::none_of(glass, [](bool is) { return is; })) return table;
  add_open_parts(scene, scene.shapes, glass, "the scene", table);
  for (const Prototype& prototype : scene.prototypes)
    add_open_parts(scene, prototype.shapes, glass, "object \"" + prototype.name + "\"", table);
  return table;
}

}  // namespace vitrail
