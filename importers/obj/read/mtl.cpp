// SPDX-License-Identifier: Apache-2.0
#include "importers/obj/read/mtl.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "importers/bytes/input_bytes.h"
#include "importers/bytes/text_cursor.h"
#include "importers/obj/read/mtl_map.h"

namespace vitrail {

namespace {

// Programs write MTL's keywords in other letter cases: map_kd, KD.
std::string_view in_usual_case(std::string_view keyword) {
  static constexpr std::array<std::string_view, 31> usual{
      "newmtl", "illum",  "Ka",        "Kd",     "Ks",     "Ke",     "Tf",    "d",
      "Tr",     "Ni",     "Ns",        "Pr",     "Pm",     "Ps",     "Pc",    "Pcr",
      "aniso",  "anisor", "sharpness", "map_Kd", "map_Ks", "map_Ke", "map_d", "map_Pr",
      "map_Pm", "map_Ps", "map_bump",  "bump",   "disp",   "norm",   "map_Ka"};
  const auto same_letter = [](char a, char b) { return lower_case(a) == lower_case(b); };
  const auto found = std::ranges::find_if(
      usual, [&](std::string_view word) { return std::ranges::equal(word, keyword, same_letter); });
  return found == usual.end() ? keyword : *found;
}

class MtlReader {
 public:
  MtlReader(std::string_view name, const InputBytes& bytes, Diagnostics& diagnostics)
      : cursor_(name, after_byte_order_mark(bytes.begin(), bytes.end()), bytes.end(), true),
        folder_(std::filesystem::path(name).parent_path()),
        diagnostics_(diagnostics) {}

  std::vector<MtlMaterial> read() {
    while (cursor_.skip_to_text()) {
      place_ = cursor_.location();
      const std::string_view keyword = in_usual_case(cursor_.word());
      if (!keyword.starts_with('#')) read_statement(keyword);
      cursor_.skip_line();
    }
    return std::move(materials_);
  }

 private:
  void read_statement(std::string_view keyword) {
    if (keyword == "newmtl") {
      MtlMaterial& material = materials_.emplace_back();
      material.name = cursor_.rest_of_line();
      material.location = place_;
    } else if (materials_.empty()) {
      cursor_.fail(fmt::format("'{}' before any newmtl", printable(keyword)));
    } else if (!read_color_statement(keyword) && !read_number_statement(keyword) &&
               !read_map_statement(keyword)) {
      drop(keyword);
    }
  }

  bool read_color_statement(std::string_view keyword) {
    MtlMaterial& m = materials_.back();
    std::optional<RGB>* const color = keyword == "Kd"   ? &m.kd
                                      : keyword == "Ks" ? &m.ks
                                      : keyword == "Ke" ? &m.ke
                                      : keyword == "Tf" ? &m.tf
                                                        : nullptr;
    if (color) *color = read_color(keyword);
    return color;
  }

  bool read_number_statement(std::string_view keyword) {
    if (keyword == "illum") {
      materials_.back().illum = cursor_.integer("illum");
      return true;
    }
    static const std::map<std::string_view, std::optional<double> MtlMaterial::*> numbers{
        {"d", &MtlMaterial::d},        {"Tr", &MtlMaterial::tr}, {"Ni", &MtlMaterial::ni},
        {"Ns", &MtlMaterial::ns},      {"Pr", &MtlMaterial::pr}, {"Pm", &MtlMaterial::pm},
        {"Ps", &MtlMaterial::ps},      {"Pc", &MtlMaterial::pc}, {"Pcr", &MtlMaterial::pcr},
        {"aniso", &MtlMaterial::aniso}};
    const auto number = numbers.find(keyword);
    if (number == numbers.end()) return false;
    if (keyword == "d") skip_halo();
    materials_.back().*(number->second) = read_number(number->first.data());
    return true;
  }

  // "d -halo factor": more opaque towards the rim.
  void skip_halo() {
    TextCursor ahead = cursor_;
    if (ahead.word() != "-halo") return;
    cursor_ = ahead;
    note(Fidelity::dropped, "option -halo of d");
  }

  bool read_map_statement(std::string_view keyword) {
    static const std::map<std::string_view, std::string> maps{
        {"map_Kd", "map_Kd"}, {"map_Ks", "map_Ks"}, {"map_Ke", "map_Ke"}, {"map_d", "map_d"},
        {"map_Pr", "map_Pr"}, {"map_Pm", "map_Pm"}, {"map_Ps", "map_Ps"}, {"map_bump", "bump"},
        {"map_Bump", "bump"}, {"bump", "bump"},     {"disp", "bump"},     {"norm", "norm"}};
    const auto found = maps.find(keyword);
    if (found == maps.end()) return false;
    const auto report = [this](std::string message) { note(Fidelity::dropped, std::move(message)); };
    const std::string word(keyword);
    MtlMap map = obj::read_map(cursor_, word, folder_, report);
    MtlMaterial& material = materials_.back();
    if (keyword == "disp" && material.maps.contains("bump")) {
      drop("disp");
    } else {
      material.maps[found->second] = std::move(map);
    }
    if (found->second == "bump")
      note(Fidelity::approximated,
           fmt::format("{} of a material: heights that tilt normals only (Blender writes normal maps so, "
                       "which belong under norm)",
                       word));
    return true;
  }

  // Values that change nothing are not worth a word: black Ka, rotations of what is isotropic.
  void drop(std::string_view keyword) {
    if (keyword == "Ka" && read_color(keyword) == RGB{0, 0, 0}) return;
    if (keyword == "anisor" && read_number("anisor") == 0) return;
    if (keyword == "sharpness") return;  // of reflected images in local reflection maps
    note(Fidelity::dropped, fmt::format("{} of a material", printable(keyword)));
  }

  // Without the material's name, which its place tells: messages that are equal can be counted.
  void note(Fidelity fidelity, std::string message) {
    diagnostics_.push_back(
        {fidelity, std::move(message), place_, materials_.back().location, RecordKind::material});
  }

  double read_number(const char* what) {
    const char* const begin = cursor_.at();
    const double value = cursor_.number(what);
    if (!std::isfinite(static_cast<float>(value))) cursor_.fail(fmt::format("{} is not finite", what), begin);
    return value;
  }

  // "r g b", or "r" for a grey. The forms "spectral file" and "xyz x y z" are dropped.
  std::optional<RGB> read_color(std::string_view keyword) {
    TextCursor ahead = cursor_;
    const std::string_view first = ahead.word();
    if (first == "spectral" || first == "xyz") {
      note(Fidelity::dropped, fmt::format("{} {} of a material", keyword, first));
      return {};
    }
    RGB color;
    color.r = color.g = color.b = read_number("a colour's red");
    if (at_end()) return color;
    color.g = read_number("a colour's green");
    color.b = read_number("a colour's blue");
    return color;
  }

  bool at_end() { return cursor_.at_line_end() || cursor_.sees('#'); }

  TextCursor cursor_;
  std::filesystem::path folder_;
  Diagnostics& diagnostics_;
  SourceLocation place_;
  std::vector<MtlMaterial> materials_;
};

}  // namespace

std::vector<MtlMaterial> read_mtl(const std::filesystem::path& file, Diagnostics& diagnostics) {
  const InputBytes bytes(file);
  const std::string name = file.string();
  return MtlReader(name, bytes, diagnostics).read();
}

}  // namespace vitrail
