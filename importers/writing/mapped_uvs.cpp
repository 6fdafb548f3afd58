// SPDX-License-Identifier: Apache-2.0
#include "importers/writing/mapped_uvs.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <set>

#include "scene/models/texture_mapping.h"
#include "scene/records/field_search.h"
#include "scene/records/material_traits.h"
#include "scene/shapes/deferred_mesh.h"
#include "scene/shapes/mesh_uv.h"

namespace vitrail {

namespace {

// What a record's textures are laid out by, those within textures too.
struct Layouts : FieldSearch<Layouts> {
  using FieldSearch::in;
  explicit Layouts(const Scene& of) : scene(of) {}
  const Scene& scene;
  std::set<std::uint32_t> textures;
  std::vector<TextureMapping> mappings;

  void in(Id<Texture> id) {
    if (textures.insert(id.value).second)
      in(static_cast<const TextureVariant&>(scene.textures.at(id.value).model));
  }
  void in(const FloatParameter& p) {
    if (const auto* id = std::get_if<Id<Texture>>(&p)) in(*id);
  }
  void in(const SpectrumParameter& p) {
    if (const auto* id = std::get_if<Id<Texture>>(&p)) in(*id);
  }
  void in(const TextureMapping& mapping) {
    if (std::ranges::find(mappings, mapping) == mappings.end()) mappings.push_back(mapping);
  }
  void in(const PtexTexture&) { in(TextureMapping{}); }
  void in(const CheckerboardTexture& t) {
    if (!t.solid) in(t.mapping);
    in(t.even), in(t.odd);
  }
  // False where something goes by the direction of u.
  bool of_material(Id<Material> id) {
    const Material& material = scene.materials.at(id.value);
    const MaterialTraits traits = traits_of(material.model);
    if (material.normal_map) in(*material.normal_map);
    if (material.displacement) in(*material.displacement);
    in(static_cast<const MaterialVariant&>(material.model));
    bool free = !material.normal_map && !traits.along_surface && !traits.fibre;
    for (const Id<Material> part : parts_of(material.model)) free = of_material(part) && free;
    return free;
  }
  bool of_shape(const Shape& shape) {
    in(shape.opacity);
    const bool free = of_material(shape.material);
    if (!shape.area_light) return free;
    const SpectrumParameter& radiance = scene.area_lights.at(shape.area_light->value).radiance;
    in(radiance);
    return free && !std::holds_alternative<Id<Texture>>(radiance);  // writers lay out images of lamps
  }
};

struct Plan {
  std::set<std::uint32_t> textures;       // that show on the shape
  std::optional<TextureMapping> mapping;  // to write into its (u,v)
};

bool can_have_uvs(const TriangleMesh& mesh) {
  return !mesh.places && !(mesh.quadric && mesh.quadric->kind == QuadricKind::curve);
}

Plan plan_of(const Scene& scene, const Shape& shape, bool in_prototype,
             bool (*is_kept)(const TextureMapping&)) {
  Layouts layouts(scene);
  const bool free = layouts.of_shape(shape);
  Plan plan{layouts.textures, {}};
  if (!free || layouts.mappings.size() != 1 || is_kept(layouts.mappings[0])) return plan;
  const bool by_uv = std::holds_alternative<UvMapping>(layouts.mappings[0]);
  if (can_have_uvs(scene.meshes.at(shape.mesh.value)) && (by_uv || !in_prototype))
    plan.mapping = layouts.mappings[0];
  return plan;
}

PreparedMapping prepared(const TextureMapping& mapping) {
  PreparedMapping result{mapping, {}};
  std::visit(
      [&](const auto& m) {
        if constexpr (requires { m.texture_to_world; }) result.world_to_texture = inverse(m.texture_to_world);
      },
      mapping);
  return result;
}

Vector3d as_vector(Normal3f n) { return {n.x, n.y, n.z}; }

// Corners of a smaller triangle: shares of the corners of the one that it lies in.
using Shares = std::array<std::array<double, 3>, 3>;

// (u,v) of a mapping around an axis, on triangles so small that they are as good as linear on each.
class Wrapped {
 public:
  Wrapped(const TriangleMesh& mesh, const Transform& to_world, const PreparedMapping& mapping)
      : mesh_(mesh), to_world_(to_world), mapping_(mapping) {}

