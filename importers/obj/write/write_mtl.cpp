// SPDX-License-Identifier: Apache-2.0
#include "importers/obj/write/write_mtl.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "importers/obj/read/obj_meshes.h"
#include "importers/obj/write/mtl_text.h"
#include "importers/writing/alike_lights.h"
#include "importers/writing/unique_names.h"
#include "scene/records/curve_uses.h"
#include "scene/shapes/deferred_mesh.h"
#include "scene/shapes/mesh_parts.h"
#include "scene/system/atomic_file.h"

namespace vitrail {

namespace {

// The text of one material.
class Writer : MtlText {
 public:
  Writer(const std::filesystem::path& file, ConversionNotes& conversion)
      : MtlText(file, conversion), scene_(conversion.scene) {}

  std::string write(const std::string& name, const Shape& shape) {
    text = fmt::format("newmtl {}\n", name);
    notes.record = RecordKind::material;
    opacity_ = shape_opacity_ = shape.opacity;
    if (const auto* of_curve = std::get_if<float>(&shape.opacity); of_curve && is_of_curves(scene_, shape))
      opacity_ = shape_opacity_ = opacity_of_wall(*of_curve);
    is_open_ = is_thin(shape.material) && encloses_nothing(scene_.meshes.at(shape.mesh.value));
    put(shape.material);
    notes.origin = shape.origin;
    if (!is_whole(opacity_)) put_opacity(scene_.materials.at(shape.material.value));
    if (shape.area_light) put(scene_.area_lights.at(shape.area_light->value));
    return text + "\n";
  }

 private:
  // ---- Pieces -----------------------------------------------------------------------------------

  double alpha_of(const Roughness& roughness) {
    const double u = constant(roughness.alpha_u, "roughness"), v = constant(roughness.alpha_v, "roughness");
    if (u != v) approximated("anisotropic roughness: the mean of the two");
    return (u + v) / 2;
  }

  bool is_thin(Id<Material> id) const {
    return std::holds_alternative<ThinDielectricMaterial>(scene_.materials.at(id.value).model);
  }
  static bool encloses_nothing(const TriangleMesh& mesh) {
    TriangleMesh storage;
    const PlacedMesh placed{&loaded(mesh, storage), {}};
    return std::ranges::none_of(parts_of(std::span(&placed, 1)), [](const MeshPart& part) {
      return part.kind == MeshPart::Kind::closed || part.kind == MeshPart::Kind::rimless;
    });
  }

  static bool is_whole(const FloatParameter& opacity) { return opacity == FloatParameter{1.0f}; }

  // Readers take an index above 1 together with d < 1 as glass.
  void coat_index(float eta) {
    const auto* opacity = std::get_if<float>(&opacity_);
    if (!opacity || *opacity >= 1) return line("Ni", eta);
    if (eta != 1.5f) approximated("index of a coat that is partly transparent: 1.5");
  }

  // Phong's exponent of the same width as microfacets of width α.
  void shininess(const Roughness& roughness) {
    const double alpha = alpha_of(roughness);
    if (roughness.distribution != Roughness::Distribution::beckmann)
      approximated("GGX microfacets: Beckmann's of the same width, or Phong's lobe");
    constexpr double smoothest = 1e6;
    if (alpha < 1e-3) approximated("smooth surface: Ns 1000000");
    line("Ns", alpha < 1e-3 ? smoothest : std::max(0.0, 2 / (alpha * alpha) - 2));
  }

  // ---- Models -----------------------------------------------------------------------------------

  void put(Id<Material> id) {
    const Material& material = scene_.materials.at(id.value);
    notes.origin = material.origin;
    std::visit([this](const auto& model) { put(model); }, material.model);
    if (!material.two_sided) approximated("one-sided material: MTL has no sides");
    if (material.displacement) {
      const auto* texture = std::get_if<Id<Texture>>(&*material.displacement);
      if (texture && !map("map_Bump", *texture, ImageUse::number, "-bm"))
        notes.dropped("displacement that is no image");
    }
    if (material.normal_map && !map("norm", *material.normal_map, ImageUse::vector, nullptr))
      notes.dropped("normal map that is no image");
  }

