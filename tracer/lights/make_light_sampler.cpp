// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <cmath>

#include "scene/geometry/portable_math.h"
#include "tracer/lights/baked_light_image.h"
#include "tracer/lights/light_sampler.h"
#include "tracer/lights/surface_lights.h"
#include "tracer/textures/tile_cache.h"

namespace vitrail {

namespace {

std::vector<LightSampler::Run> runs_of(const LightScene& scene) {
  std::vector<LightSampler::Run> runs;
  std::uint32_t number = 0;
  const auto add = [&](std::uint32_t id) {
    if (!runs.empty() && runs.back().first + runs.back().count == id)
      ++runs.back().count;
    else
      runs.push_back({id, 1, number});
    ++number;
  };
  for (const EmissiveTriangle& t : scene.triangles) add(t.triangle);
  for (const EmissiveQuadric& q : scene.quadrics) add(q.triangle);
  std::sort(runs.begin(), runs.end(), [](const auto& a, const auto& b) { return a.first < b.first; });
  return runs;
}

// Width over height of what an image texture shows; 1 of others.
double aspect_of(const SpectrumParameter& image, const LightScene& scene, const ImageSource& images) {
  const auto* id = std::get_if<Id<Texture>>(&image);
  if (!id || id->value >= scene.texture_records.size()) return 1;
  const auto* file = std::get_if<ImageTexture>(&scene.texture_records[id->value].model);
  if (!file) return 1;
  const auto opened = images(file->filename);
  return static_cast<double>(opened->width(0)) / opened->height(0);
}

// What a point gets of a light depends on its intensity I, whatever its cone: the power that counts for the
// tree is π·I, as that of a small Lambertian surface of this intensity along its normal.
void by_intensity(LightBounds& emitter) { emitter.power *= 0.5 / (1 - portable_cos(emitter.theta_o_rad)); }

// Of a curved surface by its greatest projection, as if it was the cap of a sphere.
void by_projection(LightBounds& surface) {
  const double cosine = portable_cos(surface.theta_o_rad);
  surface.power *= cosine > 0 ? (1 + cosine) / 2 : 0.5 / (1 - cosine);
}

// Sorts the lights by how they are chosen.
struct Sorter {
  LightSampler& s;
  const ImageSource& images;
  double cross_section;  // of the scene
  std::uint32_t light = 0;
  std::vector<double> distant_power{}, environment_power{};

  void operator()(const PointLight& l) { add(make_emitter(l)); }
  void operator()(const SpotLight& l) { add(make_emitter(l, s.scene.textures, s.scene.texture_records)); }
  void operator()(const ProjectionLight& l) {
    add(make_emitter(l, aspect_of(l.image, s.scene, images), s.scene.textures, s.scene.texture_records));
  }
  void operator()(const GoniometricLight& l) { add(make_emitter(l, images(l.filename))); }
  void operator()(const DistantLight& l) {
    add({.direction = unit(l.direction), .light = light, .irradiance = l.irradiance});
  }
  void operator()(const InfiniteLight& l) {
    s.infinite.push_back(light);
    s.constant.push_back(flat_spectrum(l.radiance));
  }
  void operator()(const EnvironmentLight& l) { add(make_environment(l, images(l.filename))); }
  void operator()(const SkyLight& l) {
    if (!s.scene.refracts) return add(make_environment(l));
    const auto sun = std::make_shared<const SkyModel>(l);
    const DirectionFrame frame(l.light_to_world);
    if (sun->has_sun())
      add({.direction = -frame.to_world(sun->to_sun()),
           .light = light,
           .irradiance = spectrum_of_bands(sun->sun_irradiance(sun->to_sun())),
           .sun = sun,
           .frame = frame});
    SkyLight sky = l;
    sky.sun_scale = 0;
    add(make_environment(sky));
  }

