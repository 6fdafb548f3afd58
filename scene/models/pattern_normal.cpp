// SPDX-License-Identifier: Apache-2.0
#include "scene/models/pattern_normal.h"

#include <array>
#include <cmath>

#include "scene/geometry/portable_math.h"
#include "scene/models/pattern_noise.h"
#include "scene/models/pattern_shapes.h"

namespace vitrail {

namespace {

using Kind = PatternTexture::Kind;

Vector3d wrinkles(Point3d p) {
  constexpr int octaves = 10;
  Vector3d sum;
  double scale = 1;
  for (int i = 0; i < octaves; ++i, scale *= 2) {
    const Vector3d n = vector_noise({p.x * scale, p.y * scale, p.z * scale});
    sum = sum + Vector3d{std::abs(n.x), std::abs(n.y), std::abs(n.z)} * (1 / scale);
  }
  return sum;
}

// frequency(source): of the waves, which are as high as they are long.
template <class F>
Vector3d rings(const PatternTexture& t, Point3d p, const F& frequency) {
  Vector3d sum;
  for (std::size_t i = 0; i < wave_source_count; ++i) {
    const Vector3d way = Vector3d{p.x, p.y, p.z} - wave_source(i).place;
    const double distance = length(way), f = frequency(wave_source(i));
    if (!(distance > 0)) continue;
    const double turns = distance * f * static_cast<double>(t.frequency) + static_cast<double>(t.phase);
    sum = sum + way * (sin_pi(2 * (turns - std::floor(turns))) / (f * distance));
  }
  return sum * (1.0 / wave_source_count);
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
      return vector_noise(p);
    case Kind::dents: {
      const double noise = pattern_noise(p, t.noise);
      return vector_noise(p) * (noise * noise * noise);
    }
    case Kind::wrinkles:
      return wrinkles(p);
    case Kind::ripples:
      return rings(t, p, [](const WaveSource&) { return 1.0; });
    case Kind::waves:
      return rings(t, p, [](const WaveSource& source) { return source.frequency; });
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
