// SPDX-License-Identifier: Apache-2.0
// These functions give a bundle's camera another place or angle of view.
#pragma once

#include <optional>
#include <string>

#include "bundle/manifest.h"
#include "bundle/view.h"

namespace vitrail {

struct ViewEdit {
  struct LookAt {
    Point3d eye, target;
    Vector3d up{0, 0, 0};  // 0: the axis of the world over which the camera is level, else its own up
  };
  std::optional<View> view;       // of another scene; what stands around the camera stays the bundle's
  std::optional<LookAt> look_at;  // in the world of the scene's file; the camera then stands still
  std::optional<double> fov_deg;  // over the shorter side of the picture
};

// Reads "0,-5,2,0,0,1" or with three numbers more of the direction that is up. Throws UsageError.
ViewEdit::LookAt parse_look_at(const std::string& text);

// Edits the view, before the film is given another size. Throws UsageError where the camera has no such
// thing, or the view no direction.
void edit_view(const ViewEdit& edit, Manifest& manifest);

}  // namespace vitrail
