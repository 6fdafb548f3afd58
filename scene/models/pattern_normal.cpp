// SPDX-License-Identifier: Apache-2.0
#include "scene/models/pattern_normal.h"

#include <array>
#include <cmath>

#include "scene/geometry/portable_math.h"
#include "scene/models/lattice_noise.h"
#include "scene/models/pattern_shapes.h"

namespace vitrail {

namespace {

using Kind = PatternTexture::Kind;

constexpr double deviation = 0.26 / 0.117;  // of POV-Ray's vectors over that of the noise here

Vector3d noises(Point3d p) { return lattice_noises(p) * deviation; }

Vector3d wrinkles(Point3d p) {
  constexpr int octaves = 10;
  Vector3d sum;
  double scale = 1;
  for (int i = 0; i < octaves; ++i, scale *= 2) {
    const Vector3d n = noises({p.x * scale, p.y * scale, p.z * scale});
    sum = sum + Vector3d{std::abs(n.x), std::abs(n.y), std::abs(n.z)} * (1 / scale);
  }
  return sum;
}

constexpr int sources = 10;
constexpr std::uint64_t numbers_of_directions = 7;  // of the numbers of a cell

// In a random direction from the origin, 1 away from it: where POV-Ray's waves come from.
Vector3d source(int i) {
  const CellNumbers n = numbers_of_cell(i, 0, 0, numbers_of_directions);
  const double y = 2 * n.x - 1, r = std::sqrt(1 - y * y), turn = 2 * n.y;
  return {r * sin_pi(turn + 0.5), y, r * sin_pi(turn)};
}

// frequency(i): of source i, whose waves are as high as they are long.
template <class F>
Vector3d rings(const PatternTexture& t, Point3d p, const F& frequency) {
  Vector3d sum;
  for (int i = 0; i < sources; ++i) {
    const Vector3d way = Vector3d{p.x, p.y, p.z} - source(i);
    const double distance = length(way), f = frequency(i);
    if (!(distance > 0)) continue;
    const double turns = distance * f * static_cast<double>(t.frequency) + static_cast<double>(t.phase);
    sum = sum + way * (sin_pi(2 * (turns - std::floor(turns))) / (f * distance));
  }
  return sum * (1.0 / sources);
}

}  // namespace

bool pushes_by_itself(Kind kind) {
  return kind == Kind::bumps || kind == Kind::dents || kind == Kind::ripples || kind == Kind::waves ||
         kind == Kind::wrinkles;
}

Vector3d push_of_pattern(const PatternTexture& t, Point3d at) {
  const Point3d p = moved_in_pattern(t, at);
  switch (t.kind) {
    case Kind::bumps:
      return noises(p);
    case Kind::dents: {
      const double noise = narrow_noise(p);
      return noises(p) * (noise * noise * noise);
    }
    case Kind::wrinkles:
      return wrinkles(p);
    case Kind::ripples:
      return rings(t, p, [](int) { return 1.0; });
    case Kind::waves:
      return rings(t, p, [](int i) { return 0.16 + 0.1 * i; });
    default:
      return {};
  }
}

Vector3d tilted_normal(const PatternTexture& t, Vector3d n, Vector3d v) {
  const auto& m = t.texture_to_world.m;
  const Vector3d inside = normalize(Vector3d{m[0][0] * n.x + m[1][0] * n.y + m[2][0] * n.z,
                                             m[0][1] * n.x + m[1][1] * n.y + m[2][1] * n.z,
                                             m[0][2] * n.x + m[1][2] * n.y + m[2][2] * n.z}) +
                          v;
  const Normal3d tilted = transform_normal(t.texture_to_world, Normal3d{inside.x, inside.y, inside.z});
  return {tilted.x, tilted.y, tilted.z};
}

}  // namespace vitrail
