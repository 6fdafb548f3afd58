// SPDX-License-Identifier: Apache-2.0
// This file has what a film is of, beside its extent.
#pragma once

#include <cstdint>

#include "film/light_groups.h"
#include "film/renderer_version.h"

namespace vitrail {

// A PhotonKey is that of photon mapping, whose iterations are the samples of all pixels.
struct PhotonKey {
  std::uint64_t photons = 0;           // an iteration; 0: no photon mapping
  double first_radius = 0, alpha = 0;  // in scene units, > 0; in (0,1), see tracer/photons/progressive.h
  bool operator==(const PhotonKey&) const = default;
};

// A FilmKey identifies a film. Films of one key but different seeds merge; a resume needs all equal.
struct FilmKey {
  std::uint64_t scene_hash = 0;
  std::uint64_t seed = 0;
  // They change the picture besides scene, seed and sample count, and what the film itself says.
  std::int32_t max_depth = 0;
  bool direct_only = false;
  bool straight_counts = true;
  double clamp = 0;  // the most of X, Y and Z that a deposit has in the picture; 0: no limit
  RendererVersion renderer = this_renderer();
  // It is that of direct light alone, in [0, 1): a path ends where it brings less of what it sees. It has 8
  // bits, so that it has room in a film's header (rounded_threshold).
  float threshold = 0;
  PhotonKey photons = {};
  bool splats = false;          // samples add to several pixels
  bool one_sequence = false;    // a pixel's samples are stratified together: their groups tell no variance
  bool hides_emitters = false;  // where the camera sees them directly
  LightGroups groups = {};
  bool operator==(const FilmKey&) const = default;
};

// Rounds to the 8 bits that a film's header has for it.
float rounded_threshold(double threshold);

}  // namespace vitrail
