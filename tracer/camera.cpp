// SPDX-License-Identifier: Apache-2.0
#include "tracer/camera.h"

#include "tracer/portable_math.h"

namespace vitrail {

namespace {

// The filter along one axis at distance x from its centre, not normalised.
double value(const TriangleFilter&, double radius, double x) { return std::max(0.0, radius - std::abs(x)); }
double value(const GaussianFilter& f, double radius, double x) {
  const auto gauss = [&](double d) {
    return portable_exp(std::max(-700.0, -d * d / (2 * f.sigma * f.sigma)));
  };
  return std::max(0.0, gauss(x) - gauss(radius));
}

// The negative lobes of the next two cannot be sampled by importance: they are left out.

// Mitchell and Netravali 1988, eq. 8, with x stretched so that it ends at the radius.
double value(const MitchellFilter& f, double radius, double x) {
  const double b = f.b, c = f.c, t = 2 * std::abs(x) / radius;
  const double inner = ((12 - 9 * b - 6 * c) * t + (-18 + 12 * b + 6 * c)) * t * t + (6 - 2 * b);
  const double outer =
      (((-b - 6 * c) * t + (6 * b + 30 * c)) * t + (-12 * b - 48 * c)) * t + (8 * b + 24 * c);
  return std::max(0.0, t < 1 ? inner : t < 2 ? outer : 0.0);
}

double sinc(double x) { return std::abs(x) < 1e-5 ? 1 : sin_pi(x) / (pi * x); }
double value(const SincFilter& f, double, double x) { return std::max(0.0, sinc(x) * sinc(x / f.tau)); }

}  // namespace

FilterSampler::FilterSampler(const Filter& filter) {
  std::visit(
      [&](const auto& f) {
        x_.radius = f.radius_x;
        y_.radius = f.radius_y;
        if constexpr (!std::is_same_v<std::decay_t<decltype(f)>, BoxFilter>) {
          for (Axis* axis : {&x_, &y_}) {
            axis->cumulative.assign(resolution + 1, 0);
            const double step = 2 * axis->radius / resolution;
            for (std::size_t i = 0; i < resolution; ++i)
              axis->cumulative[i + 1] =
                  axis->cumulative[i] +
                  value(f, axis->radius, (static_cast<double>(i) + 0.5) * step - axis->radius);
            const double total = axis->cumulative.back();
            if (!(total > 0)) axis->cumulative.clear();
            for (double& c : axis->cumulative) c /= total;
          }
        }
      },
      filter);
}

double FilterSampler::Axis::sample(double u) const {
  if (cumulative.empty()) return (2 * u - 1) * radius;
  const auto above = std::upper_bound(cumulative.begin() + 1, cumulative.end() - 1, u);
  const auto bin = static_cast<std::size_t>(above - cumulative.begin()) - 1;
  const double width = cumulative[bin + 1] - cumulative[bin];
  const double within = width > 0 ? std::clamp((u - cumulative[bin]) / width, 0.0, 1.0) : 0.5;
  return (static_cast<double>(bin) + within) * (2 * radius / resolution) - radius;
}

Point2d FilterSampler::sample(float u, float v) const {
  return {x_.sample(static_cast<double>(u)), y_.sample(static_cast<double>(v))};
}

CameraRay camera_ray(const Camera& camera, const FilmSettings& film, Point2d raster) {
  const auto on_screen = [&](const ScreenWindow& s) {
    return Point2d{s.x0 + raster.x / film.width * (s.x1 - s.x0),
                   s.y1 - raster.y / film.height * (s.y1 - s.y0)};
  };
  Point3d origin;
  Vector3d direction;
  if (const auto* perspective = std::get_if<PerspectiveCamera>(&camera)) {
    const Point2d p = on_screen(perspective->screen);
    origin = transform_point(perspective->camera_to_world, {0, 0, 0});
    direction = transform_vector(perspective->camera_to_world, {p.x, p.y, 1});
  } else {
    const auto& orthographic = std::get<OrthographicCamera>(camera);
    const Point2d p = on_screen(orthographic.screen);
    origin = transform_point(orthographic.camera_to_world, {p.x, p.y, 0});
    direction = transform_vector(orthographic.camera_to_world, {0, 0, 1});
  }
  return {cast<float>(origin), encode_direction(direction)};
}

}  // namespace vitrail
