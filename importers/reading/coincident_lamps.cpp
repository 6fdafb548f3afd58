// SPDX-License-Identifier: Apache-2.0
#include "importers/reading/coincident_lamps.h"

#include <fmt/format.h>

#include <algorithm>
#include <map>
#include <tuple>

#include "scene/shapes/deferred_mesh.h"
#include "scene/shapes/mesh_parts.h"
#include "scene/shapes/triangle_overlaps.h"
#include "scene/system/memory_guard.h"

namespace vitrail {

namespace {

// Rays find a glow at the nearest surface alone: it counts once as it is.
bool is_lamp(const Scene& scene, const Shape& shape) {
  return shape.area_light && scene.area_lights[shape.area_light->value].sampled;
}

// A triangle that shines.
struct Lamp {
  std::uint32_t shape, triangle;
  bool two_sided, flipped;  // flipped: its front is against `normal` of the flat triangle
};

class LampsOfSpace {
 public:
  LampsOfSpace(Scene& scene, std::vector<Shape>& shapes, Diagnostics& diagnostics)
      : scene_(scene), shapes_(shapes), diagnostics_(diagnostics) {}

  void run() {
    gone_.assign(shapes_.size(), false);
    if (triangles() > most_triangles) {
      say_incomplete();
    } else {
      ask_memory(triangles() * bytes_of_lamp);
      flat_.reserve(triangles());
      lamps_.reserve(triangles());
      gather(true);
      gather(false);
      find();
    }
    drop_quadrics();
    std::size_t index = 0;
    std::erase_if(shapes_, [&](const Shape&) { return gone_[index++]; });
  }

 private:
  const AreaLight& light_of(const Shape& shape) const { return scene_.area_lights[shape.area_light->value]; }
  bool shines(const Shape& shape) const { return is_lamp(scene_, shape); }

  // That shine.
  static constexpr std::uint64_t most_triangles = 1 << 20;
  // Each is in order, too, while those that overlap are sought.
  static constexpr std::uint64_t bytes_of_lamp = sizeof(Lamp) + sizeof(FlatTriangle) + sizeof(std::uint32_t);
  std::uint64_t triangles() const {
    std::uint64_t count = 0;
    for (const Shape& shape : shapes_)
      if (const TriangleMesh& mesh = scene_.meshes[shape.mesh.value]; shines(shape) && !mesh.quadric)
        count += triangles_of(mesh);
    return count;
  }

  void say_incomplete() {
    diagnostics_.push_back(
        {Fidelity::approximated,
         "so many surfaces shine here that those in one place were not all sought: each of them counts"});
  }

  // Those that shine to both sides come first: they cover the others.
  void gather(bool two_sided) {
    for (std::uint32_t i = 0; i < shapes_.size(); ++i) {
      const Shape& shape = shapes_[i];
      const TriangleMesh& mesh = scene_.meshes[shape.mesh.value];
      if (!shines(shape) || light_of(shape).two_sided != two_sided || mesh.quadric) continue;
      TriangleMesh storage;
      add(loaded(mesh, storage), i);
    }
  }

  void add(const TriangleMesh& mesh, std::uint32_t index) {
    const Shape& shape = shapes_[index];
    const bool flipped = shape.flip_orientation != swaps_handedness(shape.object_to_world);
    for (std::uint32_t t = 0; t < mesh.triangles.size(); ++t) {
      std::array<Point3d, 3> p;
      for (std::size_t k = 0; k < 3; ++k)
        p[k] = transform_point(shape.object_to_world, cast<double>(mesh.positions[mesh.triangles[t][k]]));
      const FlatTriangle flat = flat_triangle(p);
      if (!(flat.area > 0)) continue;
      flat_.push_back(flat);
      lamps_.push_back({index, t, light_of(shape).two_sided, flipped});
    }
  }

