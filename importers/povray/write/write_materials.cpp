// SPDX-License-Identifier: Apache-2.0
#include "importers/povray/write/write_materials.h"

#include <cmath>

#include "importers/povray/write/write_patterns.h"
#include "importers/povray/write/write_pigments.h"
#include "importers/writing/export_colors.h"
#include "scene/spectra/rgb_to_spectrum.h"

namespace vitrail::povray {

namespace {

class Builder {
 public:
  Builder(Context& context, Id<Material> material)
      : context_(context),
        material_(context.scene.materials.at(material.value)),
        transmits_(context.traits[material.value].transmits),
        is_sheet_(context.sheets.contains(material.value)) {
    normal_ = bumps_of(context, material_);
  }

  Surface build() {
    Surface surface = std::visit([this](const auto& model) { return surface_of(model); }, material_.model);
    if (!material_.two_sided && surface.back.empty() && !transmits_) surface.back = "texture { Black }\n";
    return surface;
  }

 private:
  // ---- Pieces -----------------------------------------------------------------------------------

  void approximated(std::string message) { context_.approximated(std::move(message), material_.origin); }

  Pigment pigment(const SpectrumParameter& parameter) {
    return pigment_of(context_, parameter, material_.origin);
  }

  double constant(const FloatParameter& parameter, const char* what) {
    return constant_of(context_, parameter, what, material_.origin);
  }

  RGB constant_color(const SpectrumParameter& parameter, const char* what) {
    const Pigment p = pigment(parameter);
    if (p.is_constant) return p.constant * p.factor;
    approximated(fmt::format("texture of the {}: 0.5", what));
    return {0.5, 0.5, 0.5};
  }

  double index(const Spectrum& eta, const Spectrum& exterior) {
    const double outside = index_of_refraction(exterior);
    return outside > 0 ? index_of_refraction(eta) / outside : index_of_refraction(eta);
  }

  // α, and whether its slopes are Beckmann's.
  struct Facets {
    double alpha = 0;
    bool beckmann = false;
    bool are_seen() const { return alpha >= smooth_alpha; }
    double albedo() const { return are_seen() ? facet_albedo(alpha, beckmann) : 1; }
  };

  Facets facets_of(const Roughness& roughness) {
    const auto alpha = [&](const FloatParameter& parameter) {
      const double value = constant(parameter, "roughness");
      const bool is_root = roughness.square_root && std::holds_alternative<Id<Texture>>(parameter);
      return is_root ? std::sqrt(std::max(0.0, value)) : value;
    };
    const double u = alpha(roughness.alpha_u);
    const double v = roughness.alpha_v == roughness.alpha_u ? u : alpha(roughness.alpha_v);
    if (u != v)
      approximated(fmt::format("anisotropic roughness of {:.3g} and {:.3g}: the mean of the two", u, v));
    return {(u + v) / 2, roughness.distribution == Roughness::Distribution::beckmann};
  }

  // Glossy reflection by normals that vary below the size of a pixel.
  std::string rough_normal(const Facets& facets) {
    if (!facets.are_seen() || !normal_.empty()) return normal_;
    context_.has_facets = true;
    approximated(fmt::format(
        "roughness (α = {:.3g}): normals tilted at random, of the same slopes; the {:.2g} % of mirrored "
        "light that facets hide is lost at all angles alike; points show Blinn and Phong's highlights",
        facets.alpha, 100 * (1 - facets.albedo())));
    return fmt::format(" normal {{ {} }}", facet_text(facets.alpha, facets.beckmann,
                                                      1e-4 * context_.units.radius * context_.units.scale));
  }

  // What lights without extent show: the exponent n = 2/α² − 2 has the width of the microfacets.
  std::string highlight(const Facets& facets, double strength, bool metallic) {
    if (!facets.are_seen() || !context_.has_delta_lights || strength <= 0) return "";
    const double limited = std::min(facets.alpha, 0.9), squared = limited * limited;
    return fmt::format(" specular albedo {} roughness {}{}", strength, squared / (2 - 2 * squared),
                       metallic ? " metallic" : "");
  }

  std::string layer(const std::string& pigment, const std::string& finish, const std::string& normal) const {
    return fmt::format("texture {{ pigment {{ {} }}{}{} }}\n", pigment, normal,
                       finish.empty() ? "" : " finish { " + finish + " }");
  }
  std::string layer(const std::string& pigment, const std::string& finish) const {
    return layer(pigment, finish, normal_);
  }

