// SPDX-License-Identifier: Apache-2.0
#include "partitioner/appearance/bake_textures.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "images/ptex_means.h"
#include "images/texture_values.h"
#include "scene/models/normal_map.h"
#include "scene/records/pixel_place.h"
#include "scene/records/texture_inputs.h"
#include "scene/spectra/matrix_r.h"
#include "scene/spectra/rgb_to_spectrum.h"

namespace vitrail {

namespace {

RGB to_rgb(const std::array<float, 3>& c) { return {c[0], c[1], c[2]}; }

// The linear sRGB colour that the spectrum was made of, if it was.
const std::array<float, 3>* rgb_of(const Spectrum& spectrum) {
  if (const auto* s = std::get_if<SigmoidSpectrum>(&spectrum)) return &s->rgb;
  if (const auto* s = std::get_if<RgbUnboundedSpectrum>(&spectrum)) return &s->rgb;
  if (const auto* s = std::get_if<RgbIlluminantSpectrum>(&spectrum)) return &s->rgb;
  return nullptr;
}

// A colour within a texture means what the texture is used for, and what shines is under D65; other spectra
// are what they are.
Spectrum as_used(const Spectrum& spectrum, TextureUse use, RgbMethod method) {
  const std::array<float, 3>* const rgb = rgb_of(spectrum);
  const bool is_color = use != TextureUse::number && use != TextureUse::vector;
  if (method == RgbMethod::bands && is_color) return resolved(spectrum, method);
  switch (use) {
    case TextureUse::number:
    case TextureUse::vector: {
      const double value =
          is_constant(spectrum) ? evaluate(resolved(spectrum), lambda_min_nm) : luminance(spectrum);
      return ConstantSpectrum{static_cast<float>(value)};
    }
    case TextureUse::illuminant:
      return rgb ? resolved(emission_from_rgb(to_rgb(*rgb)), method)
                 : product(emission_from_rgb({1, 1, 1}), resolved(spectrum));
    case TextureUse::reflectance:
      return rgb ? resolved(reflectance_from_rgb(to_rgb(*rgb)), method) : resolved(spectrum);
    default:
      return rgb ? resolved(unbounded_from_rgb(to_rgb(*rgb)), method) : resolved(spectrum);
  }
}

bool needs_levels(TextureFilter filter) {
  return filter == TextureFilter::trilinear || filter == TextureFilter::anisotropic;
}

// The colours (s,t,0) of pbrt-v3's uv, as an image.
Image uv_image() {
  constexpr int size = 128;
  Image image = black_image(size, size, 3);
  for (int y = 0; y < size; ++y)
    for (int x = 0; x < size; ++x) {
      float* const rgb = &image.values[3 * pixel_place(x, y, size)];
      rgb[0] = (static_cast<float>(x) + 0.5f) / size;
      rgb[1] = 1 - (static_cast<float>(y) + 0.5f) / size;
    }
  return image;
}

}  // namespace

TextureBaker::TextureBaker(const Scene& scene, std::filesystem::path bundle, Diagnostics& diagnostics,
                           ImageBaking images)
    : scene_(scene),
      bundle_(std::move(bundle)),
      diagnostics_(diagnostics),
      trust_integers_(images.trust_integers),
      cache_(std::move(images.cache)) {}

SpectrumParameter TextureBaker::bake(const SpectrumParameter& parameter, TextureUse use) {
  if (const auto* texture = std::get_if<Id<Texture>>(&parameter)) return bake_texture(*texture, use);
  return as_rendered(std::get<Spectrum>(parameter));
}

Spectrum TextureBaker::as_rendered(const Spectrum& spectrum) const {
  return resolved(spectrum, scene_.settings.rgb);
}

FloatParameter TextureBaker::bake(const FloatParameter& parameter) {
  const auto* texture = std::get_if<Id<Texture>>(&parameter);
  if (!texture) return parameter;
  const SpectrumParameter baked = bake_texture(*texture, TextureUse::number);
  if (const auto* id = std::get_if<Id<Texture>>(&baked)) return *id;
  return static_cast<float>(evaluate(std::get<Spectrum>(baked), lambda_min_nm));
}

std::optional<TextureMean> TextureBaker::mean(const SpectrumParameter& parameter) {
  try {
    return mean_of(scene_, means_, parameter);
  } catch (const Error& error) {
    const auto* id = std::get_if<Id<Texture>>(&parameter);
    if (!id) throw;
    throw Error(error.what(), location(scene_, scene_.textures[id->value].origin));
  }
}

bool TextureBaker::reads_attribute(const FloatParameter& baked) const {
  return vitrail::reads_attribute(textures_, baked);
}

SpectrumParameter TextureBaker::bake_input(const SpectrumParameter& parameter, TextureUse use) {
  if (const auto* texture = std::get_if<Id<Texture>>(&parameter)) return bake_texture(*texture, use);
  return as_used(std::get<Spectrum>(parameter), use, scene_.settings.rgb);
}

// What multiplies a colour, rather than being one.
bool TextureBaker::is_number(const SpectrumParameter& parameter) const {
  if (const auto* texture = std::get_if<Id<Texture>>(&parameter))
    return scene_.textures.at(texture->value).is_float;
  return std::holds_alternative<ConstantSpectrum>(std::get<Spectrum>(parameter));
}

// ---- Clones

struct TextureBaker::Clone {
  TextureBaker& baker;
  Id<Texture> id;
  TextureUse use;

