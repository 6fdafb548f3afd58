// SPDX-License-Identifier: Apache-2.0
#include "importers/reading/lamp_power.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <numbers>
#include <vector>

#include "images/image_files.h"
#include "images/texture_values.h"
#include "scene/shapes/deferred_mesh.h"

namespace vitrail {

namespace {

constexpr double unknown = std::numeric_limits<double>::infinity();
using std::numbers::pi;

double mean_of_image(const ImageTexture& texture) {
  try {
    const Image image = texture_values(texture, read_stored_image(texture.filename), ImageUse::light);
    double sum = 0;
    for (const float v : image.values) sum += v > 0 ? static_cast<double>(v) : 0;
    return sum / static_cast<double>(std::max<std::size_t>(image.values.size(), 1));
  } catch (const Error&) {
    return unknown;  // whoever needs the image will say so
  }
}

// The mean of what a texture shines with under a light of luminance 1.
double mean_of(const Scene& scene, const SpectrumParameter& parameter) {
  if (const auto* spectrum = std::get_if<Spectrum>(&parameter)) return luminance(*spectrum);
  const TextureModel& model = scene.textures.at(std::get<Id<Texture>>(parameter).value).model;
  if (const auto* image = std::get_if<ImageTexture>(&model)) return mean_of_image(*image);
  const auto* product = std::get_if<ProductTexture>(&model);
  if (!product) return unknown;
  const double first = mean_of(scene, product->first);
  return first == 0 ? 0 : first * mean_of(scene, product->second);
}

double area_of(const TriangleMesh& given, const Transform& to_world) {
  if (given.quadric || given.places) return unknown;
  TriangleMesh storage;
  const TriangleMesh& mesh = loaded(given, storage);
  double area = 0;
  for (const auto& t : mesh.triangles) {
    const auto corner = [&](std::size_t k) {
      return transform_point(to_world, cast<double>(mesh.positions[t[k]]));
    };
    area += length(cross(corner(1) - corner(0), corner(2) - corner(0))) / 2;
  }
  return area;
}

// The power of what shines, in units of which a square of radiance 1 and area 1 has π.
class SurfacePower {
 public:
  explicit SurfacePower(const Scene& scene) : scene_(scene) {}

  double brightest = 0;  // mean radiance of a lamp, of both its sides

  double of(const std::vector<Shape>& shapes, const std::vector<Instance>& instances,
            const Transform& to_world) {
    double sum = 0;
    for (const Shape& shape : shapes) {
      if (!shape.area_light || sum == unknown) continue;
      const double radiance = radiance_of(*shape.area_light);
      brightest = std::max(brightest, radiance);
      if (radiance > 0)
        sum += pi * radiance * area_of(scene_.meshes[shape.mesh.value], to_world * shape.object_to_world);
    }
    for (const Instance& instance : instances) {
      const Prototype& prototype = scene_.prototypes[instance.prototype.value];
      sum += of(prototype.shapes, prototype.instances, to_world * instance.prototype_to_world);
    }
    return sum;
  }

 private:
  double radiance_of(Id<AreaLight> id) {
    const auto [known, is_new] = radiance_.try_emplace(id.value, 0);
    if (!is_new) return known->second;
    const AreaLight& light = scene_.area_lights[id.value];
    const bool is_texture = std::holds_alternative<Id<Texture>>(light.radiance);
    const double factor = (is_texture ? static_cast<double>(light.scale) : 1) * (light.two_sided ? 2 : 1);
    return known->second = factor > 0 ? factor * mean_of(scene_, light.radiance) : 0;
  }

  const Scene& scene_;
  std::map<std::uint32_t, double> radiance_;
};

struct LightPower {
  double far = 0, near = 0;  // what a surface shows; power

  void operator()(const PointLight& light) { near += 4 * pi * luminance(light.intensity); }
  void operator()(const SpotLight& light) {
    const double cosine = std::cos(static_cast<double>(light.cutoff_deg) * pi / 180);
    near += 2 * pi * (1 - cosine) * luminance(light.intensity);
  }
  void operator()(const DistantLight& light) { far += luminance(light.irradiance) / pi; }
  void operator()(const InfiniteLight& light) { far += luminance(light.radiance); }
  void operator()(const auto&) { far = unknown; }  // images and skies
};

}  // namespace

double brightness_of_lamps(const Scene& scene, const Bounds3d& bounds) {
  LightPower power;
  for (const Light& light : scene.lights) std::visit(power, static_cast<const LightVariant&>(light.model));
  const double shown = scene.film.imaging_ratio;
  if (shown * power.far == unknown || bounds.empty()) return power.far + power.near > 0 ? unknown : 0;
  const Vector3d size = extent(bounds);
  const double box = 2 * (size.x * size.y + size.y * size.z + size.z * size.x);
  SurfacePower surfaces(scene);
  if (!scene.area_lights.empty()) power.near += surfaces.of(scene.shapes, scene.instances, Transform{});
  constexpr double surely_a_lamp = 10;
  if (shown * surfaces.brightest >= surely_a_lamp) return unknown;
  const double near = power.near > 0 ? power.near / (pi * box) : 0;  // infinite in a box of no size
  return shown * std::max(power.far, near);
}

}  // namespace vitrail
