// SPDX-License-Identifier: Apache-2.0
#include "importers/pbrt/materials.h"

#include <fmt/format.h>

#include <array>

#include "importers/pbrt/spectrum_names.h"
#include "scene/rgb_to_spectrum.h"

namespace vitrail::pbrt {

namespace {

struct Maker {
  const std::string& kind;
  ParameterSet& parameters;
  const Scope& scope;

  Spectrum reflectance(std::initializer_list<std::string_view> names, double otherwise) const {
    return spectrum_value(parameters, names, Quantity::reflectance,
                          ConstantSpectrum{static_cast<float>(otherwise)}, scope);
  }
  void approximated(const std::string& how) const {
    scope.context.report.approximated(fmt::format("material \"{}\": {}", kind, how), parameters.place());
  }
  // Surface detail that only ever perturbs normals.
  void drop_bumps() const {
    for (const std::string_view name : {"displacement", "normalmap", "bumpmap"})
      if (const Parameter* p =
              parameters.find(name, {ParameterType::texture, ParameterType::text, ParameterType::number}))
        scope.context.report.dropped(fmt::format("material \"{}\": \"{}\" is not rendered", kind, name),
                                     p->place);
  }
};

Material diffuse_material(const Maker& m) {
  if (number_value(m.parameters, "sigma", 0, m.scope) != 0)
    m.approximated("sigma (Oren-Nayar roughness) becomes 0, Lambertian");
  return DiffuseMaterial{m.reflectance({"reflectance", "Kd"}, 0.5)};
}

bool is_rough(const Maker& m) {
  bool rough = false;
  for (const std::string_view name : {"roughness", "uroughness", "vroughness"})
    rough = number_value(m.parameters, name, 0, m.scope) != 0 || rough;
  m.parameters.ignore({"remaproughness"});
  return rough;
}

Spectrum refraction(const Maker& m) {
  return spectrum_value(m.parameters, {"eta", "index"}, Quantity::refraction, ConstantSpectrum{1.5f},
                        m.scope);
}

Material dielectric_material(const Maker& m) {
  if (is_rough(m)) m.approximated("the rough surface becomes a smooth one");
  for (const std::string_view name : {"Kr", "Kt"}) {
    const Spectrum factor = m.reflectance({name}, 1);
    if (!is_constant(factor) || evaluate(factor, lambda_min_nm) != 1)
      m.approximated(
          fmt::format("{} becomes 1: reflection and transmission follow Fresnel's equations", name));
  }
  return DielectricMaterial{refraction(m)};
}

Material interface_material(const Maker&) { return InterfaceMaterial{}; }

Material thin_dielectric_material(const Maker& m) {
  refraction(m);
  m.approximated("light goes straight through, without the reflection of the thin sheet");
  return InterfaceMaterial{};
}

Material coated_material(const Maker& m) {
  m.parameters.ignore({"roughness", "uroughness", "vroughness", "remaproughness", "thickness", "eta",
                       "albedo", "g", "maxdepth", "nsamples", "Ks", "Kr", "d"});
  m.approximated("becomes diffuse with its reflectance; the coating or gloss is left out");
  const bool substrate_like = m.kind == "substrate" || m.kind == "coateddiffuse";
  return DiffuseMaterial{m.reflectance({"reflectance", "Kd"}, substrate_like ? 0.5 : 0.25)};
}

// Of uber's lobes the strongest one stands for all.
Material uber_material(const Maker& m) {
  const Spectrum diffuse = m.reflectance({"Kd"}, 0.25);
  const double transmitted = luminance(m.reflectance({"Kt"}, 0));
  if (luminance(m.reflectance({"opacity"}, 1)) < 0.5) {
    m.approximated(
        "is mostly transparent (opacity below 0.5) and becomes an interface that light passes unchanged");
    return InterfaceMaterial{};
  }
  if (transmitted > luminance(diffuse)) {
    m.approximated("Kt outweighs Kd: becomes a smooth dielectric");
    return DielectricMaterial{refraction(m)};
  }
  m.parameters.ignore(
      {"Ks", "Kr", "roughness", "uroughness", "vroughness", "remaproughness", "eta", "index"});
  m.approximated("becomes diffuse with Kd; gloss, mirror and transmission are left out");
  return DiffuseMaterial{diffuse};
}

// The reflectance at normal incidence: as given, of a metal by name, or from eta and k; pbrt's default is
// copper.
Spectrum metal_spectrum(const Maker& m, const std::string& prefix) {
  const std::string reflectance = "reflectance", eta = prefix + "eta", k = prefix + "k";
  if (!prefix.empty() || m.kind == "conductor")
    if (const Parameter* p = m.parameters.find_spectrum(reflectance)) return read_reflectance(*p, m.scope);
  const Parameter* index = m.parameters.find_spectrum(eta);
  const Parameter* absorption = m.parameters.find_spectrum(k);
  for (const Parameter* p : {index, absorption})
    if (p && !p->strings.empty())
      if (const auto known = metal_reflectance(p->strings.front())) return reflectance_from_rgb(*known);
  if (index && absorption)
    return conductor_reflectance(read_refraction(*index, m.scope), read_refraction(*absorption, m.scope));
  if (m.parameters.find(reflectance, {ParameterType::texture})) return m.reflectance({reflectance}, 0.5);
  return reflectance_from_rgb(*metal_reflectance("metal-Cu-eta"));
}

Material metal_material(const Maker& m) {
  const bool coated = m.kind == "coatedconductor";
  const Spectrum reflectance = metal_spectrum(m, coated ? "conductor." : "");
  m.parameters.ignore({"roughness", "uroughness", "vroughness", "remaproughness", "interface.roughness",
                       "interface.uroughness", "interface.vroughness", "interface.eta", "conductor.roughness",
                       "conductor.uroughness", "conductor.vroughness", "thickness", "albedo", "g", "maxdepth",
                       "nsamples"});
  m.approximated(fmt::format("becomes diffuse with its reflectance at normal incidence, {:.2f} on average",
                             luminance(reflectance)));
  return DiffuseMaterial{reflectance};
}

Material mirror_material(const Maker& m) {
  const Spectrum reflectance = m.reflectance({"Kr"}, 0.9);
  m.approximated(fmt::format("becomes diffuse with Kr, {:.2f} on average", luminance(reflectance)));
  return DiffuseMaterial{reflectance};
}

Material transmitting_material(const Maker& m) {
  m.parameters.ignore({"transmittance", "scale", "Ks", "reflect", "transmit", "roughness", "remaproughness"});
  m.approximated("becomes diffuse with its reflectance; transmission is left out");
  return DiffuseMaterial{m.reflectance({"reflectance", "Kd"}, 0.25)};
}

// Models whose look follows from measurements or volumes: a colour if one is given.
Material other_material(const Maker& m) {
  const Spectrum reflectance = m.reflectance({"reflectance", "color", "Kd", "diffuse"}, 0.5);
  for (const Parameter& p : m.parameters.all()) m.parameters.ignore({p.name});
  m.approximated(
      fmt::format("becomes diffuse with a reflectance of {:.2f} on average", luminance(reflectance)));
  return DiffuseMaterial{reflectance};
}

// v4's amount weights the second material, v3's the first.
MaterialAlias heavier_of_mix(const Maker& m) {
  std::array<std::string, 2> names;
  if (const Parameter* both = m.parameters.find("materials", {ParameterType::text})) {
    if (both->strings.size() != 2) fail("a mix needs two materials", both->place);
    names = {both->strings[0], both->strings[1]};
  } else {
    names = {m.parameters.text("namedmaterial1", ""), m.parameters.text("namedmaterial2", "")};
    if (names[0].empty() || names[1].empty()) fail("a mix needs two materials by name", m.parameters.place());
  }
  const double amount = luminance(m.reflectance({"amount"}, 0.5));
  const bool first = m.scope.context.version == Version::v4 ? amount <= 0.5 : amount >= 0.5;
  m.approximated(fmt::format("the heavier of two, \"{}\", stands for the mix", names[first ? 0 : 1]));
  return {names[first ? 0 : 1], m.parameters.place()};
}

struct Kind {
  std::string_view name;
  Material (*make)(const Maker&);
};

constexpr std::array<Kind, 25> kinds{{{"diffuse", diffuse_material},
                                      {"matte", diffuse_material},
                                      {"dielectric", dielectric_material},
                                      {"glass", dielectric_material},
                                      {"interface", interface_material},
                                      {"none", interface_material},
                                      {"", interface_material},
                                      {"thindielectric", thin_dielectric_material},
                                      {"coateddiffuse", coated_material},
                                      {"plastic", coated_material},
                                      {"substrate", coated_material},
                                      {"uber", uber_material},
                                      {"conductor", metal_material},
                                      {"metal", metal_material},
                                      {"coatedconductor", metal_material},
                                      {"mirror", mirror_material},
                                      {"diffusetransmission", transmitting_material},
                                      {"translucent", transmitting_material},
                                      {"subsurface", other_material},
                                      {"kdsubsurface", other_material},
                                      {"hair", other_material},
                                      {"measured", other_material},
                                      {"fourier", other_material},
                                      {"disney", other_material},
                                      {"principled", other_material}}};

}  // namespace

std::variant<Material, MaterialAlias> make_material(const std::string& kind, ParameterSet& parameters,
                                                    const Scope& scope) {
  const Maker maker{kind, parameters, scope};
  parameters.ignore({"type"});
  maker.drop_bumps();
  if (kind == "mix") {
    const MaterialAlias alias = heavier_of_mix(maker);
    parameters.report_unused(scope.context.report);
    return alias;
  }
  for (const Kind& known : kinds) {
    if (kind != known.name) continue;
    const Material material = known.make(maker);
    parameters.report_unused(scope.context.report);
    return material;
  }
  std::vector<std::string> names;
  for (const Kind& known : kinds) names.emplace_back(known.name);
  const std::string closest = closest_word(kind, names);
  maker.approximated(closest.empty() ? "is not known"
                                     : fmt::format("is not known; did you mean \"{}\"?", closest));
  return other_material(maker);
}

}  // namespace vitrail::pbrt
