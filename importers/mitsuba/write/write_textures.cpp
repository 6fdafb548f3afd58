// SPDX-License-Identifier: Apache-2.0
#include "importers/mitsuba/write/write_textures.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "images/image_files.h"
#include "images/ptex_means.h"
#include "importers/mitsuba/write/write_images.h"
#include "importers/writing/export_colors.h"
#include "scene/records/kinds.h"
#include "scene/spectra/flat_emission.h"
#include "scene/spectra/rgb_to_spectrum.h"

namespace vitrail::mitsuba_writer {

namespace {

Spectrum spectrum_of(RGB color) {
  if (color.r == color.g && color.g == color.b) return ConstantSpectrum{static_cast<float>(color.r)};
  return unbounded_from_rgb(color);
}

// What a texture is on the whole, for where Mitsuba cannot have it.
RGB mean_of(const Context& context, const SpectrumParameter& value);

RGB mix(RGB a, RGB b, double amount) {
  return {a.r + (b.r - a.r) * amount, a.g + (b.g - a.g) * amount, a.b + (b.b - a.b) * amount};
}

double mean_of(const Context& context, const FloatParameter& value) {
  if (const auto* number = std::get_if<float>(&value)) return static_cast<double>(*number);
  return mean_of(context, SpectrumParameter{std::get<Id<Texture>>(value)}).g;
}

RGB mean_of(const Context& context, const TextureModel& model) {
  const auto mean = [&](const auto& value) { return mean_of(context, value); };
  return std::visit(
      Overloaded{
          [&](const ImageTexture& t) { return mean_color(t); },
          [&](const CheckerboardTexture& t) { return mix(mean(t.even), mean(t.odd), 0.5); },
          [&](const ProductTexture& t) {
            const RGB a = mean(t.first), b = mean(t.second);
            return RGB{a.r * b.r, a.g * b.g, a.b * b.b};
          },
          [&](const MixTexture& t) { return mix(mean(t.first), mean(t.second), mean(t.amount)); },
          [&](const DirectionMixTexture& t) { return mix(mean(t.first), mean(t.second), 0.5); },
          [&](const BilinearTexture& t) {
            return mix(mix(mean(t.v00), mean(t.v01), 0.5), mix(mean(t.v10), mean(t.v11), 0.5), 0.5);
          },
          [&](const DotsTexture& t) {
            constexpr double covered = 0.394 * 3.14159265 * 0.35 * 0.35;  // discs in 39 % of the cells
            return mix(mean(t.outside), mean(t.inside), covered);
          },
          [](const NoiseTexture& t) { return mean_of_noise(t); },
          [](const PatternTexture& t) { return mean_of_pattern(t); },
          [](const PtexTexture& t) { return mean_of_ptex(t).color; },
          [](const UvTexture&) {
            return RGB{0.5, 0.5, 0};
          },
          [](const MeshAttributeTexture&) {
            return RGB{0.5, 0.5, 0.5};
          },
      },
      model);
}

RGB mean_of(const Context& context, const SpectrumParameter& value) {
  if (const auto* spectrum = std::get_if<Spectrum>(&value)) return color_of(*spectrum);
  // Textures may share their inputs: each is looked at once.
  const std::uint32_t id = std::get<Id<Texture>>(value).value;
  if (const auto known = context.means.find(id); known != context.means.end()) return known->second;
  const RGB mean = mean_of(context, context.scene.textures[id].model);
  context.means[id] = mean;
  return mean;
}

// a·u + b·v + c, d·u + e·v + f as Mitsuba wants it: 4×4, with the offsets in the last column.
void add_to_uv(Element parent, const std::array<double, 6>& m) {
  Transform to_uv;
  to_uv.m[0] = {m[0], m[1], 0, m[2]};
  to_uv.m[1] = {m[3], m[4], 0, m[5]};
  add_transform(parent, to_uv, "to_uv");
}

UvMapping uv_mapping(Context& context, const TextureMapping& mapping) {
  if (const auto* uv = std::get_if<UvMapping>(&mapping)) return *uv;
  context.approximated("Mitsuba looks textures up by uv only: this mapping by position is replaced by uv");
  return {};
}

// The image's rows run down: its t is 1 − the Scene's.
void fill_bitmap(Context& context, Element element, const MitsubaImage& written, const ImageTexture& image) {
  add_string(element, "filename", written.filename);
  add_boolean(element, "raw", written.raw);
  add_string(element, "filter_type", image.filter == TextureFilter::nearest ? "nearest" : "bilinear");
  if (image.filter > TextureFilter::bilinear)
    context.approximated("Mitsuba does not filter textures by footprint: bilinear");
  if (image.wrap == Wrap::black)
    context.approximated("black outside of an image is not in Mitsuba: its edge goes on");
  const std::array wraps{"repeat", "mirror", "clamp", "clamp"};
  add_string(element, "wrap_mode", wraps.at(static_cast<std::size_t>(image.wrap)));
  const UvMapping m = uv_mapping(context, image.mapping);
  const auto down = [](float value) { return value == 0 ? 0.0 : -static_cast<double>(value); };
  add_to_uv(element, {m.a, m.b, m.c, down(m.d), down(m.e), 1 - static_cast<double>(m.f)});
}

void write_image(Context& context, Element root, const MitsubaImage& written, const ImageTexture& image,
                 const std::string& id) {
  fill_bitmap(context, add(root, "texture", "bitmap", "", id), written, image);
}

// Mitsuba's cells are half a unit wide.
void write_checkerboard(Context& context, Element root, const CheckerboardTexture& board,
                        const std::string& id) {
  Element element = add(root, "texture", "checkerboard", "", id);
  add_parameter(context, element, "color0", board.even, Meaning::reflectance);
  add_parameter(context, element, "color1", board.odd, Meaning::reflectance);
  const UvMapping m = uv_mapping(context, board.mapping);
  std::array<double, 6> to_uv{m.a, m.b, m.c, m.d, m.e, m.f};
  for (double& entry : to_uv) entry /= 2;
  add_to_uv(element, to_uv);
}

bool is_number(const std::optional<Spectrum>& value, double number) {
  return value && is_constant(*value) && evaluate(*value, 550) == number;
}

// A colour within a texture means what the texture is for: a reflectance, unless it is brighter.
Spectrum within_texture(Context& context, const Spectrum& spectrum) {
  const bool is_color = std::holds_alternative<RgbUnboundedSpectrum>(spectrum) ||
                        std::holds_alternative<RgbIlluminantSpectrum>(spectrum);
  if (!is_color) return resolved(spectrum);
  const RGB c = color_of(spectrum);
  if (std::max({c.r, c.g, c.b}) <= 1) return resolved(reflectance_from_rgb(c));
  context.approximated(
      "a colour above 1 within a texture counts as it is, also where the texture is a reflectance");
  return resolved(spectrum);
}

// The same texture in simpler terms, where there is one: 1·x, a mix by 0 or 1, constants.
std::optional<WrittenTexture> simplified(Context& context, const TextureModel& model) {
  const auto written = [&](const SpectrumParameter& value) -> WrittenTexture {
    if (const auto* spectrum = std::get_if<Spectrum>(&value)) return *spectrum;
    return context.textures[std::get<Id<Texture>>(value).value];
  };
  if (const auto* product = std::get_if<ProductTexture>(&model)) {
    const auto first = value_of(context, product->first), second = value_of(context, product->second);
    if (is_number(first, 1)) return written(product->second);
    if (is_number(second, 1)) return written(product->first);
    if (first && second && is_constant(*first)) return scaled(*second, evaluate(*first, 550));
    if (first && second && is_constant(*second)) return scaled(*first, evaluate(*second, 550));
    if (first && second)
      return tabulated([&, a = resolved(*first), b = resolved(*second)](double lambda) {
        return evaluate(a, lambda) * evaluate(b, lambda);
      });
  }
  if (const auto* blend = std::get_if<MixTexture>(&model)) {
    const auto amount = value_of(context, blend->amount);
    if (amount == 0.0f) return written(blend->first);
    if (amount == 1.0f) return written(blend->second);
    const auto first = value_of(context, blend->first), second = value_of(context, blend->second);
    if (first && second && amount)
      return tabulated(
          [&, a = within_texture(context, *first), b = within_texture(context, *second)](double lambda) {
            const double x = evaluate(a, lambda), y = evaluate(b, lambda);
            return x + (y - x) * static_cast<double>(*amount);
          });
  }
  return std::nullopt;
}

// With a border of black texels.
Image bordered(const Image& image) {
  Image result = black_image(image.width + 2, image.height + 2, image.channels);
  const auto row = static_cast<std::ptrdiff_t>(image.width) * image.channels;
  for (std::ptrdiff_t y = 0; y < image.height; ++y)
    std::copy_n(
        image.values.begin() + y * row, row,
        result.values.begin() + (y + 1) * (row + std::ptrdiff_t{2} * image.channels) + image.channels);
  return result;
}

// Mitsuba has no black outside, but it has edges that go on. Bilinear texels fade to black as they do
// outside. Nothing where the file cannot be read.
std::optional<std::pair<MitsubaImage, ImageTexture>> with_black_border(Context& context,
                                                                       const TintedImage& tinted,
                                                                       bool is_float) {
  const auto* mapping = std::get_if<UvMapping>(&tinted.image.mapping);
  if (tinted.image.wrap != Wrap::black || !mapping) return std::nullopt;
  try {
    Image image = texture_values(tinted.image, read_stored_image(tinted.image.filename),
                                 is_float || tinted.is_number ? ImageUse::number : ImageUse::color);
    const RGB& t = tinted.tint;
    if (t.r != t.g || t.g != t.b) image = with_three_channels(std::move(image));
    multiply(image, t);
    const std::string name = context.new_file("images", "exr", context.derived_images);
    write_exr_image(context.file.parent_path() / name, bordered(image));
    const auto w = static_cast<float>(image.width), h = static_cast<float>(image.height);
    ImageTexture wider = tinted.image;
    wider.wrap = Wrap::clamp;
    wider.mapping = composed({w / (w + 2), 0, 1 / (w + 2), 0, h / (h + 2), 1 / (h + 2)}, *mapping);
    return std::pair(MitsubaImage{name, is_float}, wider);
  } catch (const Error&) {
    return std::nullopt;
  }
}

WrittenTexture write_texture(Context& context, Element root, const Texture& texture, std::size_t index) {
  if (const auto simple = simplified(context, texture.model)) return *simple;
  const auto new_id = [&] { return context.new_id(texture.name, "texture", index); };
  const auto tinted = tinted_image(context.scene, Id<Texture>{static_cast<std::uint32_t>(index)});
  if (tinted && !context.roles.normal_map[index])
    if (const auto bordered = with_black_border(context, *tinted, texture.is_float)) {
      const std::string id = new_id();
      write_image(context, root, bordered->first, bordered->second, id);
      return id;
    }
  if (std::holds_alternative<ImageTexture>(texture.model)) {
    const std::string id = new_id();
    const auto& image = std::get<ImageTexture>(texture.model);
    write_image(context, root,
                image_for_mitsuba(context, image, texture.is_float, context.roles.normal_map[index]), image,
                id);
    return id;
  }
  if (tinted) {
    const std::string id = new_id();
    const bool is_float = tinted->is_number || texture.is_float;
    const MitsubaImage written = image_for_mitsuba(context, tinted->image, is_float, false, tinted->tint);
    write_image(context, root, {written.filename, texture.is_float}, tinted->image, id);
    return id;
  }
  if (const auto* product = std::get_if<ProductTexture>(&texture.model))
    if (const auto pair = image_pair(context.scene, *product))
      if (const auto written = image_for_mitsuba(context, *pair, texture.is_float)) {
        const std::string id = new_id();
        write_image(context, root, *written, pair->first.image, id);
        return id;
      }
  if (const auto* board = std::get_if<CheckerboardTexture>(&texture.model); board && !board->solid) {
    const std::string id = new_id();
    CheckerboardTexture written = *board;
    if (texture.is_float) std::swap(written.even, written.odd);  // as Mitsuba looks numbers up
    write_checkerboard(context, root, written, id);
    return id;
  }
  if (const auto* attribute = std::get_if<MeshAttributeTexture>(&texture.model)) {
    const std::string id = new_id();
    Element element = add(root, "texture", "mesh_attribute", "", id);
    add_string(element, "name", attribute->name);
    add_float(element, "scale", attribute->scale);
    return id;
  }
  if (const BakedTexture* baked = context.baked.bake({static_cast<std::uint32_t>(index)})) {
    context.approximated(baked->note);
    const std::string id = new_id();
    write_image(context, root, {context.relative(baked->image.filename), texture.is_float}, baked->image, id);
    return id;
  }
  const RGB mean = mean_of(context, texture.model);
  context.approximated(fmt::format(
      "texture{}: Mitsuba has none of its kind ({}): replaced by its mean, rgb {:.4g} {:.4g} {:.4g}",
      texture.name.empty() ? "" : fmt::format(" \"{}\"", texture.name), kind_of(texture.model), mean.r,
      mean.g, mean.b));
  return spectrum_of(mean);
}

// A texture times a number that is the height of a bump map is written with the map (write_materials.cpp).
const Id<Texture>* scaled_height(const Context& context, std::size_t index) {
  const auto* product = std::get_if<ProductTexture>(&context.scene.textures[index].model);
  const bool by_number = product && std::holds_alternative<Spectrum>(product->second);
  return by_number && context.roles.height[index] ? std::get_if<Id<Texture>>(&product->first) : nullptr;
}

// What a light says without D65 is written with the light (write_lights.cpp).
const Id<Texture>* flat_emission(const Texture& texture) {
  const auto* product = std::get_if<ProductTexture>(&texture.model);
  const auto* factor = product ? std::get_if<Spectrum>(&product->second) : nullptr;
  return factor && multiple_of_inverse_d65(*factor) ? std::get_if<Id<Texture>>(&product->first) : nullptr;
}

}  // namespace

void write_textures(Context& context, Element root) {
  for (std::size_t i = 0; i < context.scene.textures.size(); ++i) {
    context.begin(RecordKind::texture, context.scene.textures[i].origin);
    if (const auto* height = scaled_height(context, i)) {
      context.textures.push_back(context.textures.at(height->value));
      continue;
    }
    if (const auto* image = flat_emission(context.scene.textures[i])) {
      context.textures.push_back(context.textures.at(image->value));
      continue;
    }
    context.textures.push_back(write_texture(context, root, context.scene.textures[i], i));
  }
}

std::optional<Spectrum> value_of(const Context& context, const SpectrumParameter& value) {
  if (const auto* spectrum = std::get_if<Spectrum>(&value)) return *spectrum;
  const WrittenTexture& texture = context.textures[std::get<Id<Texture>>(value).value];
  if (const auto* spectrum = std::get_if<Spectrum>(&texture)) return *spectrum;
  return std::nullopt;
}

std::optional<float> value_of(const Context& context, const FloatParameter& value) {
  if (const auto* number = std::get_if<float>(&value)) return *number;
  const auto spectrum = value_of(context, SpectrumParameter{std::get<Id<Texture>>(value)});
  if (!spectrum) return std::nullopt;
  return static_cast<float>(is_constant(*spectrum) ? evaluate(*spectrum, 550) : color_of(*spectrum).g);
}

void add_parameter(Context& context, Element parent, const std::string& name, const SpectrumParameter& value,
                   Meaning meaning) {
  if (const auto spectrum = value_of(context, value)) return add_spectrum(parent, name, *spectrum, meaning);
  add_reference(parent, std::get<std::string>(context.textures[std::get<Id<Texture>>(value).value]), name);
}

void add_parameter(Context& context, Element parent, const std::string& name, const FloatParameter& value) {
  if (const auto number = value_of(context, value)) return add_float(parent, name, *number);
  add_reference(parent, std::get<std::string>(context.textures[std::get<Id<Texture>>(value).value]), name);
}

namespace {

void note_mean(Context& context, Id<Texture> id, const char* what) {
  const std::string& name = context.scene.textures[id.value].name;
  context.approximated(fmt::format("{} takes no texture in Mitsuba: the mean of {}", what,
                                   name.empty() ? "its texture" : fmt::format("\"{}\"", name)));
}

}  // namespace

Spectrum constant_of(Context& context, const SpectrumParameter& value, const char* what) {
  if (const auto spectrum = value_of(context, value)) return *spectrum;
  note_mean(context, std::get<Id<Texture>>(value), what);
  return spectrum_of(mean_of(context, value));
}

float constant_of(Context& context, const FloatParameter& value, const char* what) {
  if (const auto number = value_of(context, value)) return *number;
  note_mean(context, std::get<Id<Texture>>(value), what);
  return static_cast<float>(mean_of(context, value));
}

void add_bitmap(Context& context, Element parent, const std::string& name, const MitsubaImage& written,
                const ImageTexture& image) {
  fill_bitmap(context, add(parent, "texture", "bitmap", name), written, image);
}

void add_lit_image(Context& context, Element emitter, const char* name, const SpectrumParameter& image,
                   float scale) {
  Element lit = add(emitter, "texture", "d65", name);
  add_parameter(context, lit, "nested", image, Meaning::emission);
  add_float(lit, "scale", scale);
}

}  // namespace vitrail::mitsuba_writer
