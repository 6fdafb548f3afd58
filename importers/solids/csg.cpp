// SPDX-License-Identifier: Apache-2.0
#include "importers/solids/csg.h"

#include <algorithm>
#include <cmath>
#include <optional>
#include <utility>

#include "importers/solids/bodies.h"
#include "importers/solids/boolean.h"
#include "importers/solids/primitives.h"

namespace vitrail::solids {

namespace {

using Bodies = std::vector<Solid>;

// What any of the bodies holds, or all the rest.
struct Value {
  Bodies bodies;
  bool complement = false;
};

// A set that others are intersected with, or its complement.
struct Literal {
  const Csg* csg;
  bool negated;
};

Bounds3d bounds_of(const Bodies& bodies) {
  Bounds3d bounds;
  for (const Solid& body : bodies) extend(bounds, solids::bounds_of(body));
  return bounds;
}

class Evaluation {
 public:
  Evaluation(const CsgOptions& options, CsgResult& result) : options_(options), result_(result) {
    const double r = options.reach;
    reach_ = {{-r, -r, -r}, {r, r, r}};
  }

  Value value_of(const Csg& csg) {
    const Bounds3d before = reach_;
    if (csg.bounds) narrow_to(*csg.bounds);
    Value value = value_within(csg);
    reach_ = before;
    return value;
  }

 private:
  // A little more than the box, so that what closes a set without end lies beyond what it is cut by.
  void narrow_to(const Bounds3d& box) {
    const Vector3d margin = extent(box) * 0.0173 + Vector3d{1e-9, 1e-9, 1e-9};
    const Bounds3d narrow = vitrail::common(reach_, Bounds3d{box.lower - margin, box.upper + margin});
    if (!narrow.empty()) reach_ = narrow;
  }

  Value value_within(const Csg& csg) {
    switch (csg.kind) {
      case Csg::Kind::solid:
        return {bodies_of(csg.solid)};
      case Csg::Kind::unbounded:
        return {{csg.within(reach_)}};
      case Csg::Kind::unite:
        return united(csg, false);
      case Csg::Kind::merge:
        return united(csg, true);
      case Csg::Kind::cut_surfaces:
        return cut(csg);
      case Csg::Kind::complement:
      case Csg::Kind::intersect:
        break;
    }
    std::vector<Literal> literals;
    gather(csg, false, literals);
    return intersected(literals);
  }

  // ¬(A ∪ B) = ¬A ∩ ¬B: what is intersected, without trees.
  static void gather(const Csg& csg, bool negated, std::vector<Literal>& literals) {
    const bool is_union = csg.kind == Csg::Kind::unite || csg.kind == Csg::Kind::merge;
    if (csg.kind == Csg::Kind::complement) {
      gather(csg.operands.front(), !negated, literals);
    } else if (negated ? is_union : csg.kind == Csg::Kind::intersect) {
      for (const Csg& operand : csg.operands) gather(operand, negated, literals);
    } else {
      literals.push_back({&csg, negated});
    }
  }

  // The operation, or `otherwise` and a reason.
  Solid carried_out(Operation operation, const Solid& a, const Solid& b, Solid otherwise) {
    BooleanResult made = boolean(operation, a, b);
    result_.perturbation = std::max(result_.perturbation, made.moved);
    if (made.solid) return std::move(*made.solid);
    refuse(operation == Operation::unite      ? "merge"
           : operation == Operation::subtract ? "difference"
                                              : "intersection",
           made.reason);
    return otherwise;
  }

  void refuse(const std::string& operation, const std::string& reason) {
    const std::string said = operation + ": " + reason;
    if (std::ranges::find(result_.refused, said) == result_.refused.end()) result_.refused.push_back(said);
  }

