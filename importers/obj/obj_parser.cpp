// SPDX-License-Identifier: Apache-2.0
#include "importers/obj/obj_parser.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <set>
#include <unordered_map>

#include "importers/ply/text_cursor.h"
#include "importers/shapes/polygon.h"

namespace vitrail::obj {

namespace {

constexpr std::uint32_t none = std::numeric_limits<std::uint32_t>::max();

struct Corner {
  std::uint32_t position = none, uv = none, normal = none;
};

// How many positions, uvs and normals have been read.
struct Counts {
  std::size_t positions, uvs, normals;
};

// A face that refers to what has not been read yet.
struct ForwardFace {
  TextCursor at;
  Counts counts;
  std::size_t material;
};

class Parser {
 public:
  Parser(InputBytes& bytes, const std::string& file, int base, Geometry& geometry)
      : bytes_(bytes), cursor_(file, bytes.begin(), bytes.end(), true), base_(base), geometry_(geometry) {
    geometry_.materials.push_back({});
  }

  bool run() {
    while (cursor_.skip_to_text() && !counts_from_zero_) {
      read_statement();
      if (++statements_ % 65536 == 0) bytes_.release_before(cursor_.at());
    }
    is_last_chance_ = true;
    for (const ForwardFace& face : forward_) {
      if (counts_from_zero_) break;
      material_ = face.material;
      cursor_ = start_ = face.at;
      read_face(face.counts);
    }
    if (counts_from_zero_) return false;
    finish();
    return true;
  }

 private:
  // ---- Statements -------------------------------------------------------------------------------

