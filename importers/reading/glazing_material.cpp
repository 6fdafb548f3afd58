// SPDX-License-Identifier: Apache-2.0
#include "importers/reading/glazing_material.h"

#include <algorithm>

#include "glazing/scattering.h"
#include "glazing/sheet.h"
#include "glazing/system_file.h"
#include "importers/spectra/sheet_file.h"
#include "scene/records/material_traits.h"
#include "scene/records/uv_uses.h"
#include "scene/spectra/spectrum.h"

namespace vitrail {

bool is_glazing(const std::string& file) { return !is_measured_sheet(file) && is_glazing_file(file); }

namespace {

using AddMaterial = std::function<Id<Material>(Material)>;

// A side that scatters: chance makes it the sheet, or a surface that scatters by Lambert's law. It is that so
// often that neither has to do more than all light.
MaterialModel scattering_side(MeasuredMaterial measured, const ScatteredShares& scattered,
                              const AddMaterial& add) {
  MeasuredSheet& sheet = *measured.sheet;
  float often = 0;
  for (std::size_t i = 0; i < scattered.reflected.size(); ++i)
    often = std::max(often, scattered.reflected[i] + scattered.transmitted[i]);
  often = std::clamp(often, 1e-3f, 1 - 1e-3f);
  for (std::size_t i = 0; i < sheet.transmittance.size(); ++i) {
    float &t = sheet.transmittance[i], &r = sheet.reflectance[i];
    t = std::min(t / (1 - often), 1.0f), r = std::min(r / (1 - often), 1 - t);
  }
  const auto spectrum = [&](const std::vector<float>& values) {
    std::vector<SpectrumSample> samples;
    for (std::size_t i = 0; i < values.size(); ++i)
      samples.push_back({static_cast<double>(sheet.wavelengths_nm[i]),
                         static_cast<double>(std::min(values[i] / often, 1.0f))});
    return Spectrum{tabulate(samples, true)};
  };
  const DiffuseTransmissionMaterial diffuse{spectrum(scattered.reflected), spectrum(scattered.transmitted)};
  return BlendMaterial{add(Material{std::move(measured)}), add(Material{diffuse}), often};
}

}  // namespace

GlazingModel glazing_model(const std::string& file, const AddMaterial& add) {
  ReadSystem read = read_system({file});
  if (const std::string held = held_note(read.system, lambda_min_nm, lambda_max_nm); !held.empty())
    read.notes.push_back(file + ": " + held);
  if (switches(read.system) && scatters_light(read.system)) {
    // What a bundle keeps of switchable glazing (kept_system.h) has no scattered rows.
    read.notes.push_back(file +
                         ": a system that switches: what its panes scatter goes straight on in pictures");
    forget_scattering(read.system);
  }
  for (const std::string& note : scattering_notes(read.system)) read.notes.push_back(file + ": " + note);
  GlazingSheets sheets = sheets_of(read.system, Polarisation::apart);
  MeasuredMaterial front{file, std::move(sheets.front)}, back{file, std::move(sheets.back)};
  if (!sheets.front_scattered.reflected.empty()) {
    const auto side = [&](MeasuredMaterial& measured, const ScatteredShares& scattered) {
      return add(Material{scattering_side(std::move(measured), scattered, add)});
    };
    const Id<Material> outside = side(front, sheets.front_scattered),
                       inside = side(back, sheets.back_scattered);
    return {TwoSidedMaterial{outside, inside}, std::move(read.notes)};
  }
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

// Of a side of two, which may be a scattering_side.
const MeasuredMaterial* sheet_of_side(const std::vector<Material>& materials, Id<Material> side) {
  const auto* blend = std::get_if<BlendMaterial>(&materials.at(side.value).model);
  if (!blend) return sheet_in(materials.at(side.value));
  const Material& other = materials.at(blend->second.value);
  return std::holds_alternative<DiffuseTransmissionMaterial>(other.model)
             ? sheet_in(materials.at(blend->first.value))
             : nullptr;
}

}  // namespace

std::string glazing_file_of(const std::vector<Material>& materials, std::size_t index) {
  const auto* sides = std::get_if<TwoSidedMaterial>(&materials.at(index).model);
  const auto* front = sides ? sheet_of_side(materials, sides->front) : sheet_in(materials[index]);
  const auto* back = sides ? sheet_of_side(materials, sides->back) : front;
  if (!front || !back || front->filename != back->filename || !is_glazing(front->filename)) return {};
  return front->filename;
}

std::vector<bool> sides_of_glazing(const Scene& scene) {
  std::vector<bool> sides(scene.materials.size()), shown(scene.materials.size());
  const auto parts = [&](std::size_t material) { return parts_of(scene.materials[material].model); };
  std::vector<bool> glazing(scene.materials.size());
  for (std::size_t i = 0; i < scene.materials.size(); ++i) {
    glazing[i] = std::holds_alternative<TwoSidedMaterial>(scene.materials[i].model) &&
                 !glazing_file_of(scene.materials, i).empty();
    if (!glazing[i]) continue;
    for (const Id<Material> side : parts(i)) {
      sides[side.value] = true;
      for (const Id<Material> of_side : parts(side.value)) sides[of_side.value] = true;
    }
  }
  for (std::size_t i = 0; i < scene.materials.size(); ++i)
    if (!glazing[i] && !sides[i])
      for (const Id<Material> part : parts(i)) shown[part.value] = true;
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
