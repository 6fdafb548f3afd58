// SPDX-License-Identifier: Apache-2.0
#include "tracer/textures/textures.h"
#include "bundle/reflectances/color_words.h"

#include <fmt/format.h>

#include <charconv>
#include <map>
#include <optional>

#include "scene/models/pattern.h"
#include "scene/models/texture_mapping.h"
#include "scene/records/nesting_limits.h"
#include "scene/records/texture_inputs.h"
#include "scene/spectra/rgb_bands.h"
#include "scene/system/diagnostics.h"
#include "tracer/sampling/wavelengths.h"
#include "tracer/textures/image_lanes.h"
#include "tracer/textures/noise.h"
#include "tracer/textures/tile_cache.h"

namespace vitrail {

namespace {

constexpr int most_octaves = 64;

// What a texture needs besides its record.
struct Node {
  const Texture* texture = nullptr;
  const BakedImage* image = nullptr;
  PreparedMapping mapping;
  MappedPoint stretch;       // of images
  Transform world_to_solid;  // of solid checkerboards, noise and patterns
  std::size_t slot = 0;      // of mesh attributes, and of mappings by them
  Nesting nesting;
};

[[noreturn]] void fail(std::size_t id, const char* what) {
  throw Error(fmt::format("texture {} of the bundle {}", id, what));
}

Transform checked_inverse(const Transform& t, std::size_t id) {
  if (!is_invertible(t)) fail(id, "has a transform without an inverse");
  return inverse(t);
}

PreparedMapping prepared(const TextureMapping& mapping, std::size_t id) {
  PreparedMapping result{mapping, {}};
  if (auto* m = std::get_if<SphericalMapping>(&mapping))
    result.world_to_texture = checked_inverse(m->texture_to_world, id);
  if (auto* m = std::get_if<CylindricalMapping>(&mapping))
    result.world_to_texture = checked_inverse(m->texture_to_world, id);
  if (auto* m = std::get_if<GlobeMapping>(&mapping))
    result.world_to_texture = checked_inverse(m->texture_to_world, id);
  if (auto* m = std::get_if<PlanarMapping>(&mapping))
    result.world_to_texture = checked_inverse(m->texture_to_world, id);
  return result;
}

std::size_t slot_of(const std::string& name, std::size_t id) {
  std::size_t slot = 0;
  const auto [end, error] = std::from_chars(name.data(), name.data() + name.size(), slot);
  if (error != std::errc{} || end != name.data() + name.size()) fail(id, "names no slot of an attribute");
  return slot;
}

MappedPoint mapped(const Node& node, const TexturePoint& at) {
  if (!std::holds_alternative<AttributeMapping>(node.mapping.mapping))
    return map_point(node.mapping, at.uv, at.p);
  MappedPoint p;
  if (node.slot >= at.attributes.size()) return p;
  const AttributeValue& value = at.attributes[node.slot];
  for (std::size_t k = 0; k < 3; ++k) {
    p.s += static_cast<double>(value.corners[k][0]) * static_cast<double>(value.weights[k]);
    p.t += static_cast<double>(value.corners[k][1]) * static_cast<double>(value.weights[k]);
  }
  return p;
}

bool is_even(double cell) { return cell - 2 * std::floor(cell / 2) == 0; }

// ---- Lookups of spectra and of numbers

struct SpectrumLookup {
  using Value = SampledSpectrum;
  const TexturePoint& at;
  const SampledWavelengths& wavelengths;
  bool in_bands;

  Value by_band(const std::array<float, 3>& rgb) const {
    Value value;
    for (std::size_t i = 0; i < hero_count; ++i) value.v[i] = rgb[band_of(wavelengths.lambda_nm[i])];
    return value;
  }
  Value constant(const Spectrum& spectrum) const { return evaluate(spectrum, wavelengths); }
  Value constant(float number) const { return filled(number); }
  Value nearest(const BakedImage& image, MappedPoint p, Wrap wrap) const {
    return image.nearest(p.s, p.t, wrap, 0, wavelengths);
  }
  Value bilinear(const BakedImage& image, MappedPoint p, Wrap wrap, int level) const {
    return image.bilinear(p.s, p.t, wrap, level, wavelengths);
  }
  Value attribute(const AttributeValue& value, const Texture& texture) const {
    const lanes::NodeWeights<float> nodes(
        lanes::gather_wavelengths<float>([&](int) -> const SampledWavelengths& { return wavelengths; }));
    SampledSpectrum sum;
    for (std::size_t k = 0; k < 3; ++k) {
      const float corner[3] = {value.corners[k][0], value.corners[k][1], value.corners[k][2]};
      const SampledSpectrum of_corner =
          texture.is_float ? filled(corner[0])
          : in_bands       ? by_band(value.corners[k])
                           : lanes::lane(lanes::parted(lanes::sigmoid_of_nodes(corner, nodes)), 0);
      sum = sum + of_corner * value.weights[k];
    }
    return sum;
  }
  Value marble(const std::array<double, marble_color_count>& weights) const {
    SampledSpectrum sum;
    for (std::size_t k = 0; k < weights.size(); ++k)
      if (weights[k] != 0)
        sum = sum +
              (in_bands ? by_band(marble_colors[k].rgb) : evaluate(Spectrum{marble_colors[k]}, wavelengths)) *
                  static_cast<float>(weights[k]);
    return sum;
  }
  static Value scaled(const Value& v, double factor) { return v * static_cast<float>(factor); }
};

struct NumberLookup {
  using Value = double;
  const TexturePoint& at;

