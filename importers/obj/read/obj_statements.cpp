// SPDX-License-Identifier: Apache-2.0
#include "importers/obj/read/obj_statements.h"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <cmath>
#include <limits>

#include "scene/spectra/color.h"

namespace vitrail::obj {

StatementReader::StatementReader(const std::string& file, const ParseOptions& options, Geometry& geometry)
    : file_(file),
      options_(options),
      geometry_(geometry),
      faces_(geometry),
      cursor_(file, nullptr, nullptr),
      start_(cursor_) {
  geometry_.materials.push_back({});
  geometry_.objects.push_back({});
  object_of_names_.emplace("\n", 0);
  choose_use();
}

int StatementReader::read(const char* begin, const char* end, int line) {
  cursor_ = TextCursor(file_, begin, end, true, line);
  while (cursor_.skip_to_text() && !counts_from_zero_) read_statement();
  return cursor_.line();
}

void StatementReader::finish() {
  is_last_chance_ = true;
  for (const ForwardFace& face : forward_) {
    if (counts_from_zero_) return;
    use_ = face.use;
    smoothing_group_ = face.smoothing_group;
    cursor_ = start_ = face.at;
    read_face(face.counts);
  }
  if (unknown_ && geometry_.positions.empty()) {
    unknown_->fail("not an OBJ file: no vertices, and this is no statement of OBJ");
  }
}

// ---- Statements -------------------------------------------------------------------------------

void StatementReader::read_statement() {
  start_ = cursor_;
  const std::string_view keyword = cursor_.word();
  if (keyword == "v") {
    read_position();
  } else if (keyword == "f") {
    read_face(counts());
  } else if (keyword == "vt") {
    geometry_.uvs.push_back(read_uv());
  } else if (keyword == "vn") {
    const float x = component(), y = component();
    geometry_.normals.push_back({x, y, component()});
  } else if (keyword.starts_with('#')) {
    cursor_.skip_line();
    return;
  } else {
    read_rare(keyword);
  }
  if (!at_end()) cursor_.fail("unexpected text at the end of the statement");
  if (cursor_.sees('#')) cursor_.skip_line();
}

void StatementReader::read_rare(std::string_view keyword) {
  if (keyword == "usemtl") {
    use_material();
  } else if (keyword == "mtllib") {
    geometry_.libraries.push_back({std::string(cursor_.rest_of_line()), start_.location()});
  } else if (keyword == "s") {
    use_smoothing_group();
  } else if (keyword == "o" || keyword == "g") {
    use_object(keyword == "g");
  } else {
    drop(keyword);
    skip_statement();
  }
}

void StatementReader::drop(std::string_view keyword) {
  static constexpr std::array<std::string_view, 33> known{
      "p",     "l",        "vp",       "cstype", "deg",    "bmat",   "step",       "curv",      "curv2",
      "surf",  "parm",     "trim",     "hole",   "scrv",   "sp",     "end",        "con",       "mg",
      "bevel", "c_interp", "d_interp", "lod",    "usemap", "maplib", "shadow_obj", "trace_obj", "ctech",
      "stech", "call",     "csh",      "bsp",    "bzp",    "cdc"};
  const std::string word = printable(keyword);
  const bool is_known = std::ranges::count(known, keyword) > 0;
  if (!is_known && !unknown_) unknown_ = start_;
  constexpr std::size_t most_notes = 60;
  if (noted_.size() >= most_notes) return note("…", Fidelity::dropped, "further unknown keywords");
  note(word, Fidelity::dropped, fmt::format("{} '{}'", is_known ? "statement" : "unknown keyword", word));
}

void StatementReader::note(const std::string& key, Fidelity fidelity, std::string message) {
  if (!noted_.insert(key).second) return;
  geometry_.diagnostics.push_back({fidelity, std::move(message), start_.location()});
}

void StatementReader::skip_statement() {
  while (!at_end()) cursor_.word();
}

void StatementReader::use_material() {
  const std::string name(cursor_.rest_of_line());
  if (options_.one_material) return;
  const auto [entry, is_new] = material_of_name_.try_emplace(name, geometry_.materials.size());
  if (is_new) geometry_.materials.push_back({name, start_.location()});
  material_ = entry->second;
  choose_use();
}

// Where o has several names, those of g are parts of objects.
void StatementReader::use_object(bool is_group) {
  const std::string name(cursor_.rest_of_line());
  if (options_.bare || (is_group && geometry_.several_named)) return;
  if (!is_group) {
    if (first_o_.empty()) first_o_ = name;
    geometry_.several_named |= !name.empty() && name != first_o_;
    o_ = name;
  }
  g_ = is_group ? name : "";
  const auto [entry, is_new] =
      object_of_names_.try_emplace(fmt::format("{}\n{}", o_, g_), geometry_.objects.size());
  if (is_new && geometry_.objects.size() <= most_objects) {
    geometry_.objects.push_back({o_, g_, start_.location()});
  } else if (is_new) {
    object_of_names_.erase(entry);
    object_ = 0;
    note("objects", Fidelity::approximated,
         fmt::format("objects after the first {} have no names: those of one material are one shape",
                     most_objects));
    return choose_use();
  }
  object_ = entry->second;
  choose_use();
}

void StatementReader::choose_use() {
  const auto [entry, is_new] =
      use_of_.try_emplace(std::uint64_t{object_} << 32 | material_, geometry_.uses.size());
  if (is_new) geometry_.uses.push_back({object_, material_});
  use_ = entry->second;
}

// A number, "off" or, of some programs, "on".
void StatementReader::use_smoothing_group() {
  const std::string_view name = cursor_.word();
  skip_statement();
  if (options_.bare) return;
  std::uint32_t number = 0;
  const auto parsed = std::from_chars(name.data(), name.data() + name.size(), number);
  const bool is_number = parsed.ec == std::errc{} && parsed.ptr == name.data() + name.size();
  smoothing_group_ = is_number ? number : name == "off" || name.empty() ? 0 : 1;
}

// ---- Vertices ---------------------------------------------------------------------------------

double StatementReader::finite_number(const char* what) {
  cursor_.at_line_end();
  const char* const begin = cursor_.at();
  const double value = cursor_.number(what);
  if (!(std::abs(value) <= std::numeric_limits<float>::max())) {
    cursor_.fail(fmt::format("{} is not a finite single-precision number", what), begin);
  }
  return value;
}

float StatementReader::component() {
  const double value = cursor_.number("a component");
  if (std::abs(value) <= std::numeric_limits<float>::max()) return static_cast<float>(value);
  note("not finite", Fidelity::dropped,
       "components of normals, texture coordinates or colours that are not finite: 0");
  return 0;
}

void StatementReader::read_position() {
  const double x = finite_number("a coordinate"), y = finite_number("a coordinate");
  const Point3d p{x, y, finite_number("a coordinate")};
  extend(geometry_.bounds, p);
  geometry_.positions.push_back(cast<float>(p - options_.offset));
  if (at_end()) return;
  std::array<double, 4> values{};
  std::size_t more = 0;
  for (; !at_end(); ++more) {
    const auto value = static_cast<double>(component());
    if (more < values.size()) values[more] = value;
  }
  const bool has_weight = more == 1 || more == 4;
  if (has_weight) note("weight", Fidelity::dropped, "weights (w) of vertices: they count for curves only");
  if (more >= 3) add_color(std::span(values).subspan(has_weight ? 1 : 0, 3));
}

// Programs write what their screens show: shares of one in sRGB's encoding.
void StatementReader::add_color(std::span<const double> rgb) {
  if (options_.bare) return note("colour", Fidelity::dropped, "colours of vertices");
  geometry_.colors.resize(3 * (geometry_.positions.size() - 1), 1.0f);
  if (std::ranges::any_of(rgb, [](double value) { return value < 0 || value > 1; }))
    note("bright", Fidelity::approximated, "colours of vertices outside of 0 to 1: the nearest of these");
  for (const double value : rgb)
    geometry_.colors.push_back(static_cast<float>(srgb_decode(std::clamp(value, 0.0, 1.0))));
}

Point2f StatementReader::read_uv() {
  Point2f uv{component(), 0};
  if (!at_end()) uv.y = component();
  if (!at_end()) component();  // the third of a solid texture
  return uv;
}

// ---- Faces ------------------------------------------------------------------------------------

StatementReader::Counts StatementReader::counts() const {
  return {geometry_.positions.size(), geometry_.uvs.size(), geometry_.normals.size()};
}

// Negative indices count back from `before`.
void StatementReader::read_face(const Counts& before) {
  const ForwardFace face{start_, before, use_, smoothing_group_};
  if (is_last_chance_) cursor_.word();
  corners_.clear();
  bool forward = false;
  while (!at_end() && !counts_from_zero_) {
    corners_.push_back(read_corner(before, forward));
  }
  if (counts_from_zero_) return skip_statement();
  if (forward && !is_last_chance_) return forward_.push_back(face);
  add_face();
}

Corner StatementReader::read_corner(const Counts& before, bool& forward) {
  Corner corner;
  const TextCursor at = cursor_;
  const std::int64_t position = cursor_.integer("a vertex index");
  if (position == 0 && options_.base == 1) counts_from_zero_ = true;
  if (position == 0 && options_.base == 0) {
    note("zero", Fidelity::approximated,
         "vertex index 0, though OBJ counts from 1: all indices are counted from 0");
  }
  corner.position = resolve(position, before.positions, geometry_.positions.size());
  if (corner.position == none) {
    forward = true;
    if (is_last_chance_ || position < 0) out_of_range(at, position);
  }
  if (cursor_.accept('/')) {
    corner.uv = read_attribute(before.uvs, geometry_.uvs.size(), forward, "texture coordinates");
    if (cursor_.accept('/')) {
      corner.normal = read_attribute(before.normals, geometry_.normals.size(), forward, "normals");
    }
  }
  if (!cursor_.at_separator() && !cursor_.sees('#'))
    cursor_.fail("expected a corner v, v/vt, v//vn or v/vt/vn");
  return corner;
}

// An index of which nothing is there, 0 among them, is as good as none: the geometry is whole without it.
std::uint32_t StatementReader::read_attribute(std::size_t before, std::size_t count, bool& forward,
                                              const char* what) {
  cursor_.join_lines();  // a corner may go on behind its slash
  if (cursor_.at_separator() || cursor_.sees('/')) return none;
  const std::int64_t raw = cursor_.integer("an index");
  const std::uint32_t index = resolve(raw, before, count);
  if (index != none) return index;
  if (raw > 0 && !is_last_chance_) {
    forward = true;
  } else {
    note(what, Fidelity::dropped,
         fmt::format("{} of faces whose index is out of range ({} of {})", what, raw, count));
  }
  return none;
}

// From 0; none if there is no such entry (yet).
std::uint32_t StatementReader::resolve(std::int64_t raw, std::size_t before, std::size_t count) const {
  const std::int64_t index = raw < 0 ? raw + static_cast<std::int64_t>(before) : raw - options_.base;
  return index >= 0 && index < static_cast<std::int64_t>(count) ? static_cast<std::uint32_t>(index) : none;
}

void StatementReader::out_of_range(const TextCursor& at, std::int64_t index) const {
  at.fail(fmt::format("vertex index {} is out of range: there are {} vertices, counted from {}", index,
                      geometry_.positions.size(), options_.base));
}

void StatementReader::add_face() {
  if (corners_.size() < 3)
    return note("two corners", Fidelity::dropped, "faces with fewer than three corners");
  const auto have = [&](std::uint32_t Corner::*index) {
    return std::ranges::count_if(corners_, [&](const Corner& c) { return c.*index != none; });
  };
  const auto all = static_cast<std::ptrdiff_t>(corners_.size());
  const auto uvs = have(&Corner::uv), normals = have(&Corner::normal);
  if ((uvs != 0 && uvs != all) || (normals != 0 && normals != all)) {
    note("mixed corners", Fidelity::dropped,
         "normals or texture coordinates of faces where not all corners have them");
  }
  faces_.add(corners_, use_, uvs == all, normals == all, smoothing_group_);
}

}  // namespace vitrail::obj
