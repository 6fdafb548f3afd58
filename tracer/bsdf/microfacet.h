// SPDX-License-Identifier: Apache-2.0
// This file has distributions of microfacet normals over a height field without correlation of heights and
// slopes (Smith 1967). They are GGX (Trowbridge & Reitz 1975; Walter et al. 2007) and Beckmann (1963), of
// width α_u along +x, α_v along +y. A normal m has m.z > 0. Directions v are unit. Those of the masking
// functions may lie on either side of the surface; those that normals are sampled for have v.z > 0.
#pragma once

#include "scene/geometry/vec.h"
#include "scene/records/material.h"

namespace vitrail {

struct Microfacets {
  double alpha_u = 0, alpha_v = 0;  // both 0: a smooth surface; else ≥ least_alpha
  Roughness::Distribution distribution = Roughness::Distribution::ggx;
  Masking masking = Masking::correlated;
  bool smooth() const { return alpha_u == 0 && alpha_v == 0; }
};

inline constexpr double least_alpha = 1e-4;  // of what is not smooth along both tangents

// Brings widths that a file or a texture gives into the range that Microfacets allows.
Microfacets make_microfacets(double alpha_u, double alpha_v,
                             Roughness::Distribution distribution = Roughness::Distribution::ggx,
                             Masking masking = Masking::correlated);

// Returns D(m), in sr⁻¹: ∫ D(m) m.z dm = 1 (Walter et al. 2007, Eqs. 25 and 33, anisotropic as in Heitz 2014,
// Eqs. 82 and 85).
double normal_density(const Microfacets& microfacets, Vector3d m);

// Returns the area of microfacets seen from v a unit of surface: σ(v) = ∫ D(m) max(0, v·m)
// dm = v.z·(1 + Λ(v)) for v.z ≥ 0 (Heitz 2014, Eqs. 54, 68 and 72). It is positive wherever v.z ≥ 0.
double visible_area(const Microfacets& microfacets, Vector3d v);

// Returns G₁ = v.z/σ(v) where v and m see each other's front, else 0 (Heitz 2014, Eq. 43).
double masking(const Microfacets& microfacets, Vector3d v, Vector3d m);

// Returns G₂(a, b)/(|a.z|·|b.z|), which is finite at grazing directions. The caller has to know that a and b
// see the sides of m that they should. area_a = σ(a), a.z ≥ 0.
double shadowing_over_cosines(const Microfacets& microfacets, Vector3d a, double area_a, Vector3d b);
inline double shadowing_over_cosines(const Microfacets& microfacets, Vector3d a, Vector3d b) {
  if (a.z < 0) a = -a;
  return shadowing_over_cosines(microfacets, a, visible_area(microfacets, a), b);
}

// Samples a normal as seen from v, v.z > 0, with the pdf D(m)·max(0, v·m)/σ(v) in solid angle of m (Heitz &
// d'Eon 2014). GGX is sampled by caps of spheres (Dupuy & Benyoub 2023), Beckmann by inverting the
// distribution of slopes.
Vector3d sample_visible_normal(const Microfacets& microfacets, Vector3d v, Point2f u);
double visible_normal_pdf(const Microfacets& microfacets, Vector3d v, Vector3d m);

// Returns `out` mirrored by a facet of normal m.
inline Vector3d mirror(Vector3d out, Vector3d m) { return m * (2 * dot(out, m)) - out; }

}  // namespace vitrail
