// SPDX-License-Identifier: Apache-2.0
#include "partitioner/writing/write_objects.h"

#include <fmt/format.h>
#include <tbb/parallel_for.h>
#include <tbb/task_arena.h>

#include <algorithm>
#include <cmath>
#include <iterator>
#include <limits>
#include <map>
#include <numeric>
#include <tuple>
#include <utility>

#include "bundle/checksum.h"
#include "bundle/triangle_number.h"
#include "partitioner/hierarchy/build_bvh.h"
#include "partitioner/least_memory.h"
#include "partitioner/memory_plan.h"
#include "partitioner/placing/object_bounds.h"
#include "partitioner/writing/object_groups.h"
#include "partitioner/writing/write_domain.h"
#include "scene/shapes/deferred_mesh.h"
#include "scene/system/diagnostics.h"

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

// Of the files: an object of the plan is one or more of them; a quadric has the number of one without it.
struct Files {
  std::vector<const Assembly*> quadric;  // of each object of the plan, null where it is none
  std::vector<std::uint32_t> first;      // of each object of the plan; one more at the end
  std::vector<Bounds3f> bounds;          // of each file
  // Of each file before it is written: about its bytes, and the objects that it has instances of.
  std::vector<ObjectInfo> planned;
};

InstanceRef reference(const ObjectUse& use, std::uint32_t object, const Bounds3f& box) {
  InstanceRef ref{use.to_parent, {}, {}, object, triangle_number(use.first_triangle)};
  set_box(ref, box);
  return ref;
}

std::vector<InstanceRef> references(const std::vector<ObjectUse>& uses, const Files& files) {
  std::vector<InstanceRef> refs;
  for (const ObjectUse& use : uses)
    for (std::uint32_t file = files.first[use.object]; file < files.first[use.object + 1]; ++file)
      refs.push_back(reference(use, file,
                               files.quadric[use.object]
                                   ? placed_bounds(*files.quadric[use.object], use.to_parent)
                                   : placed_bounds(use.to_parent, files.bounds[file])));
  return refs;
}

// Of its own triangles.
std::uint64_t triangles_in(const Assembly& object) {
  std::uint64_t triangles = 0;
  for (const Placement& p : object.placements) triangles += triangles_of(*p.mesh);
  return triangles;
}

// An object's own triangles, in its coordinates.
NumberedTriangles placed_alone(const World& world, const Assembly& object) {
  PlacementRule rule = world.rule();
  rule.offset = object.centre;
  const ReflectanceFitter fitter;
  NumberedTriangles out{make_room(rule, triangles_in(object)), {}};
  for (Placement p : object.placements) {
    TriangleMesh storage;
    p.mesh = &loaded(*p.mesh, storage);
    place(p, rule, fitter, out, out.ids.size());
    for (std::uint64_t i = 0; i < p.mesh->triangles.size(); ++i)
      out.ids.push_back(static_cast<std::uint32_t>(p.first_triangle + i));
  }
  return out;
}

// Parts are small, for their boxes overlap: where they meet a domain needs six or more.
std::uint32_t number_of_files(const Manifest& m, const Assembly& object, std::uint64_t most_bytes) {
  const auto triangles = static_cast<double>(triangles_in(object));
  const double wholes = bytes_of_a_triangle(m) * triangles / static_cast<double>(most_bytes);
  return wholes <= 1 ? 1 : static_cast<std::uint32_t>(std::min(std::ceil(4 * wholes), triangles));
}

// Appends the files of one object: parts of its triangles, of which the first has instances too, and more of
// these where they are of too much for one file.
void plan_files(const Manifest& m, const Assembly& object, const ObjectLimits& limits, Files& files) {
  std::map<std::uint32_t, std::uint64_t> places;  // by file
  for (const ObjectUse& use : object.uses)
    for (std::uint32_t file = files.first[use.object]; file < files.first[use.object + 1]; ++file)
      ++places[file];
  const std::uint32_t parts = number_of_files(m, object, limits.file_bytes);
  const double part = bytes_of_a_triangle(m) * static_cast<double>(triangles_in(object)) / parts;
  const std::uint32_t first = files.first.back();
  for (std::uint32_t i = 0; i < parts; ++i)
    files.planned.push_back({.bytes = static_cast<std::uint64_t>(part)});
  std::map<std::uint32_t, std::uint32_t> groups;
  if (limits.inner_bytes > 0)
    groups = groups_of(files.planned, places, limits.inner_bytes, files.planned[first].bytes);
  for (const auto& [file, count] : places) {
    const std::uint32_t group = groups.empty() ? 0 : groups[file],
                        holder = group == 0 ? first : first + parts - 1 + group;
    if (holder == files.planned.size()) files.planned.emplace_back();
    files.planned[holder].objects.push_back(file);
    files.planned[holder].bytes += count * bytes_of_reference;
  }
  files.first.push_back(static_cast<std::uint32_t>(files.planned.size()));
}