 private:
  void add(LightSampler::Distant d) {
    const double power = luminance(d.irradiance) * cross_section;
    if (!(power > 0) || !(length(d.direction) > 0.5)) return;
    s.has_discs = s.has_discs || d.sun;
    s.distant.push_back(std::move(d));
    distant_power.push_back(power);
  }
  void add(Environment e) {
    if (!(e.mean_luminance > 0)) return;
    environment_power.push_back(4 * pi * e.mean_luminance * cross_section);
    e.light = light;
    s.environments.push_back(std::move(e));
  }
  void add(PointEmitter e) {
    bound_fading(e, farthest_from(e.position));
    s.fades = s.fades || e.fading;
    e.light = light;
    e.casts_shadows = s.scene.lights[light].casts_shadows;
    s.emitters.push_back(std::move(e));
  }
  // Of the corners of the scene's bounds; 1 where it has none.
  double farthest_from(Point3d p) const {
    if (s.scene.bounds.empty()) return 1;
    Vector3d most;
    const Point3d lower = cast<double>(s.scene.bounds.lower), upper = cast<double>(s.scene.bounds.upper);
    for (int axis = 0; axis < 3; ++axis)
      most[axis] = std::max(std::abs(lower[axis] - p[axis]), std::abs(upper[axis] - p[axis]));
    return std::max(length(most), 1e-15);
  }
};

void find_variety(std::span<const LightBounds> lights, LightSampler& s) {
  const std::span<const std::uint32_t> chosen = s.tree.order();
  s.one_is_enough =
      !s.distant.empty() || !s.environments.empty() || (chosen.size() == 1 && s.emitters.size() == 1);
  const bool plain = std::ranges::all_of(s.scene.area_lights, [](const AreaLight& light) {
    return !light.sampled || std::holds_alternative<Spectrum>(light.radiance);
  });
  s.tree_chooses = plain && (chosen.size() > 2 || !s.emitters.empty());
  if (s.one_is_enough || s.tree_chooses || !plain) return;
  Bounds3d box;
  for (const std::uint32_t number : chosen) extend(box, lights[number].box);
  s.lamp_center = box.lower + (box.upper - box.lower) * 0.5;
  s.lamp_radius2 = dot(box.upper - s.lamp_center, box.upper - s.lamp_center);
}

// Two triangles side by side in one plane, as rectangles are: what one or the other sends to a point differs
// by less than it is worth to weigh them there.
bool is_one_flat_lamp(std::span<const LightBounds> lights) {
  if (lights.size() != 2) return false;
  const LightBounds &a = lights[0], &b = lights[1];
  constexpr double all_around = 1.5;  // not along the normal alone
  constexpr double unlike = 16;       // an image may leave one of them dark
  if (std::max(a.power, b.power) > unlike * std::min(a.power, b.power)) return false;
  if (a.theta_e_rad < all_around || b.theta_e_rad < all_around || !(dot(a.axis, b.axis) > 1 - 1e-9))
    return false;
  for (int axis = 0; axis < 3; ++axis)
    if (a.box.upper[axis] < b.box.lower[axis] || b.box.upper[axis] < a.box.lower[axis]) return false;
  return std::abs(dot(b.box.lower - a.box.lower, a.axis)) < 1e-6 * length(a.box.upper - a.box.lower);
}

void prepare_quadrics(LightSampler& s) {
  // All together 2¹⁴ of them, of 50 bytes, or 150 where two sides shine.
  const int patches = static_cast<int>((1u << 14) / std::max<std::size_t>(s.scene.quadrics.size(), 1));
  for (const EmissiveQuadric& q : s.scene.quadrics)
    s.quadrics.emplace_back(q, s.scene.area_lights[q.area_light].two_sided, patches);
}

// Of all lights of the tree, by their numbers; with what is known of surfaces beside.
std::vector<LightBounds> bounds_of_tree(LightSampler& s) {
  SurfaceLights shining = surface_lights(s.scene, s.quadrics);
  s.glows = std::move(shining.glows);
  s.parts = std::move(shining.parts);
  s.parts_of = std::move(shining.parts_of);
  std::vector<LightBounds> local = std::move(shining.bounds);
  for (const PointEmitter& e : s.emitters) local.push_back(e.bounds);
  return local;
}

double flux_of(std::span<const LightBounds> lights) {
  double flux = 0;
  for (const LightBounds& b : lights)
    if (std::isfinite(b.power)) flux += b.power;
  return flux;
}

// Flux becomes the power that counts for the tree.
void weigh_for_tree(const LightNumbers& numbers, std::span<LightBounds> lights) {
  for (std::size_t i = 0; i < lights.size(); ++i) {
    const LightKind kind = numbers.light(i).kind;
    if (kind == LightKind::quadric) by_projection(lights[i]);
    if (kind == LightKind::emitter) by_intensity(lights[i]);
  }
}

LightSampler::Slot slot_of(const LightSampler& s, LightRef light) {
  LightSampler::Slot slot;
  slot.light = light;
  if (light.kind == LightKind::triangle) {
    const EmissiveTriangle& t = s.scene.triangles[light.index];
    std::copy(std::begin(t.p), std::end(t.p), slot.p.begin());
    slot.area_light = t.area_light;
    if (!s.scene.opacities.empty()) slot.opacity = s.scene.opacities[light.index];
  } else if (light.kind == LightKind::quadric) {
    const EmissiveQuadric& q = s.scene.quadrics[light.index];
    slot.area_light = q.area_light;
    slot.opacity = q.opacity;
  }
  return slot;
}

// Half of them equal, half by power, of the choices that have any; empty where none has. `flux`: of the tree.
std::vector<double> shares_of(double flux, const Sorter& sorter) {
  std::vector<double> power{flux};
  power.insert(power.end(), sorter.distant_power.begin(), sorter.distant_power.end());
  power.insert(power.end(), sorter.environment_power.begin(), sorter.environment_power.end());
  double total = 0;
  std::size_t choices = 0;
  for (const double p : power) total += p, choices += p > 0;
  std::vector<double> share;
  if (choices == 0) return share;
  for (const double p : power)
    share.push_back(p > 0 ? 0.5 / static_cast<double>(choices) + 0.5 * p / total : 0);
  return share;
}

}  // namespace

LightSampler make_light_sampler(const LightScene& scene, const ImageSource& images, LightChoice choice) {
  constexpr std::size_t few = 1 << 12;
  LightSampler s;
  s.scene = scene;
  const double diagonal = scene.bounds.empty() ? 1 : length(cast<double>(extent(scene.bounds)));
  Sorter sorter{s, images, pi * std::max(diagonal * diagonal / 4, 1e-30)};
  for (; sorter.light < scene.lights.size(); ++sorter.light)
    std::visit(sorter, scene.lights[sorter.light].model);
  s.has_only_glows = !s.has_background() && std::ranges::none_of(scene.area_lights, &AreaLight::sampled);
  prepare_quadrics(s);
  s.numbers = LightNumbers({scene.triangles.size(), s.quadrics.size(), s.emitters.size(), s.distant.size(),
                            s.environments.size(), s.infinite.size()});
  std::vector<LightBounds> local = bounds_of_tree(s);
  const double flux = flux_of(local);
  if (choice == LightChoice::tree) weigh_for_tree(s.numbers, local);
  if (scene.triangles.size() == 2 && is_one_flat_lamp(local)) choice = LightChoice::power;
  s.tree = LightTree(local, choice);
  s.share = shares_of(flux, sorter);
  if (!s.share.empty()) {
    s.three_numbers = s.share[LightNumbers::choice_of_tree] == 1 && local.size() <= few;
    find_variety(local, s);
  }
  local = std::vector<LightBounds>();  // the slots take its room
  s.slots.reserve(s.tree.order().size());
  for (const std::uint32_t number : s.tree.order()) s.slots.push_back(slot_of(s, s.numbers.light(number)));
  if (scene.triangles.size() <= LightSampler::most_faces)
    for (const EmissiveTriangle& t : scene.triangles) s.faces.emplace_back(t.p);
  s.runs = runs_of(scene);
  return s;
}

LightSampler make_light_sampler(const LightScene& scene, const std::filesystem::path& bundle,
                                LightChoice choice) {
  constexpr std::uint64_t default_tile_bytes = 16 << 20;
  std::shared_ptr<TileCache> tiles = scene.textures ? scene.textures->tiles() : nullptr;
  const ImageSource images = [&](const std::string& filename) {
    if (!tiles) tiles = std::make_shared<TileCache>(default_tile_bytes);
    return open_light_image(bundle / filename, tiles);
  };
  return make_light_sampler(scene, images, choice);
}

}  // namespace vitrail
