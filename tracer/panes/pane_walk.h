// SPDX-License-Identifier: Apache-2.0
// Parallel faces reflect light to and fro before they let it through in the direction in which it came. A
// connection to a distant light walks the light's way back, and a photon tells whether a connection finds its
// way.
//
// A connection that meets a face goes on, or back by chance. The chance depends on what it has passed, so
// that every way brings the same. R is the reflectance of the faces before it, seen from where it comes. The
// face has r and t from the near side, r' and t' from the far one. All orders together are then (Stokes 1862)
//
//   t/(1 − R r) of what arrives, and then R is r' + t t' R/(1 − R r).
//
// So it goes back with the chance R r, and brings t/(1 − R r) where it goes on. R guides the walk alone:
// where faces have ends or absorb, the walk itself meets that, and the mean is that of all ways.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstdint>

#include "scene/geometry/vec.h"

namespace vitrail {

// It says what a face does with light on the side where it is met, and on the other.
template <class T>
struct FaceLight {
  T reflected, transmitted, reflected_far, transmitted_far;
};

struct PaneWalk {
  double behind = 0;        // R, of the faces before the ray's start; on the way back of those ahead of it
  std::uint32_t faces = 0;  // of those; at most most_faces: more are as good as any number
  bool back = false;        // on the way back

  static constexpr std::uint32_t most_faces = 127;
  // Returns the walk in 24 bits. A walk is rounded after each of its events.
  std::uint32_t bits() const {
    const double code = std::clamp(behind, 0.0, 1.0) * 0x1p16 + 0.5;
    return static_cast<std::uint32_t>(std::min(code, 65535.0)) << 8 | faces << 1 | (back ? 1u : 0u);
  }
  static PaneWalk of(std::uint32_t bits) {
    return {(bits >> 8) * 0x1p-16, bits >> 1 & most_faces, (bits & 1) != 0};
  }

  // Returns the chance that a face turns it. The first face of all turns all that comes back.
  double chance_to_turn(const FaceLight<double>& f) const {
    if (faces == 0) return 0;
    if (!back) return behind * f.reflected;
    return faces == 1 ? 1 : f.reflected / std::max(behind, f.reflected);
  }
  void turn() { back = !back; }
  void pass(const FaceLight<double>& f) {
    const double both = f.transmitted * f.transmitted_far;
    if (!back) {
      behind = f.reflected_far + both * behind / (1 - behind * f.reflected);
      faces = std::min(faces + 1, most_faces);
    } else if (faces > 0) {
      const double rest = std::max(0.0, behind - f.reflected);
      behind = rest > 0 ? rest / (both + rest * f.reflected_far) : 0;
      --faces;
    }
  }
  // Passes through an absorber.
  void fade(double transmittance) {
    const double to_and_fro = transmittance * transmittance;
    behind = back ? std::min(1.0, behind / to_and_fro) : behind * to_and_fro;
  }
};

// It is the same for a photon, which meets the faces of a connection's walk from its end. A connection goes
// back only among the faces that it has passed. So a photon that comes back among faces has to pass one more
// than it has gone back over, before a connection finds it.
struct PhotonWalk {
  std::uint32_t before = 0;  // faces to pass
  bool back = false;         // against the light

  static constexpr std::uint32_t most_before = 127;
  std::uint32_t bits() const { return before << 1 | (back ? 1u : 0u); }
  static PhotonWalk of(std::uint32_t bits) { return {bits >> 1 & most_before, (bits & 1) != 0}; }

  bool has_way_back() const { return before < most_before; }
  void turn() {
    if (!back && before == 0) before = 1;
    back = !back;
  }
  void pass() {
    if (back)
      ++before;
    else if (before > 0)
      --before;
  }
};

// It says how light that had `to_light` in its own medium stands to a face that parallel faces have brought
// it to.
struct ParallelWay {
  Vector3d to_light{};
  bool is_in = false, is_out = false;  // the near side is the light's own medium; the far side is
  bool is_within = false;              // neither is
  Vector3d turned{}, passed{};         // where it goes on from here
  bool passes = true;                  // false under total reflection

  bool holds() const { return is_in || is_out || is_within; }
};

// It is a smooth face as a ray meets it.
struct MetFace {
  Vector3d normal;        // unit, on the near side
  double near_index = 1;  // of refraction
  double eta = 1;         // index behind / in front
};

// Returns the way of light, or of a connection to it, that goes along `direction`, or with `back` against it.
// The normals of this face and those before it are known to doubt_rad. All is reversible, so that light finds
// what connections find.
ParallelWay parallel_way(Vector3d direction, bool back, Vector3d to_light, const MetFace& face,
                         double doubt_rad);

}  // namespace vitrail
