// SPDX-License-Identifier: Apache-2.0
#include "importers/ply/read/ply.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <span>
#include <string_view>

#include "importers/ply/read/ply_attributes.h"
#include "importers/ply/read/ply_body.h"
#include "importers/ply/read/ply_corner_uvs.h"
#include "scene/spectra/color.h"

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

BodyPlan::Faces find_corners(const Header& header, std::size_t element) {
  const Element& faces = header.elements[element];
  auto list = find_property(faces, "vertex_indices", true);
  if (!list) list = find_property(faces, "vertex_index", true);
  if (!list || !is_integer(faces.properties[*list].type)) {
    throw Error(fmt::format("element {} needs a list of integers vertex_indices", faces.name), faces.location,
                faces.excerpt);
  }
  return {element, *list};
}

BodyPlan make_plan(const Header& header, const TextCursor& cursor) {
  const auto vertex = find_element(header, "vertex");
  if (!vertex) cursor.fail("the file has no element vertex");
  BodyPlan plan{*vertex, find_layout(header.elements[*vertex]), {}, {}};
  if (const auto face = find_element(header, "face")) plan.faces = find_corners(header, *face);
  if (const auto strips = find_element(header, "tristrips")) plan.strips = find_corners(header, *strips);
  if (!plan.faces && !plan.strips)
    cursor.fail("the file has no element face or tristrips: a cloud of points has no surface");
  return plan;
}

bool is_used(const BodyPlan& plan, std::size_t element) {
  return element == plan.vertex_element || (plan.faces && element == plan.faces->element) ||
         (plan.strips && element == plan.strips->element);
}

using Attributes = std::vector<AttributePlan>;

bool is_used(const BodyPlan& plan, const Attributes& attributes, std::size_t element, std::size_t property) {
  if (std::ranges::any_of(attributes, [&](const AttributePlan& a) {
        return a.element == element && std::ranges::count(a.properties, property) > 0;
      }))
    return true;
  if (element == plan.vertex_element)
    return std::ranges::count(plan.vertex.property, std::optional(property)) > 0;
  return std::ranges::any_of(std::array{plan.faces, plan.strips}, [&](const auto& faces) {
    return faces && faces->element == element && faces->corner_list == property;
  });
}

void report_skipped(const Header& header, const BodyPlan& plan, const Attributes& attributes,
                    std::optional<std::size_t> corner_uvs, Diagnostics& diagnostics) {
  for (std::size_t e = 0; e < header.elements.size(); ++e) {
    const Element& element = header.elements[e];
    if (!is_used(plan, e)) {
      diagnostics.push_back({Fidelity::dropped, fmt::format("element {}", element.name), element.location});
      continue;
    }
    for (std::size_t i = 0; i < element.properties.size(); ++i) {
      if (is_used(plan, attributes, e, i) || (corner_uvs && *corner_uvs == i && e == plan.faces->element))
        continue;
      const Property& property = element.properties[i];
      diagnostics.push_back({Fidelity::dropped,
                             fmt::format("property {} of element {}", property.name, element.name),
                             property.location});
    }
  }
}

bool is_color(const AttributePlan& plan) {
  return plan.properties.size() == 3 && (plan.name == "vertex_color" || plan.name == "face_color");
}

Attributes plan_of(const Header& header, const BodyPlan& plan, PlyAttributes wanted) {
  if (wanted == PlyAttributes::skip) return {};
  Attributes attributes = plan_attributes(header, plan);
  if (wanted == PlyAttributes::faces)
    std::erase_if(attributes, [](const AttributePlan& a) { return a.name != face_indices; });
  if (wanted == PlyAttributes::colors || wanted == PlyAttributes::look) {
    std::erase_if(attributes, [](const AttributePlan& a) { return !is_color(a); });
    if (attributes.size() > 1) attributes.resize(1);  // those of vertices come first
  }
  return attributes;
}