  void put(const DiffuseMaterial& m) {
    color("Kd", "map_Kd", m.reflectance);
    if (m.sigma_deg != FloatParameter{0.0f}) approximated("Oren and Nayar's reflection: Lambert's");
  }

  void put_glass(double eta, const SpectrumParameter& tint, const Roughness& roughness) {
    text += "Kd 0 0 0\nKs 1 1 1\nillum 7\n";
    if (!(eta > 1)) approximated("index of refraction of 1 or less: readers take it as opaque");
    line("Ni", static_cast<float>(eta));
    const auto* factor = std::get_if<Spectrum>(&tint);
    if (!factor) approximated("texture of the transmitted light: clear");
    if (factor && *factor != Spectrum{ConstantSpectrum{1}}) line("Tf", factor_rgb(*factor));
    const double alpha = alpha_of(roughness);
    if (alpha > 0) line("Pr", std::sqrt(alpha));
  }
  void put(const DielectricMaterial& m) {
    const double eta = index_of_refraction(m.eta), outside = index_of_refraction(m.exterior_eta);
    if (!is_constant(m.eta)) approximated("dispersion: the index at 587.6 nm");
    if (m.reflectance_factor != SpectrumParameter{ConstantSpectrum{1}}) notes.dropped("factor of reflection");
    put_glass(outside > 0 ? eta / outside : eta, m.transmittance_factor, m.roughness);
  }
  void put(const ThinDielectricMaterial& m) {
    if (!is_open_) approximated("thin dielectric: glass, which is solid where its surface is closed");
    const double eta = index_of_refraction(m.eta), outside = index_of_refraction(m.exterior_eta);
    if (m.reflectance_factor != SpectrumParameter{ConstantSpectrum{1}}) notes.dropped("factor of reflection");
    put_glass(outside > 0 ? eta / outside : eta, m.transmittance_factor, {});
  }

  void put_metal(const Metal& metal, const Roughness& roughness) {
    text += "Kd 0 0 0\nillum 3\n";
    const auto* normal = std::get_if<NormalReflectance>(&metal);
    if (normal) {
      color("Ks", "map_Ks", normal->reflectance);
    } else {
      approximated("conductor: by its colour at normal incidence");
      line("Ks", normal_reflectance_rgb(metal));
    }
    shininess(roughness);
  }
  void put(const ConductorMaterial& m) {
    if (m.reflectance_factor != SpectrumParameter{ConstantSpectrum{1}})
      notes.dropped("factor of a conductor's reflection");
    put_metal(m.metal, m.roughness);
  }
  void put(const CoatedConductorMaterial& m) {
    approximated("coated conductor: without its coating");
    put_metal(m.metal, m.conductor_roughness);
  }

  void put(const PlasticMaterial& m) {
    color("Kd", "map_Kd", m.diffuse_reflectance);
    color("Ks", "map_Ks", m.specular_reflectance);
    coat_index(m.exterior_eta > 0 ? m.eta / m.exterior_eta : m.eta);
    shininess(m.roughness);
    if (m.nonlinear) approximated("shift of colour below a coat: without it");
  }
  void put(const CoatedDiffuseMaterial& m) {
    approximated("coated diffuse: its two layers");
    color("Kd", "map_Kd", m.reflectance);
    text += "Ks 1 1 1\n";
    coat_index(static_cast<float>(index_of_refraction(m.eta)));
    shininess(m.roughness);
  }
  void put(const DiffuseTransmissionMaterial& m) {
    approximated("diffuse transmission: reflection only");
    color("Kd", "map_Kd", m.reflectance, factor_rgb, m.scale);
  }

