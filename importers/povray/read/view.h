// SPDX-License-Identifier: Apache-2.0
// These records hold cameras, and what is around the scene.
#pragma once

#include "importers/povray/read/surface.h"

namespace vitrail::pov {

// It is `camera {}`: rays of the perspective camera go from `location` along direction + x·right + y·up, x
// and y from −½ to ½.
struct CameraView {
  Place place;
  Word kind = Word::perspective_;
  Vector3d location{0, 0, 0}, direction{0, 0, 1}, right{4.0 / 3, 0, 0}, up{0, 1, 0}, sky{0, 1, 0};
  double angle = 0;  // across, in degrees; 0: as the vectors say
  double angle_v = 0;
  double aperture = 0;
  Vector3d focal_point{0, 0, 0};
  int kind_number = 1;  // of cylindrical cameras
  bool has_normal = false;
};

// It has pigments by direction, the lowest first.
struct SkySphere {
  Place place;
  std::vector<Shared<Pigment>> pigments;
};

Shared<CameraView> read_camera_block(Reader& reader);
Shared<SkySphere> read_sky_sphere_block(Reader& reader);

}  // namespace vitrail::pov