  // A pigment of diffuse reflectance p·share, and the filters above it.
  std::string diffuse(const Pigment& p, double share = 1, const std::string& more = "") {
    const double factor = p.factor * share;
    std::string text = layer(p.text, (factor == 1 ? "" : fmt::format("diffuse {}", factor)) + more);
    for (const std::string& filter : p.filters) text += layer(filter, "diffuse 0");
    return text;
  }

  // A layer of highlights alone, whose normals are not tilted again.
  std::string shining(const std::string& highlight) const {
    return highlight.empty() ? "" : layer("rgbt 1", "diffuse 0" + highlight);
  }

  // A diffuse base under a smooth or rough interface that reflects `reflectance` · Fresnel. Light that leaves
  // the base loses what its angle reflects (conserve_energy); `share` is less for all that enters.
  Surface coated(const Pigment& base, double share, double eta, const Facets& facets, RGB reflectance) {
    const double grey = (eta - 1) * (eta - 1) / ((eta + 1) * (eta + 1));
    const std::string mirror = fmt::format("diffuse 0 reflection {{ rgb 0, {} fresnel on }} conserve_energy",
                                           color(reflectance * facets.albedo()));
    const std::string shine = highlight(facets, grey * mean(reflectance), false);
    const double leaves = 1 - diffuse_fresnel_outside(eta);
    return {diffuse(base, share / leaves) + shining(shine) + layer("rgbt 1", mirror, rough_normal(facets)),
            "", fmt::format("interior {{ ior {} }}\n", eta)};
  }

  // What one way through pbrt's coating leaves: of light that enters, and of light from a diffuse base.
  struct Passes {
    double entering = 1, diffuse = 1;
  };
  Passes passes_of(const CoatingVolume& volume) {
    const double depth = constant(volume.thickness, "thickness of a coating") *
                         (1 - mean(constant_color(volume.albedo, "albedo of a coating")));
    return {std::exp(-depth / 0.87), std::exp(-2 * depth)};
  }

  // The diffuse base, white below, that light reaches and leaves through an interface.
  Surface coated(const SpectrumParameter& reflectance, bool nonlinear, double eta, const Facets& facets,
                 RGB gloss, const Passes& passes) {
    Pigment base = pigment(reflectance);
    const double in = 1 - diffuse_fresnel_outside(eta), back = diffuse_fresnel_inside(eta);
    const double way = std::cbrt(facets.albedo()) * passes.entering;
    const double again = back * facets.albedo() * passes.diffuse * passes.diffuse;
    const auto share = [&](double rho) { return way * way * (1 - back) / (1 - std::min(rho, 1.0) * again); };
    if (!nonlinear) return coated(base, in, eta, facets, gloss);
    if (!base.is_constant) return coated(base, in * share(0.5), eta, facets, gloss);
    RGB& c = base.constant = base.constant * base.factor;
    c = {c.r * share(c.r), c.g * share(c.g), c.b * share(c.b)};
    base.text = color(c), base.factor = 1;
    return coated(base, in, eta, facets, gloss);
  }

  // ---- Models -----------------------------------------------------------------------------------

  Surface surface_of(const DiffuseMaterial& m) {
    if (m.sigma_deg != FloatParameter{0.0f}) approximated("Oren and Nayar's reflection: Lambert's");
    return {diffuse(pigment(m.reflectance)), "", ""};
  }

  Surface surface_of(const DielectricMaterial& m) {
    const double eta = index(m.eta, m.exterior_eta);
    const Facets facets = std::abs(eta - 1) < 1e-6 ? Facets{} : facets_of(m.roughness);  // 1: no interface
    const RGB reflected = constant_color(m.reflectance_factor, "factor of reflection");
    const Pigment through = pigment(m.transmittance_factor);
    if (context_.has_caustics)
      approximated("dielectric: caustics by 400,000 photons, of lamps that are rectangles alone");
    else
      approximated(
          fmt::format("dielectric: light of sources passes straight through it, without caustics and "
                      "without the {:.2g} % that a surface mirrors",
                      100 * (eta - 1) * (eta - 1) / ((eta + 1) * (eta + 1))));
    const double ratio = dispersion_ratio(m.eta);
    const bool disperses = std::abs(ratio - 1) > 1e-4;
    if (disperses) approximated("dispersion: POV-Ray's seven colours between n(700 nm) and n(400 nm)");
    const auto interior = [&](double n, double n_ratio) {
      return fmt::format("interior {{ ior {}{} }}\n", n,
                         disperses ? fmt::format(" dispersion {} dispersion_samples 7", n_ratio) : "");
    };
    const std::string finish =
        fmt::format("diffuse 0 reflection {{ rgb 0, {} fresnel on }} conserve_energy", color(reflected));
    const double passes = std::cbrt(facets.albedo());  // measured at α = .1 and .45
    if (!through.is_constant) approximated("texture of the transmitted light: clear");
    const RGB filter = through.is_constant ? through.constant * through.factor : RGB{1, 1, 1};
    const auto side = [&](double factor) {
      return layer(color(filter * (passes * factor)) + " filter 1", finish, rough_normal(facets)) +
             shining(highlight(facets, 0.04, false));
    };
    // Radiance is n² times as high within glass. POV-Ray has the same inside and outside.
    const double squared = is_sheet_ ? eta * eta : 1;
    return {side(1 / squared), is_sheet_ ? side(squared) : "", interior(eta, ratio),
            interior(1 / eta, 1 / ratio)};
  }

