// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <array>
#include <cmath>
#include <optional>

#include "images/image_files.h"
#include "importers/pbrt/write/write_images.h"
#include "importers/pbrt/write/writer.h"
#include "importers/reading/glazing_material.h"
#include "importers/writing/coat_albedo.h"
#include "importers/writing/export_colors.h"
#include "scene/records/material_traits.h"

namespace vitrail::pbrt {

namespace {

bool is_one(const SpectrumParameter& p) {
  const auto* s = std::get_if<Spectrum>(&p);
  return s && is_constant(*s) && evaluate(*s, lambda_min_nm) == 1;
}

float mean(const FloatParameter& p) {
  const auto* value = std::get_if<float>(&p);
  return value ? *value : 0.5f;
}

// Writes the parameters of one material and gives its type.
class MaterialWriter {
 public:
  MaterialWriter(Parameters& p, std::size_t index) : p_(p), index_(index) {}

  const char* operator()(const DiffuseMaterial& m) {
    if (m.sigma_deg != FloatParameter{0.0f})
      p_.approximated("sigma (Oren-Nayar roughness) becomes 0: pbrt-v4 has none");
    p_.albedo("reflectance", m.reflectance);
    return "diffuse";
  }
  const char* operator()(const DielectricMaterial& m) {
    relative_index(m.eta, m.exterior_eta);
    roughness(m.roughness);
    factors(m.reflectance_factor, m.transmittance_factor, 2);
    if (m.priority != 0) p_.dropped("its priority among overlapping interiors: pbrt has none");
    return "dielectric";
  }
  const char* operator()(const ThinDielectricMaterial& m) {
    relative_index(m.eta, m.exterior_eta);
    factors(m.reflectance_factor, m.transmittance_factor, 1);
    return "thindielectric";
  }
  const char* operator()(const ConductorMaterial& m) {
    const bool perfect = std::holds_alternative<PerfectReflector>(m.metal);
    if (perfect) {
      p_.approximated("a mirror becomes a metal of its reflectance at normal incidence");
      p_.albedo("reflectance", m.reflectance_factor);
    } else {
      metal(m.metal);
      if (std::holds_alternative<Id<Texture>>(m.reflectance_factor))
        p_.approximated("the texture that its reflection is multiplied by becomes 1");
    }
    roughness(m.roughness);
    return "conductor";
  }
  const char* operator()(const PlasticMaterial& m) {
    p_.approximated(is_smooth(m.roughness)
                        ? "Mitsuba's plastic becomes pbrt's layered coateddiffuse, of the same albedo"
                        : "Mitsuba's plastic becomes pbrt's layered coateddiffuse, of the same albedo but "
                          "for what rough coats "
                          "lose there: over a grey of .5, 6 % at α .1, 12 % at .3, 14 % at .5");
    if (!is_one(m.specular_reflectance)) p_.approximated("the factor of its reflection becomes 1");
    const float eta = m.eta / std::max(m.exterior_eta, 1e-3f);
    if (m.nonlinear)
      p_.albedo("reflectance", m.diffuse_reflectance);
    else
      base_below(m.diffuse_reflectance, eta, DiffuseAlbedo::of_what_gets_in);
    p_.number("eta", eta).integer("maxdepth", as_often_as_wanted);
    roughness(m.roughness, "", true);
    return "coateddiffuse";
  }
  const char* operator()(const CoatedDiffuseMaterial& m) {
    p_.albedo("reflectance", m.reflectance);
    index("eta", m.eta);
    roughness(m.roughness, "", true);
    coating(m.volume);
    return "coateddiffuse";
  }
  const char* operator()(const CoatedConductorMaterial& m) {
    metal(m.metal, "conductor.");
    index("interface.eta", m.interface_eta);
    roughness(m.conductor_roughness, "conductor.", true);
    roughness(m.interface_roughness, "interface.", true);
    coating(m.volume);
    return "coatedconductor";
  }
  const char* operator()(const DiffuseTransmissionMaterial& m) {
    p_.albedo("reflectance", m.reflectance).albedo("transmittance", m.transmittance).number("scale", m.scale);
    return "diffusetransmission";
  }
  const char* operator()(const PrincipledMaterial& m) {
    const Roughness surface = facets(m);
    if (mean(m.spec_trans) > 0.5f) {
      p_.number("eta", m.eta);
      if (m.thin) {
        p_.approximated("the principled model becomes thin glass, which is smooth in pbrt");
        return "thindielectric";
      }
      p_.approximated("the principled model becomes rough glass");
      roughness(surface);
      return "dielectric";
    }
    if (m.metallic == FloatParameter{1.0f}) {
      p_.approximated("the principled model becomes a metal of its base colour");
      return metal_part(m);
    }
    p_.approximated("the principled model becomes a coat over a base of the same albedo");
    base_below(m.base_color, m.eta, m.below ? DiffuseAlbedo::of_what_gets_in : DiffuseAlbedo::of_all);
    p_.number("eta", m.eta).integer("maxdepth", as_often_as_wanted);
    roughness(surface);
    return "coateddiffuse";
  }
  // Parts of a principled material: a mix of them scatters as it does.
  const char* diffuse_part(const PrincipledMaterial& m, double factor) {
    const auto scaled = [&](double value) { return std::min(value * factor, 1.0); };
    if (const auto* spectrum = std::get_if<Spectrum>(&m.base_color))
      p_.albedo("reflectance", changed_albedo(*spectrum, scaled));
    else
      scaled_texture(std::get<Id<Texture>>(m.base_color), factor, "-alone");
    return "diffuse";
  }
  const char* gloss_part(const PrincipledMaterial& m, double reflectance) {
    p_.albedo("reflectance", Spectrum{ConstantSpectrum{static_cast<float>(reflectance)}});
    roughness(facets(m));
    return "conductor";
  }
  const char* metal_part(const PrincipledMaterial& m) {
    p_.albedo("reflectance", m.base_color);
    roughness(facets(m));
    return "conductor";
  }
  // The greatest value of its base colour.
  double brightest(const PrincipledMaterial& m) {
    if (const auto* id = std::get_if<Id<Texture>>(&m.base_color)) return of_image(*id).greatest;
    double most = 0;
    const Spectrum values = resolved(std::get<Spectrum>(m.base_color));
    for (double l = 400; l <= 700; l += 10) most = std::max(most, evaluate(values, l));
    return most;
  }

