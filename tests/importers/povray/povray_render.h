// SPDX-License-Identifier: Apache-2.0
// Small scenes, and what Debian's povray makes of the files that are written of them.
#pragma once

#include <cstdlib>
#include <fstream>
#include <iterator>
#include <string>
#include <vector>

#include "importers/povray/write/write_povray.h"
#include "scene/spectra/rgb_to_spectrum.h"
#include "tests/importers/temporary_folder.h"

namespace vitrail {

struct PovPicture {
  int width = 0, height = 0;
  std::vector<double> values;  // linear rgb, rows from the top; empty where povray failed
  std::array<double, 3> at(int x, int y) const {
    const auto i = static_cast<std::size_t>((y * width + x) * 3);
    return {values.at(i), values.at(i + 1), values.at(i + 2)};
  }
};

inline bool has_povray() { return std::system("command -v povray > /dev/null 2>&1") == 0; }

// Binary PPM of 16 bits a value.
inline PovPicture read_ppm(const std::filesystem::path& file) {
  std::ifstream in(file, std::ios::binary);
  PovPicture picture;
  std::string magic;
  int largest = 0;
  in >> magic;
  for (int* value : {&picture.width, &picture.height, &largest}) {
    while ((in >> std::ws).peek() == '#') in.ignore(1 << 20, '\n');
    in >> *value;
  }
  in.get();
  if (!in || magic != "P6" || largest != 65535) return {};
  const std::string bytes{std::istreambuf_iterator<char>(in), {}};
  for (std::size_t i = 0; i + 1 < bytes.size(); i += 2)
    picture.values.push_back(
        (static_cast<unsigned char>(bytes[i]) * 256 + static_cast<unsigned char>(bytes[i + 1])) / 65535.0);
  if (picture.values.size() != static_cast<std::size_t>(picture.width * picture.height * 3)) return {};
  return picture;
}

// Writes the scene into the folder and renders it there, a sample a pixel. Values above 1 are cut.
inline PovPicture render_povray(const Scene& scene, const TemporaryFolder& folder,
                                Diagnostics* diagnostics = nullptr) {
  const Diagnostics found = write_povray(scene, folder / "scene.pov");
  if (diagnostics) *diagnostics = found;
  const std::string command = "cd '" + folder.path().string() +
                              "' && povray scene.ini -D -A +FP16 File_Gamma=1.0 +Oout.ppm > log.txt 2>&1";
  int tries = 3;  // on a busy machine POV-Ray's threads may not start in its time
  while (std::system(command.c_str()) != 0) {
    std::ifstream log(folder / "log.txt");
    std::string text{std::istreambuf_iterator<char>(log), {}};
    if (--tries > 0 && text.find("worker thread startup") != std::string::npos) continue;
    if (text.size() > 2000) text = text.substr(text.size() - 2000);
    ADD_FAILURE() << text;
    return {};
  }
  return read_ppm(folder / "out.ppm");
}

// ---- Small scenes -------------------------------------------------------------------------------

// By default 32 × 32 pixels, seen from (0,0,4) down to the plane z = 0, of which ±2 is in the picture, +x
// right and +y up; direct light only.
inline Scene empty_povray_scene() {
  Scene scene;
  PerspectiveCamera camera;
  camera.camera_to_world = look_at({0, 0, 4}, {0, 0, 0}, {0, 1, 0});
  // In pbrt's convention this look_at has +x left: turn it round.
  for (std::size_t row = 0; row < 3; ++row) camera.camera_to_world.m[row][0] *= -1;
  camera.screen = {-0.5, 0.5, -0.5, 0.5};
  scene.camera = camera;
  scene.film.width = scene.film.height = 32;
  scene.film.crop = {0, 32, 0, 32};
  scene.film.filter = BoxFilter{};
  scene.settings.max_depth = 1;
  return scene;
}

// Where the middle of a pixel of that picture is in the plane.
inline double plane_x(int x) { return (x + 0.5 - 16) / 8; }
inline double plane_y(int y) { return -(y + 0.5 - 16) / 8; }

inline TriangleMesh quad_mesh(Point3f a, Point3f b, Point3f c, Point3f d) {
  TriangleMesh mesh;
  mesh.positions = {a, b, c, d};
  mesh.triangles = {{0, 1, 2}, {0, 2, 3}};
  mesh.uvs = {{0, 0}, {1, 0}, {1, 1}, {0, 1}};
  return mesh;
}

inline TriangleMesh square(float x0, float x1, float y0, float y1, float z) {
  return quad_mesh({x0, y0, z}, {x1, y0, z}, {x1, y1, z}, {x0, y1, z});
}

inline Shape make_shape(Scene& scene, TriangleMesh mesh, MaterialModel model) {
  Shape shape;
  shape.mesh = {static_cast<std::uint32_t>(scene.meshes.size())};
  shape.material = {static_cast<std::uint32_t>(scene.materials.size())};
  scene.meshes.push_back(std::move(mesh));
  scene.materials.push_back(Material{std::move(model)});
  return shape;
}

inline Shape& add(Scene& scene, TriangleMesh mesh, MaterialModel model) {
  scene.shapes.push_back(make_shape(scene, std::move(mesh), std::move(model)));
  return scene.shapes.back();
}

inline Shape& add_emitter(Scene& scene, TriangleMesh mesh, RGB radiance) {
  Shape& shape = add(scene, std::move(mesh), DiffuseMaterial{ConstantSpectrum{0}});
  shape.area_light = Id<AreaLight>{static_cast<std::uint32_t>(scene.area_lights.size())};
  scene.area_lights.push_back({emission_from_rgb(radiance)});
  return shape;
}

inline DiffuseMaterial diffuse(RGB reflectance) { return {reflectance_from_rgb(reflectance)}; }

}  // namespace vitrail