  // Nothing where there would be too many.
  std::optional<TriangleMesh> make() {
    result_.missing_uv = mesh_.missing_uv;
    for (std::size_t i = 0; i < mesh_.triangles.size(); ++i) {
      split(i, {{{1, 0, 0}, {0, 1, 0}, {0, 0, 1}}}, 0);
      if (result_.triangles.size() > most) return std::nullopt;
    }
    return std::move(result_);
  }

 private:
  static constexpr std::size_t most = std::size_t{1} << 20;
  static constexpr int deepest = 7;
  static constexpr double tolerance = 0.002;

  Point3d at(std::size_t triangle, const std::array<double, 3>& share) const {
    Point3d p{};
    for (std::size_t k = 0; k < 3; ++k)
      p = p + (cast<double>(mesh_.positions[mesh_.triangles[triangle][k]]) - Point3d{}) * share[k];
    return transform_point(to_world_, p);
  }
  // Of the turn that is nearest to `like`.
  Point2d uv(Point3d p, const MappedPoint& like) const {
    const MappedPoint m = map_point(mapping_, {}, p);
    const bool on_axis = std::abs(m.s - like.s) == 0.5;
    return {on_axis ? m.s : m.s + std::round(like.s - m.s), m.t + std::round(like.t - m.t)};
  }
  static std::array<double, 3> middle(const std::array<double, 3>& a, const std::array<double, 3>& b) {
    return {(a[0] + b[0]) / 2, (a[1] + b[1]) / 2, (a[2] + b[2]) / 2};
  }
  void split(std::size_t triangle, const Shares& c, int depth) {
    std::array<double, 3> centre{};
    for (std::size_t k = 0; k < 3; ++k) centre[k] = (c[0][k] + c[1][k] + c[2][k]) / 3;
    const MappedPoint like = map_point(mapping_, {}, at(triangle, centre));
    std::array<Point2d, 3> corners;
    for (std::size_t k = 0; k < 3; ++k) corners[k] = uv(at(triangle, c[k]), like);
    double off = 0;
    for (std::size_t k = 0; k < 3; ++k) {
      const Point2d &a = corners[k], &b = corners[(k + 1) % 3],
                    half = uv(at(triangle, middle(c[k], c[(k + 1) % 3])), like);
      off = std::max({off, std::abs(half.x - (a.x + b.x) / 2), std::abs(half.y - (a.y + b.y) / 2)});
    }
    if (off <= tolerance || depth == deepest) return add(triangle, c, corners);
    const auto ab = middle(c[0], c[1]), bc = middle(c[1], c[2]), ca = middle(c[2], c[0]);
    for (const Shares& part :
         {Shares{c[0], ab, ca}, Shares{ab, c[1], bc}, Shares{ca, bc, c[2]}, Shares{ab, bc, ca}})
      split(triangle, part, depth + 1);
  }
  void add(std::size_t triangle, const Shares& c, const std::array<Point2d, 3>& uvs) {
    const auto first = static_cast<std::uint32_t>(result_.positions.size());
    result_.triangles.push_back({first, first + 1, first + 2});
    const auto& t = mesh_.triangles[triangle];
    for (std::size_t k = 0; k < 3; ++k) {
      Vector3d p{}, n{};
      for (std::size_t i = 0; i < 3; ++i) {
        p = p + (cast<double>(mesh_.positions[t[i]]) - Point3d{}) * c[k][i];
        if (!mesh_.normals.empty()) n = n + as_vector(mesh_.normals[t[i]]) * c[k][i];
      }
      result_.positions.push_back(cast<float>(Point3d{} + p));
      if (!mesh_.normals.empty())
        result_.normals.push_back(
            {static_cast<float>(n.x), static_cast<float>(n.y), static_cast<float>(n.z)});
      result_.uvs.push_back({static_cast<float>(uvs[k].x), static_cast<float>(uvs[k].y)});
    }
  }

