// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

#include "bundle/manifest.h"
#include "farm/options.h"

namespace vitrail {

// FilmProgress::about of a render: {"scene": name, "camera": kind, "world_to_camera": 16 numbers, row by row,
// of a matrix that takes columns}. Camera space is +x right, +y up, +z the view.
std::string about(const Manifest& manifest, const RenderOptions& options);

}  // namespace vitrail
