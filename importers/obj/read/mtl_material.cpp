// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <functional>

#include "importers/bytes/text_cursor.h"
#include "importers/obj/read/mtl.h"
#include "scene/spectra/rgb_to_spectrum.h"

namespace vitrail {

namespace {

template <class T>
Id<T> append(std::vector<T>& to, T value) {
  to.push_back(std::move(value));
  return {static_cast<std::uint32_t>(to.size() - 1)};
}

template <class... Parts>
std::size_t hash_of(const Parts&... parts) {
  std::size_t hash = 0;
  ((hash = (hash ^ std::hash<Parts>{}(parts)) * 0x9e3779b97f4a7c15u), ...);
  return hash ^ hash >> 32;
}

bool is_black(const std::optional<RGB>& c) { return !c || std::max({c->r, c->g, c->b}) <= 0; }
bool is_grey(RGB c) { return c.r == c.g && c.g == c.b; }

class Builder {
 public:
  Builder(const MtlMaterial& mtl, MtlTextures& textures, Scene& scene, Diagnostics& diagnostics)
      : mtl_(mtl),
        textures_(textures),
        scene_(scene),
        diagnostics_(diagnostics),
        origin_(origin_of(mtl.location)) {}

  MtlSurface build() {
    Material material;
    material.model = model();
    material.origin = origin_;
    if (const MtlMap* map = find("bump"))
      material.displacement = number(*map, map->gain * map->bump_multiplier, ImageNumber::luminance);
    if (const MtlMap* map = find("norm")) material.normal_map = color(*map, 1, Encoding::linear);
    material = masked(std::move(material));
    material.name = printable(mtl_.name, longest_mtl_name);
    const Id<Material> id = append(scene_.materials, std::move(material));
    return {id, light()};
  }

 private:
  void note(Fidelity fidelity, std::string message) {
    diagnostics_.push_back(
        {fidelity, std::move(message), mtl_.location, mtl_.location, RecordKind::material});
  }

  Origin origin_of(const SourceLocation& where) {
    const auto file = std::ranges::find(scene_.files, where.file);
    const auto index = static_cast<std::uint32_t>(file - scene_.files.begin());
    if (file == scene_.files.end()) scene_.files.push_back(where.file);
    return {index, static_cast<std::uint32_t>(where.line), static_cast<std::uint32_t>(where.column)};
  }

  // ---- Textures ---------------------------------------------------------------------------------

  const MtlMap* find(const char* keyword) const {
    const auto map = mtl_.maps.find(keyword);
    return map == mtl_.maps.end() ? nullptr : &map->second;
  }

  // `hash`: of some of it.
  Id<Texture> add_texture(TextureModel model, bool is_float, std::size_t hash) {
    const Texture wanted{std::move(model), is_float, "", origin_};
    const auto [begin, end] = textures_.equal_range(hash);
    for (auto known = begin; known != end; ++known)
      if (scene_.textures[known->second.value] == wanted) return known->second;
    return textures_.emplace(hash, append(scene_.textures, wanted))->second;
  }

  static ImageTexture image(const MtlMap& map, float scale, Encoding encoding) {
    ImageTexture texture;
    texture.filename = map.filename;
    texture.mapping = map.mapping;
    texture.wrap = map.wrap;
    texture.encoding = encoding;
    texture.scale = scale;
    return texture;
  }
  static std::size_t hash_of_image(const MtlMap& map, float scale) {
    const UvMapping& m = map.mapping;
    return hash_of(map.filename, scale, m.a, m.c, m.e, m.f);
  }
  Id<Texture> color(const MtlMap& map, float scale, Encoding encoding = Encoding::automatic) {
    return add_texture(image(map, scale, encoding), false, hash_of_image(map, scale));
  }
  Id<Texture> number(const MtlMap& map, float scale, ImageNumber otherwise) {
    ImageTexture values = image(map, scale, Encoding::linear);
    values.number = map.number.value_or(otherwise);
    return add_texture(std::move(values), true, hash_of_image(map, scale));
  }

  // The image times the colour, which may be black or missing where programs leave it to the image.
  SpectrumParameter product(const MtlMap& map, const std::optional<RGB>& factor) {
    if (is_black(factor)) return color(map, map.gain);
    if (is_grey(*factor)) return color(map, static_cast<float>(map.gain * factor->r));
    const Id<Texture> image = color(map, map.gain);
    return add_texture(ProductTexture{Spectrum{unbounded_from_rgb(*factor)}, image}, false,
                       hash_of(image.value, factor->r, factor->g, factor->b));
  }

  FloatParameter number(const char* keyword, double constant) {
    if (const MtlMap* map = find(keyword)) return number(*map, map->gain, ImageNumber::luminance);
    return static_cast<float>(constant);
  }

