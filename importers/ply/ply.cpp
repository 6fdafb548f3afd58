// SPDX-License-Identifier: Apache-2.0
#include "importers/ply/ply.h"

#include <fmt/format.h>

#include <algorithm>
#include <span>
#include <string_view>

#include "importers/ply/ply_body.h"

namespace vitrail {

namespace {

using namespace ply;

constexpr std::array<std::array<std::string_view, 2>, 4> uv_names{
    {{"u", "v"}, {"s", "t"}, {"texture_u", "texture_v"}, {"texture_s", "texture_t"}}};

std::optional<std::size_t> find_element(const Header& header, std::string_view name) {
  const auto found = std::ranges::find(header.elements, name, &Element::name);
  if (found == header.elements.end()) return {};
  return static_cast<std::size_t>(found - header.elements.begin());
}

std::optional<std::size_t> find_property(const Element& element, std::string_view name, bool list) {
  const auto found = std::ranges::find(element.properties, name, &Property::name);
  if (found == element.properties.end() || found->count_type.has_value() != list) return {};
  return static_cast<std::size_t>(found - element.properties.begin());
}

// Sets the slots from `first` on if the element has all of the properties.
bool find_group(const Element& element, std::span<const std::string_view> names, std::size_t first,
                VertexLayout& layout) {
  VertexLayout found = layout;
  for (std::size_t i = 0; i < names.size(); ++i) {
    found.property[first + i] = find_property(element, names[i], false);
    if (!found.property[first + i]) return false;
  }
  layout = found;
  return true;
}

VertexLayout find_layout(const Element& vertex) {
  constexpr std::array<std::string_view, 3> position{"x", "y", "z"}, normal{"nx", "ny", "nz"};
  VertexLayout layout;
  if (!find_group(vertex, position, 0, layout)) {
    throw Error("element vertex needs the properties x, y and z", vertex.location, vertex.excerpt);
  }
  find_group(vertex, normal, 3, layout);
  std::ranges::any_of(uv_names, [&](const auto& names) { return find_group(vertex, names, 6, layout); });
  return layout;
}

BodyPlan make_plan(const Header& header, const TextCursor& cursor) {
  const auto vertex = find_element(header, "vertex"), face = find_element(header, "face");
  if (!vertex) cursor.fail("the file has no element vertex");
  if (!face) cursor.fail("the file has no element face: a cloud of points has no surface");
  BodyPlan plan{*vertex, find_layout(header.elements[*vertex]), *face, 0};
  const Element& faces = header.elements[*face];
  auto list = find_property(faces, "vertex_indices", true);
  if (!list) list = find_property(faces, "vertex_index", true);
  if (!list || !is_integer(faces.properties[*list].type)) {
    throw Error("element face needs a list of integers vertex_indices", faces.location, faces.excerpt);
  }
  plan.corner_list = *list;
  return plan;
}

void report_skipped(const Header& header, const BodyPlan& plan, Diagnostics& diagnostics) {
  for (std::size_t e = 0; e < header.elements.size(); ++e) {
    const Element& element = header.elements[e];
    if (e != plan.vertex_element && e != plan.face_element) {
      diagnostics.push_back({Fidelity::dropped, fmt::format("element {}", element.name), element.location});
      continue;
    }
    for (std::size_t i = 0; i < element.properties.size(); ++i) {
      const bool used = e == plan.face_element
                            ? i == plan.corner_list
                            : std::ranges::count(plan.vertex.property, std::optional(i)) > 0;
      if (used) continue;
      const Property& property = element.properties[i];
      diagnostics.push_back({Fidelity::dropped,
                             fmt::format("property {} of element {}", property.name, element.name),
                             property.location});
    }
  }
}

}  // namespace

TriangleMesh read_ply(const std::filesystem::path& file, Diagnostics* diagnostics) {
  InputBytes bytes(file);
  const std::string name = file.string();
  TextCursor cursor(name, bytes.begin(), bytes.end());
  const Header header = read_header(cursor);
  const BodyPlan plan = make_plan(header, cursor);
  Body body = read_body(bytes, cursor, header, plan);
  if (diagnostics) {
    report_skipped(header, plan, *diagnostics);
    if (body.dropped_faces > 0) {
      diagnostics->push_back({Fidelity::dropped,
                              fmt::format("{} faces with fewer than three corners", body.dropped_faces),
                              header.elements[plan.face_element].location});
    }
  }
  return std::move(body.mesh);
}

}  // namespace vitrail
