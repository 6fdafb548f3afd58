// SPDX-License-Identifier: Apache-2.0
// Pictures of few pixels, unlike in both directions, so that nothing that is turned or mirrored looks alike.
#include <cmath>

#include "film/image_io.h"
#include "images/image_files.h"
#include "tests/conformance/gate/scene_parts.h"

namespace vitrail::test {

namespace {

template <class Value>
Image painted(int width, int height, int channels, Value&& value) {
  Image image = black_image(width, height, channels);
  for (int y = 0; y < height; ++y)
    for (int x = 0; x < width; ++x)
      for (int c = 0; c < channels; ++c)
        image.values[static_cast<std::size_t>((y * width + x) * channels + c)] =
            static_cast<float>(value((x + 0.5) / width, (y + 0.5) / height, c));
  return image;
}

// Bright at the upper left, red to the right, blue to the bottom.
double pattern(double x, double y, int channel) {
  const double corner = x < 0.5 && y < 0.5 ? 0.4 : 0.1;
  return corner + (channel == 0 ? 0.5 * x : channel == 2 ? 0.4 * y : 0.2 * x * y);
}

// A tilted plane and a bump, tangent space, (n + 1)/2.
double normal(double x, double y, int channel) {
  const double nx = 0.3 * std::cos(6 * x), ny = 0.25 * std::sin(5 * y), nz = std::sqrt(1 - nx * nx - ny * ny);
  return ((channel == 0 ? nx : channel == 1 ? ny : nz) + 1) / 2;
}

// The numbers as they are to stand in an 8-bit file, which is written through sRGB.
double decoded(double stored) {
  return stored <= 0.04045 ? stored / 12.92 : std::pow((stored + 0.055) / 1.055, 2.4);
}

void write(const std::filesystem::path& file, Image image) {
  Picture picture;
  picture.rgb = std::move(image);
  write_picture(file, picture);
}

}  // namespace

void write_part_images(const std::filesystem::path& folder) {
  write(folder / "a.png", painted(8, 8, 3, pattern));
  write(folder / "b.png",
        painted(4, 6, 3, [](double x, double y, int c) { return pattern(1 - y, x, 2 - c); }));
  write(folder / "grey.png",
        painted(8, 8, 3, [](double x, double y, int) { return decoded(pattern(x, y, 0)); }));
  write(folder / "normal.png",
        painted(16, 16, 3, [](double x, double y, int c) { return decoded(normal(x, y, c)); }));
  write_exr_image(folder / "a.exr", painted(8, 8, 3, pattern));
  write_exr_image(folder / "grey.exr", painted(8, 8, 1, pattern));
  write_exr_image(folder / "sky.exr", painted(32, 16, 3, pattern));
  write_exr_image(folder / "octahedron.exr", painted(16, 16, 3, pattern));
  write_exr_image(folder / "lamp.exr", painted(16, 16, 1, pattern));
}

}  // namespace vitrail::test
