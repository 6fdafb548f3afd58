// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <numbers>

#include "bundle/census.h"
#include "bundle/light_names.h"
#include "cli/common/quadric_counts.h"
#include "cli/inspect/inspect.h"
#include "film/film_progress.h"
#include "film/film_seeds.h"
#include "film/picture_fields.h"
#include "importers/import.h"
#include "partitioner/appearance/appearance.h"
#include "partitioner/placing/flatten.h"
#include "scene/daylight/sky_model.h"
#include "scene/records/kinds.h"
#include "scene/records/material_traits.h"
#include "tracer/lights/quadric_light.h"

namespace vitrail {

namespace {

Report triple(const auto& v) { return {v.x, v.y, v.z}; }

// Its kind and its values at blue, green and red; null where there is none.
Report values_of(const Spectrum* s) {
  Report values{{"spectrum", s ? Report(kind_of(*s)) : Report(nullptr)}};
  for (const int nm : {450, 550, 650})
    values[fmt::format("at_{}_nm", nm)] = s ? Report(evaluate(*s, nm)) : Report(nullptr);
  return values;
}

// `number`: of the list, from 1, as the channel Id.material has it.
Report describe(const Material& material, std::size_t number) {
  const Spectrum* spectrum = nullptr;
  Report of = nullptr;
  if (const auto* diffuse = std::get_if<DiffuseMaterial>(&material.model))
    if ((spectrum = std::get_if<Spectrum>(&diffuse->reflectance))) of = "reflectance";
  if (const auto* dielectric = std::get_if<DielectricMaterial>(&material.model))
    spectrum = &dielectric->eta, of = "index";
  Report row{{"number", number},
             {"name", material.name.empty() ? Report(nullptr) : Report(material.name)},
             {"kind", kind_of(material.model)},
             {"spectrum_of", of}};
  row.update(values_of(spectrum));
  return row;
}

// Emitting area of each area light, scene units².
std::vector<double> emitting_areas(const Manifest& m) {
  std::vector<double> areas(m.area_lights.size(), 0);
  for (const EmissiveTriangle& t : m.emissive_triangles)
    areas[t.area_light] +=
        polygon_area(std::array{cast<double>(t.p[0]), cast<double>(t.p[1]), cast<double>(t.p[2])});
  for (const EmissiveQuadric& q : m.emissive_quadrics)
    areas[q.area_light] += QuadricLight(q, false, 1).area();
  return areas;
}

// The luminance of what has one value; null where an image decides.
Report luminance_of(const SpectrumParameter& p) {
  const auto* spectrum = std::get_if<Spectrum>(&p);
  return spectrum ? Report(luminance(*spectrum)) : Report(nullptr);
}

struct LightDescriber {
  Report operator()(const PointLight& l) const {
    return of(l.intensity, l.fading ? 0 : 4 * std::numbers::pi);
  }
  Report operator()(const SpotLight& l) const { return of(l.intensity); }
  Report operator()(const ProjectionLight& l) const { return of(l.scale); }
  Report operator()(const GoniometricLight& l) const { return of(l.intensity); }
  Report operator()(const DistantLight& l) const { return of(l.irradiance); }
  Report operator()(const InfiniteLight& l) const { return of(l.radiance); }
  Report operator()(const EnvironmentLight& l) const { return of(l.scale); }
  // Of a plane that faces up, lit by the sky alone.
  Report operator()(const SkyLight& l) const { return of(spectrum_of_bands(SkyModel(l).sky_irradiance())); }

