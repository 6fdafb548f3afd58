// SPDX-License-Identifier: Apache-2.0
#include "importers/images/converted_images.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "importers/writing/export_colors.h"
#include "importers/writing/spot_falloff.h"
#include "scene/spectra/color.h"

namespace vitrail {

namespace {

// The index that stands for one outside of the image; nothing where it is black.
std::optional<int> wrapped(int i, int count, Wrap wrap) {
  const int turn = (i % count + count) % count;
  switch (wrap) {
    case Wrap::repeat:
      return turn;
    case Wrap::mirror:
      return (i / count - (i < 0 && i % count != 0 ? 1 : 0)) % 2 == 0 ? turn : count - 1 - turn;
    case Wrap::clamp:
      return std::clamp(i, 0, count - 1);
    default:
      return i == turn ? std::optional(i) : std::nullopt;
  }
}

// Looks up (s,t), t up from the lower edge, as a texture does on its finest level.
class Sampler {
 public:
  Sampler(const Image& image, const ImageTexture& texture)
      : image_(image), wrap_(texture.wrap), nearest_(texture.filter == TextureFilter::nearest) {}

  void add(double s, double t, float* to) const {
    const double x = s * image_.width - 0.5, y = (1 - t) * image_.height - 0.5;
    if (nearest_) return add_texel(std::lround(x), std::lround(y), 1, to);
    const double left = std::floor(x), top = std::floor(y), fx = x - left, fy = y - top;
    const auto x0 = static_cast<long>(left), y0 = static_cast<long>(top);
    add_texel(x0, y0, (1 - fx) * (1 - fy), to);
    add_texel(x0 + 1, y0, fx * (1 - fy), to);
    add_texel(x0, y0 + 1, (1 - fx) * fy, to);
    add_texel(x0 + 1, y0 + 1, fx * fy, to);
  }

 private:
  void add_texel(long x, long y, double share, float* to) const {
    const auto column = wrapped(static_cast<int>(x), image_.width, wrap_);
    const auto row = wrapped(static_cast<int>(y), image_.height, wrap_);
    if (!column || !row) return;
    const auto channels = static_cast<std::size_t>(image_.channels);
    const std::size_t pixel = static_cast<std::size_t>(*row) * static_cast<std::size_t>(image_.width) +
                              static_cast<std::size_t>(*column);
    for (std::size_t c = 0; c < channels; ++c)
      to[c] += static_cast<float>(share * static_cast<double>(image_.values[pixel * channels + c]));
  }