  // Where surfaces coincide the later one is seen, as in POV-Ray.
  Value intersected(const std::vector<Literal>& literals) {
    struct Positive {
      Bodies bodies;
      std::size_t place;  // among the literals
    };
    std::vector<Positive> positives;
    Bodies negatives;
    std::vector<Literal> unbounded;
    for (const Literal& literal : literals) {
      if (literal.csg->kind == Csg::Kind::unbounded) {
        unbounded.push_back(literal);
        continue;
      }
      Value value = value_of(*literal.csg);
      if (value.complement == literal.negated) {
        positives.push_back({std::move(value.bodies), positives.size()});
      } else {
        std::ranges::move(value.bodies, std::back_inserter(negatives));
      }
    }
    if (positives.empty() && unbounded.empty()) return {std::move(negatives), true};
    Bodies left;
    std::size_t latest = 0;  // of those that `left` is of
    const bool from_infinity = positives.empty();
    if (from_infinity) {
      left.push_back(box(reach_.lower, reach_.upper));
      std::ranges::fill(left.front().surfaces, unseen);
    } else {
      const auto smallest = std::ranges::min_element(
          positives, {}, [](const Positive& p) { return length(extent(bounds_of(p.bodies))); });
      std::iter_swap(positives.begin(), smallest);
      left = std::move(positives.front().bodies);
      latest = positives.front().place;
      positives.erase(positives.begin());
    }
    for (const Literal& literal : unbounded) {
      if (left.empty()) return {};
      const Solid part = literal.csg->within(bounds_of(left));
      left = literal.negated ? without(left, {part}) : common(left, {part});
    }
    for (const Positive& other : positives) {
      left = other.place > latest ? common(other.bodies, left) : common(left, other.bodies);
      latest = std::max(latest, other.place);
    }
    left = without(left, negatives);
    if (from_infinity) note_infinity(left);
    return {std::move(left)};
  }

  void note_infinity(const Bodies& bodies) {
    const Bounds3d bounds = bounds_of(bodies);
    for (int axis = 0; axis < 3 && !bounds.empty(); ++axis)
      if (bounds.upper[axis] >= options_.reach || bounds.lower[axis] <= -options_.reach)
        result_.reaches_infinity = true;
  }

  // Of surfaces that coincide, those of `seen` are kept, if CGAL does not refuse that; and if it refuses the
  // other order, too, the smaller one stays as it is.
  Solid intersection(const Solid& seen, const Solid& other) {
    const auto size = [](const Solid& s) { return length(extent(solids::bounds_of(s))); };
    if (size(seen) <= size(other)) return carried_out(Operation::intersect, seen, other, seen);
    BooleanResult made = boolean(Operation::intersect, seen, other);
    if (!made.solid) return carried_out(Operation::intersect, other, seen, other);
    result_.perturbation = std::max(result_.perturbation, made.moved);
    return std::move(*made.solid);
  }

  Bodies common(const Bodies& seen, const Bodies& other) {
    Bodies made;
    for (const Solid& a : seen)
      for (const Solid& b : other) {
        Solid both = intersection(a, b);
        if (!both.empty()) made.push_back(std::move(both));
      }
    return made;
  }

  // One after the other. What is left of a body may intersect itself by a rounding, where the next cannot be
  // cut out: then all are cut out exactly.
  Bodies without(const Bodies& left, const Bodies& cut) {
    const Bodies together = grouped(cut);
    Bodies made;
    for (const Solid& body : left) {
      const std::vector<std::string> before = result_.refused;
      Solid rest = cut_out(body, together);
      if (result_.refused.size() > before.size() && together.size() > 1)
        if (BooleanResult exact = subtract_exactly(body, together); exact.solid) {
          rest = std::move(*exact.solid);
          result_.refused = before;
        }
      if (!rest.empty()) made.push_back(std::move(rest));
    }
    return made;
  }

  Solid cut_out(Solid rest, const Bodies& cut) {
    for (const Solid& b : cut)
      if (!rest.empty() && boxes_meet(solids::bounds_of(rest), solids::bounds_of(b)))
        rest = carried_out(Operation::subtract, rest, b, rest);
    return rest;
  }

