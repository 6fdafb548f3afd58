// SPDX-License-Identifier: Apache-2.0
#include "tracer/photons/sensor_discs.h"

#include <cmath>
#include <tuple>

namespace vitrail {

namespace {

// By names, so that equal ones are neighbours.
bool is_before(const SensorDiscs::Disc& a, const SensorDiscs::Disc& b) {
  const auto key = [](const SensorName& n) {
    return std::tuple(n.p.x, n.p.y, n.p.z, n.facing.first(), n.facing.second());
  };
  return key(a.name) < key(b.name);
}

}  // namespace

SensorDiscs::SensorDiscs(std::span<const Sensor> sensors) {
  if (sensors.empty()) return;
  for (const Sensor& sensor : sensors) discs_.push_back({sensor, SensorName::of(sensor)});
  std::ranges::stable_sort(discs_, is_before);
  const auto is_same = [](const Disc& a, const Disc& b) { return a.name == b.name; };
  discs_.erase(std::unique(discs_.begin(), discs_.end(), is_same), discs_.end());
  build(0, static_cast<std::uint32_t>(discs_.size()));
  middle_ = nodes_.front().centre;
}

void SensorDiscs::build(std::uint32_t begin, std::uint32_t end) {
  const std::span<Disc> part = std::span(discs_).subspan(begin, end - begin);
  Point3d low = part[0].sensor.position, high = low;
  for (const Disc& disc : part)
    for (int axis = 0; axis < 3; ++axis) {
      low[axis] = std::min(low[axis], disc.sensor.position[axis]);
      high[axis] = std::max(high[axis], disc.sensor.position[axis]);
    }
  const std::size_t here = nodes_.size();
  const Vector3d extent = high - low;
  nodes_.push_back({low + extent * 0.5, length(extent) * 0.5, begin, end, 0});
  if (part.size() <= most_in_leaf) return;
  const int axis = extent.x >= std::max(extent.y, extent.z) ? 0 : extent.y >= extent.z ? 1 : 2;
  const std::uint32_t middle = begin + (end - begin) / 2;
  std::ranges::nth_element(part, part.begin() + (middle - begin), {},
                           [&](const Disc& disc) { return disc.sensor.position[axis]; });
  build(begin, middle);
  nodes_[here].other = static_cast<std::uint32_t>(nodes_.size());
  build(middle, end);
}

// The way's nearest point to the middle. A way has a length.
bool SensorDiscs::comes_near(const Node& node, const Segment& s) {
  const Vector3d to_middle = node.centre - s.from;
  const double at = std::clamp(dot(to_middle, s.way) / dot(s.way, s.way), 0.0, s.end);
  const Vector3d off = to_middle - s.way * at;
  const double reach = (node.radius + s.radius) * (1 + 1e-9);
  return dot(off, off) <= reach * reach;
}

bool SensorDiscs::crosses(const Sensor& sensor, const Segment& s) {
  const double towards = -dot(sensor.normal, s.way);
  if (!(towards > 0)) return false;
  const double at = dot(sensor.normal, s.from - sensor.position) / towards;
  if (!(at > 0 && at < s.end)) return false;
  const Vector3d off = s.from + s.way * at - sensor.position;
  return dot(off, off) < s.radius * s.radius;
}

}  // namespace vitrail