  const char* operator()(const SubsurfaceMaterial& m) {
    if (const auto* named = std::get_if<SubsurfaceMaterial::Named>(&m.interior))
      p_.text("name", named->name);
    else if (const auto* effective = std::get_if<SubsurfaceMaterial::Effective>(&m.interior))
      p_.albedo("reflectance", effective->reflectance).spectrum("mfp", effective->mean_free_path);
    else
      p_.spectrum("sigma_a", std::get<SubsurfaceMaterial::Coefficients>(m.interior).sigma_a)
          .spectrum("sigma_s", std::get<SubsurfaceMaterial::Coefficients>(m.interior).sigma_s);
    p_.number("scale", m.scale).number("g", m.g);
    single_index(m.eta);
    roughness(m.roughness);
    return "subsurface";
  }
  const char* operator()(const HairMaterial& m) {
    if (m.sigma_a) p_.spectrum("sigma_a", *m.sigma_a);
    if (m.color) p_.albedo("reflectance", *m.color);
    if (m.eumelanin) p_.number("eumelanin", *m.eumelanin);
    if (m.pheomelanin) p_.number("pheomelanin", *m.pheomelanin);
    p_.number("eta", m.eta / std::max(m.exterior_eta, 1e-3f));
    if (m.exterior_eta != 1) p_.approximated("the index around it becomes 1, its own the ratio of the two");
    p_.number("beta_m", m.beta_m).number("beta_n", m.beta_n).number("alpha", m.alpha_deg);
    return "hair";
  }
  const char* operator()(const MeasuredMaterial& m) {
    if (m.sheet) p_.approximated("pbrt does not read tables of measured glass: it keeps the file's name");
    p_.file("filename", m.filename);
    return "measured";
  }
  const char* operator()(const TabulatedMaterial& m) {
    if (m.format == TabulatedMaterial::Format::fourier) {
      p_.approximated("pbrt-v4 reads no tables of Fourier coefficients: it becomes diffuse, 0.5");
      p_.albedo("reflectance", ConstantSpectrum{0.5f});
      return "diffuse";
    }
    p_.file("filename", m.filename);
    return "measured";
  }
  const char* operator()(const SlabMaterial&) {
    p_.approximated("pbrt has no slab of a medium: it becomes diffuse transmission, 0.25 each way");
    return "diffusetransmission";
  }
  const char* operator()(const FinishMaterial& m) {
    p_.approximated("highlights of POV-Ray that are not normalised: it becomes diffuse");
    p_.albedo("reflectance", m.reflectance);
    return "diffuse";
  }
  const char* operator()(const GlazedMaterial& m) { return (*this)(m.finish); }
  const char* operator()(const InterfaceMaterial&) { return "interface"; }
  const char* operator()(const BlendMaterial& m) {
    const std::vector<std::string>& names = p_.writer().materials;
    p_.texts("materials", {names.at(m.first.value), names.at(m.second.value)})
        .number("amount", p_.writer().amounts.at(index_));
    return "mix";
  }
  // Each is written as one of its parts (the_same_as).
  const char* operator()(const MaskMaterial&) { return nullptr; }
  const char* operator()(const TwoSidedMaterial&) { return nullptr; }

