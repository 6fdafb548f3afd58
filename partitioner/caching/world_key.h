// SPDX-License-Identifier: Apache-2.0
// A WorldKey is a name to keep the domains and objects of a bundle by, made of all that decides them.
#pragma once

#include <filesystem>
#include <string>
#include <utility>
#include <vector>

#include "partitioner/partition.h"
#include "partitioner/placing/world.h"

namespace vitrail {

// A WorldKey is 128 bits of XXH3 over the content of `program` and over all that decides domains, objects,
// their lines in the manifest, and the triangles that emit. That is where every vertex stands, what instances
// there are, which surfaces emit, what the renderer requires, and the options. Names, times and sizes of
// files are not in it, so that an edited file is never taken for the one before. Camera, film, settings,
// materials, images and how bright lights are do not count: the manifest alone has them.
class WorldKey {
 public:
  // Loads deferred meshes, one after the other. Throws Error as loading them does.
  WorldKey(const World& world, const RenderSettings& settings, const PartitionOptions& options,
           const std::filesystem::path& program = "/proc/self/exe");

  const std::string& text() const { return text_; }
  // Returns whether the deferred meshes are still what they were: loads them again. If they are, what was
  // written in between is of the key.
  bool holds() const;

 private:
  std::string text_;
  std::vector<std::pair<const TriangleMesh*, std::string>> deferred_;  // with the hash of each
};

}  // namespace vitrail
