// SPDX-License-Identifier: Apache-2.0
// Cameras where they should not be: in glass, in a surface, in an interface, at a vertex that cutting makes.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <cmath>

#include "bundle/domain_file.h"
#include "bundle/manifest.h"
#include "partitioner/partition.h"
#include "tests/extremes/measure.h"
#include "tests/support/temporary_directory.h"
#include "tests/support/test_scenes.h"

namespace vitrail::test::cameras_test {
namespace {

// Radiance in glass is n² times that outside (Clausius), where light gets there at all: straight ahead it
// does.
TEST(Camera, InGlass) {
  for (const float eta : {1.5f, 1 + 1e-7f, 2.5f}) {
    Scene scene;
    add_shape(scene, add_quads(scene, box_faces({-1, -1, -1}, {1, 1, 1})),
              Material{DielectricMaterial{ConstantSpectrum{eta}}});
    add_sky(scene, 1);
    set_camera(scene, {0.1, 0.2, -0.3}, {0.1, 0.2, 1}, {0, 1, 0}, 0.3, 16, 16);
    scene.settings.max_depth = 200;
    const Measured b = measure(scene, 256);
    const auto n = static_cast<double>(eta);
    expect_relative(fmt::format("camera in glass of index {:.8g} under a sky of 1", n), n * n, b.mean, 2e-5,
                    b.standard_error);
  }
}

// A camera in the plane of a surface sees what a camera just before it sees: what it looks away from is not
// hit.
TEST(Camera, OnASurface) {
  const auto seen = [](double z, double towards) {
    Scene scene;
    add_shape(scene, add_quads(scene, {square_at(0, 2)}), matte(0), lamp(1, true));
    add_shape(scene, add_quads(scene, {square_at(1, 2)}), matte(0), lamp(2, true));
    add_shape(scene, add_quads(scene, {square_at(-1, 2)}), matte(0), lamp(3, true));
    set_camera(scene, {0.25, 0.125, z}, {0.25, 0.125, z + towards}, {0, 1, 0}, 0.5, 16, 16);
    return measure(scene, 16).mean;
  };
  expect_relative("camera in a surface, looking up", 2, seen(0, 1), 2e-5);
  expect_relative("camera in a surface, looking down", 3, seen(0, -1), 2e-5);
  expect_relative("camera 10⁻⁶ above it, looking down", 1, seen(1e-6, -1), 2e-5);
}

// Directions have a resolution of 1.2·10⁻⁷ rad and starts that of floats: a picture 2 across, whose left half
// is lit, from that far away.
TEST(Camera, FarAway) {
  for (const double distance : {1e2, 1e4, 1e6}) {
    Scene scene;
    add_shape(scene, add_quads(scene, {square_at(0, 2)}), matte(0));
    add_shape(scene, add_quads(scene, {{{{0, -2, 0.5f}, {2, -2, 0.5f}, {2, 2, 0.5f}, {0, 2, 0.5f}}}}),
              matte(0), lamp(1, true));
    set_camera(scene, {0, 0, distance}, {0, 0, 0}, {0, 1, 0}, 2 * std::atan(1 / distance), 64, 64);
    const double resolution = 1.2e-7 * distance;
    expect_absolute(fmt::format("half lit picture 2 across from {:g} away", distance), 0.5,
                    measure(scene, 16).mean, resolution + 1e-4);
  }
}

// Beyond what floats hold there is nothing but the sky.
TEST(Camera, BeyondAllScenes) {
  for (const double distance : {1e16, 1e19, 1e25, 1e38, 1e40, 1e100}) {
    Scene scene;
    add_shape(scene, add_quads(scene, {square_at(0, 2)}), matte(0.5f));
    add_sky(scene, 1);
    set_camera(scene, {distance, distance / 2, distance}, {0, 0, 0}, {0, 1, 0}, 0.5, 8, 8);
    expect_relative(fmt::format("sky of 1 from {:g} away", distance), 1, measure(scene, 16).mean, 2e-5);
  }
}

// The interfaces and the vertices of pieces of a scene cut in 32.
struct Cuts {
  std::vector<KdNode> planes;
  std::vector<Point3d> vertices;  // in the bundle's coordinates, that no triangle has
  Vector3d offset;
};

Cuts cuts_of(const Scene& scene) {
  const TemporaryDirectory directory;
  PartitionOptions options;
  options.domains = 32;
  partition(scene, directory / "scene.vit", options);
  const Manifest m = read_manifest(directory / "scene.vit");
  Cuts cuts{m.kd_nodes, {}, m.offset};
  for (std::uint32_t d = 0; d < m.domains.size(); ++d) {
    const PieceList pieces = MappedDomain(domain_path(directory / "scene.vit", d)).pieces();
    for (const Point3d& v : pieces.vertices)
      for (const KdNode& plane : m.kd_nodes)
        if (v[static_cast<int>(plane.axis)] == static_cast<double>(plane.split)) {
          cuts.vertices.push_back(v);
          break;
        }
  }
  return cuts;
}

Scene torus() {
  Scene scene = scene_of(bumpy_torus(40));
  add_sky(scene, 1);
  scene.settings.max_depth = 4;
  return scene;
}

void expect_one_picture(const std::string& what, const Scene& scene) {
  const Film one = render_finite(scene, 8, "", 1).film, many = render_finite(scene, 8, "", 32).film;
  expect_exactly(what + ", 1 and 32 domains: pixels that differ", 0,
                 static_cast<double>(picture_difference(one, many).pixels));
}

TEST(Camera, InAnInterface) {
  Scene scene = torus();
  const Cuts cuts = cuts_of(scene);
  for (const std::size_t node : {0, 1, 2}) {
    const KdNode& plane = cuts.planes.at(node);
    const int axis = static_cast<int>(plane.axis);
    Point3d eye = Point3d{} + cuts.offset, along = eye;
    eye[axis] += static_cast<double>(plane.split);
    along[axis] = eye[axis];
    along[(axis + 1) % 3] += 1, along[(axis + 2) % 3] += 0.25;
    Vector3d up;
    up[axis] = 1;  // the middle row looks along the interface
    set_camera(scene, eye, along, up, 1.2, 33, 33);
    expect_one_picture(fmt::format("camera in the interface of node {}", node), scene);
  }
}

TEST(Camera, AtAVertexOfACut) {
  Scene scene = torus();
  const Cuts cuts = cuts_of(scene);
  ASSERT_GT(cuts.vertices.size(), 10u);
  for (const std::size_t i : {std::size_t{0}, cuts.vertices.size() / 2, cuts.vertices.size() - 1}) {
    const Point3d eye = cuts.vertices[i] + cuts.offset;
    set_camera(scene, eye, eye + Vector3d{0.3, -0.2, 0.7}, {0, 1, 0}, 1.5, 32, 32);
    expect_one_picture(fmt::format("camera at vertex {} of {} cuts", i, cuts.vertices.size()), scene);
    // And looking at it, from outside.
    set_camera(scene, eye + Vector3d{5, 4, 3}, eye, {0, 1, 0}, 0.01, 33, 33);
    expect_one_picture("camera that looks at it", scene);
  }
}

}  // namespace
}  // namespace vitrail::test::cameras_test