  SpectrumParameter operator()(const ImageTexture& image) const { return image_of(image, no_tint); }
  SpectrumParameter image_of(const ImageTexture& image, const Tint& tint) const {
    ImageTexture baked;
    baked.filename = baker.bake_file(image, use, tint, needs_levels(image.filter), where());
    baked.mapping = image.mapping;
    baked.wrap = image.wrap;
    baked.filter = image.filter;
    return baker.add(baked, use);
  }
  SpectrumParameter operator()(CheckerboardTexture t) const {
    t.even = input(t.even), t.odd = input(t.odd);
    return baker.add(t, use);
  }
  // One of the two is what the product is used for, the other one a factor.
  SpectrumParameter operator()(ProductTexture t) const {
    if (const auto tinted = baker.bake_tinted(t, use)) return *tinted;
    const TextureUse factor = use == TextureUse::number ? use : TextureUse::unbounded;
    const bool swapped = baker.is_number(t.first) && !baker.is_number(t.second);
    t.first = baker.bake_input(t.first, swapped ? factor : use);
    t.second = baker.bake_input(t.second, swapped ? use : factor);
    return baker.add(t, use);
  }
  SpectrumParameter operator()(MixTexture t) const {
    t.first = input(t.first), t.second = input(t.second), t.amount = baker.bake(t.amount);
    return baker.add(t, use);
  }
  SpectrumParameter operator()(DirectionMixTexture t) const {
    t.first = input(t.first), t.second = input(t.second);
    return baker.add(t, use);
  }
  SpectrumParameter operator()(BilinearTexture t) const {
    t.v00 = input(t.v00), t.v01 = input(t.v01), t.v10 = input(t.v10), t.v11 = input(t.v11);
    return baker.add(t, use);
  }
  SpectrumParameter operator()(const UvTexture& t) const {
    ImageTexture image;
    image.filename = baker.write_image(
        rows_of(use == TextureUse::number ? numbers_of(uv_image(), ImageNumber::luminance) : uv_image()), use,
        false);
    image.mapping = t.mapping;
    return baker.add(image, use);
  }
  SpectrumParameter operator()(const MeshAttributeTexture& t) const { return attribute_of(t, no_tint); }
  SpectrumParameter attribute_of(MeshAttributeTexture t, const Tint& tint) const {
    const bool plain = use == TextureUse::number || use == TextureUse::vector;
    const TextureUse color = baker.in_bands() ? TextureUse::vector : TextureUse::reflectance;
    t.name = baker.slot_of({t.name, plain ? use : color, nullptr, tint});
    if (use != TextureUse::illuminant) return baker.add(t, use);
    return lit(t);
  }
  SpectrumParameter operator()(DotsTexture t) const {
    t.inside = input(t.inside), t.outside = input(t.outside);
    return baker.add(t, use);
  }
  SpectrumParameter operator()(const NoiseTexture& t) const {
    return use == TextureUse::illuminant ? lit(t) : baker.add(t, use);
  }
  SpectrumParameter operator()(PatternTexture t) const {
    for (PatternStop& stop : t.map) stop.value = input(stop.value);
    return t.map.empty() && use == TextureUse::illuminant ? lit(t) : baker.add(t, use);
  }
  SpectrumParameter operator()(const PtexTexture& t) const { return baker.bake_ptex(id, t, use); }