  Value constant(const Spectrum& spectrum) const { return evaluate(spectrum, lambda_min_nm); }
  Value constant(float number) const { return static_cast<double>(number); }
  Value nearest(const BakedImage& image, MappedPoint p, Wrap wrap) const {
    return image.nearest_vector(p.s, p.t, wrap, 0)[0];
  }
  Value bilinear(const BakedImage& image, MappedPoint p, Wrap wrap, int level) const {
    return image.bilinear_vector(p.s, p.t, wrap, level)[0];
  }
  Value attribute(const AttributeValue& value, const Texture&) const {
    double sum = 0;
    for (std::size_t k = 0; k < 3; ++k)
      sum += static_cast<double>(value.corners[k][0]) * static_cast<double>(value.weights[k]);
    return sum;
  }
  Value marble(const std::array<double, marble_color_count>& weights) const {
    double sum = 0;
    for (std::size_t k = 0; k < weights.size(); ++k) {
      const auto& [r, g, b] = marble_colors[k].rgb;
      sum += weights[k] * (.212671 * static_cast<double>(r) + .715160 * static_cast<double>(g) +
                           .072169 * static_cast<double>(b));
    }
    return sum;
  }
  static Value scaled(Value v, double factor) { return v * factor; }
};

struct VectorLookup {
  using Value = std::array<double, 3>;
  const TexturePoint& at;

  Value nearest(const BakedImage& image, MappedPoint p, Wrap wrap) const {
    return image.nearest_vector(p.s, p.t, wrap, 0);
  }
  Value bilinear(const BakedImage& image, MappedPoint p, Wrap wrap, int level) const {
    return image.bilinear_vector(p.s, p.t, wrap, level);
  }
  static Value scaled(const Value& v, double f) { return {v[0] * f, v[1] * f, v[2] * f}; }
};

std::array<double, 3> operator+(const std::array<double, 3>& a, const std::array<double, 3>& b) {
  return {a[0] + b[0], a[1] + b[1], a[2] + b[2]};
}

// Between the two levels whose texels are as wide as the footprint of the ray, or a little narrower and wider
// (Williams 1983).
template <class Lookup>
typename Lookup::Value trilinear(const Lookup& lookup, const Node& node, MappedPoint p, Wrap wrap) {
  const BakedImage& image = *node.image;
  const double texels =
      lookup.at.uv_width * std::max(node.stretch.s * image.width(), node.stretch.t * image.height());
  if (!(texels > 1)) return lookup.bilinear(image, p, wrap, 0);
  const int last = image.levels() - 1;
  const double level = std::min(portable_log(texels) / 0.6931471805599453, static_cast<double>(last));
  const int below = static_cast<int>(level);
  if (below >= last) return lookup.bilinear(image, p, wrap, last);
  const double f = level - below;
  return Lookup::scaled(lookup.bilinear(image, p, wrap, below), 1 - f) +
         Lookup::scaled(lookup.bilinear(image, p, wrap, below + 1), f);
}

template <class Lookup>
typename Lookup::Value image_value(const Lookup& lookup, const Node& node, const ImageTexture& t) {
  const MappedPoint p = mapped(node, lookup.at);
  switch (t.filter) {
    case TextureFilter::nearest:
      return lookup.nearest(*node.image, p, t.wrap);
    case TextureFilter::bilinear:
      return lookup.bilinear(*node.image, p, t.wrap, 0);
    default:
      return trilinear(lookup, node, p, t.wrap);
  }
}

// The value of one texture, a visitor of its model.
template <class Lookup>
struct Evaluation {
  using Value = typename Lookup::Value;
  const std::vector<Node>& nodes;
  const Lookup& lookup;
  const Node& node;

