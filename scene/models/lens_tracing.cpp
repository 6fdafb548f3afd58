// SPDX-License-Identifier: Apache-2.0
#include "scene/models/lens_tracing.h"

#include <algorithm>
#include <cmath>

namespace vitrail {

namespace {

// Where a ray of unit direction that comes from the film meets a sphere through `vertex` on the axis. A
// positive radius: the sphere's centre is on the film's side, so that it is left, not entered.
std::optional<double> meet(const Point3d& origin, const Vector3d& direction, double vertex, double radius) {
  const Vector3d to_origin{origin.x, origin.y, origin.z - (vertex - radius)};
  const double b = dot(to_origin, direction), c = dot(to_origin, to_origin) - radius * radius,
               discriminant = b * b - c;
  if (!(discriminant >= 0)) return std::nullopt;
  const double root = std::sqrt(discriminant), t = radius > 0 ? root - b : -root - b;
  if (!(t >= 0)) return std::nullopt;
  return t;
}

// Snell's law. `normal`, unit, is on the side that the ray comes from. Empty: total reflection.
std::optional<Vector3d> refracted(const Vector3d& direction, const Vector3d& normal, double from, double to) {
  const double eta = from / to, cosine = -dot(direction, normal),
               squared = 1 - eta * eta * (1 - cosine * cosine);
  if (!(squared > 0)) return std::nullopt;
  return eta * direction + normal * (eta * cosine - std::sqrt(squared));
}

}  // namespace

double rear_vertex(std::span<const LensSurface> surfaces) { return surfaces.back().thickness; }

std::optional<LensRay> through_lens(std::span<const LensSurface> surfaces, Point3d film, Point2d rear) {
  const double rear_z = rear_vertex(surfaces);
  LensRay ray{film, normalize(Point3d{rear.x, rear.y, rear_z} - film)};
  double vertex = 0;
  for (std::size_t i = surfaces.size(); i-- > 0;) {
    const LensSurface& surface = surfaces[i];
    vertex += surface.thickness;
    const bool is_stop = surface.radius == 0;
    const auto t = is_stop ? std::optional((vertex - ray.origin.z) / ray.direction.z)
                           : meet(ray.origin, ray.direction, vertex, surface.radius);
    if (!t || !(*t >= 0)) return std::nullopt;
    ray.origin = ray.origin + *t * ray.direction;
    const double off_axis = ray.origin.x * ray.origin.x + ray.origin.y * ray.origin.y;
    if (off_axis > surface.aperture_radius * surface.aperture_radius) return std::nullopt;
    if (is_stop) continue;
    const Point3d centre{0, 0, vertex - surface.radius};
    Vector3d normal = (ray.origin - centre) * (1 / std::abs(surface.radius));
    if (dot(normal, ray.direction) > 0) normal = -normal;
    const auto direction =
        refracted(ray.direction, normal, surface.index, i == 0 ? 1 : surfaces[i - 1].index);
    if (!direction) return std::nullopt;
    ray.direction = *direction;
  }
  ray.direction = normalize(ray.direction);
  return ray;
}

namespace {

constexpr int pupil_rings = 64, coarse = 64, fine = 16;
// Of the rear surface's radius: what is searched on each side, and what is added to what was found, which is
// twice the distance of pbrt's 2²⁰ samples there.
constexpr double searched = 1.5, added = 2 * (2 * searched * 1.4142135623730951) / 1024;

class PupilSearch {
 public:
  PupilSearch(std::span<const LensSurface> surfaces, double film) : surfaces_(surfaces), film_{film, 0, 0} {}

  // All that comes through from one point of the film. Empty: nothing does.
  std::optional<ScreenWindow> find(const ScreenWindow& guess) {
    const double all = searched * surfaces_.back().aperture_radius;
    for (const ScreenWindow& in : {ScreenWindow{-all, all, -all, all}, guess}) {
      const double wide = (in.x1 - in.x0) / coarse, high = (in.y1 - in.y0) / coarse;
      scan(in, coarse, coarse);
      if (found_) refine(wide, high), refine(wide / fine, high / fine);
    }
    return found_;
  }

