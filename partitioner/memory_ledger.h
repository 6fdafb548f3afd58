// SPDX-License-Identifier: Apache-2.0
// What the records of a scene take in memory, by kind.
#pragma once

#include <cstdint>
#include <string>

#include "scene/records/scene.h"

namespace vitrail {

// Bytes, with what the bundle keeps of each record beside it while one is written. Counted from the records
// alone: the same on every machine, so that a plan that follows them is.
struct MemoryLedger {
  std::uint64_t meshes = 0;  // in memory, and the samples of those that stay in their files
  std::uint64_t shapes = 0;  // with their meshes' own records
  std::uint64_t instances = 0;
  std::uint64_t prototypes = 0;
  std::uint64_t materials = 0;
  std::uint64_t textures = 0;
  std::uint64_t lights = 0;
  std::uint64_t media = 0;

  std::uint64_t all() const {
    return meshes + shapes + instances + prototypes + materials + textures + lights + media;
  }
};

MemoryLedger ledger_of(const Scene& scene);

// For people, the largest first: "shapes 200 MiB, materials 80 MiB".
std::string to_string(const MemoryLedger& ledger);

}  // namespace vitrail