// Files `first` to `end`, as they are planned.
void write_object(const World& world, const WorldObject& o, std::uint32_t first, std::uint32_t end,
                  std::uint32_t parts_end, const std::filesystem::path& bundle, Files& files,
                  std::vector<ObjectInfo>& infos) {
  const NumberedTriangles object = placed_alone(world, o.assembly);
  Indices all(object.ids.size());
  std::iota(all.begin(), all.end(), 0u);
  std::vector<Indices> parts;
  divide(object, std::move(all), parts_end - first, parts);
  parts.resize(end - first);
  std::vector<InstanceRef> all_refs = references(o.assembly.uses, files);
  for (std::uint32_t file = first; file < end; ++file) {
    Indices& part = parts[file - first];
    std::vector<InstanceRef> refs;
    if (parts_end < end)
      std::ranges::copy_if(all_refs, std::back_inserter(refs), [&](const InstanceRef& ref) {
        return std::ranges::binary_search(files.planned[file].objects, ref.object);
      });
    else if (file == first)
      refs = std::exchange(all_refs, {});
    Bounds3f& box = files.bounds[file];
    for (const std::uint32_t t : part)
      for (const Point3f& v : object.triangles[t]) extend(box, v);
    for (const InstanceRef& ref : refs) extend(box, box_of(ref));
    DomainContent content = make_domain(object, {std::move(part), {}, {}}, false);
    ObjectInfo& info = infos[file];
    info = {o.assembly.triangles, 0, 0, o.first_surface, o.surface_count, files.planned[file].objects};
    info.continues = file > first;
    add_instances(std::move(refs), infos, content);
    info.bytes = write_domain_file(object_path(bundle, file), content, &info.hash);
    if (!o.assembly.motion) continue;
    info.motion = *o.assembly.motion;
    box = swept(info.motion, {cast<double>(box.lower), cast<double>(box.upper)});
  }
}

void note_quadric(const WorldObject& o, ObjectInfo& info) {
  const Placement& p = *o.assembly.quadric;
  info = {1, 0, 0, o.first_surface, o.surface_count, {}, OrientedQuadric{*p.mesh->quadric, p.flip}};
  const Quadric& q = *p.mesh->quadric;
  const double numbers[] = {
      static_cast<double>(q.kind), static_cast<double>(q.uv), q.low, q.high, q.phi_max_rad,
      static_cast<double>(p.flip)};
  Hasher hasher;
  hasher.add(std::as_bytes(std::span(numbers)));
  info.hash = hasher.digest();
}

// Those whose instances are of objects before them: as many of them at once as there are threads, or one
// after the other.
struct Batch {
  Indices at_once, alone;
};

}  // namespace

double bytes_in_work(const Manifest& m, const Assembly& object, std::uint64_t file_bytes) {
  const auto triangles = static_cast<double>(triangles_in(object));
  std::uint64_t mesh = 0;
  for (const Placement& p : object.placements)
    if (p.mesh->deferred) mesh = std::max(mesh, p.mesh->deferred->bytes);
  return static_cast<double>(mesh) +
         bytes_to_build(m, triangles, std::ceil(triangles / number_of_files(m, object, file_bytes)));
}

std::uint64_t triangles_of_objects(const World& world) {
  std::uint64_t triangles = 0;
  for (const WorldObject& o : world.objects) triangles += triangles_in(o.assembly);
  return triangles;
}

std::uint64_t SceneInstances::in_runs() const {
  std::uint64_t count = 0;
  for (const Run& r : runs) count += r.run.places->size();
  return count;
}

void SceneInstances::for_each_of_runs(const std::function<void(const InstanceRef&)>& visit) const {
  for (const Run& r : runs)
    for_each_use(r.run, [&](const ObjectUse& use) {
      visit(reference(use, r.object, placed_bounds(r.quadric, use.to_parent)));
    });
}

