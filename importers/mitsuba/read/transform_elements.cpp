// SPDX-License-Identifier: Apache-2.0
#include "importers/mitsuba/read/transform_elements.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "importers/mitsuba/read/old_versions.h"

namespace vitrail::mitsuba {

Vector3d read_triple(const Element& element, double otherwise) {
  const Fail fails = element.failing();
  if (element.has("value")) {
    const std::vector<double> v = parse_numbers(element.attribute("value"), fails);
    if (v.size() == 1) return {v[0], v[0], v[0]};
    if (v.size() != 3)
      element.fail(fmt::format("<{}> needs 3 numbers, has {}", element.node().name(), v.size()));
    return {v[0], v[1], v[2]};
  }
  const auto component = [&](const char* name) {
    return element.has(name) ? parse_number(element.attribute(name), fails) : otherwise;
  };
  return {component("x"), component("y"), component("z")};
}

namespace {

// Rodrigues' formula with the axis as it is: since version 2 Mitsuba does not make it a unit vector, and
// files depend on that.
Transform rotate_about(Vector3d a, double angle_rad) {
  const double s = std::sin(angle_rad), c = std::cos(angle_rad), d = 1 - c;
  Transform t;
  t.m[0] = {a.x * a.x * d + c, a.x * a.y * d - a.z * s, a.x * a.z * d + a.y * s, 0};
  t.m[1] = {a.y * a.x * d + a.z * s, a.y * a.y * d + c, a.y * a.z * d - a.x * s, 0};
  t.m[2] = {a.z * a.x * d - a.y * s, a.z * a.y * d + a.x * s, a.z * a.z * d + c, 0};
  return t;
}

Vector3d triple_of(const Element& element, const char* name) {
  const std::vector<double> v = parse_numbers(element.required(name), element.failing());
  if (v.size() != 3) element.fail(fmt::format("\"{}\" needs 3 numbers, has {}", name, v.size()));
  return {v[0], v[1], v[2]};
}

Transform read_matrix(const Element& element) {
  const std::vector<double> v = parse_numbers(element.required("value"), element.failing());
  if (v.size() != 16 && v.size() != 9)
    element.fail(fmt::format("a matrix needs 16 or 9 numbers, has {}", v.size()));
  const std::size_t size = v.size() == 16 ? 4 : 3;
  Transform t;
  for (std::size_t i = 0; i < v.size(); ++i) t.m[i / size][i % size] = v[i];
  return t;
}

Transform read_look_at(const Element& element) {
  const Vector3d eye = triple_of(element, "origin"), target = triple_of(element, "target");
  const Vector3d up = element.has("up") ? triple_of(element, "up") : Vector3d{0, 1, 0};
  const Transform t = look_at({eye.x, eye.y, eye.z}, {target.x, target.y, target.z}, up);
  if (!is_invertible(t))
    element.fail("lookat has no direction: origin and target coincide, or up is along the view");
  return t;
}

Transform read_step(const Element& element) {
  const std::string tag = name_of_today(element.node().name());
  if (tag == "translate") return translate(read_triple(element, 0));
  if (tag == "scale") return scale(read_triple(element, 1));
  if (tag == "rotate") {
    const double angle =
        parse_number(element.required("angle"), element.failing()) * 3.14159265358979323846 / 180;
    const Vector3d axis = read_triple(element, 0);
    return element.is_old() ? rotate(angle, axis) : rotate_about(axis, angle);
  }
  if (tag == "matrix") return read_matrix(element);
  if (tag == "lookat" || tag == "look_at") return read_look_at(element);
  const std::string closest = closest_word(tag, {"translate", "scale", "rotate", "matrix", "lookat"});
  element.fail(fmt::format("<{}> is not a step of a transform{}", element.node().name(),
                           closest.empty() ? "" : fmt::format("; did you mean <{}>?", closest)));
}

}  // namespace

Transform read_transform(const Element& element) {
  Transform total;
  for (const pugi::xml_node step : element.node().children())
    if (step.type() == pugi::node_element) total = read_step(element.child(step)) * total;
  return total;
}

std::vector<Keyframe> read_animation(const Element& element) {
  std::vector<Keyframe> keys;
  for (const pugi::xml_node child : element.node().children()) {
    if (child.type() != pugi::node_element) continue;
    const Element step = element.child(child);
    if (std::string_view(child.name()) != "transform")
      step.fail(fmt::format("an <animation> has <transform time=\"…\"> alone, not <{}>", child.name()));
    keys.push_back({parse_number(step.required("time"), step.failing()), read_transform(step)});
  }
  if (keys.empty()) element.fail("an <animation> needs a <transform time=\"…\">");
  std::ranges::stable_sort(keys, {}, &Keyframe::time_s);
  for (std::size_t i = 1; i < keys.size(); ++i)
    if (keys[i - 1].time_s == keys[i].time_s)
      element.fail(fmt::format("two transforms of an <animation> have the time {}", keys[i].time_s));
  return keys;
}

}  // namespace vitrail::mitsuba
