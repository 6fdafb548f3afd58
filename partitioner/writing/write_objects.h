// SPDX-License-Identifier: Apache-2.0
// This file writes objects to disk, and finds the instances that domains have of them.
#pragma once

#include <filesystem>
#include <functional>
#include <vector>

#include "partitioner/placing/world.h"

namespace vitrail {

struct ObjectLimits {
  std::uint64_t file_bytes = 0;   // what is larger is parted
  std::uint64_t inner_bytes = 0;  // of what a file has instances of, with all that these need; 0: any
  double memory_bytes = 0;        // for all that are in work
};

// They are the instances of the scene, one for each part of an object, in the order of ids; their boxes are
// not inflated. Those of runs are made as they are asked for.
struct SceneInstances {
  std::vector<InstanceRef> refs;
  struct Run {
    QuadricRun run;
    Quadric quadric;
    std::uint32_t object;  // number in the manifest
  };
  std::vector<Run> runs;

  std::uint64_t in_runs() const;
  void for_each_of_runs(const std::function<void(const InstanceRef&)>& visit) const;
};

// Writes the world's objects, those beyond the limits in parts, and their lines in the manifest. Triangles
// are parted into quarters of the limit. `written` gets numbers of triangles, from any thread. Objects that
// together take more than the memory are written one after the other.
SceneInstances write_objects(const World& world, Manifest& manifest, const std::filesystem::path& bundle,
                             const ObjectLimits& limits, const std::function<void(std::uint64_t)>& written);
// Returns the bytes while an object is written, with its mesh being placed, in files of `file_bytes` at most.
double bytes_in_work(const Manifest& manifest, const Assembly& object, std::uint64_t file_bytes);
// Returns the triangles of all objects.
std::uint64_t triangles_of_objects(const World& world);

// Returns the objects of these instances and all that they need, ascending.
std::vector<std::uint32_t> needed_objects(const Manifest& manifest, std::span<const InstanceRef> instances);
// Returns the bytes of the files of these.
std::uint64_t bytes_of_objects(const Manifest& manifest, std::span<const InstanceRef> instances);

// Returns the cell, without end where it is at the border of `root`: what lies beyond belongs to it.
Bounds3f opened(Bounds3f cell, const Bounds3f& root);
// Returns the box of an instance, inflated by what hits in it may be off.
Bounds3f padded_box(const InstanceRef& instance);

// An InstanceDealer finds the instances that reach into a cell.
class InstanceDealer {
 public:
  // `root` is the cell that is divided. What lies beyond it belongs to the cells at its border.
  InstanceDealer(std::vector<InstanceRef> instances, const Bounds3f& root);

  // Returns the instances with their boxes, padded, clipped to the cell. From any thread.
  std::vector<InstanceRef> in(const Bounds3f& cell) const;
  // Returns the instances as they are.
  std::vector<InstanceRef> whole_in(const Bounds3f& cell) const;

 private:
  std::vector<std::uint32_t> found_in(const Bounds3f& opened) const;

  std::vector<InstanceRef> instances_;
  Bounds3f root_;
  std::vector<BvhNode> tree_;
};

}  // namespace vitrail
