// SPDX-License-Identifier: Apache-2.0
// These are the discs around sensors: photons that cross one bring their light to its sensor. Flux through a
// disc over its area is the mean irradiance of the disc, whichever way the photons come.
#pragma once

#include <algorithm>
#include <cstdint>
#include <span>
#include <vector>

#include "scene/geometry/vec.h"
#include "scene/records/camera.h"
#include "tracer/rays/direction.h"

namespace vitrail {

// It says where a sensor is and how it faces, as photons and questions name it. One of all sensors with the
// same name is kept.
struct SensorName {
  Point3f p;
  DirectionCode facing;  // against its normal: the way that light comes which it measures in full
  static SensorName of(const Sensor& sensor) {
    return {cast<float>(sensor.position), encode_direction(-sensor.normal)};
  }
  bool operator==(const SensorName&) const = default;
};

class SensorDiscs {
 public:
  explicit SensorDiscs(std::span<const Sensor> sensors);  // in the bundle's space, normals unit

  struct Disc {
    Sensor sensor;
    SensorName name;
  };
  // Visits the discs of this radius whose fronts are crossed on the way from `from` to `from + end·way`, its
  // end left out. `end` may be infinite.
  template <class Visit>
  void for_each_crossed(Point3d from, Vector3d way, double end, double radius, const Visit& visit) const {
    if (!nodes_.empty()) walk(0, {from, way, end, radius}, visit);
  }

  Point3d middle() const { return middle_; }                        // of the box around all
  static constexpr std::size_t bytes_a_sensor = sizeof(Disc) + 32;  // with its part of the tree, at most

 private:
  struct Segment {
    Point3d from;
    Vector3d way;
    double end, radius;
  };
  // It is a ball around the middles of the discs [begin, end). An inner node has two children: the next node,
  // and `other`.
  struct Node {
    Point3d centre;
    double radius = 0;
    std::uint32_t begin = 0, end = 0, other = 0;
  };
  static constexpr std::uint32_t most_in_leaf = 4;

  void build(std::uint32_t begin, std::uint32_t end);
  static bool comes_near(const Node& node, const Segment& s);
  static bool crosses(const Sensor& sensor, const Segment& s);
  template <class Visit>
  void walk(std::uint32_t at, const Segment& s, const Visit& visit) const {
    const Node& node = nodes_[at];
    if (!comes_near(node, s)) return;
    if (node.other != 0) {
      walk(at + 1, s, visit);
      walk(node.other, s, visit);
      return;
    }
    for (std::uint32_t i = node.begin; i < node.end; ++i)
      if (crosses(discs_[i].sensor, s)) visit(discs_[i]);
  }

  std::vector<Disc> discs_;
  std::vector<Node> nodes_;
  Point3d middle_;
};

}  // namespace vitrail
