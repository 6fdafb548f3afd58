// SPDX-License-Identifier: Apache-2.0
#include "importers/pbrt/read/media.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <filesystem>

#include "images/nanovdb.h"
#include "importers/pbrt/read/measured_name.h"
#include "importers/reading/suggestion.h"
#include "scene/models/measured_media.h"
#include "scene/spectra/color.h"
#include "scene/spectra/rgb_to_spectrum.h"

namespace vitrail::pbrt {

namespace {

struct MediumMaker {
  const std::string& kind;
  ParameterSet& parameters;
  const Scope& scope;

  float number(std::string_view name, double otherwise) const {
    return static_cast<float>(parameters.number(name, otherwise));
  }
  Spectrum coefficient(std::string_view name, const Spectrum& otherwise) const {
    return spectrum_value(parameters, {name}, Quantity::unbounded, otherwise, scope);
  }
  bool has(std::string_view name) const { return parameters.find_grid(name); }
  Point3d point(std::string_view name, Point3d otherwise) const {
    const auto v = parameters.triple(name);
    return v ? Point3d{(*v)[0], (*v)[1], (*v)[2]} : otherwise;
  }
  Bounds3d bounds() const { return {point("p0", {0, 0, 0}), point("p1", {1, 1, 1})}; }
};

AbsorptionScattering coefficients(const MediumMaker& m, const Spectrum& sigma_a, const Spectrum& sigma_s) {
  return {m.coefficient("sigma_a", sigma_a), m.coefficient("sigma_s", sigma_s)};
}

// Colours of the scope's space, in place.
void to_linear_srgb(std::vector<float>& values, const std::string& color_space) {
  if (color_space == "srgb") return;
  for (std::size_t i = 0; i + 2 < values.size(); i += 3) {
    const auto v = [&](std::size_t c) { return static_cast<double>(values[i + c]); };
    const RGB color = to_srgb({v(0), v(1), v(2)}, color_space.c_str());
    values[i] = static_cast<float>(std::max(0.0, color.r));
    values[i + 1] = static_cast<float>(std::max(0.0, color.g));
    values[i + 2] = static_cast<float>(std::max(0.0, color.b));
  }
}

// nx·ny·nz values of `channels` floats under `name`. All grids of pbrt are 0 outside of their cells.
Grid grid(const MediumMaker& m, std::string_view name, int channels) {
  Grid g;
  g.edge = GridEdge::zero;
  g.nx = m.parameters.integer("nx", 1);
  g.ny = m.parameters.integer("ny", 1);
  g.nz = m.parameters.integer("nz", 1);
  g.channels = channels;
  g.bounds = m.bounds();
  Parameter* values = m.parameters.find_grid(name);
  if (!values)
    fail(fmt::format("{} needs a parameter \"{}\"", m.parameters.owner(), name), m.parameters.place());
  const double wanted = static_cast<double>(g.nx) * g.ny * g.nz * channels;
  if (g.nx < 1 || g.ny < 1 || g.nz < 1 || wanted != static_cast<double>(number_count(*values)))
    fail(fmt::format("a grid of {} × {} × {} needs {} values, but \"{}\" has {}", g.nx, g.ny, g.nz, wanted,
                     name, number_count(*values)),
         values->place);
  if (m.scope.context.skim) {  // the list, with some room, and what it becomes
    const std::uint64_t bytes = sizeof(float) * number_count(*values);
    m.scope.context.skim->grid_bytes += bytes;
    m.scope.context.skim->statement_bytes =
        std::max(m.scope.context.skim->statement_bytes, bytes + bytes / 16);
    return g;
  }
  g.values.reserve(number_count(*values));
  consume_numbers(*values, 1, [&](const auto& numbers) {
    for (const auto v : numbers) g.values.push_back(static_cast<float>(v));
  });
  if (channels == 3) to_linear_srgb(g.values, m.scope.color_space);
  return g;
}

// What pbrt-v4 has in the place of a grid that is not given: one cell, so that what shines fades from the
// middle of the bounds on.
Grid one_cell(const MediumMaker& m, float value) {
  Grid g;
  g.nx = g.ny = g.nz = 1;
  g.values = {value};
  g.bounds = m.bounds();
  g.edge = GridEdge::zero;
  return g;
}

void read_emission_of(const MediumMaker& m, Medium& medium) {
  if (const Parameter* le = m.parameters.find_spectrum("Le"))
    medium.emission = read_emission(*le, 1, m.scope);
}

// Temperatures and what goes with them.
void read_temperature(const MediumMaker& m, Medium& medium) {
  medium.temperature_scale = m.number("temperaturescale", 1);
  medium.temperature_offset = m.number("temperatureoffset", m.parameters.number("temperaturecutoff", 0));
}

// v3's defaults are those of skim milk, per mm; v4's are 1.
void homogeneous(const MediumMaker& m, Medium& medium) {
  const Spectrum skim_milk_a = unbounded_from_rgb({0.0011, 0.0024, 0.014}),
                 skim_milk_s = unbounded_from_rgb({2.55, 3.21, 3.77}), one = ConstantSpectrum{1};
  const std::string preset = m.parameters.text("preset", "");
  if (!preset.empty() && is_measured(preset, m.parameters, m.scope))
    medium.coefficients = NamedMedium{preset};
  else
    medium.coefficients = m.scope.context.version == Version::v3 ? coefficients(m, skim_milk_a, skim_milk_s)
                                                                 : coefficients(m, one, one);
  read_emission_of(m, medium);
  medium.emission_factor = m.number("Lescale", 1);
}

void uniform_grid(const MediumMaker& m, Medium& medium) {
  medium.coefficients = coefficients(m, ConstantSpectrum{1}, ConstantSpectrum{1});
  medium.density = grid(m, "density", 1);
  read_emission_of(m, medium);
  if (m.has("temperature")) medium.temperature = grid(m, "temperature", 1);
  if (const Parameter* scale = m.parameters.find_numbers("Lescale"); scale && scale->numbers.size() > 1)
    medium.emission_scale = grid(m, "Lescale", 1);
  else if (medium.emission || medium.temperature)
    medium.emission_scale = one_cell(m, m.number("Lescale", 1));
  else
    medium.emission_factor = m.number("Lescale", 1);
  read_temperature(m, medium);
}

void rgb_grid(const MediumMaker& m, Medium& medium) {
  AbsorptionScattering c;
  if (m.has("sigma_a")) c.sigma_a = grid(m, "sigma_a", 3);
  if (m.has("sigma_s")) c.sigma_s = grid(m, "sigma_s", 3);
  medium.coefficients = c;
  if (m.has("Le")) {
    medium.emission = emission_from_rgb(white_of_rgb_grids);
    medium.emission_scale = grid(m, "Le", 3);
  }
  medium.emission_factor = m.number("Lescale", 1);
}

void cloud(const MediumMaker& m, Medium& medium) {
  medium.coefficients = coefficients(m, ConstantSpectrum{1}, ConstantSpectrum{1});
  medium.density =
      CloudDensity{m.bounds(), m.number("density", 1), m.number("wispiness", 1), m.number("frequency", 5)};
}

// Both grids have one frame: the density's.
void nanovdb_grids(const std::string& path, const Parameter& file, const MediumMaker& m, Medium& medium) {
  try {
    const auto density = read_nanovdb_header(path, "density"),
               heat = read_nanovdb_header(path, "temperature");
    if (!density) fail(fmt::format("\"{}\" has no grid \"density\"", path), file.place);
    medium.density = density->grid;
    medium.medium_to_world = medium.medium_to_world * density->frame;
    if (heat && heat->frame == density->frame)
      medium.temperature = heat->grid;
    else if (heat)
      m.scope.context.report.dropped("a temperature that is turned against its density", file.place);
  } catch (const Error& error) {
    if (error.location.line > 0) throw;
    fail(fmt::format("\"{}\": {}", path, error.what()), file.place);
  }
}

void nanovdb(const MediumMaker& m, Medium& medium) {
  medium.coefficients = coefficients(m, ConstantSpectrum{1}, ConstantSpectrum{1});
  const Parameter* file = m.parameters.find("filename", {ParameterType::text});
  if (!file || file->strings.size() != 1)
    fail("a nanovdb medium needs a \"string filename\"", m.parameters.place());
  const std::string path = find_file(*file, m.scope.context);
  std::error_code ignored;
  if (!std::filesystem::exists(path, ignored)) {  // said where all files that are not there are
    Grid density;
    density.filename = path;
    density.field = "density";
    medium.density = density;
  } else {
    nanovdb_grids(path, *file, m, medium);
  }
  medium.emission_factor = m.number("Lescale", 1);
  read_temperature(m, medium);
}

struct MediumKind {
  std::string_view name;
  void (*read)(const MediumMaker&, Medium&);
};
constexpr std::array<MediumKind, 6> medium_kinds{{{"homogeneous", homogeneous},
                                                  {"uniformgrid", uniform_grid},
                                                  {"heterogeneous", uniform_grid},
                                                  {"rgbgrid", rgb_grid},
                                                  {"cloud", cloud},
                                                  {"nanovdb", nanovdb}}};

}  // namespace

bool is_measured(const std::string& name, const ParameterSet& parameters, const Scope& scope) {
  if (measured_medium(name)) return true;
  scope.context.report.approximated(
      fmt::format("no measured medium is known by the name \"{}\": the default stands for it{}", name,
                  suggestion(name, measured_media())),
      parameters.place());
  return false;
}

Medium make_medium(const std::string& kind, const std::string& name, ParameterSet& parameters,
                   const Transform& ctm, const Scope& scope) {
  const MediumMaker maker{kind, parameters, scope};
  Medium medium;
  medium.name = name;
  medium.origin = scope.origin;
  medium.medium_to_world = ctm;
  medium.scale = maker.number("scale", 1);
  medium.g = maker.number("g", 0);
  parameters.ignore({"type"});
  std::vector<std::string> names;
  for (const MediumKind& known : medium_kinds) {
    names.emplace_back(known.name);
    if (kind != known.name) continue;
    known.read(maker, medium);
    parameters.report_unused(scope.context.report);
    return medium;
  }
  fail(fmt::format("medium \"{}\" is of the unknown kind \"{}\"{}", name, kind, suggestion(kind, names)),
       parameters.place());
}

}  // namespace vitrail::pbrt
