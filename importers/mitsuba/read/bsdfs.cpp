// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <unordered_map>

#include "importers/mitsuba/read/bsdf_models.h"
#include "importers/mitsuba/read/builder.h"
#include "importers/mitsuba/read/index_of_refraction.h"
#include "importers/mitsuba/read/properties.h"
#include "importers/mitsuba/read/values.h"
#include "importers/reading/glazing_material.h"
#include "importers/spectra/greatest_value.h"
#include "importers/spectra/sheet_file.h"
#include "scene/records/material_traits.h"
#include "scene/spectra/named_spectra.h"

namespace vitrail::mitsuba {

namespace {

Spectrum index_spectrum(Builder& b, const Object& o, const char* name, const char* otherwise) {
  return ConstantSpectrum{index_of(b, o, name, otherwise)};
}

Roughness roughness_of(Builder& b, const Object& o) {
  Roughness r;
  const std::string distribution = o.text("distribution", "beckmann", b.report);
  r.distribution = distribution == "ggx" ? Roughness::Distribution::ggx : Roughness::Distribution::beckmann;
  if (distribution != "ggx" && distribution != "beckmann")
    b.report.approximated(fmt::format("distribution \"{}\" becomes \"beckmann\"", distribution), o.origin);
  r.alpha_u = r.alpha_v = float_parameter(b, o, "alpha", 0.1);
  if (o.has("alpha_u")) r.alpha_u = float_parameter(b, o, "alpha_u", 0.1);
  if (o.has("alpha_v")) r.alpha_v = float_parameter(b, o, "alpha_v", 0.1);
  o.ignore({"sample_visible"});
  return r;
}

SpectrumParameter reflectance(Builder& b, const Object& o, const char* name, double otherwise) {
  return spectrum_parameter(b, o, name, Quantity::reflectance,
                            ConstantSpectrum{static_cast<float>(otherwise)});
}
SpectrumParameter factor(Builder& b, const Object& o, const char* name) {
  return spectrum_parameter(b, o, name, Quantity::unbounded, ConstantSpectrum{1});
}

MaterialModel diffuse(Builder& b, const Object& o) {
  return DiffuseMaterial{reflectance(b, o, "reflectance", 0.5)};
}

// 0.6's Oren-Nayar: its alpha is the slope's deviation; √2·σ there.
MaterialModel rough_diffuse(Builder& b, const Object& o) {
  DiffuseMaterial m{reflectance(b, o, "reflectance", 0.5)};
  const FloatParameter alpha = float_parameter(b, o, "alpha", 0.2);
  o.ignore({"use_fast_approx"});
  constexpr double degrees = 180 / 3.14159265358979323846;
  if (const auto* value = std::get_if<float>(&alpha))
    m.sigma_deg = static_cast<float>(std::atan(static_cast<double>(*value) / std::sqrt(2.0)) * degrees);
  else
    b.report.approximated("the texture of its roughness is left out", o.origin);
  return m;
}

MaterialModel dielectric(Builder& b, const Object& o) {
  DielectricMaterial m;
  m.eta = index_spectrum(b, o, "int_ior", "bk7");
  m.exterior_eta = index_spectrum(b, o, "ext_ior", "air");
  if (o.type == "roughdielectric") m.roughness = roughness_of(b, o);
  m.reflectance_factor = factor(b, o, "specular_reflectance");
  m.transmittance_factor = factor(b, o, "specular_transmittance");
  m.priority = o.integer("priority", 0, b.report);
  return m;
}

// A system of panes in a file, with what the object says of its state.
MaterialModel glazing(Builder& b, const Object& o, std::string file) {
  for (const char* name : {"state", "temperature"})
    if (o.has(name)) file += fmt::format("#{}={}", name, o.number(name, 0, b.report));
  GlazingModel made = glazing_model(file, [&](Material side) { return append(b, std::move(side)); });
  for (const std::string& note : made.notes) b.report.approximated(note, o.origin);
  return std::move(made.model);
}

MaterialModel thin_dielectric(Builder& b, const Object& o) {
  if (o.has("glazing")) {
    o.ignore({"int_ior", "ext_ior", "specular_reflectance", "specular_transmittance"});
    return glazing(b, o, o.text("glazing", "", b.report));
  }
  ThinDielectricMaterial m;
  m.eta = index_spectrum(b, o, "int_ior", "bk7");
  m.exterior_eta = index_spectrum(b, o, "ext_ior", "air");
  m.reflectance_factor = factor(b, o, "specular_reflectance");
  m.transmittance_factor = factor(b, o, "specular_transmittance");
  return m;
}

Metal metal_of(Builder& b, const Object& o) {
  if (o.has("eta") || o.has("k"))
    return ComplexIndex{spectrum_parameter(b, o, "eta", Quantity::unbounded, ConstantSpectrum{0}),
                        spectrum_parameter(b, o, "k", Quantity::unbounded, ConstantSpectrum{1})};
  const std::string name = o.text("material", "none", b.report);
  if (name == "none") return PerfectReflector{};
  const std::string eta = fmt::format("metal-{}-eta", name), k = fmt::format("metal-{}-k", name);
  if (named_spectrum(eta) && named_spectrum(k)) return ComplexIndex{NamedSpectrum{eta}, NamedSpectrum{k}};
  std::vector<std::string> known{"none"};
  for (const std::string& other : spectrum_names())
    if (other.starts_with("metal-") && other.ends_with("-k"))
      known.push_back(other.substr(6, other.size() - 8));
  const std::string closest = closest_word(name, known);
  b.report.approximated(fmt::format("no metal is known by the name \"{}\": copper stands for it{}", name,
                                    closest.empty() ? "" : fmt::format("; did you mean \"{}\"?", closest)),
                        o.origin);
  return ComplexIndex{};
}

// 0.6: the index around a metal divides the metal's.
void divide_by_exterior(Builder& b, const Object& o, Metal& metal) {
  const char* const name = o.has("ext_eta") ? "ext_eta" : "ext_ior";
  if (!o.has(name)) return;
  const bool is_named = std::holds_alternative<std::string>(o.find(name)->value);
  const double around = is_named
                            ? static_cast<double>(index_of(b, o, name, "air"))
                            : luminance(spectrum_value(b, o, name, Quantity::unbounded, ConstantSpectrum{1}));
  auto* index = std::get_if<ComplexIndex>(&metal);
  if (!index || around == 1 || !(around > 0)) return;
  for (SpectrumParameter* part : {&index->eta, &index->k})
    if (auto* spectrum = std::get_if<Spectrum>(part))
      *spectrum = scaled(resolved(*spectrum), 1 / around);
    else
      b.report.approximated("the index around a metal becomes 1", o.origin);
}

MaterialModel conductor(Builder& b, const Object& o) {
  ConductorMaterial m;
  m.metal = metal_of(b, o);
  divide_by_exterior(b, o, m.metal);
  if (o.type == "roughconductor") m.roughness = roughness_of(b, o);
  m.reflectance_factor = factor(b, o, "specular_reflectance");
  return m;
}

MaterialModel plastic(Builder& b, const Object& o) {
  PlasticMaterial m;
  m.diffuse_reflectance = reflectance(b, o, "diffuse_reflectance", 0.5);
  m.specular_reflectance = factor(b, o, "specular_reflectance");
  m.eta = index_of(b, o, "int_ior", "polypropylene");
  m.exterior_eta = index_of(b, o, "ext_ior", "air");
  m.nonlinear = o.boolean("nonlinear", false, b.report);
  if (o.type != "plastic") m.roughness = roughness_of(b, o);
  if (o.type == "pplastic")
    b.report.approximated("a polarising plastic becomes the one that does not polarise", o.origin);
  return m;
}

SpectrumParameter times(Builder& b, const SpectrumParameter& value, const Spectrum& factor,
                        const Origin& origin) {
  if (const auto* spectrum = std::get_if<Spectrum>(&value)) return product(*spectrum, factor);
  b.scene.textures.push_back({ProductTexture{value, factor}, false, "", origin});
  return Id<Texture>{static_cast<std::uint32_t>(b.scene.textures.size() - 1)};
}
SpectrumParameter times(Builder& b, const SpectrumParameter& value, double factor, const Origin& origin) {
  return times(b, value, ConstantSpectrum{static_cast<float>(factor)}, origin);
}

// 0.6's sums of a Lambertian part and a gloss that is no Fresnel reflection: a blend of the two, each divided
// by its share, with the microfacets of a perfect mirror for the gloss. An exponent n of the cosine is about
// α = √(2/(n+2)); Ward's α is Beckmann's.
MaterialModel phong(Builder& b, const Object& o) {
  b.report.approximated(fmt::format("the gloss of \"{}\" becomes that of microfacets as wide", o.type),
                        o.origin);
  const SpectrumParameter kd = reflectance(b, o, "diffuse_reflectance", 0.5),
                          ks = reflectance(b, o, "specular_reflectance", 0.2);
  ConductorMaterial gloss{PerfectReflector{}, {}, {}};
  gloss.roughness.distribution = Roughness::Distribution::beckmann;
  if (o.type == "ward") {
    gloss.roughness.alpha_u = float_parameter(b, o, "alpha_u", 0.1);
    gloss.roughness.alpha_v = float_parameter(b, o, "alpha_v", 0.1);
    o.ignore({"variant"});
  } else {
    const FloatParameter exponent = float_parameter(b, o, "exponent", 30);
    const double n =
        std::holds_alternative<float>(exponent) ? static_cast<double>(std::get<float>(exponent)) : 30;
    gloss.roughness.alpha_u = gloss.roughness.alpha_v =
        static_cast<float>(std::sqrt(2 / (std::max(n, 0.0) + 2)));
  }
  constexpr double least = 0.05;
  const double share = std::clamp(greatest_value(ks), least, std::max(least, 1 - greatest_value(kd)));
  gloss.reflectance_factor = times(b, ks, 1 / share, o.origin);
  Material base{DiffuseMaterial{times(b, kd, 1 / (1 - share), o.origin)}}, coat{std::move(gloss)};
  base.two_sided = coat.two_sided = false;
  base.origin = coat.origin = o.origin;
  const Id<Material> first = append(b, std::move(base)), second = append(b, std::move(coat));
  return BlendMaterial{first, second, static_cast<float>(share)};
}

MaterialModel diffuse_transmitter(Builder& b, const Object& o) {
  return DiffuseTransmissionMaterial{ConstantSpectrum{0}, reflectance(b, o, "transmittance", 0.5), 1};
}

// "specular" s is another way to say eta: s·0.08 is the reflectance at normal incidence.
MaterialModel hair(Builder& b, const Object& o) {
  HairMaterial m;
  m.eta = index_of(b, o, "int_ior", "amber");
  m.exterior_eta = index_of(b, o, "ext_ior", "air");
  m.beta_m = float_parameter(b, o, "longitudinal_roughness", 0.3);
  m.beta_n = float_parameter(b, o, "azimuthal_roughness", 0.3);
  m.alpha_deg = float_parameter(b, o, "scale_tilt", 2);
  m.along_v = true;
  if (o.has("sigma_a")) {
    m.sigma_a = spectrum_parameter(b, o, "sigma_a", Quantity::unbounded, ConstantSpectrum{0});
    if (const double scale = o.number("scale", 1, b.report); scale != 1)
      m.sigma_a = times(b, *m.sigma_a, scale, o.origin);
    return m;
  }
  o.ignore({"scale"});
  m.eumelanin = float_parameter(b, o, "eumelanin", 1.3);
  m.pheomelanin = float_parameter(b, o, "pheomelanin", 0.2);
  for (auto* melanin : {&m.eumelanin, &m.pheomelanin})
    if (*melanin == FloatParameter{0.0f}) melanin->reset();
  if (!m.eumelanin && !m.pheomelanin) m.eumelanin = 0.0f;
  return m;
}

MaterialModel measured(Builder& b, const Object& o) {
  const std::string filename = o.text("filename", "", b.report);
  if (filename.empty()) b.report.fail("a measured material needs a \"filename\"", o.origin);
  o.ignore({"alpha_sample", "wavelength"});
  if (is_glazing(filename)) return glazing(b, o, filename);
  if (is_measured_sheet(filename)) {
    MeasuredSheetFile file = read_measured_sheet(filename);
    for (const std::string& repair : file.repairs) b.report.approximated(repair, o.origin);
    return MeasuredMaterial{filename, std::move(file.sheet)};
  }
  if (o.type == "measured_polarized") {
    b.report.approximated("what it does to polarisation is left out", o.origin);
    return MeasuredMaterial{filename};  // of another format
  }
  return TabulatedMaterial{TabulatedMaterial::Format::adaptive, filename};
}

MaterialModel nothing(Builder&, const Object&) { return InterfaceMaterial{}; }

MaterialModel polarizing(Builder& b, const Object& o) {
  b.report.dropped(fmt::format("\"{}\": light has no polarisation here, and passes it unchanged", o.type),
                   o.origin);
  for (const Property& p : o.properties) o.find(p.name);
  return InterfaceMaterial{};
}

std::vector<Id<Material>> nested(Builder& b, const Object& o, std::size_t least, std::size_t most) {
  std::vector<Id<Material>> ids;
  for (const Property* child : o.children("bsdf"))
    ids.push_back(add_material(b, *std::get<ObjectPtr>(child->value)));
  if (ids.size() < least || ids.size() > most)
    b.report.fail(fmt::format("\"{}\" needs {} nested bsdf{}, has {}", o.type, least, least == 1 ? "" : "s",
                              ids.size()),
                  o.origin);
  return ids;
}

MaterialModel mask(Builder& b, const Object& o) {
  const Id<Material> material = nested(b, o, 1, 1).front();
  return MaskMaterial{float_parameter(b, o, "opacity", 0.5), material};
}

MaterialModel blend(Builder& b, const Object& o) {
  const std::vector<Id<Material>> both = nested(b, o, 2, 2);
  BlendMaterial blend{both[0], both[1], float_parameter(b, o, "weight", 0.5)};
  if (is_darkened({blend}, b.traits, b.parts))
    b.report.approximated(
        "a blend of a mirror, a smooth interface or nothing with what spreads light to the same side is "
        "their "
        "sum: darker in Mitsuba 3.9",
        o.origin);
  return blend;
}

// 0.6's: the sum of weight·part. Weights of more than 1 in all are divided by their sum, what lacks to 1 is
// black.
MaterialModel mixture(Builder& b, const Object& o) {
  const std::vector<Id<Material>> parts = nested(b, o, 1, 64);
  const Origin& place = o.has("weights") ? o.find("weights")->origin : o.origin;
  const std::vector<double> weights =
      parse_numbers(o.text("weights", "", b.report), [&](const std::string& m) { b.report.fail(m, place); });
  if (weights.size() != parts.size() ||
      std::any_of(weights.begin(), weights.end(), [](double w) { return w < 0; }))
    b.report.fail(fmt::format("{} parts need as many \"weights\", none below 0", parts.size()), place);
  const Id<Material> black = append(b, Material{DiffuseMaterial{ConstantSpectrum{0}}});
  double sum = 0;
  BlendMaterial mixed{black, black, 0.0f};
  for (std::size_t i = 0; i <= parts.size(); ++i) {
    const double weight = i < parts.size() ? weights[i] : std::max(0.0, 1 - sum);
    if (weight == 0) continue;
    if (sum > 0) mixed.first = append(b, Material{mixed});
    sum += weight;
    mixed = {mixed.first, i < parts.size() ? parts[i] : black, static_cast<float>(weight / sum)};
  }
  return mixed;
}

struct Kind {
  std::string_view name;
  MaterialModel (*make)(Builder&, const Object&);
};
constexpr std::array<Kind, 28> kinds{{{"diffuse", diffuse},
                                      {"roughdiffuse", rough_diffuse},
                                      {"dielectric", dielectric},
                                      {"roughdielectric", dielectric},
                                      {"thindielectric", thin_dielectric},
                                      {"conductor", conductor},
                                      {"roughconductor", conductor},
                                      {"plastic", plastic},
                                      {"roughplastic", plastic},
                                      {"pplastic", plastic},
                                      {"phong", phong},
                                      {"ward", phong},
                                      {"difftrans", diffuse_transmitter},
                                      {"hk", slab},
                                      {"principled", principled},
                                      {"principledthin", principled},
                                      {"hair", hair},
                                      {"measured", measured},
                                      {"measured_polarized", measured},
                                      {"null", nothing},
                                      {"polarizer", polarizing},
                                      {"retarder", polarizing},
                                      {"circular", polarizing},
                                      {"mask", mask},
                                      {"blendbsdf", blend},
                                      {"mixturebsdf", mixture},
                                      {"lambertian", diffuse},
                                      {"mirror", conductor}}};

// Adapters change the material inside of them: they have no record of their own.
constexpr std::array adapters{"twosided", "bumpmap", "bump", "normalmap", "coating", "roughcoating"};

Material unknown(Builder& b, const Object& o) {
  std::vector<std::string> names(adapters.begin(), adapters.end());
  for (const Kind& kind : kinds) names.emplace_back(kind.name);
  const std::string closest = closest_word(o.type, names);
  b.report.approximated(fmt::format("bsdf \"{}\" is not known and becomes diffuse{}", o.type,
                                    closest.empty() ? "" : fmt::format("; did you mean \"{}\"?", closest)),
                        o.origin);
  for (const Property& p : o.properties) o.find(p.name);
  return Material{DiffuseMaterial{}};
}

Material make_material(Builder& b, const Object& o);

// The material inside of an adapter, which changes it.
Material inner(Builder& b, const Object& o) {
  const Object* bsdf = o.child("bsdf");
  if (!bsdf) b.report.fail(fmt::format("\"{}\" needs a nested bsdf", o.type), o.origin);
  return make_material(b, *bsdf);
}

// Changes the material, or where it is made of others a copy of each of them, once: the file may refer to
// them elsewhere, too, and more than once.
template <class Change>
class LeafChanger {
 public:
  LeafChanger(Builder& b, const Change& change) : b_(b), change_(change) {}