  void put(const PrincipledMaterial& m) {
    color("Kd", "map_Kd", m.base_color);
    number("Pr", "map_Pr", m.roughness);
    number("Pm", "map_Pm", m.metallic);
    number("Ps", "map_Ps", m.sheen);
    if (m.clearcoat != FloatParameter{0.0f}) {
      number("Pc", nullptr, m.clearcoat);
      line("Pcr", static_cast<float>(1 - constant(m.clearcoat_gloss, "gloss of the clearcoat")));
    }
    if (m.anisotropic != FloatParameter{0.0f}) number("aniso", nullptr, m.anisotropic);
    coat_index(m.eta);
    for (const auto& [parameter, what] : {std::pair{&m.spec_trans, "transmission"},
                                          {&m.spec_tint, "tint of the reflection"},
                                          {&m.sheen_tint, "tint of the sheen"},
                                          {&m.flatness, "flatness"},
                                          {&m.diff_trans, "diffuse transmission"}})
      if (*parameter != FloatParameter{0.0f}) notes.dropped(fmt::format("{} of a principled material", what));
  }

  void put_grey(const char* what, double grey) {
    approximated(fmt::format("{}: diffuse, {}", what, grey));
    line("Kd", RGB{grey, grey, grey});
  }
  void put(const SubsurfaceMaterial& m) {
    const auto* effective = std::get_if<SubsurfaceMaterial::Effective>(&m.interior);
    if (!effective) return put_grey("subsurface scattering", 0.5);
    approximated("subsurface scattering: diffuse, of its reflectance");
    color("Kd", "map_Kd", effective->reflectance);
  }
  void put(const HairMaterial& m) {
    if (!m.color) return put_grey("hair", 0.2);
    approximated("hair: diffuse, of its colour");
    color("Kd", "map_Kd", *m.color);
  }
  void put(const MeasuredMaterial&) { put_grey("measured material", 0.5); }
  void put(const TabulatedMaterial&) { put_grey("tabulated material", 0.5); }
  void put(const SlabMaterial&) { put_grey("slab of a medium", 0.5); }
  void put(const FinishMaterial& m) {
    approximated("highlights of POV-Ray that are not normalised: diffuse");
    color("Kd", "map_Kd", m.reflectance);
  }
  void put(const GlazedMaterial& m) { put(m.finish); }
  void put(const InterfaceMaterial&) { text += "Kd 0 0 0\nd 0\n"; }

  void put(const BlendMaterial& m) {
    const bool second = constant(m.amount, "amount of a blend") > 0.5;
    approximated(fmt::format("blend of materials: the {} alone", second ? "second" : "first"));
    put_part(second ? m.second : m.first);
  }
  void put(const TwoSidedMaterial& m) {
    approximated("two-sided material: its front");
    put_part(m.front);
  }
  // What is there of the shape is multiplied by what its material leaves of it.
  void put(const MaskMaterial& m) {
    const auto *own = std::get_if<float>(&m.opacity), *of_shape = std::get_if<float>(&opacity_);
    if (own && of_shape) {
      opacity_ = *own * *of_shape;
    } else if (is_whole(opacity_)) {
      opacity_ = m.opacity;
    } else if (!is_whole(m.opacity)) {
      approximated("two opacities of which one is a texture: the shape's alone");
    }
    put_part(m.material);
  }
  void put_opacity(const Material& material) {
    if (const auto* mask = std::get_if<MaskMaterial>(&material.model))
      return put_opacity(scene_.materials.at(mask->material.value));
    if (std::holds_alternative<InterfaceMaterial>(material.model)) return;
    if (std::holds_alternative<DielectricMaterial>(material.model))
      return approximated("glass of which a part is not there: all of it");
    number("d", "map_d", opacity_);
  }
  void put_part(Id<Material> id) {
    const Origin outer = notes.origin;
    put(id);
    notes.origin = outer;
  }

  // ---- Emission ---------------------------------------------------------------------------------

  // MTL's opacity leaves the light of a surface alone.
  float shining_share() {
    const auto* share = std::get_if<float>(&shape_opacity_);
    if (!share) approximated("light of a surface of which a texture says what is there: all of it shines");
    if (share && *share == 0) approximated("a light that nothing meets: it is seen");
    return share && *share > 0 ? *share : 1;
  }

