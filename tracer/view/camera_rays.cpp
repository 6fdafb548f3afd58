// SPDX-License-Identifier: Apache-2.0
#include "tracer/view/camera_rays.h"

#include <algorithm>
#include <cmath>

#include "scene/geometry/portable_math.h"
#include "scene/models/lens_tracing.h"
#include "scene/models/paraxial_lens.h"

namespace vitrail {

namespace {

// Of camera space.
struct LocalRay {
  Point3d origin;
  Vector3d direction;  // not 0, of any length
  double weight = 1;
};

Point2d on_raster(const ScreenWindow& s, const FilmSettings& film, Point2d p) {
  return {(p.x - s.x0) / (s.x1 - s.x0) * film.width, (s.y1 - p.y) / (s.y1 - s.y0) * film.height};
}
Point2d on_screen(const ScreenWindow& s, const FilmSettings& film, Point2d raster) {
  return {s.x0 + raster.x / film.width * (s.x1 - s.x0), s.y1 - raster.y / film.height * (s.y1 - s.y0)};
}

// Through a point of the lens to where the ray of the pinhole meets the plane in focus.
LocalRay through_lens(const Lens& lens, LocalRay ray, Point2d u) {
  if (!(lens.radius > 0)) return ray;
  const Point2d p = concentric_disk(u);
  const Point3d start{lens.radius * p.x, lens.radius * p.y, 0};
  return {start, ray.origin + lens.focal_distance * ray.direction - start};
}

LocalRay local_ray(const PerspectiveCamera& camera, const FilmSettings& film, Point2d raster, Point2d lens) {
  const Point2d p = on_screen(camera.screen, film, raster);
  return through_lens(camera.lens, {{0, 0, 0}, {p.x, p.y, 1}}, lens);
}

LocalRay local_ray(const OrthographicCamera& camera, const FilmSettings& film, Point2d raster, Point2d lens) {
  const Point2d p = on_screen(camera.screen, film, raster);
  return through_lens(camera.lens, {{p.x, p.y, 0}, {0, 0, 1}}, lens);
}

// Over the edges of the octahedral square one comes back half a turn on.
Point2d wrapped(Point2d p) {
  if (p.x < 0 || p.x > 1) p = {p.x < 0 ? -p.x : 2 - p.x, 1 - p.y};
  if (p.y < 0 || p.y > 1) p = {1 - p.x, p.y < 0 ? -p.y : 2 - p.y};
  return p;
}

// The square [0,1]² to the sphere, area by area, +z in the middle (Clarberg 2008).
Vector3d equal_area_direction(Point2d p) {
  const double u = 2 * p.x - 1, v = 2 * p.y - 1;
  const double au = std::abs(u), av = std::abs(v);
  const double inside = 1 - (au + av);  // > 0: the upper hemisphere
  const double r = 1 - std::abs(inside);
  const double phi = r > 0 ? pi / 4 * ((av - au) / r + 1) : 0;  // |av − au| ≤ r
  const double sine = r * std::sqrt(std::max(0.0, 2 - r * r));
  return {std::copysign(sine * portable_cos(phi), u), std::copysign(sine * portable_sin(phi), v),
          std::copysign(1 - r * r, inside)};
}

Vector3d latitude_longitude_direction(Point2d p) {
  const double theta = pi * p.y, phi = 2 * pi * p.x;
  const double sine = portable_sin(theta);
  return {sine * portable_cos(phi), sine * portable_sin(phi), portable_cos(theta)};
}

LocalRay local_ray(const SphericalCamera& camera, const FilmSettings& film, Point2d raster, Point2d) {
  const Point2d p{raster.x / film.width, raster.y / film.height};
  const Vector3d up_is_z = camera.projection == SphericalCamera::Projection::equal_area
                               ? equal_area_direction(wrapped(p))
                               : latitude_longitude_direction(p);
  return {{0, 0, 0}, {up_is_z.x, up_is_z.z, up_is_z.y}};
}

// Towards the longitude and latitude.
Vector3d direction_at(double longitude, double latitude) {
  const double c = portable_cos(latitude);
  return {c * portable_sin(longitude), portable_sin(latitude), c * portable_cos(longitude)};
}

// A cylinder around y: `turn` about it, `height` along it.
LocalRay from_cylinder(double turn, double height, bool parallel) {
  const Vector3d across{portable_sin(turn), 0, portable_cos(turn)};
  if (parallel) return {{0, height, 0}, across};
  return {{0, 0, 0}, across + Vector3d{0, height, 0}};
}

LocalRay local_ray(const WideCamera& camera, const FilmSettings& film, Point2d raster, Point2d) {
  using enum WideCamera::Projection;
  const Point2d p{2 * raster.x / film.width - 1, 1 - 2 * raster.y / film.height};
  const double across = p.x * camera.across, above = p.y * camera.above;
  const double x = across * (pi / 180), y = above * (pi / 180);
  switch (camera.projection) {
    case fisheye: {
      const double away = std::sqrt(x * x + y * y);
      if (!(away > 0)) return {{0, 0, 0}, {0, 0, 1}};
      const double sine = portable_sin(away) / away;
      return {{0, 0, 0},
              {x * sine, y * sine, portable_cos(away)},
              away <= camera.edge_deg * (pi / 180) ? 1.0 : 0.0};
    }
    case ultra_wide:
      return {{0, 0, 0}, {portable_sin(x), portable_sin(y), portable_cos(x) * portable_cos(y)}};
    case panoramic:
      return {{0, 0, 0},
              {camera.across * portable_sin(pi / 2 * p.x), camera.above * portable_tan(pi / 2 * p.y),
               portable_cos(pi / 2 * p.x)}};
    case upright_cylinder:
      return from_cylinder(x, above, camera.parallel);
    case lying_cylinder: {
      const LocalRay ray = from_cylinder(y, across, camera.parallel);
      return {{ray.origin.y, 0, 0}, {ray.direction.y, ray.direction.x, ray.direction.z}};
    }
    case latitude_longitude:
      break;
  }
  return {{0, 0, 0}, direction_at(x, y)};
}

const Sensor& sensor_of(const SensorCamera& camera, double x) {
  const auto last = static_cast<double>(camera.sensors.size() - 1);
  return camera.sensors[static_cast<std::size_t>(std::clamp(std::floor(x), 0.0, last))];
}

// What it looks along: its samples are of the whole hemisphere (transport/sensors.h).
LocalRay local_ray(const SensorCamera& camera, const FilmSettings&, Point2d raster, Point2d) {
  const Sensor& sensor = sensor_of(camera, raster.x);
  return {sensor.position, sensor.normal};
}

// Backwards: from the film through the lens. The film's image is upside down and mirrored.
LocalRay local_ray(const RealisticCamera& camera, const FilmSettings& film, Point2d raster, Point2d u) {
  const Point2d half = half_film(camera, film);
  const Point3d p{half.x * (1 - 2 * raster.x / film.width), half.y * (2 * raster.y / film.height - 1), 0};
  const double off_axis = std::sqrt(p.x * p.x + p.y * p.y);
  const auto rings = static_cast<double>(camera.pupils.size());
  const auto ring = static_cast<std::size_t>(
      std::clamp(std::floor(off_axis / (camera.film_diagonal / 2) * rings), 0.0, rings - 1));
  const ExitPupil& pupil = camera.pupils[ring];
  const ScreenWindow& r = pupil.rectangle;
  const double x = r.x0 + u.x * (r.x1 - r.x0), y = r.y0 + u.y * (r.y1 - r.y0);
  const double cosine = off_axis > 0 ? p.x / off_axis : 1, sine = off_axis > 0 ? p.y / off_axis : 0;
  const Point2d rear{cosine * x - sine * y, sine * x + cosine * y};
  const auto ray = through_lens(camera.surfaces, p, rear);
  if (!ray || !(pupil.weight > 0)) return {{0, 0, 0}, {0, 0, 1}, 0};
  return {ray->origin, ray->direction,
          pupil.weight * cosine_4({p.x, p.y}, rear, rear_vertex(camera.surfaces))};
}

}  // namespace

Point2d concentric_disk(Point2d u) {
  const double x = 2 * u.x - 1, y = 2 * u.y - 1;
  if (x == 0 && y == 0) return {0, 0};
  const bool wide = std::abs(x) > std::abs(y);  // the larger of the two, which divides, is not 0
  const double radius = wide ? x : y;
  const double angle = wide ? pi / 4 * (y / x) : pi / 2 - pi / 4 * (x / y);
  return {radius * portable_cos(angle), radius * portable_sin(angle)};
}

namespace {

struct WorldRay {
  Point3d origin;
  Vector3d direction;
  double weight = 1;
  double depth = 1;  // along the camera's axis, of `direction`
};

// `moved`: where the camera is instead, if it moves.
WorldRay world_ray(const Camera& camera, const FilmSettings& film, Point2d raster, Point2d lens,
                   const Transform* moved) {
  return std::visit(
      [&](const auto& c) -> WorldRay {
        const LocalRay ray = local_ray(c, film, raster, lens);
        const Transform& to_world = moved ? *moved : c.camera_to_world;
        return {transform_point(to_world, ray.origin), transform_vector(to_world, ray.direction), ray.weight,
                ray.direction.z};
      },
      camera);
}

CameraRay clipped(const ClipRange& clip, const WorldRay& ray) {
  const double near = static_cast<double>(clip.near) / ray.depth,
               far = static_cast<double>(clip.far) / ray.depth;
  const DirectionCode direction = encode_direction(ray.direction);
  const double long_as = length(ray.direction);
  return {cast<float>(ray.origin + near * ray.direction), direction, ray.weight, near * long_as,
          (far - near) * long_as / length(cast<double>(decode_direction(direction)))};
}

}  // namespace

CameraSampler::CameraSampler(const Camera& camera, const Motion& motion, const FilmSettings& film)
    : camera_(camera), motion_(motion), film_(film), clips_(clip_of(camera) != ClipRange{}) {
  std::visit(
      [&](const auto& c) {
        if constexpr (requires { c.lens; }) {
          has_lens_ = c.lens.radius > 0;
          is_linear_ = !has_lens_ && !clips_ && !motion.moves();
        } else if constexpr (requires { c.surfaces; }) {
          has_lens_ = true;
        }
      },
      camera);
  if (!is_linear_) return;
  const double w = film.width, h = film.height;
  const WorldRay corner = world_ray(camera, film, {0, 0}, {}, nullptr),
                 right = world_ray(camera, film, {w, 0}, {}, nullptr),
                 below = world_ray(camera, film, {0, h}, {}, nullptr);
  const auto linear = [&](Vector3d at, Vector3d at_right, Vector3d at_below) {
    return Linear{at, (at_right - at) * (1 / w), (at_below - at) * (1 / h)};
  };
  linear_.origin = linear(corner.origin - Point3d{}, right.origin - Point3d{}, below.origin - Point3d{});
  linear_.direction = linear(corner.direction, right.direction, below.direction);
}

CameraRay CameraSampler::ray(Point2d raster, Point2d lens, double time_s) const {
  if (is_linear_) {
    const Vector3d o = linear_.origin.at(raster);
    return {cast<float>(Point3d{o.x, o.y, o.z}), encode_direction(linear_.direction.at(raster))};
  }
  std::optional<Transform> moved;
  if (motion_.moves()) moved = motion_.at(time_s);
  const WorldRay ray = world_ray(camera_, film_, raster, lens, moved ? &*moved : nullptr);
  if (clips_) return clipped(clip_of(camera_), ray);
  return {cast<float>(ray.origin), encode_direction(ray.direction), ray.weight};
}

std::optional<Point2d> CameraSampler::raster(Point3d p, double time_s) const {
  const auto in_camera = [&](const Transform& to_world) {
    return transform_point(inverse(motion_.moves() ? motion_.at(time_s) : to_world), p);
  };
  if (const auto* c = std::get_if<PerspectiveCamera>(&camera_)) {
    const Point3d at = in_camera(c->camera_to_world);
    if (!(at.z > 0)) return std::nullopt;
    return on_raster(c->screen, film_, {at.x / at.z, at.y / at.z});
  }
  if (const auto* c = std::get_if<OrthographicCamera>(&camera_)) {
    const Point3d at = in_camera(c->camera_to_world);
    return on_raster(c->screen, film_, {at.x, at.y});
  }
  return std::nullopt;
}

std::optional<Sensor> CameraSampler::sensor(int x) const {
  const auto* camera = std::get_if<SensorCamera>(&camera_);
  if (!camera) return std::nullopt;
  const Sensor& local = sensor_of(*camera, x);
  return Sensor{transform_point(camera->camera_to_world, local.position),
                normalize(transform_vector(camera->camera_to_world, local.normal))};
}

}  // namespace vitrail
