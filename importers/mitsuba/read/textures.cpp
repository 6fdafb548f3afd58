// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <filesystem>
#include <stdexcept>

#include "importers/mitsuba/read/builder.h"
#include "importers/mitsuba/read/png_gamma.h"
#include "importers/mitsuba/read/properties.h"
#include "importers/mitsuba/read/volume_file.h"
#include "importers/reading/suggestion.h"
#include "scene/spectra/rgb_to_spectrum.h"

namespace vitrail::mitsuba {

namespace {

// (s,t) of the Scene from (u,v): by the 2×3 part of to_uv.
UvMapping mapping_of(const Transform& t) {
  const auto entry = [&](std::size_t row, std::size_t column) {
    return static_cast<float>(t.m[row][column]);
  };
  return {entry(0, 0), entry(0, 1), entry(0, 3), entry(1, 0), entry(1, 1), entry(1, 3)};
}

// Mitsuba's image begins at its top row, the Scene's at its bottom row: t = 1 − v.
UvMapping flipped(const UvMapping& m) {
  const auto negated = [](float v) { return v == 0 ? 0.0f : -v; };
  return {m.a, m.b, m.c, negated(m.d), negated(m.e), static_cast<float>(1 - static_cast<double>(m.f))};
}

// Cells of a checkerboard are half a unit.
UvMapping doubled(const UvMapping& m) { return {2 * m.a, 2 * m.b, 2 * m.c, 2 * m.d, 2 * m.e, 2 * m.f}; }

// What 0.6 may take of an image in place of its colour.
ImageNumber channel_of(Builder& b, const Object& o) {
  static constexpr std::string_view names = "rgba";
  static constexpr std::array numbers{ImageNumber::red, ImageNumber::green, ImageNumber::blue,
                                      ImageNumber::alpha};
  const std::string name = o.text("channel", "", b.report);
  if (name.empty()) return ImageNumber::luminance;
  const std::size_t channel = names.find(name);
  if (name.size() == 1 && channel != names.npos) return numbers.at(channel);
  b.report.dropped(fmt::format("the channel \"{}\" of an image: all of its colour counts", name), o.origin);
  return ImageNumber::luminance;
}

TextureModel bitmap(Builder& b, const Object& o, bool as_float) {
  // A channel is a grey where a colour is asked for.
  if (!as_float && !o.text("channel", "", b.report).empty())
    return ProductTexture{ConstantSpectrum{1}, add_texture(b, o, true)};
  ImageTexture image;
  image.filename = o.text("filename", "", b.report);
  if (image.filename.empty()) b.report.fail("a bitmap needs a \"filename\"", o.origin);
  if (o.boolean("raw", false, b.report)) image.encoding = Encoding::linear;
  double gamma = o.number("gamma", 0, b.report);  // 0.6: 0 stands for the file's own
  if (o.boolean("gamma_of_file", false, b.report) && gamma == 0)
    gamma = png_gamma(image.filename).value_or(0);
  if (gamma > 0) image.encoding = Encoding::gamma, image.gamma = static_cast<float>(gamma);
  if (gamma < 0) image.encoding = Encoding::srgb;
  const std::string filter = o.text("filter_type", "bilinear", b.report);
  image.filter = filter == "nearest"     ? TextureFilter::nearest
                 : filter == "trilinear" ? TextureFilter::trilinear
                 : filter == "ewa"       ? TextureFilter::anisotropic
                                         : TextureFilter::bilinear;
  const std::string both = o.text("wrap_mode", "repeat", b.report);
  const std::string wrap = o.text("wrap_mode_u", both, b.report);  // 0.6 has one for each direction
  if (const std::string v = o.text("wrap_mode_v", both, b.report); v != wrap)
    b.report.approximated(fmt::format("wrap_mode_v \"{}\" becomes \"{}\" as in u", v, wrap), o.origin);
  if (wrap == "mirror") image.wrap = Wrap::mirror;
  if (wrap == "clamp") image.wrap = Wrap::clamp;
  if (wrap != "mirror" && wrap != "clamp" && wrap != "repeat")
    b.report.approximated(fmt::format("wrap_mode \"{}\" becomes \"repeat\"", wrap), o.origin);
  image.number = channel_of(b, o);
  image.mapping = flipped(mapping_of(o.transform("to_uv", b.report)));
  o.ignore({"format", "accel", "max_anisotropy", "cache"});
  return image;
}

SpectrumParameter input(Builder& b, const Object& o, const char* name, double otherwise, bool as_float) {
  if (!as_float)
    return spectrum_parameter(b, o, name, Quantity::reflectance,
                              ConstantSpectrum{static_cast<float>(otherwise)});
  const FloatParameter value = float_parameter(b, o, name, otherwise);
  if (const auto* id = std::get_if<Id<Texture>>(&value)) return *id;
  return ConstantSpectrum{std::get<float>(value)};
}

// Where Mitsuba looks up a number, its checkerboard has the two values the other way round.
TextureModel checkerboard(Builder& b, const Object& o, bool as_float) {
  CheckerboardTexture board{input(b, o, "color0", 0.4, as_float), input(b, o, "color1", 0.2, as_float)};
  if (as_float) std::swap(board.even, board.odd);
  board.mapping = doubled(mapping_of(o.transform("to_uv", b.report)));
  return board;
}

TextureModel mesh_attribute(Builder& b, const Object& o, bool) {
  MeshAttributeTexture attribute;
  const bool is_of_0_6 = o.type == "vertexcolors";  // of the mesh itself
  attribute.name = is_of_0_6 ? "vertex_color" : o.text("name", "", b.report);
  attribute.scale = static_cast<float>(o.number("scale", 1, b.report));
  if (attribute.name.empty()) b.report.fail("a mesh_attribute needs a \"name\"", o.origin);
  return attribute;
}

// 0.6: a texture times a factor.
TextureModel scaled_texture(Builder& b, const Object& o, bool as_float) {
  const Object* nested = o.child("texture");
  SpectrumParameter first = ConstantSpectrum{1};
  if (nested) first = add_texture(b, *nested, as_float);
  return ProductTexture{first, input(b, o, "scale", 1, as_float)};
}

// A grid that surfaces cut through is its mean: textures here go by (u,v).
TextureModel mean_of_grid(Builder& b, const Object& volume, bool as_float) {
  const std::string file = existing_file(b, volume, "filename");
  volume.ignore({"to_world", "use_grid_bbox", "wrap_mode", "filter_type", "raw", "accel"});
  std::error_code ignored;
  if (!std::filesystem::is_regular_file(file, ignored)) {  // and may be replaced
    b.report.dropped(fmt::format("cannot find the file \"{}\": grey 0.5 stands for it", file), volume.origin);
    return ProductTexture{ConstantSpectrum{0.5f}, ConstantSpectrum{1}};
  }
  std::vector<VolumeValues> values;
  try {
    values = values_of_volume(read_volume_header(file));
  } catch (const std::runtime_error& error) {
    b.report.fail(error.what(), place_of(volume, "filename"));
  }
  const auto mean = [&](std::size_t i) { return values[std::min(i, values.size() - 1)].mean; };
  const VolumeValues& first = values.front();
  b.report.approximated(
      fmt::format("texture \"volume\": the mean of its grid, {:.4g} in its first channel, of "
                  "values from {:.4g} to {:.4g}",
                  first.mean, first.least, first.greatest),
      volume.origin);
  const bool is_number = as_float || values.size() < 3;
  const Spectrum color = is_number ? Spectrum{ConstantSpectrum{static_cast<float>(mean(0))}}
                                   : Spectrum{unbounded_from_rgb({mean(0), mean(1), mean(2)})};
  return ProductTexture{color, ConstantSpectrum{1}};
}

// Of one layer, which our writer makes of a picture that is brighter than a bitmap may be: lamp_images.h.
TextureModel picture_of_grid(Builder& b, const Object& volume) {
  ImageTexture image;
  image.filename = volume.text("picture", "", b.report);
  if (volume.text("filter_type", "trilinear", b.report) == "nearest") image.filter = TextureFilter::nearest;
  const std::string wrap = volume.text("wrap_mode", "clamp", b.report);
  image.wrap = wrap == "repeat" ? Wrap::repeat : wrap == "mirror" ? Wrap::mirror : Wrap::clamp;
  image.mapping = PlanarMapping{volume.transform("to_world", b.report)};
  volume.ignore({"filename", "raw"});
  return image;
}

TextureModel volume_texture(Builder& b, const Object& o, bool as_float) {
  const Object* volume = o.child("volume");
  if (!volume) b.report.fail("a \"volume\" texture needs a volume", o.origin);
  if (volume->type == "gridvolume" && volume->has("picture")) return picture_of_grid(b, *volume);
  if (volume->type == "gridvolume") {
    TextureModel mean = mean_of_grid(b, *volume, as_float);
    report_unused(*volume, b.report, {"filename"});
    return mean;
  }
  if (volume->type != "constvolume")
    b.report.dropped(fmt::format("texture \"volume\" of a \"{}\": 1 stands for it", volume->type),
                     volume->origin);
  const SpectrumParameter value = input(b, *volume, "value", 1, as_float);
  volume->ignore({"to_world"});
  return ProductTexture{value, ConstantSpectrum{1}};
}

// 0.6's lines of a width on each side of whole u and v, and the edges of triangles.
TextureModel lines(Builder& b, const Object& o, bool as_float) {
  const bool is_grid = o.type == "gridtexture";
  const SpectrumParameter between = input(b, o, is_grid ? "color0" : "interior_color", is_grid ? 0.2 : 0.5,
                                          as_float),
                          line =
                              input(b, o, is_grid ? "color1" : "edge_color", is_grid ? 0.4 : 0.1, as_float);
  const double width = std::clamp(o.number("line_width", 0.01, b.report), 0.0, 0.5);
  o.ignore({"to_uv", "step_width"});
  const double share = is_grid ? 1 - (1 - 2 * width) * (1 - 2 * width) : 0;
  b.report.approximated(
      is_grid ? fmt::format("texture \"gridtexture\": its mean, of which {:.3g} are lines", share)
              : "texture \"wireframe\": the colour between its edges, of which it is nearly all",
      o.origin);
  return MixTexture{between, line, static_cast<float>(share)};
}

struct TextureKind {
  std::string_view name;
  TextureModel (*make)(Builder&, const Object&, bool);
};
constexpr std::array<TextureKind, 8> texture_kinds{{{"bitmap", bitmap},
                                                    {"volume", volume_texture},
                                                    {"checkerboard", checkerboard},
                                                    {"mesh_attribute", mesh_attribute},
                                                    {"vertexcolors", mesh_attribute},
                                                    {"gridtexture", lines},
                                                    {"wireframe", lines},
                                                    {"scale", scaled_texture}}};

TextureModel make_model(Builder& b, const Object& o, bool as_float) {
  std::vector<std::string> names;
  for (const TextureKind& kind : texture_kinds) {
    names.emplace_back(kind.name);
    if (o.type != kind.name) continue;
    TextureModel model = kind.make(b, o, as_float);
    report_unused(o, b.report,
                  {"filename", "filter_type", "wrap_mode", "wrap_mode_u", "wrap_mode_v", "raw", "to_uv",
                   "color0", "color1", "name", "scale"});
    return model;
  }
  b.report.dropped(
      fmt::format("texture \"{}\" is not supported and becomes 0.5{}", o.type, suggestion(o.type, names)),
      o.origin);
  return ProductTexture{ConstantSpectrum{0.5f}, ConstantSpectrum{1}};
}

}  // namespace

Id<Texture> add_texture(Builder& b, const Object& o, bool as_float) {
  const auto known = b.textures.find({&o, as_float});
  if (known != b.textures.end()) return known->second;
  const Report::Item before = b.report.begin_item({o.origin, RecordKind::texture});
  Texture texture{make_model(b, o, as_float), as_float, o.id.starts_with("_unnamed_") ? "" : o.id, o.origin};
  b.report.begin_item(before);
  const Id<Texture> id{static_cast<std::uint32_t>(b.scene.textures.size())};
  b.scene.textures.push_back(std::move(texture));
  b.textures[{&o, as_float}] = id;
  return id;
}

}  // namespace vitrail::mitsuba
