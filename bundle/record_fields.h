// SPDX-License-Identifier: Apache-2.0
// This file has the fields of the records of materials.bin, lights.bin and domains.bin for a writer, a reader
// or a checker. They are those of scene/records/fields.h, but where bundles leave some out. `io` is called
// with every number, and with every Id; its type is of this namespace, so that all overloads are found.
// Names, origins and the colours that sigmoids were fitted to are left out: they serve to write scenes.
#pragma once

#include <optional>
#include <stdexcept>
#include <string>
#include <utility>
#include <variant>
#include <vector>

#include "bundle/byte_stream.h"
#include "bundle/manifest.h"
#include "scene/records/fields.h"

namespace vitrail::records {

template <class IO>
constexpr bool reads = std::decay_t<IO>::reads;

// ---- Building blocks, declared first: they call each other

template <class... Alternatives>
void fields(auto& io, std::variant<Alternatives...>& v);
template <class... Alternatives>
void fields(auto& io, const std::variant<Alternatives...>& v);
template <class... Alternatives>
void set_kind(auto& io, std::variant<Alternatives...>& v, int index);
template <class T>
void fields(auto& io, std::vector<T>& value);
template <class T>
void fields(auto& io, const std::vector<T>& value);
template <class T>
void fields(auto& io, std::optional<T>& value);
template <class T>
void fields(auto& io, const std::optional<T>& value);

template <Number T>
requires(!Is<T, bool>) void fields(auto& io, T& value) { io(value); }

void fields(auto& io, Is<bool> auto& value) {
  auto byte = static_cast<std::uint8_t>(value);
  io(byte);
  if constexpr (reads<decltype(io)>) value = byte != 0;
}

// It is the greatest value of each enumeration.
template <class E>
inline constexpr E last_of = E{};
template <>
inline constexpr auto last_of<TabulatedMaterial::Format> = TabulatedMaterial::Format::fourier;
template <>
inline constexpr auto last_of<QuadricKind> = QuadricKind::curve;
template <>
inline constexpr auto last_of<QuadricUv> = QuadricUv::mitsuba;
template <>
inline constexpr auto last_of<Wrap> = Wrap::black;
template <>
inline constexpr auto last_of<GridEdge> = GridEdge::zero;
template <>
inline constexpr auto last_of<NoiseTexture::Kind> = NoiseTexture::Kind::marble;
template <>
inline constexpr auto last_of<PatternTexture::Kind> = PatternTexture::Kind::formula;
template <>
inline constexpr auto last_of<NoiseGenerator> = NoiseGenerator::corrected;
template <>
inline constexpr auto last_of<PatternTexture::Wave> = PatternTexture::Wave::poly;
template <>
inline constexpr auto last_of<PatternStep::Op> = PatternStep::Op::fractal;
template <>
inline constexpr auto last_of<PatternFractal::Kind> = PatternFractal::Kind::magnet2;
template <>
inline constexpr auto last_of<PatternFractal::Color> = PatternFractal::Color::modulus;
template <>
inline constexpr auto last_of<TextureFilter> = TextureFilter::anisotropic;
template <>
inline constexpr auto last_of<SphericalCamera::Projection> = SphericalCamera::Projection::latitude_longitude;
template <>
inline constexpr auto last_of<WideCamera::Projection> = WideCamera::Projection::lying_cylinder;
template <>
inline constexpr auto last_of<SpotLight::Falloff> = SpotLight::Falloff::linear;
template <>
inline constexpr auto last_of<EnvironmentLight::Projection> =
    EnvironmentLight::Projection::latitude_longitude;

template <class E>
requires std::is_enum_v<E>
void fields(auto& io, E& value) {
  auto byte = static_cast<std::uint8_t>(value);
  io(byte);
  if constexpr (reads<decltype(io)>) {
    if (byte > static_cast<std::uint8_t>(last_of<E>)) io.stream.fail("a record has an unknown choice");
    value = static_cast<E>(byte);
  }
}

template <class T>
void fields(auto& io, Id<T>& id) {
  io(id);
}
template <class T>
void fields(auto& io, const Id<T>& id) {
  io(id);
}

void fields(auto& io, Is<std::string> auto& text) {
  if constexpr (reads<decltype(io)>)
    text.resize(io.stream.get_count(1));
  else
    io(static_cast<std::uint64_t>(text.size()));
  for (auto& c : text) io(c);
}

// These are points and vectors of two or three dimensions, and colours.
template <class V>
requires requires(V v) { v.x, v.y; }
void fields(auto& io, V& v) {
  io(v.x), io(v.y);
  if constexpr (requires { v.z; }) io(v.z);
}

template <class T, std::size_t n>
void fields(auto& io, std::array<T, n>& values) {
  for (T& value : values) fields(io, value);
}
template <class T, std::size_t n>
void fields(auto& io, const std::array<T, n>& values) {
  for (const T& value : values) fields(io, value);
}

// A list is its length in 8 bytes, then its records, of at least so many bytes each.
template <std::size_t least_bytes = 1, class List>
void list(auto& io, List& records) {
  if constexpr (reads<decltype(io)>)
    records.resize(io.stream.get_count(least_bytes));
  else
    io(static_cast<std::uint64_t>(records.size()));
  for (auto& record : records) fields(io, record);
}

void fields(auto& io, Is<Transform> auto& t) { fields(io, t.m); }
template <class T>
void fields(auto& io, Bounds3<T>& b) {
  fields(io, b.lower), fields(io, b.upper);
}
template <class T>
void fields(auto& io, const Bounds3<T>& b) {
  fields(io, b.lower), fields(io, b.upper);
}
void fields(auto&, Is<std::monostate> auto&) {}

// ---- Spectra

void fields(auto& io, Is<ConstantSpectrum> auto& s) { io(s.value); }
// c2 is ±∞ for the constants 1 and 0.
void fields(auto& io, Is<SigmoidSpectrum> auto& s) { io(s.c0), io(s.c1), io.may_be_infinite(s.c2); }
void fields(auto& io, Is<RgbIlluminantSpectrum> auto& s) { fields(io, s.shape), io(s.scale); }
void fields(auto& io, Is<RgbUnboundedSpectrum> auto& s) { fields(io, s.shape), io(s.scale); }
void fields(auto& io, Is<TabulatedSpectrum> auto& s) {
  if constexpr (reads<decltype(io)>) s.values.resize(table_size);
  if (s.values.size() != table_size) throw std::logic_error("a tabulated spectrum has 471 values");
  for (auto& value : s.values) io(value);
}
void fields(auto& io, Is<SellmeierSpectrum> auto& s) { fields(io, s.b), fields(io, s.c_um2); }
// These are resolved before they come here.
template <class T>
concept Unresolved = Is<T, BlackbodySpectrum> || Is<T, NamedSpectrum>;
void fields(auto& io, Unresolved auto&) {
  if constexpr (reads<decltype(io)>) io.stream.fail("a spectrum is not resolved");
  throw std::logic_error("a bundle takes resolved spectra");
}

// ---- Records as they are listed

// Bundles have other fields of these records than scene/records/fields.h.
template <class T>
concept Reduced = IsOneOf<T, ImageTexture, PtexTexture, PatternTexture, Roughness, SubsurfaceMaterial,
                          MeasuredMaterial, TabulatedMaterial, AreaLight, PointLight, SpotLight,
                          GoniometricLight, EnvironmentLight, SkyLight>;
template <HasFields T>
requires(!Reduced<T>) void fields(auto& io, T& record) {
  visit_fields(record, [&](auto&... field) { (fields(io, field), ...); });
}

// ---- Textures

inline constexpr std::size_t least_pattern_bytes = 256;

// The content of its file is final: encoding, scale and inversion are applied.
void fields(auto& io, Is<ImageTexture> auto& t) {
  fields(io, t.filename), fields(io, t.mapping), fields(io, t.wrap), fields(io, t.filter);
}
// A bundle has an image or a mean in place of it.
void fields(auto& io, Is<PtexTexture> auto&) {
  if constexpr (reads<decltype(io)>) io.stream.fail("a texture is not baked");
  throw std::logic_error("a bundle takes baked textures");
}
// The kind of a pattern has 128 added where it is looked up by (u,v).
void pattern_kind(auto& io, Is<PatternTexture> auto& t) {
  constexpr std::uint8_t by_uv = 128;
  auto byte = static_cast<std::uint8_t>(static_cast<std::uint8_t>(t.kind) | (t.by_uv ? by_uv : 0));
  io(byte);
  if constexpr (reads<decltype(io)>) {
    t.by_uv = (byte & by_uv) != 0;
    byte = static_cast<std::uint8_t>(byte & ~by_uv);
    if (byte > static_cast<std::uint8_t>(last_of<PatternTexture::Kind>))
      io.stream.fail("a record has an unknown choice");
    t.kind = static_cast<PatternTexture::Kind>(byte);
  }
}
// Only those of the feature `formulas` have a formula. Patterns in it have none: a file cannot nest them.
void plain_fields(auto& io, Is<PatternTexture> auto& t) {
  visit_fields(t, [&](auto&, auto&... field) { pattern_kind(io, t), (fields(io, field), ...); });
}
void fields(auto& io, Is<PatternTexture> auto& t) {
  plain_fields(io, t);
  if (t.kind != PatternTexture::Kind::formula) return;
  list(io, t.steps), list(io, t.fractals);
  if constexpr (reads<decltype(io)>)
    t.patterns.resize(io.stream.get_count(least_pattern_bytes));
  else
    io(static_cast<std::uint64_t>(t.patterns.size()));
  for (auto& pattern : t.patterns) plain_fields(io, pattern);
}
void fields(auto& io, Is<Texture> auto& t) { fields(io, t.model), fields(io, t.is_float); }

// ---- Materials

// The distribution is the lowest bit of its byte, and masking the next one, which only those of the feature
// `masking` have.
void facets(auto& io, Is<Roughness> auto& r) {
  auto byte = static_cast<std::uint8_t>(static_cast<int>(r.distribution) | static_cast<int>(r.masking) << 1);
  io(byte);
  if constexpr (reads<decltype(io)>) {
    if (byte > 3) io.stream.fail("a record has an unknown choice");
    r.distribution = Roughness::Distribution{static_cast<std::uint8_t>(byte & 1)};
    r.masking = Masking{static_cast<std::uint8_t>(byte >> 1)};
  }
}
void fields(auto& io, Is<Roughness> auto& r) {
  fields(io, r.alpha_u), fields(io, r.alpha_v), facets(io, r), fields(io, r.square_root);
}
void fields(auto& io, Is<MeasuredSheet> auto& s) {
  list(io, s.wavelengths_nm), list(io, s.cosines), list(io, s.reflectance), list(io, s.transmittance);
}
void fields(auto& io, Is<MeasuredMaterial> auto& m) { fields(io, m.sheet); }
void fields(auto& io, Is<TabulatedMaterial> auto& m) { fields(io, m.format), fields(io, m.table); }
// Other materials stand for these in a bundle.
template <class T>
concept Replaced = Is<T, SubsurfaceMaterial>;
void fields(auto& io, Replaced auto&) {
  if constexpr (reads<decltype(io)>) io.stream.fail("a material is of a kind that bundles do not have");
  throw std::logic_error("a bundle does not take this material");
}
void fields(auto& io, Is<Surface> auto& s) {
  io(s.first_triangle), io(s.material), io(s.area_light), io(s.interior), io(s.exterior);
  fields(io, s.opacity);
}

void fields(auto& io, Is<FourierTable> auto& t) {
  io(t.eta), io(t.channels), list(io, t.mu), list(io, t.first), list(io, t.orders), list(io, t.coefficients);
}
void fields(auto& io, Is<SquareTable> auto& t) { io(t.rows), io(t.columns), list(io, t.values); }
void fields(auto& io, Is<AdaptiveTable> auto& t) {
  list(io, t.phi_i), list(io, t.theta_i), list(io, t.wavelengths_nm);
  for (auto* square : {&t.normals, &t.projected_area, &t.visible_normals, &t.luminance, &t.spectra})
    fields(io, *square);
  fields(io, t.normalised);
}

// ---- Media

void fields(auto& io, Is<Grid> auto& g) {
  io(g.nx), io(g.ny), io(g.nz), io(g.channels), list(io, g.values);
  fields(io, g.bounds), fields(io, g.edge);
}
void fields(auto& io, Is<AbsorptionScattering> auto& c) { fields(io, c.sigma_a), fields(io, c.sigma_s); }
void fields(auto& io, Is<ExtinctionAlbedo> auto& c) { fields(io, c.sigma_t), fields(io, c.albedo); }
template <class T>
concept Unknown = Is<T, NamedMedium> || Is<T, CloudDensity>;
void fields(auto& io, Unknown auto&) {
  if constexpr (reads<decltype(io)>) io.stream.fail("a medium is of a kind that bundles do not have");
  throw std::logic_error("a bundle does not take this medium");
}
// A byte says whether there is an emission_scale; its next bits only media of the features `veils` and
// `temperatures` have, and those that fade.
void fields(auto& io, Is<Medium> auto& m) {
  fields(io, m.coefficients), io(m.scale), fields(io, m.density), fields(io, m.emission);
  auto byte = static_cast<std::uint8_t>(m.emission_scale.has_value() | m.veils << 1 |
                                        m.temperature.has_value() << 2 | m.fade.has_value() << 3);
  io(byte);
  if constexpr (reads<decltype(io)>) {
    m.veils = byte & 2;
    if (byte & 1) m.emission_scale.emplace();
    if (byte & 4) m.temperature.emplace();
    if (byte & 8) m.fade.emplace();
  }
  if (m.emission_scale) fields(io, *m.emission_scale);
  if (m.temperature) fields(io, *m.temperature), io(m.temperature_scale), io(m.temperature_offset);
  if (m.fade) io(m.fade->distance), io(m.fade->power), fields(io, m.fade->color);
  io(m.g), fields(io, m.medium_to_world);
}

// ---- Lights

// The lowest bit of a byte is `directional`. The next one, `!sampled`, is set only in bundles of the feature
// `glows`.
void fields(auto& io, Is<AreaLight> auto& l) {
  fields(io, l.radiance), fields(io, l.scale), fields(io, l.two_sided);
  auto byte = static_cast<std::uint8_t>(l.directional | !l.sampled << 1);
  io(byte);
  if constexpr (reads<decltype(io)>) l.directional = byte & 1, l.sampled = !(byte & 2);
}
void fields(auto& io, Is<PointLight> auto& l) { fields(io, l.position), fields(io, l.intensity); }
void fields(auto& io, Is<SpotLight> auto& l) {
  fields(io, *l.light_to_world), fields(io, l.intensity), fields(io, l.beam_deg), fields(io, l.cutoff_deg);
  fields(io, l.falloff), fields(io, l.texture);
}
// Returns whether the light has fields of the feature `fadings`, which follow the fields of its kind.
bool fades(const auto& l) {
  if constexpr (requires { l.tightness; })
    return l.fading || l.tightness != 0;
  else if constexpr (requires { l.fading; })
    return l.fading.has_value();
  else
    return false;
}
void fading_fields(auto& io, auto& l) {
  if constexpr (requires { l.fading; }) fields(io, l.fading);
  if constexpr (requires { l.tightness; }) fields(io, l.tightness);
}
void fields(auto& io, Is<GoniometricLight> auto& l) {
  fields(io, *l.light_to_world), fields(io, *l.intensity), fields(io, l.filename);
  fields(io, l.latitude_longitude), fields(io, l.power);
}
void fields(auto& io, Is<EnvironmentLight> auto& l) {
  fields(io, l.filename), fields(io, *l.light_to_world), fields(io, l.projection), fields(io, *l.scale);
  fields(io, l.illuminance), fields(io, *l.portal);
}
// A byte says whether the limb is dark (1), and what follows: a distribution (2), the ground (4), a
// temperature (8). The latter three are of the feature `skies`.
void fields(auto& io, Is<SkyLight> auto& l) {
  fields(io, *l.light_to_world), fields(io, l.to_sun), fields(io, l.turbidity), fields(io, *l.albedo);
  fields(io, l.sky_scale), fields(io, l.sun_scale), fields(io, l.sun_diameter_deg);
  auto byte = static_cast<std::uint8_t>(l.limb_darkening | l.distribution->has_value() << 1 |
                                        (l.ground != 0) << 2 | (l.color_temperature_k != 0) << 3);
  io(byte);
  if constexpr (reads<decltype(io)>) {
    l.limb_darkening = byte & 1;
    if (byte & 2) l.distribution->emplace();
  }
  if (*l.distribution) fields(io, **l.distribution);
  if (byte & 4) fields(io, l.ground);
  if (byte & 8) fields(io, l.color_temperature_k);
}
// The byte is the kind. Its highest bit says whether something follows the fields; the next one says that the
// light casts no shadows (the feature `shadowless`).
void fields(auto& io, Is<Light> auto& l) {
  constexpr std::uint8_t fading = 0x80, shadowless = 0x40;
  auto kind = static_cast<std::uint8_t>(l.model.index());
  if (std::visit([](const auto& model) { return fades(model); }, l.model)) kind |= fading;
  if (!l.casts_shadows) kind |= shadowless;
  io(kind);
  if constexpr (reads<decltype(io)>) {
    set_kind(io, l.model, kind & (shadowless - 1));
    l.casts_shadows = !(kind & shadowless);
  }
  std::visit(
      [&](auto& model) {
        fields(io, model);
        if (kind & fading) fading_fields(io, model);
      },
      l.model);
}
void fields(auto& io, Is<EmissiveTriangle> auto& t) {
  for (auto& p : t.p) fields(io, p);
  for (auto& uv : t.uv) fields(io, uv);
  io(t.triangle), io(t.area_light);
}
void fields(auto& io, Is<Quadric> auto& q) {
  fields(io, q.kind), fields(io, q.uv), io(q.low), io(q.high), io(q.phi_max_rad);
}
void fields(auto& io, Is<EmissiveQuadric> auto& q) {
  fields(io, q.quadric);
  for (auto& row : q.to_bundle.m)
    for (auto& x : row) io(x);
  io(q.triangle), io(q.area_light), fields(io, q.opacity);
}
void fields(auto& io, Is<CornerValues> auto& v) {
  for (auto& vertex : v)
    for (auto& channel : vertex) io(channel);
}

// ---- Cameras: kept in the manifest

void fields(auto& io, Is<ScreenWindow> auto& s) { io(s.x0), io(s.x1), io(s.y0), io(s.y1); }
void fields(auto& io, Is<Lens> auto& l) { io(l.radius), io(l.focal_distance); }
void fields(auto& io, Is<ClipRange> auto& c) { io(c.near), io.may_be_infinite(c.far); }
template <class T>
concept Framed = Is<T, PerspectiveCamera> || Is<T, OrthographicCamera>;
void fields(auto& io, Framed auto& c) {
  fields(io, c.camera_to_world), fields(io, c.screen), fields(io, c.lens), fields(io, c.clip);
}
void fields(auto& io, Is<SphericalCamera> auto& c) {
  fields(io, c.camera_to_world), fields(io, c.projection);
}
void fields(auto& io, Is<WideCamera> auto& c) {
  fields(io, c.camera_to_world), fields(io, c.projection), io(c.across), io(c.above), io(c.edge_deg);
  fields(io, c.parallel);
}

void fields(auto& io, Is<Sensor> auto& s) { fields(io, s.position), fields(io, s.normal); }
void fields(auto& io, Is<SensorCamera> auto& c) { fields(io, c.camera_to_world), list(io, c.sensors); }

void fields(auto& io, Is<LensSurface> auto& s) {
  io(s.radius), io(s.thickness), io(s.index), io(s.aperture_radius);
}
void fields(auto& io, Is<ExitPupil> auto& p) { fields(io, p.rectangle), io(p.weight); }
void fields(auto& io, Is<RealisticCamera> auto& c) {
  fields(io, c.camera_to_world), io(c.film_diagonal), list(io, c.surfaces), list(io, c.pupils);
}

// ---- Domains and objects

inline constexpr std::size_t kd_node_bytes = 16, least_domain_bytes = 137, least_object_bytes = 50;

void fields(auto& io, Is<KdNode> auto& n) { io(n.split), io(n.axis), io(n.below), io(n.above); }
void fields(auto& io, Is<PackPlace> auto& p) { io(p.pack), io(p.offset); }
void fields(auto& io, Is<DomainInfo> auto& d) {
  io(d.triangles), io(d.pieces), io(d.bytes), io(d.hash);
  fields(io, d.tight_bounds), fields(io, d.occupancy.slice);
  io(d.instances), list(io, d.objects), fields(io, d.pack);
}
void fields(auto& io, Is<OrientedQuadric> auto& q) { fields(io, q.quadric), fields(io, q.inside_out); }
void fields(auto& io, Is<Keyframe> auto& k) { io(k.time_s), fields(io, k.transform); }
void fields(auto& io, Is<Motion> auto& m) {
  if constexpr (reads<decltype(io)>) {
    std::vector<Keyframe> keys;
    list(io, keys);
    if (keys.empty()) return;
    if (!can_move(keys)) io.stream.fail("an object moves as nothing can");
    m = Motion(std::move(keys));
  } else {
    list(io, m.keys());
  }
}
void fields(auto& io, Is<ObjectInfo> auto& o) {
  io(o.triangles), io(o.bytes), io(o.hash), io(o.first_surface), io(o.surface_count);
  list(io, o.objects), fields(io, o.quadric), fields(io, o.motion), fields(io, o.continues);
}

// ---- Building blocks, defined

template <class... Alternatives>
void set_kind(auto& io, std::variant<Alternatives...>& v, int index) {
  if (index >= static_cast<int>(sizeof...(Alternatives))) io.stream.fail("a record is of an unknown kind");
  int i = 0;
  ((i++ == index ? static_cast<void>(v = Alternatives{}) : void()), ...);
}
// A variant is its index in one byte, then the fields of that alternative.
template <class... Alternatives>
void fields(auto& io, std::variant<Alternatives...>& v) {
  auto index = static_cast<std::uint8_t>(v.index());
  io(index);
  if constexpr (reads<decltype(io)>) set_kind(io, v, index);
  std::visit([&](auto& alternative) { fields(io, alternative); }, v);
}
template <class... Alternatives>
void fields(auto& io, const std::variant<Alternatives...>& v) {
  io(static_cast<std::uint8_t>(v.index()));
  std::visit([&](const auto& alternative) { fields(io, alternative); }, v);
}

template <class T>
void fields(auto& io, std::vector<T>& records) {
  list(io, records);
}
template <class T>
void fields(auto& io, const std::vector<T>& records) {
  list(io, records);
}

template <class T>
void fields(auto& io, std::optional<T>& value) {
  auto given = static_cast<std::uint8_t>(value.has_value());
  io(given);
  if constexpr (reads<decltype(io)>) {
    if (given) value.emplace();
  }
  if (value) fields(io, *value);
}
template <class T>
void fields(auto& io, const std::optional<T>& value) {
  io(static_cast<std::uint8_t>(value.has_value()));
  if (value) fields(io, *value);
}

}  // namespace vitrail::records
