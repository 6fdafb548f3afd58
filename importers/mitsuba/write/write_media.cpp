// SPDX-License-Identifier: Apache-2.0
#include "importers/mitsuba/write/write_media.h"

#include <algorithm>
#include <cmath>

#include "importers/mitsuba/write/rgb_variants.h"
#include "importers/mitsuba/write/volume_files.h"
#include "importers/writing/medium_grids.h"
#include "scene/models/measured_media.h"
#include "scene/models/subsurface_media.h"

namespace vitrail::mitsuba_writer {

namespace {

// Mitsuba's grids fill the unit cube of their own space.
Transform grid_to_world(const Transform& medium_to_world, const Bounds3d& box) {
  if (box == Bounds3d{{0, 0, 0}, {1, 1, 1}}) return medium_to_world;
  return medium_to_world * translate({box.lower.x, box.lower.y, box.lower.z}) * scale(box.upper - box.lower);
}

// Held at its edges, a grid that is 0 outside is as it was with cells of 0 around it, within its own bounds.
Grid with_zeros_around(const Grid& grid) {
  Grid wide = with_cells_around(grid, true);
  wide.edge = GridEdge::held;
  return wide;
}

// False where the grid's file is not there.
bool add_grid(Context& context, Element parent, const std::string& name, const Grid& given,
              const Transform& medium_to_world) {
  if (!given.filename.empty() && given.nx == 0) return false;
  Grid grid = given.field.empty() ? given : with_values(given);
  if (grid.edge == GridEdge::zero && grid.filename.empty()) grid = with_zeros_around(grid);
  std::string filename = grid.filename.empty() ? "" : context.relative(grid.filename);
  if (filename.empty()) {
    filename = context.new_file("volumes", "vol", context.derived_volumes);
    write_volume_file(context.file.parent_path() / filename, grid);
  }
  Element element = add(parent, "volume", "gridvolume", name);
  add_string(element, "filename", filename);
  add_string(element, "filter_type", "trilinear");
  add_string(element, "wrap_mode", grid.edge == GridEdge::repeated ? "repeat" : "clamp");
  add_boolean(element, "raw", false);
  add_transform(element, grid_to_world(medium_to_world, grid.bounds));
  return true;
}

void add_volume(Context& context, Element parent, const std::string& name, const VolumeParameter& value,
                const Transform& medium_to_world) {
  if (const auto* spectrum = std::get_if<Spectrum>(&value))
    return add_spectrum(parent, name, *spectrum, Meaning::unbounded);
  if (!add_grid(context, parent, name, std::get<Grid>(value), medium_to_world)) {
    context.dropped("a grid whose file is not there: a constant 1 stands for it");
    add_spectrum(parent, name, ConstantSpectrum{1}, Meaning::unbounded);
  }
}

// a(λ) op b(λ), a constant where both are.
template <class F>
Spectrum combined(const Spectrum& a, const Spectrum& b, F&& f) {
  if (is_constant(a) && is_constant(b))
    return ConstantSpectrum{static_cast<float>(f(evaluate(a, 550), evaluate(b, 550)))};
  const Spectrum x = resolved(a), y = resolved(b);
  return tabulated([&](double lambda) { return f(evaluate(x, lambda), evaluate(y, lambda)); });
}

Spectrum spectrum_of(Context& context, const VolumeParameter& value, const char* what) {
  if (const auto* spectrum = std::get_if<Spectrum>(&value)) return *spectrum;
  const Grid& grid = std::get<Grid>(value);
  double sum = 0;
  for (const float v : grid.values) sum += static_cast<double>(v);
  context.approximated(fmt::format("a grid of {} is replaced by its mean", what));
  return ConstantSpectrum{
      grid.values.empty() ? 1.0f : static_cast<float>(sum / static_cast<double>(grid.values.size()))};
}

// Cell by cell. Of the albedo, nothing is known where there is nothing: at the edges it goes on.
std::optional<ExtinctionAlbedo> extinction_and_albedo_grids(Context& context, const AbsorptionScattering& m) {
  try {
    Grid sigma_t = combined_cells(m.sigma_a, m.sigma_s, [](double a, double s) { return a + s; });
    Grid albedo =
        combined_cells(m.sigma_a, m.sigma_s, [](double a, double s) { return a + s > 0 ? s / (a + s) : 0; });
    albedo.edge = GridEdge::held;
    context.approximated(
        "grids of absorption and scattering become those of extinction and albedo, which Mitsuba takes as "
        "linear "
        "between cells");
    if (becomes_color(m.sigma_a) || becomes_color(m.sigma_s))
      context.approximated("a coefficient beside a grid becomes its colour");
    return ExtinctionAlbedo{std::move(sigma_t), std::move(albedo)};
  } catch (const Error&) {
    return std::nullopt;
  }
}

ExtinctionAlbedo extinction_and_albedo(Context& context, const Medium& medium) {
  const auto of_sum = [&](const AbsorptionScattering& m) {
    if (std::holds_alternative<Grid>(m.sigma_a) || std::holds_alternative<Grid>(m.sigma_s))
      if (const auto grids = extinction_and_albedo_grids(context, m)) return *grids;
    const Spectrum a = spectrum_of(context, m.sigma_a, "absorption"),
                   s = spectrum_of(context, m.sigma_s, "scattering");
    return ExtinctionAlbedo{combined(a, s, [](double x, double y) { return x + y; }),
                            combined(a, s, [](double x, double y) { return x + y > 0 ? y / (x + y) : 0; })};
  };
  return std::visit(Overloaded{
                        [](const ExtinctionAlbedo& m) { return m; },
                        of_sum,
                        [&](const NamedMedium& m) {
                          if (const auto measured = measured_medium(m.name)) return of_sum(*measured);
                          context.dropped(fmt::format(
                              "Mitsuba has no medium \"{}\": its default, σt 1 and albedo 0.75", m.name));
                          return ExtinctionAlbedo{};
                        },
                    },
                    medium.coefficients);
}

void add_phase(Element parent, float g) {
  if (g == 0) return void(add(parent, "phase", "isotropic"));
  add_float(add(parent, "phase", "hg"), "g", g);
}

void report_rest(Context& context, const Medium& medium) {
  if (medium.emission || medium.temperature)
    context.dropped("the emission of a medium: Mitsuba's media do not shine");
  if (std::holds_alternative<CloudDensity>(medium.density))
    context.dropped("Mitsuba has no procedural cloud: the medium is homogeneous");
}

// Of a colour a grid of three channels is made, of their product; of a number it goes to the scale.
struct DensityGrid {
  Grid grid;
  double factor = 1;
};
DensityGrid density_grid(Context& context, const Grid& density, const VolumeParameter& sigma_t) {
  const auto* spectrum = std::get_if<Spectrum>(&sigma_t);
  if (spectrum && !is_constant(*spectrum)) try {
      Grid product = combined_cells(density, sigma_t, [](double d, double t) { return d * t; });
      context.approximated(becomes_color(sigma_t)
                               ? "the extinction beside a density becomes its colour"
                               : "a density and the colour of its extinction become one grid of colours");
      return {std::move(product)};
    } catch (const Error&) {  // a file that is not there
    }
  const Spectrum one = spectrum_of(context, sigma_t, "extinction");
  return {density, number_of(context, one, "the extinction of a medium with a density")};
}

bool write_density(Context& context, Element root, const Medium& medium, const ExtinctionAlbedo& coefficients,
                   const std::string& id) {
  const auto* density = std::get_if<Grid>(&medium.density);
  if (!density) return false;
  Element element = add(root, "medium", "heterogeneous", "", id);
  const DensityGrid sigma_t = density_grid(context, *density, coefficients.sigma_t);
  if (!add_grid(context, element, "sigma_t", sigma_t.grid, medium.medium_to_world)) {
    root.remove_child(element);
    context.dropped("a density whose file is not there: the medium is homogeneous");
    return false;
  }
  context.colored_extinction |= sigma_t.grid.channels > 1;
  add_volume(context, element, "albedo", coefficients.albedo, medium.medium_to_world);
  add_float(element, "scale", static_cast<float>(sigma_t.factor * static_cast<double>(medium.scale)));
  add_phase(element, medium.g);
  return true;
}

// Mitsuba's rgb variants cut coefficients that are no plain numbers, and the components of their colours, at
// 1 (3.9.1: a σt of 3 is 1); its scales are free: what is above 1 goes there.
double greatest_above_one(const VolumeParameter& sigma_t) {
  const auto* spectrum = std::get_if<Spectrum>(&sigma_t);
  if (!spectrum || is_constant(*spectrum)) return 1;
  const Spectrum values = resolved(*spectrum);
  const RGB color = color_of(values);
  double greatest = std::max({1.0, color.r, color.g, color.b});
  for (int i = 0; i < table_size; ++i) greatest = std::max(greatest, evaluate(values, lambda_min_nm + i));
  return greatest;
}

bool is_colored(const VolumeParameter& value) {
  if (const auto* grid = std::get_if<Grid>(&value)) return grid->channels > 1;
  return !is_constant(std::get<Spectrum>(value));
}

bool is_black(const VolumeParameter& value) {
  const auto* spectrum = std::get_if<Spectrum>(&value);
  if (!spectrum) return false;
  const RGB color = color_of(*spectrum);
  return color.r == 0 && color.g == 0 && color.b == 0;
}

// What rgb variants make of the extinction's spectrum.
void report_colour(Context& context, const Medium& medium, const ExtinctionAlbedo& of, double greatest) {
  const auto* spectrum = std::get_if<Spectrum>(&of.sigma_t);
  if (!spectrum || is_constant(*spectrum)) return;
  const RGB color = color_of(*spectrum);
  const double least = std::min({color.r, color.g, color.b});
  if (!(least > 0) && color.r + color.g + color.b > 0 && !is_black(of.albedo))
    context.approximated(
        "the colour of an extinction is outside of sRGB: in Mitsuba's rgb variants its medium does not "
        "scatter");
  const bool is_theirs = is_mitsuba_file(context.scene, medium.origin);
  if (const double tenth = tenth_in_rgb_variants(*spectrum); !is_theirs && std::abs(tenth - 0.1) > 0.005)
    context.approximated(
        fmt::format("Mitsuba's rgb variants weaken light by three numbers: white light that comes to a tenth "
                    "comes to {:.3g} "
                    "there",
                    tenth));
  if (greatest > 1 && is_theirs)
    context.approximated(fmt::format(
        "an extinction up to {:.3g}: Mitsuba's rgb variants cut that of the input at 1; the scale of what is "
        "written keeps it",
        greatest));
}

// Mitsuba 3.9's spectral variants make no numbers of an extinction that is 0 at some wavelengths alone: there
// it is next to nothing.
VolumeParameter nowhere_zero(const VolumeParameter& sigma_t) {
  const auto* spectrum = std::get_if<Spectrum>(&sigma_t);
  if (!spectrum || is_constant(*spectrum)) return sigma_t;
  const Spectrum values = resolved(*spectrum);
  double least = HUGE_VAL, greatest = 0;
  for (int i = 0; i < table_size; ++i) {
    const double value = evaluate(values, lambda_min_nm + i);
    least = std::min(least, value), greatest = std::max(greatest, value);
  }
  if (least > 0 || !(greatest > 0)) return sigma_t;
  return tabulated([&](double lambda) { return std::max(evaluate(values, lambda), 1e-9 * greatest); });
}

void write_medium(Context& context, Element root, const Medium& medium, const std::string& id) {
  report_rest(context, medium);
  const ExtinctionAlbedo coefficients = extinction_and_albedo(context, medium);
  if (write_density(context, root, medium, coefficients, id)) return;
  const bool varies =
      std::holds_alternative<Grid>(coefficients.sigma_t) || std::holds_alternative<Grid>(coefficients.albedo);
  Element element = add(root, "medium", varies ? "heterogeneous" : "homogeneous", "", id);
  context.colored_extinction |= is_colored(coefficients.sigma_t);
  const double greatest = greatest_above_one(coefficients.sigma_t);
  VolumeParameter sigma_t = coefficients.sigma_t;
  report_colour(context, medium, coefficients, greatest);
  if (greatest > 1) sigma_t = scaled(std::get<Spectrum>(sigma_t), 1 / greatest);
  add_volume(context, element, "sigma_t", nowhere_zero(sigma_t), medium.medium_to_world);
  add_volume(context, element, "albedo", coefficients.albedo, medium.medium_to_world);
  add_float(element, "scale", static_cast<float>(greatest * static_cast<double>(medium.scale)));
  add_phase(element, medium.g);
}

std::optional<Medium> interior_medium(Context& context, SubsurfaceMaterial material) {
  const auto constant = [&](SpectrumParameter& p, const char* what) { p = constant_of(context, p, what); };
  if (auto* m = std::get_if<SubsurfaceMaterial::Coefficients>(&material.interior)) {
    constant(m->sigma_a, "the absorption of a medium"), constant(m->sigma_s, "the scattering of a medium");
  } else if (auto* e = std::get_if<SubsurfaceMaterial::Effective>(&material.interior)) {
    constant(e->reflectance, "the albedo of a medium");
    constant(e->mean_free_path, "the extinction of a medium");
  }
  std::optional<Medium> medium = interior_of(material);
  if (!medium)
    context.dropped(fmt::format("Mitsuba has no medium \"{}\": the inside is empty",
                                std::get<SubsurfaceMaterial::Named>(material.interior).name));
  return medium;
}

}  // namespace

void write_media(Context& context, Element root) {
  for (std::size_t i = 0; i < context.scene.media.size(); ++i) {
    const Medium& medium = context.scene.media[i];
    context.begin(RecordKind::medium, medium.origin);
    context.medium_ids.push_back(context.new_id(medium.name, "medium", i));
    write_medium(context, root, medium, context.medium_ids.back());
  }
  for (std::size_t i = 0; i < context.scene.materials.size(); ++i) {
    const Material& material = context.scene.materials[i];
    context.begin(RecordKind::material, material.origin);
    if (const auto* subsurface = std::get_if<SubsurfaceMaterial>(&material.model))
      if (const auto medium = interior_medium(context, *subsurface)) {
        const std::string id = context.new_id("", "interior", i);
        context.interiors.emplace(i, id);
        write_medium(context, root, *medium, id);
      }
  }
}

std::string interior_of(const Context& context, Id<Material> material) {
  const auto found = context.interiors.find(material.value);
  return found == context.interiors.end() ? "" : found->second;
}

}  // namespace vitrail::mitsuba_writer
