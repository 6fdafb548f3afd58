// SPDX-License-Identifier: Apache-2.0
// What is inside a solid, as steps of a formula: of spheres, boxes, planes, discs, cones and sets of them. It
// is the law of is_inside (object_hits.h).
#include <array>

#include "importers/povray/read/formula_maker.h"
#include "scene/geometry/bounds.h"

namespace vitrail::pov {

void FormulaMaker::shape(const Object& object, Slot p) {
  const Slot first = top_;
  if (const auto* s = std::get_if<SphereShape>(&object.shape)) {
    const Slot d = moved(translate(Point3d{} - s->center), p);
    lengths(std::array{d, d + 1, d + 2});
    op(Op::less, s->radius);
  } else if (const auto* b = std::get_if<BoxShape>(&object.shape)) {
    Bounds3d box;
    extend(box, b->corner1);
    extend(box, b->corner2);
    constant(1);
    for (int axis = 0; axis < 3; ++axis) {
      pick(p + static_cast<Slot>(axis)), op(Op::greater, box.lower[axis]), op(Op::both);
      pick(p + static_cast<Slot>(axis)), op(Op::less, box.upper[axis]), op(Op::both);
    }
  } else if (const auto* plane = std::get_if<PlaneShape>(&object.shape)) {
    dot_with(plane->normal, p);
    op(Op::less, plane->distance);
  } else if (const auto* disc = std::get_if<DiscShape>(&object.shape)) {
    dot_with(disc->normal, p);
    op(Op::less, dot(disc->normal, disc->center - Point3d{}));
  } else if (const auto* cone = std::get_if<ConeShape>(&object.shape)) {
    const double high = length(cone->cap - cone->base);
    if (!(high > 0)) return refuse();
    const Vector3d axis = (cone->cap - cone->base) * (1 / high);
    const Slot d = moved(translate(Point3d{} - cone->base), p), h = d + 3;
    dot_with(axis, d);
    for (int i = 0; i < 3; ++i)
      pick(d + static_cast<Slot>(i)), pick(h), op(Op::multiply, axis[i]), op(Op::subtract);
    lengths(std::array{h + 1, h + 2, h + 3});
    pick(h), op(Op::multiply, (cone->cap_radius - cone->base_radius) / high), op(Op::add, cone->base_radius);
    op(Op::less);
    pick(h), op(Op::greater, 0), op(Op::both), pick(h), op(Op::less, high), op(Op::both);
  } else {
    return refuse();
  }
  keep_at(first);
}

void FormulaMaker::group(const Object& object, Slot p) {
  const Word kind = std::get<GroupShape>(object.shape).kind;
  const bool all = kind == Word::intersection_ || kind == Word::difference_;
  constant(all && !object.children.empty() ? 1 : 0);
  for (std::size_t i = 0; i < object.children.size(); ++i) {
    this->object(*object.children[i], p);
    if (kind == Word::difference_ && i > 0) op(Op::invert);
    op(all ? Op::both : Op::either);
  }
}

void FormulaMaker::object(const Object& object, Slot point) {
  if (!held_) return;
  if (!is_invertible(object.to_parent)) return constant(0);
  const Slot first = top_;
  const Slot p = object.to_parent == Transform{} ? point : moved(inverse(object.to_parent), point);
  if (std::holds_alternative<GroupShape>(object.shape))
    group(object, p);
  else
    shape(object, p);
  if (object.inverse) op(Op::invert);
  for (const Shared<Object>& clip : object.clipped_by) this->object(*clip, point), op(Op::both);
  keep_at(first);
}

}  // namespace vitrail::pov
