// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>
#include <set>
#include <span>
#include <string>
#include <unordered_map>
#include <vector>

#include "importers/bytes/text_cursor.h"
#include "importers/obj/read/obj_faces.h"
#include "importers/obj/read/obj_parser.h"

namespace vitrail::obj {

// It understands every statement of OBJ, one after the other, and says where something is wrong.
class StatementReader {
 public:
  StatementReader(const std::string& file, const ParseOptions& options, Geometry& geometry);

  // Reads the statements from `begin`, where line `line` begins, to `end`, where one ends; returns the line
  // there.
  int read(const char* begin, const char* end, int line);
  // Reads, after the whole file, faces that came before their vertices; reports what only the whole shows.
  void finish();

  // Returns whether a face with vertex index 0 came where indices count from 1: nothing more is read.
  bool counts_from_zero() const { return counts_from_zero_; }
  std::size_t use() const { return use_; }
  std::uint32_t smoothing_group() const { return smoothing_group_; }  // 0: none
  FaceSink& faces() { return faces_; }

 private:
  // They count the positions, uvs and normals that have been read.
  struct Counts {
    std::size_t positions, uvs, normals;
  };

  // It is a face that refers to what has not been read yet.
  struct ForwardFace {
    TextCursor at;
    Counts counts;
    std::size_t use;
    std::uint32_t smoothing_group;
  };

  void read_statement();
  void read_rare(std::string_view keyword);
  void drop(std::string_view keyword);
  void note(const std::string& key, Fidelity fidelity, std::string message);
  bool at_end() { return cursor_.at_line_end() || cursor_.sees('#'); }
  void skip_statement();
  void use_material();
  void use_object(bool is_group);
  void use_smoothing_group();
  void choose_use();

  double finite_number(const char* what);
  // Reads a number of a normal or of texture coordinates: one that is not finite is 0, and the rest is kept.
  float component();
  void read_position();
  void add_color(std::span<const double> rgb);
  Point2f read_uv();

  Counts counts() const;
  void read_face(const Counts& before);
  Corner read_corner(const Counts& before, bool& forward);
  std::uint32_t read_attribute(std::size_t before, std::size_t count, bool& forward, const char* what);
  std::uint32_t resolve(std::int64_t raw, std::size_t before, std::size_t count) const;
  [[noreturn]] void out_of_range(const TextCursor& at, std::int64_t index) const;
  void add_face();

  const std::string& file_;
  ParseOptions options_;
  Geometry& geometry_;
  FaceSink faces_;
  TextCursor cursor_, start_;  // start_: of the present statement

  std::size_t object_ = 0, material_ = 0, use_ = 0;
  std::string first_o_, o_, g_;
  std::uint32_t smoothing_group_ = 0;
  std::unordered_map<std::string, std::size_t> material_of_name_, object_of_names_;
  std::unordered_map<std::uint64_t, std::size_t> use_of_;  // by object and material
  std::vector<ForwardFace> forward_;
  bool is_last_chance_ = false;  // all has been read: what is not there now never will be
  bool counts_from_zero_ = false;

  std::set<std::string> noted_;
  std::optional<TextCursor> unknown_;
  std::vector<Corner> corners_;
};

}  // namespace vitrail::obj
