// SPDX-License-Identifier: Apache-2.0
// Media that absorb, and what of light a straight way through them leaves.
#pragma once

#include <string>
#include <vector>

#include "tests/support/render.h"

namespace vitrail::test {

// A cube of half the width `reach`, or a ball of this radius; or all of space, where there is none.
struct MediumPlace {
  std::string name;
  Point3d center;
  double reach = 0;
  bool round = false;
  double sigma_a = 0.5;
  bool is_endless() const { return reach == 0; }
};

// Around a lamp at `lamp`, above 0; before it; across its middle; around 0; around a camera 20 away as well.
std::vector<MediumPlace> places(Point3d lamp, bool round);
MediumPlace endless(double sigma_a);

// What absorption leaves from a to b.
double through(const MediumPlace& place, Point3d a, Point3d b);

Medium absorbing(double sigma_a, bool grid);
// Puts the medium there, behind a boundary of this material; around the camera where that is inside.
void fill(Scene& scene, const MediumPlace& place, bool grid,
          const Material& boundary = {InterfaceMaterial{}});

Transform ball(Point3d center, double radius);
void add_quadric(Scene& scene, const Quadric& quadric, const Transform& to, const Material& material,
                 const std::optional<AreaLight>& light = std::nullopt);

}  // namespace vitrail::test