  SpectrumParameter reflectance(const char* keyword, const char* map_keyword, std::optional<RGB> color) {
    if (color &&
        (std::min({color->r, color->g, color->b}) < 0 || std::max({color->r, color->g, color->b}) > 1)) {
      note(Fidelity::approximated,
           fmt::format("{} {} {} {} is clamped to 0 … 1", keyword, color->r, color->g, color->b));
      color =
          RGB{std::clamp(color->r, 0.0, 1.0), std::clamp(color->g, 0.0, 1.0), std::clamp(color->b, 0.0, 1.0)};
    }
    if (const MtlMap* map = find(map_keyword)) return product(*map, color);
    return reflectance_from_rgb(color.value_or(RGB{}));
  }

  SpectrumParameter kd() { return reflectance("Kd", "map_Kd", mtl_.kd); }
  SpectrumParameter ks() { return reflectance("Ks", "map_Ks", mtl_.ks); }

  // ---- Models -----------------------------------------------------------------------------------

  double opacity() const {
    if (mtl_.d) return *mtl_.d;
    return mtl_.tr && !is_opaque_by_tr() ? 1 - *mtl_.tr : 1;
  }

  // "Tr 1" alone. MeshLab, OpenMVS and others have written it for what is opaque: Tr was never in the
  // format's specification, and 1 − d came later. Whoever means "not seen at all" does not export it.
  bool is_opaque_by_tr() const { return mtl_.tr && *mtl_.tr >= 1 && !mtl_.d && !(mtl_.ni && *mtl_.ni > 1); }

  bool is_glass() const {
    const bool by_illum = mtl_.illum == 4 || mtl_.illum == 6 || mtl_.illum == 7 || mtl_.illum == 9;
    return (opacity() < 1 || by_illum) && mtl_.ni && *mtl_.ni > 1;
  }

  bool is_physically_based() const {
    return mtl_.pr || mtl_.pm || mtl_.ps || mtl_.pc || mtl_.pcr || mtl_.aniso || find("map_Pr") ||
           find("map_Pm") || find("map_Ps");
  }

  // Blender's "PBR Extensions" are all of these, for every material. Tf is there only where something is
  // transmitted: its mean is Blender's weight of transmission.
  bool is_of_blender() const {
    return mtl_.pr && mtl_.pm && mtl_.ps && mtl_.pc && mtl_.pcr && mtl_.aniso && mtl_.tf;
  }

  // Phong's exponent as the width of microfacets.
  float alpha() {
    const double exponent = mtl_.ns.value_or(1);
    if (exponent < 0) note(Fidelity::approximated, "negative Ns counts as 0");
    return static_cast<float>(std::sqrt(2 / (std::max(0.0, exponent) + 2)));
  }

  float eta_of_coat() const { return mtl_.ni && *mtl_.ni > 1 ? static_cast<float>(*mtl_.ni) : 1.5f; }

  MaterialModel model() {
    const bool glass = is_glass();
    if (mtl_.d && mtl_.tr && *mtl_.d != 1 - *mtl_.tr) note(Fidelity::dropped, "Tr: its d says otherwise");
    if (is_opaque_by_tr())
      note(Fidelity::approximated, "Tr 1 without d: taken as opaque, as MeshLab means it");
    if (mtl_.tf && !glass && !is_of_blender() && *mtl_.tf != RGB{1, 1, 1})
      note(Fidelity::dropped, "Tf of a material that is not glass");
    if (glass) return dielectric();
    if (opacity() <= 0 && !find("map_d")) return InterfaceMaterial{};
    if (is_physically_based()) return principled();
    if (mtl_.illum == 0)
      note(Fidelity::approximated, "illum 0, an unlit colour: taken as diffuse reflectance");
    if (is_shiny()) return shiny();
    if (mtl_.illum > 2)
      note(Fidelity::approximated,
           fmt::format("illum {}: taken as diffuse, for want of Ks or Ni", mtl_.illum));
    return DiffuseMaterial{kd()};
  }

  bool is_shiny() const { return mtl_.illum >= 2 && (!is_black(mtl_.ks) || find("map_Ks")); }

  MaterialModel dielectric() {
    DielectricMaterial material;
    material.eta = ConstantSpectrum{static_cast<float>(*mtl_.ni)};
    if (mtl_.tf && *mtl_.tf != RGB{1, 1, 1}) material.transmittance_factor = unbounded_from_rgb(*mtl_.tf);
    if (mtl_.pr)
      material.roughness.alpha_u = material.roughness.alpha_v = static_cast<float>(*mtl_.pr * *mtl_.pr);
    if (find("map_Kd")) note(Fidelity::dropped, "map_Kd of glass");
    note_what_glass_ignores();
    return material;
  }

