// SPDX-License-Identifier: Apache-2.0
#include "importers/reading/glazing_material.h"

#include "glazing/scattering.h"
#include "glazing/sheet.h"
#include "glazing/system_file.h"
#include "importers/spectra/sheet_file.h"
#include "scene/records/material_traits.h"
#include "scene/records/uv_uses.h"
#include "scene/spectra/spectrum.h"

namespace vitrail {

bool is_glazing(const std::string& file) { return !is_measured_sheet(file) && is_glazing_file(file); }

GlazingModel glazing_model(const std::string& file, const std::function<Id<Material>(Material)>& add) {
  ReadSystem read = read_system({file});
  if (const std::string held = held_note(read.system, lambda_min_nm, lambda_max_nm); !held.empty())
    read.notes.push_back(file + ": " + held);
  for (const std::string& note : scattering_notes(read.system)) read.notes.push_back(file + ": " + note);
  GlazingSheets sheets = sheets_of(read.system, Polarisation::apart);
  MeasuredMaterial front{file, std::move(sheets.front)}, back{file, std::move(sheets.back)};
  // Sides that are alike in this state may differ in another.
  if (front == back && !switches(read.system)) return {std::move(front), std::move(read.notes)};
  const Id<Material> outside = add(Material{std::move(front)}), inside = add(Material{std::move(back)});
  return {TwoSidedMaterial{outside, inside}, std::move(read.notes)};
}

namespace {

const MeasuredMaterial* sheet_in(const Material& material) {
  const auto* measured = std::get_if<MeasuredMaterial>(&material.model);
  return measured && measured->sheet && !measured->filename.empty() ? measured : nullptr;
}

}  // namespace

std::string glazing_file_of(const std::vector<Material>& materials, std::size_t index) {
  const auto* sides = std::get_if<TwoSidedMaterial>(&materials.at(index).model);
  const auto* front = sheet_in(sides ? materials.at(sides->front.value) : materials[index]);
  const auto* back = sides ? sheet_in(materials.at(sides->back.value)) : front;
  if (!front || !back || front->filename != back->filename || !is_glazing(front->filename)) return {};
  return front->filename;
}

std::vector<bool> sides_of_glazing(const Scene& scene) {
  std::vector<bool> sides(scene.materials.size()), shown(scene.materials.size());
  for (std::size_t i = 0; i < scene.materials.size(); ++i) {
    const auto* sided = std::get_if<TwoSidedMaterial>(&scene.materials[i].model);
    const bool is_glazing = sided && !glazing_file_of(scene.materials, i).empty();
    for (const Id<Material> part : parts_of(scene.materials[i].model))
      (is_glazing ? sides : shown)[part.value] = true;
  }
  const auto show = [&](const std::vector<Shape>& shapes) {
    for (const Shape& shape : shapes) shown[shape.material.value] = true;
  };
  show(scene.shapes);
  for (const auto& prototype : scene.prototypes) show(prototype.shapes);
  for (std::size_t i = 0; i < sides.size(); ++i)
    if (shown[i]) sides[i] = false;
  return sides;
}

}  // namespace vitrail
