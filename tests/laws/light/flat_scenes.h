// SPDX-License-Identifier: Apache-2.0
// Scenes in which every camera ray of a direction meets the same: randomness that repeats along a path, or
// from sample to sample, has nowhere to average out, and the mean is known in closed form or by quadrature.
#pragma once

#include <functional>
#include <string>

#include "tests/support/render.h"
#include "tracer/bsdf/bsdf.h"

namespace vitrail::test {

// Of a film whose pixels all see the same, each by random numbers of its own: so their scatter tells the
// error of their mean.
struct Mean {
  XYZ value, error;
};
Mean mean_of(const Film& film);

// Within 4.5 standard errors and `slack`·expected; also tells that the error itself is at most `precision`
// of what is expected.
void expect_luminance(const Mean& found, double expected, double precision, const std::string& what,
                      double slack = 1e-4);

// Unit, θ from +z.
Vector3d direction(double theta_deg, double phi_deg = 0);

// Parallel rays along −out towards the origin (or `target`), 16 × 16 pixels over a square of `half_width`.
void look_along(Scene& scene, Vector3d out, Point3d target = {}, double half_width = 0.05);

// A square of the plane at the height z around (x, 0), front upwards.
Id<TriangleMesh> square(Scene& scene, float z, float half_width = 1000, float x = 0);

// f·cosθ of light of irradiance 1 (across its direction) from `in`, and of radiance 1 from all around, that
// an opaque plane sends along `out`. Without VITRAIL_LONG_TESTS of half of the samples: errors are those of
// the film.
Mean lit_plane(const Material& material, Vector3d out, Vector3d in, int samples);
Mean plane_under_sky(const Material& material, Vector3d out, int samples);

// ∫ value(in) dω over the sphere, by the midpoints of `rings` × 2·`rings` cells of equal solid angle in
// either hemisphere.
double over_sphere(const std::function<double(Vector3d)>& value, int rings = 150);

}  // namespace vitrail::test
