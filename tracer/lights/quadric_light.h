// SPDX-License-Identifier: Apache-2.0
// A QuadricLight samples one quadric that emits, and gives the density. All is exact under affine transforms.
//
//   whole sphere, from outside    uniform in the cone of directions that meets it, in its own space
//   whole sphere, from inside     uniform in all directions of its own space
//   cylinder that goes all the way round and whose outside alone shines or is seen
//                                 uniform in the angle about its axis that it is seen under, and at each of
//                                 these equiangular along the axis (Kulla & Fajardo 2012)
//   whole disk                    in the elliptic cone of directions that meets it, uniform where that is
//                                 squeezed to a circular one
//   others                        uniform by the area of their own space in one of its patches, if it has any
#pragma once

#include <memory>
#include <optional>

#include "bundle/manifest.h"
#include "tracer/lights/light_tree.h"
#include "tracer/lights/quadric_patches.h"
#include "tracer/quadrics/placed_quadric.h"
#include "tracer/quadrics/quadric_area.h"
#include "tracer/textures/textures.h"

namespace vitrail {

class QuadricLight {
 public:
  // It refers to the record. `two_sided` is that of its area light. `patches` is about the number that it may
  // have.
  QuadricLight(const EmissiveQuadric& record, bool two_sided, int patches = QuadricPatches::most);

  struct Sample {
    Point3d local;        // in the quadric's own space
    Vector3d to_light;    // unit
    Vector3d normal;      // unit, of the front
    double distance = 0;  // > 0
    double pdf = 0;       // per solid angle
    bool front = false;   // is seen
  };
  // u and v are in [0,1). It returns nothing where nothing that emits is seen.
  std::optional<Sample> sample(Point3d from, float u, float v) const;
  // Returns the density, per solid angle, with which sample(from) gives the point `at` of the quadric, seen
  // at `cosine` from its normal (> 0: its front).
  double pdf(Point3d from, Point3d at, double cosine) const;

  // Returns one over the density, per area where it stands, of points uniform by the area of its own space.
  double area_by(Vector3d unit_normal) const {
    return own_area_ * area_stretch(record_->to_bundle, unit_normal);
  }
  TexturePoint texture_point(Point3d local) const;
  double area() const;         // where it stands
  LightBounds bounds() const;  // box and normals
  const EmissiveQuadric& record() const { return *record_; }
  const PlacedQuadric& stands() const { return stands_; }
  // Returns whether that side of a closed quadric is its front.
  bool is_front(bool outside) const { return outside != record_->quadric.inside_out; }

 private:
  enum class Way : std::uint8_t { sphere, cylinder, disk, area };
  struct Arc;
  struct EllipticCone;

  Vector3d own(Vector3d v) const;
  Vector3d placed(Vector3d v) const;
  double sphere_pdf(Vector3d q, bool from_outside) const;
  Arc arc(Vector3d q) const;
  std::optional<Sample> sample_sphere(Point3d from, float u, float v) const;
  std::optional<Sample> sample_cylinder(Point3d from, float u, float v) const;
  std::optional<Sample> sample_disk(Point3d from, float u, float v) const;
  std::optional<Sample> sample_area(Point3d from, float u, float v) const;
  Sides sides(Point3d from) const;
  Way way(Point3d from) const;

  const EmissiveQuadric* record_;
  PlacedQuadric stands_;
  double own_area_ = 0;
  double own_height_ = 1;  // of a cylinder, over its radius
  Way way_ = Way::area;
  bool two_sided_ = false;
  std::shared_ptr<const QuadricPatches> patches_;  // or none
};

}  // namespace vitrail