  Bodies merged(Bodies bodies) {
    while (bodies.size() > 1) {
      Bodies half;
      for (std::size_t i = 0; i < bodies.size(); i += 2) {
        if (i + 1 == bodies.size()) {
          half.push_back(std::move(bodies[i]));
          break;
        }
        BooleanResult made = boolean(Operation::unite, bodies[i], bodies[i + 1]);
        result_.perturbation = std::max(result_.perturbation, made.moved);
        if (made.solid) {
          half.push_back(std::move(*made.solid));
        } else {
          refuse("merge", made.reason);
          half.push_back(std::move(bodies[i]));
          kept_apart_.push_back(std::move(bodies[i + 1]));
        }
      }
      bodies = std::move(half);
    }
    std::ranges::move(kept_apart_, std::back_inserter(bodies));
    kept_apart_.clear();
    return bodies;
  }

  Value united(const Csg& csg, bool is_merge) {
    const auto is_unbounded = [](const Csg& c) { return c.kind == Csg::Kind::unbounded; };
    std::vector<Value> values;
    bool any = std::ranges::any_of(csg.operands, is_unbounded);
    if (!any)
      for (const Csg& operand : csg.operands) {
        values.push_back(value_of(operand));
        any = any || values.back().complement;
      }
    if (any) {  // A ∪ B = ¬(¬A ∩ ¬B)
      std::vector<Literal> literals;
      gather(csg, true, literals);
      Value rest = intersected(literals);
      rest.complement = !rest.complement;
      return rest;
    }
    Value made;
    for (Value& value : values) std::ranges::move(value.bodies, std::back_inserter(made.bodies));
    if (is_merge) made.bodies = merged(std::move(made.bodies));
    return made;
  }

  Value cut(const Csg& csg) {
    Value object = value_of(csg.operands.front());
    std::vector<Literal> literals;
    for (std::size_t i = 1; i < csg.operands.size(); ++i) gather(csg.operands[i], false, literals);
    for (const Literal& literal : literals) {
      bool keep_inside = !literal.negated;
      Bodies by;
      if (object.bodies.empty()) break;
      if (literal.csg->kind == Csg::Kind::unbounded) {
        by.push_back(literal.csg->within(bounds_of(object.bodies)));
      } else {
        Value value = value_of(*literal.csg);
        keep_inside = keep_inside != value.complement;
        by = keep_inside ? merged(std::move(value.bodies)) : std::move(value.bodies);
      }
      object.bodies = keep_inside ? cut_inside(object.bodies, by) : cut_outside(std::move(object.bodies), by);
    }
    for (Solid& body : object.bodies) body.closed = false;
    return object;
  }

  Solid cut_by(const Solid& surface, const Solid& by, bool keep_inside) {
    BooleanResult made = cut_surface(surface, by, keep_inside);
    result_.perturbation = std::max(result_.perturbation, made.moved);
    if (made.solid) return std::move(*made.solid);
    refuse("clipped_by", made.reason);
    return surface;
  }

  Bodies cut_inside(const Bodies& surfaces, const Bodies& by) {
    Bodies made;
    for (const Solid& surface : surfaces)
      for (const Solid& b : by) made.push_back(b.empty() ? Solid{} : cut_by(surface, b, true));
    std::erase_if(made, [](const Solid& solid) { return solid.empty(); });
    return made;
  }

  Bodies cut_outside(Bodies surfaces, const Bodies& by) {
    for (Solid& surface : surfaces)
      for (const Solid& b : by)
        if (!surface.empty() && !b.empty()) surface = cut_by(surface, b, false);
    std::erase_if(surfaces, [](const Solid& solid) { return solid.empty(); });
    return surfaces;
  }

  const CsgOptions& options_;
  Bounds3d reach_;  // of what has no end
  CsgResult& result_;
  Bodies kept_apart_;
};

}  // namespace

CsgResult evaluate(const Csg& csg, const CsgOptions& options) {
  CsgResult result;
  Value value = Evaluation(options, result).value_of(csg);
  for (const Solid& body : value.bodies) append(result.solid, body);
  if (value.complement) result.solid = inverted(std::move(result.solid));
  return result;
}

}  // namespace vitrail::solids
