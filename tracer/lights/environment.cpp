// SPDX-License-Identifier: Apache-2.0
#include "tracer/lights/environment.h"

#include <algorithm>
#include <cmath>
#include <cstdint>

#include "scene/geometry/portable_math.h"
#include "tracer/lights/environment_lanes.h"
#include "tracer/sampling/luminance_of.h"
#include "tracer/sampling/wavelengths.h"

namespace vitrail {

namespace {

using enum EnvironmentLight::Projection;

constexpr int max_table_width = 1024, max_table_height = 512;
constexpr int min_table_width = 64, min_table_height = 32;  // of images that are interpolated
// Of the mean density, in every cell: it is an estimate that decides where to look, not what is there.
constexpr double density_floor = 0.01;

}  // namespace

DirectionFrame::DirectionFrame(const Transform& light_to_world) {
  const auto column = [&](Vector3d axis) { return normalize(transform_vector(light_to_world, axis)); };
  const Vector3d cz = column({0, 0, 1}), cy = column({0, 1, 0}), cx = column({1, 0, 0});
  const Vector3d flat = normalize(cx - cz * dot(cx, cz));
  const Vector3d last = cross(cz, flat);
  if (!(std::abs(dot(last, last) - 1) < 1e-6)) return;
  z = cz;
  x = flat;
  y = dot(last, cy) < 0 ? -last : last;
}

SampledSpectrum look_up(const LightImage& image, SphereProjection projection, Point2d at,
                        const SampledWavelengths& wavelengths) {
  const auto place = lanes::detail::place_in_image<double>({at.x, at.y}, image.width(0), image.height(0));
  return projection == equal_area ? image.texel(place.x, place.y, wavelengths)
                                  : image.bilinear(place.s, place.t, wavelengths);
}

namespace {

// Luminances of one level, y down from the top, looked up as the image is.
class LuminanceGrid {
 public:
  LuminanceGrid(const LightImage& image, SphereProjection projection, int level)
      : projection_(projection), width_(image.width(level)), height_(image.height(level)) {
    for (int y = 0; y < height_; ++y)
      for (int x = 0; x < width_; ++x) {
        const double l = image.luminance(x, height_ - 1 - y, level);
        values_.push_back(l > 0 && std::isfinite(l) ? l : 0);
      }
  }

  int width() const { return width_; }
  int height() const { return height_; }

  double at(Point2d point) const {
    if (projection_ == equal_area)
      return value(std::clamp(static_cast<int>(point.x * width_), 0, width_ - 1),
                   std::clamp(static_cast<int>(point.y * height_), 0, height_ - 1));
    const double x = point.x * width_ - 0.5, y = point.y * (height_ - 1);
    const double left = std::floor(x), top = std::floor(y), fx = x - left, fy = y - top;
    const int x0 = (static_cast<int>(left) + width_) % width_, x1 = (x0 + 1) % width_;
    const int y0 = std::clamp(static_cast<int>(top), 0, height_ - 1), y1 = std::min(y0 + 1, height_ - 1);
    return (value(x0, y0) * (1 - fx) + value(x1, y0) * fx) * (1 - fy) +
           (value(x0, y1) * (1 - fx) + value(x1, y1) * fx) * fy;
  }