  bool shines_within(std::uint32_t inner, std::uint32_t outer) const {
    const Lamp &a = lamps_[inner], &b = lamps_[outer];
    if (shapes_[a.shape].opacity != shapes_[b.shape].opacity) return false;
    if (b.two_sided) return true;
    const bool turned = dot(flat_[inner].normal, flat_[outer].normal) < 0;
    return !a.two_sided && turned == (a.flipped != b.flipped);
  }

  void find() {
    bool complete = true;
    std::vector<Overlap> overlaps = overlaps_of(flat_, complete);
    std::ranges::sort(overlaps, {}, [](const Overlap& o) { return std::pair{o.second, o.first}; });
    std::vector<bool> dropped(lamps_.size());
    std::vector<double> covered(lamps_.size());
    for (std::size_t i = 0, end; i < overlaps.size(); i = end) {
      const std::uint32_t lamp = overlaps[i].second;
      for (end = i; end < overlaps.size() && overlaps[end].second == lamp; ++end)
        if (const std::uint32_t other = overlaps[end].first; !dropped[other] && shines_within(lamp, other))
          covered[lamp] += overlaps[end].area, under_[lamp_shape(lamp)] = lamp_shape(other);
      dropped[lamp] = covered[lamp] >= (1 - 1e-5) * flat_[lamp].area;
    }
    apply(dropped, covered);
    if (!complete) say_incomplete();
  }

  std::uint32_t lamp_shape(std::uint32_t lamp) const { return lamps_[lamp].shape; }

  void apply(const std::vector<bool>& dropped, const std::vector<double>& covered) {
    for (std::uint32_t first = 0, end; first < lamps_.size(); first = end) {
      std::vector<std::uint32_t> out;
      double all = 0, gone = 0, partly = 0;
      for (end = first; end < lamps_.size() && lamp_shape(end) == lamp_shape(first); ++end) {
        all += flat_[end].area;
        if (dropped[end])
          out.push_back(lamps_[end].triangle), gone += flat_[end].area;
        else
          partly += covered[end] > 0.01 * flat_[end].area ? covered[end] : 0;
      }
      const std::uint32_t shape = lamp_shape(first);
      if (partly > 0)
        note(shape, fmt::format("{:.3g} % of the area of this lamp lies on {}, and shines in addition",
                                100 * partly / all, name_of(under_[shape], shape)));
      if (out.empty()) continue;
      note(shape,
           fmt::format(
               "{} triangles of this lamp, {:.3g} % of its area, lie on {} and are left out: they would "
               "shine in addition",
               out.size(), 100 * gone / all, name_of(under_[shape], shape)));
      gone_[shape] = out.size() == end - first;  // triangles without area do not shine
      if (!gone_[shape]) leave_out(shape, out);
    }
  }

  std::string name_of(std::uint32_t other, std::uint32_t shape) const {
    if (other == shape) return "others of it";
    const bool alike = light_of(shapes_[other]).radiance == light_of(shapes_[shape]).radiance;
    return fmt::format("{}the lamp of {}", alike ? "" : "(another radiance) ",
                       to_string(location(scene_, shapes_[other].origin)));
  }

  void note(std::uint32_t shape, std::string message) {
    const SourceLocation place = location(scene_, shapes_[shape].origin);
    diagnostics_.push_back({Fidelity::approximated, std::move(message), place, place, RecordKind::shape});
  }

  void leave_out(std::uint32_t index, const std::vector<std::uint32_t>& out) {
    Shape& shape = shapes_[index];
    TriangleMesh storage;
    const TriangleMesh& mesh = loaded(scene_.meshes[shape.mesh.value], storage);
    std::vector<std::uint32_t> kept;
    for (std::uint32_t t = 0; t < mesh.triangles.size(); ++t)
      if (!std::ranges::binary_search(out, t)) kept.push_back(t);
    TriangleMesh rest = only_triangles(mesh, kept);  // other shapes may have the mesh too
    scene_.meshes.push_back(std::move(rest));
    shape.mesh = {static_cast<std::uint32_t>(scene_.meshes.size() - 1)};
  }