  // Programs write these of glass as of anything: black, white and 1 say nothing.
  void note_what_glass_ignores() {
    std::string words;
    const auto add = [&](const char* word) { words += (words.empty() ? "" : ", ") + std::string(word); };
    if (!is_black(mtl_.kd)) add("Kd");
    if (mtl_.ks && *mtl_.ks != RGB{1, 1, 1}) add("Ks");
    if (opacity() < 1) add(mtl_.d ? "d" : "Tr");
    if (!words.empty())
      note(Fidelity::dropped,
           fmt::format("{} of glass: its Ni and Tf say what it reflects and lets through", words));
  }

  MaterialModel principled() {
    PrincipledMaterial material;
    material.base_color = kd();
    material.roughness = number("map_Pr", mtl_.pr ? *mtl_.pr : std::sqrt(alpha()));
    material.metallic = number("map_Pm", mtl_.pm.value_or(0));
    material.sheen = number("map_Ps", mtl_.ps.value_or(0));
    material.clearcoat = static_cast<float>(mtl_.pc.value_or(0));
    material.clearcoat_gloss = static_cast<float>(mtl_.pc ? 1 - mtl_.pcr.value_or(0) : 0);
    material.anisotropic = static_cast<float>(mtl_.aniso.value_or(0));
    if (is_of_blender())
      material.spec_trans =
          static_cast<float>(std::clamp((mtl_.tf->r + mtl_.tf->g + mtl_.tf->b) / 3.0, 0., 1.));
    material.eta = eta_of_coat();
    return material;
  }

  // Not where both together would reflect more than comes: there Ks is a highlight.
  bool is_mostly_mirror() const {
    const auto greatest = [](const std::optional<RGB>& c) { return c ? std::max({c->r, c->g, c->b}) : 0; };
    return is_black(mtl_.kd) ||
           (greatest(mtl_.ks) >= 2 * greatest(mtl_.kd) && greatest(mtl_.ks) + greatest(mtl_.kd) <= 1);
  }

  MaterialModel shiny() {
    Roughness roughness;
    roughness.alpha_u = roughness.alpha_v = alpha();
    roughness.distribution = Roughness::Distribution::beckmann;
    const bool reflects = mtl_.illum == 3 || mtl_.illum == 5;
    if (reflects && is_mostly_mirror() && !find("map_Kd")) {
      note(Fidelity::approximated, is_black(mtl_.kd)
                                       ? "Ks and Ns: a metal of that reflectance"
                                       : "Ks and Ns: a metal of that reflectance, without its Kd");
      return ConductorMaterial{NormalReflectance{ks()}, roughness};
    }
    note(Fidelity::approximated, "Ks and Ns: the Fresnel reflection of a coat, times Ks");
    PlasticMaterial material;
    material.diffuse_reflectance = kd();
    material.specular_reflectance = ks();
    material.eta = eta_of_coat();
    material.exterior_eta = 1;
    material.roughness = roughness;
    return material;
  }

  // ---- Around the model -------------------------------------------------------------------------

  Material masked(Material inner) {
    const MtlMap* const map = find("map_d");
    if (is_glass() && map) note(Fidelity::dropped, "map_d of glass");
    if (is_glass() || std::holds_alternative<InterfaceMaterial>(inner.model)) return inner;
    if (!map && opacity() >= 1) return inner;
    MaskMaterial mask;
    mask.opacity = static_cast<float>(std::max(0.0, opacity()));
    if (map) {
      const double scale = opacity() > 0 && opacity() < 1 ? opacity() : 1;
      mask.opacity = number(*map, static_cast<float>(map->gain * scale), ImageNumber::alpha_or_luminance);
    }
    mask.material = append(scene_.materials, std::move(inner));
    Material outer;
    outer.model = mask;
    outer.origin = origin_;
    return outer;
  }

  std::optional<Id<AreaLight>> light() {
    const MtlMap* const map = find("map_Ke");
    const RGB ke = mtl_.ke.value_or(RGB{});
    if (std::min({ke.r, ke.g, ke.b}) < 0) note(Fidelity::approximated, "negative Ke counts as 0");
    if (is_black(mtl_.ke) && !map) return {};
    AreaLight light;
    light.two_sided = true;
    light.origin = origin_;
    if (map) {
      light.radiance = product(*map, mtl_.ke);
    } else {
      light.radiance = Spectrum{emission_from_rgb(ke)};
    }
    return append(scene_.area_lights, std::move(light));
  }

  const MtlMaterial& mtl_;
  MtlTextures& textures_;
  Scene& scene_;
  Diagnostics& diagnostics_;
  Origin origin_;
};

}  // namespace

MtlSurface add_mtl_material(const MtlMaterial& material, MtlTextures& textures, Scene& scene,
                            Diagnostics& diagnostics) {
  return Builder(material, textures, scene, diagnostics).build();
}

}  // namespace vitrail
