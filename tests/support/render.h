// SPDX-License-Identifier: Apache-2.0
// Rendering a Scene that a test has made.
#pragma once

#include "farm/render.h"
#include "film/film.h"
#include "scene/records/scene.h"

namespace vitrail::test {

struct Rendered {
  Film film;
  RenderStats stats;
};

// Through a bundle of `domains` in a temporary directory, in this process.
Rendered render(const Scene& scene, int samples_per_pixel, std::uint32_t domains = 1, std::uint64_t seed = 0);
// With all other options; those of files are filled in.
Rendered render(const Scene& scene, RenderOptions options, std::uint32_t domains = 1);

// A pinhole at `eye` that sees `fov_rad` on the shorter axis; a box filter of one pixel.
void set_camera(Scene& scene, Point3d eye, Point3d target, Vector3d up, double fov_rad, int width,
                int height);

// Two triangles a quadrilateral, counter-clockwise seen from the front. Returns the mesh's id.
Id<TriangleMesh> add_quads(Scene& scene, const std::vector<std::array<Point3f, 4>>& quads);
void add_shape(Scene& scene, Id<TriangleMesh> mesh, const Material& material,
               const std::optional<AreaLight>& light = std::nullopt);

// The six faces of a box, fronts outwards.
std::vector<std::array<Point3f, 4>> box_faces(Point3f lower, Point3f upper);
// The inside of a grey box with a lamp under its ceiling, `side` pixels square: noisy everywhere.
Scene lit_box(int side);

// Mean Y of all pixels, and the standard error of that mean.
struct Brightness {
  double mean = 0, standard_error = 0;
};
Brightness brightness(const Film& film);

}  // namespace vitrail::test