  const TriangleMesh& mesh_;
  const Transform& to_world_;
  const PreparedMapping& mapping_;
  TriangleMesh result_;
};

// The mesh with (u,v) of the mapping.
std::optional<TriangleMesh> mapped(const TriangleMesh& mesh, const Transform& to_world,
                                   const TextureMapping& mapping) {
  const PreparedMapping prepared_mapping = prepared(mapping);
  const bool by_uv = std::holds_alternative<UvMapping>(mapping);
  if (!by_uv && !std::holds_alternative<PlanarMapping>(mapping)) {
    if (!mesh.attributes.empty()) return std::nullopt;
    return Wrapped(mesh, to_world, prepared_mapping).make();
  }
  TriangleMesh result = by_uv ? with_uvs(mesh) : mesh;
  result.uvs.resize(result.positions.size());
  for (std::size_t i = 0; i < result.uvs.size(); ++i) {
    const MappedPoint m = map_point(prepared_mapping, {result.uvs[i].x, result.uvs[i].y},
                                    transform_point(to_world, cast<double>(result.positions[i])));
    result.uvs[i] = {static_cast<float>(m.s), static_cast<float>(m.t)};
  }
  return result;
}

// A texture that shows on a mesh which stays as it is stays as it is, too, and so on.
void keep_apart(const Scene& scene, std::vector<Plan>& plans) {
  Layouts of_lights(scene);
  for (const Light& light : scene.lights) of_lights.in(static_cast<const LightVariant&>(light.model));
  std::set<std::uint32_t> kept = of_lights.textures;
  for (bool more = true; more;) {
    more = false;
    for (Plan& plan : plans) {
      if (plan.mapping && std::ranges::any_of(plan.textures, [&](auto id) { return kept.contains(id); }))
        plan.mapping.reset();
      if (plan.mapping) continue;
      const std::size_t before = kept.size();
      kept.insert(plan.textures.begin(), plan.textures.end());
      more = more || kept.size() > before;
    }
  }
}

}  // namespace

std::optional<MappedUvs> with_mapped_uvs(const Scene& scene, bool (*is_kept)(const TextureMapping&)) {
  std::vector<Plan> plans;
  std::vector<const Shape*> shapes;
  const auto plan = [&](const std::vector<Shape>& list, bool in_prototype) {
    for (const Shape& shape : list) {
      shapes.push_back(&shape);
      plans.push_back(plan_of(scene, shape, in_prototype, is_kept));
    }
  };
  plan(scene.shapes, false);
  for (const Prototype& prototype : scene.prototypes) plan(prototype.shapes, true);
  keep_apart(scene, plans);
  std::vector<std::optional<TriangleMesh>> meshes(plans.size());
  for (std::size_t i = 0; i < plans.size(); ++i) {
    if (!plans[i].mapping) continue;
    TriangleMesh storage;
    meshes[i] = mapped(loaded(scene.meshes[shapes[i]->mesh.value], storage), shapes[i]->object_to_world,
                       *plans[i].mapping);
    if (!meshes[i]) plans[i].mapping.reset();
  }
  keep_apart(scene, plans);
  if (std::ranges::none_of(plans, [](const Plan& p) { return p.mapping.has_value(); })) return std::nullopt;

  MappedUvs result{scene, {}};
  std::size_t next = 0;
  const auto apply = [&](std::vector<Shape>& list) {
    for (Shape& shape : list) {
      const std::size_t i = next++;
      if (!plans[i].mapping) continue;
      const TriangleMesh& from = scene.meshes[shape.mesh.value];
      if (from.quadric || meshes[i]->triangles.size() > from.triangles.size())
        result.notes.emplace_back(shape.origin,
                                  fmt::format("its textures are laid out by the (u,v) of {} triangles",
                                              meshes[i]->triangles.size()));
      for (const std::uint32_t id : plans[i].textures)
        std::visit(
            [](auto& model) {
              if constexpr (requires { model.mapping; }) model.mapping = UvMapping{};
            },
            static_cast<TextureVariant&>(result.scene.textures[id].model));
      shape.mesh = {static_cast<std::uint32_t>(result.scene.meshes.size())};
      result.scene.meshes.push_back(std::move(*meshes[i]));
    }
  };
  apply(result.scene.shapes);
  for (Prototype& prototype : result.scene.prototypes) apply(prototype.shapes);
  return result;
}

void note(ConversionNotes& notes, const std::optional<MappedUvs>& mapped) {
  if (!mapped) return;
  for (const auto& [origin, text] : mapped->notes) notes.approximated(text, origin, RecordKind::shape);
}

bool is_unturned(const TextureMapping& mapping) {
  const auto* m = std::get_if<UvMapping>(&mapping);
  return m && m->b == 0 && m->d == 0;
}

}  // namespace vitrail
