// SPDX-License-Identifier: Apache-2.0
#include "partitioner/placing/place_scene.h"

#include <fmt/format.h>
#include <tbb/parallel_for.h>
#include <tbb/parallel_for_each.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <span>
#include <utility>

#include "bundle/binary_records.h"
#include "bundle/checksum.h"
#include "bundle/triangle_number.h"
#include "scene/records/texture_inputs.h"
#include "scene/shapes/deferred_mesh.h"

namespace vitrail {

namespace {

// Tracing multiplies two coordinates in float.
constexpr float greatest_scale = 1e15f;

struct MeshUse {
  const TriangleMesh* mesh;
  std::vector<const Placement*> placements;
  // Of the loaded mesh and its placed vertices.
  std::uint64_t bytes() const {
    return mesh->deferred ? mesh->deferred->bytes * 3 / 2 : mesh->positions.size() * sizeof(Point3f);
  }
};

std::vector<MeshUse> uses_of_meshes(const World& world) {
  std::map<const TriangleMesh*, std::size_t> index;
  std::vector<MeshUse> uses;
  for (const Placement& p : world.placements) {
    const auto [known, is_new] = index.try_emplace(p.mesh, uses.size());
    if (is_new) uses.push_back({p.mesh, {}});
    uses[known->second].placements.push_back(&p);
  }
  return uses;
}

std::size_t blocks_of(const Placement& p) {
  return (triangles_of(*p.mesh) + block_triangles - 1) / block_triangles;
}

// The id of a place that nothing emits from.
constexpr std::uint32_t absent = 0xffffffffu;

// To the places from `first` on. Triangles without area emit nothing: their places stay empty.
void take_emissive(const PlacedTriangles& placed, std::uint64_t at, std::size_t count, std::uint64_t first_id,
                   std::uint32_t area_light, const FloatParameter& opacity, Emissive& out,
                   std::size_t first) {
  const std::size_t slots = out.attributes.empty() ? 0 : placed.attributes.size();
  for (std::size_t i = 0; i < count; ++i) {
    const Triangle& t = placed.triangles[at + i];
    const Vector3d normal =
        cross(cast<double>(t[1]) - cast<double>(t[0]), cast<double>(t[2]) - cast<double>(t[0]));
    if (!(length(normal) > 0)) continue;
    EmissiveTriangle& e = out.triangles[first + i];
    std::copy(t.begin(), t.end(), e.p);
    if (!placed.uvs.empty()) std::copy(placed.uvs[at + i].begin(), placed.uvs[at + i].end(), e.uv);
    e.triangle = triangle_number(first_id + i);
    e.area_light = area_light;
    for (std::size_t slot = 0; slot < slots; ++slot)
      out.attributes[(first + i) * slots + slot] = placed.attributes[slot][at + i];
    if (!out.opacities.empty()) out.opacities[first + i] = opacity;
  }
}

// Without the empty places.
void close_up(Emissive& all) {
  const std::size_t slots = all.triangles.empty() ? 0 : all.attributes.size() / all.triangles.size();
  std::size_t kept = 0;
  for (std::size_t i = 0; i < all.triangles.size(); ++i) {
    if (all.triangles[i].triangle == absent) continue;
    all.triangles[kept] = all.triangles[i];
    for (std::size_t slot = 0; slot < slots; ++slot)
      all.attributes[kept * slots + slot] = all.attributes[i * slots + slot];
    if (!all.opacities.empty()) all.opacities[kept] = all.opacities[i];
    ++kept;
  }
  all.triangles.resize(kept);
  all.attributes.resize(kept * slots);
  all.opacities.resize(all.opacities.empty() ? 0 : kept);
}

// A light that a ray hits is found by its number.
void require_own_numbers(const Emissive& all) {
  std::vector<std::uint32_t> numbers;
  for (const EmissiveTriangle& e : all.triangles) numbers.push_back(e.triangle);
  for (const EmissiveQuadric& e : all.quadrics) numbers.push_back(e.triangle);
  std::ranges::sort(numbers);
  if (std::ranges::adjacent_find(numbers) != numbers.end())
    throw Error(
        "two triangles that emit have one number, as happens in scenes of very many: another order of the "
        "scene's instances parts them");
}

std::uint32_t surface_of(std::span<const Surface> surfaces, const Placement& p) {
  const auto after = std::ranges::upper_bound(surfaces, p.first_triangle, {}, &Surface::first_triangle);
  return static_cast<std::uint32_t>(after - surfaces.begin() - 1);
}

bool shines(const World& world, const Placement& p) {
  const std::span<const Surface> surfaces = scene_surfaces(world.manifest);
  return is_lamp(world.manifest.area_lights, surfaces[surface_of(surfaces, p)]);
}

}  // namespace

void place_scene(const World& world, std::uint64_t load_bytes,
                 const std::function<void(const Block&)>& visit) {
  const std::vector<MeshUse> uses = uses_of_meshes(world);
  const PlacementRule rule = world.rule();
  const ReflectanceFitter fitter;
  const auto place_use = [&](const MeshUse& use) {
    TriangleMesh storage;
    const TriangleMesh& mesh = loaded(*use.mesh, storage);
    for (const Placement* p : use.placements) {
      const MeshPlacer placer(*p, mesh, rule, fitter);
      tbb::parallel_for(std::size_t{0}, blocks_of(*p), [&](std::size_t b) {
        const std::size_t begin = b * block_triangles;
        visit({*p, placer, begin, std::min(begin + block_triangles, mesh.triangles.size())});
      });
    }
  };
  for (std::size_t i = 0; i < uses.size();) {
    const std::size_t first = i;
    for (std::uint64_t bytes = 0; i < uses.size() && (i == first || bytes + uses[i].bytes() <= load_bytes);
         ++i)
      bytes += uses[i].bytes();
    tbb::parallel_for_each(uses.begin() + static_cast<std::ptrdiff_t>(first),
                           uses.begin() + static_cast<std::ptrdiff_t>(i), place_use);
  }
}

std::uint64_t emissive_triangles_of(const World& world) {
  std::uint64_t triangles = 0;
  for (const Placement& p : world.placements)
    if (shines(world, p)) triangles += triangles_of(*p.mesh);
  for (const ShiningPlacement& shining : world.shining)
    if (!shining.placement.mesh->quadric) triangles += triangles_of(*shining.placement.mesh);
  return triangles;
}

SceneTally::SceneTally(const World& world) : world_(world) {
  std::size_t blocks = 0;
  const std::span<const Surface> surfaces = scene_surfaces(world.manifest);
  const auto note_opacity = [&](const FloatParameter& opacity) {
    emissive_opacities_ = emissive_opacities_ || opacity != FloatParameter{1.0f};
    emissive_attributes_ = emissive_attributes_ || reads_attribute(world.manifest.textures, opacity);
  };
  for (const Placement& p : world.placements) {
    first_block_.push_back(blocks);
    blocks += blocks_of(p);
    surfaces_.push_back(surface_of(surfaces, p));
    const Surface& surface = surfaces[surfaces_.back()];
    if (is_lamp(world.manifest.area_lights, surface)) note_opacity(surface.opacity);
  }
  for (const ShiningPlacement& shining : world.shining)
    if (!shining.placement.mesh->quadric) note_opacity(shining.opacity);
  hashes_.resize(blocks);
  const Manifest& m = world.manifest;
  for (const AreaLight& light : m.area_lights)
    emissive_attributes_ = emissive_attributes_ || reads_attribute(m.textures, light.radiance);
  make_room_for_emissive();
}

void SceneTally::make_room_for_emissive() {
  struct Part {
    std::uint64_t first_id, count;
    std::size_t* place;
  };
  std::vector<Part> parts;
  first_emissive_.resize(world_.placements.size());
  first_shining_.resize(world_.shining.size());
  for (std::size_t i = 0; i < world_.placements.size(); ++i)
    if (const Placement& p = world_.placements[i]; shines(world_, p))
      parts.push_back({p.first_triangle, triangles_of(*p.mesh), &first_emissive_[i]});
  for (std::size_t i = 0; i < world_.shining.size(); ++i)
    if (const Placement& p = world_.shining[i].placement; !p.mesh->quadric)
      parts.push_back({p.first_triangle, triangles_of(*p.mesh), &first_shining_[i]});
  std::ranges::sort(parts, {}, &Part::first_id);
  std::size_t places = 0;
  for (const Part& part : parts) *part.place = std::exchange(places, places + part.count);
  EmissiveTriangle empty;
  empty.triangle = absent;
  emissive_.triangles.resize(places, empty);
  if (emissive_attributes_) emissive_.attributes.resize(places * world_.manifest.attributes);
  if (emissive_opacities_) emissive_.opacities.resize(places, 1.0f);
}

void SceneTally::add(const Block& block, const PlacedTriangles& placed, std::uint64_t at) {
  const std::size_t count = block.end - block.begin;
  const auto placement = static_cast<std::size_t>(&block.placement - world_.placements.data());
  const auto part = [&](const auto& values) { return std::as_bytes(std::span(values).subspan(at, count)); };
  Hasher hasher;
  hasher.add(part(placed.triangles));
  if (!placed.normals.empty()) hasher.add(part(placed.normals));
  if (!placed.uvs.empty()) hasher.add(part(placed.uvs));
  for (const auto& slot : placed.attributes) hasher.add(part(slot));
  hashes_[first_block_[placement] + block.begin / block_triangles] = hasher.digest();

  Bounds3f bounds;
  if (!block.placement.standing)
    for (const Triangle& t : std::span(placed.triangles).subspan(at, count))
      for (const Point3f& v : t) extend(bounds, v);
  if (const Surface& surface = world_.manifest.surfaces[surfaces_[placement]];
      is_lamp(world_.manifest.area_lights, surface))
    take_emissive(placed, at, count, block.placement.first_triangle + block.begin,
                  static_cast<std::uint32_t>(surface.area_light), surface.opacity, emissive_,
                  first_emissive_[placement] + block.begin);
  if (bounds.empty()) return;
  const std::lock_guard lock(mutex_);
  extend(bounds_, bounds);
}

void SceneTally::add_shining(const ShiningPlacement& shining, std::size_t first_emissive) {
  TriangleMesh storage;
  const Placement& p = shining.placement;
  if (p.mesh->quadric) {
    emissive_.quadrics.push_back({{*p.mesh->quadric, p.flip},
                                  p.standing.value().to_bundle,
                                  triangle_number(p.first_triangle),
                                  shining.area_light,
                                  shining.opacity});
    return;
  }
  const TriangleMesh& mesh = loaded(*p.mesh, storage);
  const PlacementRule rule = world_.rule();
  const ReflectanceFitter fitter;
  const std::size_t count = mesh.triangles.size();
  PlacedTriangles placed = make_room(rule, count);
  MeshPlacer(p, mesh, rule, fitter).place(0, count, placed, 0);
  take_emissive(placed, 0, count, p.first_triangle, shining.area_light, shining.opacity, emissive_,
                first_emissive);
}

// Instances, kept or copied, count as their boxes: the same bounds either way.
void SceneTally::finish(Manifest& m) {
  for (std::size_t i = 0; i < world_.shining.size(); ++i) add_shining(world_.shining[i], first_shining_[i]);
  m.bounds = bounds_;
  if (!world_.instance_bounds.empty()) extend(m.bounds, world_.instance_bounds);
  for (int axis = 0; axis < 3 && m.triangles > 0; ++axis)
    m.scale = std::max({m.scale, std::abs(m.bounds.lower[axis]), std::abs(m.bounds.upper[axis])});
  if (m.scale > greatest_scale)
    throw Error(
        fmt::format("the scene reaches {:g} from its centre; the most is {:g}", m.scale, greatest_scale));
  close_up(emissive_);
  if (m.triangles > triangle_numbers) require_own_numbers(emissive_);
  m.emissive_triangles = std::move(emissive_.triangles);
  m.emissive_attributes = std::move(emissive_.attributes);
  m.emissive_opacities = std::move(emissive_.opacities);
  m.emissive_quadrics = std::move(emissive_.quadrics);
  m.scene_hash = scene_hash_of(world_, m, hashes_);
}

std::uint64_t scene_hash_of(const World& world, const Manifest& m,
                            std::span<const std::uint64_t> block_hashes) {
  const std::uint64_t records = hash_of_records(m);
  Hasher hasher;
  hasher.add(std::as_bytes(block_hashes));
  for (const ObjectInfo& object : m.objects) hasher.add(std::as_bytes(std::span(&object.hash, 1)));
  // A member at a time: what lies between them is anything.
  const auto add_use = [&](const ObjectUse& use) {
    hasher.add(std::as_bytes(std::span(&use.object, 1)));
    hasher.add(std::as_bytes(std::span(use.to_parent.m)));
    hasher.add(std::as_bytes(std::span(&use.first_triangle, 1)));
  };
  for (const ObjectUse& use : world.uses) add_use(use);
  for (const QuadricRun& run : world.runs) for_each_use(run, add_use);
  hasher.add(std::as_bytes(std::span(&records, 1)));
  return hasher.digest();
}

}  // namespace vitrail
