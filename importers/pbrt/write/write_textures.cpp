// SPDX-License-Identifier: Apache-2.0
#include "importers/pbrt/write/write_images.h"
#include "importers/writing/export_colors.h"
#include "scene/spectra/rgb_to_spectrum.h"

namespace vitrail::pbrt {

namespace {

// Writes the parameters of one texture; gives its kind, or nothing where pbrt has no such texture.
class TextureWriter {
 public:
  TextureWriter(Parameters& p, bool is_float) : p_(p), is_float_(is_float) {}

  const Transform& texture_to_world() const { return texture_to_world_; }

  const char* operator()(const ImageTexture& t) {
    return image(image_for_pbrt(p_, t, is_float_ ? ImageUse::number : ImageUse::color));
  }
  const char* image(const ImageTexture& t) {
    mapping(t.mapping);
    p_.file("filename", t.filename).number("scale", t.scale).boolean("invert", t.invert);
    p_.text("wrap", t.wrap == Wrap::clamp ? "clamp" : t.wrap == Wrap::black ? "black" : "repeat");
    if (t.wrap == Wrap::mirror) p_.approximated("mirrored repetition becomes plain repetition");
    constexpr std::array filters{"point", "bilinear", "trilinear", "ewa"};
    p_.text("filter", filters.at(static_cast<std::size_t>(t.filter)));
    encoding(t.encoding, t.gamma);
    return "imagemap";
  }
  const char* operator()(const PtexTexture& t) {
    p_.file("filename", t.filename).number("scale", t.scale);
    encoding(t.encoding, t.gamma);
    return "ptex";
  }
  const char* operator()(const CheckerboardTexture& t) {
    input("tex1", t.even), input("tex2", t.odd);
    p_.integer("dimension", t.solid ? 3 : 2);
    if (t.solid)
      texture_to_world_ = t.texture_to_world;
    else
      mapping(t.mapping);
    return "checkerboard";
  }
  const char* operator()(const ProductTexture& t) {
    const bool swapped = !is_number(t.second) && is_number(t.first);
    const SpectrumParameter &tex = swapped ? t.second : t.first, &scale = swapped ? t.first : t.second;
    if (!is_number(scale))
      if (const char* kind = tinted(t)) return kind;
    input("tex", tex);
    if (!is_number(scale)) {
      const auto* factor = std::get_if<Spectrum>(&scale);
      p_.approximated(
          "pbrt multiplies a texture by numbers only: the luminance of a colour, 1 for a texture");
      p_.number("scale", factor ? static_cast<float>(luminance(*factor)) : 1.0f);
      return "scale";
    }
    p_.input("scale", scale, true);
    return "scale";
  }
  const char* operator()(const MixTexture& t) {
    input("tex1", t.first), input("tex2", t.second);
    p_.number("amount", t.amount);
    return "mix";
  }
  const char* operator()(const DirectionMixTexture& t) {
    input("tex1", t.first), input("tex2", t.second);
    p_.numbers("vector3 dir", std::array{t.direction.x, t.direction.y, t.direction.z});
    return "directionmix";
  }
  const char* operator()(const BilinearTexture& t) {
    corner("v00", t.v00), corner("v01", t.v01), corner("v10", t.v10), corner("v11", t.v11);
    mapping(t.mapping);
    return "bilerp";
  }
  const char* operator()(const DotsTexture& t) {
    input("inside", t.outside), input("outside", t.inside);  // pbrt exchanges them
    mapping(t.mapping);
    return "dots";
  }
  const char* operator()(const NoiseTexture& t) {
    const bool is_marble = t.kind == NoiseTexture::Kind::marble;
    if (is_marble && is_float_) {
      p_.dropped("pbrt has no marble of numbers; 0.5 stands for it");
      return nullptr;
    }
    if (!is_marble && !is_float_) return noise_of_colors(t);
    texture_to_world_ = t.texture_to_world;
    noise(p_, t);
    return name_of(t.kind);
  }
  const char* operator()(const PatternTexture& t) {
    if (const auto board = as_checkerboard(t)) return (*this)(*board);
    const RGB mean = mean_of_pattern(t);
    p_.dropped(
        fmt::format("pbrt has no patterns of POV-Ray's; the mean stands for it, rgb {:.3g} {:.3g} {:.3g}",
                    mean.r, mean.g, mean.b));
    input("value", constant(mean));
    return "constant";
  }
  const char* operator()(const MeshAttributeTexture& t) {
    const RGB mean = mean_of_attribute(p_.writer().scene, t).value_or(RGB{0.5, 0.5, 0.5});
    p_.dropped(fmt::format(
        "pbrt has no attributes of meshes; the mean of \"{}\" stands for it, rgb {:.3g} {:.3g} {:.3g}",
        t.name, mean.r, mean.g, mean.b));
    input("value", constant(mean));
    return "constant";
  }
  const char* operator()(const UvTexture&) {
    p_.dropped("pbrt-v4 has no texture that shows (u,v); 0.5 stands for it");
    return nullptr;
  }