  // Equal ones at one place, by what they are and where they stand.
  void drop_quadrics() {
    std::vector<std::uint32_t> lamps;
    for (std::uint32_t i = 0; i < shapes_.size(); ++i)
      if (const TriangleMesh& mesh = scene_.meshes[shapes_[i].mesh.value];
          shines(shapes_[i]) && mesh.quadric && !mesh.places)
        lamps.push_back(i);
    std::ranges::stable_sort(lamps, {}, [&](std::uint32_t i) {
      return std::tuple{shapes_[i].object_to_world.m, !light_of(shapes_[i]).two_sided};
    });
    for (std::size_t i = 0; i < lamps.size(); ++i)
      for (std::size_t k = i;
           k-- > 0 && shapes_[lamps[k]].object_to_world == shapes_[lamps[i]].object_to_world;)
        if (!gone_[lamps[k]] && is_same_quadric(lamps[i], lamps[k])) {
          note(lamps[i], fmt::format("this lamp lies on {} and is left out: it would shine in addition",
                                     name_of(lamps[k], lamps[i])));
          gone_[lamps[i]] = true;
          break;
        }
  }

  bool is_same_quadric(std::uint32_t inner, std::uint32_t outer) const {
    const Shape &a = shapes_[inner], &b = shapes_[outer];
    return scene_.meshes[a.mesh.value].quadric == scene_.meshes[b.mesh.value].quadric &&
           a.opacity == b.opacity && (light_of(b).two_sided || a.flip_orientation == b.flip_orientation);
  }

  Scene& scene_;
  std::vector<Shape>& shapes_;
  Diagnostics& diagnostics_;
  std::vector<Lamp> lamps_;
  std::vector<FlatTriangle> flat_;  // of these
  std::vector<bool> gone_;          // shapes
  std::map<std::uint32_t, std::uint32_t> under_;
};

// Prototypes that shine, themselves or by what stands in them.
std::vector<bool> shining(const Scene& scene) {
  std::vector<bool> shine;
  for (const Prototype& p : scene.prototypes)
    shine.push_back(
        std::ranges::any_of(p.shapes, [&](const Shape& s) { return is_lamp(scene, s); }) ||
        std::ranges::any_of(p.instances, [&](const Instance& i) { return shine[i.prototype.value]; }));
  return shine;
}

void drop_instances(ImportedScene& imported, std::vector<Instance>& instances,
                    const std::vector<bool>& shine) {
  std::vector<std::uint32_t> order;
  for (std::uint32_t i = 0; i < instances.size(); ++i)
    if (shine[instances[i].prototype.value]) order.push_back(i);
  const auto key = [&](std::uint32_t i) {
    return std::tuple{instances[i].prototype.value, instances[i].prototype_to_world.m, i};
  };
  std::ranges::sort(order, {}, key);
  std::vector<bool> gone(instances.size());
  for (std::size_t i = 1; i < order.size(); ++i) {
    const Instance &a = instances[order[i - 1]], &b = instances[order[i]];
    if (!(a.prototype == b.prototype && a.prototype_to_world == b.prototype_to_world && a.motion == b.motion))
      continue;
    gone[order[i]] = true;
    const SourceLocation place = location(imported.scene, b.origin);
    imported.diagnostics.push_back(
        {Fidelity::approximated,
         "this instance, which shines, stands where an equal one does and is left out", place, place,
         RecordKind::instance});
  }
  std::size_t index = 0;
  std::erase_if(instances, [&](const Instance&) { return gone[index++]; });
}

}  // namespace

void drop_coincident_lamps(ImportedScene& imported) {
  Scene& scene = imported.scene;
  if (scene.area_lights.empty()) return;
  LampsOfSpace(scene, scene.shapes, imported.diagnostics).run();
  for (Prototype& prototype : scene.prototypes)
    LampsOfSpace(scene, prototype.shapes, imported.diagnostics).run();
  const std::vector<bool> shine = shining(scene);
  drop_instances(imported, scene.instances, shine);
  for (Prototype& prototype : scene.prototypes) drop_instances(imported, prototype.instances, shine);
}

}  // namespace vitrail
