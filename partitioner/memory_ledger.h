// SPDX-License-Identifier: Apache-2.0
// A MemoryLedger has what the records of a scene take in memory, by kind.
#pragma once

#include <cstdint>
#include <string>

#include "scene/records/scene.h"

namespace vitrail {

// A ledger counts bytes, with what the bundle keeps of each record beside it while one is written. It counts
// the records alone: it is the same on every machine, and so is a plan that follows it.
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

// Returns the ledger for people, the largest first: "shapes 200 MiB, materials 80 MiB".
std::string to_string(const MemoryLedger& ledger);

}  // namespace vitrail
