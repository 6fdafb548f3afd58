// SPDX-License-Identifier: Apache-2.0
#include "importers/povray/read/object_hits.h"

#include <algorithm>
#include <cmath>

#include "importers/povray/read/extents.h"
#include "importers/povray/read/shape_hits.h"

namespace vitrail::pov {

namespace {

void hits_of(const Object& object, const Line& line, std::vector<Hit>& hits);

bool is_inside_all(const std::vector<Shared<Object>>& objects, Point3d p) {
  return std::ranges::all_of(objects, [&](const auto& object) { return is_inside(*object, p); });
}

// Of the child `own` of a difference or an intersection: what of its surface is a surface of the set.
bool remains(const Object& set, Word kind, std::size_t own, Point3d p) {
  for (std::size_t i = 0; i < set.children.size(); ++i) {
    if (i == own) continue;
    const bool cuts = kind == Word::difference_ && i > 0;
    const bool inside = is_inside(*set.children[i], p);
    if (kind == Word::merge_ || cuts ? inside : !inside) return false;
  }
  return true;
}

void hits_of_group(const Object& object, Word kind, const Line& line, std::vector<Hit>& hits) {
  const bool keeps_all = kind == Word::union_ || kind == Word::light_group_;
  for (std::size_t i = 0; i < object.children.size(); ++i) {
    const std::size_t before = hits.size();
    hits_of(*object.children[i], line, hits);
    if (keeps_all) continue;
    if (kind == Word::difference_ && i > 0)
      for (std::size_t k = before; k < hits.size(); ++k) hits[k].normal = -hits[k].normal;
    const auto cut =
        std::remove_if(hits.begin() + static_cast<std::ptrdiff_t>(before), hits.end(),
                       [&](const Hit& hit) { return !remains(object, kind, i, line.at(hit.t)); });
    hits.erase(cut, hits.end());
  }
}

// Of the parent's space; normals of any length.
void hits_of(const Object& object, const Line& parent_line, std::vector<Hit>& hits) {
  if (!is_invertible(object.to_parent)) return;
  const Transform to_own = inverse(object.to_parent);
  const Line line{transform_point(to_own, parent_line.from), transform_vector(to_own, parent_line.along)};
  const std::size_t before = hits.size();
  if (const auto* group = std::get_if<GroupShape>(&object.shape)) {
    const Bounds3d& box = own_box(object);
    if (box.empty() || meets(box, line)) hits_of_group(object, group->kind, line, hits);
  } else if (std::holds_alternative<LightShape>(object.shape)) {
    for (const auto& child : object.children) hits_of(*child, line, hits);
  } else {
    hits_of_shape(object, line, hits);
  }
  for (std::size_t i = before; i < hits.size(); ++i) {
    hits[i].normal = to_vector(transform_normal(object.to_parent, to_normal(hits[i].normal)));
    if (object.inverse) hits[i].normal = -hits[i].normal;
  }
  if (!object.clipped_by.empty()) {
    const auto cut = std::remove_if(
        hits.begin() + static_cast<std::ptrdiff_t>(before), hits.end(),
        [&](const Hit& hit) { return !is_inside_all(object.clipped_by, parent_line.at(hit.t)); });
    hits.erase(cut, hits.end());
  }
}

}  // namespace

std::optional<Hit> first_hit(const Object& object, Point3d from, Vector3d along) {
  if (!(length(along) > 0)) return std::nullopt;
  std::vector<Hit> hits;
  hits_of(object, {from, along}, hits);
  // What is met where the line begins is left.
  const double least = 1e-6 / length(along);
  std::optional<Hit> first;
  for (const Hit& hit : hits)
    if (hit.t > least && (!first || hit.t < first->t)) first = hit;
  if (first && length(first->normal) > 0) first->normal = normalize(first->normal);
  return first;
}

bool is_inside(const Object& object, Point3d parent_point) {
  if (!is_invertible(object.to_parent) || !is_inside_all(object.clipped_by, parent_point)) return false;
  const Point3d p = transform_point(inverse(object.to_parent), parent_point);
  const auto in = [&](const auto& child) { return is_inside(*child, p); };
  bool inside = false;
  if (const auto* group = std::get_if<GroupShape>(&object.shape)) {
    if (object.children.empty()) return object.inverse;
    if (group->kind == Word::intersection_)
      inside = std::ranges::all_of(object.children, in);
    else if (group->kind == Word::difference_)
      inside =
          in(object.children.front()) && std::none_of(object.children.begin() + 1, object.children.end(), in);
    else
      inside = std::ranges::any_of(object.children, in);
  } else {
    inside = is_inside_shape(object, p);
  }
  return inside != object.inverse;
}

}  // namespace vitrail::pov
