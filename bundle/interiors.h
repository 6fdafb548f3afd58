// SPDX-License-Identifier: Apache-2.0
// What rays are inside of. Where interiors of dielectrics with priorities overlap, the one of the greatest
// priority is there, and faces of the others within it are not (Schmidt and Budge, "Simple Nested Dielectrics
// in Ray Traced Images", 2002). A state is one byte, so that it travels with a path: the medium around, and
// how often it is inside of each such dielectric.
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <vector>

#include "bundle/manifest.h"

namespace vitrail {

// A face of a dielectric as it is met.
struct DielectricFace {
  const Spectrum* exterior_eta;  // index in front of it: of what it stands in
};

class Interiors {
 public:
  // `manifest` outlives it. Throws Error where it has more media and priorities than a byte keeps apart:
  // 255 media, or 7 dielectrics with priorities and one medium.
  explicit Interiors(const Manifest& manifest);

  // The state in a medium (−1: vacuum) and in no dielectric that has a priority.
  std::uint8_t state_in(std::int32_t medium) const { return static_cast<std::uint8_t>(medium + 1); }
  // The medium there, −1: vacuum.
  std::int32_t medium(std::uint8_t state) const { return media_[state]; }

  // Whether the surface bounds a dielectric that has a priority.
  bool has_priority(const Surface& surface) const { return volume_of(surface) >= 0; }
  // The face of such a surface as a ray in `state` meets it; none where it lies in what goes before it.
  std::optional<DielectricFace> face(std::uint8_t state, const Surface& surface, bool from_front) const;
  // On the front side or the back of a surface that was reached in `state`, with or without crossing it.
  std::uint8_t beside(std::uint8_t state, const Surface& surface, bool front_side, bool crossed) const;

  // Whether any surface has two states beside it.
  bool divide_space() const { return divide_space_; }
  // What a ray that leaves a place tells of it by the surfaces that it crosses, on its way out of everything:
  // the medium by the first one that bounds any, of dielectrics how often it leaves each more than it enters.
  struct Told {
    std::uint8_t state = 0;
    bool medium = false;  // is known; vacuum in `state` until it is
  };
  Told told_by(Told told, const Surface& surface, bool from_front) const;
  // Whether no surface behind can tell more.
  bool tells_all(const Told& told) const { return told.medium && volumes_.empty(); }

 private:
  // The inside of a dielectric with a priority, wherever surfaces bound it.
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
