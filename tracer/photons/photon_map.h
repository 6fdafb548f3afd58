// SPDX-License-Identifier: Apache-2.0
// The photons of one iteration that landed where a rank answers for them. What is gathered is a function of
// the photons within the radius alone, to the bit: they are added up in an order of their own (cell, number,
// depth), whatever else the map holds and in whatever order they came.
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <vector>

#include "scene/geometry/bounds.h"
#include "tracer/photons/photon_records.h"

namespace vitrail {

class PhotonMap {
 public:
  // `most`: photons that there is memory for, 0: no limit.
  explicit PhotonMap(std::size_t most = 0);

  // Throws MachineError beyond the limit.
  void add(const Photon& photon);
  // Puts them in order for `gather`. `bounds` of the scene: the cells' origin.
  void build(double radius, const Bounds3f& bounds);
  void clear();

  // Σ f·Φ·|cos θ_s|/|cos θ_g| / (πr²) over the photons in the disc around the point that were scattered less
  // than `max_depth` times together with its path, θ_s and θ_g from the shading and the surface's normal:
  // what scatters by the shading normal is lit by the surface's (Veach 1997, §5.3). Times the weight.
  // `found`: their number is added to it.
  SampledSpectrum gather(const Gather& at, std::uint32_t max_depth, std::uint64_t& found) const;
  // Of the photons that landed at the sensor which `at` names, those that `is_of` takes by their number: the
  // sum of their powers times the weight.
  template <class IsOf>
  SampledSpectrum at_sensor(const Gather& at, std::uint32_t max_depth, std::uint64_t& found,
                            const IsOf& is_of) const;

  std::size_t size() const { return photons_.size(); }
  static constexpr std::size_t photon_bytes = sizeof(std::uint64_t) + sizeof(Photon);

 private:
  struct Placed {
    std::uint64_t cell = 0;
    Photon photon;
  };
  std::uint64_t row(int axis, double coordinate) const;
  std::uint64_t cell_of(const float (&p)[3]) const;

  std::vector<Placed> photons_;
  std::size_t most_;
  double radius_ = 0, edge_ = 1;
  Point3d origin_;
};

template <class IsOf>
SampledSpectrum PhotonMap::at_sensor(const Gather& at, std::uint32_t max_depth, std::uint64_t& found,
                                     const IsOf& is_of) const {
  std::array<double, hero_count> sum{};
  const std::uint64_t cell = cell_of(at.p);
  for (auto placed = std::ranges::lower_bound(photons_, cell, {}, &Placed::cell);
       placed != photons_.end() && placed->cell == cell; ++placed) {
    const Photon& photon = placed->photon;
    if (!std::ranges::equal(photon.p, at.p) || !(photon.direction == at.out) || !is_of(photon.number))
      continue;
    if (std::uint32_t{photon.depth} % Photon::dispersed + 1 > max_depth) continue;
    for (std::size_t i = 0; i < hero_count; ++i) sum[i] += static_cast<double>(photon.power[i]);
    ++found;
  }
  SampledSpectrum result;
  for (std::size_t i = 0; i < hero_count; ++i)
    result.v[i] = static_cast<float>(static_cast<double>(at.weight[i]) * sum[i]);
  return result;
}

}  // namespace vitrail
