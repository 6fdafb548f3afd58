// SPDX-License-Identifier: Apache-2.0
#include "importers/images/baked_textures.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numeric>

#include "images/image_codec.h"
#include "images/texture_values.h"
#include "importers/writing/export_colors.h"
#include "scene/records/kinds.h"
#include "scene/system/atomic_file.h"

namespace vitrail {

namespace {

constexpr int least_texels = 512, most_texels = 4096, most_period = 16;

double fraction(double x) { return x - std::floor(x); }
bool is_whole(double x) { return std::abs(x - std::round(x)) < 1e-5; }
RGB mix(RGB a, RGB b, double amount) {
  return {a.r + (b.r - a.r) * amount, a.g + (b.g - a.g) * amount, a.b + (b.b - a.b) * amount};
}

// Along u or v.
struct Side {
  int period = 1;     // what repeats after that; 0: it does not repeat
  double texels = 0;  // that a unit of it needs
  int cells = 1;      // of a checkerboard in a period that begins at 0
};

// What a texture reads.
struct Inputs {
  std::vector<const UvMapping*> boards;
  std::vector<std::pair<const ImageTexture*, Image>> images;
  bool is_smooth = false, repeats = true;
};

// Values of a texture by (u,v).
class Values {
 public:
  Values(const Scene& scene, Id<Texture> id) : scene_(scene) { can_be_baked_ = gather(id); }

  bool can_be_baked() const { return can_be_baked_; }
  const Inputs& inputs() const { return inputs_; }

  RGB at(const SpectrumParameter& p, Point2d uv) const {
    if (const auto* spectrum = std::get_if<Spectrum>(&p)) return factor_rgb(*spectrum);
    return at(std::get<Id<Texture>>(p), uv);
  }
  RGB at(Id<Texture> id, Point2d uv) const {
    return std::visit([&](const auto& t) { return value(t, uv); },
                      static_cast<const TextureVariant&>(scene_.textures.at(id.value).model));
  }

 private:
  // ---- Whether all of it goes by (u,v)

  bool gather(const SpectrumParameter& p) {
    const auto* id = std::get_if<Id<Texture>>(&p);
    return !id || gather(*id);
  }
  bool gather(const FloatParameter& p) {
    const auto* id = std::get_if<Id<Texture>>(&p);
    return !id || gather(*id);
  }
  bool gather(Id<Texture> id) {
    const Texture& texture = scene_.textures.at(id.value);
    is_number_ = texture.is_float;
    return std::visit([this](const auto& t) { return gather_of(t); },
                      static_cast<const TextureVariant&>(texture.model));
  }
  bool gather_of(const ImageTexture& t) {
    if (!std::holds_alternative<UvMapping>(t.mapping)) return false;
    inputs_.is_smooth = inputs_.is_smooth || t.filter != TextureFilter::nearest;
    for (const auto& [known, image] : inputs_.images)
      if (known == &t) return true;
    try {
      inputs_.images.emplace_back(&t, texture_values(t, read_stored_image(t.filename),
                                                     is_number_ ? ImageUse::number : ImageUse::color));
    } catch (const Error&) {
      return false;
    }
    return true;
  }
  bool gather_of(const CheckerboardTexture& t) {
    const auto* m = std::get_if<UvMapping>(&t.mapping);
    if (t.solid || !m) return false;
    inputs_.boards.push_back(m);
    return gather(t.even) && gather(t.odd);
  }
  bool gather_of(const ProductTexture& t) { return gather(t.first) && gather(t.second); }
  bool gather_of(const MixTexture& t) { return gather(t.first) && gather(t.second) && gather(t.amount); }
  bool gather_of(const BilinearTexture& t) {
    inputs_.is_smooth = true, inputs_.repeats = false;
    return std::holds_alternative<UvMapping>(t.mapping) && gather(t.v00) && gather(t.v01) && gather(t.v10) &&
           gather(t.v11);
  }
  bool gather_of(const UvTexture& t) {
    inputs_.is_smooth = true, inputs_.repeats = inputs_.repeats && t.mapping == TextureMapping{};
    return std::holds_alternative<UvMapping>(t.mapping);
  }
  template <class T>
  bool gather_of(const T&) {
    return false;
  }

  // ---- Values

  static Point2d mapped(const TextureMapping& mapping, Point2d uv) {
    const auto& m = std::get<UvMapping>(mapping);
    const auto d = [](float x) { return static_cast<double>(x); };
    return {d(m.a) * uv.x + d(m.b) * uv.y + d(m.c), d(m.d) * uv.x + d(m.e) * uv.y + d(m.f)};
  }
  double number(const FloatParameter& p, Point2d uv) const {
    if (const auto* value = std::get_if<float>(&p)) return *value;
    return at(std::get<Id<Texture>>(p), uv).g;
  }