SceneInstances write_objects(const World& world, Manifest& m, const std::filesystem::path& bundle,
                             const ObjectLimits& limits, const std::function<void(std::uint64_t)>& written) {
  if (world.objects.empty()) return {};
  Files files{{}, {0}, {}, {}};
  std::vector<Batch> by_depth;
  const int threads = tbb::this_task_arena::max_concurrency();
  for (std::uint32_t i = 0; i < world.objects.size(); ++i) {
    const Assembly& object = world.objects[i].assembly;
    files.quadric.push_back(object.quadric ? &object : nullptr);
    if (object.quadric) {
      files.planned.emplace_back();
      files.first.push_back(files.first.back() + 1);
      continue;
    }
    std::filesystem::create_directories(bundle / "objects");
    plan_files(world.manifest, object, limits, files);
    const double bytes = bytes_in_work(world.manifest, object, limits.file_bytes);
    by_depth.resize(std::max(by_depth.size(), static_cast<std::size_t>(object.depth) + 1));
    Batch& batch = by_depth[static_cast<std::size_t>(object.depth)];
    (threads * bytes <= limits.memory_bytes ? batch.at_once : batch.alone).push_back(i);
  }
  files.bounds.resize(files.first.back());
  m.objects.resize(files.first.back());
  for (std::size_t i = 0; i < world.objects.size(); ++i)
    if (files.quadric[i]) note_quadric(world.objects[i], m.objects[files.first[i]]);
  const auto write = [&](std::uint32_t i) {
    const WorldObject& object = world.objects[i];
    const std::uint32_t parts = number_of_files(world.manifest, object.assembly, limits.file_bytes);
    write_object(world, object, files.first[i], files.first[i + 1], files.first[i] + parts, bundle, files,
                 m.objects);
    written(triangles_in(object.assembly));
  };
  for (const Batch& batch : by_depth) {
    // A thread that waits within one object begins no other.
    tbb::parallel_for(std::size_t{0}, batch.at_once.size(), [&](std::size_t i) {
      tbb::this_task_arena::isolate([&] { write(batch.at_once[i]); });
    });
    for (const std::uint32_t i : batch.alone) write(i);
  }
  SceneInstances instances{references(world.uses, files), {}};
  for (const QuadricRun& run : world.runs)
    instances.runs.push_back(
        {run, *files.quadric[run.object]->quadric->mesh->quadric, files.first[run.object]});
  return instances;
}

std::vector<std::uint32_t> needed_objects(const Manifest& m, std::span<const InstanceRef> instances) {
  std::vector<bool> needed(m.objects.size());
  for (const InstanceRef& ref : instances) needed[ref.object] = true;
  std::vector<std::uint32_t> objects;
  for (std::size_t i = needed.size(); i-- > 0;)
    if (needed[i]) {
      objects.push_back(static_cast<std::uint32_t>(i));
      for (const std::uint32_t inner : m.objects[i].objects) needed[inner] = true;
    }
  std::ranges::reverse(objects);
  return objects;
}

std::uint64_t bytes_of_objects(const Manifest& m, std::span<const InstanceRef> instances) {
  std::uint64_t bytes = 0;
  for (const std::uint32_t object : needed_objects(m, instances)) bytes += m.objects[object].bytes;
  return bytes;
}

namespace {

// A box of what an instance shows, all of which is in `whole`.
Bounds3f padded(const Bounds3f& box, const Bounds3f& whole) {
  return inflated(box, padding(greatest(whole)));
}

}  // namespace

Bounds3f padded_box(const InstanceRef& instance) { return padded(box_of(instance), box_of(instance)); }

InstanceDealer::InstanceDealer(std::vector<InstanceRef> instances, const Bounds3f& root)
    : instances_(std::move(instances)), root_(root) {
  std::vector<Bounds3f> boxes;
  for (const InstanceRef& ref : instances_) boxes.push_back(padded_box(ref));
  tree_ = build_tree(boxes);
}

Bounds3f opened(Bounds3f cell, const Bounds3f& root) {
  constexpr float infinity = std::numeric_limits<float>::infinity();
  for (int axis = 0; axis < 3; ++axis) {
    if (cell.lower[axis] <= root.lower[axis]) cell.lower[axis] = -infinity;
    if (cell.upper[axis] >= root.upper[axis]) cell.upper[axis] = infinity;
  }
  return cell;
}

std::vector<std::uint32_t> InstanceDealer::found_in(const Bounds3f& cell) const {
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
  return found;
}

std::vector<InstanceRef> InstanceDealer::whole_in(const Bounds3f& cell) const {
  std::vector<InstanceRef> refs;
  for (const std::uint32_t i : found_in(opened(cell, root_))) refs.push_back(instances_[i]);
  return refs;
}

std::vector<InstanceRef> InstanceDealer::in(const Bounds3f& of) const {
  const Bounds3f cell = opened(of, root_);
  std::vector<InstanceRef> refs;
  for (const std::uint32_t i : found_in(cell)) {
    InstanceRef ref = instances_[i];
    const Bounds3f whole = box_of(ref);
    Bounds3f box = padded(whole, whole);
    for (int axis = 0; axis < 3; ++axis) {
      box.lower[axis] = std::max(box.lower[axis], cell.lower[axis]);
      box.upper[axis] = std::min(box.upper[axis], cell.upper[axis]);
    }
    if (box.empty()) continue;
    set_box(ref, padded(box, whole));
    refs.push_back(ref);
  }
  return refs;
}

}  // namespace vitrail
