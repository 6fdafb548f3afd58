// SPDX-License-Identifier: Apache-2.0
// What decides the domains and objects of a bundle, as a name to keep them by.
#pragma once

#include <filesystem>
#include <string>
#include <utility>
#include <vector>

#include "partitioner/partition.h"
#include "partitioner/placing/world.h"

namespace vitrail {

// 128 bits of XXH3 over the content of `program` and over all that its files of domains and objects, their
// lines in the manifest, and the triangles that emit come from: where every vertex stands, what instances
// there are, which surfaces emit, what the renderer requires, and the options. Names, times and sizes of
// files are not in it, so that an edited file is never taken for the one before. Camera, film, settings,
// materials, images and how bright lights are do not count: the manifest alone has them.
class WorldKey {
 public:
  // Loads deferred meshes, one after the other. Throws Error as loading them does.
  WorldKey(const World& world, const RenderSettings& settings, const PartitionOptions& options,
           const std::filesystem::path& program = "/proc/self/exe");

  const std::string& text() const { return text_; }
  // Whether the deferred meshes are still what they were: loads them again. What was written in between is of
  // the key then.
  bool holds() const;

 private:
  std::string text_;
  std::vector<std::pair<const TriangleMesh*, std::string>> deferred_;  // with the hash of each
};

}  // namespace vitrail