 private:
  // Of the walk below a coat: after pbrt's 10, light bases lose 5 %.
  static constexpr int as_often_as_wanted = 100;

  // The reflectance of pbrt's base; a texture as it is times a number, which is right at its mean.
  void base_below(const SpectrumParameter& albedo, float eta, DiffuseAlbedo of) {
    const auto base = [&](const auto& value) { return base_below_coat(value, static_cast<double>(eta), of); };
    if (const auto* spectrum = std::get_if<Spectrum>(&albedo))
      return void(p_.albedo("reflectance", base(*spectrum)));
    const Id<Texture> id = std::get<Id<Texture>>(albedo);
    const double mean = of_image(id).mean, factor = mean > 0 ? base(mean) / mean : 1;
    if (factor == 1) return void(p_.albedo("reflectance", albedo));
    p_.approximated("the texture of its colour is brightened by what is right at its mean");
    scaled_texture(id, factor, "-below");
  }
  void scaled_texture(Id<Texture> id, double factor, const char* suffix) {
    Writer& w = p_.writer();
    const std::string inner = w.textures.at(id.value), name = Writer::add_name(w.textures, inner + suffix);
    w.line(fmt::format("Texture {} \"spectrum\" \"scale\" \"texture tex\" {} \"float scale\" {}",
                       in_quotes(name), in_quotes(inner), static_cast<float>(factor)));
    p_.texture("reflectance", name);
  }
  struct ImageValues {
    double mean, greatest;
  };
  // The luminance and the greatest number of an image; 0.5 and 1 of what is none, or cannot be read.
  ImageValues of_image(Id<Texture> id) {
    try {
      if (const auto tinted = tinted_image(p_.writer().scene, id)) {
        const Image image =
            texture_values(tinted->image, read_stored_image(tinted->image.filename), ImageUse::color);
        double sum = 0, greatest = 0;
        for (const float value : image.values) {
          sum += static_cast<double>(value);
          greatest = std::max(greatest, static_cast<double>(value));
        }
        return {sum / static_cast<double>(std::max<std::size_t>(image.values.size(), 1)) *
                    srgb_to_xyz(tinted->tint).y,
                greatest * std::max({tinted->tint.r, tinted->tint.g, tinted->tint.b})};
      }
    } catch (const Error&) {
    }
    return {0.5, 1};
  }
  static Roughness facets(const PrincipledMaterial& m) {
    return {.alpha_u = squared(m.roughness), .alpha_v = squared(m.roughness), .masking = Masking::correlated};
  }
  static FloatParameter squared(const FloatParameter& roughness) {
    const auto* value = std::get_if<float>(&roughness);
    return value ? FloatParameter{*value * *value} : roughness;
  }
  void index(const std::string& name, const Spectrum& eta) {
    if (const auto* constant = std::get_if<ConstantSpectrum>(&eta))
      p_.number(name, constant->value);
    else
      p_.spectrum(name, eta);
  }
  void single_index(const Spectrum& eta) {
    if (!is_constant(eta))
      p_.approximated("dispersion: pbrt takes one index of refraction here, at 587.6 nm");
    p_.number("eta", static_cast<float>(index_of_refraction(eta)));
  }
  void relative_index(const Spectrum& eta, const Spectrum& exterior) {
    if (exterior == Spectrum{ConstantSpectrum{1}}) return index("eta", eta);
    p_.approximated("the index of refraction around it becomes 1, its own the ratio of the two");
    if (is_constant(eta) && is_constant(exterior)) {
      const double outside = evaluate(exterior, lambda_min_nm);
      p_.number("eta", static_cast<float>(evaluate(eta, lambda_min_nm) / (outside > 0 ? outside : 1)));
      return;
    }
    const Spectrum inside = resolved(eta), outside = resolved(exterior);
    TabulatedSpectrum ratio;
    for (double l = lambda_min_nm; l <= lambda_max_nm; ++l)
      ratio.values.push_back(static_cast<float>(evaluate(inside, l) / std::max(1e-3, evaluate(outside, l))));
    p_.spectrum("eta", Spectrum{ratio});
  }
  // `faces`: through how many of them light goes that gets through.
  void factors(const SpectrumParameter& reflectance, const SpectrumParameter& transmittance, int faces) {
    if (!is_one(reflectance)) p_.approximated("the factor of its reflection becomes 1: pbrt has none");
    if (is_one(transmittance) || p_.writer().tinted.contains(static_cast<std::uint32_t>(index_))) return;
    const auto* tint = std::get_if<Spectrum>(&transmittance);
    const double left = tint ? std::pow(luminance(*tint), faces) : 0;
    p_.approximated(
        "the factor of its transmission becomes 1: pbrt has none" +
        (left > 0 ? fmt::format("; what goes through is brighter by about {:.0f} %", 100 * (1 / left - 1))
                  : std::string()));
  }
  void metal(const Metal& metal, const std::string& prefix = "") {
    if (const auto* index = std::get_if<ComplexIndex>(&metal)) {
      p_.spectrum(prefix + "eta", index->eta).spectrum(prefix + "k", index->k);
    } else if (const auto* normal = std::get_if<NormalReflectance>(&metal)) {
      p_.albedo("reflectance", normal->reflectance);
    } else {
      p_.approximated("a mirror becomes a metal that reflects all at normal incidence");
      p_.albedo("reflectance", Spectrum{ConstantSpectrum{1}});
    }
  }
  void roughness(const Roughness& r, const std::string& prefix = "", bool in_layers = false) {
    const bool rough = !is_smooth(r);
    if (rough && r.distribution == Roughness::Distribution::beckmann)
      p_.approximated("Beckmann's distribution of facets becomes GGX");
    if (rough && r.masking != Masking::correlated && !in_layers)
      p_.approximated(
          "the masking of its facets, which takes the two directions as independent, becomes pbrt's "
          "height-correlated one: brighter by 1.5 % at α .5, by 7 % at 1");
    const auto put = [&](const std::string& name, const FloatParameter& alpha) {
      const auto* value = std::get_if<float>(&alpha);
      p_.number(prefix + name, value && r.square_root ? FloatParameter{*value * *value} : alpha);
    };
    if (r.alpha_u == r.alpha_v)
      put("roughness", r.alpha_u);
    else
      put("uroughness", r.alpha_u), put("vroughness", r.alpha_v);
    if (remap_ && *remap_ != r.square_root)
      p_.approximated("one of two roughness textures is remapped as the other");
    if (!remap_) p_.boolean("remaproughness", r.square_root);
    remap_ = r.square_root;
  }
  void coating(const CoatingVolume& c) {
    p_.number("thickness", c.thickness).number("g", c.g).albedo("albedo", c.albedo);
    p_.integer("maxdepth", c.max_depth).integer("nsamples", c.samples);
  }

