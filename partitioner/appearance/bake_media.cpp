// SPDX-License-Identifier: Apache-2.0
#include "partitioner/appearance/bake_media.h"

#include <fmt/format.h>

#include <algorithm>
#include <bit>
#include <cmath>
#include <numeric>

#include "bundle/reflectances/reflectance_fitter.h"
#include "images/nanovdb.h"
#include "scene/models/measured_media.h"
#include "scene/spectra/color.h"
#include "scene/spectra/matrix_r.h"
#include "scene/system/diagnostics.h"
#include "scene/system/input_files.h"

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
  std::ifstream in = open_input(grid.filename);
  in.seekg(header_bytes);
  in.read(reinterpret_cast<char*>(grid.values.data()), static_cast<std::streamsize>(count * sizeof(float)));
  if (!in) throw Error("the file ends before the grid that its header announces", {grid.filename});
}

// "cell 3,0,1 of 4 × 4 × 4": of the value of that place in the grid.
std::string cell_of(const Grid& grid, std::size_t value) {
  const std::size_t cell = value / static_cast<std::size_t>(grid.channels),
                    nx = static_cast<std::size_t>(grid.nx), ny = static_cast<std::size_t>(grid.ny);
  return fmt::format("cell {},{},{} of {} × {} × {}", cell % nx, cell / nx % ny, cell / nx / ny, grid.nx,
                     grid.ny, grid.nz);
}

// What programs that filter write below 0 counts as 0.
void no_negatives(Grid& grid, std::vector<std::string>& notes) {
  std::size_t negative = 0, first = 0;
  for (std::size_t i = 0; i < grid.values.size(); ++i) {
    if (!std::isfinite(grid.values[i]))
      throw Error(fmt::format("a grid has a value that is not finite, in {}", cell_of(grid, i)));
    if (grid.values[i] < 0 && negative++ == 0) first = i;
  }
  if (negative == 0) return;
  notes.push_back(fmt::format("{} values of its grid are below 0 and count as 0, the first, {:g}, in {}",
                              negative, grid.values[first], cell_of(grid, first)));
  for (float& v : grid.values) v = std::max(v, 0.0f);
}

// False where the grid cannot be read.
bool bake_grid(Grid& grid, std::vector<std::string>& notes) {
  if (!grid.filename.empty()) {
    if (grid.nx == 0) {
      notes.push_back("its grid's file is not there");
      return false;
    }
    if (grid.field.empty())
      read_values(grid);
    else
      grid.values = read_nanovdb_values(grid);
  }
  grid.filename.clear();
  grid.field.clear();
  no_negatives(grid, notes);
  return true;
}

// One number a cell: the mean of its channels.
void make_grey(Grid& grid, std::vector<std::string>& notes) {
  if (grid.channels == 1) return;
  constexpr const char* grey = "the colours of its grids become grey, their means";
  if (std::ranges::find(notes, grey) == notes.end()) notes.push_back(grey);
  const auto channels = static_cast<std::size_t>(grid.channels), cells = grid.values.size() / channels;
  for (std::size_t i = 0; i < cells; ++i) {
    const float* const cell = &grid.values[i * channels];
    grid.values[i] = static_cast<float>(std::accumulate(cell, cell + channels, 0.0) / grid.channels);
  }
  grid.values.resize(cells);
  grid.channels = 1;
}

// Linear sRGB to the nodes of a sigmoid and a scale of twice the greatest component, as in Mitsuba: black has
// S = 0.
void make_spectra(Grid& grid) {
  const ReflectanceFitter fit;
  const std::size_t cells = grid.values.size() / 3;
  std::vector<float> spectra;
  spectra.reserve(cells * 4);
  for (std::size_t i = 0; i < cells; ++i) {
    const auto component = [&](std::size_t c) { return static_cast<double>(grid.values[3 * i + c]); };
    const double scale = 2 * std::max({component(0), component(1), component(2)});
    const double by = scale > 0 ? 1 / scale : 0;
    const SigmoidNodes x = fit({component(0) * by, component(1) * by, component(2) * by});
    spectra.insert(spectra.end(), {x[0], x[1], x[2], static_cast<float>(scale)});
  }
  grid.values = std::move(spectra);
  grid.channels = 4;
}

bool bake_colors(Grid& grid, RgbMethod method, std::vector<std::string>& notes) {
  if (!bake_grid(grid, notes)) return false;
  if (grid.channels == 3 && method == RgbMethod::bands) return true;
  if (grid.channels == 3) {
    if (method == RgbMethod::matrix_r)
      notes.emplace_back("the colours of its grids become spectra by Jakob and Hanika's method");
    make_spectra(grid);
  } else {
    make_grey(grid, notes);
  }
  return true;
}

bool bake_volume(VolumeParameter& volume, RgbMethod method, std::vector<std::string>& notes) {
  if (auto* grid = std::get_if<Grid>(&volume)) return bake_colors(*grid, method, notes);
  Spectrum& spectrum = std::get<Spectrum>(volume);
  spectrum = resolved(spectrum, method);
  return true;
}

bool bake_number(Grid& grid, std::vector<std::string>& notes) {
  if (!bake_grid(grid, notes)) return false;
  make_grey(grid, notes);
  return true;
}

}  // namespace

std::optional<Medium> bake_medium(const Medium& medium, RgbMethod method, std::vector<std::string>& notes) {
  Medium baked = medium;
  baked.name.clear();
  bool whole = true;
  if (const auto* named = std::get_if<NamedMedium>(&baked.coefficients))
    if (const auto measured = measured_medium(named->name)) baked.coefficients = *measured;
  if (auto* k = std::get_if<AbsorptionScattering>(&baked.coefficients))
    whole = bake_volume(k->sigma_a, method, notes) && bake_volume(k->sigma_s, method, notes);
  else if (auto* albedo = std::get_if<ExtinctionAlbedo>(&baked.coefficients))
    whole = bake_volume(albedo->sigma_t, method, notes) && bake_volume(albedo->albedo, method, notes);
  else
    whole = false, notes.push_back("its coefficients are known by name alone, and not here");
  if (auto* grid = std::get_if<Grid>(&baked.density))
    whole = whole && bake_number(*grid, notes);
  else if (std::holds_alternative<CloudDensity>(baked.density))
    whole = false, notes.push_back("a procedural cloud cannot be shown");
  if (!whole) return std::nullopt;
  if (baked.fade) baked.fade->color = resolved(baked.fade->color, method);
  if (baked.temperature) {  // as pbrt's film shows what no light normalises
    baked.emission = ConstantSpectrum{static_cast<float>(cie_y_integral_nm)};
    if (!bake_number(*baked.temperature, notes)) baked.emission.reset();
  }
  if (baked.emission)
    *baked.emission = scaled(resolved(*baked.emission, method), static_cast<double>(baked.emission_factor));
  if (baked.emission_scale && !bake_colors(*baked.emission_scale, method, notes)) baked.emission.reset();
  if (!baked.emission) baked.emission_scale.reset(), baked.temperature.reset();
  baked.emission_factor = 1;
  return baked;
}

}  // namespace vitrail