  template <class Parameter>
  Value of(const Parameter& parameter) const {
    if (const auto* id = std::get_if<Id<Texture>>(&parameter)) {
      const Node& next = nodes[id->value];
      return std::visit(Evaluation{nodes, lookup, next}, next.texture->model);
    }
    return lookup.constant(std::get<0>(parameter));
  }

  Value operator()(const ImageTexture& t) const { return image_value(lookup, node, t); }
  Value operator()(const CheckerboardTexture& t) const {
    const TexturePoint& at = lookup.at;
    if (t.solid) {
      const Point3d p = transform_point(node.world_to_solid, at.p);
      return is_even(std::floor(p.x) + std::floor(p.y) + std::floor(p.z)) ? of(t.even) : of(t.odd);
    }
    const MappedPoint p = mapped(node, at);
    return is_even(std::floor(p.s) + std::floor(p.t)) ? of(t.even) : of(t.odd);
  }
  Value operator()(const ProductTexture& t) const { return of(t.first) * of(t.second); }
  Value operator()(const MixTexture& t) const {
    const NumberLookup number{lookup.at};
    return mixed(t.first, t.second, Evaluation<NumberLookup>{nodes, number, node}.of(t.amount));
  }
  Value operator()(const DirectionMixTexture& t) const {
    return mixed(t.second, t.first, std::abs(dot(lookup.at.normal, t.direction)));
  }
  Value operator()(const BilinearTexture& t) const {
    const MappedPoint p = mapped(node, lookup.at);
    return Lookup::scaled(of(t.v00), (1 - p.s) * (1 - p.t)) + Lookup::scaled(of(t.v01), (1 - p.s) * p.t) +
           Lookup::scaled(of(t.v10), p.s * (1 - p.t)) + Lookup::scaled(of(t.v11), p.s * p.t);
  }
  Value operator()(const MeshAttributeTexture& t) const {
    if (node.slot >= lookup.at.attributes.size()) return {};
    return Lookup::scaled(lookup.attribute(lookup.at.attributes[node.slot], *node.texture),
                          static_cast<double>(t.scale));
  }
  Value operator()(const DotsTexture& t) const {
    const MappedPoint p = mapped(node, lookup.at);
    return inside_dot(p.s, p.t) ? of(t.inside) : of(t.outside);
  }
  Value operator()(const NoiseTexture& t) const {
    const Point3d p = transform_point(node.world_to_solid, lookup.at.p);
    if (t.kind == NoiseTexture::Kind::marble) return lookup.marble(marble_weights(t, p));
    return lookup.constant(static_cast<float>(noise_value(t, p)));
  }
  Value operator()(const PatternTexture& t) const {
    const Point3d at = t.by_uv ? Point3d{lookup.at.uv.x, lookup.at.uv.y, 0} : lookup.at.p;
    const Point3d p = transform_point(node.world_to_solid, at);
    const Vector3d n = lookup.at.normal * lookup.at.side;
    if (t.map.empty()) return lookup.constant(static_cast<float>(pattern_value(t, p, n)));
    const PatternMix mix = pattern_mix(t, p, n);
    return mixed(t.map[mix.first].value, t.map[mix.second].value, mix.amount);
  }
  // Not in bundles.
  Value operator()(const PtexTexture&) const { return {}; }
  Value operator()(const UvTexture&) const { return {}; }

 private:
  // (1 − amount)·first + amount·second
  Value mixed(const SpectrumParameter& first, const SpectrumParameter& second, double amount) const {
    if (amount == 0) return of(first);
    if (amount == 1) return of(second);
    return Lookup::scaled(of(first), 1 - amount) + Lookup::scaled(of(second), amount);
  }
};

}  // namespace

struct Textures::Implementation {
  std::vector<Node> nodes;
  std::map<std::string, BakedImage> images;
  std::shared_ptr<TileCache> cache;
  bool in_bands = false;  // colours of vertices and of marble

  Implementation(const std::vector<Texture>& textures, const std::filesystem::path& bundle,
                 std::uint64_t budget_bytes) {
    open_images(textures, bundle, budget_bytes);
    nodes.reserve(textures.size());
    for (std::size_t id = 0; id < textures.size(); ++id) nodes.push_back(make_node(textures[id], id));
  }

  void open_images(const std::vector<Texture>& textures, const std::filesystem::path& bundle,
                   std::uint64_t budget_bytes) {
    std::map<std::string, TextureFile> files;
    std::uint64_t table_bytes = 0, taken = 0;
    for (const Texture& texture : textures) {
      const auto* image = std::get_if<ImageTexture>(&texture.model);
      if (!image || files.contains(image->filename)) continue;
      const auto opened = files.emplace(image->filename, TextureFile(bundle / image->filename)).first;
      table_bytes += opened->second.layout().tiles * BakedImage::table_bytes_per_tile;
      if (finds_spectra(opened->second.info().format)) taken = conversion_bytes;
    }
    table_bytes += taken;
    cache = std::make_shared<TileCache>(budget_bytes > table_bytes ? budget_bytes - table_bytes : 0);
    for (auto& [name, file] : files) images.emplace(name, BakedImage(std::move(file), cache));
  }

