// SPDX-License-Identifier: Apache-2.0
#include "partitioner/placing/objects.h"

#include <fmt/format.h>

#include <algorithm>

#include "bundle/triangle_number.h"
#include "partitioner/placing/object_bounds.h"

namespace vitrail {

void for_each_use(const QuadricRun& run, const std::function<void(const ObjectUse&)>& visit) {
  std::array<Transform, 1024> block;
  for (std::size_t i = 0; i < run.places->size(); i += block.size()) {
    const std::size_t count = std::min(block.size(), run.places->size() - i);
    run.places->read(i, std::span(block).first(count));
    for (std::size_t k = 0; k < count; ++k) visit(run.use(i + k, block[k]));
  }
}

namespace {

Affine placed_use(const Assembly& object, const Affine& outer, const Affine& to_parent) {
  return object.quadric ? compose(outer, *object.quadric->mesh->quadric, to_parent)
                        : compose(outer, to_parent);
}

// Calls visit(object, chain, first id) for every use of the scene and within, of objects that `enter` says
// to. What moves has no place for what is within it.
void for_each_use(const ScenePlan& plan, const std::vector<bool>& enter, const auto& visit) {
  const std::function<void(const ObjectUse&, const Affine&, std::uint64_t)> expand =
      [&](const ObjectUse& use, const Affine& chain, std::uint64_t first) {
        if (!enter[use.object]) return;
        visit(use.object, chain, first);
        if (plan.objects[use.object].motion) return;
        for (const ObjectUse& inner : plan.objects[use.object].uses)
          expand(inner, placed_use(plan.objects[inner.object], chain, inner.to_parent),
                 first + inner.first_triangle);
      };
  for (const ObjectUse& use : plan.scene.uses) expand(use, use.to_parent, use.first_triangle);
}

}  // namespace

std::vector<Placement> expanded(const ScenePlan& plan, const std::function<bool(const Placement&)>& select) {
  // Each object is asked once; what holds nothing that is wanted is not entered.
  std::vector<std::vector<const Placement*>> wanted(plan.objects.size());
  std::vector<bool> holds(plan.objects.size());
  for (std::size_t i = 0; i < plan.objects.size(); ++i) {
    for (const Placement& p : plan.objects[i].placements)
      if (select(p)) wanted[i].push_back(&p);
    if (const auto& quadric = plan.objects[i].quadric; quadric && select(*quadric))
      wanted[i].push_back(&*quadric);
    holds[i] = !wanted[i].empty() || std::ranges::any_of(plan.objects[i].uses, [&](const ObjectUse& use) {
      return holds[use.object];
    });
  }
  std::vector<Placement> out;
  for_each_use(plan, holds, [&](std::uint32_t object, const Affine& chain, std::uint64_t first) {
    for (const Placement* p : wanted[object]) {
      Placement& placed = out.emplace_back(*p);
      placed.first_triangle += first;
      placed.standing = Standing{plan.objects[object].centre, chain};
    }
  });
  std::ranges::sort(out, {}, &Placement::first_triangle);
  return out;
}

void flatten(ScenePlan& plan) {
  if (plan.scene.triangles > triangle_numbers)
    throw Error(fmt::format("it has {} triangles with all instances; --flatten copies up to {}",
                            plan.scene.triangles, triangle_numbers));
  // Those that stay whatever is copied, and of what is within those that move all.
  std::vector<bool> stays(plan.objects.size()), within(plan.objects.size());
  for (std::size_t i = plan.objects.size(); i-- > 0;) {
    const Assembly& object = plan.objects[i];
    stays[i] = object.quadric || object.motion || within[i];
    if (object.motion || within[i])
      for (const ObjectUse& use : object.uses) within[use.object] = true;
  }
  std::vector<Placement>& own = plan.scene.placements;
  std::ranges::copy(expanded(plan, [](const Placement& p) { return !p.mesh->quadric; }),
                    std::back_inserter(own));
  std::ranges::sort(own, {}, &Placement::first_triangle);
  std::vector<ObjectUse> uses;
  for_each_use(plan, std::vector(plan.objects.size(), true),
               [&](std::uint32_t object, const Affine& chain, std::uint64_t first) {
                 const Assembly& used = plan.objects[object];
                 if (used.quadric || used.motion) uses.push_back({object, chain, first});
               });
  std::vector<std::uint32_t> kept(plan.objects.size());
  std::vector<Assembly> objects;
  for (std::size_t i = 0; i < plan.objects.size(); ++i) {
    if (!stays[i]) continue;
    kept[i] = static_cast<std::uint32_t>(objects.size());
    objects.push_back(std::move(plan.objects[i]));
    for (ObjectUse& use : objects.back().uses) use.object = kept[use.object];
  }
  for (ObjectUse& use : uses) use.object = kept[use.object];
  for (QuadricRun& run : plan.scene.runs) run.object = kept[run.object];
  std::ranges::sort(uses, {}, &ObjectUse::first_triangle);
  plan.scene.uses = std::move(uses);
  plan.objects = std::move(objects);
}

}  // namespace vitrail
