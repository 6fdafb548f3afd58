// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <variant>
#include <vector>

#include "tracer/lights/direction_table.h"
#include "tracer/lights/light_sampler.h"
#include "tracer/sampling/guide_table.h"

namespace vitrail {

// It samples the directions of photons that leave a point. They are about as the light's image has it, with a
// density above 0 wherever that may shine.
class EmitterDirections {
 public:
  EmitterDirections(const EmitterShape& shape, const LightScene& scene);

  struct Way {
    Vector3d direction;  // unit, of the world
    double pdf = 0;      // solid angle; 0: nothing shines
  };
  // All numbers are in [0,1).
  Way sample(float u, float v, float choice) const;

 private:
  // It is uniform in the cone of world directions with at least that cosine to the axis.
  struct Cone {
    Vector3d axis;
    double least_z;
  };
  // It chooses by the cells of a projection's frame, `side` along each of its edges.
  struct Cells {
    static constexpr int side = 128;
    Point2d half;
    std::vector<double> cumulative;
    GuideTable guide;
  };
  void tabulate(const ProjectionShape& projection, const LightScene& scene);
  void tabulate(const GoniometricShape& goniometric);
  Way in_cells(const Cells& cells, float u, float v, float choice) const;

  std::variant<Cone, Cells, DirectionTable> how_{Cone{{0, 0, 1}, -1}};
  Transform light_to_world_;
};

}  // namespace vitrail