  void apply(Material& material) {
    if (auto* blend = std::get_if<BlendMaterial>(&material.model))
      copy(blend->first), copy(blend->second);
    else if (auto* mask = std::get_if<MaskMaterial>(&material.model))
      copy(mask->material);
    else if (auto* sided = std::get_if<TwoSidedMaterial>(&material.model))
      copy(sided->front), copy(sided->back);
    else
      change_(material);
  }

 private:
  void copy(Id<Material>& id) {
    if (const auto known = copies_.find(id.value); known != copies_.end()) {
      id = known->second;
      return;
    }
    const std::uint32_t original = id.value;
    Material material = b_.scene.materials.at(original);
    material.name.clear();
    apply(material);
    id = copies_[original] = append(b_, std::move(material));
  }

  Builder& b_;
  const Change& change_;
  std::unordered_map<std::uint32_t, Id<Material>> copies_;
};

template <class Change>
void change_leaves(Builder& b, Material& material, const Change& change) {
  LeafChanger(b, change).apply(material);
}

void report_mirrored_bumps(Builder& b, const Object& o) {
  b.report.approximated(
      "\"twosided\" around bumps: on the back they are turned over with the normal, not mirrored", o.origin);
}

Material two_sided(Builder& b, const Object& o) {
  const std::vector<const Property*> sides = o.children("bsdf");
  if (sides.size() == 2) {
    const std::vector<Id<Material>> ids = nested(b, o, 2, 2);
    if (b.parts[ids[1].value].bumps) report_mirrored_bumps(b, o);
    Material material{TwoSidedMaterial{ids[0], ids[1]}};
    change_leaves(b, material, [](Material& leaf) { leaf.two_sided = true; });
    return material;
  }
  Material material = inner(b, o);
  bool bumps = false;
  change_leaves(b, material, [&](Material& leaf) {
    leaf.two_sided = true;
    bumps = bumps || leaf.displacement || leaf.normal_map;
  });
  if (bumps) report_mirrored_bumps(b, o);
  material.two_sided = true;
  return material;
}

// What an adapter with bumps is around.
Material bumped(Builder& b, const Object& o) {
  Material material = inner(b, o);
  if (parts_of(material, b.parts).straight) b.bumps_of_straight.push_back(o.origin);
  return material;
}

// Of a leaf that has been given bumps.
void report_bumps(Builder& b, const Object& o, const Material& leaf) {
  for (const char* what : bumps_shown_otherwise(leaf)) b.report.approximated(what, o.origin);
}

// Whether bumps shadow, since 3.7.1.
bool has_bump_shadowing(Builder& b, const Object& o) {
  if (!o.boolean("flip_invalid_normals", true, b.report))
    b.report.approximated("normals that are turned away are never used", o.origin);
  return o.boolean("use_shadowing_function", o.type != "bump", b.report);
}

// The height of a bump map times its scale.
Material bump_map(Builder& b, const Object& o) {
  Material material = bumped(b, o);
  const double scale = o.number("scale", 1, b.report);
  const Object* texture = o.child("texture");
  if (!texture) {
    b.report.dropped("a bump map without a texture", o.origin);
    return material;
  }
  Id<Texture> height = add_texture(b, *texture, true);
  if (scale != 1) {
    b.scene.textures.push_back(
        {ProductTexture{height, ConstantSpectrum{static_cast<float>(scale)}}, true, "", o.origin});
    height = {static_cast<std::uint32_t>(b.scene.textures.size() - 1)};
  }
  const bool shadows = has_bump_shadowing(b, o);
  change_leaves(b, material, [&](Material& leaf) {
    if (leaf.displacement) b.report.dropped("a second bump map on one material", o.origin);
    leaf.displacement = height;
    leaf.bump_shadowing = shadows;
    report_bumps(b, o, leaf);
  });
  return material;
}

Material normal_map(Builder& b, const Object& o) {
  Material material = bumped(b, o);
  const Object* texture = o.child("texture");
  const bool shadows = has_bump_shadowing(b, o);
  if (!texture) {
    b.report.dropped("a normal map without a texture", o.origin);
  } else if (texture->type == "rawconstant") {
    const bool is_flat = texture->vector("value", b.report) == Vector3d{0.5, 0.5, 1};
    if (!is_flat) b.report.dropped("a normal map that is the same everywhere", texture->origin);
  } else {
    if (texture->type == "bitmap" && !texture->boolean("raw", false, b.report))
      b.report.approximated(
          "a normal map that is not raw counts as if it were: Mitsuba's rgb variants decode it, and its "
          "spectral ones refuse it",
          texture->origin);
    const Id<Texture> map = add_texture(b, *texture, false);
    change_leaves(b, material, [&](Material& leaf) {
      leaf.normal_map = map;
      leaf.bump_shadowing = shadows;
      report_bumps(b, o, leaf);
    });
  }
  return material;
}

// What light that falls from everywhere, cosine μ, leaves of itself on its way down through a layer of
// optical depth τ and index η and up again: the square of 2∫exp(−τ/μ′)μ dμ, μ′² = 1 − (1 − μ²)/η².
Spectrum absorbed_twice(const Spectrum& sigma_a, double thickness, double eta) {
  const Spectrum depth = resolved(sigma_a);
  const auto share = [&](double tau) {
    constexpr int steps = 64;
    double sum = 0;
    for (int i = 0; i < steps; ++i) {
      const double mu = (i + 0.5) / steps, below = std::sqrt(std::max(1 - (1 - mu * mu) / (eta * eta), 1e-4));
      sum += 2 * mu / steps * std::exp(-tau / below);
    }
    return sum * sum;
  };
  if (is_constant(depth))
    return ConstantSpectrum{static_cast<float>(share(thickness * evaluate(depth, lambda_min_nm)))};
  TabulatedSpectrum table;
  for (double nm = lambda_min_nm; nm <= lambda_max_nm; ++nm)
    table.values.push_back(static_cast<float>(share(thickness * evaluate(depth, nm))));
  return table;
}

// 0.6's coat knows no light that goes back and forth below it: over a Lambertian base of reflectance ρ it is
// a plastic of ρ·(1 − r), as that one divides by 1 − r for such light.
Material coated(Builder& b, const Object& o) {
  Material material = inner(b, o);
  PlasticMaterial coat;
  coat.eta = index_of(b, o, "int_ior", "bk7");
  coat.exterior_eta = index_of(b, o, "ext_ior", "air");
  coat.specular_reflectance = factor(b, o, "specular_reflectance");
  if (o.type == "roughcoating") coat.roughness = roughness_of(b, o);
  const double eta = static_cast<double>(coat.eta) / static_cast<double>(coat.exterior_eta);
  const double left = 1 - internal_reflectance(eta);
  const Spectrum sigma_a = spectrum_value(b, o, "sigma_a", Quantity::unbounded, ConstantSpectrum{0});
  const Spectrum kept = absorbed_twice(sigma_a, o.number("thickness", 1, b.report), eta);
  bool is_exact = true;
  change_leaves(b, material, [&](Material& leaf) {
    const auto* base = std::get_if<DiffuseMaterial>(&leaf.model);
    is_exact = is_exact && base && base->sigma_deg == FloatParameter{0.0f};
    if (auto* metal = std::get_if<ConductorMaterial>(&leaf.model))
      metal->reflectance_factor = times(b, metal->reflectance_factor, kept, o.origin);
    if (!base) return;
    PlasticMaterial plastic = coat;
    plastic.diffuse_reflectance =
        times(b, base->reflectance, product(kept, ConstantSpectrum{static_cast<float>(left)}), o.origin);
    leaf.model = plastic;
  });
  if (!is_exact)
    b.report.approximated("a coating of what is not Lambertian: the surface under it shows", o.origin);
  if (kept != Spectrum{ConstantSpectrum{1}})
    b.report.approximated(
        fmt::format("what a coating absorbs is that of diffuse light at every angle: {:.3g} of it "
                    "are left",
                    luminance(product(kept, NamedSpectrum{"stdillum-D65"})) /
                        luminance(NamedSpectrum{"stdillum-D65"})),
        o.origin);
  return material;
}

Material make_material(Builder& b, const Object& o) {
  Material material;
  if (o.type == "twosided") {
    material = two_sided(b, o);
  } else if (o.type == "bumpmap" || o.type == "bump") {
    material = bump_map(b, o);
  } else if (o.type == "normalmap") {
    material = normal_map(b, o);
  } else if (o.type == "coating" || o.type == "roughcoating") {
    material = coated(b, o);
  } else {
    const auto kind =
        std::find_if(kinds.begin(), kinds.end(), [&](const Kind& k) { return k.name == o.type; });
    material = kind == kinds.end() ? unknown(b, o) : Material{kind->make(b, o)};
    material.two_sided = traits_of(material, b.traits).transmits;
  }
  report_unused(o, b.report,
                {"reflectance", "diffuse_reflectance", "specular_reflectance", "alpha", "int_ior", "ext_ior",
                 "eta", "k", "material", "opacity", "weight", "base_color", "roughness"});
  material.origin = o.origin;
  return material;
}

}  // namespace

Id<Material> append(Builder& b, Material material) {
  b.traits.push_back(traits_of(material, b.traits));
  b.sided.push_back(has_sides(material, b.traits.back(), b.sided));
  b.parts.push_back(parts_of(material, b.parts));
  b.scene.materials.push_back(std::move(material));
  return {static_cast<std::uint32_t>(b.scene.materials.size() - 1)};
}

Id<Material> add_material(Builder& b, const Object& o) {
  if (const auto known = b.materials.find(&o); known != b.materials.end()) return known->second;
  const Report::Item before = b.report.begin_item({o.origin, RecordKind::material});
  Material material = make_material(b, o);
  material.name = o.id.starts_with("_unnamed_") ? "" : o.id;
  b.report.begin_item(before);
  return b.materials[&o] = append(b, std::move(material));
}

}  // namespace vitrail::mitsuba
