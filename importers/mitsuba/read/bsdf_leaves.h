// SPDX-License-Identifier: Apache-2.0
// These functions change the material inside of an adapter.
#pragma once

#include <unordered_map>

#include "importers/mitsuba/read/builder.h"

namespace vitrail::mitsuba {

// It changes the material, or where it is made of others a copy of each of them, once: the file may refer to
// them elsewhere, too, and more than once.
template <class Change>
class LeafChanger {
 public:
  LeafChanger(Builder& b, const Change& change) : b_(b), change_(change) {}

  void apply(Material& material) {
    if (auto* blend = std::get_if<BlendMaterial>(&material.model))
      copy(blend->first), copy(blend->second);
    else if (auto* mask = std::get_if<MaskMaterial>(&material.model))
      copy(mask->material);
    else if (auto* sided = std::get_if<TwoSidedMaterial>(&material.model))
      copy(sided->front), copy(sided->back);
    else
      change_(material);
  }

 private:
  void copy(Id<Material>& id) {
    if (const auto known = copies_.find(id.value); known != copies_.end()) {
      id = known->second;
      return;
    }
    const std::uint32_t original = id.value;
    Material material = b_.scene.materials.at(original);
    material.name.clear();
    apply(material);
    id = copies_[original] = append(b_, std::move(material));
  }

  Builder& b_;
  const Change& change_;
  std::unordered_map<std::uint32_t, Id<Material>> copies_;
};

// Calls change(material) with the material, or with each that it is made of.
template <class Change>
void change_leaves(Builder& b, Material& material, const Change& change) {
  LeafChanger(b, change).apply(material);
}

}  // namespace vitrail::mitsuba
