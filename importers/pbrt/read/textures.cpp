// SPDX-License-Identifier: Apache-2.0
#include "importers/pbrt/read/textures.h"

#include <fmt/format.h>

#include <algorithm>
#include <numbers>

#include "importers/pbrt/read/image_numbers.h"
#include "importers/reading/suggestion.h"
#include "scene/spectra/rgb_to_spectrum.h"

namespace vitrail::pbrt {

namespace {

template <class Table>
const auto* find_in(const Table& table, const Parameter& parameter) {
  const auto found = table.find(parameter.strings.front());
  return found == table.end() ? nullptr : &found->second;
}

[[noreturn]] void fail_undefined(const Parameter& parameter, const TextureTable& textures) {
  std::vector<std::string> known;
  for (const auto& entry : textures.spectra) known.push_back(entry.first);
  for (const auto& entry : textures.numbers) known.push_back(entry.first);
  std::sort(known.begin(), known.end());
  fail(fmt::format("texture \"{}\" is not defined{}", parameter.strings.front(),
                   suggestion(parameter.strings.front(), known)),
       parameter.place);
}

// The same texture read as the other of number and colour. pbrt has no such thing: a colour is a number by
// its luminance.
Id<Texture> converted(Id<Texture> id, bool to_float, const Parameter& parameter, const Scope& scope) {
  scope.context.report.approximated(
      fmt::format("texture \"{}\" is a {} texture, but \"{}\" needs a {}", parameter.strings.front(),
                  to_float ? "spectrum" : "float", parameter.name, to_float ? "number" : "colour"),
      parameter.place);
  Texture copy = scope.made.at(id.value);
  copy.is_float = to_float;
  scope.made.push_back(std::move(copy));
  return {static_cast<std::uint32_t>(scope.made.size() - 1)};
}

void require_one_name(const Parameter& parameter) {
  if (parameter.strings.size() != 1)
    fail(fmt::format("texture parameter \"{}\" needs one name", parameter.name), parameter.place);
}

SpectrumParameter spectrum_texture(const Parameter& parameter, const Scope& scope) {
  require_one_name(parameter);
  if (const auto* found = find_in(scope.textures.spectra, parameter)) return *found;
  const auto* number = find_in(scope.textures.numbers, parameter);
  if (!number) fail_undefined(parameter, scope.textures);
  if (const auto* value = std::get_if<float>(number)) return ConstantSpectrum{*value};
  return converted(std::get<Id<Texture>>(*number), false, parameter, scope);
}

FloatParameter float_texture(const Parameter& parameter, const Scope& scope) {
  require_one_name(parameter);
  if (const auto* found = find_in(scope.textures.numbers, parameter)) return *found;
  const auto* spectrum = find_in(scope.textures.spectra, parameter);
  if (!spectrum) fail_undefined(parameter, scope.textures);
  if (const auto* value = std::get_if<Spectrum>(spectrum)) return static_cast<float>(luminance(*value));
  return converted(std::get<Id<Texture>>(*spectrum), true, parameter, scope);
}

Spectrum read_quantity(const Parameter& parameter, Quantity quantity, const SpectrumScope& scope) {
  if (quantity == Quantity::reflectance) return read_reflectance(parameter, scope);
  return quantity == Quantity::unbounded ? read_unbounded(parameter, scope)
                                         : read_refraction(parameter, scope);
}

// ---- Texture directives

struct TextureMaker {
  const std::string& kind;
  const std::string& name;
  bool is_float;
  ParameterSet& parameters;
  const Transform& texture_to_world;
  const Scope& scope;

  void approximated(const std::string& how) const {
    scope.context.report.approximated(fmt::format("texture \"{}\" ({}): {}", name, kind, how),
                                      parameters.place());
  }
  // An input of the texture's own kind.
  SpectrumParameter input(std::string_view of, double otherwise) const {
    if (!is_float)
      return spectrum_parameter(parameters, {of}, Quantity::unbounded,
                                ConstantSpectrum{static_cast<float>(otherwise)}, scope);
    const FloatParameter value = float_parameter(parameters, {of}, otherwise, scope);
    if (const auto* id = std::get_if<Id<Texture>>(&value)) return *id;
    return ConstantSpectrum{std::get<float>(value)};
  }
  FloatParameter number_input(std::string_view of, double otherwise) const {
    return float_parameter(parameters, {of}, otherwise, scope);
  }
  float number(std::string_view of, double otherwise) const {
    return static_cast<float>(parameters.number(of, otherwise));
  }

