// SPDX-License-Identifier: Apache-2.0
// Mitsuba 0.6's height fields.
#include <fmt/format.h>

#include <bit>
#include <cmath>

#include "images/texture_values.h"
#include "importers/mitsuba/read/shape_geometry.h"
#include "importers/shapes/grid_surfaces.h"

namespace vitrail::mitsuba {

namespace {

// Heights, a row of x after the other; the image's upper row is y = −1.
struct Heights {
  std::size_t width = 2, height = 2;
  std::vector<double> z;
  double at(std::size_t x, std::size_t y) const { return z[y * width + x]; }
};

// Of 2ⁿ + 1 values: 0.6 brings others to the next such size, by Lanczos' filter. Here between two pixels.
Heights resampled(const Image& image, double scale) {
  const auto grid = [](int pixels) {
    return std::bit_ceil(static_cast<unsigned>(std::max(pixels, 2) - 1)) + 1;
  };
  Heights h{grid(image.width), grid(image.height), {}};
  struct Between {
    int low, high;
    double share;
  };
  const auto place = [](std::size_t i, std::size_t count, int pixels) {
    const double x = std::clamp((static_cast<double>(i) + 0.5) * pixels / static_cast<double>(count) - 0.5,
                                0.0, static_cast<double>(pixels - 1));
    const int low = std::min(static_cast<int>(x), std::max(pixels - 2, 0));
    return Between{low, std::min(low + 1, pixels - 1), x - low};
  };
  const auto value = [&](int x, int y) {
    return scale * static_cast<double>(
                       image.values[static_cast<std::size_t>(y) * static_cast<std::size_t>(image.width) +
                                    static_cast<std::size_t>(x)]);
  };
  for (std::size_t y = 0; y < h.height; ++y)
    for (std::size_t x = 0; x < h.width; ++x) {
      const Between u = place(x, h.width, image.width), v = place(y, h.height, image.height);
      h.z.push_back(std::lerp(std::lerp(value(u.low, v.low), value(u.high, v.low), u.share),
                              std::lerp(value(u.low, v.high), value(u.high, v.high), u.share), v.share));
    }
  return h;
}

// Greatest height of a bilinear patch over the two triangles of its corners: in the middle of their edge.
double greatest_bend(const Heights& h) {
  double most = 0;
  for (std::size_t y = 0; y + 1 < h.height; ++y)
    for (std::size_t x = 0; x + 1 < h.width; ++x)
      most = std::max(most, std::abs(h.at(x, y) + h.at(x + 1, y + 1) - h.at(x + 1, y) - h.at(x, y + 1)) / 4);
  return most;
}

// As 0.6 makes them: the sums of the unit normals that the patches around a vertex have there, over cells of
// size 1.
std::vector<Normal3f> normals_of(const Heights& h) {
  std::vector<Vector3d> sums(h.z.size());
  const auto add = [&](std::size_t x, std::size_t y, double dx, double dy) {
    sums[y * h.width + x] = sums[y * h.width + x] + normalize(Vector3d{-dx, -dy, 1});
  };
  for (std::size_t y = 0; y + 1 < h.height; ++y)
    for (std::size_t x = 0; x + 1 < h.width; ++x) {
      const double z00 = h.at(x, y), z10 = h.at(x + 1, y), z01 = h.at(x, y + 1), z11 = h.at(x + 1, y + 1);
      add(x, y, z10 - z00, z01 - z00), add(x + 1, y, z10 - z00, z11 - z10);
      add(x, y + 1, z11 - z01, z01 - z00), add(x + 1, y + 1, z11 - z01, z11 - z10);
    }
  const double nx = static_cast<double>(h.width - 1), ny = static_cast<double>(h.height - 1);
  std::vector<Normal3f> normals;
  for (const Vector3d& n : sums) {  // over the unit square
    const Vector3d there = normalize(Vector3d{n.x * nx, n.y * ny, n.z});
    normals.push_back(
        {static_cast<float>(there.x), static_cast<float>(there.y), static_cast<float>(there.z)});
  }
  return normals;
}

// Of the file that it names, or of the bitmap within it; nothing for other textures.
std::optional<ImageTexture> heights_image(Builder& builder, const Object& shape) {
  const Object* nested = shape.child("texture");
  if (!nested) {
    ImageTexture image;
    image.filename = shape_file(builder, shape).string();
    image.number = ImageNumber::luminance;
    return image;
  }
  const Id<Texture> id = add_texture(builder, *nested, true);
  const auto* image = std::get_if<ImageTexture>(&builder.scene.textures[id.value].model);
  if (image) return *image;
  builder.report.dropped("shape \"heightfield\" of a texture that is no bitmap is left out", shape.origin);
  return std::nullopt;
}

}  // namespace

// Over [−1,1]² of the object's space, the front towards +z.
std::optional<ShapeGeometry> height_shape(Builder& builder, const Object& shape) {
  if (kind_of(shape) != "heightfield") return std::nullopt;
  const double scale = shape.number("scale", 1, builder.report);
  const bool smooth = shape.boolean("shading_normals", true, builder.report);
  shape.ignore({"width", "height"});  // of procedural textures
  const std::optional<ImageTexture> image = heights_image(builder, shape);
  if (!image) return std::nullopt;
  std::string said = fmt::format("shape \"heightfield\": triangles in place of its bilinear patches");
  const auto make = [&] {
    const Image values = texture_values(*image, read_stored_image(image->filename), ImageUse::number);
    for (const float v : values.values)
      if (!std::isfinite(v)) throw Error("a height is not finite", {image->filename});
    const Heights h = resampled(values, scale);
    said += fmt::format(", at most {:.2g} in height from them", greatest_bend(h));
    if (h.width != static_cast<std::size_t>(values.width) ||
        h.height != static_cast<std::size_t>(values.height))
      said +=
          fmt::format("; its {} × {} heights become {} × {} between the two next, in 0.6 by Lanczos' filter",
                      values.width, values.height, h.width, h.height);
    TriangleMesh mesh = heightfield(static_cast<int>(h.width), static_cast<int>(h.height), h.z);
    if (smooth) mesh.normals = normals_of(h);
    return mesh;
  };
  const MeshKey key{fmt::format("{} × {}", image->filename, scale), smooth, 0};
  const Id<TriangleMesh> mesh = shared_mesh(builder, shape, key, make);
  builder.report.approximated(said, shape.origin);
  return ShapeGeometry{mesh, translate({-1, -1, 0}) * vitrail::scale({2, 2, 1}), false};
}

}  // namespace vitrail::mitsuba
