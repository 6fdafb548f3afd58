// SPDX-License-Identifier: Apache-2.0
// The directives that change the current transform.
#include <fmt/format.h>

#include "importers/pbrt/read/directives.h"
#include "importers/reading/suggestion.h"

namespace vitrail::pbrt {

template <class Changed>
void Interpreter::change_active(const Place& place, Changed&& changed) {
  const auto change = [&](Transform& ctm) {
    ctm = changed(ctm);
    if (!is_invertible(ctm)) fail("the transform becomes singular here: it has no inverse", place);
  };
  if (state_.transform_start) change(state_.ctm);
  if (state_.transform_end) change(state_.ctm_end);
}

void Interpreter::set_transform(const Transform& t, const Place& place) {
  change_active(place, [&](const Transform&) { return t; });
}

void Interpreter::apply_transform(const Transform& by, const Place& place) {
  change_active(place, [&](const Transform& ctm) { return ctm * by; });
}

// None where there is no way from one to the other, or no time between them: the start holds.
Motion Interpreter::motion_between(const Transform& start, const Transform& end, const Place& place) {
  std::vector<Keyframe> keys{{transform_start_s_, start}, {transform_end_s_, end}};
  if (can_move(keys)) return Motion(std::move(keys));
  context_.report.approximated(
      "motion with TransformTimes that do not ascend, or between transforms of which one mirrors or is no "
      "affine one: the start holds for the whole picture",
      place);
  return {};
}

// What pbrt, too, holds.
void Interpreter::report_held(const char* what, const Place& place) {
  if (is_moving())
    context_.report.approximated(
        fmt::format("motion of {}: as in pbrt, the start holds for the whole picture", what), place);
}

const Interpreter::Placing& Interpreter::placing(const Place& place) {
  LastPlacing& last = last_placing_;
  const bool in_object = current_object_.has_value();
  if (last.of.start == state_.ctm && last.of.end == state_.ctm_end && last.in_object == in_object)
    return last.placing;
  last = {{state_.ctm, state_.ctm_end}, in_object, {state_.ctm, {}}, {}};
  if (!is_moving()) return last.placing;
  Motion motion = motion_between(state_.ctm, state_.ctm_end, place);
  if (!motion.moves()) return last.placing;
  last.placing.at_open = motion.at(view_.shutter.open_s);
  if (stands_still(motion, view_.shutter)) return last.placing;
  if (in_object) {
    context_.report.approximated("motion within an object: it stands where it is when the shutter opens",
                                 place);
    return last.placing;
  }
  last.placing.motion = Id<Motion>{static_cast<std::uint32_t>(scene_.motions.size())};
  scene_.motions.push_back(std::move(motion));
  return last.placing;
}

void Interpreter::identity(const Place& place) { set_transform({}, place); }

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

void Interpreter::transform(const Place& place) { set_transform(read_matrix(place), place); }

void Interpreter::concat_transform(const Place& place) { apply_transform(read_matrix(place), place); }

void Interpreter::coordinate_system(const Place&) {
  coordinate_systems_[read_text("the name of a coordinate system")] = {state_.ctm, state_.ctm_end};
}

void Interpreter::coord_sys_transform(const Place& place) {
  const std::string name = read_text("the name of a coordinate system");
  const auto found = coordinate_systems_.find(name);
  if (found != coordinate_systems_.end()) {
    state_.ctm = found->second.start;
    state_.ctm_end = found->second.end;
    return;
  }
  std::vector<std::string> known;
  for (const auto& entry : coordinate_systems_) known.push_back(entry.first);
  context_.report.dropped(
      fmt::format("coordinate system \"{}\" is not defined: CoordSysTransform has no effect{}", name,
                  suggestion(name, known)),
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

void Interpreter::transform_times(const Place& place) {
  const auto times = read_numbers(2, place);
  transform_start_s_ = times[0], transform_end_s_ = times[1];
  last_placing_ = {};
}

}  // namespace vitrail::pbrt
