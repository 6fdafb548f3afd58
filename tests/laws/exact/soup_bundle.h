// SPDX-License-Identifier: Apache-2.0
// Soups cut into domains, in memory or by way of files.
#pragma once

#include <memory>

#include "bundle/census.h"
#include "bundle/loaded_domain.h"
#include "scene/records/scene.h"
#include "tests/laws/exact/ghost_free.h"
#include "tests/laws/exact/soup.h"

namespace vitrail::test {

// A bundle as the partitioner makes it, whose domains are never written.
struct SoupBundle {
  Manifest manifest;
  std::vector<DomainContent> contents;
  std::vector<DomainView> views;  // of them
  CensusResult census;
};
SoupBundle cut_in_memory(const Soup& soup, std::uint32_t domains);
BundleGeometry geometry_of(const SoupBundle& bundle);

// A bundle of files.
struct LoadedBundle {
  explicit LoadedBundle(const std::filesystem::path& directory);
  Manifest manifest;
  std::vector<std::unique_ptr<const LoadedDomain>> domains;
  std::vector<DomainView> views;
};

// The soup as one mesh, and as some meshes with instances of others, mirrored, scaled and nested.
Scene scene_of(const Soup& soup);
Scene scene_with_instances(const Soup& soup);

}  // namespace vitrail::test