 private:
  double value(int x, int y) const {
    return values_[static_cast<std::size_t>(y) * static_cast<std::size_t>(width_) +
                   static_cast<std::size_t>(x)];
  }
  SphereProjection projection_;
  int width_, height_;
  std::vector<double> values_;
};

}  // namespace

ImageTable tabulate_image(const LightImage& image, SphereProjection projection, bool beside_bsdf) {
  int level = 0;
  while (level + 1 < image.levels() &&
         (image.width(level) > max_table_width || image.height(level) > max_table_height))
    ++level;
  const LuminanceGrid grid(image, projection, level);
  const bool interpolated = projection == latitude_longitude;
  const int width = std::clamp(grid.width(), interpolated ? min_table_width : 1, max_table_width);
  const int height = std::clamp(grid.height(), interpolated ? min_table_height : 1, max_table_height);

  ImageTable result;
  const DirectionTable cells(projection, width, height, [](int, int) { return 1.0; });
  std::vector<double> density;
  for (int y = 0; y < height; ++y)
    for (int x = 0; x < width; ++x) {
      double sum = 0;  // over 2 × 2 points
      for (int i = 0; i < 4; ++i)
        sum += grid.at({(x + 0.25 + 0.5 * (i & 1)) / width, (y + 0.25 + 0.5 * (i >> 1)) / height});
      density.push_back(sum / 4);
      result.flux += density.back() * cells.cell_solid_angle(y);
    }
  const double floor = density_floor * result.flux / (4 * pi);
  const double left_out = beside_bsdf ? result.flux / (4 * pi) : 0;
  result.table = DirectionTable(projection, width, height, [&](int x, int y) {
    const double d =
        density[static_cast<std::size_t>(y) * static_cast<std::size_t>(width) + static_cast<std::size_t>(x)];
    return floor + std::max(0.0, d - left_out);
  });
  return result;
}

namespace {

// Of texels that are looked up one by one: ∫ dω, of max(0,z) where `upward`, of texel (x,y) from the top.
double weight_of_texel(int x, int y, int width, int height, bool upward) {
  const double solid_angle = 4 * pi / width / height;
  if (!upward) return solid_angle;
  const int side = std::max(1, 256 / std::min(width, height));
  double sum = 0;
  for (int i = 0; i < side * side; ++i)
    sum += std::max(0.0, sphere_direction(equal_area, {(x + (i % side + 0.5) / side) / width,
                                                       (y + (i / side + 0.5) / side) / height})
                             .z);
  return solid_angle * sum / (side * side);
}

// Of texels of row y that are interpolated: the first and the last row lie on the poles.
double weight_in_row(int y, int width, int height, bool upward) {
  if (height == 1) return (upward ? pi : 4 * pi) / width;
  const int steps = std::max(16, 2048 / height);
  const double height_rad = pi / (height - 1);
  double sum = 0;
  for (int i = -steps; i < steps; ++i) {
    const double off = (i + 0.5) / steps, polar = (y + off) * height_rad;
    if (polar > 0 && polar < pi)
      sum += (1 - std::abs(off)) * portable_sin(polar) * (upward ? std::max(0.0, portable_cos(polar)) : 1);
  }
  return 2 * pi / width * sum * height_rad / steps;
}

}  // namespace

double flux_of(const LightImage& image, SphereProjection projection, bool upward) {
  constexpr std::int64_t most_texels = 1 << 22;  // of coarser levels each is a mean
  int level = 0;
  while (level + 1 < image.levels() && std::int64_t{image.width(level)} * image.height(level) > most_texels)
    ++level;
  const int width = image.width(level), height = image.height(level);
  double sum = 0;
  for (int y = 0; y < height; ++y) {
    const double of_row = projection == equal_area ? 0 : weight_in_row(y, width, height, upward);
    for (int x = 0; x < width; ++x) {
      const double luminance = image.luminance(x, height - 1 - y, level);
      if (luminance > 0 && std::isfinite(luminance))
        sum += luminance * (projection == equal_area ? weight_of_texel(x, y, width, height, upward) : of_row);
    }
  }
  return sum;
}

Environment make_environment(const EnvironmentLight& light, std::shared_ptr<const LightImage> image) {
  Environment e;
  e.image = std::move(image);
  e.projection = light.projection;
  e.frame = DirectionFrame(light.light_to_world);
  ImageTable sampled = tabulate_image(*e.image, e.projection, true);
  e.table = std::move(sampled.table);
  e.scale = light.scale;
  if (light.illuminance) {
    const double up = flux_of(*e.image, e.projection, true);
    if (up > 0) e.factor = static_cast<float>(static_cast<double>(*light.illuminance) / up);
  }
  e.mean_luminance = sampled.flux / (4 * pi) * luminance(e.scale) * static_cast<double>(e.factor);
  return e;
}

Vector3d sample_sun(const SkyModel& sky, double u, double v) {
  return lanes::lane(lanes::sample_sun(sky, u, v), 0);
}

namespace {

double luminance_of_sky(const SkyModel& sky, Vector3d d) {
  return luminance_of([&](const SampledWavelengths& w) { return sky.sky(d, w); }, 2);
}

}  // namespace

Environment make_environment(const SkyLight& light, bool sun) {
  constexpr int width = 128, height = 128;  // rows of equal angle: the upper half is 64 of them
  Environment e;
  e.projection = latitude_longitude;
  e.frame = DirectionFrame(light.light_to_world);
  const SkyModel model(light);
  e.sky = std::make_shared<const SkyModel>(sun ? model : model.without_sun());
  const int rows = model.has_ground() ? height : height / 2;
  double sky_flux = 0;  // ∫ Y dω
  std::vector<double> density(static_cast<std::size_t>(width * height));
  const DirectionTable cells(latitude_longitude, width, height, [](int, int) { return 1.0; });
  for (int y = 0; y < rows; ++y)
    for (int x = 0; x < width; ++x) {
      const Point2d at{(x + 0.5) / width, (y + 0.5) / height};
      const double value = luminance_of_sky(*e.sky, sphere_direction(latitude_longitude, at));
      density[static_cast<std::size_t>(y * width + x)] = value;
      sky_flux += value * cells.cell_solid_angle(y);
    }
  const double floor = density_floor * sky_flux / (2 * pi);
  e.table = DirectionTable(latitude_longitude, width, height, [&](int x, int y) {
    return y < rows ? density[static_cast<std::size_t>(y * width + x)] + floor : 0.0;
  });
  const double sun_flux = luminance(spectrum_of_bands(e.sky->sun_irradiance(e.sky->to_sun())));
  e.sun_luminance = e.sky->has_sun() ? luminance(spectrum_of_bands(e.sky->sun(e.sky->to_sun()))) : 0;
  // Equal where both shine: the sun brings most wherever it is not hidden.
  e.sun_share = sun_flux > 0 ? (sky_flux > 0 ? 0.5 : 1) : 0;
  e.mean_luminance = (sky_flux + sun_flux) / (4 * pi);
  return e;
}

SampledSpectrum radiance_of_image(const Environment& e, Point2d at, const SampledWavelengths& wavelengths) {
  return look_up(*e.image, e.projection, at, wavelengths) * scale_of(e, wavelengths) * e.factor;
}

SampledSpectrum scale_of(const Environment& e, const SampledWavelengths& wavelengths) {
  return evaluate(e.scale, wavelengths);
}

const float* constant_scale_of(const Environment& e) {
  const auto* const constant = std::get_if<ConstantSpectrum>(&e.scale);
  return constant ? &constant->value : nullptr;
}

const BakedImage* baked_image_of(const Environment& e) { return e.image->baked(); }

EnvironmentValue value_towards(const Environment& e, Vector3d direction,
                               const SampledWavelengths& wavelengths) {
  const lanes::Seen<double> seen =
      lanes::value_towards<double>(e, {direction.x, direction.y, direction.z}, true,
                                   [&](int) -> const SampledWavelengths& { return wavelengths; });
  return {lanes::lane(seen.radiance, 0), seen.pdf};
}

Vector3d sample_direction(const Environment& e, double u, double v) {
  return lanes::lane(lanes::sample_direction(e, u, v), 0);
}

}  // namespace vitrail
