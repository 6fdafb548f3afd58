// SPDX-License-Identifier: Apache-2.0
#include "importers/pbrt/read/materials.h"

#include <array>
#include <cmath>

#include "importers/pbrt/read/material_parameters.h"
#include "importers/pbrt/read/measured_name.h"
#include "importers/reading/glazing_material.h"
#include "importers/spectra/sheet_file.h"
#include "scene/records/material_traits.h"
#include "scene/spectra/rgb_to_spectrum.h"

namespace vitrail::pbrt {

namespace {

// v4: √r. v3: its polynomial in ln r, which it also clamps below 1e-3.
double remapped(double roughness, bool v3) {
  if (!v3) return std::sqrt(std::max(roughness, 0.0));
  const double x = std::log(std::max(roughness, 1e-3));
  return 1.62142 + 0.819955 * x + 0.1734 * x * x + 0.0171201 * x * x * x + 0.000640711 * x * x * x * x;
}

}  // namespace

Roughness MaterialMaker::roughness(double otherwise, const std::string& prefix) const {
  const FloatParameter both = number(prefix + "roughness", otherwise);
  const auto of = [&](const std::string& axis) {
    const std::string name = prefix + axis + "roughness";
    const bool given =
        parameters.find(name, {ParameterType::number, ParameterType::integer, ParameterType::texture});
    return given ? number(name, otherwise) : both;
  };
  Roughness r{of("u"), of("v")};
  if (r.alpha_u != FloatParameter{0.0f} || r.alpha_v != FloatParameter{0.0f})
    r.masking = Masking::correlated;  // Λ of the two directions is added in all versions
  const bool remap = parameters.boolean("remaproughness", true);
  for (FloatParameter* alpha : {&r.alpha_u, &r.alpha_v}) {
    if (auto* value = std::get_if<float>(alpha)) {
      if (remap && *value != 0) *value = static_cast<float>(remapped(static_cast<double>(*value), v3()));
    } else if (remap) {
      r.square_root = true;
      if (v3()) approximated("the square root of its roughness texture stands for v3's remapping");
    }
  }
  return r;
}

Metal MaterialMaker::metal(const std::string& prefix) const {
  const std::string eta = prefix + "eta", k = prefix + "k";
  const bool by_index = parameters.find_spectrum(eta) || parameters.find_spectrum(k) ||
                        parameters.find(eta, {ParameterType::texture}) ||
                        parameters.find(k, {ParameterType::texture});
  if (!by_index && !v3() &&
      (parameters.find_spectrum("reflectance") || parameters.find("reflectance", {ParameterType::texture})))
    return NormalReflectance{reflectance({"reflectance"}, 0.5)};
  return ComplexIndex{
      spectrum_parameter(parameters, {eta}, Quantity::unbounded, NamedSpectrum{"metal-Cu-eta"}, scope),
      spectrum_parameter(parameters, {k}, Quantity::unbounded, NamedSpectrum{"metal-Cu-k"}, scope)};
}

CoatingVolume MaterialMaker::coating() const {
  CoatingVolume c;
  c.thickness = number("thickness", 0.01);
  c.g = number("g", 0);
  c.albedo = reflectance({"albedo"}, 0);
  c.max_depth = parameters.integer("maxdepth", 10);
  c.samples = parameters.integer("nsamples", 1);
  return c;
}

namespace {

using Maker = MaterialMaker;

MaterialModel diffuse(const Maker& m) { return DiffuseMaterial{m.reflectance({"reflectance"}, 0.5)}; }

MaterialModel dielectric(const Maker& m) {
  DielectricMaterial d;
  d.eta = m.index({"eta"}, 1.5);
  d.roughness = m.roughness(0);
  d.priority = m.parameters.integer("priority", 0);
  return d;
}

// A system of panes in a file, with what the parameters say of its state.
MaterialModel glazing(const Maker& m, const Parameter& name) {
  std::string file =
      std::filesystem::absolute(m.scope.context.resolve(name.strings.front())).lexically_normal().string();
  for (const char* what : {"state", "temperature"})
    if (m.parameters.find(what, {ParameterType::number}))
      file += fmt::format("#{}={}", what, m.parameters.number(what, 0));
  GlazingModel made = glazing_model(file, m.slots.add);
  for (const std::string& note : made.notes) m.scope.context.report.approximated(note, name.place);
  return std::move(made.model);
}

MaterialModel thin_dielectric(const Maker& m) {
  if (const Parameter* file = m.parameters.find("glazing", {ParameterType::text});
      file && file->strings.size() == 1) {
    m.parameters.ignore({"eta"});
    return glazing(m, *file);
  }
  ThinDielectricMaterial d;
  d.eta = m.index({"eta"}, 1.5);
  return d;
}

MaterialModel interface(const Maker&) { return InterfaceMaterial{}; }

MaterialModel coated_diffuse(const Maker& m) {
  return CoatedDiffuseMaterial{m.reflectance({"reflectance"}, 0.5), m.index({"eta"}, 1.5), m.roughness(0),
                               m.coating()};
}

MaterialModel conductor(const Maker& m) { return ConductorMaterial{m.metal(), m.roughness(0)}; }

MaterialModel coated_conductor(const Maker& m) {
  return CoatedConductorMaterial{m.metal("conductor."), m.roughness(0, "conductor."),
                                 m.index({"interface.eta"}, 1.5), m.roughness(0, "interface."), m.coating()};
}

MaterialModel diffuse_transmission(const Maker& m) {
  return DiffuseTransmissionMaterial{m.reflectance({"reflectance"}, 0.25),
                                     m.reflectance({"transmittance"}, 0.25),
                                     static_cast<float>(m.parameters.number("scale", 1))};
}

MaterialModel subsurface(const Maker& m) {
  SubsurfaceMaterial s;
  s.scale = static_cast<float>(m.parameters.number("scale", 1));
  s.g = static_cast<float>(m.parameters.number("g", 0));
  s.eta = m.index({"eta", "index"}, 1.33);
  s.roughness = m.roughness(0);
  const std::string name = m.parameters.text("name", "");
  if (!name.empty() && is_measured(name, m.parameters, m.scope)) {
    s.interior = SubsurfaceMaterial::Named{name};
  } else if (m.kind == "kdsubsurface" || m.parameters.find_spectrum("reflectance") ||
             m.parameters.find("reflectance", {ParameterType::texture})) {
    s.interior = SubsurfaceMaterial::Effective{m.reflectance({"reflectance", "Kd"}, 0.5),
                                               m.unbounded({"mfp"}, Maker::grey(m.v3() ? 0.5 : 1))};
  } else {  // of skim milk, per mm: pbrt's defaults
    s.interior = SubsurfaceMaterial::Coefficients{
        m.unbounded({"sigma_a"}, unbounded_from_rgb({0.0011, 0.0024, 0.014})),
        m.unbounded({"sigma_s"}, unbounded_from_rgb({2.55, 3.21, 3.77}))};
  }
  return s;
}

MaterialModel hair(const Maker& m) {
  HairMaterial h;
  const auto is_given = [&](const char* name) {
    return m.parameters.find_spectrum(name) || m.parameters.find(name, {ParameterType::texture});
  };
  if (is_given("sigma_a")) h.sigma_a = m.unbounded({"sigma_a"}, Maker::grey(0));
  for (const char* color : {"reflectance", "color"})
    if (is_given(color)) h.color = m.reflectance({color}, 0.5);
  if (is_given("eumelanin")) h.eumelanin = m.number("eumelanin", 0);
  if (is_given("pheomelanin")) h.pheomelanin = m.number("pheomelanin", 0);
  if (!h.sigma_a && !h.color && !h.eumelanin && !h.pheomelanin) h.eumelanin = 1.3f;  // brown, pbrt's default
  h.eta = static_cast<float>(m.parameters.number("eta", 1.55));
  h.beta_m = m.number("beta_m", 0.3);
  h.beta_n = m.number("beta_n", 0.3);
  h.alpha_deg = m.number("alpha", 2);
  return h;
}

MaterialModel measured(const Maker& m) {
  const Parameter* file = m.parameters.find("filename", {ParameterType::text});
  if (!file || file->strings.size() != 1)
    fail("a measured material needs a \"string filename\"", m.parameters.place());
  if (is_glazing(std::filesystem::absolute(m.scope.context.resolve(file->strings.front())).string()))
    return glazing(m, *file);
  const std::string filename = find_file(*file, m.scope.context);
  if (!is_measured_sheet(filename)) return TabulatedMaterial{TabulatedMaterial::Format::adaptive, filename};
  MeasuredSheetFile table = read_measured_sheet(filename);
  for (const std::string& repair : table.repairs) m.scope.context.report.approximated(repair, file->place);
  return MeasuredMaterial{filename, std::move(table.sheet)};
}

// v4's amount weights the second material, v3's the first.
MaterialModel mix(const Maker& m) {
  std::array<std::string, 2> names;
  if (const Parameter* both = m.parameters.find("materials", {ParameterType::text})) {
    if (both->strings.size() != 2) fail("a mix needs two materials", both->place);
    names = {both->strings[0], both->strings[1]};
  } else {
    names = {m.parameters.text("namedmaterial1", ""), m.parameters.text("namedmaterial2", "")};
    if (names[0].empty() || names[1].empty()) fail("a mix needs two materials by name", m.parameters.place());
  }
  if (m.v3()) std::swap(names[0], names[1]);
  FloatParameter amount = 0.5f;
  if (const Parameter* color = m.parameters.find_spectrum("amount");
      color && color->type != ParameterType::number) {
    const Spectrum value = read_reflectance(*color, m.scope);
    if (!is_constant(value)) m.approximated("its amount is a colour: its luminance stands for it");
    amount = static_cast<float>(luminance(value));
  } else {
    amount = m.number("amount", 0.5);
  }
  return BlendMaterial{m.slots.named(names[0]), m.slots.named(names[1]), amount};
}

struct MaterialKind {
  std::string_view name;
  MaterialModel (*make)(const Maker&);
};

constexpr std::array<MaterialKind, 15> material_kinds{{{"diffuse", diffuse},
                                                       {"dielectric", dielectric},
                                                       {"thindielectric", thin_dielectric},
                                                       {"interface", interface},
                                                       {"none", interface},
                                                       {"", interface},
                                                       {"coateddiffuse", coated_diffuse},
                                                       {"conductor", conductor},
                                                       {"coatedconductor", coated_conductor},
                                                       {"diffusetransmission", diffuse_transmission},
                                                       {"subsurface", subsurface},
                                                       {"kdsubsurface", subsurface},
                                                       {"hair", hair},
                                                       {"measured", measured},
                                                       {"mix", mix}}};

MaterialModel make_model(const Maker& m) {
  for (const MaterialKind& known : material_kinds)
    if (m.kind == known.name) return known.make(m);
  if (auto model = make_v3_material(m)) return *model;
  std::vector<std::string> names{"matte", "plastic",     "substrate", "uber",   "glass",
                                 "metal", "translucent", "mirror",    "disney", "fourier"};
  for (const MaterialKind& known : material_kinds) names.emplace_back(known.name);
  const std::string closest = closest_word(m.kind, names);
  m.approximated(closest.empty()
                     ? "is not known and becomes diffuse"
                     : fmt::format("is not known and becomes diffuse; did you mean \"{}\"?", closest));
  MaterialModel model = DiffuseMaterial{m.reflectance({"reflectance", "color", "Kd", "diffuse"}, 0.5)};
  for (const Parameter& p : m.parameters.all()) m.parameters.ignore({p.name});
  return model;
}

void read_bumps(const Maker& m, Material& material) {
  for (const char* name : {"displacement", "bumpmap"})
    if (m.parameters.find(name, {ParameterType::texture, ParameterType::number}))
      material.displacement = m.number(name, 0);
  if (const Parameter* file = m.parameters.find("normalmap", {ParameterType::text}))
    material.normal_map = add_image(*file, Encoding::linear, m.scope);
}

}  // namespace

Material make_material(const std::string& kind, ParameterSet& parameters, const Scope& scope,
                       const MaterialSlots& slots) {
  parameters.ignore({"type"});
  Material bumps;
  if (kind != "mix") read_bumps({kind, parameters, scope, slots}, bumps);  // a mix has none of its own
  const auto bumped = [&](Material material) {
    if (is_made_of_others(material)) return material;
    material.displacement = bumps.displacement;
    material.normal_map = bumps.normal_map;
    return material;
  };
  const auto add = [&](Material part) { return slots.add(bumped(std::move(part))); };
  const MaterialSlots bumped_slots{slots.named, add};
  Material material = bumped({make_model({kind, parameters, scope, bumped_slots})});
  material.origin = scope.origin;
  parameters.report_unused(scope.context.report);
  return material;
}

}  // namespace vitrail::pbrt
