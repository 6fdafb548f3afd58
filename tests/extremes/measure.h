// SPDX-License-Identifier: Apache-2.0
// The rows of docs/why/extremes.md: each is printed as it is measured, and held to its limit.
#pragma once

#include <string>

#include "tests/support/render.h"

namespace vitrail::test {

// |measured − expected| ≤ limit·|expected| + 4·noise, `noise` being a standard error of what is measured.
void expect_relative(const std::string& what, double expected, double measured, double limit,
                     double noise = 0);
// The same with a limit that is no share of what is expected.
void expect_absolute(const std::string& what, double expected, double measured, double limit,
                     double noise = 0);
// A count or another number that has to be exactly that.
void expect_exactly(const std::string& what, double expected, double measured);
// A number without an expectation, for the reader of the table.
void report(const std::string& what, double value, const std::string& unit = "");

std::uint32_t pixels_of(const Film& film);

// Of two films of one size. Relative differences are of Y, to the mean Y of the first.
struct FilmDifference {
  double mean = 0;              // of the means of all pixels
  double root_mean_square = 0;  // of the pixels
  std::size_t pixels = 0;       // that are not equal to the bit
};
FilmDifference picture_difference(const Film& a, const Film& b);

// What all samples of a pixel have in common with those of any other scene is their wavelengths: the mean Y
// over that of a sky of 1 with the same ones is free of what sampling the spectrum makes of noise.
struct Measured {
  double mean = 0;
  double standard_error = 0;  // from the scatter of the pixels, which are to be alike
};
Measured measured(const Film& film);
Measured measure(const Scene& scene, int samples_per_pixel, const std::string& name = "");

// Renders, expects that no sample is refused, and keeps the film in VITRAIL_EXTREMES_FILMS as NAME.film
// where that directory is named: to be developed and looked at.
Rendered render_finite(const Scene& scene, int samples_per_pixel, const std::string& name = "",
                       std::uint32_t domains = 1);

// An orthographic camera whose picture is the square of that half width around `target`, seen from `eye`.
void set_orthographic(Scene& scene, Point3d eye, Point3d target, Vector3d up, double half_width, int pixels);

// A quadrilateral in the plane z, front upwards.
std::array<Point3f, 4> square_at(float z, float half_width);

Material matte(float reflectance);
AreaLight lamp(double radiance, bool two_sided = false);
void add_sky(Scene& scene, double radiance);
void add_sun(Scene& scene, Vector3d direction, double irradiance);
void add_point(Scene& scene, Point3d position, double intensity);

// Whether what takes minutes or gigabytes is to be run whole: VITRAIL_EXTREMES_WHOLE is set.
bool run_whole();

}  // namespace vitrail::test
