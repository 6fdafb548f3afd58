// SPDX-License-Identifier: Apache-2.0
#include "importers/glazing_material.h"

#include "glazing/sheet.h"
#include "glazing/system_file.h"
#include "importers/spectra/measured_sheet.h"
#include "scene/spectrum.h"

namespace vitrail {

bool is_glazing(const std::string& file) { return !is_measured_sheet(file) && is_glazing_file(file); }

GlazingModel glazing_model(const std::string& file, const std::function<Id<Material>(Material)>& add) {
  ReadSystem read = read_system({file});
  if (const std::string held = held_note(read.system, lambda_min_nm, lambda_max_nm); !held.empty())
    read.notes.push_back(file + ": " + held);
  GlazingSheets sheets = sheets_of(read.system, Polarisation::mixed_at_panes);
  MeasuredMaterial front{file, std::move(sheets.front)}, back{file, std::move(sheets.back)};
  // Sides that are alike in this state may differ in another.
  if (front == back && !switches(read.system)) return {std::move(front), std::move(read.notes)};
  const Id<Material> outside = add(Material{std::move(front)}), inside = add(Material{std::move(back)});
  return {TwoSidedMaterial{outside, inside}, std::move(read.notes)};
}

}  // namespace vitrail
