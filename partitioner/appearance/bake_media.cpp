// SPDX-License-Identifier: Apache-2.0
#include "partitioner/appearance/bake_media.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <fstream>

#include "scene/color.h"
#include "scene/diagnostics.h"

namespace vitrail {

namespace {

static_assert(std::endian::native == std::endian::little);

// The values of a Mitsuba volume file of version 3: floats after a header of 48 bytes, whose counts the
// importer has checked.
void read_values(Grid& grid) {
  constexpr std::streamoff header_bytes = 48;
  const std::size_t count = static_cast<std::size_t>(grid.nx) * static_cast<std::size_t>(grid.ny) *
                            static_cast<std::size_t>(grid.nz) * static_cast<std::size_t>(grid.channels);
  grid.values.resize(count);
  std::ifstream in(grid.filename, std::ios::binary);
  in.seekg(header_bytes);
  in.read(reinterpret_cast<char*>(grid.values.data()), static_cast<std::streamsize>(count * sizeof(float)));
  if (!in) throw Error("the file ends before the grid that its header announces", {grid.filename});
}

// False where the grid cannot be read.
bool bake_grid(Grid& grid, std::vector<std::string>& notes) {
  if (!grid.filename.empty()) {
    if (!grid.field.empty() || grid.nx == 0) {
      notes.push_back("its NanoVDB grid cannot be read");
      return false;
    }
    read_values(grid);
  }
  grid.filename.clear();
  constexpr const char* grey = "the colours of its grids become grey, their means";
  if (grid.channels > 1 && std::ranges::find(notes, grey) == notes.end()) notes.push_back(grey);
  for (const float v : grid.values)
    if (!std::isfinite(v) || v < 0) throw Error("a grid has a value that is negative or not finite");
  return true;
}

bool bake_volume(VolumeParameter& volume, std::vector<std::string>& notes) {
  if (auto* spectrum = std::get_if<Spectrum>(&volume)) {
    *spectrum = resolved(*spectrum);
    return true;
  }
  return bake_grid(std::get<Grid>(volume), notes);
}

}  // namespace

std::optional<Medium> bake_medium(const Medium& medium, std::vector<std::string>& notes) {
  Medium baked = medium;
  baked.name.clear();
  bool whole = true;
  if (auto* k = std::get_if<AbsorptionScattering>(&baked.coefficients))
    whole = bake_volume(k->sigma_a, notes) && bake_volume(k->sigma_s, notes);
  else if (auto* albedo = std::get_if<ExtinctionAlbedo>(&baked.coefficients))
    whole = bake_volume(albedo->sigma_t, notes) && bake_volume(albedo->albedo, notes);
  else
    whole = false, notes.push_back("its coefficients are known by name alone, and not here");
  if (auto* grid = std::get_if<Grid>(&baked.density))
    whole = whole && bake_grid(*grid, notes);
  else if (std::holds_alternative<CloudDensity>(baked.density))
    whole = false, notes.push_back("a procedural cloud cannot be shown");
  if (!whole) return std::nullopt;
  if (baked.temperature) {
    notes.push_back("its glow by temperature is left out");
    baked.temperature.reset();
    baked.emission.reset();
  }
  if (baked.emission)
    *baked.emission = scaled(resolved(*baked.emission), static_cast<double>(baked.emission_factor));
  if (baked.emission_scale && !bake_grid(*baked.emission_scale, notes)) baked.emission.reset();
  if (!baked.emission) baked.emission_scale.reset();
  baked.emission_factor = 1;
  return baked;
}

}  // namespace vitrail
