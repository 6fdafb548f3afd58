// SPDX-License-Identifier: Apache-2.0
#include "importers/images/cube_faces.h"

#include <algorithm>
#include <cmath>

namespace vitrail {

namespace {

Transform transform_of_columns(Vector3d x, Vector3d y, Vector3d z) {
  Transform t;
  t.m[0] = {x.x, y.x, z.x, 0};
  t.m[1] = {x.y, y.y, z.y, 0};
  t.m[2] = {x.z, y.z, z.z, 0};
  return t;
}

Image face_image(const Image& picture, EnvironmentProjection projection, const Transform& to_picture,
                 int side, int cosine_power) {
  constexpr int samples = 4;  // across a pixel
  Image face = black_image(side, side, picture.channels);
  float* to = face.values.data();
  for (int y = 0; y < side; ++y)
    for (int x = 0; x < side; ++x, to += picture.channels)
      for (int s = 0; s < samples * samples; ++s) {
        const int column = s % samples, row = s / samples;
        const double px = 2 * (x + (column + 0.5) / samples) / side - 1;
        const double py = 1 - 2 * (y + (row + 0.5) / samples) / side;
        const Point2d point = point_of(projection, normalize(transform_vector(to_picture, {px, py, 1})));
        const double share = std::pow(1 + px * px + py * py, -0.5 * cosine_power) / (samples * samples);
        for (int c = 0; c < picture.channels; ++c)
          to[c] += static_cast<float>(share * environment_lookup(picture, projection, point, c));
      }
  return face;
}

}  // namespace

std::vector<CubeFace> cube_faces(const Image& picture, EnvironmentProjection projection, int cosine_power) {
  const int side = std::clamp(picture.height, 128, 2048);
  const Vector3d axes[] = {{1, 0, 0}, {0, 1, 0}, {0, 0, 1}};
  std::vector<CubeFace> faces;
  for (int i = 0; i < 6; ++i) {
    const Vector3d x = axes[(i + 1) % 3], z = i < 3 ? axes[i] : -axes[i % 3];
    const Transform to_picture = transform_of_columns(x, cross(z, x), z);
    Image image = face_image(picture, projection, to_picture, side, cosine_power);
    if (std::ranges::any_of(image.values, [](float v) { return v > 0; }))
      faces.push_back({to_picture, std::move(image)});
  }
  return faces;
}

}  // namespace vitrail
