// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <optional>

#include "importers/mitsuba/read/builder.h"
#include "importers/mitsuba/read/properties.h"
#include "importers/mitsuba/read/subsurface.h"
#include "importers/mitsuba/read/values.h"
#include "importers/mitsuba/read/volume_file.h"
#include "importers/reading/suggestion.h"

namespace vitrail::mitsuba {

namespace {

const Bounds3d unit_cube{{0, 0, 0}, {1, 1, 1}};

// The grids of a medium share its frame, which is that of the first of them.
struct MediumReader {
  Builder& builder;
  const Object& object;
  Medium& medium;
  bool has_frame = false;
};

Bounds3d transformed(const Transform& t, const Bounds3d& box) {
  const Point3d a = transform_point(t, box.lower), b = transform_point(t, box.upper);
  return {{std::min(a.x, b.x), std::min(a.y, b.y), std::min(a.z, b.z)},
          {std::max(a.x, b.x), std::max(a.y, b.y), std::max(a.z, b.z)}};
}

// Whether the transform only moves and stretches along the axes.
bool keeps_axes(const Transform& t) {
  constexpr double tolerance = 1e-9;
  double largest = 0, crossed = 0;
  for (std::size_t i = 0; i < 3; ++i)
    for (std::size_t j = 0; j < 3; ++j) {
      if (i == j && !(t.m[i][j] > 0)) return false;
      (i == j ? largest : crossed) = std::max(i == j ? largest : crossed, std::abs(t.m[i][j]));
    }
  return crossed <= tolerance * largest;
}

void place_grid(MediumReader& reader, Grid& grid, const Transform& to_world, const Origin& place) {
  Transform& frame = reader.medium.medium_to_world;
  if (!reader.has_frame) {
    frame = to_world;
    reader.has_frame = true;
  } else if (frame != to_world) {
    const Transform relative = inverse(frame) * to_world;
    if (keeps_axes(relative))
      grid.bounds = transformed(relative, grid.bounds);
    else
      reader.builder.report.approximated(
          "a medium whose grids are turned against each other: all lie as the first", place);
  }
}

void read_lookup(const Object& volume, Grid& grid, Report& report) {
  const std::string wrap = volume.text("wrap_mode", "clamp", report),
                    filter = volume.text("filter_type", "trilinear", report);
  grid.edge = wrap == "repeat" ? GridEdge::repeated : GridEdge::held;
  if (wrap != "repeat" && wrap != "clamp")
    report.approximated(fmt::format("the wrap_mode \"{}\" of a grid becomes \"clamp\"", wrap),
                        place_of(volume, "wrap_mode"));
  if (filter != "trilinear")
    report.approximated(fmt::format("the filter_type \"{}\" of a grid becomes \"trilinear\"", filter),
                        place_of(volume, "filter_type"));
}

// Mitsuba's grids fill the unit cube of their own space, or the box of their file.
Grid read_grid(MediumReader& reader, const Object& volume) {
  Report& report = reader.builder.report;
  const std::string file = existing_file(reader.builder, volume, "filename");
  Grid grid;
  std::error_code ignored;
  const bool is_there = std::filesystem::is_regular_file(file, ignored);
  grid.filename = file;  // replace_missing_images speaks of one that is not there
  try {
    if (is_there) grid = read_volume_header(file);
  } catch (const std::runtime_error& error) {
    report.fail(error.what(), place_of(volume, "filename"));
  }
  if (!volume.boolean("use_grid_bbox", false, report)) grid.bounds = unit_cube;
  const Transform to_world = volume.transform("to_world", report);
  if (!is_invertible(to_world))
    report.fail("the to_world of a grid has no inverse", place_of(volume, "to_world"));
  place_grid(reader, grid, to_world, volume.origin);
  read_lookup(volume, grid, report);
  volume.ignore({"raw", "accel"});
  report_unused(volume, report, {"filename", "to_world", "use_grid_bbox", "wrap_mode", "filter_type"});
  return grid;
}

VolumeParameter read_volume(MediumReader& reader, std::string_view name, Quantity quantity,
                            const Spectrum& otherwise) {
  Builder& builder = reader.builder;
  const Object* volume = object_of(reader.object, name);
  if (!volume || volume->tag != "volume")
    return spectrum_value(builder, reader.object, name, quantity, otherwise);
  if (volume->type == "gridvolume") return read_grid(reader, *volume);
  if (volume->type != "constvolume") {
    builder.report.approximated(
        fmt::format("volume \"{}\" is not known: the default stands for it{}", volume->type,
                    suggestion(volume->type, {"constvolume", "gridvolume"})),
        volume->origin);
    return otherwise;
  }
  Spectrum value = spectrum_value(builder, *volume, "value", quantity, otherwise);
  volume->ignore({"to_world"});
  report_unused(*volume, builder.report, {"value"});
  return value;
}

// A heterogeneous medium is where the volume of its extinction is: what is constant, or not given, fills the
// unit cube of its own space.
void bound_by_volume(MediumReader& reader) {
  const Object* volume = object_of(reader.object, "sigma_t");
  const bool is_volume = volume && volume->tag == "volume";
  if (is_volume && volume->type != "constvolume") return;
  Grid cell;
  cell.nx = cell.ny = cell.nz = 1;
  cell.values = {1};
  cell.bounds = unit_cube;
  place_grid(reader, cell, is_volume ? volume->transform("to_world", reader.builder.report) : Transform{},
             reader.object.origin);
  reader.medium.density = cell;
}

Fail failing_at(const Report& report, const Origin& place) {
  return [&report, place](const std::string& message) { report.fail(message, place); };
}

// Of linear pieces between values at equal steps of the cosine from −1 to 1: ∫μp ÷ ∫p.
double mean_cosine_of(const std::vector<double>& values) {
  double sum = 0, total = 0;
  const double step = 2 / static_cast<double>(std::max<std::size_t>(values.size(), 2) - 1);
  for (std::size_t i = 0; i + 1 < values.size(); ++i) {
    const double left = -1 + static_cast<double>(i) * step, a = values[i], b = values[i + 1];
    total += step * (a + b) / 2;
    sum += step * (left * (a + b) / 2 + step * (a + 2 * b) / 6);
  }
  return total > 0 ? sum / total : 0;
}

// The mean cosine of the angle that light turns by: g of Henyey and Greenstein's; nothing for those that
// depend on more than the angle.
std::optional<double> mean_cosine(const Object& phase, const Report& report) {
  const Fail fail = failing_at(report, phase.origin);
  if (phase.type == "isotropic" || phase.type == "rayleigh") return 0;
  if (phase.type == "tabphase") return mean_cosine_of(parse_numbers(phase.text("values", "", report), fail));
  if (phase.type == "hg") {
    const double g = phase.number("g", 0.8, report);
    if (!(std::abs(g) < 1))
      report.fail(fmt::format("\"g\" is {}, which is not between -1 and 1", g), place_of(phase, "g"));
    return g;
  }
  if (phase.type != "blendphase" && phase.type != "mixturephase") return std::nullopt;
  const auto parts = phase.children("phase");
  std::vector<double> weights =
      parse_numbers(phase.has("weights") ? phase.text("weights", "", report) : "", fail);
  if (phase.type == "blendphase") {
    const Property* weight = phase.find("weight");
    if (!weight || std::holds_alternative<ObjectPtr>(weight->value)) return std::nullopt;
    const double second = phase.number("weight", 0.5, report);
    weights = {1 - second, second};
  }
  if (weights.size() != parts.size()) return std::nullopt;
  double sum = 0, total = 0;
  for (std::size_t i = 0; i < parts.size(); ++i) {
    const auto part = mean_cosine(*std::get<ObjectPtr>(parts[i]->value), report);
    if (!part) return std::nullopt;
    sum += weights[i] * *part, total += weights[i];
  }
  return total > 0 ? std::optional(sum / total) : std::nullopt;
}

}  // namespace

float read_phase(const Object& medium, Report& report) {
  const Object* phase = medium.child("phase");
  if (!phase) return 0;
  const std::optional<double> g = mean_cosine(*phase, report);
  if (phase->type != "isotropic" && phase->type != "hg")
    report.approximated(
        g && *g != 0
            ? fmt::format(
                  "phase function \"{}\" becomes Henyey and Greenstein's of the same mean cosine, {:.3g}",
                  phase->type, *g)
            : fmt::format("phase function \"{}\" becomes isotropic{}", phase->type,
                          suggestion(phase->type, {"isotropic", "hg"})),
        phase->origin);
  else
    report_unused(*phase, report, {"g"});
  return static_cast<float>(std::clamp(g.value_or(0), -0.999, 0.999));
}

namespace {

// Mitsuba 0.6 takes a list of measured media, absorption and scattering, or the density by itself, too.
void read_coefficients(MediumReader& reader) {
  const Object& object = reader.object;
  const Spectrum one = ConstantSpectrum{1};
  if (object.has("material")) {
    reader.medium.coefficients = measured_coefficients(reader.builder, object);
  } else if (object.has("sigma_a") || object.has("sigma_s")) {
    AbsorptionScattering c;
    c.sigma_a = read_volume(reader, "sigma_a", Quantity::unbounded, one);
    c.sigma_s = read_volume(reader, "sigma_s", Quantity::unbounded, one);
    reader.medium.coefficients = c;
  } else {
    ExtinctionAlbedo c;
    c.sigma_t = read_volume(reader, object.has("density") ? "density" : "sigma_t", Quantity::unbounded, one);
    c.albedo = read_volume(reader, "albedo", Quantity::reflectance, ConstantSpectrum{0.75f});
    reader.medium.coefficients = c;
  }
}

}  // namespace

Id<Medium> add_medium(Builder& builder, const Object& object) {
  if (const auto known = builder.media.find(&object); known != builder.media.end()) return known->second;
  Report& report = builder.report;
  report.begin_item({object.origin, RecordKind::medium});
  if (object.type != "homogeneous" && object.type != "heterogeneous")
    report.approximated(fmt::format("medium \"{}\" is not known and read as \"homogeneous\"{}", object.type,
                                    suggestion(object.type, {"homogeneous", "heterogeneous"})),
                        object.origin);
  Medium medium;
  medium.origin = object.origin;
  medium.name = name_of(object);
  MediumReader reader{builder, object, medium};
  read_coefficients(reader);
  medium.scale = static_cast<float>(object.number("scale", 1, report));
  medium.g = read_phase(object, report);
  if (object.type == "heterogeneous") bound_by_volume(reader);
  object.ignore({"sample_emitters", "has_spectral_extinction", "method", "step_size", "strategy",
                 "majorant_resolution_factor"});
  report_unused(object, report, {"sigma_t", "albedo", "sigma_a", "sigma_s", "scale", "material"});
  const Id<Medium> id{static_cast<std::uint32_t>(builder.scene.media.size())};
  builder.scene.media.push_back(std::move(medium));
  builder.media.emplace(&object, id);
  return id;
}

}  // namespace vitrail::mitsuba
