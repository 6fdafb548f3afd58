// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <cmath>

#include "scene/geometry/portable_math.h"
#include "scene/spectra/rgb_bands.h"
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

bool is_point_like(const Light& light) {
  return std::holds_alternative<PointLight>(light.model) || std::holds_alternative<SpotLight>(light.model) ||
         std::holds_alternative<ProjectionLight>(light.model) ||
         std::holds_alternative<GoniometricLight>(light.model);
}

// The mean of the three numbers of a colour in bands.
double mean_of_bands(const Spectrum& spectrum) {
  double sum = 0;
  for (const int lambda_nm : {blue_ends_nm - 20, green_begins_nm + 60, red_begins_nm + 20})
    sum += evaluate(spectrum, lambda_nm);
  return sum / 3;
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
    add(make_environment(l, false));
  }

 private:
  void add(LightSampler::Distant d) {
    const double power =
        (s.scene.bands ? mean_of_bands(d.irradiance) : luminance(d.irradiance)) * cross_section;
    if (!(power > 0) || !(length(d.direction) > 0.5)) return;
    if (d.sun) s.suns.push_back(static_cast<std::uint32_t>(s.distant.size()));
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
    s.fades = s.fades || e.fading;
    if (s.scene.bands && e.flux > 0) e.flux *= mean_of_bands(*e.intensity) / luminance(*e.intensity);
    e.light = light;
    e.casts_shadows = s.scene.lights[light].casts_shadows;
    s.emitters.push_back(std::move(e));
  }
};

void find_variety(const LightTree::BoundsOf& bounds, LightSampler& s) {
  const std::span<const std::uint32_t> chosen = s.tree.order();
  s.one_is_enough =
      !s.distant.empty() || !s.environments.empty() || (chosen.size() == 1 && s.emitters.size() == 1);
  const bool plain = std::ranges::all_of(s.scene.area_lights, [](const AreaLight& light) {
    return !light.sampled || std::holds_alternative<Spectrum>(light.radiance);
  });
  s.tree_chooses = plain && (chosen.size() > 2 || !s.emitters.empty());
  if (s.one_is_enough || s.tree_chooses || !plain) return;
  Bounds3d box;
  for (const std::uint32_t number : chosen) extend(box, bounds(number).box);
  s.lamp_center = box.lower + (box.upper - box.lower) * 0.5;
  s.lamp_radius2 = dot(box.upper - s.lamp_center, box.upper - s.lamp_center);
}

// Two triangles side by side in one plane, as rectangles are: what one or the other sends to a point differs
// by less than it is worth to weigh them there.
bool is_one_flat_lamp(const LightBounds& a, const LightBounds& b) {
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

// Of the surfaces that shine; with what is known of them beside.
std::vector<LightBounds> bounds_of_surfaces(LightSampler& s) {
  SurfaceLights shining = surface_lights(s.scene, s.quadrics);
  s.glows = std::move(shining.glows);
  s.parts = std::move(shining.parts);
  s.parts_of = std::move(shining.parts_of);
  return std::move(shining.bounds);
}

// Of a light of the tree by its number. Those of emitters are made when they are asked for, as a hundred
// bytes of each would be a third of all that many lights take.
LightBounds bounds_in_tree(const LightSampler& s, std::span<const LightBounds> surfaces,
                           std::uint32_t number) {
  return number < surfaces.size() ? surfaces[number]
                                  : s.bounds_of_emitter(s.emitters[number - surfaces.size()]);
}

// Flux becomes the power that counts for the tree.
LightBounds weighed_for_tree(LightBounds bounds, LightKind kind) {
  if (kind == LightKind::quadric) by_projection(bounds);
  if (kind == LightKind::emitter) by_intensity(bounds);
  return bounds;
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

// Where all lights of the tree are points, there is nothing in a slot.
void fill_slots(LightSampler& s) {
  if (s.scene.triangles.empty() && s.quadrics.empty()) return;
  s.slots.reserve(s.tree.order().size());
  for (const std::uint32_t number : s.tree.order()) s.slots.push_back(slot_of(s, s.numbers.light(number)));
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

void set_shares(LightSampler& s, std::vector<double> shares) {
  s.share = std::move(shares);
  if (s.share.empty()) return;
  s.share_sums.push_back(0);
  for (const double share : s.share) s.share_sums.push_back(s.share_sums.back() + share);
  s.share_guide = GuideTable(s.share_sums, s.share.size());
}

// Of the corners of the bounds; 1 where there are none.
double farthest_from(Point3d p, const Bounds3f& bounds) {
  if (bounds.empty()) return 1;
  Vector3d most;
  const Point3d lower = cast<double>(bounds.lower), upper = cast<double>(bounds.upper);
  for (int axis = 0; axis < 3; ++axis)
    most[axis] = std::max(std::abs(lower[axis] - p[axis]), std::abs(upper[axis] - p[axis]));
  return std::max(length(most), 1e-15);
}

}  // namespace

LightBounds LightSampler::bounds_of_emitter(const PointEmitter& emitter) const {
  return bounds_of(emitter, emitter.fading ? farthest_from(emitter.position, scene.bounds) : 0);
}

LightSampler make_light_sampler(const LightScene& scene, const ImageSource& images, LightChoice choice) {
  constexpr std::size_t few = 1 << 12;
  LightSampler s;
  s.scene = scene;
  const double diagonal = scene.bounds.empty() ? 1 : length(cast<double>(extent(scene.bounds)));
  s.emitters.reserve(static_cast<std::size_t>(std::ranges::count_if(scene.lights, is_point_like)));
  Sorter sorter{s, images, pi * std::max(diagonal * diagonal / 4, 1e-30)};
  for (; sorter.light < scene.lights.size(); ++sorter.light)
    std::visit(sorter, scene.lights[sorter.light].model);
  s.has_only_glows = !s.has_background() && std::ranges::none_of(scene.area_lights, &AreaLight::sampled);
  prepare_quadrics(s);
  s.numbers = LightNumbers({scene.triangles.size(), s.quadrics.size(), s.emitters.size(), s.distant.size(),
                            s.environments.size(), s.infinite.size()});
  std::vector<LightBounds> surfaces = bounds_of_surfaces(s);
  const std::size_t in_tree = surfaces.size() + s.emitters.size();
  double flux = 0;
  for (std::uint32_t i = 0; i < in_tree; ++i)
    if (const double power = bounds_in_tree(s, surfaces, i).power; std::isfinite(power)) flux += power;
  const LightTree::BoundsOf bounds = [&, weighs = choice == LightChoice::tree](std::uint32_t i) {
    const LightBounds of_flux = bounds_in_tree(s, surfaces, i);
    return weighs ? weighed_for_tree(of_flux, s.numbers.light(i).kind) : of_flux;
  };
  if (in_tree == 2 && scene.triangles.size() == 2 && is_one_flat_lamp(surfaces[0], surfaces[1]))
    choice = LightChoice::power;
  s.tree = LightTree(in_tree, bounds, choice);
  set_shares(s, shares_of(flux, sorter));
  if (!s.share.empty()) {
    s.three_numbers = s.share[LightNumbers::choice_of_tree] == 1 && in_tree <= few;
    find_variety(bounds, s);
  }
  surfaces = std::vector<LightBounds>();  // the slots take its room
  fill_slots(s);
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
