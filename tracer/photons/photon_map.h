// SPDX-License-Identifier: Apache-2.0
// A PhotonMap holds the photons of one iteration that landed where a rank answers for them. What is gathered
// is a function of the photons within the radius alone, to the bit. They are added up in an order of their
// own (cell, number, depth), whatever else the map holds and in whatever order they came. Photons that memory
// has no room for are in files.
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "scene/geometry/bounds.h"
#include "tracer/photons/photon_file.h"

namespace vitrail {

class PhotonMap {
 public:
  // `most` is the number of photons that there is memory for, 0: no limit.
  explicit PhotonMap(std::size_t most = 0);

  // Begins an iteration, without photons. The `bounds` of the scene give the cells' origin.
  void begin(double radius, const Bounds3f& bounds);
  // Throws MachineError where the disk cannot take those beyond the limit; so do `build` and the functions
  // that gather.
  void add(const Photon& photon);
  // Puts the photons in order for `gather`.
  void build();

  // Returns the weight times Σ f·Φ·|cos θ_s|/|cos θ_g| / (πr²) over the photons in the disc around the point.
  // Only those count that were scattered less than `max_depth` times together with the point's path. θ_s and
  // θ_g are from the shading and the surface's normal: what scatters by the shading normal is lit by the
  // surface's (Veach 1997, §5.3). The number of these photons is added to `found`.
  SampledSpectrum gather(const Gather& at, std::uint32_t max_depth, std::uint64_t& found) const;
  // Returns the weight times the sum of powers of the photons that landed at the sensor that `at` names. Only
  // those count whose number `is_of` accepts.
  template <class IsOf>
  SampledSpectrum at_sensor(const Gather& at, std::uint32_t max_depth, std::uint64_t& found,
                            const IsOf& is_of) const;

  std::size_t in_memory() const { return photons_.size(); }
  std::uint64_t written_bytes() const { return file_.written_bytes(); }  // to the disk, in all
  // A photon in memory takes these bytes, with its part of the table that finds those in files.
  static constexpr std::size_t photon_bytes = sizeof(PlacedPhoton) + 2;

 private:
  std::uint64_t row(int axis, double coordinate) const;
  std::uint64_t cell_of(const float (&p)[3]) const;
  void write_run();
  template <class Visit>
  void visit(std::uint64_t first_cell, std::uint64_t last_cell, const Visit& visit) const;

  std::vector<PlacedPhoton> photons_;  // all of them, or what the file has not yet
  PhotonFile file_;
  std::size_t most_;
  double radius_ = 0, edge_ = 1;
  Point3d origin_;
};

template <class Visit>
void PhotonMap::visit(std::uint64_t first_cell, std::uint64_t last_cell, const Visit& visit) const {
  if (!file_.empty()) return file_.visit(first_cell, last_cell, visit);
  for (auto placed = std::ranges::lower_bound(photons_, first_cell, {}, &PlacedPhoton::cell);
       placed != photons_.end() && placed->cell <= last_cell; ++placed)
    visit(placed->photon);
}

template <class IsOf>
SampledSpectrum PhotonMap::at_sensor(const Gather& at, std::uint32_t max_depth, std::uint64_t& found,
                                     const IsOf& is_of) const {
  std::array<double, hero_count> sum{};
  const std::uint64_t cell = cell_of(at.p);
  visit(cell, cell, [&](const Photon& photon) {
    if (!std::ranges::equal(photon.p, at.p) || !(photon.direction == at.out) || !is_of(photon.number)) return;
    if (std::uint32_t{photon.depth} % Photon::dispersed + 1 > max_depth) return;
    for (std::size_t i = 0; i < hero_count; ++i) sum[i] += static_cast<double>(photon.power[i]);
    ++found;
  });
  SampledSpectrum result;
  for (std::size_t i = 0; i < hero_count; ++i)
    result.v[i] = static_cast<float>(static_cast<double>(at.weight[i]) * sum[i]);
  return result;
}

}  // namespace vitrail
