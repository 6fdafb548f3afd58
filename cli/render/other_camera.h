// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>

#include "bundle/view.h"
#include "farm/transport/transport.h"

namespace vitrail {

// The view of a scene file of any format, which vitrail-partition reads on rank 0 into `between`, a file that
// is gone then. To be called by all ranks together. Throws Error, and what run_program throws.
View view_of_scene(Transport& transport, const std::filesystem::path& scene,
                   const std::filesystem::path& between);

}  // namespace vitrail
