// SPDX-License-Identifier: Apache-2.0
#include "scene/shapes/quadric_places.h"

#include <algorithm>
#include <cmath>

#include "scene/system/temporary_file.h"

namespace vitrail {

namespace {

constexpr std::size_t most_samples = 4096;

Transform transform_of(const QuadricPlaces::Place& place) {
  Transform t;
  for (std::size_t i = 0; i < 3; ++i) std::copy_n(&place[4 * i], 4, t.m[i].begin());
  return t;
}

double median(std::vector<double> values) {
  const auto middle = values.begin() + static_cast<std::ptrdiff_t>((values.size() - 1) / 2);
  std::ranges::nth_element(values, middle);
  return *middle;
}

constexpr const char* kept = "shapes";

}  // namespace

QuadricPlaces::QuadricPlaces(const Quadric& quadric, std::uint64_t memory_bytes)
    : quadric_(quadric),
      memory_places_(std::max<std::uint64_t>(memory_bytes / sizeof(Place), most_samples)) {}

void QuadricPlaces::add(const Transform& place) {
  if (block_.size() == memory_places_) spill();
  Place& stored = block_.emplace_back();
  for (std::size_t i = 0; i < 3; ++i) std::ranges::copy(place.m[i], &stored[4 * i]);
  const Bounds3d box = bounds_of(quadric_, place);
  extend(bounds_, box);
  if (size_++ % stride_ != 0) return;
  sample_.push_back(center(box));
  if (sample_.size() < most_samples) return;
  for (std::size_t i = 0; 2 * i < sample_.size(); ++i) sample_[i] = sample_[2 * i];
  sample_.resize(sample_.size() / 2);
  stride_ *= 2;
}

void QuadricPlaces::spill() {
  if (!file_) file_.reset(open_temporary(kept));
  write_at(file_.get(), spilled_ * sizeof(Place), std::as_bytes(std::span(block_)), kept);
  spilled_ += block_.size();
  block_.clear();
}

void QuadricPlaces::read(std::size_t first, std::span<Transform> out) const {
  const std::size_t on_disk = first < spilled_ ? std::min(out.size(), spilled_ - first) : 0;
  std::vector<Place> places(on_disk);
  if (on_disk > 0)
    read_at(file_.get(), first * sizeof(Place), std::as_writable_bytes(std::span(places)), kept);
  for (std::size_t i = 0; i < out.size(); ++i)
    out[i] = transform_of(i < on_disk ? places[i] : block_[first + i - spilled_]);
}

Point3d QuadricPlaces::centre() const {
  Point3d middle;
  std::vector<double> values(sample_.size());
  for (int axis = 0; axis < 3; ++axis) {
    std::ranges::transform(sample_, values.begin(), [&](const Point3d& p) { return p[axis]; });
    middle[axis] = median(values);
  }
  return middle;
}

double QuadricPlaces::radius() const {
  const Point3d middle = centre();
  std::vector<double> values(sample_.size());
  std::ranges::transform(sample_, values.begin(), [&](const Point3d& p) {
    const Vector3d off = p - middle;
    return std::max({std::abs(off.x), std::abs(off.y), std::abs(off.z)});
  });
  return median(std::move(values));
}

}  // namespace vitrail
