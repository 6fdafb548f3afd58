// SPDX-License-Identifier: Apache-2.0
#include "importers/reading/given_glazing.h"

#include <fmt/format.h>

#include <algorithm>
#include <filesystem>
#include <set>

#include "importers/reading/glazing_material.h"
#include "importers/reading/suggestion.h"
#include "scene/records/material_traits.h"

namespace vitrail {

namespace {

// A name stands for several materials where a file has defined it more than once.
std::set<std::size_t> named(const std::vector<Material>& materials, const std::string& name,
                            const std::string& word) {
  std::set<std::size_t> found;
  std::vector<std::string> known;
  for (std::size_t i = 0; i < materials.size(); ++i) {
    if (materials[i].name == name) found.insert(i);
    known.push_back(materials[i].name);
  }
  if (found.empty())
    throw UsageError(
        fmt::format("--glazing {}: the scene has no material \"{}\"{}", word, name, suggestion(name, known)));
  for (const Material& material : materials)
    for (const Id<Material> part : parts_of(material.model))
      if (found.contains(part.value) && material.name != name)
        throw UsageError(
            fmt::format("--glazing {}: the material \"{}\" is a part of \"{}\"", word, name, material.name));
  return found;
}

}  // namespace

void give_glazing(ImportedScene& imported, const std::vector<std::string>& given) {
  Scene& scene = imported.scene;
  for (const std::string& word : given) {
    const std::size_t at = word.find('=');
    const std::string name = word.substr(0, at);
    const std::set<std::size_t> replaced = named(scene.materials, name, word);
    const std::string file = std::filesystem::absolute(word.substr(at + 1)).lexically_normal().string();
    const auto add = [&](Material material) {
      scene.materials.push_back(std::move(material));
      return Id<Material>{static_cast<std::uint32_t>(scene.materials.size() - 1)};
    };
    GlazingModel made = glazing_model(file, add);
    // Parts come before what is made of them, so the glazing is a material of its own, which takes the name.
    Material whole{std::move(made.model)};
    whole.name = name;
    whole.origin = scene.materials[*replaced.begin()].origin;
    for (const std::size_t i : replaced) scene.materials[i].name.clear();
    const Id<Material> glazing = add(std::move(whole));
    const auto put = [&](std::vector<Shape>& shapes) {
      for (Shape& shape : shapes)
        if (replaced.contains(shape.material.value)) shape.material = glazing, shape.opacity = 1.0f;
    };
    put(scene.shapes);
    for (Prototype& prototype : scene.prototypes) put(prototype.shapes);
    for (std::string& note : made.notes)
      imported.diagnostics.push_back({Fidelity::approximated, std::move(note), {file}, {}, RecordKind::any});
  }
}

}  // namespace vitrail
