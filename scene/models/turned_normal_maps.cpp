// SPDX-License-Identifier: Apache-2.0
#include "scene/models/turned_normal_maps.h"

#include <algorithm>
#include <iterator>
#include <set>
#include <type_traits>

#include "scene/geometry/transform.h"
#include "scene/models/normal_map.h"
#include "scene/records/fields.h"
#include "scene/records/material_traits.h"
#include "scene/shapes/deferred_mesh.h"
#include "scene/shapes/mesh_parts.h"
#include "scene/shapes/mesh_uv.h"

namespace vitrail {

namespace {

template <class T>
Id<T> kept(std::vector<T>& all, T value) {
  const auto at = std::ranges::find(all, value);
  const auto index = static_cast<std::uint32_t>(at - all.begin());
  if (at == all.end()) all.push_back(std::move(value));
  return {index};
}

bool is_mirrored(const CornerUvs& uv) {
  const auto along = [](float to, float from) { return static_cast<double>(to) - static_cast<double>(from); };
  return along(uv[1].x, uv[0].x) * along(uv[2].y, uv[0].y) <
         along(uv[2].x, uv[0].x) * along(uv[1].y, uv[0].y);
}

// The shapes of a scene whose normal maps are to be turned.
class ShapeTurner {
 public:
  explicit ShapeTurner(Scene& scene) : scene_(scene), materials_(scene) {
    const auto find_uses = [&](const std::vector<Shape>& shapes) {
      for (const Shape& shape : shapes)
        uses_.insert({shape.mesh.value, key_of(materials_.layout(shape.material)).value_or(plain)});
    };
    find_uses(scene.shapes);
    for (const Prototype& prototype : scene.prototypes) find_uses(prototype.shapes);
  }

  void turn() {
    scene_.shapes = turned(std::move(scene_.shapes));
    for (Prototype& prototype : scene_.prototypes) prototype.shapes = turned(std::move(prototype.shapes));
    turn_mirrored_instances(scene_, materials_);
  }

 private:
  using Part = std::pair<AgainstAxes, Id<TriangleMesh>>;
  using Layout = std::uint8_t;          // by its axes
  static constexpr Layout plain = 255;  // without a normal map

  static std::optional<Layout> key_of(const std::optional<UvMapping>& m) {
    return m ? std::optional<Layout>((m->a < 0 ? 1 : 0) + (m->e < 0 ? 2 : 0)) : std::nullopt;
  }

  std::vector<Shape> turned(std::vector<Shape> shapes) {
    std::vector<Shape> all;
    for (Shape& shape : shapes) {
      const std::optional<UvMapping> layout = materials_.layout(shape.material);
      if (!layout || scene_.meshes[shape.mesh.value].quadric) {
        all.push_back(std::move(shape));
        continue;
      }
      for (const auto& [against, mesh] : parts(shape.mesh, *layout)) {
        Shape& part = all.emplace_back(shape);
        part.mesh = mesh;
        part.material =
            materials_.turned(shape.material, {against.first, against.second != shape.flip_orientation});
      }
    }
    return all;
  }

  // The first part takes the place of the mesh where all its shapes show it so.
  const std::vector<Part>& parts(Id<TriangleMesh> id, const UvMapping& mapping) {
    const auto [at, is_new] = parts_.try_emplace({id.value, *key_of(mapping)});
    if (!is_new) return at->second;
    TriangleMesh storage;
    const TriangleMesh whole = loaded(scene_.meshes[id.value], storage);
    std::vector<UvPart> by_side = uv_parts(whole, mapping);
    if (by_side.size() < 2) {
      at->second.emplace_back(by_side.empty() ? AgainstAxes{} : by_side[0].against, id);
      return at->second;
    }
    MeshMemory memory(scene_.meshes[id.value].deferred ? 0 : ~std::uint64_t{0});
    const auto uses = [&](std::uint32_t mesh) { return uses_.lower_bound({mesh, 0}); };
    const bool takes_place = std::distance(uses(id.value), uses(id.value + 1)) == 1;
    for (const UvPart& side : by_side) {
      TriangleMesh part = memory.keep(only_triangles(whole, side.triangles), {});
      if (takes_place && at->second.empty()) {
        scene_.meshes[id.value] = std::move(part);
        at->second.emplace_back(side.against, id);
      } else {
        scene_.meshes.push_back(std::move(part));
        at->second.emplace_back(side.against,
                                Id<TriangleMesh>{static_cast<std::uint32_t>(scene_.meshes.size() - 1)});
      }
    }
    return at->second;
  }