  Node make_node(const Texture& texture, std::size_t id) const {
    Node node;
    node.texture = &texture;
    for_texture_inputs(texture.model, [&](Id<Texture> input) {
      if (input.value >= id) fail(id, "refers to one that does not come before it");
      node.nesting.add(nodes[input.value].nesting);
    });
    if (node.nesting.lookups > most_lookups_baked || node.nesting.levels > most_nested_baked)
      fail(id, "is nested too deeply");
    std::visit(
        [&](const auto& model) {
          if constexpr (requires { model.mapping; }) {
            node.mapping = prepared(model.mapping, id);
            if (const auto* m = std::get_if<AttributeMapping>(&model.mapping))
              node.slot = slot_of(m->slot, id);
          }
        },
        texture.model);
    if (const auto* t = std::get_if<ImageTexture>(&texture.model)) {
      node.image = &images.at(t->filename);
      node.stretch = stretch(t->mapping);
      if (texture.is_float && node.image->format() != TexelFormat::number)
        fail(id, "is a number, but not its image");
    }
    if (const auto* t = std::get_if<CheckerboardTexture>(&texture.model); t && t->solid)
      node.world_to_solid = checked_inverse(t->texture_to_world, id);
    if (const auto* t = std::get_if<NoiseTexture>(&texture.model)) {
      node.world_to_solid = checked_inverse(t->texture_to_world, id);
      if (t->octaves < 0 || t->octaves > most_octaves) fail(id, "has an impossible number of octaves");
    }
    if (const auto* t = std::get_if<PatternTexture>(&texture.model)) {
      node.world_to_solid = checked_inverse(t->texture_to_world, id);
      if (const char* fault = fault_of(*t)) fail(id, fault);
    }
    if (const auto* t = std::get_if<MeshAttributeTexture>(&texture.model)) node.slot = slot_of(t->name, id);
    return node;
  }
};

Textures::Textures(const std::vector<Texture>& textures, const std::filesystem::path& bundle,
                   std::uint64_t budget_bytes, RgbMethod rgb)
    : implementation_(std::make_unique<Implementation>(textures, bundle, budget_bytes)) {
  implementation_->in_bands = rgb == RgbMethod::bands;
}
Textures::~Textures() = default;
Textures::Textures(Textures&&) noexcept = default;

SampledSpectrum Textures::spectrum(const SpectrumParameter& parameter, const TexturePoint& at,
                                   const SampledWavelengths& wavelengths) const {
  if (const auto* constant = std::get_if<Spectrum>(&parameter)) return evaluate(*constant, wavelengths);
  const std::vector<Node>& nodes = implementation_->nodes;
  const Node& node = nodes[std::get<Id<Texture>>(parameter).value];
  const SpectrumLookup lookup{at, wavelengths, implementation_->in_bands};
  SampledSpectrum value = std::visit(Evaluation<SpectrumLookup>{nodes, lookup, node}, node.texture->model);
  for (float& v : value.v) v = std::max(v, 0.0f);
  return value;
}

double Textures::number(const FloatParameter& parameter, const TexturePoint& at) const {
  if (const auto* constant = std::get_if<float>(&parameter)) return static_cast<double>(*constant);
  const std::vector<Node>& nodes = implementation_->nodes;
  const Node& node = nodes[std::get<Id<Texture>>(parameter).value];
  const NumberLookup lookup{at};
  return std::visit(Evaluation<NumberLookup>{nodes, lookup, node}, node.texture->model);
}

std::array<double, 3> Textures::vector(Id<Texture> texture, const TexturePoint& at) const {
  const Node& node = implementation_->nodes[texture.value];
  const auto* image = std::get_if<ImageTexture>(&node.texture->model);
  if (!image) return {0.5, 0.5, 1};
  return image_value(VectorLookup{at}, node, *image);
}

const BakedImage& Textures::image(Id<Texture> texture) const {
  return *implementation_->nodes[texture.value].image;
}

const std::shared_ptr<TileCache>& Textures::tiles() const { return implementation_->cache; }
std::uint64_t Textures::tile_loads() const { return tiles()->tile_loads(); }
std::uint64_t Textures::resident_bytes() const { return tiles()->resident_bytes(); }

}  // namespace vitrail
