// SPDX-License-Identifier: Apache-2.0
// It holds the places of one quadric that stands many times: scenes of particles and fibres have 10⁷ and
// more.
#pragma once

#include <array>
#include <cstdint>
#include <cstdio>
#include <memory>
#include <span>
#include <vector>

#include "scene/geometry/bounds.h"
#include "scene/shapes/quadric.h"

namespace vitrail {

class QuadricPlaces {
 public:
  // It has the rows of an affine transform from the quadric's space to the mesh's.
  using Place = std::array<double, 12>;

  // Places beyond `memory_bytes` go to a file without a name in the folder for temporary files.
  QuadricPlaces(const Quadric& quadric, std::uint64_t memory_bytes);

  // Adds a place: an affine transform that does not mirror. Throws MachineError where the disk is full.
  void add(const Transform& place);

  std::size_t size() const { return size_; }
  // Reads places [first, first + out.size()), from any thread. Throws MachineError.
  void read(std::size_t first, std::span<Transform> out) const;
  // bounds() holds all the quadrics. centre() is where the middle one of a few thousand of them is, and
  // radius() the distance on the greatest axis within which half of them lie.
  const Bounds3d& bounds() const { return bounds_; }
  Point3d centre() const;
  double radius() const;
  std::uint64_t bytes() const { return block_.capacity() * sizeof(Place); }  // in memory

 private:
  struct Closer {
    void operator()(std::FILE* file) const { std::fclose(file); }
  };
  void spill();

  Quadric quadric_;
  std::uint64_t memory_places_;
  std::size_t size_ = 0, spilled_ = 0;
  std::vector<Place> block_;  // those from `spilled_` on
  std::unique_ptr<std::FILE, Closer> file_;
  Bounds3d bounds_;
  std::vector<Point3d> sample_;
  std::size_t stride_ = 1;  // of the sample
};

}  // namespace vitrail
