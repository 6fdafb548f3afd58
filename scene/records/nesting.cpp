// SPDX-License-Identifier: Apache-2.0
#include "scene/records/nesting.h"

#include <fmt/format.h>

#include <algorithm>
#include <limits>

namespace vitrail {

namespace {

class Unnesting {
 public:
  explicit Unnesting(const Scene& scene) : scene_(scene) {
    for (const Prototype& prototype : scene.prototypes) {
      auto count = static_cast<double>(prototype.shapes.size());
      for (const Instance& instance : prototype.instances) count += shapes_.at(instance.prototype.value);
      shapes_.push_back(count);
    }
    choose_limit();
  }

  Scene apply() const {
    Scene flat = scene_;
    const std::vector<double> uses = uses_with(limit_);
    for (std::size_t i = 0; i < shapes_.size(); ++i) {
      Prototype& prototype = flat.prototypes[i];
      prototype.instances.clear();
      if (uses[i] > 0 && is_whole(i, limit_)) take_shapes(scene_.prototypes[i].instances, prototype.shapes);
    }
    flat.instances.clear();
    for (const Instance& instance : scene_.instances) place(instance, flat.instances);
    return flat;
  }

 private:
  bool is_whole(std::size_t prototype, double limit) const { return shapes_[prototype] <= limit; }

  // Few records, and of several such choices the one that leaves most objects whole.
  void choose_limit() {
    constexpr double most_tried = 1e15;
    const auto largest = std::ranges::max_element(shapes_);
    limit_ = std::numeric_limits<double>::infinity();
    if (largest == shapes_.end()) return;
    double least = records_with(limit_);
    for (double limit = std::min(*largest, most_tried) / 2; limit >= 0.5; limit /= 2)
      if (const double count = records_with(limit); count < least) least = count, limit_ = limit;
    if (least > static_cast<double>(most_unnested_records))
      throw Error(
          fmt::format("objects within objects stand for {:.3g} shapes: too many to be written into a "
                      "format that has no instances in objects",
                      *largest),
          location(scene_, scene_.prototypes[static_cast<std::size_t>(largest - shapes_.begin())].origin));
  }

  // How often each prototype stands in the scene by itself; what nobody refers to counts once.
  std::vector<double> uses_with(double limit) const {
    std::vector<double> uses(shapes_.size(), 1);
    const auto use = [&](const std::vector<Instance>& instances, double times) {
      for (const Instance& instance : instances) uses[instance.prototype.value] += times;
    };
    const auto clear = [&](const std::vector<Instance>& instances) {
      for (const Instance& instance : instances) uses[instance.prototype.value] = 0;
    };
    clear(scene_.instances);
    for (const Prototype& prototype : scene_.prototypes) clear(prototype.instances);
    use(scene_.instances, 1);
    for (std::size_t i = shapes_.size(); i-- > 0;)
      if (!is_whole(i, limit)) use(scene_.prototypes[i].instances, uses[i]);
    return uses;
  }

  // Shapes and instances.
  double records_with(double limit) const {
    const std::vector<double> uses = uses_with(limit);
    double count = 0;
    for (std::size_t i = 0; i < shapes_.size(); ++i) {
      if (uses[i] == 0) continue;
      const auto own = static_cast<double>(scene_.prototypes[i].shapes.size());
      count += uses[i] + (is_whole(i, limit) ? shapes_[i] : own);
    }
    return count;
  }

  // Calls `visit` with each of the instances, in order; where that says so, then with those within it.
  template <class Visit>
  void descend(const std::vector<Instance>& instances, Visit&& visit) const {
    std::vector<Instance> open(instances.rbegin(), instances.rend());
    while (!open.empty()) {
      const Instance instance = open.back();
      open.pop_back();
      const Prototype& prototype = scene_.prototypes[instance.prototype.value];
      if (!visit(instance, prototype)) continue;
      for (std::size_t i = prototype.instances.size(); i-- > 0;) {
        Instance& inner = open.emplace_back(prototype.instances[i]);
        inner.prototype_to_world = instance.prototype_to_world * inner.prototype_to_world;
        inner.motion.reset();
      }
    }
  }

  void take_shapes(const std::vector<Instance>& instances, std::vector<Shape>& to) const {
    descend(instances, [&](const Instance& instance, const Prototype& prototype) {
      // A mirrored instance keeps the fronts of its prototype.
      const bool mirrors = swaps_handedness(instance.prototype_to_world);
      for (Shape shape : prototype.shapes) {
        shape.object_to_world = instance.prototype_to_world * shape.object_to_world;
        shape.flip_orientation = shape.flip_orientation != mirrors;
        to.push_back(std::move(shape));
      }
      return shapes_[instance.prototype.value] > 0;
    });
  }

  void place(const Instance& outer, std::vector<Instance>& to) const {
    descend({outer}, [&](const Instance& instance, const Prototype& prototype) {
      const bool whole = is_whole(instance.prototype.value, limit_);
      if (whole || !prototype.shapes.empty()) to.push_back(instance);
      return !whole;
    });
  }

  const Scene& scene_;
  std::vector<double> shapes_;  // of each prototype, with all that is in it
  double limit_ = 0;            // objects of more are taken apart
};

}  // namespace

bool has_nested_instances(const Scene& scene) {
  return std::ranges::any_of(scene.prototypes, [](const Prototype& p) { return !p.instances.empty(); });
}

Scene without_nested_instances(const Scene& scene) { return Unnesting(scene).apply(); }

}  // namespace vitrail
