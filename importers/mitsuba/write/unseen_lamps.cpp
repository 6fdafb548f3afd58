// SPDX-License-Identifier: Apache-2.0
#include "importers/mitsuba/write/unseen_lamps.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "importers/mitsuba/write/rgb_variants.h"
#include "importers/mitsuba/write/write_textures.h"
#include "scene/shapes/deferred_mesh.h"

namespace vitrail::mitsuba_writer {

namespace {

using std::numbers::pi;

double fraction(double x) { return x - std::floor(x); }

// A place on the lamp, and which way it shines there.
struct Place {
  Point3d p;
  Vector3d normal;
};

// Lamps of the written scene that no ray meets, with those of instances.
std::size_t unseen_lamps(const Scene& scene) {
  std::vector<std::size_t> instances(scene.prototypes.size());
  for (const Instance& instance : scene.instances) ++instances[instance.prototype.value];
  auto count = static_cast<std::size_t>(std::ranges::count_if(scene.shapes, is_unseen_lamp));
  for (std::size_t i = 0; i < instances.size(); ++i)
    count += instances[i] *
             static_cast<std::size_t>(std::ranges::count_if(scene.prototypes[i].shapes, is_unseen_lamp));
  return count;
}

// Spread evenly over an area, in world space: by a sequence of low discrepancy within each triangle.
struct Surface {
  std::vector<std::array<Point3d, 3>> triangles;
  std::vector<double> area_up_to;

  Surface(const TriangleMesh& mesh, const Transform& to_world) {
    double sum = 0;
    for (const auto& t : mesh.triangles) {
      std::array<Point3d, 3> p;
      for (std::size_t k = 0; k < 3; ++k)
        p[k] = transform_point(to_world, cast<double>(mesh.positions[t[k]]));
      triangles.push_back(p);
      area_up_to.push_back(sum += length(cross(p[1] - p[0], p[2] - p[0])) / 2);
    }
  }
  double area() const { return area_up_to.empty() ? 0 : area_up_to.back(); }
  Place at(std::size_t i, std::size_t count) const {
    const double wanted = (static_cast<double>(i) + 0.5) / static_cast<double>(count) * area();
    const auto found = std::ranges::upper_bound(area_up_to, wanted) - area_up_to.begin();
    const auto& p = triangles[std::min(static_cast<std::size_t>(found), triangles.size() - 1)];
    const double n = static_cast<double>(i) + 1;
    double u = fraction(n * 0.7548776662466927), v = fraction(n * 0.5698402909980532);
    if (u + v > 1) u = 1 - u, v = 1 - v;
    const Vector3d e1 = p[1] - p[0], e2 = p[2] - p[0];
    return {p[0] + e1 * u + e2 * v, normalize(cross(e1, e2))};
  }
};

// Falls of a spot's intensity from 1 at `beam` to 0 at `cutoff`, linear in the angle, times `weight`.
struct Fall {
  double beam, cutoff, weight;
  double flux() const {  // ∫ dω
    return weight * 2 * pi * (1 - (std::sin(cutoff) - std::sin(beam)) / (cutoff - beam));
  }
};

// They add up to the cosine, but for what it is above its chords. `offset` from 0 to 1 moves the corners.
std::vector<Fall> falls_of_cosine(double offset) {
  constexpr int steps = 4;
  constexpr double step = pi / 2 / steps, least = 0.01;
  std::vector<double> corners{0};
  for (int i = 0; i < steps; ++i)
    if (const double corner = (i + offset) * step; corner > least) corners.push_back(corner);
  corners.push_back(pi / 2);
  std::vector<Fall> falls;
  for (std::size_t i = 0; i + 1 < corners.size(); ++i)
    falls.push_back({corners[i], corners[i + 1], std::cos(corners[i]) - std::cos(corners[i + 1])});
  return falls;
}

void add_spot(Element root, const Place& place, const Fall& fall, const Spectrum& intensity, double share) {
  Element spot = add(root, "emitter", "spot");
  const Vector3d up = std::abs(place.normal.z) < 0.9 ? Vector3d{0, 0, 1} : Vector3d{1, 0, 0};
  Element transform = spot.append_child("transform");
  transform.append_attribute("name") = "to_world";
  Element looks = transform.append_child("lookat");
  const auto add_vector = [&](const char* name, double x, double y, double z) {
    looks.append_attribute(name) = fmt::format("{:.9g},{:.9g},{:.9g}", x, y, z).c_str();
  };
  const Point3d target = place.p + place.normal;
  add_vector("origin", place.p.x, place.p.y, place.p.z);
  add_vector("target", target.x, target.y, target.z);
  add_vector("up", up.x, up.y, up.z);
  add_spectrum(spot, "intensity", intensity, Meaning::emission);
  add_float(spot, "cutoff_angle", static_cast<float>(fall.cutoff * 180 / pi));
  add_float(spot, "beam_width", static_cast<float>(fall.beam * 180 / pi));
  add_float(spot, "sampling_weight", static_cast<float>(share));
}

}  // namespace

bool is_unseen_lamp(const Shape& shape) { return shape.area_light && shape.opacity == FloatParameter{0.0f}; }

void write_unseen_lamp(Context& context, Element root, const Shape& shape) {
  constexpr std::size_t most = 128, least = 16, of_all = 1024;
  const AreaLight light = context.exposed.area_lights[shape.area_light->value];
  context.begin(RecordKind::area_light, light.origin);
  const Spectrum radiance = constant_of(context, light.radiance, "a light that nothing meets");
  report_rgb_variants(context, radiance);
  TriangleMesh storage;
  const TriangleMesh& mesh = loaded(context.scene.meshes[shape.mesh.value], storage);
  const Surface surface(mesh, shape.object_to_world);
  if (!(surface.area() > 0)) return;
  // Of a ball that shines to both sides, pbrt has what lies towards the point that is lit.
  const auto& quadric = context.scene.meshes[shape.mesh.value].quadric;
  const bool is_ball = quadric && quadric->kind == QuadricKind::sphere;
  const Point3d middle = transform_point(shape.object_to_world, {0, 0, 0});
  const std::size_t count =
      std::clamp(of_all / std::max(unseen_lamps(context.scene), std::size_t{1}), least, most);
  std::vector<std::pair<Place, Fall>> spots;
  double flux = 0;
  for (std::size_t i = 0; i < count; ++i) {
    Place place = surface.at(i, count);
    const bool outwards = dot(place.normal, place.p - middle) > 0;
    if (is_ball && light.two_sided ? !outwards : shape.flip_orientation) place.normal = -place.normal;
    for (const Fall& fall : falls_of_cosine(fraction((static_cast<double>(i) + 1) * 0.6180339887498949))) {
      flux += fall.flux() / static_cast<double>(count);
      spots.emplace_back(place, fall);
      if (light.two_sided && !is_ball) spots.emplace_back(Place{place.p, -place.normal}, fall);
    }
  }
  const double scale =
      static_cast<double>(light.scale) * surface.area() / static_cast<double>(count) * (pi / flux);
  for (const auto& [place, fall] : spots)
    add_spot(root, place, fall, scaled(radiance, scale * fall.weight), 1 / static_cast<double>(spots.size()));
  context.approximated(
      fmt::format("a light that nothing meets becomes {} spot lights on its surface: in all as bright, "
                  "within a few per cent "
                  "near it and in its shadows' edges",
                  spots.size()));
}

}  // namespace vitrail::mitsuba_writer
