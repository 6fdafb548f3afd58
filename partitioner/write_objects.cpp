// SPDX-License-Identifier: Apache-2.0
#include "partitioner/write_objects.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>
#include <tuple>

#include "partitioner/build_bvh.h"
#include "partitioner/write_domain.h"
#include "scene/deferred_mesh.h"

namespace vitrail {

namespace {

using Indices = std::vector<std::uint32_t>;

// Divides triangles by their centroids into so many parts of about equal numbers, each stored once.
void divide(const NumberedTriangles& object, Indices triangles, std::size_t parts,
            std::vector<Indices>& out) {
  if (parts <= 1 || triangles.size() <= 1) {
    std::ranges::sort(triangles);
    out.push_back(std::move(triangles));
    return;
  }
  const auto centroid = [&](std::uint32_t i, int axis) {
    const Triangle& t = object.triangles[i];
    return double{t[0][axis]} + double{t[1][axis]} + double{t[2][axis]};
  };
  Bounds3d box;
  for (const std::uint32_t i : triangles)
    extend(box, Point3d{centroid(i, 0), centroid(i, 1), centroid(i, 2)});
  const Vector3d e = extent(box);
  const int axis = e.x >= e.y && e.x >= e.z ? 0 : e.y >= e.z ? 1 : 2;
  const std::size_t below = parts / 2;
  const auto middle = triangles.begin() + static_cast<std::ptrdiff_t>(triangles.size() * below / parts);
  std::ranges::nth_element(triangles, middle, {},
                           [&](std::uint32_t i) { return std::tuple(centroid(i, axis), i); });
  Indices above(middle, triangles.end());
  triangles.erase(middle, triangles.end());
  divide(object, std::move(triangles), below, out);
  divide(object, std::move(above), parts - below, out);
}

double bytes_of(const NumberedTriangles& t) {
  return 62.0 + (t.normals.empty() ? 0 : 16) + (t.uvs.empty() ? 0 : 32) +
         48.0 * static_cast<double>(t.attributes.size());
}

// Of the files: an object of the plan is one or more of them.
struct Files {
  std::vector<std::uint32_t> first;  // of each object of the plan; one more at the end
  std::vector<Bounds3f> bounds;      // of each file
};

std::vector<InstanceRef> references(const std::vector<ObjectUse>& uses, const Files& files) {
  std::vector<InstanceRef> refs;
  for (const ObjectUse& use : uses)
    for (std::uint32_t file = files.first[use.object]; file < files.first[use.object + 1]; ++file) {
      InstanceRef& ref = refs.emplace_back(
          InstanceRef{use.to_parent, {}, {}, file, static_cast<std::uint32_t>(use.first_triangle)});
      set_box(ref, placed_bounds(use.to_parent, files.bounds[file]));
    }
  return refs;
}

std::vector<std::uint32_t> objects_of(const std::vector<InstanceRef>& refs) {
  std::vector<std::uint32_t> objects;
  for (const InstanceRef& ref : refs) objects.push_back(ref.object);
  std::ranges::sort(objects);
  objects.erase(std::unique(objects.begin(), objects.end()), objects.end());
  return objects;
}

// An object's own triangles, in its coordinates.
NumberedTriangles placed_alone(const World& world, const Assembly& object) {
  PlacementRule rule = world.rule();
  rule.offset = object.centre;
  const ReflectanceFitter fitter;
  std::uint64_t triangles = 0;
  for (const Placement& p : object.placements) triangles += triangles_of(*p.mesh);
  NumberedTriangles out{make_room(rule, triangles), {}};
  for (Placement p : object.placements) {
    TriangleMesh storage;
    p.mesh = &loaded(*p.mesh, storage);
    place(p, rule, fitter, out, out.ids.size());
    for (std::uint64_t i = 0; i < p.mesh->triangles.size(); ++i)
      out.ids.push_back(static_cast<std::uint32_t>(p.first_triangle + i));
  }
  return out;
}

}  // namespace

std::vector<InstanceRef> write_objects(const World& world, Manifest& m, const std::filesystem::path& bundle,
                                       std::uint64_t most_bytes) {
  Files files{{0}, {}};
  if (!world.objects.empty()) std::filesystem::create_directories(bundle / "objects");
  for (const WorldObject& o : world.objects) {
    const NumberedTriangles object = placed_alone(world, o.assembly);
    const double bytes = bytes_of(object) * static_cast<double>(object.ids.size());
    Indices all(object.ids.size());
    std::iota(all.begin(), all.end(), 0u);
    std::vector<Indices> parts;
    divide(object, std::move(all),
           static_cast<std::size_t>(std::max(1.0, std::ceil(bytes / static_cast<double>(most_bytes)))),
           parts);
    for (std::size_t part = 0; part < parts.size(); ++part) {
      std::vector<InstanceRef> refs;
      if (part == 0) refs = references(o.assembly.uses, files);
      Bounds3f box;
      for (const std::uint32_t t : parts[part])
        for (const Point3f& v : object.triangles[t]) extend(box, v);
      for (const InstanceRef& ref : refs) extend(box, box_of(ref));
      DomainContent content = make_domain(object, {std::move(parts[part]), {}, {}}, 0);
      ObjectInfo info{o.assembly.triangles, 0, 0, o.first_surface, o.surface_count, objects_of(refs)};
      add_instances(std::move(refs), 0, content);
      info.bytes = write_domain_file(object_path(bundle, static_cast<std::uint32_t>(m.objects.size())),
                                     content, &info.hash);
      m.objects.push_back(std::move(info));
      files.bounds.push_back(box);
    }
    files.first.push_back(static_cast<std::uint32_t>(m.objects.size()));
  }
  return references(world.uses, files);
}

std::vector<std::uint32_t> needed_objects(const Manifest& m, std::span<const InstanceRef> instances) {
  std::vector<bool> needed(m.objects.size());
  for (const InstanceRef& ref : instances) needed[ref.object] = true;
  std::vector<std::uint32_t> objects;
  for (std::size_t i = needed.size(); i-- > 0;)
    if (needed[i]) {
      objects.insert(objects.begin(), static_cast<std::uint32_t>(i));
      for (const std::uint32_t inner : m.objects[i].objects) needed[inner] = true;
    }
  return objects;
}

InstanceDealer::InstanceDealer(std::vector<InstanceRef> instances, float padding, const Bounds3f& root)
    : instances_(std::move(instances)), padding_(padding), root_(root) {
  std::vector<Bounds3f> boxes;
  for (const InstanceRef& ref : instances_) boxes.push_back(box_of(ref));
  tree_ = build_tree(boxes, padding);
}

std::vector<InstanceRef> InstanceDealer::in(Bounds3f cell) const {
  constexpr float infinity = std::numeric_limits<float>::infinity();
  for (int axis = 0; axis < 3; ++axis) {
    if (cell.lower[axis] <= root_.lower[axis]) cell.lower[axis] = -infinity;
    if (cell.upper[axis] >= root_.upper[axis]) cell.upper[axis] = infinity;
  }
  Indices found, pending;
  if (!tree_.empty()) pending.push_back(0);
  while (!pending.empty()) {
    const BvhNode& node = tree_[pending.back()];
    pending.pop_back();
    for (std::size_t i = 0; i < 8; ++i) {
      bool meets = node.child[i] != BvhNode::empty;
      for (int axis = 0; axis < 3; ++axis)
        meets = meets && node.lower[axis][i] <= cell.upper[axis] && node.upper[axis][i] >= cell.lower[axis];
      if (!meets) continue;
      if (node.child[i] & BvhNode::cluster_bit)
        found.push_back(node.child[i] & ~BvhNode::cluster_bit);
      else
        pending.push_back(node.child[i]);
    }
  }
  std::ranges::sort(found);
  std::vector<InstanceRef> refs;
  for (const std::uint32_t i : found) {
    InstanceRef ref = instances_[i];
    Bounds3f box = inflated(box_of(ref), padding_);
    for (int axis = 0; axis < 3; ++axis) {
      box.lower[axis] = std::max(box.lower[axis], cell.lower[axis]);
      box.upper[axis] = std::min(box.upper[axis], cell.upper[axis]);
    }
    if (box.empty()) continue;
    set_box(ref, box);
    refs.push_back(ref);
  }
  return refs;
}

}  // namespace vitrail
