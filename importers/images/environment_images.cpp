// SPDX-License-Identifier: Apache-2.0
#include "importers/images/environment_images.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "scene/geometry/pi.h"
#include "scene/spectra/color.h"

namespace vitrail {

namespace {

using enum EnvironmentLight::Projection;

// The equal-area map of the sphere to a square of Clarberg, "Fast Equal-Area Mapping of the (Hemi)Sphere
// using SIMD" (2008): each quadrant of the square is an octant above its diagonal and one below.
Vector3d equal_area_direction(Point2d point) {
  const double x = 2 * point.x - 1, y = 2 * point.y - 1;
  const double above = 1 - (std::abs(x) + std::abs(y));  // of the diagonal: the upper hemisphere
  const double radius = 1 - std::abs(above);
  const double angle = radius > 0 ? ((std::abs(y) - std::abs(x)) / radius + 1) * pi / 4 : pi / 4;
  const double z = std::copysign(1 - radius * radius, above);
  const double across = radius * std::sqrt(2 - radius * radius);  // √(1 − z²), radius in [0,1]
  return {std::copysign(across * std::cos(angle), x), std::copysign(across * std::sin(angle), y), z};
}

Point2d equal_area_point(Vector3d d) {
  const double x = std::abs(d.x), y = std::abs(d.y);
  const double radius = std::sqrt(std::max(0.0, 1 - std::abs(d.z)));
  const double angle = std::atan2(y, x) * 2 / pi;  // [0,1]
  double v = angle * radius, u = radius - v;
  if (d.z < 0) {
    const double folded = 1 - u;
    u = 1 - v;
    v = folded;
  }
  return {(std::copysign(u, d.x) + 1) / 2, (std::copysign(v, d.y) + 1) / 2};
}

// The pixel that continues the picture beyond its edges.
std::size_t pixel_index(const Image& image, EnvironmentProjection projection, int x, int y) {
  const int w = image.width, h = image.height;
  if (projection == latitude_longitude) {
    x = ((x % w) + w) % w;
  } else {  // each edge is folded onto itself about its middle
    if (x < 0 || x >= w) {
      x = x < 0 ? -1 - x : 2 * w - 1 - x;
      y = h - 1 - y;
    }
    if (y < 0 || y >= h) {
      y = y < 0 ? -1 - y : 2 * h - 1 - y;
      x = w - 1 - x;
    }
  }
  return static_cast<std::size_t>(std::clamp(y, 0, h - 1)) * static_cast<std::size_t>(w) +
         static_cast<std::size_t>(std::clamp(x, 0, w - 1));
}

// The four pixels around a point, and their shares of its value.
struct Neighbours {
  std::array<std::size_t, 4> pixels{};
  std::array<double, 4> shares{};
};

Neighbours neighbours(const Image& image, EnvironmentProjection projection, Point2d point) {
  if (projection == equal_area) {  // the pixel that it lies in
    const auto index = [](double at, int count) { return static_cast<int>(std::floor(at * count)); };
    return {{pixel_index(image, projection, index(point.x, image.width), index(point.y, image.height))}, {1}};
  }
  const double x = point.x * image.width - 0.5, y = point.y * (image.height - 1);
  const double left = std::floor(x), top = std::floor(y), fx = x - left, fy = y - top;
  const int x0 = static_cast<int>(left), y0 = static_cast<int>(top);
  const auto pixel = [&](int dx, int dy) { return pixel_index(image, projection, x0 + dx, y0 + dy); };
  return {{pixel(0, 0), pixel(1, 0), pixel(0, 1), pixel(1, 1)},
          {(1 - fx) * (1 - fy), fx * (1 - fy), (1 - fx) * fy, fx * fy}};
}

double value_at(const Image& image, const Neighbours& near, std::size_t channel) {
  double sum = 0;
  for (std::size_t i = 0; i < 4; ++i)
    if (near.shares[i] > 0)
      sum += near.shares[i] *
             static_cast<double>(
                 image.values[near.pixels[i] * static_cast<std::size_t>(image.channels) + channel]);
  return sum;
}

// Proportional to the solid angle of a small piece of the picture.
double density(EnvironmentProjection projection, Point2d point) {
  return projection == latitude_longitude ? std::sin(pi * point.y) : 1;
}

}  // namespace

Vector3d direction_of(EnvironmentProjection projection, Point2d point) {
  if (projection == equal_area) return equal_area_direction(point);
  const double theta = pi * point.y, phi = 2 * pi * point.x;
  return {std::sin(theta) * std::cos(phi), std::sin(theta) * std::sin(phi), std::cos(theta)};
}

Point2d pixel_point(EnvironmentProjection projection, int width, int height, double x, double y) {
  if (projection == equal_area) return {(x + 0.5) / width, (y + 0.5) / height};
  return {(x + 0.5) / width, height > 1 ? std::clamp(y / (height - 1), 0.0, 1.0) : 0.5};
}

Point2d point_of(EnvironmentProjection projection, Vector3d d) {
  if (projection == equal_area) return equal_area_point(d);
  const double u = std::atan2(d.y, d.x) / (2 * pi);
  return {u < 0 ? u + 1 : u, std::acos(std::clamp(d.z, -1.0, 1.0)) / pi};
}

double environment_lookup(const Image& image, EnvironmentProjection projection, Point2d point, int channel) {
  return value_at(image, neighbours(image, projection, point), static_cast<std::size_t>(channel));
}

Image reproject(const Image& image, EnvironmentProjection from, EnvironmentProjection to) {
  constexpr int side = 4;  // samples across a pixel
  // Twice as fine: the pixels of the one lie askew on those of the other.
  constexpr int least = 256, most = 4096;
  const int height = std::max(std::clamp(2 * image.height, least, most), image.height);
  Image result = black_image(to == latitude_longitude ? 2 * height : height, height, image.channels);
  const auto channels = static_cast<std::size_t>(image.channels);
  std::vector<double> sum(channels);
  for (std::size_t pixel = 0; pixel < result.pixels(); ++pixel) {
    const auto width = static_cast<std::size_t>(result.width);
    std::fill(sum.begin(), sum.end(), 0.0);
    double weights = 0;
    for (int s = 0; s < side * side; ++s) {
      const int column = s % side, row = s / side;
      const double dx = (column + 0.5) / side - 0.5, dy = (row + 0.5) / side - 0.5;
      const auto x = pixel % width, y = pixel / width;
      const Point2d point =
          pixel_point(to, result.width, height, static_cast<double>(x) + dx, static_cast<double>(y) + dy);
      const double weight = density(to, point) + 1e-12;  // on a pole
      const Neighbours near = neighbours(image, from, point_of(from, direction_of(to, point)));
      weights += weight;
      for (std::size_t c = 0; c < channels; ++c) sum[c] += weight * value_at(image, near, c);
    }
    for (std::size_t c = 0; c < channels; ++c)
      result.values[pixel * channels + c] = static_cast<float>(sum[c] / weights);
  }
  return result;
}

namespace {

// The mean of f(luminance, direction) over the sphere.
template <class F>
double mean_over_sphere(const Image& image, EnvironmentProjection projection, F&& f) {
  constexpr int side = 4;  // samples across a pixel
  double sum = 0, weights = 0;
  for (int y = 0; y < side * image.height; ++y)
    for (int x = 0; x < side * image.width; ++x) {
      const Point2d point{(x + 0.5) / (side * image.width), (y + 0.5) / (side * image.height)};
      const Neighbours near = neighbours(image, projection, point);
      const auto channel = [&](std::size_t c) { return value_at(image, near, image.channels < 3 ? 0 : c); };
      const double weight = density(projection, point);
      weights += weight;
      sum += weight * f(srgb_to_xyz({channel(0), channel(1), channel(2)}).y, direction_of(projection, point));
    }
  return weights > 0 ? sum / weights : 0;
}

}  // namespace

double upward_illuminance(const Image& image, EnvironmentProjection projection) {
  return 4 * pi * mean_over_sphere(image, projection, [](double luminance, Vector3d d) {
           return luminance * std::max(0.0, d.z);
         });
}

double total_flux(const Image& image, EnvironmentProjection projection) {
  return 4 * pi * mean_over_sphere(image, projection, [](double luminance, Vector3d) { return luminance; });
}

}  // namespace vitrail
