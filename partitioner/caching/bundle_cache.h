// SPDX-License-Identifier: Apache-2.0
// The cache keeps domains and objects of bundles for the next start.
#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "bundle/census.h"
#include "bundle/manifest.h"

namespace vitrail {

// A PlacedScene is what placing and cutting a scene gave.
struct PlacedScene {
  Manifest manifest;  // whole, of the render that kept it: only what WorldKey decides is of use later
  std::vector<std::uint64_t> block_hashes;  // SceneTally's
  CensusResult census;
};

// A BundleCache is a folder of entries, each a folder named by its key: domains/, objects/, the manifest and
// kept.json. The key has to tell their content (WorldKey). Entries appear whole, by renaming. Any number of
// processes may use the cache at once. An entry that cannot be read, written or made room for is as if it
// were not kept: only std::bad_alloc is thrown.
class BundleCache {
 public:
  static constexpr std::uint64_t usual_most_bytes = std::uint64_t{4} << 30;
  // Smaller bundles are made faster than found.
  static constexpr std::uint64_t least_bytes = 1 << 20;

  // Nothing is kept where `folder` is empty.
  explicit BundleCache(std::filesystem::path folder, std::uint64_t most_bytes = usual_most_bytes);

  bool is_on() const { return !folder_.empty(); }
  // Puts the files into the directory `bundle`, as links where its file system is the cache's: they stay when
  // the entry goes. Checks them all. An entry that is damaged is removed.
  std::optional<PlacedScene> take(const std::string& key, const std::filesystem::path& bundle) const;
  // Keeps the files of the bundle, then removes entries until all are within `most_bytes`,
  // those used longest ago first.
  void keep(const std::string& key, const std::filesystem::path& bundle, const PlacedScene& placed) const;

 private:
  std::filesystem::path folder_;
  std::uint64_t most_bytes_;
};

}  // namespace vitrail