 private:
  // `flux`: over the luminance; 0: not told.
  static Report of(const Spectrum& s, double flux = 0) {
    const double y = luminance(s);
    return {{"luminance", y}, {"area", nullptr}, {"power", flux > 0 ? Report(flux * y) : Report(nullptr)}};
  }
};

// `power` is ȳ-weighted: π·A·L of an area light (twice that if two-sided), 4π·I of a point light.
Report describe_lights(const Manifest& m) {
  Report lights = Report::array();
  const std::vector<double> areas = emitting_areas(m);
  const LightNames names = light_names(m);
  for (std::size_t i = 0; i < areas.size(); ++i) {
    const AreaLight& l = m.area_lights[i];
    const Report y = luminance_of(l.radiance);
    const double sides = l.two_sided ? 2 : 1;
    lights.push_back(
        {{"number", lights.size() + 1},
         {"name", names.area_lights[i]},
         {"kind", !l.sampled    ? "glow"
                  : l.two_sided ? "area, both sides"
                                : "area"},
         {"luminance", y},
         {"area", areas[i]},
         {"power", y.is_null() ? y : Report(std::numbers::pi * areas[i] * y.get<double>() * sides)}});
  }
  for (const Light& light : m.lights) {
    Report described{{"number", lights.size() + 1},
                     {"name", names.lights[lights.size() - areas.size()]},
                     {"kind", kind_of(light.model)}};
    described.update(std::visit(LightDescriber{}, light.model));
    lights.push_back(std::move(described));
  }
  return lights;
}

template <class Condition>
std::string materials_that(const Manifest& m, const char* what, Condition condition) {
  std::size_t count = 0, first = 0;
  for (std::size_t i = 0; i < m.materials.size(); ++i)
    if (condition(m.materials[i]) && count++ == 0) first = i;
  return fmt::format("{} of {} materials {}, the first is number {}", count, m.materials.size(), what,
                     first + 1);
}

template <class Model>
bool is(const Material& material) {
  return std::holds_alternative<Model>(material.model);
}

std::string why_see_through(const Manifest& m) {
  const auto sheer = [](const Material& x) {
    const auto* d = std::get_if<DielectricMaterial>(&x.model);
    const MaterialTraits traits = traits_of(x.model);
    return (d && d->priority != 0) || traits.straight || traits.fibre;
  };
  const auto partly =
      std::ranges::count_if(m.surfaces, [](const Surface& s) { return s.opacity != FloatParameter{1.0f}; });
  if (partly > 0) return fmt::format("{} of {} surfaces are there in part", partly, m.surfaces.size());
  return materials_that(m, "let light straight through", sheer);
}

// What the scene asks of a renderer, and why.
Report describe_requirements(const Manifest& m) {
  const Requirements& r = m.requirements;
  const auto disperses = [](const Material& x) {
    const auto* d = std::get_if<DielectricMaterial>(&x.model);
    return d && !(is_constant(d->eta) && is_constant(d->exterior_eta));
  };
  return {
      {"shading_normals", need(r.shading_normals ? "a mesh in use has normals at its vertices" : "")},
      {"uv", need(r.uv ? "a texture, a tangent or a bump is looked up by (u,v)" : "")},
      {"filtering", need(r.filtering ? "an image asks for it" : "")},
      {"textures", need(m.texture_files.empty() ? "" : fmt::format("{} images", m.texture_files.size()))},
      {"mesh_attributes", need(m.attributes == 0 ? "" : fmt::format("{} values a vertex", m.attributes))},
      {"refraction", need(r.refraction ? materials_that(m, "are dielectric", is<DielectricMaterial>) : "")},
      {"dispersion", need(r.dispersion ? materials_that(m, "refract by wavelength", disperses) : "")},
      {"see_through", need(r.see_through ? why_see_through(m) : "")},
      {"media", need(r.media ? fmt::format("{} of them", m.media.size()) : "")}};
}

template <class Value>
Report or_null(const std::optional<Value>& value) {
  return value ? Report(*value) : Report(nullptr);
}

// Null: no limit.
Report depth_or_null(int depth) { return depth >= no_limit_of_depth ? Report(nullptr) : Report(depth); }

Report describe_view(const Manifest& m) {
  const FilmSettings& f = m.film;
  const PhotonSettings photons = m.settings.photons.value_or(PhotonSettings{});
  return {{"camera", kind_of(m.camera)},
          {"pixels", {f.width, f.height}},
          {"crop", {f.crop.x0, f.crop.x1, f.crop.y0, f.crop.y1}},
          {"layers", names_of(f.layers)},
          {"samples_per_pixel", m.settings.samples_per_pixel},
          {"max_depth", depth_or_null(m.settings.max_depth)},
          {"integrator", m.settings.direct_only ? "direct"
                         : m.settings.photons   ? "photon"
                                                : "path"},
          {"photons", or_null(photons.photons)},
          {"photon_radius", or_null(photons.first_radius)},
          {"photon_alpha", or_null(photons.alpha)},
          {"hide_emitters", m.settings.hides_emitters},
          {"rgb", rgb_method_names[static_cast<std::size_t>(m.settings.rgb)]}};
}

Report describe_diagnostics(const Diagnostics& diagnostics) {
  Report list = Report::array();
  for (const Diagnostic& d : diagnostics)
    list.push_back({{"fidelity", d.fidelity == Fidelity::dropped ? "dropped" : "approximated"},
                    {"where", to_string(d.location)},
                    {"what", d.message}});
  return list;
}

// What was asked for, "glazing" or "sampling", as the film tells; `otherwise` where nothing was.
std::string asked_of(const FilmProgress& progress, const char* what, const char* otherwise) {
  const Report about = Report::parse(progress.about, nullptr, false);
  return about.is_object() && about.contains(what) && about[what].is_string() ? about[what].get<std::string>()
                                                                              : otherwise;
}

}  // namespace

Report describe(const Manifest& m) {
  Report r;
  r["scene_hash"] = fmt::format("{:016x}", m.scene_hash);
  r["triangles"] = m.triangles;
  r["surfaces"] = m.surfaces.size();
  if (!m.bounds.empty()) {
    r["bounds_lower"] = triple(cast<double>(m.bounds.lower) + m.offset);
    r["bounds_upper"] = triple(cast<double>(m.bounds.upper) + m.offset);
  }
  r["requires"] = describe_requirements(m);
  r["materials"] = Report::array();
  for (const Material& material : m.materials)
    r["materials"].push_back(describe(material, r["materials"].size() + 1));
  r["emissive_triangles"] = m.emissive_triangles.size();
  r["lights"] = describe_lights(m);
  r["view"] = describe_view(m);
  return r;
}

namespace {

// Adds the shape and the material of each area light to the list: of many shapes, the first in the file.
// `ids`: the light's place in the list, by its id in the scene.
void name_shapes_of_lamps(const Scene& scene, const std::vector<std::int32_t>& ids, Report& lights) {
  for (Report& light : lights) light.update({{"shape", nullptr}, {"material", nullptr}});
  const auto take = [&](const std::vector<Shape>& shapes) {
    for (const Shape& shape : shapes) {
      const std::int32_t at = shape.area_light ? ids.at(shape.area_light->value) : -1;
      if (at < 0 || !lights[static_cast<std::size_t>(at)]["shape"].is_null()) continue;
      Report& light = lights[static_cast<std::size_t>(at)];
      light["shape"] = shape.name.empty() ? to_string(location(scene, shape.origin)) : shape.name;
      const std::string& material = scene.materials[shape.material.value].name;
      if (!material.empty()) light["material"] = material;
    }
  };
  take(scene.shapes);
  for (const Prototype& prototype : scene.prototypes) take(prototype.shapes);
}

// About what its bundle would take: triangles with their hierarchy (docs/why/partitioning.md), and images.
std::uint64_t bundle_bytes(const Manifest& m, const Scene& scene) {
  std::uint64_t bytes = (m.requirements.shading_normals ? 78 : 62) * m.triangles;
  for (const Report& t : describe_textures(scene))
    if (t["width"].is_number())
      bytes += 4 * t["width"].get<std::uint64_t>() * t["height"].get<std::uint64_t>();
  return bytes;
}

}  // namespace

Report inspect_scene(const std::filesystem::path& file, const ImportOptions& options) {
  const ImportedScene imported = import_scene(file, MeshMemory{}, {}, options);
  const Scene& s = imported.scene;
  const Manifest manifest = flatten(s, {}, {.keep_instances = true}).manifest;
  Report r{{"file", file.string()}, {"kind", "scene"}, {"summary", nullptr}};
  r["meshes"] = s.meshes.size();
  r["shapes"] = s.shapes.size();
  r["quadrics"] = quadric_counts(s);
  r["prototypes"] = s.prototypes.size();
  r["instances"] = s.instances.size();
  r["mesh_bytes"] = mesh_bytes(s);
  r["needs"] = describe_needs(s);
  r["materials_of_the_scene"] = describe_materials(s);
  r["textures"] = describe_textures(s);
  r["media"] = describe_media(s);
  if (Report panes = describe_panes(s); !panes.empty()) r["glazing"] = std::move(panes);
  r["open_glass"] = describe_open_glass(s);
  r.update(describe(manifest));
  const Appearance appearance = appearance_of(s, {});
  name_shapes_of_lamps(s, appearance.area_light_ids, r["lights"]);
  r["not_exact"] = describe_diagnostics(imported.diagnostics);
  r["not_rendered_exactly"] = describe_diagnostics(appearance.diagnostics);
  r["summary"] = summary_of(manifest, bundle_bytes(manifest, s));
  r["summary"]["not_exact"] = r["not_exact"].size();
  r["summary"]["not_rendered_exactly"] = r["not_rendered_exactly"].size();
  return r;
}

Report inspect_film(const std::filesystem::path& file) {
  FilmProgress progress;
  const Film film = read_film(file, &progress);
  const auto pixels = film.pixels();
  std::uint64_t least = pixels ? film.samples(0) : 0, most = 0, sum = 0;
  double luminance = 0;
  for (std::uint32_t i = 0; i < pixels; ++i) {
    least = std::min(least, film.samples(i));
    most = std::max(most, film.samples(i));
    sum += film.samples(i);
    luminance += film.mean(i).y;
  }
  const PixelRect& crop = film.crop();
  return {{"file", file.string()},
          {"kind", "film"},
          {"pixels", {film.full_width(), film.full_height()}},
          {"crop", {crop.x0, crop.x1, crop.y0, crop.y1}},
          {"complete", progress.complete()},
          {"adaptive", progress.adaptive},
          {"samples_per_pixel_asked", progress.samples_per_pixel},
          {"samples_per_pixel_least", least},
          {"samples_per_pixel_most", most},
          {"samples", sum},
          {"mean_luminance", pixels ? luminance / pixels : 0},
          {"nonfinite_samples", film.refused().nonfinite},
          {"saturated_samples", film.refused().too_large},
          {"render_time_s", progress.render_time_s},
          {"seeds", seeds_of(film, progress.about)},
          {"scene_hash", fmt::format("{:016x}", film.key().scene_hash)},
          {"glazing", asked_of(progress, "glazing", "as the scene says")},
          {"sampling", asked_of(progress, "sampling", "as usual")},
          {"made_by", to_string(film.key().renderer)},
          {"max_depth", depth_or_null(film.key().max_depth)},
          {"integrator", film.key().direct_only           ? "direct"
                         : film.key().photons.photons > 0 ? "photon"
                                                          : "path"},
          {"photons", film.key().photons.photons},
          {"photon_radius", film.key().photons.first_radius},
          {"photon_alpha", film.key().photons.alpha},
          {"shared_error", film.shared_error()},
          {"straight_counts", film.key().straight_counts},
          {"clamp", film.key().clamp},
          {"clamped_share", film.clamped_share()},
          {"spectral_bins", film.bins().count},
          {"layers", names_of(film.layers())},
          {"light_groups", film.key().groups.names},
          {"hide_emitters", film.key().hides_emitters},
          {"layers_in_camera_space", film.layers().in_camera_space},
          {"imaging_ratio", film.imaging_ratio()},
          {"working_gamma", film.settings().working_gamma},
          {"quantum_exponent", film.exponent()},
          {"film_hash", fmt::format("{:016x}", film.hash())}};
}

}  // namespace vitrail
