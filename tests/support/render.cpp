// SPDX-License-Identifier: Apache-2.0
#include "tests/support/render.h"

#include "film/film_progress.h"
#include "partitioner/partition.h"
#include "tests/support/temporary_directory.h"

namespace vitrail::test {

Rendered render(const Scene& scene, int samples_per_pixel, std::uint32_t domains, std::uint64_t seed) {
  RenderOptions options;
  options.picture.samples_per_pixel = samples_per_pixel;
  options.picture.seed = seed;
  return render(scene, std::move(options), domains);
}

Rendered render(const Scene& scene, RenderOptions options, std::uint32_t domains) {
  const TemporaryDirectory directory;
  PartitionOptions partitioning;
  partitioning.domains = domains;
  partition(scene, directory / "scene.vit", partitioning);
  options.bundle = directory / "scene.vit";
  options.outputs.film = directory / "scene.film";
  int argc = 0;
  char** argv = nullptr;
  const auto transport = make_transport(&argc, &argv);
  Rendered result;
  result.stats = vitrail::render(*transport, options);
  result.film = read_film(options.outputs.film, nullptr);
  return result;
}

void set_camera(Scene& scene, Point3d eye, Point3d target, Vector3d up, double fov_rad, int width,
                int height) {
  PerspectiveCamera camera;
  camera.camera_to_world = look_at(eye, target, up);
  const double tangent = std::tan(fov_rad / 2), shorter = std::min(width, height);
  camera.screen = {-tangent * width / shorter, tangent * width / shorter, -tangent * height / shorter,
                   tangent * height / shorter};
  scene.camera = camera;
  scene.film.width = width;
  scene.film.height = height;
  scene.film.crop = {0, width, 0, height};
  scene.film.filter = BoxFilter{};
}

Id<TriangleMesh> add_quads(Scene& scene, const std::vector<std::array<Point3f, 4>>& quads) {
  TriangleMesh mesh;
  for (const auto& quad : quads) {
    const auto first = static_cast<std::uint32_t>(mesh.positions.size());
    mesh.positions.insert(mesh.positions.end(), quad.begin(), quad.end());
    mesh.triangles.push_back({first, first + 1, first + 2});
    mesh.triangles.push_back({first, first + 2, first + 3});
  }
  scene.meshes.push_back(std::move(mesh));
  return {static_cast<std::uint32_t>(scene.meshes.size() - 1)};
}

void add_shape(Scene& scene, Id<TriangleMesh> mesh, const Material& material,
               const std::optional<AreaLight>& light) {
  Shape shape;
  shape.mesh = mesh;
  shape.material = {static_cast<std::uint32_t>(scene.materials.size())};
  scene.materials.push_back(material);
  if (light) {
    shape.area_light = Id<AreaLight>{static_cast<std::uint32_t>(scene.area_lights.size())};
    scene.area_lights.push_back(*light);
  }
  scene.shapes.push_back(shape);
}

std::vector<std::array<Point3f, 4>> box_faces(Point3f a, Point3f b) {
  return {{{{a.x, a.y, a.z}, {a.x, b.y, a.z}, {b.x, b.y, a.z}, {b.x, a.y, a.z}}},
          {{{a.x, a.y, b.z}, {b.x, a.y, b.z}, {b.x, b.y, b.z}, {a.x, b.y, b.z}}},
          {{{a.x, a.y, a.z}, {b.x, a.y, a.z}, {b.x, a.y, b.z}, {a.x, a.y, b.z}}},
          {{{a.x, b.y, a.z}, {a.x, b.y, b.z}, {b.x, b.y, b.z}, {b.x, b.y, a.z}}},
          {{{a.x, a.y, a.z}, {a.x, a.y, b.z}, {a.x, b.y, b.z}, {a.x, b.y, a.z}}},
          {{{b.x, a.y, a.z}, {b.x, b.y, a.z}, {b.x, b.y, b.z}, {b.x, a.y, b.z}}}};
}

Brightness brightness(const Film& film) {
  Brightness result;
  const auto pixels = static_cast<std::uint32_t>(film.width() * film.height());
  double variance = 0;
  for (std::uint32_t i = 0; i < pixels; ++i) {
    result.mean += film.mean(i).y / pixels;
    variance += film.variance_of_mean(i) / pixels / pixels;
  }
  result.standard_error = std::sqrt(variance);
  return result;
}

Scene lit_box(int side) {
  Scene scene;
  auto faces = box_faces({-1, -1, -1}, {1, 1, 1});
  for (auto& face : faces) std::swap(face[1], face[3]);  // fronts inwards
  const Material grey{DiffuseMaterial{ConstantSpectrum{0.6f}}};
  add_shape(scene, add_quads(scene, faces), grey);
  add_shape(
      scene,
      add_quads(scene, {{{{-.3f, .99f, -.3f}, {.3f, .99f, -.3f}, {.3f, .99f, .3f}, {-.3f, .99f, .3f}}}}),
      grey, AreaLight{ConstantSpectrum{10}, true});
  set_camera(scene, {0, 0, -0.95}, {0, 0, 1}, {0, 1, 0}, 1.6, side, side);
  scene.settings.max_depth = 4;
  return scene;
}

}  // namespace vitrail::test
