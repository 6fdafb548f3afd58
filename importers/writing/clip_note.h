// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <fmt/format.h>

#include <cmath>
#include <string>

#include "scene/records/camera.h"

namespace vitrail {

// Returns what is lost in formats whose cameras have no planes; empty where these cut nothing away.
inline std::string clip_note(const ClipRange& c) {
  std::string cut;
  if (c.near > 0) cut = fmt::format("nearer than {:g}", c.near);
  if (std::isfinite(c.far)) cut += fmt::format("{}farther than {:g}", cut.empty() ? "" : " or ", c.far);
  return cut.empty() ? cut : "near and far planes of the camera: what is " + cut + " is seen";
}

}  // namespace vitrail
