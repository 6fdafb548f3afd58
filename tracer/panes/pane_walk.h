// SPDX-License-Identifier: Apache-2.0
// Light that parallel faces reflect to and fro before they let it through as it came: a connection to a
// distant light walks its way back, and a photon tells whether a connection finds its way.
//
// A connection that meets a face goes on, or back by chance. What it has passed tells by what chance, so that
// every way brings the same: with R the reflectance of the faces before it, seen from where it comes, and of
// the face r and t from the near side, r' and t' from the far one, all orders together are (Stokes 1862)
//
//   t/(1 − R r) of what arrives, and then R is r' + t t' R/(1 − R r).
//
// So it goes back with the chance R r, and brings t/(1 − R r) where it goes on. R guides the walk alone:
// where faces have ends or absorb, a walk says so by what becomes of it, and the mean is that of all ways.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstdint>

#include "scene/geometry/vec.h"

namespace vitrail {

// What a face does with light on the side where it is met, and on the other.
template <class T>
struct FaceLight {
  T reflected, transmitted, reflected_far, transmitted_far;
};

struct PaneWalk {
  double behind = 0;        // R, of the faces before the ray's start; on the way back of those ahead of it
  std::uint32_t faces = 0;  // of those; at most most_faces: more are as good as any number
  bool back = false;        // on the way back

  static constexpr std::uint32_t most_faces = 127;
  // In 24 bits. A walk is rounded after each of its events.
  std::uint32_t bits() const {
    const double code = std::clamp(behind, 0.0, 1.0) * 0x1p16 + 0.5;
    return static_cast<std::uint32_t>(std::min(code, 65535.0)) << 8 | faces << 1 | (back ? 1u : 0u);
  }
  static PaneWalk of(std::uint32_t bits) {
    return {(bits >> 8) * 0x1p-16, bits >> 1 & most_faces, (bits & 1) != 0};
  }

  // That a face turns it. The first of all turns all of what comes back.
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
  // Through what absorbs.
  void fade(double transmittance) {
    const double to_and_fro = transmittance * transmittance;
    behind = back ? std::min(1.0, behind / to_and_fro) : behind * to_and_fro;
  }
};

// The same of a photon, which meets the faces of a connection's walk from its end. A connection goes back
// among the faces that it has passed alone; so a photon that comes back among faces has to pass one more than
// it has gone back over, before a connection finds it.
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

// How light that had `to_light` in its own medium stands to a face that parallel faces have brought it to.
struct ParallelWay {
  Vector3d to_light{};
  bool is_in = false, is_out = false;  // the near side is the light's own medium; the far side is
  bool is_within = false;              // neither is
  Vector3d turned{}, passed{};         // where it goes on from here
  bool passes = true;                  // false under total reflection

  bool holds() const { return is_in || is_out || is_within; }
};

// A smooth face as it is met.
struct MetFace {
  Vector3d normal;        // unit, on the near side
  double near_index = 1;  // of refraction
  double eta = 1;         // index behind / in front
};

// Of light, or a connection to it, that goes along `direction`, or on its way back against it. The normals of
// this and the faces before it are known to doubt_rad; all is reversible, so that light finds what
// connections find.
ParallelWay parallel_way(Vector3d direction, bool back, Vector3d to_light, const MetFace& face,
                         double doubt_rad);

}  // namespace vitrail