  bool is_v3() const { return scope.context.version == Version::v3; }
  // Textures of three dimensions. v3 looks them up where the transform, not its inverse, puts the point.
  Transform solid_to_world() const { return is_v3() ? inverse(texture_to_world) : texture_to_world; }
  TextureMapping mapping() const {
    const std::string by = parameters.text("mapping", "uv");
    if (by == "spherical") return SphericalMapping{texture_to_world};
    if (by == "cylindrical") return CylindricalMapping{texture_to_world, is_v3()};
    if (by == "planar") {
      const auto vector = [&](const char* of, Vector3d otherwise) {
        const auto v = parameters.triple(of);
        return v ? Vector3d{(*v)[0], (*v)[1], (*v)[2]} : otherwise;
      };
      return PlanarMapping{is_v3() ? Transform{} : texture_to_world,  // v3: in world space
                           vector("v1", {1, 0, 0}), vector("v2", {0, 1, 0}), parameters.number("udelta", 0),
                           parameters.number("vdelta", 0)};
    }
    if (by != "uv") approximated(fmt::format("mapping \"{}\" is not known and read as \"uv\"", by));
    return UvMapping{number("uscale", 1), 0, number("udelta", 0), 0, number("vscale", 1),
                     number("vdelta", 0)};
  }
};

Wrap read_wrap(const TextureMaker& m) {
  const std::string wrap = m.parameters.text("wrap", "repeat");
  if (wrap == "clamp") return Wrap::clamp;
  if (wrap == "black") return Wrap::black;
  if (wrap != "repeat") m.approximated(fmt::format("wrap \"{}\" becomes \"repeat\"", wrap));
  return Wrap::repeat;
}

TextureFilter read_texture_filter(const TextureMaker& m) {
  m.parameters.ignore({"maxanisotropy"});
  if (m.parameters.boolean("trilinear", false)) return TextureFilter::trilinear;
  const std::string filter = m.parameters.text("filter", m.is_v3() ? "ewa" : "bilinear");
  if (filter == "point") return TextureFilter::nearest;
  if (filter == "trilinear") return TextureFilter::trilinear;
  if (filter == "ewa" || filter == "EWA") return TextureFilter::anisotropic;
  if (filter != "bilinear") m.approximated(fmt::format("filter \"{}\" becomes \"bilinear\"", filter));
  return TextureFilter::bilinear;
}

void read_encoding(const TextureMaker& m, Encoding& encoding, float& gamma) {
  if (m.parameters.find("gamma", {ParameterType::boolean})) {
    encoding = m.parameters.boolean("gamma", true) ? Encoding::srgb : Encoding::linear;
    return;
  }
  const std::string text = m.parameters.text("encoding", "");
  if (text == "sRGB")
    encoding = Encoding::srgb;
  else if (text == "linear")
    encoding = Encoding::linear;
  else if (text.starts_with("gamma ")) {
    encoding = Encoding::gamma;
    gamma = std::strtof(text.c_str() + 6, nullptr);
    if (!(gamma > 0)) fail(fmt::format("encoding \"{}\" needs a number above 0", text), m.parameters.place());
  } else if (!text.empty()) {
    m.approximated(
        fmt::format("encoding \"{}\" is not known: sRGB, linear, or gamma and a number are", text));
  }
}

std::string file_of(const TextureMaker& m) {
  const Parameter* filename = m.parameters.find("filename", {ParameterType::text});
  if (!filename) filename = m.parameters.find("mapname", {ParameterType::text});
  if (!filename || filename->strings.size() != 1)
    fail(fmt::format("texture \"{}\" needs a parameter \"string filename\"", m.name), m.parameters.place());
  return find_file(*filename, m.scope.context);
}

TextureModel image_texture(const TextureMaker& m) {
  ImageTexture t;
  t.filename = file_of(m);
  t.mapping = m.mapping();
  t.wrap = read_wrap(m);
  t.filter = read_texture_filter(m);
  read_encoding(m, t.encoding, t.gamma);
  if (!m.is_v3() && !takes_encoding(t.filename)) t.encoding = Encoding::automatic, t.gamma = 1;
  t.scale = m.number("scale", 1);
  t.invert = m.parameters.boolean("invert", false);
  const Version version = m.scope.context.version;
  t.number = m.is_float ? number_taken(version, t.filename, t.filter) : ImageNumber::luminance;
  t.primaries = primaries_taken(version, m.is_float);
  return t;
}

TextureModel ptex_texture(const TextureMaker& m) {
  PtexTexture t;
  t.filename = file_of(m);
  read_encoding(m, t.encoding, t.gamma);
  if (const double gamma = m.parameters.number("gamma", 2.2); gamma != 2.2) {  // v3's
    t.encoding = gamma == 1 ? Encoding::linear : Encoding::gamma;
    t.gamma = static_cast<float>(gamma);
  }
  t.scale = m.number("scale", 1);
  return t;
}

TextureModel checkerboard_texture(const TextureMaker& m) {
  CheckerboardTexture t{m.input("tex1", 1), m.input("tex2", 0)};
  t.solid = m.parameters.integer("dimension", 2) == 3;
  if (t.solid)
    t.texture_to_world = m.solid_to_world();
  else
    t.mapping = m.mapping();
  m.parameters.ignore({"aamode"});
  return t;
}

// pbrt-v3 and v4 show what is named "inside" around the dots, and what is named "outside" in them.
TextureModel dots_texture(const TextureMaker& m) {
  return DotsTexture{m.input("outside", 0), m.input("inside", 1), m.mapping()};
}

TextureModel mix_texture(const TextureMaker& m) {
  return MixTexture{m.input("tex1", 0), m.input("tex2", 1), m.number_input("amount", 0.5)};
}

TextureModel direction_mix_texture(const TextureMaker& m) {
  const auto v = m.parameters.triple("dir").value_or(std::array<double, 3>{0, 1, 0});
  return DirectionMixTexture{m.input("tex1", 0), m.input("tex2", 1),
                             unit(transform_vector(m.texture_to_world, {v[0], v[1], v[2]}))};
}

// v4: tex · scale, a float; v3: tex1 · tex2.
TextureModel product_texture(const TextureMaker& m) {
  const bool v3 = m.parameters.find("tex1", {ParameterType::texture, ParameterType::number,
                                             ParameterType::rgb, ParameterType::spectrum}) != nullptr;
  if (v3) return ProductTexture{m.input("tex1", 1), m.input("tex2", 1)};
  const FloatParameter scale = m.number_input("scale", 1);
  const SpectrumParameter tex = m.input("tex", 1);
  if (const auto* value = std::get_if<float>(&scale)) return ProductTexture{tex, ConstantSpectrum{*value}};
  return ProductTexture{tex, std::get<Id<Texture>>(scale)};
}

TextureModel bilinear_texture(const TextureMaker& m) {
  return BilinearTexture{m.input("v00", 0), m.input("v01", 1), m.input("v10", 0), m.input("v11", 1),
                         m.mapping()};
}

TextureModel noise_texture(const TextureMaker& m) {
  NoiseTexture t;
  t.kind = m.kind == "wrinkled" ? NoiseTexture::Kind::wrinkled
           : m.kind == "windy"  ? NoiseTexture::Kind::windy
           : m.kind == "marble" ? NoiseTexture::Kind::marble
                                : NoiseTexture::Kind::fbm;
  t.texture_to_world = m.solid_to_world();
  constexpr int most_octaves = 64;
  const int octaves = m.parameters.integer("octaves", 8);
  t.octaves = std::clamp(octaves, 0, most_octaves);
  if (octaves > most_octaves)
    m.approximated(fmt::format("of {} octaves the first {} count", octaves, most_octaves));
  t.roughness = m.number("roughness", 0.5);
  t.scale = m.number("scale", 1);
  t.variation = m.number("variation", 0.2);
  return t;
}

TextureModel uv_texture(const TextureMaker& m) { return UvTexture{m.mapping()}; }

struct TextureKind {
  std::string_view name;
  TextureModel (*make)(const TextureMaker&);
};
constexpr std::array<TextureKind, 13> texture_kinds{{{"imagemap", image_texture},
                                                     {"ptex", ptex_texture},
                                                     {"checkerboard", checkerboard_texture},
                                                     {"dots", dots_texture},
                                                     {"mix", mix_texture},
                                                     {"directionmix", direction_mix_texture},
                                                     {"scale", product_texture},
                                                     {"bilerp", bilinear_texture},
                                                     {"fbm", noise_texture},
                                                     {"wrinkled", noise_texture},
                                                     {"windy", noise_texture},
                                                     {"marble", noise_texture},
                                                     {"uv", uv_texture}}};

Id<Texture> make_texture(const TextureMaker& m) {
  for (const TextureKind& known : texture_kinds) {
    if (m.kind != known.name) continue;
    Texture texture{known.make(m), m.is_float, m.name, m.scope.origin};
    m.parameters.report_unused(m.scope.context.report);
    m.scope.made.push_back(std::move(texture));
    return {static_cast<std::uint32_t>(m.scope.made.size() - 1)};
  }
  std::vector<std::string> names{"constant"};
  for (const TextureKind& known : texture_kinds) names.emplace_back(known.name);
  fail(fmt::format("texture \"{}\" is of the unknown kind \"{}\"{}", m.name, m.kind,
                   suggestion(m.kind, names)),
       m.parameters.place());
}

}  // namespace

SpectrumParameter spectrum_parameter(ParameterSet& parameters, std::initializer_list<std::string_view> names,
                                     Quantity quantity, const Spectrum& otherwise, const Scope& scope) {
  for (const std::string_view name : names) {
    if (const Parameter* texture = parameters.find(name, {ParameterType::texture}))
      return spectrum_texture(*texture, scope);
    if (const Parameter* value = parameters.find_spectrum(name))
      return read_quantity(*value, quantity, scope);
  }
  return otherwise;
}

FloatParameter float_parameter(ParameterSet& parameters, std::initializer_list<std::string_view> names,
                               double otherwise, const Scope& scope) {
  for (const std::string_view name : names) {
    if (const Parameter* texture = parameters.find(name, {ParameterType::texture}))
      return float_texture(*texture, scope);
    if (parameters.find(name, {ParameterType::number, ParameterType::integer}))
      return static_cast<float>(parameters.number(name, otherwise));
  }
  return static_cast<float>(otherwise);
}

Spectrum spectrum_value(ParameterSet& parameters, std::initializer_list<std::string_view> names,
                        Quantity quantity, const Spectrum& otherwise, const Scope& scope) {
  const SpectrumParameter parameter = spectrum_parameter(parameters, names, quantity, otherwise, scope);
  if (const auto* value = std::get_if<Spectrum>(&parameter)) return *value;
  fail(fmt::format("\"{}\" of {} cannot be a texture that varies", *names.begin(), parameters.owner()),
       parameters.place());
}

bool textures_are_known(const ParameterSet& parameters, const TextureTable& textures) {
  return std::all_of(parameters.all().begin(), parameters.all().end(), [&](const Parameter& parameter) {
    return parameter.type != ParameterType::texture || parameter.strings.empty() ||
           textures.spectra.contains(parameter.strings.front()) ||
           textures.numbers.contains(parameter.strings.front());
  });
}

SpectrumParameter make_spectrum_texture(const std::string& kind, const std::string& name,
                                        ParameterSet& parameters, const Transform& ctm, const Scope& scope) {
  const TextureMaker m{kind, name, false, parameters, ctm, scope};
  if (kind != "constant") return make_texture(m);
  SpectrumParameter value = m.input("value", 1);
  parameters.report_unused(scope.context.report);
  return value;
}

FloatParameter make_float_texture(const std::string& kind, const std::string& name, ParameterSet& parameters,
                                  const Transform& ctm, const Scope& scope) {
  const TextureMaker m{kind, name, true, parameters, ctm, scope};
  if (kind != "constant") return make_texture(m);
  const FloatParameter value = m.number_input("value", 1);
  parameters.report_unused(scope.context.report);
  return value;
}

Id<Texture> add_image(const Parameter& filename, Encoding encoding, const Scope& scope) {
  if (filename.strings.size() != 1)
    fail(fmt::format("\"{}\" needs one file name", filename.name), filename.place);
  ImageTexture image;
  image.filename = find_file(filename, scope.context);
  image.encoding = encoding;
  image.primaries = primaries_taken(scope.context.version);
  scope.made.push_back({image, false, "", scope.origin});
  return {static_cast<std::uint32_t>(scope.made.size() - 1)};
}

}  // namespace vitrail::pbrt
