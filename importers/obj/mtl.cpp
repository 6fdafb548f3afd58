// SPDX-License-Identifier: Apache-2.0
#include "importers/obj/mtl.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <set>

#include "importers/ply/input_bytes.h"
#include "importers/ply/text_cursor.h"
#include "scene/rgb_to_spectrum.h"

namespace vitrail {

namespace {

struct Statements {
  std::string name;
  SourceLocation location;
  std::optional<RGB> kd, ke;
  std::optional<double> d, tr, ni;
  std::int64_t illum = 2;
  bool has_map_kd = false;
};

class MtlReader {
 public:
  MtlReader(std::string_view name, const InputBytes& bytes, Diagnostics& diagnostics)
      : cursor_(name, bytes.begin(), bytes.end(), true), diagnostics_(diagnostics) {}

  std::vector<MtlMaterial> read() {
    while (cursor_.skip_to_text()) {
      place_ = cursor_.location();
      const std::string_view keyword = cursor_.word();
      if (!keyword.starts_with('#')) read_statement(keyword);
      cursor_.skip_line();
    }
    finish_material();
    return std::move(materials_);
  }

 private:
  void read_statement(std::string_view keyword) {
    if (keyword == "newmtl") {
      finish_material();
      open_.emplace();
      open_->name = cursor_.rest_of_line();
      open_->location = place_;
    } else if (!open_) {
      cursor_.fail(fmt::format("'{}' before any newmtl", printable(keyword)));
    } else if (keyword == "Kd") {
      open_->kd = read_color(keyword);
    } else if (keyword == "Ke") {
      open_->ke = read_color(keyword);
    } else if (keyword == "d") {
      open_->d = read_number("d");
    } else if (keyword == "Tr") {
      open_->tr = read_number("Tr");
    } else if (keyword == "Ni") {
      open_->ni = read_number("Ni");
    } else if (keyword == "illum") {
      open_->illum = cursor_.integer("illum");
    } else {
      drop(keyword);
    }
  }

  // Values that change nothing are not worth a word: black Ka and Ks, white filters, and Ns, which only
  // shapes Ks.
  void drop(std::string_view keyword) {
    if (keyword == "Ns") return;
    if (keyword == "Ka" || keyword == "Ks") {
      if (read_color(keyword) == RGB{0, 0, 0}) return;
    } else if (keyword == "Tf") {
      if (read_color(keyword) == RGB{1, 1, 1}) return;
    } else if (keyword == "map_Kd") {
      open_->has_map_kd = true;
    }
    const std::string word = printable(keyword);
    note(word, Fidelity::dropped, fmt::format("{} of material {}", word, printable(open_->name)));
  }

  void note(const std::string& key, Fidelity fidelity, std::string message) {
    if (noted_.insert(key).second) diagnostics_.push_back({fidelity, std::move(message), place_});
  }

  double read_number(const char* what) {
    const char* const begin = cursor_.at();
    const double value = cursor_.number(what);
    if (!std::isfinite(value)) cursor_.fail(fmt::format("{} is not finite", what), begin);
    return value;
  }

  // "r g b", or "r" for a grey. The forms "spectral file" and "xyz x y z" are dropped.
  std::optional<RGB> read_color(std::string_view keyword) {
    TextCursor ahead = cursor_;
    const std::string_view first = ahead.word();
    if (first == "spectral" || first == "xyz") {
      note(fmt::format("{} {}", keyword, first), Fidelity::dropped,
           fmt::format("{} {} of material {}", keyword, first, printable(open_->name)));
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

  void finish_material() {
    if (!open_) return;
    place_ = open_->location;
    MtlMaterial result{open_->name, surface(*open_), {}, open_->location};
    const RGB ke = open_->ke.value_or(RGB{});
    if (ke.r < 0 || ke.g < 0 || ke.b < 0) note("Ke < 0", Fidelity::approximated, "negative Ke counts as 0");
    if (std::max({ke.r, ke.g, ke.b}) > 0) result.light = AreaLight{emission_from_rgb(ke), true};
    materials_.push_back(std::move(result));
    open_.reset();
  }

  Material surface(const Statements& s) {
    if (s.d && s.tr && *s.d != 1 - *s.tr) {
      note("d and Tr", Fidelity::dropped,
           fmt::format("Tr of material {}: its d says otherwise", printable(s.name)));
    }
    const double opacity = s.d ? *s.d : s.tr ? 1 - *s.tr : 1;
    const bool glass = s.illum == 4 || s.illum == 6 || s.illum == 7 || s.illum == 9;
    if ((opacity < 1 || glass) && s.ni && *s.ni > 1) {
      return {DielectricMaterial{ConstantSpectrum{static_cast<float>(*s.ni)}}};
    }
    if (opacity <= 0) return {InterfaceMaterial{}};
    if (opacity < 1) {
      note("d", Fidelity::approximated,
           fmt::format("material {} is {} opaque and has no Ni above 1: taken as opaque", printable(s.name),
                       opacity));
    }
    if (s.illum > 2) {
      note(fmt::format("illum {}", s.illum), Fidelity::approximated,
           fmt::format("illum {} of material {}: taken as diffuse", s.illum, printable(s.name)));
    }
    return diffuse(s);
  }

  Material diffuse(const Statements& s) {
    const double unset = s.has_map_kd ? 0.5 : 0;
    const RGB kd = s.kd.value_or(RGB{unset, unset, unset});
    if (std::min({kd.r, kd.g, kd.b}) < 0 || std::max({kd.r, kd.g, kd.b}) > 1) {
      note(
          "Kd range", Fidelity::approximated,
          fmt::format("Kd {} {} {} of material {} is clamped to 0 … 1", kd.r, kd.g, kd.b, printable(s.name)));
    }
    return {DiffuseMaterial{reflectance_from_rgb(kd)}};
  }

  TextCursor cursor_;
  Diagnostics& diagnostics_;
  SourceLocation place_;
  std::optional<Statements> open_;
  std::vector<MtlMaterial> materials_;
  std::set<std::string> noted_;
};

}  // namespace

std::vector<MtlMaterial> read_mtl(const std::filesystem::path& file, Diagnostics& diagnostics) {
  const InputBytes bytes(file);
  const std::string name = file.string();
  return MtlReader(name, bytes, diagnostics).read();
}

}  // namespace vitrail