 private:
  Spectrum constant(RGB mean) const {
    if (is_float_) return ConstantSpectrum{static_cast<float>((mean.r + mean.g + mean.b) / 3)};
    return reflectance_from_rgb(mean);
  }
  bool is_number(const SpectrumParameter& value) const {
    const auto* spectrum = std::get_if<Spectrum>(&value);
    return spectrum ? std::holds_alternative<ConstantSpectrum>(*spectrum)
                    : p_.writer().scene.textures.at(std::get<Id<Texture>>(value).value).is_float;
  }
  // An image times a colour, by the colour of each pixel.
  const char* tinted(const ProductTexture& product) {
    const auto found = tinted_image(p_.writer().scene, product);
    if (!found) return nullptr;
    return image(
        image_for_pbrt(p_, found->image, found->is_number ? ImageUse::number : ImageUse::color, found->tint));
  }
  static const char* name_of(NoiseTexture::Kind kind) {
    constexpr std::array kinds{"fbm", "wrinkled", "windy", "marble"};
    return kinds.at(static_cast<std::size_t>(kind));
  }
  static void noise(Parameters& p, const NoiseTexture& t) {
    if (t.kind == NoiseTexture::Kind::windy) return;
    p.integer("octaves", t.octaves).number("roughness", t.roughness);
    if (t.kind == NoiseTexture::Kind::marble) p.number("scale", t.scale).number("variation", t.variation);
  }
  // pbrt has such noise as numbers alone: a mix of 0 and 1 by it is the colour.
  const char* noise_of_colors(const NoiseTexture& t) {
    Writer& w = p_.writer();
    const std::string name = Writer::add_name(w.textures, "noise");
    Parameters p(w, "texture", {}, RecordKind::texture);
    noise(p, t);
    w.begin("AttributeBegin"), w.transform(t.texture_to_world);
    w.line(fmt::format("Texture {} \"float\" \"{}\"{}", in_quotes(name), name_of(t.kind), p.list()));
    w.end("AttributeEnd");
    p_.numbers("spectrum tex1", std::array{360, 0, 830, 0})
        .numbers("spectrum tex2", std::array{360, 1, 830, 1});
    p_.texture("amount", name);
    return "mix";
  }
  // A corner of a bilinear texture, which is one value.
  void corner(std::string_view name, const SpectrumParameter& value) {
    if (std::holds_alternative<Spectrum>(value)) return input(name, value);
    p_.approximated(fmt::format("0.5 stands for the texture in its corner {}: pbrt takes none there", name));
    input(name, ConstantSpectrum{0.5f});
  }
  void input(std::string_view name, const SpectrumParameter& value) { p_.input(name, value, is_float_); }

  void encoding(Encoding encoding, float gamma) {
    if (encoding == Encoding::srgb) p_.text("encoding", "sRGB");
    if (encoding == Encoding::linear) p_.text("encoding", "linear");
    if (encoding == Encoding::gamma) p_.text("encoding", fmt::format("gamma {}", gamma));
  }
  void mapping(const TextureMapping& mapping) {
    if (const auto* uv = std::get_if<UvMapping>(&mapping)) {
      if (uv->b != 0 || uv->d != 0) p_.approximated("the turn or shear of its (u,v) is left out");
      p_.number("uscale", uv->a).number("vscale", uv->e).number("udelta", uv->c).number("vdelta", uv->f);
    } else if (const auto* sphere = std::get_if<SphericalMapping>(&mapping)) {
      texture_to_world_ = sphere->texture_to_world;
      p_.text("mapping", "spherical");
    } else if (const auto* cylinder = std::get_if<CylindricalMapping>(&mapping)) {
      texture_to_world_ = cylinder->texture_to_world;
      if (cylinder->of_direction)
        p_.approximated("an image around a cylinder by direction, as in pbrt-v3: by height");
      p_.text("mapping", "cylindrical");
    } else if (std::holds_alternative<GlobeMapping>(mapping)) {
      p_.approximated("an image around a globe, which pbrt turns by a quarter: by the surface's (u,v)");
    } else {
      const auto& plane = std::get<PlanarMapping>(mapping);
      texture_to_world_ = plane.texture_to_world;
      p_.text("mapping", "planar").number("udelta", plane.offset_s).number("vdelta", plane.offset_t);
      p_.numbers("vector3 v1", std::array{plane.v1.x, plane.v1.y, plane.v1.z});
      p_.numbers("vector3 v2", std::array{plane.v2.x, plane.v2.y, plane.v2.z});
    }
  }

  Parameters& p_;
  bool is_float_;
  Transform texture_to_world_;
};

}  // namespace

void write_textures(Writer& w) {
  for (std::size_t i = 0; i < w.scene.textures.size(); ++i) {
    const Texture& texture = w.scene.textures[i];
    Parameters p(w, fmt::format("texture \"{}\"", w.textures[i]), texture.origin, RecordKind::texture);
    TextureWriter writer(p, texture.is_float);
    const char* kind = std::visit(writer, texture.model);
    if (!kind) {
      kind = "constant";
      p.input("value", ConstantSpectrum{0.5f}, texture.is_float);
    }
    const bool moved = writer.texture_to_world() != Transform{};
    if (moved) w.begin("AttributeBegin"), w.transform(writer.texture_to_world());
    w.line(fmt::format("Texture {} \"{}\" \"{}\"{}", in_quotes(w.textures[i]),
                       texture.is_float ? "float" : "spectrum", kind, p.list()));
    if (moved) w.end("AttributeEnd");
  }
}

}  // namespace vitrail::pbrt
