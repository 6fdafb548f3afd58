// SPDX-License-Identifier: Apache-2.0
#include "importers/mitsuba/write/unseen_lamps.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "importers/mitsuba/write/rgb_variants.h"
#include "importers/mitsuba/write/write_textures.h"
#include "scene/geometry/pi.h"
#include "scene/shapes/deferred_mesh.h"

namespace vitrail::mitsuba_writer {

namespace {

// The i-th number of the k-th component of a sequence of low discrepancy in four dimensions: multiples of the
// inverse powers of the root of x⁵ = x + 1.
double spread(std::size_t i, std::size_t k) {
  constexpr std::array steps{0.8566748838545029, 0.733891856627126, 0.6287067210378087, 0.5385972572236101};
  const double x = (static_cast<double>(i) + 1) * steps.at(k);
  return x - std::floor(x);
}

// A place on the lamp, and which way it shines there.
struct Place {
  Point3d p;
  Vector3d normal;
  double share = 0;  // of the area
};

// An area in world space.
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
  Place at(std::size_t i) const {
    const auto found = std::ranges::upper_bound(area_up_to, spread(i, 0) * area()) - area_up_to.begin();
    const auto& p = triangles[std::min(static_cast<std::size_t>(found), triangles.size() - 1)];
    double u = spread(i, 1), v = spread(i, 2);
    if (u + v > 1) u = 1 - u, v = 1 - v;
    const Vector3d e1 = p[1] - p[0], e2 = p[2] - p[0];
    return {p[0] + e1 * u + e2 * v, normalize(cross(e1, e2))};
  }
};

// As far from each other as they can be, in place and normal, each with the area that is nearest to it.
std::vector<Place> places_on(const Surface& surface, std::size_t count) {
  constexpr std::size_t tries = 16;
  std::vector<Place> all;
  for (std::size_t i = 0; i < tries * count; ++i) all.push_back(surface.at(i));
  const double turn = surface.area() / (4 * pi);  // of a ball its radius, squared
  std::vector<double> nearest(all.size(), HUGE_VAL);
  std::vector<std::size_t> owner(all.size());
  std::vector<Place> chosen;
  for (std::size_t next = 0; chosen.size() < count;) {
    const Place place = all[next];
    for (std::size_t i = 0; i < all.size(); ++i) {
      const Vector3d way = all[i].p - place.p, turned = all[i].normal - place.normal;
      const double off = dot(way, way) + turn * dot(turned, turned);
      if (off < nearest[i]) nearest[i] = off, owner[i] = chosen.size();
    }
    chosen.push_back(place);
    next = static_cast<std::size_t>(std::ranges::max_element(nearest) - nearest.begin());
  }
  for (const std::size_t i : owner) chosen[i].share += 1 / static_cast<double>(all.size());
  return chosen;
}

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

std::size_t count_unseen_lamps(const Scene& scene) {
  std::vector<std::size_t> instances(scene.prototypes.size());
  for (const Instance& instance : scene.instances) ++instances[instance.prototype.value];
  auto count = static_cast<std::size_t>(std::ranges::count_if(scene.shapes, is_unseen_lamp));
  for (std::size_t i = 0; i < instances.size(); ++i)
    count += instances[i] *
             static_cast<std::size_t>(std::ranges::count_if(scene.prototypes[i].shapes, is_unseen_lamp));
  return count;
}

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
  const std::size_t count = std::clamp(of_all / std::max(context.unseen_lamps, std::size_t{1}), least, most);
  std::vector<std::pair<Place, Fall>> spots;
  double flux = 0;
  for (Place place : places_on(surface, count)) {
    const bool outwards = dot(place.normal, place.p - middle) > 0;
    if (is_ball && light.two_sided ? !outwards : shape.flip_orientation) place.normal = -place.normal;
    for (const Fall& fall : falls_of_cosine(spread(spots.size(), 3))) {
      flux += place.share * fall.flux();
      spots.emplace_back(place, fall);
      if (light.two_sided && !is_ball) spots.emplace_back(Place{place.p, -place.normal, place.share}, fall);
    }
  }
  const double scale = static_cast<double>(light.scale) * surface.area() * (pi / flux);
  for (const auto& [place, fall] : spots)
    add_spot(root, place, fall, scaled(radiance, scale * place.share * fall.weight),
             1 / static_cast<double>(spots.size()));
  context.approximated(
      fmt::format("a light that nothing meets becomes {} spot lights on its surface: in all as bright, "
                  "within a few per cent "
                  "near it and in its shadows' edges",
                  spots.size()));
}

}  // namespace vitrail::mitsuba_writer