  Parameters& p_;
  std::size_t index_;
  std::optional<bool> remap_;
};

void bumps(Parameters& p, const Material& m) {
  if (std::holds_alternative<InterfaceMaterial>(m.model)) return;  // nothing shows them
  if (std::holds_alternative<HairMaterial>(m.model)) {
    if (m.displacement || m.normal_map) p.dropped("bumps of hair: pbrt has none");
    return;
  }
  if (m.displacement) p.number("displacement", *m.displacement);
  if (m.bump_shadowing && (m.displacement || m.normal_map))
    p.approximated("its bumps do not shadow: pbrt has no such term");
  if (!m.normal_map) return;
  const auto file = file_for_pbrt(p, *m.normal_map, ImageUse::vector);
  if (!file) return p.dropped("a normal map that is not an image");
  p.file("normalmap", *file);
}

// Of what a metal reflects by its index, the share that is left. pbrt has no such factor: the rest is black.
float share_of_metal(Parameters& p, const Material& material) {
  const auto* metal = std::get_if<ConductorMaterial>(&material.model);
  const auto* factor = metal ? std::get_if<Spectrum>(&metal->reflectance_factor) : nullptr;
  if (!factor || std::holds_alternative<PerfectReflector>(metal->metal)) return 1;
  const RGB color = factor_rgb(*factor);
  if (color.r != color.g || color.g != color.b)
    p.approximated("the colour that its reflection is multiplied by becomes grey");
  return static_cast<float>(std::clamp(luminance(*factor), 0.0, 1.0));
}

// The material that is all that is there of one that is made of others.
std::optional<Id<Material>> the_same_as(Writer& w, std::size_t index) {
  const Material& material = w.scene.materials[index];
  if (const auto* mask = std::get_if<MaskMaterial>(&material.model)) return mask->material;
  if (const auto* sided = std::get_if<TwoSidedMaterial>(&material.model)) {
    if (sided->front != sided->back)
      w.approximated("the front's material is on both sides", material.origin, RecordKind::material);
    return sided->front;
  }
  const auto* blend = std::get_if<BlendMaterial>(&material.model);
  const auto is_gone = [&](Id<Material> part) { return w.coverage[part.value] == FloatParameter{0.0f}; };
  if (blend && is_gone(blend->first)) return blend->second;
  if (blend && is_gone(blend->second)) return blend->first;
  return std::nullopt;
}

// pbrt stops at a parameter that it does not know, unless it comes from an attribute: so it has thin glass
// there.
void write_glazing(Writer& w, std::size_t index, const std::string& file) {
  const Material& material = w.scene.materials[index];
  Parameters p(w, fmt::format("material \"{}\"", w.materials[index]), material.origin, RecordKind::material);
  p.approximated("pbrt has a sheet of clear glass here: it does not know the glazing");
  p.file("glazing", file);
  w.begin("AttributeBegin");
  w.line(fmt::format("Attribute \"material\"{}", p.list()));
  w.line(
      fmt::format("MakeNamedMaterial {} \"string type\" \"thindielectric\"", in_quotes(w.materials[index])));
  w.end("AttributeEnd");
}

void write_named(Writer& w, std::string_view name, const char* type, const Parameters& p) {
  w.line(fmt::format("MakeNamedMaterial {} \"string type\" \"{}\"{}", in_quotes(name), type, p.list()));
}

const std::string& black(Writer& w) {
  if (w.black.empty()) {
    w.black = Writer::add_name(w.materials, "black");
    write_named(
        w, w.black, "diffuse",
        Parameters(w, "", {}, RecordKind::material).albedo("reflectance", Spectrum{ConstantSpectrum{0}}));
  }
  return w.black;
}

void write_material(Writer& w, std::size_t index, const char* type, Parameters& p) {
  const float share = share_of_metal(p, w.scene.materials[index]);
  if (share == 1) return write_named(w, w.materials[index], type, p);
  const std::string name = w.materials[index], whole = Writer::add_name(w.materials, name + "-whole");
  write_named(w, whole, type, p);
  Parameters parts(w, "", {}, RecordKind::material);
  parts.texts("materials", {black(w), whole}).number("amount", share);
  write_named(w, name, "mix", parts);
}

// Whether a principled material is written as a mix: not glass, nor a whole metal, nor as smooth as a coat
// that loses little.
bool is_mixed(const PrincipledMaterial& m) {
  constexpr float smooth = 0.2f;
  const auto* roughness = std::get_if<float>(&m.roughness);
  const bool is_coat = m.metallic == FloatParameter{0.0f} && roughness && *roughness <= smooth;
  return mean(m.spec_trans) <= 0.5f && m.metallic != FloatParameter{1.0f} && !is_coat;
}

// What of a principled material is left out.
void note_left_out(Parameters& p, const PrincipledMaterial& m) {
  std::string names;
  const auto add = [&](const char* name, const FloatParameter& amount) {
    if (amount != FloatParameter{0.0f}) names += (names.empty() ? "" : ", ") + std::string(name);
  };
  add("sheen", m.sheen), add("clearcoat", m.clearcoat), add("anisotropy", m.anisotropic);
  add("tint of the reflection", m.spec_tint), add("flatness", m.flatness);
  add("diffuse transmission", m.diff_trans);
  if (mean(m.spec_trans) <= 0.5f) add("transmission", m.spec_trans);
  if (!names.empty()) p.dropped(names + " of the principled model");
}

// Diffuse reflection, and a metal of few per cent for its gloss: pbrt's rough coats lose light, 18 % at
// roughness .5 and 57 % at 1 over a grey base. The share of the gloss is what the base colour leaves room
// for.
void write_principled(Writer& w, std::size_t index, const PrincipledMaterial& m) {
  const Material& material = w.scene.materials[index];
  const std::string name = w.materials[index], owner = fmt::format("material \"{}\"", name);
  Parameters whole(w, owner, material.origin, RecordKind::material);
  whole.approximated(
      "the principled model becomes a mix of diffuse, gloss and metal: of as much light within 5 %");
  note_left_out(whole, m);
  if (!material.two_sided)
    whole.approximated("its back, which is black in the scene, shows as its front does");
  const auto part = [&](const char* suffix, auto&& write) {
    std::string part_name = Writer::add_name(w.materials, name + suffix);
    Parameters p(w, owner, material.origin, RecordKind::material);
    MaterialWriter writer(p, index);
    const char* type = write(writer);
    bumps(p, material);
    write_named(w, part_name, type, p);
    return part_name;
  };
  const auto mix = [&](const std::string& mixed, const std::string& first, const std::string& second,
                       const FloatParameter& amount) {
    Parameters p(w, owner, material.origin, RecordKind::material);
    p.texts("materials", {first, second}).number("amount", amount);
    write_named(w, mixed, "mix", p);
  };
  const bool has_metal = m.metallic != FloatParameter{0.0f};
  const double eta = std::max(1.0, static_cast<double>(m.eta)),
               normal = (eta - 1) / (eta + 1) * (eta - 1) / (eta + 1);
  constexpr double least = 0.1, most = 0.5;
  const double share = std::clamp(1 - MaterialWriter(whole, index).brightest(m), least, most);
  const double gets_in = m.below ? 1 - normal : 1;
  const std::string diffuse =
      part("-diffuse", [&](MaterialWriter& writer) { return writer.diffuse_part(m, gets_in / (1 - share)); });
  const std::string gloss = part(
      "-gloss", [&](MaterialWriter& writer) { return writer.gloss_part(m, std::min(normal / share, 1.0)); });
  const std::string plain = has_metal ? Writer::add_name(w.materials, name + "-plain") : name;
  mix(plain, diffuse, gloss, static_cast<float>(share));
  if (has_metal)
    mix(name, plain, part("-metal", [&](MaterialWriter& writer) { return writer.metal_part(m); }),
        m.metallic);
}

}  // namespace

void write_materials(Writer& w) {
  const std::vector<bool> sides = sides_of_glazing(w.scene);
  const std::vector<MaterialTraits> traits = traits_of(w.scene.materials);
  for (std::size_t i = 0; i < w.scene.materials.size(); ++i) {
    const Material& material = w.scene.materials[i];
    if (sides[i]) continue;
    if (const std::string file = glazing_file_of(w.scene.materials, i); !file.empty()) {
      write_glazing(w, i, file);
      continue;
    }
    const auto* principled = std::get_if<PrincipledMaterial>(&material.model);
    if (principled && is_mixed(*principled)) {
      write_principled(w, i, *principled);
      continue;
    }
    Parameters p(w, fmt::format("material \"{}\"", w.materials[i]), material.origin, RecordKind::material);
    if (principled) note_left_out(p, *principled);
    const bool is_made = is_made_of_others(material);
    if (is_made && (material.displacement || material.normal_map))
      p.dropped("bumps of a material that is made of others, which have their own");
    if (const auto part = the_same_as(w, i)) {
      w.materials[i] = w.materials.at(part->value);
      continue;
    }
    MaterialWriter writer(p, i);
    const char* type = std::visit(writer, material.model);
    if (!material.two_sided && !traits[i].transmits)
      p.approximated("its back, which is black in the scene, shows as its front does");
    if (!is_made) bumps(p, material);
    write_material(w, i, type, p);
  }
}

}  // namespace vitrail::pbrt