  void put(const AreaLight& light) {
    notes.origin = light.origin;
    notes.record = RecordKind::area_light;
    color("Ke", "map_Ke", light.radiance, emission_rgb, light.scale * shining_share());
    if (!light.two_sided) approximated("one-sided light: shines from both sides, since MTL has none");
    if (light.directional) approximated("light along the normal only: shines in all directions");
  }

  const Scene& scene_;
  bool is_open_ = false;  // the shape: readers take its glass as thin
  FloatParameter shape_opacity_ = 1.0f;
  FloatParameter opacity_ = 1.0f;  // with that of its material
};

// One line without blanks at its ends.
std::string cleaned(std::string name) {
  std::ranges::replace_if(
      name, [](char c) { return static_cast<unsigned char>(c) < ' '; }, '_');
  const auto begin = name.find_first_not_of(' ');
  return begin == std::string::npos ? "" : name.substr(begin, name.find_last_not_of(' ') - begin + 1);
}

// Diffuse by the colours of its mesh's vertices, and nothing else.
bool is_vertex_coloured(const Scene& scene, const Shape& shape) {
  const Material& material = scene.materials.at(shape.material.value);
  const auto* diffuse = std::get_if<DiffuseMaterial>(&material.model);
  const auto* texture = diffuse ? std::get_if<Id<Texture>>(&diffuse->reflectance) : nullptr;
  if (!texture || diffuse->sigma_deg != FloatParameter{0.0f} || !material.two_sided ||
      material.displacement || material.normal_map || shape.area_light ||
      shape.opacity != FloatParameter{1.0f})
    return false;
  const auto* colors = std::get_if<MeshAttributeTexture>(&scene.textures.at(texture->value).model);
  return colors && *colors == MeshAttributeTexture{std::string(obj::vertex_color)} &&
         vertex_colors(scene.meshes.at(shape.mesh.value));
}

// One that differs in the names of its light alone.
MtlNames::const_iterator same_surface(const Scene& scene, const MtlKey& key, const MtlNames& names) {
  const auto& [material, light, opacity] = key;
  if (!light) return names.end();
  for (auto at = names.lower_bound({material, std::nullopt, {}}); at != names.end(); ++at) {
    const auto& [its_material, its_light, its_opacity] = at->first;
    if (its_material != material) break;
    if (its_light && its_opacity == opacity &&
        shine_alike(scene.area_lights.at(*its_light), scene.area_lights.at(*light)))
      return at;
  }
  return names.end();
}

}  // namespace

const MeshAttribute* vertex_colors(const TriangleMesh& mesh) {
  const auto found = std::ranges::find_if(mesh.attributes, [&](const MeshAttribute& a) {
    return a.name == obj::vertex_color && !a.per_face && a.channels == 3 &&
           a.values.size() == 3 * mesh.positions.size();
  });
  return found == mesh.attributes.end() ? nullptr : &*found;
}

MtlNames write_mtl(const std::vector<FlatShape>& shapes, const std::filesystem::path& path,
                   ConversionNotes& notes) {
  MtlNames names;
  UniqueNames taken;
  std::string text;
  Writer writer(path, notes);
  for (const FlatShape& flat : shapes) {
    const MtlKey key = surface_key(flat.shape);
    if (names.contains(key)) continue;
    if (const auto alike = same_surface(notes.scene, key, names); alike != names.end()) {
      names.emplace(key, alike->second);
      continue;
    }
    std::string name = cleaned(notes.scene.materials.at(std::get<0>(key)).name);
    if (name.empty()) name = fmt::format("material_{}", std::get<0>(key));
    name = taken.take(name);
    if (!is_vertex_coloured(notes.scene, flat.shape)) text += writer.write(name, flat.shape);
    names.emplace(key, name);
  }
  AtomicFile file(path);
  file.write(std::as_bytes(std::span(text)));
  file.commit_part();
  return names;
}

}  // namespace vitrail