  // Of one side of n texels; −1: outside.
  static int texel(int i, int n, Wrap wrap) {
    if (wrap == Wrap::clamp) return std::clamp(i, 0, n - 1);
    if (wrap == Wrap::black) return i < 0 || i >= n ? -1 : i;
    const int period = wrap == Wrap::mirror ? 2 * n : n, at = ((i % period) + period) % period;
    return at < n ? at : period - 1 - at;
  }
  static RGB texel(const Image& image, int x, int y, Wrap wrap) {
    const int i = texel(x, image.width, wrap), j = texel(y, image.height, wrap);
    if (i < 0 || j < 0) return {};
    const auto at = (static_cast<std::size_t>(image.height - 1 - j) * static_cast<std::size_t>(image.width) +
                     static_cast<std::size_t>(i)) *
                    static_cast<std::size_t>(image.channels);
    const auto channel = [&](std::size_t c) {
      return static_cast<double>(image.values[at + (image.channels >= 3 ? c : 0)]);
    };
    return {channel(0), channel(1), channel(2)};
  }
  RGB value(const ImageTexture& t, Point2d uv) const {
    const Image& image = std::ranges::find(inputs_.images, &t, [](const auto& i) { return i.first; })->second;
    const Point2d st = mapped(t.mapping, uv);
    const double x = st.x * image.width, y = st.y * image.height;
    if (!(std::abs(x) < 1e9 && std::abs(y) < 1e9)) return {};
    if (t.filter == TextureFilter::nearest)
      return texel(image, static_cast<int>(std::floor(x)), static_cast<int>(std::floor(y)), t.wrap);
    const int i = static_cast<int>(std::floor(x - 0.5)), j = static_cast<int>(std::floor(y - 0.5));
    const double fx = fraction(x - 0.5), fy = fraction(y - 0.5);
    return mix(mix(texel(image, i, j, t.wrap), texel(image, i + 1, j, t.wrap), fx),
               mix(texel(image, i, j + 1, t.wrap), texel(image, i + 1, j + 1, t.wrap), fx), fy);
  }
  RGB value(const CheckerboardTexture& t, Point2d uv) const {
    const Point2d st = mapped(t.mapping, uv);
    return at(fraction((std::floor(st.x) + std::floor(st.y)) / 2) == 0 ? t.even : t.odd, uv);
  }
  RGB value(const ProductTexture& t, Point2d uv) const {
    const RGB a = at(t.first, uv), b = at(t.second, uv);
    return {a.r * b.r, a.g * b.g, a.b * b.b};
  }
  RGB value(const MixTexture& t, Point2d uv) const {
    return mix(at(t.first, uv), at(t.second, uv), number(t.amount, uv));
  }
  RGB value(const BilinearTexture& t, Point2d uv) const {
    const Point2d st = mapped(t.mapping, uv);
    return mix(mix(at(t.v00, uv), at(t.v10, uv), st.x), mix(at(t.v01, uv), at(t.v11, uv), st.x), st.y);
  }
  RGB value(const UvTexture& t, Point2d uv) const {
    const Point2d st = mapped(t.mapping, uv);
    return {fraction(st.x), fraction(st.y), 0};
  }
  template <class T>
  RGB value(const T&, Point2d) const {
    return {};  // not baked
  }

