// SPDX-License-Identifier: Apache-2.0
// The parts of the pbrt writer share a Writer.
#pragma once

#include <fmt/format.h>

#include <array>
#include <filesystem>
#include <map>
#include <set>
#include <string>
#include <string_view>
#include <vector>

#include "importers/images/converted_images.h"
#include "importers/writing/conversion_notes.h"
#include "importers/writing/mesh_files.h"
#include "importers/writing/opacity_key.h"
#include "importers/writing/side_files.h"
#include "scene/records/scene.h"

namespace vitrail::pbrt {

struct Writer : ConversionNotes {
  std::filesystem::path directory;  // of the scene's file
  MeshFiles meshes;
  std::string text;
  std::vector<std::string> materials, textures, media, objects;  // names
  // They are of materials, as write_coverage finds them: which share of a surface is there, and of a blend
  // the weight of its second material in that share. Textures may be new ones, which only `textures` knows.
  std::vector<FloatParameter> coverage, amounts;
  // They are media that stand for the colour of glass, by the shapes of the scene that have it, and the
  // materials of which all shapes have one.
  std::map<const Shape*, std::string> tints;
  std::set<std::uint32_t> tinted;
  // They have been written already: names of materials, and the product of two opacities.
  std::string sheer, nothing, black;
  std::map<std::uint32_t, std::string> shining;  // by the material of a shape
  std::map<std::pair<OpacityKey, OpacityKey>, FloatParameter> alphas;

  Writer(const Scene& scene, const std::filesystem::path& out);
  Writer(const Writer&) = delete;

  // ---- Text
  void line(std::string_view what) { text += fmt::format("{:{}}{}\n", "", indent, what); }
  void begin(std::string_view block) { line(block), indent += 4; }
  void end(std::string_view block) { indent -= 4, line(block); }
  void transform(const Transform& t);  // nothing for the identity
  // Writes a motion: its transforms at both of `transform_times_s`, inverted where it is a camera's.
  void transforms(const Motion& motion, const Origin& of, RecordKind kind);
  std::array<double, 2> transform_times_s{0, 1};
  int indent = 0;

  // Returns a name that no other record of the names has, and adds it to them.
  static std::string add_name(std::vector<std::string>& names, std::string_view wanted);
  // Returns the path of a new file in OUT-KIND/, which it creates, relative to the scene's folder.
  std::string new_file(const std::string& kind, const char* extension);
  std::filesystem::path new_image() { return directory / new_file("images", "exr"); }
  ConvertedImages images{[this] { return std::filesystem::absolute(new_image()); }};

 private:
  SideFiles side_files_;
  std::map<std::string, std::size_t> file_counts_;  // by kind
};

std::string in_quotes(std::string_view text);

// It is a parameter list that is being written; `owner` is what its diagnostics are about.
class Parameters {
 public:
  Parameters(Writer& writer, std::string owner, const Origin& origin, RecordKind kind)
      : writer_(writer), owner_(std::move(owner)), origin_(origin), kind_(kind) {}

  Parameters& text(std::string_view name, std::string_view value);
  Parameters& texts(std::string_view name, std::initializer_list<std::string_view> values);
  Parameters& file(std::string_view name, const std::string& absolute);
  Parameters& boolean(std::string_view name, bool value);
  Parameters& integer(std::string_view name, int value);
  Parameters& number(std::string_view name, float value);
  Parameters& number(std::string_view name, double value);
  Parameters& numbers(std::string_view type_and_name, const auto& values) {
    list_ += fmt::format(" \"{}\" [ {} ]", type_and_name, fmt::join(values, " "));
    return *this;
  }
  Parameters& number(std::string_view name, const FloatParameter& value);
  Parameters& texture(std::string_view name, std::string_view texture);
  Parameters& spectrum(std::string_view name, const SpectrumParameter& value);
  // Writes the same where pbrt refuses an rgb above 1.
  Parameters& albedo(std::string_view name, const SpectrumParameter& value);
  // Writes an input of a texture of the kind that `is_float` says.
  Parameters& input(std::string_view name, const SpectrumParameter& value, bool is_float);
  // Writes the emission of a light: pbrt sets spectra and blackbodies to luminance 1, times "scale".
  Parameters& emission(std::string_view name, const Spectrum& value);

  void approximated(std::string_view how) {
    writer_.approximated(fmt::format("{}: {}", owner_, how), origin_, kind_);
  }
  void dropped(std::string_view why) { writer_.dropped(fmt::format("{}: {}", owner_, why), origin_, kind_); }
  const std::string& list() const { return list_; }
  Writer& writer() { return writer_; }

 private:
  void tabulated(std::string_view name, const TabulatedSpectrum& table);

  Writer& writer_;
  std::string owner_;
  Origin origin_;
  RecordKind kind_;
  std::string list_;
};

// ---- The parts, in the order of the file
void write_tints(Writer& writer);  // media that stand for the colour of glass: they decide the integrator
void write_view(Writer& writer);
void write_media(Writer& writer);
void write_textures(Writer& writer);
void write_coverage(Writer& writer);
void write_materials(Writer& writer);
void write_lights(Writer& writer);
void write_shapes(Writer& writer);

// It has the name of a shape's material, and the share of the shape that is there. pbrt's masks are the
// "alpha" of shapes. surface_of writes what it needs for that: it is called outside of blocks of attributes.
struct ShapeSurface {
  std::string material;
  FloatParameter alpha = 1.0f;
};
ShapeSurface surface_of(Writer& writer, const Shape& shape);

}  // namespace vitrail::pbrt