  Scene& scene_;
  TurnedMaterials materials_;
  std::set<std::pair<std::uint32_t, Layout>> uses_;  // of meshes
  std::map<std::pair<std::uint32_t, Layout>, std::vector<Part>> parts_;
};

}  // namespace

std::vector<UvPart> uv_parts(const TriangleMesh& mesh, const UvMapping& mapping) {
  const bool first = mapping.a < 0, second = mapping.e < 0;
  UvPart straight{{first, second}, {}}, mirrored{{first, !second}, {}};
  for (std::size_t i = 0; i < mesh.triangles.size(); ++i)
    (is_mirrored(uvs_of(mesh, i)) ? mirrored : straight).triangles.push_back(static_cast<std::uint32_t>(i));
  std::vector<UvPart> parts;
  for (UvPart* part : {&straight, &mirrored})
    if (!part->triangles.empty()) parts.push_back(std::move(*part));
  std::ranges::sort(parts, {}, &UvPart::against);
  return parts;
}

std::optional<UvMapping> TurnedMaterials::layout(Id<Material> id) const {
  const Material& material = scene_.materials.at(id.value);
  if (material.normal_map)
    if (const auto map = normal_map_of(scene_.textures, *material.normal_map)) {
      const auto& image = std::get<ImageTexture>(scene_.textures[map->image.value].model);
      if (const auto* mapping = std::get_if<UvMapping>(&image.mapping)) return *mapping;
    }
  for (const Id<Material> part : parts_of(material.model))
    if (const auto mapping = layout(part)) return mapping;
  return {};
}

Id<Texture> TurnedMaterials::turned_map(Id<Texture> id, AgainstAxes against, const Origin& origin) {
  std::optional<NormalMap> map = normal_map_of(scene_.textures, id);
  if (!map) return id;
  if (against.first) map->factors[0] = -map->factors[0];
  if (against.second) map->factors[1] = -map->factors[1];
  if (map->factors == std::array{1.0f, 1.0f, 1.0f}) return map->image;
  return kept(scene_.textures, Texture{scaled_normal_map(*map), false, "", origin});
}

Id<Material> TurnedMaterials::turned(Id<Material> id, AgainstAxes against) {
  if (against == AgainstAxes{}) return id;
  const auto [at, is_new] = known_.try_emplace({id.value, against}, id);
  if (!is_new || !layout(id)) return at->second;
  Material material = scene_.materials[id.value];
  if (material.normal_map) material.normal_map = turned_map(*material.normal_map, against, material.origin);
  const auto turn = [&](auto& field) {
    if constexpr (std::is_same_v<decltype(field), Id<Material>&>) field = turned(field, against);
  };
  const auto turn_all = [&](auto&... fields) { (turn(fields), ...); };
  std::visit([&](auto& model) { visit_fields(model, turn_all); },
             static_cast<MaterialVariant&>(material.model));
  return at->second = kept(scene_.materials, std::move(material));
}

void turn_mirrored_instances(Scene& scene, TurnedMaterials& materials) {
  std::map<std::uint32_t, Id<Prototype>> mirrored;
  for (Instance& instance : scene.instances) {
    if (!swaps_handedness(instance.prototype_to_world)) continue;
    const std::uint32_t id = instance.prototype.value;
    if (std::ranges::none_of(scene.prototypes[id].shapes, [&](const Shape& shape) {
          return materials.layout(shape.material).has_value();
        }))
      continue;
    const auto [at, is_new] = mirrored.try_emplace(id);
    if (is_new) {
      Prototype prototype = scene.prototypes[id];
      for (Shape& shape : prototype.shapes) shape.material = materials.turned(shape.material, {false, true});
      at->second = kept(scene.prototypes, std::move(prototype));
    }
    instance.prototype = at->second;
  }
}

void turn_normal_maps(Scene& scene) { ShapeTurner(scene).turn(); }

}  // namespace vitrail
