// SPDX-License-Identifier: Apache-2.0
#include "scene/models/paraxial_lens.h"

#include <algorithm>
#include <cmath>

#include "scene/system/diagnostics.h"

namespace vitrail {

namespace {

// A ray near the axis: height and slope.
struct Ray {
  double height, slope;
};

double curvature(const LensSurface& surface) { return surface.radius == 0 ? 0 : 1 / surface.radius; }

// n′u′ = nu − y(n′ − n)/R at a surface, y′ = y + tu′ behind it; the thickness behind the last is the film's.
Ray refracted(Ray ray, const LensSurface& surface, double before, double behind) {
  return {ray.height, (before * ray.slope - ray.height * (behind - before) * curvature(surface)) / behind};
}

}  // namespace

ThinLens thin_lens(std::span<const LensSurface> surfaces) {
  Ray ray{1, 0};
  double before = 1, length = 0;
  ThinLens lens;
  for (std::size_t i = 0; i < surfaces.size(); ++i) {
    const LensSurface& surface = surfaces[i];
    if (surface.radius == 0) {
      if (!(ray.height > 0)) throw Error("a lens whose stop is behind its focus");
      lens.pupil_radius = surface.aperture_radius / ray.height;
    }
    ray = refracted(ray, surface, before, surface.index);
    before = surface.index;
    if (i + 1 == surfaces.size()) break;
    ray.height += surface.thickness * ray.slope;
    length += surface.thickness;
  }
  if (lens.pupil_radius == 0) throw Error("a lens without a stop: no surface has a radius of curvature of 0");
  if (!(ray.slope < 0)) throw Error("a lens that does not gather light");
  lens.focal_length = -1 / ray.slope;
  const double rear_focus = length - ray.height / ray.slope;  // from the first surface
  lens.rear_principal = rear_focus - lens.focal_length - length;
  // The same from the film's side gives the front focus.
  Ray back{1, 0};
  for (std::size_t i = surfaces.size(); i-- > 0;) {
    const double index_before = i == 0 ? 1 : surfaces[i - 1].index;
    back.slope = (surfaces[i].index * back.slope +
                  back.height * (index_before - surfaces[i].index) * curvature(surfaces[i])) /
                 index_before;
    if (i > 0) back.height += surfaces[i - 1].thickness * back.slope;
  }
  const double front_focus = back.height / back.slope;
  lens.principal_gap = rear_focus - lens.focal_length - (front_focus + lens.focal_length);
  return lens;
}

// s + s′ = S and 1/s + 1/s′ = 1/f: the lesser of the two is the image's.
std::optional<double> image_distance(const ThinLens& lens, double distance) {
  const double sum = distance - lens.principal_gap, f = lens.focal_length;
  if (!(sum > 4 * f)) return std::nullopt;
  return (sum - std::sqrt(sum * (sum - 4 * f))) / 2;
}

Point2d half_film(const RealisticCamera& camera, const FilmSettings& film) {
  const double width = film.width, height = film.height,
               half = camera.film_diagonal / 2 / std::sqrt(width * width + height * height);
  return {half * width, half * height};
}

PerspectiveCamera view_of(const RealisticCamera& camera, const FilmSettings& film) {
  const ThinLens lens = thin_lens(camera.surfaces);
  const double image = camera.surfaces.back().thickness - lens.rear_principal,
               nearest = lens.focal_length * (1 + 1e-6);  // of focus: hardly ever that far
  const Point2d half = half_film(camera, film);
  const double x = half.x / image, y = half.y / image;
  return {camera.camera_to_world * translate({0, 0, image + lens.principal_gap}),
          {-x, x, -y, y},
          {lens.pupil_radius, lens.focal_length * image / (std::max(image, nearest) - lens.focal_length)}};
}

}  // namespace vitrail