  const Image& image_;
  Wrap wrap_;
  bool nearest_;
};

// As many texels along u (v) as the texture has under it.
int size_along(double ds, double dt, const Image& image) {
  constexpr double most = 8192;
  return static_cast<int>(std::clamp(
      std::ceil(std::max(std::abs(ds) * image.width, std::abs(dt) * image.height) - 1e-6), 1.0, most));
}

Image mapped(const Image& image, const ImageTexture& texture, const UvMapping& m) {
  const double a = static_cast<double>(m.a), b = static_cast<double>(m.b), c = static_cast<double>(m.c);
  const double d = static_cast<double>(m.d), e = static_cast<double>(m.e), f = static_cast<double>(m.f);
  Image result = black_image(size_along(a, d, image), size_along(b, e, image), image.channels);
  const Sampler sampler(image, texture);
  float* to = result.values.data();
  for (int y = 0; y < result.height; ++y)
    for (int x = 0; x < result.width; ++x, to += image.channels) {
      const double u = (x + 0.5) / result.width, v = 1 - (y + 0.5) / result.height;
      sampler.add(a * u + b * v + c, d * u + e * v + f, to);
    }
  return result;
}

// Colours, of that many texels.
Image resized(Image image, const ImageTexture& texture, int width, int height) {
  image = with_three_channels(std::move(image));
  if (image.width == width && image.height == height) return image;
  Image result = black_image(width, height, image.channels);
  const Sampler sampler(image, texture);
  float* to = result.values.data();
  for (int y = 0; y < height; ++y)
    for (int x = 0; x < width; ++x, to += image.channels)
      sampler.add((x + 0.5) / width, 1 - (y + 0.5) / height, to);
  return result;
}

Image under_spot(Image image, const ImageTexture& texture, const SpotLight& spot) {
  const int side = std::max({image.width, image.height, 512});
  image = resized(std::move(image), texture, side, side);
  const double half = std::tan(static_cast<double>(spot.cutoff_deg) / 180 * std::numbers::pi);
  float* value = image.values.data();
  for (int y = 0; y < side; ++y)
    for (int x = 0; x < side; ++x) {
      const double px = (2 * (x + 0.5) / side - 1) * half, py = (2 * (y + 0.5) / side - 1) * half;
      const double share = spot_falloff(spot, std::atan(std::hypot(px, py)));
      for (int c = 0; c < image.channels; ++c, ++value)
        *value = static_cast<float>(static_cast<double>(*value) * share);
    }
  return image;
}

}  // namespace

void multiply_by_cosine(Image& image, int power, Point2d half) {
  float* value = image.values.data();
  for (int y = 0; y < image.height; ++y)
    for (int x = 0; x < image.width; ++x) {
      const double px = (2 * (x + 0.5) / image.width - 1) * half.x,
                   py = (2 * (y + 0.5) / image.height - 1) * half.y;
      const double factor = std::pow(1 + px * px + py * py, -0.5 * power);
      for (int c = 0; c < image.channels; ++c, ++value)
        *value = static_cast<float>(static_cast<double>(*value) * factor);
    }
}

void multiply(Image& image, RGB tint) {
  const std::array factors{tint.r, tint.g, tint.b};
  const auto channels = static_cast<std::size_t>(image.channels);
  for (std::size_t i = 0; i < image.values.size(); ++i)
    image.values[i] = static_cast<float>(static_cast<double>(image.values[i]) * factors[i % channels]);
}

Point2d half_size(const ProjectionLight& light, double aspect) {
  const double half = std::tan(static_cast<double>(light.fov_deg) / 360 * std::numbers::pi);
  return light.irradiance || aspect < 1 ? Point2d{half, half / aspect} : Point2d{half * aspect, half};
}

UvMapping composed(const UvMapping& m, const UvMapping& n) {
  return {m.a * n.a + m.b * n.d, m.a * n.b + m.b * n.e, m.a * n.c + m.b * n.f + m.c,
          m.d * n.a + m.e * n.d, m.d * n.b + m.e * n.e, m.d * n.c + m.e * n.f + m.f};
}

double thrown_flux(const Image& image, Point2d half) {
  double sum = 0;
  for (std::size_t i = 0; i + 2 < image.values.size(); i += 3)
    sum += srgb_to_xyz({image.values[i], image.values[i + 1], image.values[i + 2]}).y;
  return 4 * half.x * half.y * sum / static_cast<double>(std::max<std::size_t>(image.pixels(), 1));
}

Image with_three_channels(Image image) {
  if (image.channels != 1) return image;
  Image result = black_image(image.width, image.height, 3);
  for (std::size_t i = 0; i < result.values.size(); ++i) result.values[i] = image.values[i / 3];
  return result;
}

ConvertedImages::Key ConvertedImages::key_of(const ImageTexture& t, ImageUse use, const ImageChange& change) {
  const UvMapping& m = change.mapping;
  const auto f = [](double v) { return static_cast<float>(v); };
  return {t.filename,
          t.encoding,
          use == ImageUse::number ? t.number : ImageNumber{},
          t.primaries,
          m == UvMapping{} ? Wrap{} : t.wrap,
          m == UvMapping{} ? TextureFilter{} : t.filter,
          use,
          t.invert,
          change.three_channels,
          {t.gamma, t.scale, f(change.tint.r), f(change.tint.g), f(change.tint.b), m.a, m.b, m.c, m.d, m.e,
           m.f, static_cast<float>(change.cosine_power), f(change.half.x), f(change.half.y),
           change.spot ? change.spot->beam_deg : 0, change.spot ? change.spot->cutoff_deg : 0,
           change.spot ? static_cast<float>(change.spot->falloff) : 0}};
}

std::filesystem::path ConvertedImages::write(const ImageTexture& texture, ImageUse use,
                                             const ImageChange& change) {
  const Key key = key_of(texture, use, change);
  if (const auto known = written_.find(key); known != written_.end()) return known->second;
  Image values = texture_values(texture, read_stored_image(texture.filename), use);
  const bool is_colored = change.tint.r != change.tint.g || change.tint.g != change.tint.b;
  if (is_colored || change.three_channels) values = with_three_channels(std::move(values));
  if (change.tint != RGB{1, 1, 1}) multiply(values, change.tint);
  if (change.mapping != UvMapping{}) values = mapped(values, texture, change.mapping);
  if (change.spot) values = under_spot(std::move(values), texture, *change.spot);
  if (change.cosine_power != 0) {
    const int finer = (511 + std::max(values.width, values.height)) / std::max(values.width, values.height);
    const int width = finer * values.width, height = finer * values.height;
    if (finer > 1) values = resized(std::move(values), texture, width, height);
    multiply_by_cosine(values, change.cosine_power, change.half);
  }
  const std::filesystem::path file = new_file_();
  write_exr_image(file, values);
  return written_[key] = file;
}

std::filesystem::path ConvertedImages::write(const ImagePair& pair) {
  const auto values_of = [](const TintedImage& t) {
    return texture_values(t.image, read_stored_image(t.image.filename),
                          t.is_number ? ImageUse::number : ImageUse::color);
  };
  const Image first = values_of(pair.first), second = values_of(pair.second);
  const int width = std::max(first.width, second.width), height = std::max(first.height, second.height);
  Image product = resized(first, pair.first.image, width, height);
  const Image factor = resized(second, pair.second.image, width, height);
  for (std::size_t i = 0; i < product.values.size(); ++i) product.values[i] *= factor.values[i];
  const RGB &a = pair.first.tint, &b = pair.second.tint;
  multiply(product, {a.r * b.r, a.g * b.g, a.b * b.b});
  std::filesystem::path file = new_file_();
  write_exr_image(file, product);
  return file;
}

std::optional<ImagePair> image_pair(const Scene& scene, const ProductTexture& product) {
  const auto *first = std::get_if<Id<Texture>>(&product.first),
             *second = std::get_if<Id<Texture>>(&product.second);
  if (!first || !second) return {};
  const auto a = tinted_image(scene, *first), b = tinted_image(scene, *second);
  if (!a || !b || a->image.mapping != b->image.mapping || a->image.wrap != b->image.wrap ||
      a->image.filter != b->image.filter)
    return {};
  return ImagePair{*a, *b};
}

std::optional<TintedImage> tinted_image(const Scene& scene, Id<Texture> id) {
  const Texture& texture = scene.textures.at(id.value);
  if (const auto* image = std::get_if<ImageTexture>(&texture.model))
    return TintedImage{*image, texture.is_float, {1, 1, 1}};
  const auto* product = std::get_if<ProductTexture>(&texture.model);
  return product ? tinted_image(scene, *product) : std::nullopt;
}

std::optional<TintedImage> tinted_image(const Scene& scene, const ProductTexture& product) {
  const bool swapped = std::holds_alternative<Id<Texture>>(product.second);
  const auto* inner = std::get_if<Id<Texture>>(swapped ? &product.second : &product.first);
  const auto* factor = std::get_if<Spectrum>(swapped ? &product.first : &product.second);
  if (!inner || !factor) return {};
  std::optional<TintedImage> tinted = tinted_image(scene, *inner);
  if (!tinted) return {};
  const RGB c = factor_rgb(*factor);
  tinted->tint = {tinted->tint.r * c.r, tinted->tint.g * c.g, tinted->tint.b * c.b};
  return tinted;
}

}  // namespace vitrail
