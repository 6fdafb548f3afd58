// SPDX-License-Identifier: Apache-2.0
#include "tracer/lights/surface_lights.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "scene/geometry/portable_math.h"
#include "tracer/quadrics/quadric_area.h"
#include "tracer/textures/texture_ranges.h"

namespace vitrail {

namespace {

// Calls f(region) for the parts of a triangle, `side`² alike ones.
template <class F>
void for_parts(const LightScene& scene, std::size_t triangle, int side, F&& f) {
  const EmissiveTriangle& t = scene.triangles[triangle];
  const auto part = [&](const std::array<std::array<int, 2>, 3>& corners) {
    double middle1 = 0, middle2 = 0;
    TextureRegion region;
    for (const auto& [i, j] : corners) {
      const double b1 = static_cast<double>(i) / side, b2 = static_cast<double>(j) / side, b0 = 1 - b1 - b2;
      const auto mix = [&](float x0, float x1, float x2) {
        return static_cast<double>(x0) * b0 + static_cast<double>(x1) * b1 + static_cast<double>(x2) * b2;
      };
      region.extend({mix(t.uv[0].x, t.uv[1].x, t.uv[2].x), mix(t.uv[0].y, t.uv[1].y, t.uv[2].y)},
                    {mix(t.p[0].x, t.p[1].x, t.p[2].x), mix(t.p[0].y, t.p[1].y, t.p[2].y),
                     mix(t.p[0].z, t.p[1].z, t.p[2].z)});
      middle1 += b1 / 3;
      middle2 += b2 / 3;
    }
    const EmissivePoint middle(scene, triangle, middle1, middle2);
    region.middle = middle.point();
    f(region);
  };
  for (int i = 0; i < side; ++i)
    for (int j = 0; i + j < side; ++j) {
      part({{{i, j}, {i + 1, j}, {i, j + 1}}});
      if (i + j + 1 < side) part({{{i + 1, j}, {i + 1, j + 1}, {i, j + 1}}});
    }
}

// Of a quadric, by its area. Between the points that are asked it bends by less than the margin.
template <class F>
void for_parts(const QuadricLight& quadric, F&& f) {
  constexpr int side = 8;
  constexpr double edge = 1e-9, margin = 0.1;
  for (int i = 0; i < side * side; ++i) {
    TextureRegion region;
    for (int k = 0; k < 9; ++k) {
      const double s = std::clamp((i % side + k % 3 * 0.5) / side, edge, 1 - edge),
                   t = std::clamp((i / side + k / 3 * 0.5) / side, edge, 1 - edge);
      const TexturePoint at = quadric.texture_point(point_by_area(quadric.record().quadric.quadric, s, t));
      region.extend(at.uv, at.p);
      if (k == 4) region.middle = at;
    }
    const Vector3d beyond = extent(region.p) * margin;
    const double wider = std::max({beyond.x, beyond.y, beyond.z});
    region.p.lower = region.p.lower - Vector3d{wider, wider, wider};
    region.p.upper = region.p.upper + Vector3d{wider, wider, wider};
    f(region);
  }
}

class Tally {
 public:
  explicit Tally(const LightScene& scene)
      : scene_(scene), ranges_(scene.textures, scene.texture_records), sums_(scene.area_lights.size()) {
    for (std::size_t i = 0; i < sums_.size(); ++i)
      if (const auto* spectrum = std::get_if<Spectrum>(&scene.area_lights[i].radiance))
        sums_[i].luminance = luminance(*spectrum);
    all_.bounds.reserve(scene.triangles.size() + scene.quadrics.size());
  }

  // `parts` calls a function for the regions of the surface.
  template <class Parts>
  void add(LightBounds b, double area, std::uint32_t area_light, const FloatParameter& opacity,
           const Parts& parts) {
    const AreaLight& light = scene_.area_lights[area_light];
    Sum& sum = sums_[area_light];
    const bool varies = !sum.luminance || std::holds_alternative<Id<Texture>>(opacity);
    const Glow glow = varies ? varying(light, opacity, parts) : whole(*sum.luminance, opacity);
    const double scale = static_cast<double>(light.scale), sides = light.two_sided ? 2 : 1;
    const auto sane = [](double x) { return x > 0 && std::isfinite(x) ? x : 0.0; };
    b.theta_e_rad = pi / 2;
    b.two_sided = light.two_sided;
    b.power = sane(area * pi * glow.mean * scale * sides);
    const double most = sane(glow.most * scale);
    sum.area += area;
    sum.radiance += sane(area * glow.mean * scale);
    sum.power += b.power;
    sum.most = std::max(sum.most, most);
    last_varies_ = varies;
    if (varies && most > 0) varying_.push_back({all_.bounds.size(), area, most, area_light});
    all_.bounds.push_back(b);
  }
  // Of the triangle that was added last.
  void part() {
    const bool parted = last_varies_ && shines_.size() > 1;
    std::optional<TriangleParts> parts = parted ? TriangleParts::of(shines_) : std::nullopt;
    if (!parts && all_.parts.empty()) return;
    all_.parts_of.resize(all_.bounds.size(), LightSampler::whole);
    if (!parts) return;
    all_.parts_of.back() = static_cast<std::uint32_t>(all_.parts.size());
    all_.parts.push_back(*std::move(parts));
  }