  void read_statement() {
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

  void read_rare(std::string_view keyword) {
    if (keyword == "usemtl") {
      use_material();
    } else if (keyword == "mtllib") {
      geometry_.libraries.push_back({std::string(cursor_.rest_of_line()), start_.location()});
    } else if (keyword == "s") {
      const std::string_view group = cursor_.word();
      if (group != "off" && group != "0" && !smoothing_) smoothing_ = start_.location();
      skip_statement();
    } else {
      if (keyword != "o" && keyword != "g") drop(keyword);
      skip_statement();
    }
  }

  void drop(std::string_view keyword) {
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

  void note(const std::string& key, Fidelity fidelity, std::string message) {
    if (!noted_.insert(key).second) return;
    geometry_.diagnostics.push_back({fidelity, std::move(message), start_.location()});
  }

  bool at_end() { return cursor_.at_line_end() || cursor_.sees('#'); }

  void skip_statement() {
    while (!at_end()) cursor_.word();
  }

  void use_material() {
    const std::string name(cursor_.rest_of_line());
    const auto [entry, is_new] = material_of_name_.try_emplace(name, geometry_.materials.size());
    if (is_new) geometry_.materials.push_back({name, start_.location()});
    material_ = entry->second;
  }

  void finish() {
    if (unknown_ && geometry_.positions.empty()) {
      unknown_->fail("not an OBJ file: no vertices, and this is no statement of OBJ");
    }
    if (smoothing_ && geometry_.normals.empty()) {
      geometry_.diagnostics.push_back(
          {Fidelity::dropped, "smoothing groups: no normals are made for faces without them", *smoothing_});
    }
  }

  // ---- Vertices ---------------------------------------------------------------------------------

  double finite_number(const char* what) {
    cursor_.at_line_end();
    const char* const begin = cursor_.at();
    const double value = cursor_.number(what);
    if (!(std::abs(value) <= std::numeric_limits<float>::max())) {
      cursor_.fail(fmt::format("{} is not a finite single-precision number", what), begin);
    }
    return value;
  }

  float component() { return static_cast<float>(finite_number("a component")); }

  void read_position() {
    const double x = finite_number("a coordinate"), y = finite_number("a coordinate");
    geometry_.positions.push_back({x, y, finite_number("a coordinate")});
    if (at_end()) return;
    int more = 0;
    for (; !at_end(); ++more) finite_number("a vertex's weight or colour");
    if (more % 2 == 1)
      note("weight", Fidelity::dropped, "weights (w) of vertices: they count for curves only");
    if (more >= 3) note("colour", Fidelity::dropped, "colours of vertices");
  }

  Point2f read_uv() {
    Point2f uv{component(), 0};
    if (!at_end()) uv.y = component();
    if (!at_end()) component();  // the third of a solid texture
    return uv;
  }

  // ---- Faces ------------------------------------------------------------------------------------

  Counts counts() const {
    return {geometry_.positions.size(), geometry_.uvs.size(), geometry_.normals.size()};
  }

  // Negative indices count back from `before`.
  void read_face(const Counts& before) {
    const ForwardFace face{start_, before, material_};
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

  Corner read_corner(const Counts& before, bool& forward) {
    Corner corner;
    const TextCursor at = cursor_;
    const std::int64_t position = cursor_.integer("a vertex index");
    if (position == 0 && base_ == 1) counts_from_zero_ = true;
    if (position == 0 && base_ == 0) {
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
  std::uint32_t read_attribute(std::size_t before, std::size_t count, bool& forward, const char* what) {
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
  std::uint32_t resolve(std::int64_t raw, std::size_t before, std::size_t count) const {
    const std::int64_t index = raw < 0 ? raw + static_cast<std::int64_t>(before) : raw - base_;
    return index >= 0 && index < static_cast<std::int64_t>(count) ? static_cast<std::uint32_t>(index) : none;
  }

  [[noreturn]] void out_of_range(const TextCursor& at, std::int64_t index) const {
    at.fail(fmt::format("vertex index {} is out of range: there are {} vertices, counted from {}", index,
                        geometry_.positions.size(), base_));
  }

  void add_face() {
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
    Group& group = group_of(uvs == all, normals == all);
    cut_.clear();
    if (corners_.size() == 3) {
      cut_.push_back({0, 1, 2});
    } else {
      points_.clear();
      for (const Corner& c : corners_) points_.push_back(geometry_.positions[c.position]);
      triangulate_polygon(points_, cut_);
    }
    for (const CornerTriple& triangle : cut_) {
      for (const std::uint32_t i : triangle) append(group, corners_[i]);
    }
  }

  static void append(Group& group, const Corner& corner) {
    group.corners.push_back(corner.position);
    if (group.has_uvs) group.corners.push_back(corner.uv);
    if (group.has_normals) group.corners.push_back(corner.normal);
  }

  Group& group_of(bool has_uvs, bool has_normals) {
    const std::size_t kind = (has_uvs ? 1u : 0u) + (has_normals ? 2u : 0u);
    if (groups_of_material_.size() <= material_) groups_of_material_.resize(material_ + 1);
    std::optional<std::size_t>& group = groups_of_material_[material_][kind];
    if (!group) {
      group = geometry_.groups.size();
      geometry_.groups.push_back({material_, has_uvs, has_normals, {}});
    }
    return geometry_.groups[*group];
  }

  InputBytes& bytes_;
  TextCursor cursor_;
  TextCursor start_ = cursor_;  // of the present statement
  int base_;
  Geometry& geometry_;

  std::size_t statements_ = 0;
  std::size_t material_ = 0;
  std::unordered_map<std::string, std::size_t> material_of_name_;
  std::vector<std::array<std::optional<std::size_t>, 4>> groups_of_material_;
  std::vector<ForwardFace> forward_;
  bool is_last_chance_ = false;  // all has been read: what is not there now never will be
  bool counts_from_zero_ = false;

  std::set<std::string> noted_;
  std::optional<SourceLocation> smoothing_;
  std::optional<TextCursor> unknown_;

  std::vector<Corner> corners_;
  std::vector<Point3d> points_;
  std::vector<CornerTriple> cut_;
};

}  // namespace

bool parse(InputBytes& bytes, const std::string& file, int base, Geometry& geometry) {
  return Parser(bytes, file, base, geometry).run();
}

}  // namespace vitrail::obj
