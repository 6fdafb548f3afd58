// SPDX-License-Identifier: Apache-2.0
#include "importers/images/environment_images.h"

#include <gmock/gmock.h>

#include <cmath>
#include <numbers>

#include "images/image_files.h"
#include "importers/images/cube_faces.h"
#include "importers/images/mean_intensity.h"
#include "scene/geometry/pi.h"
#include "scene/system/diagnostics.h"
#include "tests/importers/temporary_folder.h"

namespace vitrail::environment_images_test {
namespace {

constexpr EnvironmentProjection projections[] = {EnvironmentProjection::equal_area,
                                                 EnvironmentProjection::latitude_longitude};

template <class F>
Image image_of(EnvironmentProjection projection, int height, F&& f) {
  Image image = black_image(projection == EnvironmentProjection::equal_area ? height : 2 * height, height, 1);
  for (std::size_t pixel = 0; pixel < image.pixels(); ++pixel) {
    const auto width = static_cast<std::size_t>(image.width);
    image.values[pixel] = static_cast<float>(f(direction_of(
        projection, pixel_point(projection, image.width, height, static_cast<double>(pixel % width),
                                static_cast<double>(pixel / width)))));
  }
  return image;
}

// ∫ L dω of what a renderer sees, which looks the image up: over 6 × 6 points of each pixel.
double total(const Image& image, EnvironmentProjection projection) {
  constexpr int side = 6;
  double sum = 0, weights = 0;
  for (int y = 0; y < side * image.height; ++y)
    for (int x = 0; x < side * image.width; ++x) {
      const Point2d point{(x + 0.5) / (side * image.width), (y + 0.5) / (side * image.height)};
      const double weight =
          projection == EnvironmentProjection::equal_area ? 1 : std::sin(std::numbers::pi * point.y);
      weights += weight;
      sum += weight * environment_lookup(image, projection, point, 0);
    }
  return 4 * std::numbers::pi * sum / weights;
}

TEST(EnvironmentImages, DirectionsAndPointsAreInverse) {
  for (const auto projection : projections)
    for (int i = 0; i < 400; ++i) {
      const double z = 1 - 2 * (i + 0.5) / 400, phi = 2.4 * i, r = std::sqrt(1 - z * z);
      const Vector3d d{r * std::cos(phi), r * std::sin(phi), z};
      const Vector3d back = direction_of(projection, point_of(projection, d));
      EXPECT_LT(length(back - d), 1e-7) << d.x << ' ' << d.y << ' ' << d.z;
    }
}

// Corners and centre of the square: Clarberg 2008, figure 2.
TEST(EnvironmentImages, LandmarksOfTheMaps) {
  const auto near = [](Vector3d a, Vector3d b) { return length(a - b) < 1e-9; };
  EXPECT_TRUE(near(direction_of(projections[0], {0.5, 0.5}), {0, 0, 1}));
  EXPECT_TRUE(near(direction_of(projections[0], {0, 0}), {0, 0, -1}));
  EXPECT_TRUE(near(direction_of(projections[0], {1, 0.5}), {1, 0, 0}));
  EXPECT_TRUE(near(direction_of(projections[0], {0.5, 1}), {0, 1, 0}));
  EXPECT_TRUE(near(direction_of(projections[1], {0, 0.5}), {1, 0, 0}));
  EXPECT_TRUE(near(direction_of(projections[1], {0.25, 0.5}), {0, 1, 0}));
  EXPECT_TRUE(near(direction_of(projections[1], {0.6, 0}), {0, 0, 1}));
}

// Equal pieces of the square are equal solid angles: the mean of z², and of z over a half.
TEST(EnvironmentImages, TheSquareIsOfEqualArea) {
  const Image z2 = image_of(projections[0], 256, [](Vector3d d) { return d.z * d.z; });
  EXPECT_NEAR(total(z2, projections[0]), 4 * pi / 3, 1e-3);
}

TEST(EnvironmentImages, LookupsGoOnAcrossTheEdges) {
  const auto smooth = [](Vector3d d) { return 2 + d.x + 0.5 * d.y * d.z; };
  for (const auto projection : projections) {
    const Image image = image_of(projection, 128, smooth);
    for (int i = 0; i <= 100; ++i) {
      const double a = i / 100.0;
      for (const Point2d p : {Point2d{a, 0}, Point2d{a, 1}, Point2d{0, a}, Point2d{1, a}, Point2d{a, a}})
        EXPECT_NEAR(environment_lookup(image, projection, p, 0), smooth(direction_of(projection, p)), 0.05)
            << p.x << ' ' << p.y;
    }
  }
}

TEST(EnvironmentImages, ReprojectionKeepsValuesAndEnergy) {
  const auto smooth = [](Vector3d d) { return 1 + d.x + std::exp(20 * (d.y - 1)); };
  for (int i = 0; i < 2; ++i) {
    const auto from = projections[i], to = projections[1 - i];
    const Image source = image_of(from, 128, smooth), result = reproject(source, from, to);
    EXPECT_EQ(result.width, to == EnvironmentProjection::equal_area ? 256 : 512);
    const Image expected = image_of(to, 256, smooth);
    for (std::size_t p = 0; p < expected.values.size(); ++p)
      ASSERT_NEAR(result.values[p], expected.values[p], 0.04) << p;
    EXPECT_NEAR(total(result, to) / total(source, from), 1, 5e-3);
  }
}

// A sun of five pixels, on the seams and near the poles too. Right on a pole the bilinear lookup itself,
// between rows that shrink to a point, is off by up to 2 %.
TEST(EnvironmentImages, EnergyOfASmallSun) {
  for (int i = 0; i < 2; ++i)
    for (const Vector3d sun : {Vector3d{0.3, 0.5, 0.8}, Vector3d{0.1, 0.1, 1}, Vector3d{0, 0, 1},
                               Vector3d{0, 0, -1}, Vector3d{1, 0, 0}, Vector3d{-1, -0.01, 0}}) {
      const auto from = projections[i], to = projections[1 - i];
      const Image source = image_of(
          from, 128, [s = normalize(sun)](Vector3d d) { return dot(s, d) > std::cos(0.06) ? 1000 : 0; });
      const Image result = reproject(source, from, to);
      const double tolerance = sun.x == 0 ? 0.02 : 5e-3;
      EXPECT_NEAR(total(result, to) / total(source, from), 1, tolerance)
          << i << ": " << sun.x << ' ' << sun.y << ' ' << sun.z;
    }
}

TEST(EnvironmentImages, Illuminance) {
  for (const auto projection : projections) {
    EXPECT_NEAR(upward_illuminance(image_of(projection, 64, [](Vector3d) { return 2.0; }), projection),
                2 * pi, 5e-3);
    EXPECT_NEAR(upward_illuminance(image_of(projection, 64, [](Vector3d d) { return 1 + d.z; }), projection),
                pi + 2 * pi / 3, 5e-3);
  }
}

// Every texel of every face is what the picture has there; five faces of a light that shines upwards.
TEST(EnvironmentImages, FacesOfACube) {
  const auto smooth = [](Vector3d d) { return 2 + d.x + 0.5 * d.y * d.z; };
  for (const auto projection : projections) {
    const Image picture = image_of(projection, 256, smooth);
    const std::vector<CubeFace> faces = cube_faces(picture, projection, 3);
    ASSERT_EQ(faces.size(), 6u);
    for (const CubeFace& face : faces)
      for (const auto& [x, y] : {std::pair{0, 0}, {255, 0}, {10, 240}, {128, 128}}) {
        const Vector3d local{2 * (x + 0.5) / 256 - 1, 1 - 2 * (y + 0.5) / 256, 1};
        EXPECT_NEAR(face.image.values.at(static_cast<std::size_t>(y * 256 + x)),
                    smooth(normalize(transform_vector(face.to_picture, local))) / std::pow(length(local), 3),
                    0.02);
      }
    const Image up = image_of(projection, 64, [](Vector3d d) { return d.z > 0.1 ? 1.0 : 0.0; });
    EXPECT_EQ(cube_faces(up, projection, 3).size(), 5u);
  }
}

TEST(ImageFiles, RowsAreThoseOfTheWhole) {
  TemporaryFolder folder;
  Image image = black_image(2048, 700, 3);
  for (std::size_t i = 0; i < image.values.size(); ++i) image.values[i] = static_cast<float>(i % 1009);
  write_exr_image(folder / "a.exr", image);
  Image rows{2048, 0, 3, {}};
  int visits = 0;
  read_stored_rows(folder / "a.exr", [&](const StoredImage& some) {
    ++visits;
    EXPECT_FALSE(some.integer);
    EXPECT_EQ(some.image.width, 2048);
    rows.height += some.image.height;
    rows.values.insert(rows.values.end(), some.image.values.begin(), some.image.values.end());
  });
  EXPECT_GT(visits, 2);
  EXPECT_EQ(rows, image);
  folder.write("b.exr", "no image");
  EXPECT_THROW(read_stored_rows(folder / "b.exr", [](StoredImage) {}), Error);
}

TEST(ImageFiles, RoundTripAndErrors) {
  TemporaryFolder folder;
  Image image = black_image(3, 2, 3);
  for (std::size_t i = 0; i < image.values.size(); ++i) image.values[i] = 0.1f * static_cast<float>(i);
  write_exr_image(folder / "a.exr", image);
  EXPECT_EQ(read_linear_image(folder / "a.exr"), image);
  EXPECT_FALSE(read_stored_image(folder / "a.exr").integer);
  const ImageLayout layout = read_image_layout(folder / "a.exr");
  EXPECT_EQ(layout.width, 3);
  EXPECT_EQ(layout.channels, 3);
  folder.write("b.exr", "no image");
  EXPECT_THROW(read_stored_image(folder / "b.exr"), Error);
  EXPECT_THROW(read_image_layout(folder / "none.png"), Error);
  EXPECT_THROW(write_exr_image(folder / "none" / "a.exr", image), MachineError);
}

// A lamp that shines up alone, as a point light of the same flux.
TEST(MeanIntensity, IsThatOfTheSameFlux) {
  const TemporaryFolder folder;
  for (const EnvironmentProjection projection : projections) {
    GoniometricLight light;
    light.filename = (folder / "lamp.exr").string();
    light.latitude_longitude = projection == EnvironmentProjection::latitude_longitude;
    write_exr_image(light.filename, image_of(projection, 64, [](Vector3d d) { return d.z > 0 ? 8.0 : 0.0; }));
    EXPECT_NEAR(mean_intensity(light).mean, 4, .2) << "half a pixel at the edge";
    EXPECT_EQ(mean_intensity(light).greatest, 8);
    light.power = static_cast<float>(4 * pi * 3);
    EXPECT_NEAR(mean_intensity(light).mean, 3, 1e-5);
    EXPECT_NEAR(mean_intensity(light).greatest, 6, .2);
  }
}

}  // namespace
}  // namespace vitrail::environment_images_test