  const Scene& scene_;
  Inputs inputs_;
  bool is_number_ = false, can_be_baked_ = false;
};

// s and t of a unit along u (`axis` 0) or v.
Point2d step(const UvMapping& m, int axis) {
  return axis == 0 ? Point2d{static_cast<double>(m.a), static_cast<double>(m.d)}
                   : Point2d{static_cast<double>(m.b), static_cast<double>(m.e)};
}

bool repeats(const Inputs& inputs, int axis, int period) {
  const auto whole = [&](const UvMapping& m, double each) {
    const Point2d d = step(m, axis);
    return is_whole(d.x * period / each) && is_whole(d.y * period / each);
  };
  for (const UvMapping* board : inputs.boards) {
    const Point2d d = step(*board, axis);
    if (!whole(*board, 1) || !is_whole((d.x + d.y) * period / 2)) return false;
  }
  for (const auto& [texture, image] : inputs.images) {
    if (texture->wrap != Wrap::repeat && texture->wrap != Wrap::mirror) return false;
    if (!whole(std::get<UvMapping>(texture->mapping), texture->wrap == Wrap::mirror ? 2 : 1)) return false;
  }
  return inputs.repeats;
}

Side side_of(const Inputs& inputs, int axis) {
  Side side;
  while (side.period <= most_period && !repeats(inputs, axis, side.period)) ++side.period;
  if (side.period > most_period) side.period = 0;
  const int length = std::max(side.period, 1);
  for (const UvMapping* board : inputs.boards) {
    const Point2d d = step(*board, axis);
    const double cells = std::max(std::abs(d.x), std::abs(d.y)) * length;
    if (is_whole(cells) && cells >= 1 && cells <= most_texels)
      side.cells = std::min(std::lcm(side.cells, static_cast<int>(std::round(cells))), most_texels);
    side.texels = std::max(side.texels, 8 * cells / length);
  }
  for (const auto& [texture, image] : inputs.images) {
    const Point2d d = step(std::get<UvMapping>(texture->mapping), axis);
    side.texels = std::max(side.texels, std::abs(d.x) * image.width + std::abs(d.y) * image.height);
  }
  return side;
}

int texels_of(const Side& side, bool has_edges) {
  const double wanted = side.texels * std::max(side.period, 1);
  const int n = static_cast<int>(
      std::clamp(std::round(wanted), has_edges ? double{least_texels} : 1.0, double{most_texels}));
  return std::min((n + side.cells - 1) / side.cells, std::max(most_texels / side.cells, 1)) * side.cells;
}

// Of three channels, the top row first.
Image rendered(const Values& values, Id<Texture> id, const Side& u, const Side& v, bool has_edges) {
  Image image = black_image(texels_of(u, has_edges), texels_of(v, has_edges), 3);
  float* to = image.values.data();
  for (int y = image.height; y-- > 0;)
    for (int x = 0; x < image.width; ++x) {
      const RGB c = values.at(id, {(x + 0.5) / image.width * std::max(u.period, 1),
                                   (y + 0.5) / image.height * std::max(v.period, 1)});
      for (const double value : {c.r, c.g, c.b}) *to++ = static_cast<float>(value);
    }
  return image;
}

// Numbers as they are, colours encoded as sRGB.
void write_png(const std::filesystem::path& file, const Image& image, bool is_number) {
  PictureFile picture;
  picture.width = picture.full_width = image.width, picture.height = picture.full_height = image.height;
  picture.are_integers = true, picture.bits = 8;
  for (const char* name : {"R", "G", "B"}) picture.channels.push_back({name, false});
  std::vector<unsigned char> pixels(image.values.size());
  std::ranges::transform(image.values, pixels.begin(), [&](float value) {
    const double held = std::clamp(static_cast<double>(value), 0.0, 1.0);
    return static_cast<unsigned char>(std::lround(255 * (is_number ? held : srgb_encode(held))));
  });
  std::vector<std::byte> bytes;
  if (const std::string problem = image_codec().encode_picture(file.string(), picture, pixels.data(), bytes);
      !problem.empty())
    throw MachineError("cannot write " + file.string() + ": " + problem);
  AtomicFile out(file);
  out.write(bytes);
  out.commit_part();
}

}  // namespace

const BakedTexture* BakedTextures::bake(Id<Texture> id) {
  const auto [known, is_new] = baked_.try_emplace(id.value);
  std::optional<BakedTexture>& result = known->second;
  if (!is_new) return result ? &*result : nullptr;
  const Values values(scene_, id);
  if (!values.can_be_baked()) return nullptr;
  const Texture& texture = scene_.textures.at(id.value);
  const Inputs& inputs = values.inputs();
  const Side u = side_of(inputs, 0), v = side_of(inputs, 1);
  const bool is_smooth = inputs.is_smooth, has_edges = !inputs.boards.empty() || inputs.images.empty();
  Image image = rendered(values, id, u, v, has_edges);
  result.emplace();
  ImageTexture& baked = result->image;
  const std::filesystem::path file = new_file_();
  const float most = *std::ranges::max_element(image.values);
  if (file.extension() == ".png") {
    if (most > 1) {
      for (float& value : image.values) value /= most;
      baked.scale = most;
    }
    write_png(file, image, texture.is_float);
    baked.encoding = texture.is_float ? Encoding::linear : Encoding::automatic;
  } else {
    write_exr_image(file, image);
  }
  baked.filename = std::filesystem::absolute(file).string();
  baked.number = ImageNumber::luminance;
  baked.wrap = u.period && v.period ? Wrap::repeat : Wrap::clamp;
  baked.filter = is_smooth ? TextureFilter::bilinear : TextureFilter::nearest;
  UvMapping mapping;
  mapping.a = 1 / static_cast<float>(std::max(u.period, 1)),
  mapping.e = 1 / static_cast<float>(std::max(v.period, 1));
  baked.mapping = mapping;
  result->note =
      fmt::format("texture{} ({}): an image of {} × {} texels{}",
                  texture.name.empty() ? "" : fmt::format(" \"{}\"", texture.name), kind_of(texture.model),
                  image.width, image.height, baked.wrap == Wrap::clamp ? ", for (u,v) from 0 to 1" : "");
  return &*result;
}

}  // namespace vitrail