  SurfaceLights finish() {
    for (const Sum& sum : sums_)
      all_.glows.push_back({sum.radiance > 0 ? sum.radiance / sum.area : sum.most, sum.most});
    for (const Varying& surface : varying_) {
      double& power = all_.bounds[surface.light].power;
      power = std::max(power, least_power(surface));
    }
    return std::move(all_);
  }

 private:
  struct Sum {
    double area = 0, radiance = 0, power = 0, most = 0;  // radiance: times area
    std::optional<double> luminance;                     // where it is the same everywhere
  };
  // A light that shines, by a texture.
  struct Varying {
    std::size_t light = 0;  // of all_.bounds
    double area = 0, most = 0;
    std::uint32_t area_light = 0;
  };

  // A light that nothing meets shines as if it was whole.
  static Glow whole(double luminance, const FloatParameter& opacity) {
    const auto share = static_cast<double>(std::get<float>(opacity));
    return {is_invisible(opacity) ? luminance : luminance * std::clamp(share, 0.0, 1.0), luminance};
  }
  template <class Parts>
  Glow varying(const AreaLight& light, const FloatParameter& opacity, const Parts& parts) {
    Glow glow;
    shines_.clear();
    parts([&](const TextureRegion& region) {
      const ValueRange radiance = ranges_.luminances(light.radiance, region),
                       share = is_invisible(opacity) ? ValueRange{1, 1, 1} : ranges_.numbers(opacity, region);
      TriangleParts::Shine& shine = shines_.emplace_back();
      if (!(radiance.most > 0) || !(share.most > 0)) return;
      shine = {radiance.mean * std::clamp(share.mean, 0.0, 1.0), radiance.most};
      glow.mean += shine.mean;
      glow.most = std::max(glow.most, shine.most);
    });
    return {glow.mean / static_cast<double>(shines_.size()), glow.most};
  }
  double least_power(const Varying& surface) const {
    constexpr double of_mean = 0.1, of_most = 1e-3;
    const Sum& sum = sums_[surface.area_light];
    return surface.area * (sum.power > 0 ? of_mean * sum.power / sum.area : of_most * pi * surface.most);
  }

  const LightScene& scene_;
  TextureRanges ranges_;
  std::vector<Sum> sums_;  // of the area lights
  std::vector<Varying> varying_;
  bool last_varies_ = false;                  // the light that was added last
  std::vector<TriangleParts::Shine> shines_;  // of the parts of the last surface
  SurfaceLights all_;
};

}  // namespace

SurfaceLights surface_lights(const LightScene& scene, std::span<const QuadricLight> quadrics) {
  Tally tally(scene);
  // 2¹⁶ parts of all together, or one of each triangle.
  constexpr int most_side = 64;
  int side = most_side;
  while (side > 1 && scene.triangles.size() * static_cast<std::size_t>(side * side) > (1u << 16)) side /= 2;
  for (std::size_t i = 0; i < scene.triangles.size(); ++i) {
    const EmissiveTriangle& t = scene.triangles[i];
    LightBounds b;
    for (const Point3f& p : t.p) extend(b.box, cast<double>(p));
    const Point3d p0 = cast<double>(t.p[0]);
    const Vector3d across = cross(cast<double>(t.p[1]) - p0, cast<double>(t.p[2]) - p0);
    const double area = length(across) / 2;
    if (area > 0) b.axis = across * (0.5 / area);
    tally.add(b, area, t.area_light, scene.opacities.empty() ? FloatParameter{1.0f} : scene.opacities[i],
              [&](const auto& f) { for_parts(scene, i, side, f); });
    tally.part();
  }
  for (const QuadricLight& q : quadrics) {
    const EmissiveQuadric& record = q.record();
    const bool shines = !scene.area_lights[record.area_light].directional;
    tally.add(q.bounds(), shines ? q.area() : 0, record.area_light, record.opacity,
              [&](const auto& f) { for_parts(q, f); });
  }
  return tally.finish();
}

}  // namespace vitrail
