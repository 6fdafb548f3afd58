// SPDX-License-Identifier: Apache-2.0
// Media stand between Camera and WorldBegin: the camera's has to be known when the world begins.
#include <algorithm>
#include <array>
#include <numeric>

#include "images/nanovdb.h"
#include "importers/pbrt/read/media.h"
#include "importers/pbrt/write/writer.h"
#include "importers/writing/export_colors.h"
#include "importers/writing/medium_grids.h"

namespace vitrail::pbrt {

namespace {

// pbrt's are 0 outside: what goes on at its edges has a layer of cells more, so that it is as it was within.
void grid(Parameters& p, std::string_view type_and_name, const Grid& given, bool sizes) {
  Grid g = given.edge == GridEdge::held ? with_cells_around(given, false) : given;
  for (float& value : g.values) value = std::max(value, 0.0f);  // what is below, pbrt makes anything of
  if (g.edge == GridEdge::held)
    p.approximated("its grids go on at their edges: pbrt's have one more layer of cells, and end behind it");
  if (g.edge == GridEdge::repeated)
    p.approximated("its grids fade over half a cell at their edges, as pbrt's do, and do not repeat");
  if (sizes) {
    p.integer("nx", g.nx).integer("ny", g.ny).integer("nz", g.nz);
    p.numbers("point3 p0", std::array{g.bounds.lower.x, g.bounds.lower.y, g.bounds.lower.z});
    p.numbers("point3 p1", std::array{g.bounds.upper.x, g.bounds.upper.y, g.bounds.upper.z});
  }
  p.numbers(type_and_name, g.values);
}

// A coefficient that has to be one value.
void coefficient(Parameters& p, std::string_view name, const VolumeParameter& value, float scale) {
  if (const auto* spectrum = std::get_if<Spectrum>(&value)) {
    p.spectrum(name, scaled(*spectrum, static_cast<double>(scale)));
    return;
  }
  p.approximated(fmt::format("the grid of its {} becomes 1", name));
  p.spectrum(name, Spectrum{ConstantSpectrum{scale}});
}

// Times `scale`.
void coefficients(Parameters& p, const Medium& m, float scale = 1) {
  if (const auto* named = std::get_if<NamedMedium>(&m.coefficients)) {
    p.text("preset", named->name);
  } else if (const auto* both = std::get_if<AbsorptionScattering>(&m.coefficients)) {
    coefficient(p, "sigma_a", both->sigma_a, scale);
    coefficient(p, "sigma_s", both->sigma_s, scale);
  } else {  // σₛ = σₜ·albedo, σₐ = σₜ·(1 − albedo)
    const auto& e = std::get<ExtinctionAlbedo>(m.coefficients);
    const auto *t = std::get_if<Spectrum>(&e.sigma_t), *albedo = std::get_if<Spectrum>(&e.albedo);
    const Spectrum one = ConstantSpectrum{1}, sigma_t = scaled(t ? *t : one, static_cast<double>(scale)),
                   a = albedo ? *albedo : one;
    p.approximated("extinction and albedo become absorption and scattering");
    p.spectrum("sigma_s", product(sigma_t, a))
        .spectrum("sigma_a", product(sigma_t, weighted_sum(one, 1, a, -1)));
  }
}

// Times `factor`, where it is a colour.
void emission(Parameters& p, const Medium& m, float factor = 1) {
  if (!m.emission) return;
  if (const auto* color = std::get_if<RgbIlluminantSpectrum>(&*m.emission)) {
    const auto& c = color->rgb;
    p.numbers("rgb Le", std::array{c[0] * factor, c[1] * factor, c[2] * factor});
  } else {
    p.approximated("its emission is normalised to luminance 1, as pbrt does");
    p.spectrum("Le", *m.emission);
  }
}

// Only homogeneous media have presets.
void no_preset(Parameters& p, const Medium& m) {
  if (const auto* named = std::get_if<NamedMedium>(&m.coefficients))
    p.dropped(fmt::format(
        "\"{}\": pbrt has presets of homogeneous media alone; absorption and scattering are 1", named->name));
}
void varying_coefficients(Parameters& p, const Medium& m, float scale = 1) {
  no_preset(p, m);
  if (!std::holds_alternative<NamedMedium>(m.coefficients)) coefficients(p, m, scale);
}

// A coefficient as three values a cell of `cells`: of a grid of one or three channels, or everywhere the
// same.
Grid in_each_cell(Parameters& p, const VolumeParameter& value, const Grid& cells) {
  Grid colors = cells;
  colors.channels = 3;
  colors.values.clear();
  const auto count = static_cast<std::size_t>(cells.nx) * static_cast<std::size_t>(cells.ny) *
                     static_cast<std::size_t>(cells.nz);
  const auto* given = std::get_if<Grid>(&value);
  const bool fits = given && given->values.size() == count * static_cast<std::size_t>(given->channels);
  if (given && !fits) p.approximated("a grid of another size than the other becomes 1");
  const auto* spectrum = std::get_if<Spectrum>(&value);
  if (spectrum && !is_rgb(*spectrum)) p.approximated("a coefficient beside a grid becomes its colour");
  const RGB everywhere = spectrum ? factor_rgb(*spectrum) : RGB{1, 1, 1};
  for (std::size_t i = 0; i < count; ++i)
    for (std::size_t c = 0; c < 3; ++c)
      colors.values.push_back(
          fits
              ? given
                    ->values[given->channels == 3 ? 3 * i + c : i * static_cast<std::size_t>(given->channels)]
              : static_cast<float>(c == 0   ? everywhere.r
                                   : c == 1 ? everywhere.g
                                            : everywhere.b));
  return colors;
}

// What shines in each cell, as rgbgrid takes it.
Grid glow_in_each_cell(Parameters& p, const Medium& m, const Grid& cells) {
  Grid glow = in_each_cell(p, *m.emission_scale, cells);
  if (!is_rgb(*m.emission)) p.approximated("its emission beside a grid becomes its colour");
  const RGB of_one = emission_rgb(*m.emission);
  const std::array factors{of_one.r / white_of_rgb_grids.r, of_one.g / white_of_rgb_grids.g,
                           of_one.b / white_of_rgb_grids.b};
  for (std::size_t i = 0; i < glow.values.size(); ++i) glow.values[i] *= static_cast<float>(factors[i % 3]);
  return glow;
}

// pbrt counts a grid that is not given as 1.
bool is_one(const VolumeParameter& value) {
  const auto* spectrum = std::get_if<Spectrum>(&value);
  return spectrum && is_constant(*spectrum) && evaluate(*spectrum, lambda_min_nm) == 1;
}

const char* rgb_grid(Parameters& p, const Medium& m, const AbsorptionScattering& both) {
  p.number("scale", m.scale);
  const auto* cells = std::get_if<Grid>(&both.sigma_a);
  const bool absorbs = cells || !is_one(both.sigma_a) || m.emission_scale;  // needed where it shines
  if (!cells) cells = &std::get<Grid>(both.sigma_s);
  if (absorbs) grid(p, "rgb sigma_a", in_each_cell(p, both.sigma_a, *cells), true);
  if (!is_one(both.sigma_s)) grid(p, "rgb sigma_s", in_each_cell(p, both.sigma_s, *cells), !absorbs);
  if (m.emission && m.emission_scale) grid(p, "rgb Le", glow_in_each_cell(p, m, *cells), false);
  if (m.emission_factor != 1) p.number("Lescale", m.emission_factor);
  return "rgbgrid";
}

// σₛ = σₜ·albedo and σₐ = σₜ·(1 − albedo) in each cell, where one of the two is a grid.
std::optional<AbsorptionScattering> absorption_and_scattering_grids(Parameters& p, const Medium& m) {
  const auto* e = std::get_if<ExtinctionAlbedo>(&m.coefficients);
  if (!e) return std::nullopt;
  const bool is_t = std::holds_alternative<Grid>(e->sigma_t),
             is_albedo = std::holds_alternative<Grid>(e->albedo);
  if (!is_t && !is_albedo) return std::nullopt;
  try {
    AbsorptionScattering both;
    both.sigma_a = combined_cells(e->sigma_t, e->albedo, [](double t, double a) { return t * (1 - a); });
    both.sigma_s = combined_cells(e->sigma_t, e->albedo, [](double t, double a) { return t * a; });
    if (is_t && is_albedo)
      p.approximated(
          "grids of extinction and albedo become those of absorption and scattering, cell by cell");
    if (becomes_color(e->sigma_t) || becomes_color(e->albedo))
      p.approximated("a coefficient beside a grid becomes its colour");
    return both;
  } catch (const Error& error) {
    p.approximated(fmt::format("the grids of its extinction and albedo become 1: {}", error.what()));
    return std::nullopt;
  }
}

const char* cloud(Parameters& p, const Medium& m, const CloudDensity& c) {
  varying_coefficients(p, m, m.scale);
  if (m.emission) p.dropped("its emission: pbrt's clouds do not shine");
  const Bounds3d& b = c.bounds;
  p.numbers("point3 p0", std::array{b.lower.x, b.lower.y, b.lower.z});
  p.numbers("point3 p1", std::array{b.upper.x, b.upper.y, b.upper.z});
  p.number("density", c.density).number("wispiness", c.wispiness).number("frequency", c.frequency);
  return "cloud";
}

const char* nanovdb(Parameters& p, const Medium& m, const Grid& density) {
  p.number("scale", m.scale);
  varying_coefficients(p, m);
  if (m.emission) p.dropped("its emission: pbrt's NanoVDB media shine by their temperature alone");
  if (m.emission_factor != 1) p.number("Lescale", m.emission_factor);
  if (density.field.empty()) p.approximated("its file is read as NanoVDB");
  p.file("filename", density.filename);
  return "nanovdb";
}

// What pbrt takes where no factors of emission are given, but for its value.
bool is_one_cell(const Grid& grid) { return grid.values.size() == 1 && grid.edge == GridEdge::zero; }

bool is_default_scale(const Medium& m) {
  return m.emission_scale && is_one_cell(*m.emission_scale) &&
         m.emission_scale->values[0] * m.emission_factor == 1;
}

// Emission has a factor in each cell.
void emission_grid(Parameters& p, const Medium& m, const Grid& cells) {
  if (!m.emission_scale && !m.emission) return;
  Grid factors = m.emission_scale ? *m.emission_scale : cells;
  if (factors.values.size() != cells.values.size()) {
    p.approximated("the grid of its emission, of another size than its density's, becomes its mean");
    const float mean = std::accumulate(factors.values.begin(), factors.values.end(), 0.0f) /
                       static_cast<float>(factors.values.size());
    factors = cells;
    std::ranges::fill(factors.values, mean);
  }
  if (!m.emission_scale) std::ranges::fill(factors.values, 1.0f);
  for (float& factor : factors.values) factor *= m.emission_factor;
  grid(p, "float Lescale", factors, false);
}

const char* uniform_grid(Parameters& p, const Medium& m, const Grid& density) {
  p.number("scale", m.scale);
  varying_coefficients(p, m);
  grid(p, "float density", density, true);
  if (m.temperature) {
    grid(p, "float temperature", *m.temperature, false);
    if (m.emission) p.dropped("its emission: pbrt takes none beside a temperature");
    if (!is_default_scale(m)) emission_grid(p, m, density);
  } else if (m.emission_scale && is_one_cell(*m.emission_scale) && density.values.size() > 1) {
    emission(p, m, m.emission_scale->values[0] * m.emission_factor);
  } else {
    emission(p, m);
    emission_grid(p, m, density);
  }
  return "uniformgrid";
}

// The parameters of a medium; gives its type.
const char* medium_type(Parameters& p, const Medium& m) {
  p.number("g", m.g);
  const auto* both = std::get_if<AbsorptionScattering>(&m.coefficients);
  if (both && (std::holds_alternative<Grid>(both->sigma_a) || std::holds_alternative<Grid>(both->sigma_s)))
    return rgb_grid(p, m, *both);
  if (const auto grids = absorption_and_scattering_grids(p, m)) return rgb_grid(p, m, *grids);
  if (const auto* procedural = std::get_if<CloudDensity>(&m.density)) return cloud(p, m, *procedural);
  if (const auto* density = std::get_if<Grid>(&m.density)) {
    if (m.temperature_scale != 1) p.number("temperaturescale", m.temperature_scale);
    if (m.temperature_offset != 0) p.number("temperatureoffset", m.temperature_offset);
    return density->values.empty() ? nanovdb(p, m, *density) : uniform_grid(p, m, *density);
  }
  p.number("scale", m.scale);
  coefficients(p, m);
  emission(p, m);
  if (m.emission_factor != 1) p.number("Lescale", m.emission_factor);
  return "homogeneous";
}

// pbrt places NanoVDB's file, which places its grid.
Transform file_to_world(const Medium& medium) {
  const auto* density = std::get_if<Grid>(&medium.density);
  if (!density || density->field.empty() || density->nx == 0) return medium.medium_to_world;
  const auto grid = read_nanovdb_header(density->filename, density->field);
  return grid ? medium.medium_to_world * inverse(grid->frame) : medium.medium_to_world;
}

}  // namespace

void write_media(Writer& w) {
  for (std::size_t i = 0; i < w.scene.media.size(); ++i) {
    const Medium& medium = w.scene.media[i];
    Parameters p(w, fmt::format("medium \"{}\"", w.media[i]), medium.origin, RecordKind::medium);
    const char* type = medium_type(p, medium);
    const Transform to_world = file_to_world(medium);
    w.transform(to_world);
    w.line(fmt::format("MakeNamedMedium {} \"string type\" \"{}\"{}", in_quotes(w.media[i]), type, p.list()));
    if (to_world != Transform{}) w.line("Identity");
  }
}

}  // namespace vitrail::pbrt