void decode_colors(const Header& header, const Attributes& attributes, TriangleMesh& mesh) {
  for (std::size_t i = 0; i < attributes.size(); ++i) {
    const Type type = header.elements[attributes[i].element].properties[attributes[i].properties[0]].type;
    if (!is_integer(type)) continue;
    const bool is_signed = type == Type::int8 || type == Type::int16 || type == Type::int32;
    const double most = std::ldexp(1.0, static_cast<int>(8 * size_of(type)) - (is_signed ? 1 : 0)) - 1;
    for (float& value : mesh.attributes[i].values)
      value = static_cast<float>(srgb_decode(std::clamp(static_cast<double>(value) / most, 0.0, 1.0)));
  }
}

}  // namespace

namespace {

Body read_file(const std::filesystem::path& file, Diagnostics* diagnostics, PlyAttributes wanted,
               std::optional<PbrtQuads> quads) {
  const InputBytes bytes(file);
  const std::string name = file.string();
  TextCursor cursor(name, after_byte_order_mark(bytes.begin(), bytes.end()), bytes.end());
  const Header header = read_header(cursor);
  const BodyPlan plan = make_plan(header, cursor);
  const Attributes attributes = plan_of(header, plan, wanted);
  Body body = read_body(bytes, cursor, header, plan, quads);
  read_attributes(bytes, cursor, header, plan, attributes, body);
  if (wanted == PlyAttributes::colors || wanted == PlyAttributes::look)
    decode_colors(header, attributes, body.mesh);
  std::optional<std::size_t> corner_uvs;
  if (wanted == PlyAttributes::look) corner_uvs = corner_uvs_of(header, plan);
  if (corner_uvs) read_corner_uvs(bytes, cursor, header, plan, *corner_uvs, body);
  if (diagnostics) {
    report_skipped(header, plan, attributes, corner_uvs, *diagnostics);
    if (body.lost_numbers > 0) {
      diagnostics->push_back({Fidelity::dropped,
                              fmt::format("{} numbers of normals, (u,v) or attributes that are not finite: 0",
                                          body.lost_numbers),
                              header.elements[plan.vertex_element].location});
    }
    if (body.dropped_faces > 0) {
      diagnostics->push_back({Fidelity::dropped,
                              fmt::format("{} faces with fewer than three corners", body.dropped_faces),
                              header.elements[plan.faces->element].location});
    }
    if (quads && body.polygons > 0) {
      diagnostics->push_back(
          {Fidelity::approximated,
           fmt::format("{} faces with more than four corners, which pbrt leaves out", body.polygons),
           header.elements[plan.faces->element].location});
    }
  }
  return body;
}

}  // namespace

TriangleMesh read_ply(const std::filesystem::path& file, Diagnostics* diagnostics, PlyAttributes wanted) {
  return read_file(file, diagnostics, wanted, {}).mesh;
}

std::vector<std::string> texture_files_of_ply(const std::filesystem::path& file) {
  const InputBytes bytes(file);
  const std::string name = file.string();
  TextCursor cursor(name, after_byte_order_mark(bytes.begin(), bytes.end()), bytes.end());
  return read_header(cursor).texture_files;
}

PlyCounts count_ply(const std::filesystem::path& file) {
  const InputBytes bytes(file);
  const std::string name = file.string();
  TextCursor cursor(name, after_byte_order_mark(bytes.begin(), bytes.end()), bytes.end());
  const Header header = read_header(cursor);
  PlyCounts counts;
  for (const Element& element : header.elements) {
    const auto has = [&](std::string_view property) {
      return std::ranges::any_of(element.properties, [&](const Property& p) { return p.name == property; });
    };
    if (element.name == "face") counts.triangles += element.count, counts.bytes += 12 * element.count;
    if (has("red")) counts.color_bytes += 12 * element.count;
    if (element.name != "vertex") continue;
    counts.has_normals = has("nx");
    const bool has_uv = has("u") || has("s");
    counts.bytes += element.count * (12u + (counts.has_normals ? 12u : 0u) + (has_uv ? 8u : 0u));
  }
  return counts;
}

PbrtPly read_pbrt_ply(const std::filesystem::path& file, PbrtQuads quads, Diagnostics* diagnostics) {
  Body body = read_file(file, diagnostics, PlyAttributes::faces, quads);
  return {std::move(body.mesh), std::move(body.patches), std::move(body.patch_faces)};
}

}  // namespace vitrail