 private:
  SpectrumParameter input(const SpectrumParameter& parameter) const {
    return baker.bake_input(parameter, use);
  }
  // What shines is a reflectance under D65.
  SpectrumParameter lit(const TextureModel& shape) const {
    if (baker.in_bands()) return baker.add(shape, use);
    const Id<Texture> unlit = baker.add(shape, TextureUse::reflectance);
    return baker.add(ProductTexture{unlit, Spectrum{emission_from_rgb({1, 1, 1})}}, use);
  }
  SourceLocation where() const { return location(baker.scene_, baker.scene_.textures[id.value].origin); }
};

Id<Texture> TextureBaker::bake_vector(Id<Texture> texture) {
  if (const auto map = normal_map_of(scene_.textures, texture)) {
    const auto [known, is_new] = baked_.try_emplace({texture.value, TextureUse::vector});
    if (is_new)
      known->second = Clone{*this, map->image, TextureUse::vector}.image_of(
          std::get<ImageTexture>(scene_.textures[map->image.value].model), map->factors);
    return std::get<Id<Texture>>(known->second);
  }
  diagnostics_.push_back({Fidelity::dropped,
                          "a normal map that is no image is left out",
                          location(scene_, scene_.textures[texture.value].origin),
                          {}});
  ImageTexture flat;
  flat.filename = write_image(rows_of({1, 1, 3, {0.5f, 0.5f, 1}}), TextureUse::vector, false);
  return add(flat, TextureUse::vector);
}

// A colour given as RGB times an image or attribute of RGB is the product of their numbers, as in programs
// that know no spectra: the product of two spectra has another colour. Nothing where it is no such product.
std::optional<SpectrumParameter> TextureBaker::bake_tinted(const ProductTexture& product, TextureUse use) {
  if (use == TextureUse::number || use == TextureUse::vector) return {};
  const bool swapped = std::holds_alternative<Id<Texture>>(product.first);
  const auto* color = std::get_if<Spectrum>(swapped ? &product.second : &product.first);
  const auto* id = std::get_if<Id<Texture>>(swapped ? &product.first : &product.second);
  const Tint* tint = color ? rgb_of(*color) : nullptr;
  const auto is_grey = [](const Tint& t) { return t[0] == t[1] && t[1] == t[2]; };
  if (!tint || is_grey(*tint) || !id || scene_.textures.at(id->value).is_float) return {};
  const Clone clone{*this, *id, use};
  const TextureModel& model = scene_.textures[id->value].model;
  if (const auto* image = std::get_if<ImageTexture>(&model)) return clone.image_of(*image, *tint);
  const auto* attribute = std::get_if<MeshAttributeTexture>(&model);
  if (attribute && std::ranges::max(*tint) <= 1) return clone.attribute_of(*attribute, *tint);
  return {};
}

SpectrumParameter TextureBaker::bake_texture(Id<Texture> texture, TextureUse use) {
  const Texture& original = scene_.textures.at(texture.value);
  // A number may stand for a spectrum; it stays that number, and has no colour to light.
  if (original.is_float && use != TextureUse::vector) use = TextureUse::number;
  const auto known = baked_.find({texture.value, use});
  if (known != baked_.end()) return known->second;
  SpectrumParameter baked = std::visit(Clone{*this, texture, use}, original.model);
  baked_.insert({{texture.value, use}, baked});
  return baked;
}

// What shines, and a file that cannot be read, is its mean.
SpectrumParameter TextureBaker::bake_ptex(Id<Texture> texture, const PtexTexture& ptex, TextureUse use) {
  const Texture& original = scene_.textures[texture.value];
  const SourceLocation where = location(scene_, original.origin);
  const std::string name = original.name.empty() ? "" : fmt::format(" \"{}\"", original.name);
  const auto report = [&](const std::string& how) {
    diagnostics_.push_back({Fidelity::approximated,
                            fmt::format("texture{} of ptex is rendered as {}", name, how), where, where,
                            RecordKind::texture});
  };
  std::string why;
  if (use != TextureUse::illuminant) try {
      const PtexImage image = ptex_image(ptex, use == TextureUse::number);
      ImageTexture baked;
      baked.filename = write_image(image.rows, use, false);
      baked.mapping = AttributeMapping{slot_of({std::string(face_indices), TextureUse::vector, image.tiles})};
      baked.wrap = Wrap::clamp;
      report(image.how);
      return add(baked, use);
    } catch (const Error& error) {
      why = error.what();
    }
  const PtexMean mean = mean_of_ptex(ptex);
  const bool is_said = mean.how.find(why) != std::string::npos;  // its means cannot be read either
  report(is_said ? mean.how : fmt::format("{}: {}", mean.how, why));
  const RGB& c = mean.color;
  if (c.r == c.g && c.g == c.b) return as_used(ConstantSpectrum{static_cast<float>(c.r)}, use, {});
  return as_used(unbounded_from_rgb(c), use, {});
}

Id<Texture> TextureBaker::add(TextureModel model, TextureUse use) {
  textures_.push_back({std::move(model), use == TextureUse::number, "", {}});
  return {static_cast<std::uint32_t>(textures_.size() - 1)};
}

std::string TextureBaker::slot_of(const Attribute& wanted) {
  const auto found = std::find(attributes_.begin(), attributes_.end(), wanted);
  const auto slot = found - attributes_.begin();
  if (found == attributes_.end()) attributes_.push_back(wanted);
  return std::to_string(slot);
}

std::array<float, 3> attribute_value(RGB color, TextureUse use, const ReflectanceFitter& fitter) {
  if (use == TextureUse::vector)
    return {static_cast<float>(color.r), static_cast<float>(color.g), static_cast<float>(color.b)};
  if (use == TextureUse::number) {
    const auto mean = static_cast<float>((color.r + color.g + color.b) / 3);
    return {mean, mean, mean};
  }
  SigmoidNodes x = fitter(color);
  for (float& v : x) v = std::clamp(v, -200.0f, 200.0f);
  return x;
}

void move(std::vector<Texture>& textures, Vector3d by) {
  const auto moved = [&](Transform& t) { t = translate(by) * t; };
  const auto move_mapping = [&](TextureMapping& mapping) {
    if (auto* m = std::get_if<SphericalMapping>(&mapping)) moved(m->texture_to_world);
    if (auto* m = std::get_if<CylindricalMapping>(&mapping)) moved(m->texture_to_world);
    if (auto* m = std::get_if<GlobeMapping>(&mapping)) moved(m->texture_to_world);
    if (auto* m = std::get_if<PlanarMapping>(&mapping)) moved(m->texture_to_world);
  };
  for (Texture& texture : textures)
    std::visit(
        [&](auto& model) {
          if constexpr (requires { model.mapping; }) move_mapping(model.mapping);
          if constexpr (requires { model.by_uv; }) {
            if (model.by_uv) return;
          }
          if constexpr (requires { model.texture_to_world; }) moved(model.texture_to_world);
        },
        texture.model);
}

}  // namespace vitrail
