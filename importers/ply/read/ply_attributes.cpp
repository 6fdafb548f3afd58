// SPDX-License-Identifier: Apache-2.0
#include "importers/ply/read/ply_attributes.h"

#include <array>
#include <optional>
#include <span>

#include "importers/ply/read/ply_rows.h"
#include "importers/ply/read/ply_vertices.h"

namespace vitrail::ply {

namespace {

bool is_scalar(const Element& element, std::size_t i, std::string_view name) {
  return i < element.properties.size() && !element.properties[i].count_type &&
         element.properties[i].name == name;
}

// How many properties from `first` on are called `base` and these suffixes, in their order.
std::size_t run_of(const Element& element, std::size_t first, const std::string& base,
                   std::span<const std::string_view> suffixes) {
  std::size_t count = 0;
  while (count < suffixes.size() && is_scalar(element, first + count, base + std::string(suffixes[count])))
    ++count;
  return count;
}

struct Run {
  std::string name;
  std::size_t count = 0;
};

// Of the properties from `first` on.
Run attribute_at(const Element& element, std::size_t first) {
  using Suffixes = std::array<std::string_view, 4>;
  static constexpr Suffixes colors[] = {{"r", "g", "b", "a"}, {"red", "green", "blue", "alpha"}};
  for (const Suffixes& names : colors)
    if (const std::size_t count = run_of(element, first, "", names); count >= 3) return {"color", count};
  static constexpr Suffixes suffixes[] = {
      {"_0", "_1", "_2", "_3"}, {"_1", "_2", "_3", "_4"}, {"_x", "_y", "_z", "_w"}, {"_r", "_g", "_b", "_a"}};
  const std::string& name = element.properties[first].name;
  for (const Suffixes& names : suffixes) {
    if (!name.ends_with(names[0]) || name.size() == names[0].size()) continue;
    const std::string base = name.substr(0, name.size() - names[0].size());
    return {names[0] == "_r" ? base + "_color" : base, run_of(element, first, base, names)};
  }
  return {};
}

bool is_taken(const BodyPlan& plan, std::size_t element, std::size_t property) {
  return element == plan.vertex_element &&
         std::ranges::count(plan.vertex.property, std::optional(property)) > 0;
}

void plan_element(const Header& header, const BodyPlan& plan, std::size_t e, bool per_face,
                  std::vector<AttributePlan>& attributes) {
  const Element& element = header.elements[e];
  for (std::size_t i = 0; i < element.properties.size(); ++i) {
    if (element.properties[i].count_type || is_taken(plan, e, i)) continue;
    if (per_face && element.properties[i].name == face_indices) {
      attributes.push_back({std::string(face_indices), true, e, {i}});
      continue;
    }
    const Run run = attribute_at(element, i);
    const bool is_color = run.count == 4 && run.name == "color";  // whose alpha is left out
    if (run.count == 1 || run.count == 3 || is_color) {
      AttributePlan attribute{(per_face ? "face_" : "vertex_") + run.name, per_face, e, {}};
      for (std::size_t k = 0; k < std::min<std::size_t>(run.count, 3); ++k)
        attribute.properties.push_back(i + k);
      attributes.push_back(std::move(attribute));
    }
    if (run.count > 0) i += run.count - 1;
  }
}

// The attributes of one element.
template <class Source>
void read_element(Source& source, const Element& element, const std::vector<const AttributePlan*>& plans,
                  std::optional<std::size_t> corner_list, Body& body) {
  source.require_room(element);
  std::vector<MeshAttribute> attributes;
  for (const AttributePlan* plan : plans)
    attributes.push_back({plan->name, plan->per_face, static_cast<int>(plan->properties.size()), {}});
  std::vector<float> row(element.properties.size());
  std::uint64_t copies = 1;
  bool is_patch = false;
  const auto end_row = [&](std::size_t property) {
    if (property + 1 < row.size()) return;
    if (is_patch)
      for (const AttributePlan* plan : plans) body.patch_faces.push_back(row[plan->properties.front()]);
    for (std::uint64_t copy = 0; copy < copies; ++copy)
      for (std::size_t k = 0; k < plans.size(); ++k)
        for (const std::size_t i : plans[k]->properties) attributes[k].values.push_back(row[i]);
  };
  const auto is_read = [&](std::size_t property) {
    return std::ranges::any_of(
        plans, [&](const AttributePlan* plan) { return std::ranges::count(plan->properties, property) > 0; });
  };
  std::vector<char> wanted(row.size());
  for (std::size_t i = 0; i < row.size(); ++i) wanted[i] = is_read(i);
  read_rows(
      source, element,
      [&](std::size_t i, double value) {
        row[i] = static_cast<float>(value);
        if (wanted[i] && !std::isfinite(row[i])) row[i] = 0, ++body.lost_numbers;
        end_row(i);
      },
      [&](std::size_t i, const std::vector<double>& items) {
        if (i == corner_list) {
          is_patch = body.quads == PbrtQuads::v4 && items.size() == 4;
          copies = is_patch || items.size() < 3 ? 0 : items.size() - 2;
        }
        end_row(i);
      });
  for (MeshAttribute& attribute : attributes) body.mesh.attributes.push_back(std::move(attribute));
}

template <class Source>
void read(Source source, const Header& header, const BodyPlan& plan,
          const std::vector<AttributePlan>& attributes, Body& body) {
  std::size_t last = 0;
  for (const AttributePlan& attribute : attributes) last = std::max(last, attribute.element);
  for (std::size_t e = 0; e <= last; ++e) {
    std::vector<const AttributePlan*> plans;
    for (const AttributePlan& attribute : attributes)
      if (attribute.element == e) plans.push_back(&attribute);
    const bool faces = plan.faces && plan.faces->element == e;
    const auto list = faces ? std::optional(plan.faces->corner_list) : std::nullopt;
    plans.empty() ? skip_element(source, header.elements[e])
                  : read_element(source, header.elements[e], plans, list, body);
  }
}

}  // namespace

std::vector<AttributePlan> plan_attributes(const Header& header, const BodyPlan& plan) {
  std::vector<AttributePlan> attributes;
  plan_element(header, plan, plan.vertex_element, false, attributes);
  // Triangles of strips would have no values.
  if (plan.faces && !plan.strips) plan_element(header, plan, plan.faces->element, true, attributes);
  return attributes;
}

void read_attributes(const InputBytes& bytes, const TextCursor& cursor, const Header& header,
                     const BodyPlan& plan, const std::vector<AttributePlan>& attributes, Body& body) {
  if (attributes.empty()) return;
  switch (header.format) {
    case Format::ascii:
      return read(AsciiSource(bytes, cursor), header, plan, attributes, body);
    case Format::binary_big_endian:
      return read(BinarySource<true>(bytes, cursor), header, plan, attributes, body);
    default:
      return read(BinarySource<false>(bytes, cursor), header, plan, attributes, body);
  }
}

}  // namespace vitrail::ply