  Surface surface_of(const ThinDielectricMaterial& m) {
    const double eta = index(m.eta, m.exterior_eta);
    const double once = (eta - 1) * (eta - 1) / ((eta + 1) * (eta + 1));
    const double sheet = 2 * once / (1 + once);  // to and fro
    approximated(
        fmt::format("thin dielectric: reflects by Schlick's approximation; light of sources passes "
                    "without the {:.2g} % that it mirrors",
                    100 * sheet));
    const RGB reflected = constant_color(m.reflectance_factor, "factor of reflection");
    return {layer(color(constant_color(m.transmittance_factor, "factor of transmission")) + " filter 1",
                  fmt::format("diffuse 0 reflection {{ {}, {} falloff 5 }} conserve_energy",
                              color(reflected * sheet), color(reflected))),
            "", ""};
  }

  Surface conductor(const Metal& metal, const Roughness& roughness, const SpectrumParameter& factor) {
    const Facets facets = facets_of(roughness);
    const RGB tint = constant_color(factor, "factor of reflection") * facets.albedo();
    const auto* normal = std::get_if<NormalReflectance>(&metal);
    if (normal && std::holds_alternative<Id<Texture>>(normal->reflectance)) {
      const Pigment p = pigment(normal->reflectance);
      approximated("textured reflectance of a metal: POV-Ray's metallic reflection");
      return {layer(p.text,
                    fmt::format("diffuse 0 reflection {{ {} metallic }}{}", color(tint * p.factor),
                                highlight(facets, 1, true)),
                    rough_normal(facets)),
              "", ""};
    }
    const RGB facing = normal_reflectance_rgb(metal) * tint;
    if (!std::holds_alternative<PerfectReflector>(metal))
      approximated("conductor: Schlick's approximation from its colour at normal incidence");
    const std::string mirror =
        fmt::format("diffuse 0 reflection {{ {}, {} falloff 5 }}", color(facing), color(tint));
    const std::string shine = highlight(facets, 1, true), tilted = rough_normal(facets);
    if (shine.empty()) return {layer(color(facing), mirror, tilted), "", ""};
    return {layer(color(facing), "diffuse 0" + shine) + layer("rgbt 1", mirror, tilted), "", ""};
  }

  Surface surface_of(const ConductorMaterial& m) {
    return conductor(m.metal, m.roughness, m.reflectance_factor);
  }

  Surface surface_of(const PlasticMaterial& m) {
    const double eta = m.exterior_eta > 0 ? m.eta / m.exterior_eta : m.eta;
    approximated("plastic: a diffuse base of the same mean albedo under Fresnel reflection");
    return coated(m.diffuse_reflectance, m.nonlinear, eta, facets_of(m.roughness),
                  constant_color(m.specular_reflectance, "specular reflectance"), {});
  }

  Surface surface_of(const CoatedDiffuseMaterial& m) {
    const double eta = index_of_refraction(m.eta);
    approximated("coated diffuse: a diffuse base of the same mean albedo under Fresnel reflection");
    return coated(m.reflectance, true, eta, facets_of(m.roughness), {1, 1, 1}, passes_of(m.volume));
  }

