// SPDX-License-Identifier: Apache-2.0
#include "scene/records/nesting_limits.h"

#include <fmt/format.h>

#include <algorithm>

#include "scene/records/material_traits.h"
#include "scene/records/texture_inputs.h"
#include "scene/records/uv_uses.h"

namespace vitrail {

namespace {

std::string named(const std::string& name) { return name.empty() ? "" : fmt::format(" \"{}\"", name); }

[[noreturn]] void refuse_depth(const Scene& scene, const char* what, const std::string& name,
                               const Origin& origin) {
  throw Error(fmt::format("{}{} is nested too deeply: at most {} may lie within each other", what,
                          named(name), most_nested),
              location(scene, origin));
}

void require(const Scene& scene, const Nesting& nesting, const char* what, const auto& record) {
  if (nesting.levels > most_nested) refuse_depth(scene, what, record.name, record.origin);
  if (nesting.lookups > most_lookups)
    throw Error(fmt::format("{}{} is made of too many: where those that it shares count each time, one may "
                            "lead to {}",
                            what, named(record.name), most_lookups),
                location(scene, record.origin));
}

}  // namespace

void Nesting::add(const Nesting& part) {
  constexpr std::uint64_t most = std::uint64_t{1} << 63;
  levels = std::max(levels, part.levels + 1);
  lookups = part.lookups >= most - lookups ? most : lookups + part.lookups;
}

std::vector<Nesting> nesting_of(const std::vector<Texture>& textures) {
  std::vector<Nesting> all;
  for (const Texture& texture : textures) {
    Nesting own;
    for_texture_inputs(texture.model, [&](Id<Texture> input) { own.add(all.at(input.value)); });
    all.push_back(own);
  }
  return all;
}

std::vector<Nesting> nesting_of(const std::vector<Material>& materials) {
  std::vector<Nesting> all;
  for (const Material& material : materials) {
    Nesting own;
    for (const Id<Material> part : parts_of(material.model)) own.add(all.at(part.value));
    all.push_back(own);
  }
  return all;
}

void require_shallow(const Scene& scene) {
  const std::vector<Nesting> textures = nesting_of(scene.textures);
  for (std::size_t i = 0; i < textures.size(); ++i) require(scene, textures[i], "texture", scene.textures[i]);
  const std::vector<Nesting> materials = nesting_of(scene.materials);
  for (std::size_t i = 0; i < materials.size(); ++i)
    require(scene, materials[i], "material", scene.materials[i]);
  std::vector<int> levels;
  for (const Prototype& prototype : scene.prototypes) {
    levels.push_back(1);
    for (const Instance& inner : prototype.instances)
      levels.back() = std::max(levels.back(), levels.at(inner.prototype.value) + 1);
    if (levels.back() > most_nested) refuse_depth(scene, "object", prototype.name, prototype.origin);
  }
}

}  // namespace vitrail
