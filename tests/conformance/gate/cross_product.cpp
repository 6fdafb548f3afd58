// SPDX-License-Identifier: Apache-2.0
#include "tests/conformance/gate/cross_product.h"

#include <fmt/format.h>

#include <algorithm>

#include "scene/records/material_traits.h"
#include "scene/spectra/rgb_to_spectrum.h"
#include "tests/conformance/gate/pairs.h"
#include "tests/conformance/gate/scene_parts.h"

namespace vitrail::test {

namespace {

void look(Scene& scene) {
  constexpr int size = 32;
  PerspectiveCamera camera;
  camera.camera_to_world = look_at({0.2, 0.4, 5}, {0, 0, 0}, {0, 1, 0});
  camera.screen = {-0.45, 0.45, -0.45, 0.45};
  scene.camera = camera;
  scene.film.width = scene.film.height = size;
  scene.film.crop = {0, size, 0, size};
  scene.film.filter = BoxFilter{};
  scene.settings.max_depth = 4;
}

void add_plane(SceneParts& s, Spectrum color, const Transform& to_world) {
  TriangleMesh mesh;
  mesh.positions = {{-4, -4, 0}, {4, -4, 0}, {4, 4, 0}, {-4, 4, 0}};
  mesh.triangles = {{0, 1, 2}, {0, 2, 3}};
  Shape shape;
  shape.mesh = s.add(std::move(mesh));
  shape.material = s.add(Material{DiffuseMaterial{std::move(color)}});
  shape.object_to_world = to_world;
  s.scene.shapes.insert(s.scene.shapes.begin(), std::move(shape));
}

// Light goes straight through sheets and masks here. In Mitsuba it does so to its volumetric path tracer,
// which counts no such event; no light without extent gets through to the other.
void agree_on_straight_light(Scene& scene) {
  scene.settings.straight_counts = std::ranges::none_of(traits_of(scene.materials), &MaterialTraits::counts);
}

// The first of its kind comes from line 1.
void number(auto& records) {
  for (std::size_t i = 0; i < records.size(); ++i) records[i].origin.line = static_cast<std::uint32_t>(i + 1);
}
void number_records(Scene& scene) {
  scene.files = {"scene"};
  number(scene.textures), number(scene.materials), number(scene.lights), number(scene.area_lights);
  number(scene.prototypes), number(scene.instances);
  std::uint32_t shapes = 0;
  const auto number_shape = [&](Shape& shape) {  // by name, too: writers give shapes none
    shape.name = fmt::format("_unnamed_shape_{}", shapes);
    shape.origin.line = ++shapes;
  };
  std::ranges::for_each(scene.shapes, number_shape);
  for (Prototype& prototype : scene.prototypes) std::ranges::for_each(prototype.shapes, number_shape);
}

std::vector<std::size_t> sizes() {
  return {material_values().size(), wrapper_values().size(), color_values().size(),
          number_values().size(),   light_values().size(),   shape_values().size()};
}

}  // namespace

CrossProduct::CrossProduct(const std::filesystem::path& folder) : folder_(folder) {
  write_part_images(folder);
}

std::vector<CrossProduct::Row> CrossProduct::rows() const { return rows_of_all_pairs(sizes()); }

std::vector<CrossProduct::Row> CrossProduct::rows_that(const std::function<bool(const Scene&)>& test) const {
  std::vector<Row> values;
  Row counts;
  for (std::size_t d = 0; d < sizes().size(); ++d) {
    Row passing;
    for (std::size_t v = 0; v < sizes()[d]; ++v) {
      Row plain(sizes().size(), 0);
      plain[d] = v;
      if (test(scene(plain))) passing.push_back(v);
    }
    counts.push_back(passing.size());
    values.push_back(std::move(passing));
  }
  std::vector<Row> rows = rows_of_all_pairs(counts);
  for (Row& row : rows)
    for (std::size_t d = 0; d < row.size(); ++d) row[d] = values[d][row[d]];
  return rows;
}

std::vector<CrossProduct::Row> short_form(const std::vector<CrossProduct::Row>& rows) {
  return rows_of_all_values(rows);
}

std::string CrossProduct::name(const Row& row) const {
  return fmt::format("{} / {} / {} / {} / {} / {}", material_values()[row[0]].name,
                     wrapper_values()[row[1]].name, color_values()[row[2]].name, number_values()[row[3]].name,
                     light_values()[row[4]].name, shape_values()[row[5]].name);
}

Scene CrossProduct::scene(const Row& row) const {
  SceneParts s;
  s.images = folder_;
  look(s.scene);
  s.number = number_values()[row[3]].make(s);
  s.color = color_values()[row[2]].make(s);
  const Id<Material> material = wrapper_values()[row[1]].make(s, Material{material_values()[row[0]].make(s)});
  light_values()[row[4]].make(s);
  shape_values()[row[5]].make(s, material);
  s.add(PointLight{{0.5, 0.5, 4}, emission_from_rgb({3, 3, 3})});  // so that everything is seen
  add_plane(s, reflectance_from_rgb({0.3, 0.5, 0.7}), translate({0, 0, -1.5}));
  add_plane(s, reflectance_from_rgb({0.6, 0.6, 0.4}),
            translate({0, -1.4, 0}) * rotate(-1.5707963267948966, {1, 0, 0}));
  agree_on_straight_light(s.scene);
  number_records(s.scene);
  return std::move(s.scene);
}

}  // namespace vitrail::test