  Surface surface_of(const CoatedConductorMaterial& m) {
    const double eta = index_of_refraction(m.interface_eta);
    Metal metal = m.metal;
    if (auto* index = std::get_if<ComplexIndex>(&metal))
      for (SpectrumParameter* part : {&index->eta, &index->k})
        if (const auto* spectrum = std::get_if<Spectrum>(part)) *part = scaled(resolved(*spectrum), 1 / eta);
    approximated("coated conductor: a metal of the colour that both have at normal incidence");
    const Facets facets = facets_of(m.conductor_roughness);
    const RGB both = with_interface(normal_reflectance_rgb(metal),
                                    {.eta = eta,
                                     .alpha = facets.alpha,
                                     .albedo = facets.albedo(),
                                     .interface_albedo = facets_of(m.interface_roughness).albedo(),
                                     .entering = passes_of(m.volume).entering});
    return conductor(NormalReflectance{reflectance_from_rgb(both)}, m.conductor_roughness,
                     ConstantSpectrum{1});
  }

  // POV-Ray's second diffuse amount is for light from behind.
  Surface surface_of(const DiffuseTransmissionMaterial& m) {
    Pigment p = pigment(m.reflectance);
    const double forth = mean(constant_color(m.transmittance, "transmittance"));
    const double back = p.is_constant ? mean(p.constant) : 0.5;
    approximated("diffuse transmission: light that passes has the colour of light that is reflected");
    if (back <= 0) return {layer(color(RGB{1, 1, 1}), fmt::format("diffuse 0, {}", forth * m.scale)), "", ""};
    return {layer(p.text, fmt::format("diffuse {}, {}", p.factor * m.scale, forth / back * m.scale)), "", ""};
  }

  // Plastic, glass and metal in their proportions, under a coat.
  Surface surface_of(const PrincipledMaterial& m) {
    const double rough = constant(m.roughness, "roughness");
    const Facets facets{std::max(0.001, rough * rough)};
    Roughness roughness;
    roughness.alpha_u = roughness.alpha_v = static_cast<float>(facets.alpha);
    approximated(
        "principled material: plastic, glass and metal by their amounts; its sheen, tints and "
        "flatness are left out");
    const std::string coat = clearcoat(m);
    DielectricMaterial glass{ConstantSpectrum{m.eta}, ConstantSpectrum{1}, roughness};
    glass.transmittance_factor = passes_once(m.base_color);
    Surface whole = share(
        m.spec_trans, "Glass", [&] { return plastic(m, facets); }, [&] { return surface_of(glass); });
    whole = share(
        m.metallic, "Metal", [&] { return whole; },
        [&] { return conductor(NormalReflectance{m.base_color}, roughness, ConstantSpectrum{1}); });
    whole.texture += coat;
    return whole;
  }

  // Its gloss is added to its colour.
  Surface plastic(const PrincipledMaterial& m, const Facets& facets) {
    return coated(pigment(m.base_color), 1 - diffuse_fresnel_outside(m.eta), m.eta, facets, {1, 1, 1});
  }

  // Light of the colour passes the surface twice.
  static SpectrumParameter passes_once(const SpectrumParameter& color) {
    const auto* spectrum = std::get_if<Spectrum>(&color);
    if (!spectrum) return color;
    const RGB c = factor_rgb(*spectrum);
    return reflectance_from_rgb({std::sqrt(c.r), std::sqrt(c.g), std::sqrt(c.b)});
  }

  // Burley's coat reflects F·cos²θ of its amount where its facets are small: within .002 of this.
  std::string clearcoat(const PrincipledMaterial& m) {
    if (m.clearcoat == FloatParameter{0.0f}) return "";
    const double amount = constant(m.clearcoat, "clearcoat"), gloss = constant(m.clearcoat_gloss, "gloss");
    approximated(fmt::format("clearcoat: a smooth one, which adds {:.2g} % of mirrored light", 4 * amount));
    return shining(highlight({std::lerp(0.1, 0.001, gloss)}, 0.04 * amount, false)) +
           layer("rgbt 1", fmt::format("diffuse 0 reflection {{ rgb {}, rgb {} falloff 0.4 }}", 0.04 * amount,
                                       0.012 * amount));
  }

