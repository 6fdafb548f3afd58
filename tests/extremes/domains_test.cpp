// SPDX-License-Identifier: Apache-2.0
// Far more domains than triangles.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include "partitioner/partition.h"
#include "tests/extremes/measure.h"
#include "tests/laws/exact/soup.h"
#include "tests/support/temporary_directory.h"

namespace vitrail::test::domains_test {
namespace {

Scene soup_of_triangles(std::size_t count) {
  SoupRandom random(3);
  TriangleMesh mesh;
  if (count == 1) {
    mesh.positions = {{-1, -1, 0}, {1, -0.75f, 0.5f}, {0.25f, 1, -0.5f}};
    mesh.triangles = {{0, 1, 2}};
    count = 0;
  }
  for (std::size_t i = 0; i < count; ++i) {
    const Point3d a = Point3d{} + random.vector(1);
    for (int k = 0; k < 3; ++k) mesh.positions.push_back(cast<float>(a + random.vector(0.6)));
    const auto first = static_cast<std::uint32_t>(3 * i);
    mesh.triangles.push_back({first, first + 1, first + 2});
  }
  Scene scene;
  scene.meshes.push_back(std::move(mesh));
  add_shape(scene, {0}, matte(0.7f));
  add_sky(scene, 1);
  add_point(scene, {2, 1, -1}, 5);
  set_camera(scene, {0.5, 1, -4}, {0, 0, 0}, {0, 1, 0}, 0.8, 64, 64);
  return scene;
}

void expect_one_picture(std::size_t triangles, std::uint32_t domains) {
  const Scene scene = soup_of_triangles(triangles);
  const Rendered one = render_finite(scene, 8, fmt::format("soup_{}", triangles)),
                 many = render_finite(scene, 8, "", domains);
  expect_exactly(
      fmt::format("{} triangles in {} domains: pixels that differ from 1 domain", triangles, domains), 0,
      static_cast<double>(picture_difference(one.film, many.film).pixels));
  expect_exactly("domains", domains, static_cast<double>(many.stats.domains_total));
}

TEST(Domains, MoreThanTriangles) {
  expect_one_picture(100, 4096);
  expect_one_picture(1, 256);
}

TEST(Domains, TilePiecesExactly) {
  const TemporaryDirectory directory;
  PartitionOptions options;
  options.domains = 4096;
  const PartitionStats stats = partition(soup_of_triangles(100), directory / "scene.vit", options);
  expect_exactly("100 triangles in 4096 domains: stored twice", 0, static_cast<double>(stats.duplicates));
  expect_absolute("100 triangles in 4096 domains: area of the pieces, relative", 0, stats.area_error, 1e-12);
  report("pieces", static_cast<double>(stats.pieces));
  report("bundle", static_cast<double>(stats.bundle_bytes) / 1e6, "MB");
}

}  // namespace
}  // namespace vitrail::test::domains_test
