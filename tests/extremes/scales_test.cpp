// SPDX-License-Identifier: Apache-2.0
// A scene that is made larger, smaller or moved away shows the same picture.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include "tests/extremes/measure.h"

namespace vitrail::test::scales_test {
namespace {

struct Place {
  double size = 1;
  Vector3d offset;
};

// A floor, a box of glass and one that is matte, under a square lamp, a point light and the sky; its centre
// is the origin. All its coordinates are multiples of 2⁻⁸ where `dyadic`, so that doubles hold them 10⁷ away
// too.
Scene room(const Place& place, bool dyadic) {
  const float r = dyadic ? 0 : 0.0123f;
  Scene scene;
  add_shape(scene, add_quads(scene, {{{{-2, -2, -1}, {2, -2, -1}, {2, 2, -1}, {-2, 2, -1}}}}), matte(0.6f));
  add_shape(scene, add_quads(scene, box_faces({-1 + r, -0.5f, -0.75f + r}, {-0.25f, 0.25f + r, 0})),
            Material{DielectricMaterial{ConstantSpectrum{1.5f}}});
  add_shape(scene, add_quads(scene, box_faces({0.125f + r, -0.5f + r, -1}, {0.75f, 0.5f, -0.25f - r})),
            matte(0.3f));
  add_shape(scene,
            add_quads(scene, {{{{-0.5f, -0.5f, 1}, {-0.5f, 0.5f, 1}, {0.5f, 0.5f, 1}, {0.5f, -0.5f, 1}}}}),
            matte(0), lamp(4));
  const auto placed = [&](Point3d p) { return Point3d{} + place.offset + (p - Point3d{}) * place.size; };
  for (Shape& shape : scene.shapes)
    shape.object_to_world = translate(place.offset) * scale({place.size, place.size, place.size});
  add_point(scene, placed({1.5, -1, 0.5}), place.size * place.size);
  add_sky(scene, 0.2);
  set_camera(scene, placed({0.5, -3, 0.75}), placed({0, 0, -0.375}), {0, 0, 1}, 0.9, 48, 48);
  scene.settings.max_depth = 6;
  return scene;
}

const Film& as_modelled(bool dyadic) {
  static const Film films[] = {render_finite(room({}, false), 64, "scale_1").film,
                               render_finite(room({}, true), 64, "scale_1_dyadic").film};
  return films[dyadic];
}

// A throughput is rounded by a hash of its ray, to 14 bits.
TEST(Scale, PowersOfTwoChangeRoundingByChanceAlone) {
  for (const int exponent : {-40, -20, 23, 40}) {
    const Film film = render_finite(room({std::ldexp(1.0, exponent), {}}, true), 64).film;
    expect_absolute(fmt::format("scale 2^{}: pixels, root mean square, relative", exponent), 0,
                    picture_difference(as_modelled(true), film).root_mean_square, 1e-5);
  }
}

// A rounded vertex moves an edge by 10⁻⁷ of the scene, which turns few samples into others.
TEST(Scale, AnyOtherChangesRoundingAlone) {
  for (const double size : {1e-6, 1e-3, 1e3, 1e7, 1e12}) {
    const Film film = render_finite(room({size, {}}, false), 64, fmt::format("scale_{:g}", size)).film;
    const FilmDifference d = picture_difference(as_modelled(false), film);
    expect_absolute(fmt::format("scale {:g}: mean of the picture, relative", size), 0, d.mean, 1e-4);
    expect_absolute(fmt::format("scale {:g}: pixels, root mean square, relative", size), 0,
                    d.root_mean_square, 5e-3);
  }
}

TEST(Offset, OfWhatDoublesHoldChangesNoBit) {
  for (const double offset : {1e3, 1e7, -16777216.0}) {
    const Film film = render_finite(room({1, {offset, -offset, offset}}, true), 64).film;
    expect_exactly(fmt::format("offset {:g}: pixels that differ", offset), 0,
                   static_cast<double>(picture_difference(as_modelled(true), film).pixels));
  }
}

TEST(Offset, AnyOtherChangesRoundingAlone) {
  struct Case {
    double size, offset, limit;
  };
  // 10⁷ has 1.9·10⁻⁹ between neighbouring doubles: 2·10⁻⁶ of a scene of 10⁻³, and a fiftieth at 10⁸ of one of
  // 10⁻⁶ is what is left there.
  for (const Case c : {Case{1, 1e4 + 0.37, 5e-3}, Case{1, 1e7 + 0.37, 5e-3}, Case{1e7, 1e7 + 0.37, 5e-3},
                       Case{1e-3, 1e7 + 0.37, 2e-2}}) {
    const Place place{c.size, {c.offset, c.offset, -c.offset}};
    const Film film =
        render_finite(room(place, false), 64, fmt::format("offset_{:g}_{:g}", c.size, c.offset)).film;
    const FilmDifference d = picture_difference(as_modelled(false), film);
    const std::string what = fmt::format("size {:g} at {:.9g}", c.size, c.offset);
    expect_absolute(what + ": mean of the picture, relative", 0, d.mean, c.limit / 5);
    expect_absolute(what + ": pixels, root mean square, relative", 0, d.root_mean_square, c.limit);
  }
}

// ---- One triangle far away ------------------------------------------------------------------------

enum class As { own_shape, same_mesh, instance };

std::array<Point3f, 3> far_triangle(double distance) {
  const auto at = [&](double x, double y) {
    return cast<float>(Point3d{distance + x, -0.5 * distance + y, 0.25 * distance});
  };
  return {at(0, 0), at(1, 0), at(0, 1)};
}

using Quads = std::vector<std::array<Point3f, 4>>;

// Each parted into n×n.
Quads tiled(const Quads& quads, int n) {
  Quads tiles;
  for (const auto& q : quads) {
    const auto at = [&](int i, int k) {
      const Point3d a = cast<double>(q[0]);
      return cast<float>(a + (cast<double>(q[1]) - a) * (double{1} * i / n) +
                         (cast<double>(q[3]) - a) * (double{1} * k / n));
    };
    for (int i = 0; i < n; ++i)
      for (int k = 0; k < n; ++k) tiles.push_back({at(i, k), at(i + 1, k), at(i + 1, k + 1), at(i, k + 1)});
  }
  return tiles;
}

Scene room_and(double distance, As as) {
  Scene scene = room({}, false);
  const std::array<Point3f, 3> far = far_triangle(distance);
  TriangleMesh mesh;
  if (as == As::same_mesh) {
    TriangleMesh& box = scene.meshes[1];
    const auto first = static_cast<std::uint32_t>(box.positions.size());
    box.positions.insert(box.positions.end(), far.begin(), far.end());
    box.triangles.push_back({first, first + 1, first + 2});
    return scene;
  }
  mesh.positions.assign(far.begin(), far.end());
  mesh.triangles = {{0, 1, 2}};
  scene.meshes.push_back(mesh);
  if (as == As::own_shape) {
    add_shape(scene, {static_cast<std::uint32_t>(scene.meshes.size() - 1)}, matte(0.5f));
    return scene;
  }
  // The matte box where it was and far away, of as many triangles as are worth being instanced.
  Prototype prototype;
  prototype.shapes.push_back(scene.shapes[2]);
  prototype.shapes[0].mesh = add_quads(
      scene, tiled(box_faces({0.125f + 0.0123f, -0.5f + 0.0123f, -1}, {0.75f, 0.5f, -0.25f - 0.0123f}), 4));
  scene.shapes.erase(scene.shapes.begin() + 2);
  scene.prototypes.push_back(prototype);
  scene.instances.push_back({{0}, {}, {}});
  scene.instances.push_back({{0}, translate({distance, -0.5 * distance, 0.25 * distance}), {}});
  return scene;
}

TEST(FarAway, OneTriangleLeavesTheRestAsItIs) {
  for (const As as : {As::own_shape, As::same_mesh, As::instance}) {
    const char* const name = as == As::own_shape   ? "a triangle"
                             : as == As::same_mesh ? "a triangle of the same mesh"
                                                   : "an instance";
    // Kept, the box is rounded about its own centre, which turns a caustic's path or two into others.
    const Film alone = as == As::instance ? render_finite(room_and(300, as), 64).film : as_modelled(false);
    for (const double distance : {1e3, 1e5, 1e6, 1e7, 1e8}) {
      const Scene scene = room_and(distance, as);
      const Film film = render_finite(scene, 64).film;
      const FilmDifference d = picture_difference(alone, film);
      const std::string what = fmt::format("{} {:g} away", name, distance);
      expect_absolute(what + ": mean of the picture, relative", 0, d.mean, 1e-4);
      expect_absolute(what + ": pixels, root mean square, relative", 0, d.root_mean_square, 5e-3);
      for (const std::uint32_t domains : {2u, 16u})
        expect_exactly(
            fmt::format("{}: pixels that differ in {} domains", what, domains), 0,
            static_cast<double>(picture_difference(film, render_finite(scene, 64, "", domains).film).pixels));
    }
  }
}

// What is far from the others is what the camera sees.
TEST(FarAway, WhatIsSeenCounts) {
  for (const double distance : {1e6, 1e8}) {
    Scene scene = room({1, {distance, 0, 0}}, false);
    TriangleMesh cloud;  // of more triangles than the room has
    for (int i = 0; i < 400; ++i) {
      const auto x = static_cast<float>(i % 20), y = static_cast<float>(i / 20);
      const auto first = static_cast<std::uint32_t>(cloud.positions.size());
      cloud.positions.insert(cloud.positions.end(), {{x, y, 0}, {x + 1, y, 0}, {x, y + 1, 0}});
      cloud.triangles.push_back({first, first + 1, first + 2});
    }
    scene.meshes.push_back(std::move(cloud));
    add_shape(scene, {static_cast<std::uint32_t>(scene.meshes.size() - 1)}, matte(0.5f));
    const Film film = render_finite(scene, 64).film;
    const FilmDifference d = picture_difference(as_modelled(false), film);
    expect_absolute(fmt::format("a room {:g} away: mean of the picture, relative", distance), 0, d.mean,
                    2e-2);
  }
}

}  // namespace
}  // namespace vitrail::test::scales_test