  // The second in the proportion of `amount`; either is made where some of it shows.
  template <class First, class Second>
  Surface share(const FloatParameter& amount, const char* second_name, First&& first, Second&& second) {
    if (amount == FloatParameter{0.0f}) return first();
    if (amount == FloatParameter{1.0f}) return second();
    const auto number = static_cast<std::size_t>(&material_ - context_.scene.materials.data());
    const Surface one = first(), other = second();
    const auto both = [&](const char* side, const std::string& without, const std::string& with) {
      const std::string name = fmt::format("{}{}_{}", side, second_name, number);
      context_.functions += fmt::format("#declare Without_{0} = {1}#declare {0} = {2}", name, without, with);
      return weighted(context_, amount, "Without_" + name, name, material_.origin);
    };
    const auto or_black = [](const std::string& text) { return text.empty() ? "texture { Black }\n" : text; };
    const bool has_back = !one.back.empty() || !other.back.empty();
    return {both("", one.texture, other.texture),
            has_back ? both("Back_", or_black(one.back), or_black(other.back)) : "",
            one.interior.empty() ? other.interior : one.interior,
            one.turned.empty() ? other.turned : one.turned};
  }

  Surface opaque_instead(const char* what, double grey) {
    approximated(fmt::format("{}: diffuse, {}", what, grey));
    return {layer(color(RGB{grey, grey, grey}), ""), "", ""};
  }
  Surface surface_of(const SubsurfaceMaterial& m) {
    const auto* effective = std::get_if<SubsurfaceMaterial::Effective>(&m.interior);
    if (!effective) return opaque_instead("subsurface scattering", 0.5);
    approximated("subsurface scattering: diffuse, of its reflectance");
    return {diffuse(pigment(effective->reflectance)), "", ""};
  }
  Surface surface_of(const HairMaterial& m) {
    if (!m.color) return opaque_instead("hair", 0.2);
    approximated("hair: diffuse, of its colour");
    return {diffuse(pigment(*m.color)), "", ""};
  }
  Surface surface_of(const MeasuredMaterial& m) {
    if (!m.sheet) return opaque_instead("measured material", 0.5);
    approximated("measured glass: at every angle what it is at normal incidence");
    const SheetColors sheet = colors_at_normal(*m.sheet);
    return {layer(color(sheet.transmitted) + " filter 1",
                  fmt::format("diffuse 0 reflection {{ {} }}", color(sheet.reflected))),
            "", ""};
  }
  Surface surface_of(const TabulatedMaterial&) { return opaque_instead("tabulated material", 0.5); }
  Surface surface_of(const SlabMaterial&) {
    approximated("slab of a medium: diffuse transmission, 0.25 each way");
    return surface_of(DiffuseTransmissionMaterial{});
  }
  Surface surface_of(const FinishMaterial& m) {
    if (m.highlight != SpectrumParameter{ConstantSpectrum{1}}) approximated("tint of highlights: white");
    std::string more = m.brilliance == 1 ? "" : fmt::format(" brilliance {}", m.brilliance);
    if (m.phong > 0) more += fmt::format(" phong {} phong_size {}", m.phong, m.phong_size);
    if (m.specular > 0) more += fmt::format(" specular {} roughness {}", m.specular, m.roughness);
    return {diffuse(pigment(m.reflectance), 1, more), "", ""};
  }
  Surface surface_of(const GlazedMaterial& m) { return surface_of(m.finish); }
  Surface surface_of(const InterfaceMaterial&) { return {"texture { Clear }\n", "", ""}; }

  // ---- Made of others ---------------------------------------------------------------------------

  std::string name(Id<Material> id) { return fmt::format("Material_{}", id.value); }
  std::string interior(Id<Material> id) {
    if (const auto known = context_.interiors.find(id.value); known != context_.interiors.end())
      return known->second;
    return context_.interiors[id.value] = povray::surface_of(context_, id).interior;
  }

  Surface surface_of(const BlendMaterial& m) {
    Surface surface{weighted(context_, m.amount, name(m.first), name(m.second), material_.origin), "", ""};
    const std::string first = interior(m.first), second = interior(m.second);
    if (!first.empty() && !second.empty() && first != second)
      approximated("blend of two interiors: the first one's index of refraction");
    surface.interior = first.empty() ? second : first;
    return surface;
  }

  Surface surface_of(const MaskMaterial& m) {
    Surface surface{weighted(context_, m.opacity, "Clear", name(m.material), material_.origin), "", ""};
    surface.interior = interior(m.material);
    return surface;
  }

  Surface surface_of(const TwoSidedMaterial& m) {
    return {fmt::format("texture {{ {} }}\n", name(m.front)), fmt::format("texture {{ {} }}\n", name(m.back)),
            interior(m.front)};
  }

  Context& context_;
  const Material& material_;
  const bool transmits_, is_sheet_;
  std::string normal_;
};

}  // namespace

Surface surface_of(Context& context, Id<Material> material) { return Builder(context, material).build(); }

}  // namespace vitrail::povray
