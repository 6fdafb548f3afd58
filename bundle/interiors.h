// SPDX-License-Identifier: Apache-2.0
// This file tracks which media and dielectrics a ray is inside of. Where interiors of dielectrics with
// priorities overlap, only the one of the greatest priority counts. Faces of the others within it do not
// (Schmidt and Budge, "Simple Nested Dielectrics in Ray Traced Images", 2002). A state is one byte, so that
// it travels with a path. It holds the surrounding medium, and how often the ray is inside of each such
// dielectric.
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <vector>

#include "bundle/manifest.h"

namespace vitrail {

// A DielectricFace is a face of a dielectric as a ray meets it.
struct DielectricFace {
  const Spectrum* exterior_eta;  // index in front of it: of what it stands in
};

class Interiors {
 public:
  // `manifest` has to outlive it. Throws Error where a byte cannot keep its media and priorities apart. A
  // byte can hold 255 media, or 7 dielectrics with priorities and one medium.
  explicit Interiors(const Manifest& manifest);

  // Returns the state in a medium (−1: vacuum) and in no dielectric that has a priority.
  std::uint8_t state_in(std::int32_t medium) const { return static_cast<std::uint8_t>(medium + 1); }
  // Returns the medium of a state; −1: vacuum.
  std::int32_t medium(std::uint8_t state) const { return media_[state]; }

  // Returns whether the surface bounds a dielectric that has a priority.
  bool has_priority(const Surface& surface) const { return volume_of(surface) >= 0; }
  // Returns the face of such a surface as a ray in `state` meets it. There is none where the surface lies in
  // its own dielectric or in one that takes precedence.
  std::optional<DielectricFace> face(std::uint8_t state, const Surface& surface, bool from_front) const;
  // Returns the state on the front side or the back of a surface that a ray reached in `state`, and crossed
  // or not.
  std::uint8_t beside(std::uint8_t state, const Surface& surface, bool front_side, bool crossed) const;

  // Returns whether any surface has two states beside it.
  bool divide_space() const { return divide_space_; }
  // A Told is what is known of a ray's starting state from the surfaces that it crosses on its way out of
  // everything. The first surface that bounds a medium tells the medium. The dielectrics are told by how
  // often the ray leaves each more than it enters it.
  struct Told {
    std::uint8_t state = 0;
    bool medium = false;  // is known; vacuum in `state` until it is
  };
  Told told_by(Told told, const Surface& surface, bool from_front) const;
  // Returns whether no further surface can tell more.
  bool tells_all(const Told& told) const { return told.medium && volumes_.empty(); }

 private:
  // A Volume is the inside of a dielectric with a priority, wherever surfaces bound it.
  struct Volume {
    std::uint32_t material;
    std::int32_t interior, exterior;  // as of its surfaces
    const DielectricMaterial* dielectric;
    bool operator==(const Volume&) const = default;
  };

  int volume_of(const Surface& surface) const {
    return volume_of_surface_.empty()
               ? -1
               : volume_of_surface_[static_cast<std::size_t>(&surface - manifest_.surfaces.data())];
  }
  int count(int state, int volume) const;  // how often it is inside
  int entered(int state, int volume) const;
  int left(int state, int volume) const;
  int first_volume(int state) const;  // the one that is there, −1: none

  const Manifest& manifest_;
  int bases_ = 1;                // media and vacuum
  int most_ = 3;                 // a state counts so often
  std::vector<Volume> volumes_;  // greatest priority first
  std::vector<int> stride_;      // of a volume's count in a state
  std::vector<std::int8_t> volume_of_surface_;
  bool divide_space_ = false;
  std::array<std::int16_t, 256> media_{};
};

}  // namespace vitrail
