// SPDX-License-Identifier: Apache-2.0
#include "partitioner/caching/world_key.h"

#include <array>
#include <map>
#include <span>
#include <string_view>
#include <type_traits>

#include "partitioner/caching/content_hash.h"
#include "scene/records/texture_inputs.h"
#include "scene/shapes/deferred_mesh.h"
#include "scene/system/diagnostics.h"

namespace vitrail {

namespace {

// Members one at a time: what lies between them in memory is anything.
class Adder {
 public:
  template <class T>
  requires std::is_arithmetic_v<T> || std::is_enum_v<T>
  void add(T value) { hash_.add(std::as_bytes(std::span(&value, 1))); }
  void add(std::string_view text) { hash_.add(text); }
  // Of elements without gaps.
  template <class T>
  void add_all(const std::vector<T>& values) {
    static_assert(sizeof(T) % sizeof(float) == 0 && std::is_trivially_copyable_v<T>);
    hash_.add(std::as_bytes(std::span(values)));
  }
  void add(const Transform& t) { hash_.add(std::as_bytes(std::span(t.m))); }
  void add(const Affine& a) { hash_.add(std::as_bytes(std::span(a.m))); }
  template <class V>
  requires requires(V v) { v.x, v.y, v.z; }
  void add(const V& v) { add(v.x), add(v.y), add(v.z); }
  void add(const Bounds3f& b) { add(b.lower), add(b.upper); }
  void add(const Quadric& q) { add(q.kind), add(q.uv), add(q.low), add(q.high), add(q.phi_max_rad); }

  ContentHash& hash() { return hash_; }

 private:
  ContentHash hash_;
};

std::string hash_of(const TriangleMesh& of) {
  Adder a;
  TriangleMesh storage;
  a.add(of.quadric.has_value());
  if (of.quadric) a.add(*of.quadric);
  const TriangleMesh& mesh = of.quadric ? of : loaded(of, storage);
  static_assert(sizeof(Point3f) == 12 && sizeof(Normal3f) == 12 && sizeof(Point2f) == 8);
  a.add_all(mesh.positions), a.add_all(mesh.triangles), a.add_all(mesh.normals), a.add_all(mesh.uvs);
  a.add(of.missing_uv), a.add(mesh.missing_uv);
  a.add(mesh.attributes.size());
  for (const MeshAttribute& attribute : mesh.attributes) {
    a.add(attribute.name), a.add(attribute.per_face), a.add(attribute.channels);
    a.add_all(attribute.values);
  }
  return a.hash().hex();
}

class WorldAdder : public Adder {
 public:
  using Adder::add;

  explicit WorldAdder(std::vector<std::pair<const TriangleMesh*, std::string>>& deferred)
      : deferred_(deferred) {}

  void add(const World& w) {
    const Manifest& m = w.manifest;
    add(m.triangles), add(m.offset);
    add(m.core.has_value());
    if (m.core) add(*m.core);
    add_requirements(m.requirements);
    add_surfaces(m);
    for (const TextureBaker::Attribute& attribute : w.attributes) add(attribute);
    add(w.placements.size());
    for (const Placement& p : w.placements) add(p);
    add(w.shining.size());
    for (const ShiningPlacement& s : w.shining)
      add(s.placement), add(s.area_light), add(s.opacity, m.textures);
    add(w.instance_bounds);
    add(w.objects.size());
    for (const WorldObject& o : w.objects) {
      add(o.first_surface), add(o.surface_count);
      add(o.assembly);
    }
    add(w.uses);
    add(w.runs.size());
    for (const QuadricRun& run : w.runs) {
      add(run.places->size());
      add(*run.quadric);
      for_each_use(run, [&](const ObjectUse& use) { add(use); });
    }
  }

  void add(const PartitionOptions& o) {
    add(o.domains), add(o.domain_bytes), add(o.memory_bytes), add(o.domains_at_once);
    add(o.flatten), add(o.median), add(o.everything);
  }

 private:
  void add_requirements(const Requirements& r) {
    for (const bool needed :
         {r.shading_normals, r.uv, r.filtering, r.dispersion, r.refraction, r.see_through, r.media, r.motion})
      add(needed);
  }

  void add(const FloatParameter& opacity, const std::vector<Texture>& textures) {
    add(opacity.index());
    add(reads_attribute(textures, opacity));
    if (const auto* texture = std::get_if<Id<Texture>>(&opacity)) add(texture->value);
    if (const auto* value = std::get_if<float>(&opacity)) add(*value);
  }

  // Those that emit, for the triangles of theirs that the manifest lists.
  void add_surfaces(const Manifest& m) {
    for (const Surface& surface : m.surfaces) {
      if (!is_lamp(m.area_lights, surface)) continue;
      add(surface.first_triangle), add(surface.area_light);
      add(surface.opacity, m.textures);
      add(reads_attribute(m.textures, m.area_lights[static_cast<std::size_t>(surface.area_light)].radiance));
    }
    add(m.surfaces.size());
    for (const Surface& surface : m.surfaces)
      add(surface.first_triangle), add(is_lamp(m.area_lights, surface));
  }

  void add(const TextureBaker::Attribute& attribute) {
    add(attribute.name), add(attribute.use);
    for (const float factor : attribute.tint) add(factor);
    add(attribute.tiles != nullptr);
    if (!attribute.tiles) return;
    add(attribute.tiles->width), add(attribute.tiles->height);
    add_all(attribute.tiles->tiles);
  }

  void add(const Placement& p) {
    const auto [known, is_new] = meshes_.try_emplace(p.mesh);
    if (is_new) {
      known->second = hash_of(*p.mesh);
      if (p.mesh->deferred) deferred_.emplace_back(p.mesh, known->second);
    }
    add(known->second);
    add(p.to_world), add(p.flip), add(p.first_triangle);
    add(p.standing.has_value());
    if (p.standing) add(p.standing->centre), add(p.standing->to_bundle);
  }

  void add(const ObjectUse& use) { add(use.object), add(use.to_parent), add(use.first_triangle); }
  void add(const std::vector<ObjectUse>& uses) {
    add(uses.size());
    for (const ObjectUse& use : uses) add(use);
  }

  void add(const Assembly& object) {
    add(object.quadric.has_value());
    if (object.quadric) add(*object.quadric);
    add(object.placements.size());
    for (const Placement& p : object.placements) add(p);
    add(object.uses);
    add(object.triangles), add(object.centre), add(object.depth);
    add(object.motion != nullptr);
    if (!object.motion) return;
    add(object.motion->keys().size());
    for (const Keyframe& key : object.motion->keys()) add(key.time_s), add(key.transform);
  }

  std::map<const TriangleMesh*, std::string> meshes_;
  std::vector<std::pair<const TriangleMesh*, std::string>>& deferred_;
};

}  // namespace

WorldKey::WorldKey(const World& world, const RenderSettings& settings, const PartitionOptions& options,
                   const std::filesystem::path& program) {
  WorldAdder all(deferred_);
  all.hash().add_content(program);
  all.add(options);
  all.add(settings.rgb);  // mesh attributes become spectra by it
  all.add(world);
  text_ = all.hash().hex();
}

bool WorldKey::holds() const {
  try {
    for (const auto& [mesh, hash] : deferred_)
      if (hash_of(*mesh) != hash) return false;
  } catch (const Error&) {
    return false;
  }
  return true;
}

}  // namespace vitrail