 private:
  void scan(const ScreenWindow& in, int across, int down) {
    for (int j = 0; j < down; ++j)
      for (int i = 0; i < across; ++i) {
        const Point2d p{in.x0 + (i + 0.5) / across * (in.x1 - in.x0),
                        in.y0 + (j + 0.5) / down * (in.y1 - in.y0)};
        const bool known =
            found_ && found_->x0 <= p.x && p.x <= found_->x1 && found_->y0 <= p.y && p.y <= found_->y1;
        if (known || !through_lens(surfaces_, film_, p)) continue;
        if (!found_) found_ = ScreenWindow{p.x, p.x, p.y, p.y};
        found_->x0 = std::min(found_->x0, p.x), found_->x1 = std::max(found_->x1, p.x);
        found_->y0 = std::min(found_->y0, p.y), found_->y1 = std::max(found_->y1, p.y);
      }
  }
  // Looks at strips of a cell's size along the edges.
  void refine(double wide, double high) {
    const ScreenWindow f = *found_;
    scan({f.x0 - wide, f.x0, f.y0 - high, f.y1 + high}, fine, 2 * coarse);
    scan({f.x1, f.x1 + wide, f.y0 - high, f.y1 + high}, fine, 2 * coarse);
    scan({f.x0 - wide, f.x1 + wide, f.y0 - high, f.y0}, 2 * coarse, fine);
    scan({f.x0 - wide, f.x1 + wide, f.y1, f.y1 + high}, 2 * coarse, fine);
  }

  std::span<const LensSurface> surfaces_;
  Point3d film_;
  std::optional<ScreenWindow> found_;
};

ScreenWindow together(const std::optional<ScreenWindow>& a, const std::optional<ScreenWindow>& b) {
  if (!a || !b) return a ? *a : b.value_or(ScreenWindow{0, 0, 0, 0});
  return {std::min(a->x0, b->x0), std::max(a->x1, b->x1), std::min(a->y0, b->y0), std::max(a->y1, b->y1)};
}

bool is_empty(const ScreenWindow& w) { return !(w.x0 < w.x1 && w.y0 < w.y1); }

}  // namespace

std::vector<ExitPupil> exit_pupils(std::span<const LensSurface> surfaces, double film_radius) {
  const double rear = surfaces.back().aperture_radius, margin = added * rear;
  constexpr int a_ring = 2;  // points of the film: its edges and its middle
  std::vector<std::optional<ScreenWindow>> found;
  ScreenWindow guess{-rear / 8, rear / 8, -rear / 8, rear / 8};
  for (int i = 0; i <= a_ring * pupil_rings; ++i) {
    PupilSearch search(surfaces, i * film_radius / (a_ring * pupil_rings));
    found.push_back(search.find(guess));
    if (!found.back()) continue;
    const ScreenWindow& f = *found.back();  // the next point's is near it
    const double wide = (f.x1 - f.x0) / 2, high = (f.y1 - f.y0) / 2;
    guess = {f.x0 - wide, f.x1 + wide, f.y0 - high, f.y1 + high};
  }
  std::vector<ExitPupil> pupils;
  for (std::size_t i = 0; i < pupil_rings; ++i) {
    std::optional<ScreenWindow> all;
    for (std::size_t j = a_ring * i; j <= a_ring * (i + 1); ++j)
      if (found[j]) all = together(all, found[j]);
    ExitPupil& pupil = pupils.emplace_back();
    if (!all || is_empty(*all)) continue;
    pupil.rectangle = {all->x0 - margin, all->x1 + margin, all->y0 - margin, all->y1 + margin};
  }
  return pupils;
}

double cosine_4(Point2d film, Point2d rear, double rear_z) {
  const double dx = rear.x - film.x, dy = rear.y - film.y, z2 = rear_z * rear_z,
               squared = z2 / (dx * dx + dy * dy + z2);
  return squared * squared;
}

double mean_weight(std::span<const LensSurface> surfaces, Point2d film, const ScreenWindow& rectangle) {
  constexpr int side = 512;
  double sum = 0;
  for (int j = 0; j < side; ++j)
    for (int i = 0; i < side; ++i) {
      const Point2d p{rectangle.x0 + (i + 0.5) / side * (rectangle.x1 - rectangle.x0),
                      rectangle.y0 + (j + 0.5) / side * (rectangle.y1 - rectangle.y0)};
      if (through_lens(surfaces, {film.x, film.y, 0}, p)) sum += cosine_4(film, p, rear_vertex(surfaces));
    }
  return sum / (side * side);
}

}  // namespace vitrail
