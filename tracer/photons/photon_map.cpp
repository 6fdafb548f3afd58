// SPDX-License-Identifier: Apache-2.0
#include "tracer/photons/photon_map.h"

#include <algorithm>
#include <cmath>

#include "scene/geometry/portable_math.h"
#include "tracer/bsdf/diffuse.h"
#include "tracer/bsdf/fresnel.h"
#include "tracer/bsdf/local.h"

namespace vitrail {

namespace {

constexpr int cell_bits = 21;  // an axis
constexpr double most_cells = 0x1p20;
// Of the disc's radius: photons above or below it are of other surfaces.
constexpr double half_height = 0.25;

Vector3d decoded(const DirectionCode& code) { return cast<double>(decode_direction(code)); }

}  // namespace

PhotonMap::PhotonMap(std::size_t most) : most_(most) {
  if (most > 0) photons_.reserve(most);  // takes no memory before it is used
}

void PhotonMap::begin(double radius, const Bounds3f& bounds) {
  photons_.clear();
  file_.clear();
  radius_ = radius;
  edge_ = 2 * radius;
  if (bounds.empty()) return;
  origin_ = cast<double>(bounds.lower);
  for (int axis = 0; axis < 3; ++axis)
    edge_ =
        std::max(edge_, (static_cast<double>(bounds.upper[axis]) - static_cast<double>(bounds.lower[axis])) /
                            most_cells);
}

void PhotonMap::add(const Photon& photon) {
  if (most_ > 0 && photons_.size() == most_) write_run();
  photons_.push_back({cell_of(photon.p), photon});
}

void PhotonMap::write_run() {
  std::ranges::sort(photons_, comes_before);
  file_.add_run(photons_);
  photons_.clear();
}

void PhotonMap::build() {
  if (file_.empty()) {
    std::ranges::sort(photons_, comes_before);
    return;
  }
  write_run();
  photons_.resize(most_);
  constexpr std::size_t photons_an_entry = sizeof(std::uint64_t) / (photon_bytes - sizeof(PlacedPhoton));
  file_.merge(photons_, most_ / photons_an_entry);
}

std::uint64_t PhotonMap::row(int axis, double coordinate) const {
  const double cell = std::floor((coordinate - origin_[axis]) / edge_) + 1;
  return static_cast<std::uint64_t>(std::clamp(cell, 0.0, 2 * most_cells - 1));
}

std::uint64_t PhotonMap::cell_of(const float (&p)[3]) const {
  const auto at = [&](int axis) { return row(axis, static_cast<double>(p[axis])); };
  return (at(2) << cell_bits | at(1)) << cell_bits | at(0);
}

SampledSpectrum PhotonMap::gather(const Gather& at, std::uint32_t max_depth, std::uint64_t& found) const {
  const Point3d p{static_cast<double>(at.p[0]), static_cast<double>(at.p[1]), static_cast<double>(at.p[2])};
  const Vector3d out = decoded(at.out), geometric = decoded(at.geometric), shading = decoded(at.shading);
  const Frame frame(shading);
  const auto to_local = [&](Vector3d v) {
    return Vector3d{dot(v, frame.tangent), dot(v, frame.bitangent), dot(v, frame.normal)};
  };
  const Vector3d local_out = to_local(out);
  // Its reflectance has no part in its shape.
  const auto shape = static_cast<double>(at.shape);
  const OrenNayarBsdf grooves{filled(0.5f), std::max(shape, 0.0)};
  const bool path_dispersed = (at.depth & Photon::dispersed) != 0;
  const std::uint32_t path_depth = at.depth & Photon::most_depth;
  std::array<double, hero_count> sum{};
  const auto add_up = [&](const Photon& photon) {
    const Vector3d way = Point3d{static_cast<double>(photon.p[0]), static_cast<double>(photon.p[1]),
                                 static_cast<double>(photon.p[2])} -
                         p;
    if (!(dot(way, way) < radius_ * radius_) || std::abs(dot(way, geometric)) > half_height * radius_) return;
    const std::uint32_t depth = photon.depth & Photon::most_depth;
    if (path_depth + 1 + depth > max_depth) return;
    const Vector3d in = -decoded(photon.direction);
    const double cosine = dot(in, geometric), local_cosine = dot(in, shading);
    if (!(cosine > 0) || !(local_cosine > 0)) return;
    double f = local_cosine / (pi * cosine);
    if (shape < 0) f *= 1 - fresnel_dielectric(std::min(local_cosine, 1.0), -shape);
    if (shape > 0) f = 2 * static_cast<double>(eval(grooves, local_out, to_local(in)).value[0]) / cosine;
    // Of the two that lost the wavelengths but one, each counts it for all.
    if (path_dispersed && (photon.depth & Photon::dispersed)) f /= hero_count;
    for (std::size_t i = 0; i < hero_count; ++i) sum[i] += f * static_cast<double>(photon.power[i]);
    ++found;
  };
  const auto low = [&](int axis) { return row(axis, p[axis] - radius_); };
  const auto high = [&](int axis) { return row(axis, p[axis] + radius_); };
  const std::uint64_t x0 = low(0), x1 = high(0), y1 = high(1), z1 = high(2);
  for (std::uint64_t z = low(2); z <= z1; ++z)
    for (std::uint64_t y = low(1); y <= y1; ++y) {
      const std::uint64_t row_of_cells = (z << cell_bits | y) << cell_bits;
      visit(row_of_cells | x0, row_of_cells | x1, add_up);
    }
  SampledSpectrum result;
  const double density = 1 / (pi * radius_ * radius_);
  for (std::size_t i = 0; i < hero_count; ++i)
    result.v[i] = static_cast<float>(static_cast<double>(at.weight[i]) * sum[i] * density);
  return result;
}

}  // namespace vitrail
