// SPDX-License-Identifier: Apache-2.0
// The material models: exact where Mitsuba has the model, else the nearest one, which is reported.
#include <cmath>

#include "importers/mitsuba/write/coated_metal.h"
#include "importers/mitsuba/write/write_materials.h"
#include "importers/writing/coat_albedo.h"
#include "scene/models/hair_color.h"
#include "scene/spectra/color.h"
#include "scene/spectra/metal_tables.h"
#include "scene/spectra/rgb_to_spectrum.h"

namespace vitrail::mitsuba_writer {

namespace {

using ElementId = const std::string&;

bool is_smooth(const Context& context, const Roughness& r) {
  return value_of(context, r.alpha_u) == 0.0f && value_of(context, r.alpha_v) == 0.0f;
}

const char* name_of(Roughness::Distribution distribution) {
  return distribution == Roughness::Distribution::ggx ? "ggx" : "beckmann";
}

// Of light from all around, rough metals lose .5 % at α = .3, 1.6 % at .5, 8 % at 1; glass .4, 1.4 and 7 %.
void report_masking(Context& context, const Roughness& r) {
  if (r.masking != Masking::separable)
    context.approximated(
        "the height-correlated masking of its facets becomes Mitsuba's, which takes the two directions as "
        "independent: darker by 1.5 % at α .5, by 7 % at 1");
}

void add_roughness(Context& context, Element element, const Roughness& r) {
  if (is_smooth(context, r)) return;
  report_masking(context, r);
  add_string(element, "distribution", name_of(r.distribution));
  const bool textured = !value_of(context, r.alpha_u) || !value_of(context, r.alpha_v);
  if (r.square_root && textured)
    context.approximated(
        "a texture of the roughness is taken as its square root, which is not in Mitsuba: as it is");
  if (r.alpha_u == r.alpha_v) return add_parameter(context, element, "alpha", r.alpha_u);
  add_parameter(context, element, "alpha_u", r.alpha_u);
  add_parameter(context, element, "alpha_v", r.alpha_v);
}

void add_index(Context& context, Element element, const char* name, const Spectrum& eta) {
  add_float(element, name, static_cast<float>(index_of_refraction(context, eta)));
}

void write(Context& context, Element parent, ElementId id, const DiffuseMaterial& m) {
  if (value_of(context, m.sigma_deg) != 0.0f)
    context.approximated("Oren and Nayar's rough diffuse surface is not in Mitsuba: Lambert's");
  add_parameter(context, add(parent, "bsdf", "diffuse", "", id), "reflectance", m.reflectance,
                Meaning::reflectance);
}

// Mitsuba refuses rough interfaces between equal indices: light goes straight through them.
void write_no_interface(Context& context, Element parent, ElementId id, const DielectricMaterial& m,
                        float eta) {
  Element element = add(parent, "bsdf", "thindielectric", "", id);
  add_float(element, "int_ior", eta);
  add_float(element, "ext_ior", eta);
  add_parameter(context, element, "specular_transmittance", m.transmittance_factor, Meaning::unbounded);
}

void write(Context& context, Element parent, ElementId id, const DielectricMaterial& m) {
  const bool smooth = is_smooth(context, m.roughness);
  if (!smooth && is_constant(m.eta) && is_constant(m.exterior_eta) &&
      evaluate(m.eta, 550) == evaluate(m.exterior_eta, 550))
    return write_no_interface(context, parent, id, m, static_cast<float>(evaluate(m.eta, 550)));
  const char* type = smooth ? "dielectric" : "roughdielectric";
  Element element = add(parent, "bsdf", type, "", id);
  add_index(context, element, "int_ior", m.eta);
  add_index(context, element, "ext_ior", m.exterior_eta);
  add_roughness(context, element, m.roughness);
  add_parameter(context, element, "specular_reflectance", m.reflectance_factor, Meaning::unbounded);
  add_parameter(context, element, "specular_transmittance", m.transmittance_factor, Meaning::unbounded);
  if (m.priority != 0) context.dropped("its priority among overlapping interiors: Mitsuba has none");
}

void write(Context& context, Element parent, ElementId id, const ThinDielectricMaterial& m) {
  Element element = add(parent, "bsdf", "thindielectric", "", id);
  add_index(context, element, "int_ior", m.eta);
  add_index(context, element, "ext_ior", m.exterior_eta);
  add_parameter(context, element, "specular_reflectance", m.reflectance_factor, Meaning::unbounded);
  add_parameter(context, element, "specular_transmittance", m.transmittance_factor, Meaning::unbounded);
}

// "Cu" where the spectra are metal-Cu-eta and metal-Cu-k of the tables, which are Mitsuba's but for pbrt's
// brass.
std::string named_metal(const ComplexIndex& metal) {
  const auto name = [](const SpectrumParameter& value) {
    const auto* spectrum = std::get_if<Spectrum>(&value);
    const auto* named = spectrum ? std::get_if<NamedSpectrum>(spectrum) : nullptr;
    return named ? named->name : std::string();
  };
  for (const NumberTable<float>& table : metal_tables())
    if (table.name != std::string_view("CuZn") &&
        name(metal.eta) == fmt::format("metal-{}-eta", table.name) &&
        name(metal.k) == fmt::format("metal-{}-k", table.name))
      return std::string(table.name);
  return "";
}

// k of a metal with η = 1 that reflects r at normal incidence: k² = 4r/(1 − r).
double extinction(double r) {
  r = std::clamp(r, 0.0, 0.9999);
  return 2 * std::sqrt(r) / std::sqrt(1 - r);
}

void add_metal(Context& context, Element element, const NormalReflectance& metal) {
  const Spectrum r = resolved(constant_of(context, metal.reflectance, "the reflectance of a metal"));
  add_spectrum(element, "eta", ConstantSpectrum{1}, Meaning::unbounded);
  if (is_constant(r))
    return add_spectrum(element, "k", ConstantSpectrum{static_cast<float>(extinction(evaluate(r, 550)))},
                        Meaning::unbounded);
  add_spectrum(element, "k", tabulated([&](double lambda) { return extinction(evaluate(r, lambda)); }),
               Meaning::unbounded);
}

// Mitsuba 3.9's spectral variants have no number, at normal incidence, for an index of which both parts are
// 0, as they are outside of its samples. An index of nearly 0 reflects all as well.
SpectrumParameter nowhere_nothing(const ComplexIndex& metal) {
  constexpr double least = 1e-4;
  const auto *eta = std::get_if<Spectrum>(&metal.eta), *k = std::get_if<Spectrum>(&metal.k);
  if (!eta || !k || (is_constant(*eta) && is_constant(*k))) return metal.eta;
  const Spectrum real = resolved(*eta), imaginary = resolved(*k);
  const auto is_nothing = [&](double lambda) {
    return evaluate(real, lambda) == 0 && evaluate(imaginary, lambda) == 0;
  };
  bool any = false;
  for (int i = 0; i < table_size; ++i) any |= is_nothing(lambda_min_nm + i);
  if (!any) return metal.eta;
  return tabulated([&](double lambda) { return is_nothing(lambda) ? least : evaluate(real, lambda); });
}

void add_metal(Context& context, Element element, const Metal& metal) {
  std::visit(Overloaded{
                 [&](const PerfectReflector&) { add_string(element, "material", "none"); },
                 [&](const NormalReflectance& m) { add_metal(context, element, m); },
                 [&](const ComplexIndex& m) {
                   if (const std::string name = named_metal(m); !name.empty())
                     return add_string(element, "material", name);
                   add_parameter(context, element, "eta", nowhere_nothing(m), Meaning::unbounded);
                   add_parameter(context, element, "k", m.k, Meaning::unbounded);
                 },
             },
             metal);
}

void write(Context& context, Element parent, ElementId id, const ConductorMaterial& m) {
  const char* type = is_smooth(context, m.roughness) ? "conductor" : "roughconductor";
  Element element = add(parent, "bsdf", type, "", id);
  add_metal(context, element, m.metal);
  add_roughness(context, element, m.roughness);
  add_parameter(context, element, "specular_reflectance", m.reflectance_factor, Meaning::unbounded);
}

// Mitsuba's plastic asks its textures for their means, which those that read attributes of meshes do not
// know.
bool reads_attribute(const Context& context, const SpectrumParameter& value) {
  const auto* id = std::get_if<Id<Texture>>(&value);
  if (!id || value_of(context, value)) return false;
  const TextureModel& model = context.scene.textures[id->value].model;
  const auto either = [&](const auto& a, const auto& b) {
    return reads_attribute(context, a) || reads_attribute(context, b);
  };
  if (const auto* board = std::get_if<CheckerboardTexture>(&model)) return either(board->even, board->odd);
  if (const auto* product = std::get_if<ProductTexture>(&model))
    return either(product->first, product->second);
  if (const auto* blend = std::get_if<MixTexture>(&model)) return either(blend->first, blend->second);
  return std::holds_alternative<MeshAttributeTexture>(model);
}

void add_averaged(Context& context, Element element, const char* name, const SpectrumParameter& value,
                  Meaning meaning) {
  if (!reads_attribute(context, value)) return add_parameter(context, element, name, value, meaning);
  add_spectrum(element, name, constant_of(context, value, "plastic whose colour is an attribute of a mesh"),
               meaning);
}

void write(Context& context, Element parent, ElementId id, const PlasticMaterial& m) {
  const bool smooth = is_smooth(context, m.roughness);
  // Which Mitsuba refuses: a coat that nobody sees.
  if (!smooth && m.eta == m.exterior_eta)
    return write(context, parent, id, DiffuseMaterial{.reflectance = m.diffuse_reflectance});
  Element element = add(parent, "bsdf", smooth ? "plastic" : "roughplastic", "", id);
  add_averaged(context, element, "diffuse_reflectance", m.diffuse_reflectance, Meaning::reflectance);
  add_averaged(context, element, "specular_reflectance", m.specular_reflectance, Meaning::unbounded);
  add_float(element, "int_ior", m.eta);
  add_float(element, "ext_ior", m.exterior_eta);
  add_boolean(element, "nonlinear", m.nonlinear);
  if (smooth) return;
  const float u = constant_of(context, m.roughness.alpha_u, "the roughness of plastic"),
              v = constant_of(context, m.roughness.alpha_v, "the roughness of plastic");
  if (u != v) context.approximated("Mitsuba's plastic has no direction of roughness: the geometric mean");
  report_masking(context, m.roughness);
  add_string(element, "distribution", name_of(m.roughness.distribution));
  add_float(element, "alpha", u == v ? u : std::sqrt(u * v));
}

void write(Context& context, Element parent, ElementId id, const CoatedDiffuseMaterial& m) {
  context.approximated(
      "coateddiffuse is written as nonlinear plastic: the light between coating and base is summed in closed "
      "form, "
      "without thickness, absorption or scattering in between");
  const float eta = static_cast<float>(index_of_refraction(context, m.eta));
  write(context, parent, id, PlasticMaterial{m.reflectance, ConstantSpectrum{1}, eta, 1, m.roughness, true});
}

// Below a coat of index n a facet's tilt turns what it mirrors n times as far, as seen from outside.
FloatParameter seen_through(Context& context, const FloatParameter& alpha, double eta) {
  const auto value = value_of(context, alpha);
  return value ? FloatParameter{static_cast<float>(std::min(1.0, static_cast<double>(*value) * eta))} : alpha;
}

void write(Context& context, Element parent, ElementId id, const CoatedConductorMaterial& m) {
  ConductorMaterial conductor;
  const auto share = coated_share(context, m.metal, m.interface_eta);
  if (share) conductor.reflectance_factor = *share;
  context.approximated(
      share ? "coatedconductor is written without its coating, as a metal of its mean reflectance"
            : "coatedconductor is written without its coating");
  conductor.metal = m.metal;
  conductor.roughness = m.conductor_roughness;
  const double eta = std::max(1.0, evaluate(resolved(m.interface_eta), 550));
  conductor.roughness.alpha_u = seen_through(context, m.conductor_roughness.alpha_u, eta);
  conductor.roughness.alpha_v = seen_through(context, m.conductor_roughness.alpha_v, eta);
  write(context, parent, id, conductor);
}

// Mitsuba's thin sheet: base_color/π · (1 − diff_trans/2) is reflected and base_color/π · diff_trans/2 goes
// through.
void write(Context& context, Element parent, ElementId id, const DiffuseTransmissionMaterial& m) {
  const RGB r = color_of(constant_of(context, m.reflectance, "the reflectance of a thin sheet")),
            t = color_of(constant_of(context, m.transmittance, "the transmittance of a thin sheet"));
  const double scale = static_cast<double>(m.scale);
  const RGB sum{(r.r + t.r) * scale, (r.g + t.g) * scale, (r.b + t.b) * scale};
  const double both = srgb_to_xyz({r.r + t.r, r.g + t.g, r.b + t.b}).y;
  const double through = both > 0 ? srgb_to_xyz(t).y / both : 0;
  context.approximated(
      "diffuse transmission is written as principledthin: one colour, the sum, for both sides, and Disney's "
      "diffuse lobe, which darkens towards grazing angles");
  if (const double most = std::max({sum.r, sum.g, sum.b}); most > 1.0001)
    context.approximated(fmt::format(
        "diffuse transmission that gives back {:.3g} of the light: Mitsuba's gives back 1 at most", most));
  PrincipledMaterial sheet{.base_color = reflectance_from_rgb(sum)};
  sheet.roughness = 0.5f;
  sheet.diff_trans = static_cast<float>(2 * through);
  sheet.eta = 1.001f;  // next to no reflection on the surface; Mitsuba refuses 1
  sheet.thin = true;
  write_model(context, parent, {sheet}, id);
}

void write(Context& context, Element parent, ElementId id, const PrincipledMaterial& m) {
  if (m.below && has_base(m))
    context.approximated(
        "the base of glTF's model is written as principled: 3 to 7 % brighter, 20 % at grazing angles");
  if (mitsuba::is_tinted(m))
    context.approximated(
        "tints of the base colour are by its luminance: Mitsuba's spectral variants take that of each "
        "sample's few "
        "wavelengths");
  Element element = add(parent, "bsdf", m.thin ? "principledthin" : "principled", "", id);
  const auto parameter = [&](const char* name, const auto& value) {
    add_parameter(context, element, name, value);
  };
  add_parameter(context, element, "base_color", m.base_color, Meaning::reflectance);
  parameter("roughness", m.roughness);
  parameter("anisotropic", m.anisotropic);
  parameter("spec_trans", m.spec_trans);
  parameter("spec_tint", m.spec_tint);
  parameter("sheen", m.sheen);
  parameter("sheen_tint", m.sheen_tint);
  parameter("flatness", m.flatness);
  add_float(element, "eta", m.eta);
  if (m.thin) return parameter("diff_trans", m.diff_trans);
  parameter("metallic", m.metallic);
  parameter("clearcoat", m.clearcoat);
  parameter("clearcoat_gloss", m.clearcoat_gloss);
}

void write(Context& context, Element parent, ElementId id, const SubsurfaceMaterial& m) {
  context.approximated(
      "subsurface scattering is written as a dielectric boundary around a homogeneous medium: closed "
      "surfaces, and "
      "an integrator for media, are needed");
  write(context, parent, id, DielectricMaterial{.eta = m.eta, .roughness = m.roughness});
}

// The absorption that gives hair of azimuthal roughness β the colour c.
Spectrum hair_absorption(RGB c, double beta) {
  const auto absorption = [&](double component) {
    const double root = std::log(std::clamp(component, 1e-4, 1.0)) / hair_color_scale(beta);
    return root * root;
  };
  return unbounded_from_rgb({absorption(c.r), absorption(c.g), absorption(c.b)});
}

void write(Context& context, Element parent, ElementId id, const HairMaterial& m) {
  Element element = add(parent, "bsdf", "hair", "", id);
  add_float(element, "int_ior", m.eta);
  add_float(element, "ext_ior", m.exterior_eta);
  const float beta_n = constant_of(context, m.beta_n, "the roughness of hair");
  add_float(element, "longitudinal_roughness", constant_of(context, m.beta_m, "the roughness of hair"));
  add_float(element, "azimuthal_roughness", beta_n);
  add_float(element, "scale_tilt", constant_of(context, m.alpha_deg, "the tilt of hair"));
  if (m.sigma_a) return add_parameter(context, element, "sigma_a", *m.sigma_a, Meaning::unbounded);
  if (m.color) {
    context.approximated("the colour of hair is written as the absorption that leads to it");
    const RGB color = color_of(constant_of(context, *m.color, "the colour of hair"));
    return add_spectrum(element, "sigma_a", hair_absorption(color, static_cast<double>(beta_n)),
                        Meaning::unbounded);
  }
  const auto melanin = [&](const std::optional<FloatParameter>& p) {
    return constant_of(context, p.value_or(0.0f), "the melanin of hair");
  };
  add_float(element, "eumelanin", melanin(m.eumelanin));
  add_float(element, "pheomelanin", melanin(m.pheomelanin));
}

void write(Context& context, Element parent, ElementId id, const MeasuredMaterial& m) {
  if (m.sheet)
    context.approximated("Mitsuba does not read tables of measured glass: it keeps the file's name");
  const char* const type = m.sheet ? "measured" : "measured_polarized";
  add_string(add(parent, "bsdf", type, "", id), "filename", context.relative(m.filename));
}

void write(Context& context, Element parent, ElementId id, const TabulatedMaterial& m) {
  if (m.format == TabulatedMaterial::Format::adaptive)
    return add_string(add(parent, "bsdf", "measured", "", id), "filename", context.relative(m.filename));
  context.approximated("Mitsuba reads no tables of Fourier coefficients: it becomes diffuse, 0.5");
  write(context, parent, id, DiffuseMaterial{});
}

void write(Context& context, Element parent, ElementId id, const SlabMaterial&) {
  context.approximated("Mitsuba 3 has no slab of a medium: it becomes diffuse transmission, 0.25 each way");
  write(context, parent, id, DiffuseTransmissionMaterial{});
}

void write(Context& context, Element parent, ElementId id, const FinishMaterial& m) {
  context.approximated("highlights of POV-Ray that are not normalised: it becomes diffuse");
  write(context, parent, id, DiffuseMaterial{m.reflectance});
}

void write(Context& context, Element parent, ElementId id, const GlazedMaterial& m) {
  write(context, parent, id, m.finish);
}

void write(Context&, Element parent, ElementId id, const InterfaceMaterial&) {
  add(parent, "bsdf", "null", "", id);
}

void write(Context& context, Element parent, ElementId id, const BlendMaterial& m) {
  Element element = add(parent, "bsdf", "blendbsdf", "", id);
  add_parameter(context, element, "weight", m.amount);
  add_reference(element, context.material_ids[m.first.value]);
  add_reference(element, context.material_ids[m.second.value]);
}

void write(Context& context, Element parent, ElementId id, const MaskMaterial& m) {
  Element element = add(parent, "bsdf", "mask", "", id);
  add_parameter(context, element, "opacity", m.opacity);
  add_reference(element, context.material_ids[m.material.value]);
}

void write(Context& context, Element parent, ElementId id, const TwoSidedMaterial& m) {
  const auto through = [&](Id<Material> side) { return context.traits[side.value].transmits; };
  if (through(m.front) || through(m.back)) {
    context.approximated("Mitsuba's sides must be opaque: the front's material on both");
    Element element = add(parent, "bsdf", "blendbsdf", "", id);
    add_float(element, "weight", 0.0);
    add_reference(element, context.material_ids[m.front.value]);
    return add_reference(element, context.material_ids[m.front.value]);
  }
  if (context.parts[m.back.value].bumps)
    context.approximated("Mitsuba mirrors the bumps of a back's material: here they are turned over");
  Element element = add(parent, "bsdf", "twosided", "", id);
  add_reference(element, context.material_ids[m.front.value]);
  add_reference(element, context.material_ids[m.back.value]);
}

}  // namespace

void write_model(Context& context, Element parent, const Material& material, const std::string& id) {
  std::visit([&](const auto& model) { write(context, parent, id, model); }, material.model);
}

}  // namespace vitrail::mitsuba_writer
