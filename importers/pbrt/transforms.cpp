// SPDX-License-Identifier: Apache-2.0
// The directives that change the current transform.
#include <fmt/format.h>

#include "importers/pbrt/directives.h"

namespace vitrail::pbrt {

void Interpreter::set_ctm(const Transform& ctm, const Place& place) {
  if (!state_.transform_start || !state_.transform_end)
    context_.report.approximated(
        "motion: the transform at the start of the shutter holds for the whole picture", place);
  if (!state_.transform_start) return;
  if (!is_invertible(ctm)) fail("the transform becomes singular here: it has no inverse", place);
  state_.ctm = ctm;
}

void Interpreter::identity(const Place& place) { set_ctm({}, place); }

void Interpreter::translate(const Place& place) {
  const auto v = read_numbers(3, place);
  apply_transform(vitrail::translate({v[0], v[1], v[2]}), place);
}

void Interpreter::scale(const Place& place) {
  const auto v = read_numbers(3, place);
  apply_transform(vitrail::scale({v[0], v[1], v[2]}), place);
}

void Interpreter::rotate(const Place& place) {
  constexpr double radians = 0.017453292519943295;
  const auto v = read_numbers(4, place);
  const Vector3d axis{v[1], v[2], v[3]};
  if (!(length(axis) > 0)) fail("the axis of the rotation is zero", place);
  apply_transform(vitrail::rotate(v[0] * radians, axis), place);
}

void Interpreter::look_at(const Place& place) {
  const auto v = read_numbers(9, place);
  const Transform camera_to_world =
      vitrail::look_at({v[0], v[1], v[2]}, {v[3], v[4], v[5]}, {v[6], v[7], v[8]});
  if (!is_invertible(camera_to_world))
    fail("LookAt has no direction: eye and target coincide, or up is along the view", place);
  apply_transform(inverse(camera_to_world), place);
}

// Files list matrices by columns.
Transform Interpreter::read_matrix(const Place& place) {
  const auto v = read_numbers(16, place);
  Transform t;
  for (std::size_t i = 0; i < 16; ++i) t.m[i % 4][i / 4] = v[i];
  return t;
}

void Interpreter::transform(const Place& place) { set_ctm(read_matrix(place), place); }

void Interpreter::concat_transform(const Place& place) { apply_transform(read_matrix(place), place); }

void Interpreter::coordinate_system(const Place&) {
  coordinate_systems_[read_text("the name of a coordinate system")] = state_.ctm;
}

void Interpreter::coord_sys_transform(const Place& place) {
  const std::string name = read_text("the name of a coordinate system");
  const auto found = coordinate_systems_.find(name);
  if (found != coordinate_systems_.end()) return set_ctm(found->second, place);
  std::vector<std::string> known;
  for (const auto& entry : coordinate_systems_) known.push_back(entry.first);
  const std::string closest = closest_word(name, known);
  context_.report.dropped(
      fmt::format("coordinate system \"{}\" is not defined: CoordSysTransform has no effect{}", name,
                  closest.empty() ? "" : fmt::format("; did you mean \"{}\"?", closest)),
      place);
}

void Interpreter::active_transform(const Place& place) {
  const Token token = tokens_.next();
  const bool all = token.text == "All", start = token.text == "StartTime", end = token.text == "EndTime";
  if (token.kind != TokenKind::word || !(all || start || end))
    fail(fmt::format("expected All, StartTime or EndTime, found {}", describe(token)),
         token.kind == TokenKind::end ? place : token.place);
  state_.transform_start = all || start;
  state_.transform_end = all || end;
}

void Interpreter::transform_times(const Place& place) { read_numbers(2, place); }

}  // namespace vitrail::pbrt
