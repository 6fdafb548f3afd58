// SPDX-License-Identifier: Apache-2.0
// Panes behind panes, apart and touching, and surfaces in one plane.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <cmath>
#include <vector>

#include "scene/geometry/portable_math.h"
#include "tests/extremes/measure.h"
#include "tests/support/polarised.h"
#include "tracer/bsdf/local.h"

namespace vitrail::test::panes_test {
namespace {

constexpr float thickness = 0.0625f;

// Before a lamp of radiance 1, from straight ahead.
Scene before_a_lamp() {
  Scene scene;
  add_shape(scene, add_quads(scene, {square_at(-1, 4)}), matte(0), lamp(1));
  set_orthographic(scene, {0.03, 0.07, 8}, {0.03, 0.07, 0}, {0, 1, 0}, 0.25, 16);
  scene.settings.max_depth = 250;
  return scene;
}

Material glass() { return {DielectricMaterial{ConstantSpectrum{1.5f}}}; }

constexpr long double r = 0.04L;  // of a face, (½/2½)²

// The faces' interreflections summed: m faces let (1 − R)/(1 + (m − 1)R) through (Stokes 1862).
double through(int faces) { return static_cast<double>((1 - r) / (1 + (faces - 1) * r)); }

// What of it meets `depth` faces at most before it goes straight on.
double through(int faces, int depth) {
  const auto count = static_cast<std::size_t>(faces);
  std::vector<long double> down(count + 1), up(count + 1);  // about to meet face i, on its way down or up
  long double arrived = 0;
  down[0] = 1;
  for (int event = 0; event < depth; ++event) {
    std::vector<long double> next_down(count + 1), next_up(count + 1);
    for (std::size_t i = 0; i < count; ++i) {
      next_down[i + 1] = down[i] * (1 - r) + up[i] * r;
      if (i > 0) next_up[i - 1] = down[i] * r + up[i] * (1 - r);
    }
    arrived += next_down[count];
    next_down[count] = 0;
    down = next_down, up = next_up;
  }
  for (std::size_t i = 0; i < count; ++i)
    arrived += down[i] * std::pow(1 - r, static_cast<long double>(count - i));
  return static_cast<double>(arrived);
}

void add_stack(Scene& scene, int panes, float gap) {
  for (int i = 0; i < panes; ++i) {
    const float z = static_cast<float>(i) * (thickness + gap);
    add_shape(scene, add_quads(scene, box_faces({-2, -2, z}, {2, 2, z + thickness})), glass());
  }
}

TEST(Panes, Apart) {
  for (const int panes : {1, 2, 8, 32})
    for (const float gap : {0.0625f, 1e-5f}) {
      Scene scene = before_a_lamp();
      add_stack(scene, panes, gap);
      const Measured b = measure(scene, 256);
      expect_relative(fmt::format("{} panes {:g} apart", panes, gap),
                      through(2 * panes, scene.settings.max_depth), b.mean, 2e-5, b.standard_error);
    }
}

// A pane before a lamp that is 10⁻³ behind it: (1 − R)²·Σ R²ʲ over what meets so many faces. A direction
// within is off by 1.2·10⁻⁷ rad, and the sine outside by 1.3·10⁻⁷, which is of the cosine a share
// of 1.3·10⁻⁷/cos²θ: from 89.97° on nothing may come out.
TEST(Panes, AtGrazingIncidence) {
  for (const double degrees : {80.0, 89.0, 89.9}) {
    Scene scene;
    add_shape(scene, add_quads(scene, {square_at(-thickness - 1e-3f, 200)}), matte(0), lamp(1));
    add_shape(scene, add_quads(scene, box_faces({-100, -100, -thickness}, {100, 100, 0})), glass());
    add_shape(scene, add_quads(scene, {{{{9, 9, 0.06f}, {9, 8, 0.06f}, {8, 8, 0.06f}, {8, 9, 0.06f}}}}),
              matte(0));
    const double tilt = degrees * pi / 180, cosine = std::cos(tilt);
    set_orthographic(scene, {5 * std::sin(tilt), 0, 5 * cosine}, {0, 0, 0}, {0, 1, 0}, 1e-6 * cosine, 32);
    scene.settings.max_depth = 250;
    const double expected = over_polarisations([&](Fresnel f) {
      const double reflected = f(cosine, 1.5);
      double sum = 0;
      for (int events = 2; events <= scene.settings.max_depth; events += 2)
        sum += (1 - reflected) * (1 - reflected) * std::pow(reflected, events - 2);
      return sum;
    });
    const Measured b = measure(scene, 256);
    expect_relative(fmt::format("a pane at {:g}°", degrees), expected, b.mean,
                    1.3e-7 / (cosine * cosine) + 2e-5, b.standard_error);
  }
}

TEST(Panes, Touching) {
  for (const int panes : {2, 4}) {
    Scene scene = before_a_lamp();
    add_stack(scene, panes, 0);
    const Measured b = measure(scene, 256);
    report(fmt::format("{} panes touching (no gap {:.6f}, optical contact {:.6f})", panes, through(2 * panes),
                       through(2)),
           b.mean);
  }
}

// With priorities, faces within each other are not there.
TEST(Panes, TouchingWithPriorities) {
  Scene scene = before_a_lamp();
  for (int i = 0; i < 3; ++i) {
    const float z = static_cast<float>(i) * thickness;
    DielectricMaterial m{ConstantSpectrum{1.5f}};
    m.priority = i + 1;
    add_shape(scene, add_quads(scene, box_faces({-2, -2, z}, {2, 2, z + thickness * 1.25f})), Material{m});
  }
  const Measured b = measure(scene, 256);
  expect_relative("3 overlapping panes with priorities: one pane", through(2), b.mean, 2e-5,
                  b.standard_error);
}

// In sunlight that makes what is level and has an albedo of 1 shine with 1.
Scene in_the_sun() {
  Scene scene = before_a_lamp();
  scene.shapes.clear();
  add_sun(scene, {0, 0, -1}, pi);
  scene.settings.max_depth = 1;
  return scene;
}

// The least id of those at the least distance is met: equal triangles show the first alone.
TEST(Coplanar, EqualTrianglesShowTheFirst) {
  for (const float z : {0.0f, 0.1f}) {
    Scene scene = in_the_sun();
    for (const float reflectance : {0.75f, 0.25f})
      add_shape(scene, add_quads(scene, {square_at(z, 2)}), matte(reflectance));
    expect_relative(fmt::format("two equal squares at {:g}, of .75 and .25", z), 0.75,
                    measure(scene, 16).mean, 2e-5);
  }
}

// A square across the diagonals of another: rounding decides, the same on any number of domains.
TEST(Coplanar, OtherTrianglesShowEither) {
  Scene scene = in_the_sun();
  const Point3f a{-2, -2, 0.125f}, b{2, -2, 0.25f}, c{2, 2, 0.375f}, d{-2, 2, 0.25f};
  add_shape(scene, add_quads(scene, {{{a, b, c, d}}}), matte(0.75f));
  add_shape(scene, add_quads(scene, {{{b, c, d, a}}}), matte(0.25f));
  const Film one = render_finite(scene, 64, "coplanar").film, many = render_finite(scene, 64, "", 16).film;
  expect_exactly("two squares in one plane, 1 and 16 domains: pixels that differ", 0,
                 static_cast<double>(picture_difference(one, many).pixels));
  const double cosine = 1 / std::sqrt(1 + 2.0 / 32 / 32);
  report("share of the samples that the first square gets", (measured(one).mean / cosine - 0.25) / 0.5);
}

// Two squares back to back, each cut along its own diagonal, and two disks: the one that faces the camera is
// seen, whichever comes first, in any number of domains. They lie along no axis.
TEST(Coplanar, TheFaceThatFacesIsSeen) {
  for (const bool disks : {false, true}) {
    for (const bool first_is_front : {true, false}) {
      Scene scene = in_the_sun();
      const Transform turn = rotate(0.02, {1, 2, 0.5});
      const double cosine = transform_vector(turn, {0, 0, 1}).z;
      for (const bool front : {first_is_front, !first_is_front}) {
        auto square = square_at(0.1f, 2);
        if (!front) std::swap(square[0], square[3]), std::swap(square[1], square[2]);
        for (Point3f& p : square) p = cast<float>(transform_point(turn, cast<double>(p)));
        Material material = matte(front ? 0.75f : 0.25f);
        if (disks) {
          TriangleMesh disk;
          disk.quadric = Quadric{.kind = QuadricKind::disk, .low = 0};
          scene.meshes.push_back(disk);
          add_shape(scene, {static_cast<std::uint32_t>(scene.meshes.size() - 1)}, material);
          scene.shapes.back().object_to_world = turn * scale({2, 2, 2});
          scene.shapes.back().flip_orientation = !front;
        } else {
          add_shape(scene, add_quads(scene, {square}), material);
        }
      }
      const Film one = render_finite(scene, 64, "faces").film, many = render_finite(scene, 64, "", 16).film;
      const std::string what = fmt::format("two {} back to back, the {} one first",
                                           disks ? "disks" : "squares", first_is_front ? "front" : "back");
      expect_relative(what, 0.75 * cosine, measure(scene, 64).mean, 2e-5);
      expect_exactly(what + ", 1 and 16 domains: pixels that differ", 0,
                     static_cast<double>(picture_difference(one, many).pixels));
    }
  }
}

// Faces of a matte box on a matte floor, and of one box on another.
TEST(Coplanar, ABoxOnAFloorLeaksNoLight) {
  Scene scene;
  add_shape(scene, add_quads(scene, {square_at(0, 2)}), matte(0.5f));
  auto room = box_faces({-1, -1, 0}, {1, 1, 1});
  for (auto& face : room) std::swap(face[1], face[3]);
  add_shape(scene, add_quads(scene, room), matte(0.5f));
  add_shape(scene, add_quads(scene, box_faces({-0.5f, -0.5f, 0}, {0.5f, 0.5f, 0.25f})), matte(0.5f));
  add_sky(scene, 1e6);
  set_camera(scene, {0.9, 0.8, 0.9}, {0, 0, 0.2}, {0, 0, 1}, 1, 64, 64);
  scene.settings.max_depth = 20;
  expect_exactly("a closed room under a sky of 10⁶: light in it", 0, measure(scene, 64).mean);
}

}  // namespace
}  // namespace vitrail::test::panes_test
