// SPDX-License-Identifier: Apache-2.0
// This file tells what the images of a scene take while they are baked.
#pragma once

#include <cstdint>

#include "scene/records/scene.h"

namespace vitrail {

struct BakingMemory {
  std::uint64_t bytes = 0;     // for the largest image
  bool image_library = false;  // needed (images/image_files.h)
};

// Reads the files' heads, and the pixels of grey images. Images that other files hold count as ones that the
// library reads, and those that cannot be opened as nothing.
BakingMemory baking_memory(const Scene& scene, int threads);

}  // namespace vitrail
